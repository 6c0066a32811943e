"""The ground between its knots: python3 -m unittest test_woodlouse_ground"""

import math
import os
import sys
import unittest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import woodlouse


class TheGround(unittest.TestCase):
    def ground(self, function, columns=9, rows=7):
        heights = [[function(-2 + 0.5 * i, 1 + 0.25 * j) for i in range(columns)] for j in range(rows)]
        return woodlouse.Ground("g", [-2, 1], [0.5, 0.25], heights)

    def test_it_goes_through_its_knots(self):
        ground = self.ground(lambda x, y: math.sin(3 * x) + y * y)
        for j in range(ground.rows):
            for i in range(ground.columns):
                self.assertAlmostEqual(ground.height(-2 + 0.5 * i, 1 + 0.25 * j), ground.heights[j][i], places=12)

    def test_it_is_exact_on_planes_to_the_rim(self):
        ground = self.ground(lambda x, y: 3 * x - 2 * y + 1)
        for k in range(200):
            x, y = -2 + 4 * (k * 0.618 % 1), 1 + 1.5 * (k * 0.414 % 1)
            self.assertAlmostEqual(ground.height(x, y), 3 * x - 2 * y + 1, places=12)
            self.assertAlmostEqual(ground.gradient(x, y)[0], 3, places=11)
            self.assertAlmostEqual(ground.gradient(x, y)[1], -2, places=11)

    def test_its_gradient_is_that_of_its_heights(self):
        ground = self.ground(lambda x, y: math.sin(2 * x) * math.cos(y))
        for k in range(200):
            x, y, h = -1.99 + 3.98 * (k * 0.618 % 1), 1.01 + 1.48 * (k * 0.414 % 1), 1e-6
            gx, gy = ground.gradient(x, y)
            self.assertAlmostEqual(gx, (ground.height(x + h, y) - ground.height(x - h, y)) / (2 * h), places=6)
            self.assertAlmostEqual(gy, (ground.height(x, y + h) - ground.height(x, y - h)) / (2 * h), places=6)

    def test_outside_it_is_its_rim(self):
        ground = self.ground(lambda x, y: x + y)
        self.assertAlmostEqual(ground.height(99, 1.5), 2 + 1.5)
        self.assertAlmostEqual(ground.height(-99, -99), -2 + 1)

    def test_its_summit_is_the_highest_inner_knot(self):
        ground = self.ground(lambda x, y: -(x - 0.5) ** 2 - (y - 1.75) ** 2 + (100 if x == 2 else 0))
        self.assertEqual(ground.summit(), (0.5, 1.75, 0.0))


if __name__ == "__main__":
    unittest.main()
