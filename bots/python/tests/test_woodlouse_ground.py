"""The ground between its knots: python3 -m unittest test_woodlouse_ground"""

import math
import os
import sys
import unittest

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
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

    def test_where_the_edges_wrap_it_goes_on_over_the_seam(self):
        def wave(x, y):
            return math.sin(math.pi * x / 2) + math.cos(math.pi * (y - 1) / 0.75)

        heights = [[wave(-2 + 0.25 * i, 1 + 0.125 * j) for i in range(17)] for j in range(13)]
        ground = woodlouse.Ground("g", [-2, 1], [0.25, 0.125], heights, wraps=True)
        for k in range(100):
            x, y = -2 + 4 * (k * 0.618 % 1), 1 + 1.5 * (k * 0.414 % 1)
            self.assertAlmostEqual(ground.height(x + 8, y - 3), ground.height(x, y), places=12)
        for y in (1.3, 2.2):  # on the seam: as smooth as anywhere
            self.assertAlmostEqual(ground.gradient(2, y)[0], -math.pi / 2, delta=0.05)
            self.assertAlmostEqual(ground.gradient(-2 - 1e-9, y)[0], ground.gradient(-2 + 1e-9, y)[0], places=6)
            self.assertAlmostEqual(ground.height(2 - 1e-9, y), ground.height(2 + 1e-9, y), places=6)

    def test_the_way_is_straight_or_where_the_edges_wrap_the_shortest(self):
        for wraps, way in ((False, (3.5, -0.2)), (True, (-0.5, -0.2))):
            ground = woodlouse.Ground("g", [-2, 1], [1, 0.5], [[0] * 5] * 4, wraps)
            for there, back in zip(ground.way(-1.75, 1.5, 1.75, 1.3), ground.way(1.75, 1.3, -1.75, 1.5)):
                self.assertAlmostEqual(there, -back)
            self.assertAlmostEqual(ground.way(-1.75, 1.5, 1.75, 1.3)[0], way[0])
            self.assertAlmostEqual(ground.way(-1.75, 1.5, 1.75, 1.3)[1], way[1])


class TheSummit(unittest.TestCase):
    def of(self, heights, wraps=False):
        return woodlouse.Ground("g", [10, 20], [1, 2], heights, wraps).summit()

    def test_it_is_the_highest_of_the_summits(self):
        self.assertEqual(self.of([[0, 0, 0, 0, 0, 0], [0, 3, 0, 0, 5, 0], [0, 0, 0, 0, 0, 0]]), (14, 22, 5))

    def test_a_knot_of_a_slope_is_none_though_it_be_the_highest_inside(self):
        self.assertEqual(self.of([[9, 9, 9, 9, 9], [0, 7, 6, 6, 6], [0, 6, 6, 2, 6], [0, 6, 6, 6, 6], [9, 9, 9, 9, 0]]),
                         None)
        self.assertEqual(self.of([[9, 9, 9, 9, 9, 9, 9], [9, 8, 7, 7, 7, 8, 9], [9, 8, 0, 0, 0, 8, 9],
                                  [9, 8, 0, 1, 0, 8, 9], [9, 8, 0, 0, 0, 8, 9], [9, 9, 9, 9, 9, 9, 9]]), (13, 26, 1))

    def test_a_knot_on_the_rim_is_none(self):
        self.assertIsNone(self.of([[0, 0, 0, 0], [9, 8, 0, 0], [0, 0, 0, 0]]))

    def test_knots_of_one_height_are_a_summit_together_if_all_around_is_lower(self):
        self.assertEqual(self.of([[0] * 5, [0, 4, 4, 0, 0], [0] * 5])[2], 4)
        self.assertEqual(self.of([[0] * 5, [0, 4, 4, 5, 9], [0] * 5]), None)
        self.assertEqual(self.of([[0] * 5, [0, 4, 4, 4, 4], [0] * 5]), None)

    def test_a_bowl_and_level_ground_have_none_but_a_highest_knot(self):
        bowl = [[(i - 3) ** 2 + (j - 2) ** 2 for i in range(5)] for j in range(5)]
        self.assertIsNone(self.of(bowl))
        self.assertEqual(woodlouse.Ground("g", [10, 20], [1, 2], bowl).highest()[2], 13)
        for wraps in (False, True):
            self.assertIsNone(self.of([[1] * 5] * 5, wraps))

    def test_where_the_edges_wrap_it_may_lie_on_the_seam(self):
        heights = [[5, 0, 1, 0, 5], [0, 0, 0, 0, 0], [0, 0, 0, 0, 0], [5, 0, 1, 0, 5]]
        self.assertIsNone(self.of(heights))
        self.assertEqual(self.of(heights, wraps=True), (10, 20, 5))
        # Higher ground beyond the seam: a slope.
        self.assertEqual(self.of([[0, 0, 0, 0, 0], [6, 0, 3, 5, 6], [0, 0, 0, 0, 0], [0, 0, 0, 0, 0]], wraps=True),
                         (10, 22, 6))


if __name__ == "__main__":
    unittest.main()
