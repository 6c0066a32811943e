"""The document's figures: docs/document.md shows what is drawn and quotes what is so, and what the figures argue holds."""
import csv
import math
import os
import pathlib
import re
import shutil
import subprocess
import tempfile
import unittest

import lab

DOCS = pathlib.Path(__file__).resolve().parents[2] / "docs"
TEXT = (DOCS / "document.md").read_text()
# The sentences of docs/document.md with a figure, and where the run says it: figure, what.
QUOTED = (
    (r"parabolic pot by up to ([\d.]+) %", "2.2", "Parabolic pot, no dissipation: energy off by at most, as printed"),
    (r"wavy one by ([\d.]+) %", "2.2", "Wavy pot, no dissipation: energy off by at most, as printed"),
    (r"energy swings by ([\d.]+) %", "2.3", "False Euler, 10 periods: energy off by at most"),
    (r"standard Euler's is off by ([\d.]+) %", "2.3", "standard Euler, 10 periods: energy off by at most"),
    (r"([\d.]+) % of the path", "3.5", "of the path, behind the terrain"),
    (r"sharpest crease has ([\d.]+) degrees", "4.2", "sharpest crease without blending"),
    (r"blending leaves ([\d.]+)", "4.2", "sharpest crease with blending"),
    (r"up to ([\d.]+) m apart without dissipation", "hoffmann_2002", "no dissipation: as played from the exact path at most"),
    (r"([\d.]+) m with drag and friction", "hoffmann_2002", "drag and friction: as played from the exact path at most"),
    (r"creeps on at ([\d.]+) m/s", "hoffmann_2002", "drag and friction: speed at the end, as played"),
)


def read(folder, name):
    with open(os.path.join(folder, name + ".csv"), newline="") as file:
        return list(csv.DictReader(line for line in file if not line.startswith("#")))


def numbers(rows, column):
    return [float(row[column]) for row in rows]


def says(printed, value):
    """Whether `printed` is the value, rounded to the digits that are printed."""
    decimals = len(printed.partition(".")[2])
    return abs(float(printed) - value) <= 0.5 * 10.0 ** -decimals * (1 + 1e-9)


def natural_spline(values, at):
    """By the document's recursion (5.2.2), written once more: `at` in knot spacings from the first value."""
    n = len(values) - 2
    right = [6 * (values[i + 1] - 2 * values[i] + values[i - 1]) for i in range(1, n + 1)]
    factors = [0.25]
    for _ in range(n - 1):
        factors.append(1 / (4 - factors[-1]))
    for i in range(1, n):
        right[i] -= right[i - 1] * factors[i - 1]
    bends = [0.0] * (n + 2)
    for i in range(n, 0, -1):
        bends[i] = (right[i - 1] - bends[i + 1]) * factors[i - 1]
    i = min(max(math.floor(at), 0), n)
    d = at - i
    slope = values[i + 1] - values[i] - (bends[i + 1] + 2 * bends[i]) / 6
    return values[i] + d * (slope + d * (bends[i] / 2 + d * (bends[i + 1] - bends[i]) / 6))


class Figures(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scratch = tempfile.TemporaryDirectory()
        cls.folder = cls.scratch.name
        cls.pictures = os.path.join(cls.folder, "pictures")
        os.mkdir(cls.pictures)
        done = lab.run("figures", "--quick", "--out", cls.folder, "--pictures", cls.pictures)
        if done.returncode != 0:
            raise AssertionError(done.stderr)

    @classmethod
    def tearDownClass(cls):
        cls.scratch.cleanup()

    def test_what_the_page_shows_is_what_is_drawn(self):
        shown = set(re.findall(r"\(pictures/(document-[^)]+)\)", TEXT))
        self.assertEqual({name[:-4] for name in shown if name.endswith(".png")},
                         {name[:-4] for name in shown if name.endswith(".svg")}, "each as PNG and as SVG")
        self.assertEqual(shown, {file.name for file in (DOCS / "pictures").glob("document-*")})
        for name in shown:
            self.assertLess((DOCS / "pictures" / name).stat().st_size, 300_000, name)
        if shutil.which("gnuplot"):
            self.assertEqual(shown, set(os.listdir(self.pictures)))
            for name in shown:
                self.assertGreater(os.path.getsize(os.path.join(self.pictures, name)), 10_000, name)
        else:
            self.assertEqual(os.listdir(self.pictures), [])

    def test_what_the_page_quotes_is_what_a_full_run_says(self):
        with tempfile.TemporaryDirectory() as folder:
            done = lab.run("figures", "--out", folder, env={**os.environ, "PATH": folder})  # no gnuplot: only tables
            self.assertEqual(done.returncode, 0, done.stderr)
            value = {(row["figure"], row["what"]): float(row["value"]) for row in read(folder, "document-figures")}
        text = " ".join(TEXT.split())
        for pattern, figure, what in QUOTED:
            found = re.findall(pattern, text)
            self.assertEqual(len(found), 1, pattern)
            self.assertTrue(says(found[0], value[figure, what]), f"{pattern}: {found[0]}, not {value[figure, what]}")

    def test_the_exact_energy_is_constant_and_the_printed_one_is_not(self):
        for (pot, forces, equations), rows in lab.groups(read(self.folder, "document-2.2"), "pot", "forces", "equations").items():
            energies = numbers(rows, "energy")
            spread = (max(energies) - min(energies)) / energies[0]
            if forces != "none":
                self.assertLess(energies[-1], 0.9 * energies[0], f"{pot} {forces} {equations}")
            elif equations == "surface":
                self.assertLess(spread, 1e-6, pot)  # the table has seven digits
            else:
                self.assertGreater(spread, 0.05, pot)

    def test_with_dissipation_the_exact_energy_only_falls(self):
        for (pot, forces), rows in lab.groups(filter(lambda row: row["equations"] == "surface", read(self.folder, "document-2.2")),
                                              "pot", "forces").items():
            energies = numbers(rows, "energy")
            for before, after in zip(energies, energies[1:]):
                self.assertLessEqual(after, before * (1 + 1e-6), f"{pot} {forces}")

    def test_false_euler_keeps_the_planet_s_angular_momentum(self):
        rows = lab.groups(read(self.folder, "document-2.3"), "integrator")
        for momentum in numbers(rows["false_euler",], "angular_momentum"):
            self.assertAlmostEqual(momentum, 0.8, delta=1e-6)
        self.assertGreater(numbers(rows["explicit_euler",], "angular_momentum")[-1], 0.85)

    def test_the_terrain_hides_a_part_of_the_path(self):
        hidden = numbers(read(self.folder, "document-3.5"), "hidden")
        self.assertEqual(set(hidden), {0.0, 1.0})

    def test_blending_joins_the_normals(self):
        creases = lab.groups(read(self.folder, "document-4.2"), "interpolation", "line")
        worst = {key: max(numbers(rows, "crease_degrees")) for key, rows in creases.items()}
        self.assertGreater(worst["biquadratic", "halfway"], 0.5)
        self.assertLess(worst["biquadratic", "knots"], 1e-5, "there one polynomial goes on")
        self.assertLess(worst["blended_document", "knots"], 1e-5)
        self.assertLess(worst["blended_document", "halfway"], 0.05 * worst["biquadratic", "halfway"],
                        "but for the fourth neighbour, which the three leave out")

    def test_a_value_is_the_column_s_spline_through_the_rows_values(self):
        rows = lab.groups(read(self.folder, "document-5.1"), "what")
        values = numbers(rows["value",], "z")
        result = rows["result",][0]
        self.assertEqual(len(values), 11)
        knots = {}
        for row in rows["knot",]:
            knots.setdefault(float(row["y"]), []).append((float(row["x"]), float(row["z"])))
        x = float(result["x"])
        for (y, row), value in zip(sorted(knots.items()), values):
            through = natural_spline([z for _, z in sorted(row)], 5 * (x + 1))
            self.assertAlmostEqual(through, value, delta=1e-6, msg=f"row {y}")
        self.assertAlmostEqual(natural_spline(values, 5 * (float(result["y"]) + 1)), float(result["z"]), delta=1e-6)

    def test_the_map_of_2002_parts_from_the_exact_motion(self):
        rows = lab.groups(read(self.folder, "document-hoffmann-2002"), "forces", "motion")
        exact, played = rows["none", "exact"], rows["none", "as_played"]
        self.assertEqual([exact[0][name] for name in ("x", "y", "vx", "vy")], [played[0][name] for name in ("x", "y", "vx", "vy")])
        energies = numbers(exact, "energy")
        self.assertLess(max(energies) - min(energies), 1e-6 * energies[0])
        self.assertGreater(math.dist([float(exact[-1][v]) for v in "xy"], [float(played[-1][v]) for v in "xy"]), 1.0)
        for row in played:  # there are no walls in the figure: it needs none
            self.assertLess(max(abs(float(row["x"])), abs(float(row["y"]))), 20.0)

    def test_a_picture_that_can_not_be_written_is_told(self):
        done = subprocess.run([lab.LAB, "figures", "--quick", "--out", "/nonexistent"], capture_output=True, text=True)
        self.assertEqual(done.returncode, 2)
        self.assertIn("--out", done.stderr)


if __name__ == "__main__":
    unittest.main()
