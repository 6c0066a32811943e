"""Central gravity and unilateral contact against closed forms."""
import json
import math
import os
import tempfile
import unittest

import lab


def on_map(heights, origin, spacing, state, **options):
    """The path over a grid of heights."""
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "ground.json")
        with open(path, "w") as file:
            json.dump({"name": "ground", "terrain": {"origin": origin, "spacing": spacing, "heights": heights}, "physics": {}}, file)
        arguments = ["trajectory", "--surface", "not_a_knot", "--map", path, "--state", ",".join(map(repr, state))]
        for name, value in options.items():
            arguments += ["--" + name.replace("_", "-"), value]
        return [{key: float(value) for key, value in row.items()} for row in lab.table(*arguments)]


def flat(state, **options):
    return on_map([[0.0] * 5] * 5, [-20, -20], 10, state, gravity=0, **options)


class CentralGravity(unittest.TestCase):
    def test_a_planet_runs_its_ellipse_by_kepler_s_equation(self):
        speed = 0.8
        eccentricity, axis = 1 - speed**2, 1 / (2 - speed**2)  # it starts at the far end
        for integrator, error in (("nystrom4", 2e-7), ("verlet_q", 2e-3), ("precise", 2e-7), ("dopri5", 2e-9)):
            for row in flat((1.0, 0.0, 0.0, speed), central_gravity=1, integrator=integrator, rate=120, seconds=10, every=60):
                mean = math.pi + row["t"] / axis**1.5
                anomaly = mean
                for _ in range(50):
                    anomaly -= (anomaly - eccentricity * math.sin(anomaly) - mean) / (1 - eccentricity * math.cos(anomaly))
                x = -axis * (math.cos(anomaly) - eccentricity)
                y = -axis * math.sqrt(1 - eccentricity**2) * math.sin(anomaly)
                self.assertLess(math.hypot(row["x"] - x, row["y"] - y), error, f"{integrator} {row['t']}")

    def test_its_energy_counts_the_pull(self):
        rows = flat((2.0, 0.0, 0.0, 1.5), central_gravity=3, rate=240, seconds=5)
        for row in rows:
            self.assertAlmostEqual(row["energy"], 1.5**2 / 2 - 3 / 2, delta=1e-9)

    def test_in_a_bowl_a_circle_s_speed_is_that_of_both_pulls(self):
        # z = r^2 / 2: omega^2 = g + k / r^3.
        k, r = 0.2, 0.5
        omega = math.sqrt(9.81 + k / r**3)
        rows = lab.table("trajectory", "--surface", "function", "--function", "parabolic_pot", "--central-gravity", k, "--rate", 240,
                         "--seconds", 5, "--state", f"{r},0,0,{omega * r!r}", "--every", 24)
        for row in rows:
            t = float(row["t"])
            self.assertLess(math.hypot(float(row["x"]) - r * math.cos(omega * t), float(row["y"]) - r * math.sin(omega * t)), 1e-7, t)


class Flight(unittest.TestCase):
    """A table whose edge bends down as -b x^3, and from x = c up again with 8 b (x - c)^3: a C2 cubic, which the spline repeats."""

    g, b, c = 9.81, 0.02, 4.0

    def ground(self, x):
        return -self.b * max(x, 0.0)**3 + 8 * self.b * max(x - self.c, 0.0)**3

    def slope(self, x):
        return -3 * self.b * max(x, 0.0)**2 + 24 * self.b * max(x - self.c, 0.0)**2

    def jump(self, state, **options):
        heights = [[self.ground(-4 + 0.5 * i) for i in range(29)]] * 17
        return on_map(heights, [-4, -4], 0.5, state, **options)

    def leaves_at(self, x):
        """The speed on the table of a louse that takes off at x."""
        return math.sqrt(self.g * (1 - 3 * self.b**2 * x**4) / (6 * self.b * x))

    def test_it_leaves_where_the_normal_force_ends_and_lands_where_the_parabola_does(self):
        leaves = 2.4
        lands = 2 * self.c - leaves
        rows = self.jump((-1.7, -1.0, self.leaves_at(leaves), 0.4), contact="unilateral", integrator="precise", rate=240, seconds=1.6)
        flying = [row for row in rows if row["z"] > self.ground(row["x"]) + 1e-9]
        self.assertGreater(len(flying), 100)
        self.assertLess(abs(flying[0]["x"] - leaves), 0.1)  # 1e-9 m above the ground
        self.assertLess(lands - flying[-1]["x"], flying[-1]["vx"] / 240)
        along = math.sqrt((self.leaves_at(leaves)**2 - 2 * self.g * self.ground(leaves)) / (1 + self.slope(leaves)**2))
        for row in flying:
            self.assertAlmostEqual(row["vx"], along, delta=1e-8)
            # Where it takes off, its speed is brought to the energy it had: some last bits.
            self.assertAlmostEqual(row["vy"], 0.4, delta=1e-15)
            # It touches the ground in second order where it leaves.
            self.assertAlmostEqual(row["z"] - self.ground(row["x"]),
                                   self.b * (row["x"] - leaves)**3 - 8 * self.b * max(row["x"] - self.c, 0.0)**3, delta=1e-7)

    def test_energy_is_kept_but_for_what_the_landing_takes(self):
        leaves = 2.6
        rows = self.jump((-1.0, 0.0, self.leaves_at(leaves), 0.0), contact="unilateral", integrator="nystrom4", rate=240, seconds=1.4)
        lands = 2 * self.c - leaves
        start = rows[0]["energy"]
        along = rows[len(rows) // 2]["vx"]
        falls = self.slope(leaves) * along - self.g * (lands - leaves) / along
        taken = (falls - self.slope(lands) * along)**2 / (1 + self.slope(lands)**2) / 2
        before = [row["energy"] for row in rows if row["x"] < lands - along / 240]
        after = [row["energy"] for row in rows if row["x"] > lands + along / 240]
        self.assertLess(max(abs(e - start) for e in before), 1e-6)
        self.assertGreater(len(after), 10)
        self.assertGreater(taken, 1.0)
        self.assertLess(max(abs(e - (start - taken)) for e in after), 1e-5)

    def test_a_bead_on_a_wire_stays_on_the_same_ground(self):
        for row in self.jump((-1.7, 0.0, self.leaves_at(2.4), 0.0), seconds=1.5):
            self.assertAlmostEqual(row["z"], self.ground(row["x"]), delta=1e-12)

    def test_below_the_speed_that_lifts_it_the_two_contacts_run_alike(self):
        start = (-1.7, 0.0, 1.0, 0.0)
        self.assertEqual(self.jump(start, seconds=2, contact="unilateral"), self.jump(start, seconds=2))


if __name__ == "__main__":
    unittest.main()
