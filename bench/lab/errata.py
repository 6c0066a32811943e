#!/usr/bin/env python3
"""Measures with woodlouse-lab what the document's errors amount to, a line for each figure.

    bench/lab/errata.py build/release/bin/woodlouse-lab > bench/results/lab-errata.txt
"""
import json
import math
import os
import sys
import tempfile

from goals import distance, preamble, table


def tell(what, value, unit):
    print(f"{what:<104} {value:>9.3g} {unit}".rstrip())


def local_plane(lab):
    """Erratum 2: without dissipation, both integrated far below the difference."""
    for function, state, how in (("parabolic_pot", "0.8,0,0,1.5", "thrown"), ("parabolic_pot", "0.8,0,0,0", "let go"),
                                 ("wavy_pot", "0.8,0,0,1.5", "thrown"), ("wavy_pot", "0.8,0,0,0", "let go")):
        exact, plane = (table(lab, "trajectory", "--surface", "function", "--function", function, "--equations", equations,
                              "--integrator", "dopri5", "--rate", 240, "--seconds", 10, "--state", state)
                        for equations in ("surface", "local_plane"))
        start = float(exact[0]["energy"])
        where = f"2: local plane, {function}, {how} at {state}, 10 s"
        tell(f"{where}: position, furthest", max(distance(a, b["x"], b["y"]) for a, b in zip(exact, plane)), "m")
        tell(f"{where}: energy, furthest", max(abs(float(row["energy"]) / start - 1) for row in plane) * 100, "%")


def creep(lab):
    """Erratum 5: a slope that friction holds, so a louse at rest stays for ever."""
    with tempfile.TemporaryDirectory() as folder:
        slope = os.path.join(folder, "slope.json")
        row = [0.04 * x for x in range(-400, 401, 40)]
        with open(slope, "w") as file:
            json.dump({"name": "slope", "terrain": {"origin": [-400, -80], "spacing": 40, "heights": [row] * 5}, "physics": {}}, file)
        for equations, integrator in (("as_printed", "false_euler"), ("local_plane", "false_euler"), ("surface", "nystrom4")):
            end = table(lab, "trajectory", "--surface", "not_a_knot", "--map", slope, "--equations", equations, "--integrator", integrator,
                        "--seconds", 600, "--state", "0,0,0,0", "--mu", 0.05, "--every", 36000)[-1]
            tell(f"5: creep, slope 0.04, mu 0.05, {equations}, {integrator}, 60 Hz, 600 s", math.hypot(float(end["x"]), float(end["y"])), "m")


def gradients(lab):
    """Erratum 11: the blended gradient against the derivative of the same height, where no stencil is at the rim."""
    ticks = [0.9 * i / 100 for i in range(-100, 101)]
    points = "".join(f"{x!r},{y!r}\n" for y in ticks for x in ticks)
    for function in ("wavy_pot", "volcano"):
        printed, right = (table(lab, "sample", "--surface", surface, "--function", function, "--grid", 10, "--points", "-", text=points)
                          for surface in ("blended_document", "blended"))
        worst = max(abs(float(a[v]) - float(b[v])) for a, b in zip(printed, right) for v in ("zx", "zy"))
        tell(f"11: blended gradient, {function}, knots 0.1 apart: off the derivative of its height", worst, "")


def main():
    if len(sys.argv) != 2:
        sys.exit("errata.py: takes the path of woodlouse-lab\n  see the head of this file")
    print(preamble(f"bench/lab/errata.py {sys.argv[1]}"))
    for measure in (local_plane, creep, gradients):
        measure(sys.argv[1])


if __name__ == "__main__":
    main()
