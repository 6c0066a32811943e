"""The surfaces against the document's procedures, and what a sample says of itself."""
import unittest

import lab

INTERPOLATIONS = {"natural": "spline", "natural_document": "spline", "biquadratic": "biquad", "blended_document": "blend"}


def sample(surface, function, grid, points):
    text = "".join(f"{x},{y}\n" for x, y in points)
    return lab.table("sample", "--surface", surface, "--function", function, "--grid", grid, "--points", "-", text=text)


class Sample(unittest.TestCase):
    def test_spline_biquadratic_and_blended_meet_the_reference_to_1e_12(self):
        for (function, grid), rows in lab.groups(lab.reference("surfaces.csv"), "surface", "g").items():
            for surface, column in INTERPOLATIONS.items():
                got = sample(surface, function, grid, [(r["x"], r["y"]) for r in rows])
                self.assertEqual(len(got), len(rows))
                for want, have in zip(rows, got):
                    for value in ("z", "zx", "zy"):
                        error = abs(float(want[f"{column}_{value}"]) - float(have[value]))
                        self.assertLessEqual(error, 1e-12, f"{surface} of {function}, grid {grid}: {value} at {want['x']}, {want['y']}")

    def test_points_come_back_as_they_were_given(self):
        row = sample("function", "hills", 10, [(0.1, -0.30000000000000004)])[0]
        self.assertEqual((float(row["x"]), float(row["y"])), (0.1, -0.30000000000000004))

    def test_a_surface_without_hessian_leaves_its_fields_empty(self):
        row = sample("biquadratic", "hills", 10, [(0.1, 0.2)])[0]
        self.assertEqual((row["zxx"], row["zxy"], row["zyy"]), ("", "", ""))
        self.assertNotEqual(row["z"], "")

    def test_every_surface_is_near_the_function(self):
        for surface in "not_a_knot natural periodic natural_document biquadratic blended blended_document blended_differenced gauss bspline".split():
            function = "wavy_pot" if surface == "periodic" else "hills"
            exact = sample("function", function, 40, [(0.21, -0.33)])[0]
            got = sample(surface, function, 40, [(0.21, -0.33)])[0]
            self.assertAlmostEqual(float(exact["z"]), float(got["z"]), delta=1e-4, msg=surface)
            self.assertAlmostEqual(float(exact["zx"]), float(got["zx"]), delta=1e-2, msg=surface)

    def test_outside_the_domain_there_is_nothing_unless_asked_to_extend(self):
        text = "1.25,0\n"
        options = ("sample", "--surface", "not_a_knot", "--function", "parabolic_pot", "--points", "-")
        self.assertEqual(lab.table(*options, text=text)[0]["z"], "")
        self.assertAlmostEqual(float(lab.table(*options, "--outside", "extend", text=text)[0]["z"]), 0.78125, delta=1e-12)


if __name__ == "__main__":
    unittest.main()
