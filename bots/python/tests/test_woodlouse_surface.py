"""The server's surface in Python, against what is known of splines: python3 -m unittest test_woodlouse_surface

That it is the server's own is seen in test_predict.py, on a server.
"""

import math
import os
import sys
import unittest

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from woodlouse_surface import FunctionSurface, SplineSurface

ORIGIN, SPACING, COLUMNS, ROWS = (-2.0, 1.0), (0.5, 0.25), 9, 7


def spline(function, ends):
    heights = [[function(ORIGIN[0] + SPACING[0] * i, ORIGIN[1] + SPACING[1] * j) for i in range(COLUMNS)]
               for j in range(ROWS)]
    return SplineSurface(ORIGIN, SPACING, heights, ends)


def places(count):
    """Points spread over the spline's rectangle."""
    return [(-2 + 4 * (k * 0.618034 % 1), 1 + 1.5 * (k * 0.414214 % 1)) for k in range(count)]


def wave(x, y):
    """Periodic over the rectangle."""
    return math.sin(math.pi * x / 2 + 0.3) * math.cos(math.pi * (y - 1) / 0.75 + 0.2)


class Near(unittest.TestCase):
    def assert_near(self, found, expected, delta):
        self.assertEqual(len(found), len(expected))
        for a, b in zip(found, expected):
            self.assertAlmostEqual(a, b, delta=delta)

    def assert_derivatives(self, surface, at, delta, step=1e-5):
        for x, y in at:
            east, west = surface.sample(x + step, y), surface.sample(x - step, y)
            north, south = surface.sample(x, y + step), surface.sample(x, y - step)
            _, zx, zy, zxx, zxy, zyy = surface.sample(x, y)
            by_x = [(a - b) / (2 * step) for a, b in zip(east, west)]
            by_y = [(a - b) / (2 * step) for a, b in zip(north, south)]
            self.assert_near((zx, zy, zxx, zxy, zyy), (by_x[0], by_y[0], by_x[1], by_y[1], by_y[2]), delta)


class Spline(Near):
    def test_its_derivatives_are_those_of_its_heights(self):
        for ends in ("not_a_knot", "natural", "periodic"):
            self.assert_derivatives(spline(wave, ends), places(60), 1e-3)  # the third derivative jumps at knots

    def test_it_goes_through_its_knots(self):
        for ends in ("not_a_knot", "natural"):
            surface = spline(lambda x, y: math.sin(9 * x) + y ** 5, ends)
            for j in range(ROWS):
                for i in range(COLUMNS):
                    x, y = ORIGIN[0] + SPACING[0] * i, ORIGIN[1] + SPACING[1] * j
                    self.assertAlmostEqual(surface.sample(x, y)[0], math.sin(9 * x) + y ** 5, places=11)

    def test_not_a_knot_repeats_bicubics_exactly_to_the_rim(self):
        surface = spline(lambda x, y: x ** 3 * y ** 3 - 2 * x * x * y + 3 * y ** 3, "not_a_knot")
        for x, y in places(60) + [(-2, 1), (2, 2.5)]:
            self.assert_near(surface.sample(x, y),
                             (x ** 3 * y ** 3 - 2 * x * x * y + 3 * y ** 3, 3 * x * x * y ** 3 - 4 * x * y,
                              3 * x ** 3 * y * y - 2 * x * x + 9 * y * y, 6 * x * y ** 3 - 4 * y,
                              9 * x * x * y * y - 4 * x, 6 * x ** 3 * y + 18 * y), 1e-9)

    def test_natural_ends_do_not_bend_across_the_rim(self):
        surface = spline(lambda x, y: x ** 3 + y ** 4, "natural")
        for k in range(20):
            x, y = -2 + 0.2 * k, 1 + 0.075 * k
            self.assertAlmostEqual(surface.sample(-2, y)[3], 0, places=9)
            self.assertAlmostEqual(surface.sample(2, y)[3], 0, places=9)
            self.assertAlmostEqual(surface.sample(x, 1)[5], 0, places=9)
            self.assertAlmostEqual(surface.sample(x, 2.5)[5], 0, places=9)
        self.assertGreater(abs(surface.sample(1, 1.75)[3]), 1)

    def test_periodic_ends_go_on_over_the_seam_up_to_the_curvature(self):
        surface = spline(wave, "periodic")
        for x, y in places(40):
            self.assert_near(surface.sample(2 + 1e-10, y), surface.sample(2 - 1e-10, y), 1e-7)
            self.assert_near(surface.sample(x, 1 + 1e-10), surface.sample(x, 1 - 1e-10), 1e-6)
            self.assert_near(surface.sample(x - 8, y + 3), surface.sample(x, y), 1e-9)


class Functions(Near):
    def test_their_derivatives_are_those_of_their_heights(self):
        for name in ("parabolic_pot", "wavy_pot", "volcano", "hills", "waves"):
            self.assert_derivatives(FunctionSurface(name, 2.0), places(40), 1e-7)

    def test_their_heights_are_those_of_the_maps_readme(self):
        x, y, scale = 3.0, -7.0, 20.0
        u, v = x / scale, y / scale
        pot, pi = 0.5 * (u * u + v * v), math.pi
        for name, height in (("parabolic_pot", pot), ("volcano", pot + 0.02 / (2 * pot + 0.1)),
                             ("wavy_pot", pot + 0.03 * math.cos(2 * pi * u) * math.cos(2 * pi * v)),
                             ("hills", 0.3 * math.sin(2.3 * u + 0.4) * math.cos(1.7 * v - 0.2) + 0.1 * u * v),
                             ("waves", 0.12 * math.cos(pi * u) * math.cos(pi * v) +
                              0.03 * math.sin(2 * pi * u) * math.sin(3 * pi * v))):
            self.assertAlmostEqual(FunctionSurface(name, scale).sample(x, y)[0], scale * height, places=12)

    def test_there_are_no_others(self):
        with self.assertRaises(ValueError):
            FunctionSurface("mountain")


if __name__ == "__main__":
    unittest.main()
