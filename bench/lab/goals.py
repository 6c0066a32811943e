#!/usr/bin/env python3
"""Measures the accuracy goals with woodlouse-lab against tests/reference and prints a line for each.

    bench/lab/goals.py build/release/bin/woodlouse-lab tests/reference > bench/results/lab-goals.txt
"""
import csv
import io
import math
import os
import subprocess
import sys


def table(lab, *arguments, text=None):
    done = subprocess.run([lab, *map(str, arguments)], input=text, capture_output=True, text=True, check=True)
    return list(csv.DictReader(io.StringIO(done.stdout)))


def groups(rows, *keys):
    result = {}
    for row in rows:
        result.setdefault(tuple(row[key] for key in keys), []).append(row)
    return result


def processor():
    with open("/proc/cpuinfo") as file:
        return next((line.split(":", 1)[1].strip() for line in file if line.startswith("model name")), "unknown")


def preamble(command):
    commit = subprocess.run(["git", "rev-parse", "--short", "HEAD"], capture_output=True, text=True).stdout.strip() or "not told"
    return f"# machine: {processor()}\n# commit: {commit}\n# command: {command}"


def distance(row, x, y):
    return math.hypot(float(row["x"]) - float(x), float(row["y"]) - float(y))


class Goals:
    def __init__(self, lab, reference):
        self.lab = lab
        self.reference = lambda name: list(csv.DictReader(open(os.path.join(reference, name), newline="")))

    def tell(self, what, measured, goal):
        print(f"{what:<76} {measured:>10.3g} {goal:>10.3g}  {'met' if measured <= goal else 'MISSED'}")

    def surfaces(self):
        for surface, column in (("natural", "spline"), ("natural_document", "spline"), ("biquadratic", "biquad"), ("blended_document", "blend")):
            worst = 0.0
            for (function, grid), rows in groups(self.reference("surfaces.csv"), "surface", "g").items():
                points = "".join(f"{r['x']},{r['y']}\n" for r in rows)
                got = table(self.lab, "sample", "--surface", surface, "--function", function, "--grid", grid, "--points", "-", text=points)
                for want, have in zip(rows, got):
                    worst = max([worst, *(abs(float(want[f"{column}_{v}"]) - float(have[v])) for v in ("z", "zx", "zy"))])
            self.tell(f"surfaces.csv, {surface}: z and gradient", worst, 1e-12)

    def exact(self, integrator, rate, goal, label, only):
        keys = ("surface", "drag", "mu", "thrust_x", "thrust_y", "x0", "y0", "vx0", "vy0")
        worst = 0.0
        for (function, drag, mu, tx, ty, *state), rows in groups(filter(only, self.reference("exact_trajectories.csv")), *keys).items():
            got = table(self.lab, "trajectory", "--surface", "function", "--function", function, "--integrator", integrator,
                        "--rate", rate, "--seconds", max(float(r["t"]) for r in rows), "--state", ",".join(state),
                        "--drag", drag, "--mu", mu, "--thrust", f"{tx},{ty}", "--every", rate // 2)
            at = {float(r["t"]): r for r in got}
            worst = max([worst, *(distance(at[float(r["t"])], r["x"], r["y"]) for r in rows)])
        self.tell(f"exact_trajectories.csv, {integrator}, {rate} Hz{label}", worst, goal)

    def stops(self):
        worst, all_rest = 0.0, True
        for row in self.reference("stops.csv"):
            state = ",".join(row[name] for name in ("x0", "y0", "vx0", "vy0"))
            end = table(self.lab, "trajectory", "--surface", "function", "--function", row["surface"], "--rate", 60, "--seconds", 60,
                        "--state", state, "--drag", row["drag"], "--mu", row["mu"], "--every", 3600)[-1]
            all_rest = all_rest and float(end["vx"]) == float(end["vy"]) == 0.0
            worst = max(worst, distance(end, row["x_rest"], row["y_rest"]))
        self.tell("stops.csv, nystrom4, 60 Hz: rest positions" + ("" if all_rest else " (SOME DO NOT REST)"), worst, 3e-6)
        self.tell("  the further goal", worst, 3e-7)

    def document(self):
        methods = {"spline": ("natural", 1.0), "biquadratic": ("biquadratic", 0.95), "blended": ("blended_document", 0.9)}
        worst, compared = 0.0, 0
        keys = ("surface", "g", "method", "corrected_cramer")
        for (function, grid, method, corrected), rows in groups(self.reference("seed_trajectories.csv"), *keys).items():
            surface, reach = methods[method]
            got = table(self.lab, "trajectory", "--surface", surface, "--function", function, "--grid", grid, "--rate", 200, "--seconds", 5,
                        "--state", "0.35,-0.2,0.3,0.4", "--drag", 0.2, "--mu", 0.05, "--integrator", "false_euler",
                        "--equations", "local_plane" if corrected == "1" else "as_printed")
            left = next((i for i, r in enumerate(got) if max(abs(float(r["x"])), abs(float(r["y"]))) > reach), len(got))
            for row in rows:
                if int(row["step"]) < left:
                    compared += 1
                    worst = max(worst, distance(got[int(row["step"])], row["x"], row["y"]))
        self.tell(f"seed_trajectories.csv, {compared} rows on the grid, false_euler, 200 Hz", worst, 1e-9)

    def energy(self):
        raster = [i / 1000 for i in range(-1000, 1001, 5)]
        lowest = min(0.5 * (x * x + y * y) + 0.03 * math.cos(2 * math.pi * x) * math.cos(2 * math.pi * y) for x in raster for y in raster)
        # A louse that is pushed, be it ever so little, does not keep its energy by projection.
        for integrator, thrust, goal in (("nystrom4", 0, 3e-5), ("nystrom4", 1e-12, 3e-5), ("verlet_q", 0, 5e-4)):
            rows = table(self.lab, "trajectory", "--surface", "function", "--function", "wavy_pot", "--integrator", integrator,
                         "--rate", 120, "--seconds", 1000, "--state", "0.8,0,0,1.5", "--thrust", f"{thrust},0", "--every", 12)
            start = float(rows[0]["energy"])
            error = max(abs(float(r["energy"]) - start) for r in rows) / (start - 9.81 * lowest)
            self.tell(f"energy over 1000 s, wavy_pot, 120 Hz, {integrator}" + (", not projected" if thrust else ""), error, goal)


def main():
    if len(sys.argv) != 3:
        sys.exit("goals.py: takes the path of woodlouse-lab and the folder of the reference tables\n  see the head of this file")
    goals = Goals(*sys.argv[1:])
    print(preamble(f"bench/lab/goals.py {sys.argv[1]} {sys.argv[2]}"))
    print(f"{'goal':<76} {'measured':>10} {'goal':>10}")
    goals.surfaces()
    goals.exact("nystrom4", 120, 3e-7, "", lambda row: True)
    goals.exact("dopri5", 240, 1e-9, ", mu = 0", lambda row: float(row["mu"]) == 0.0)
    goals.stops()
    goals.document()
    goals.energy()


if __name__ == "__main__":
    main()
