"""Trajectories against those that an independent program integrated to 1e-13, and against the document's."""
import math
import unittest

import lab


def trajectory(surface, function, state, **options):
    arguments = ["trajectory", "--surface", surface, "--function", function, "--state", ",".join(state)]
    for name, value in options.items():
        arguments += [f"--{name}", value]
    return lab.table(*arguments)


def distance(row, x, y):
    return math.hypot(float(row["x"]) - float(x), float(row["y"]) - float(y))


class Trajectory(unittest.TestCase):
    def errors(self, integrator, rate, only=lambda row: True):
        """The position's error at each time of each reference trajectory."""
        keys = ("surface", "drag", "mu", "thrust_x", "thrust_y", "x0", "y0", "vx0", "vy0")
        for key, rows in lab.groups(filter(only, lab.reference("exact_trajectories.csv")), *keys).items():
            function, drag, mu, tx, ty, *state = key
            got = trajectory("function", function, state, integrator=integrator, rate=rate, drag=drag, mu=mu,
                             thrust=f"{tx},{ty}", seconds=max(float(r["t"]) for r in rows), every=rate // 2)
            at = {float(r["t"]): r for r in got}
            for row in rows:
                yield distance(at[float(row["t"])], row["x"], row["y"])

    def test_the_default_at_120_hz_is_within_3e_7(self):
        errors = list(self.errors("nystrom4", 120))
        self.assertEqual(len(errors), 72)
        self.assertLessEqual(max(errors), 3e-7)

    def test_dopri5_at_240_hz_is_within_1e_9_without_friction(self):
        self.assertLessEqual(max(self.errors("dopri5", 240, lambda row: float(row["mu"]) == 0.0)), 1e-9)

    def test_the_document_s_trajectories_are_met_to_1e_9(self):
        # Surface and how far out the document's stencil stays on its grid: it checks no bounds.
        methods = {"spline": ("natural", 1.0), "biquadratic": ("biquadratic", 0.95), "blended": ("blended_document", 0.9)}
        keys = ("surface", "g", "method", "corrected_cramer")
        compared = 0
        for (function, grid, method, corrected), rows in lab.groups(lab.reference("seed_trajectories.csv"), *keys).items():
            surface, reach = methods[method]
            got = trajectory(surface, function, ("0.35", "-0.2", "0.3", "0.4"), grid=grid, rate=200, seconds=5,
                             equations="local_plane" if corrected == "1" else "as_printed", integrator="false_euler",
                             drag="0.2", mu="0.05", every=1)
            left = next((i for i, r in enumerate(got) if max(abs(float(r["x"])), abs(float(r["y"]))) > reach), len(got))
            for row in rows:
                if int(row["step"]) < left:
                    compared += 1
                    error = distance(got[int(row["step"])], row["x"], row["y"])
                    self.assertLessEqual(error, 1e-9, f"{function} {method} {corrected} {row['step']}")
        self.assertGreater(compared, 180)

    def test_rest_positions_at_60_hz_are_within_3e_6(self):
        for row in lab.reference("stops.csv"):
            state = [row[name] for name in ("x0", "y0", "vx0", "vy0")]
            got = trajectory("function", row["surface"], state, rate=60, seconds=60, drag=row["drag"], mu=row["mu"], every=60)
            self.assertEqual(len(got), 61, "rows go on at rest")
            self.assertEqual((float(got[-1]["vx"]), float(got[-1]["vy"])), (0.0, 0.0))
            self.assertLessEqual(distance(got[-1], row["x_rest"], row["y_rest"]), 3e-6)

    def test_energy_is_kinetic_plus_potential(self):
        row = trajectory("function", "parabolic_pot", ("0.5", "0", "0", "2"), seconds=0)[0]
        self.assertAlmostEqual(float(row["energy"]), 0.5 * 4 + 9.81 * 0.125, delta=1e-14)


if __name__ == "__main__":
    unittest.main()
