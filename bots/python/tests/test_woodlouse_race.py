"""The tables of woodlouse_course.py and who drives by them, without a server: python3 -m unittest test_woodlouse_race"""

import math
import os
import sys
import types
import unittest

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
import woodlouse
from woodlouse_course import Course, Gate, Moves, Table
from woodlouse_motion import HELD, MAP_VECTOR, Body, Motion
from woodlouse_racer import Racer, Sketch
from woodlouse_surface import surface_of
from test_woodlouse_play import LEVEL, Me, ground, seen

PHYSICS = {"gravity": 9.81, "drag": 0.1, "friction": 0.05, "thrust_max": 4, "edge_restitution": 0.5, "equations": "exact",
           "method": "standard", "contact": "bilateral", "edges": "walls", "central_gravity": 0, "core_radius": 0}
# 5 m high, and steeper than a thrust climbs.
RAMP = ground(lambda x, y: min(5.0, max(0.0, x - 2)))
THROUGH_8 = {"a": [8, 4], "b": [8, -4]}  # eastwards
BACK = {"a": [-8, -4], "b": [-8, 4]}  # westwards


def table(of, *gates, **physics):
    """That of the first of those gates."""
    return Course(surface_of(of), of, dict(PHYSICS, **physics), gates).tables[0]


def alone(of, gate):
    """That of a gate behind which nothing comes."""
    return Table(Moves(surface_of(of), of, PHYSICS), Gate(of, gate["a"], gate["b"], gate.get("air", False)), None)


class TheTable(unittest.TestCase):
    def test_on_level_ground_it_tells_way_by_speed(self):
        times = alone(LEVEL, THROUGH_8)
        self.assertAlmostEqual(times.seconds(-10, 0, 11, 0), 18 / 12.5, delta=0.3)
        self.assertAlmostEqual(times.seconds(-2, 0, 0, 0), math.sqrt(2 * 10 / 3.5), delta=0.6)
        self.assertGreater(times.seconds(-2, 0, -7, 0), times.seconds(-2, 0, 0, 0) + 1)

    def test_a_steep_ramp_wants_a_run_up(self):
        times = alone(RAMP, THROUGH_8)
        at_its_foot, from_afar, at_speed = (times.seconds(x, 0, v, 0) for x, v in ((1, 0), (-11, 0), (1, 11)))
        self.assertLess(at_speed, 2)
        self.assertLess(from_afar, 10)
        self.assertGreater(at_its_foot, from_afar)
        self.assertLess(at_its_foot, 20)

    def test_who_is_past_a_gate_is_not_through_it(self):
        times = alone(LEVEL, THROUGH_8)
        self.assertLess(times.seconds(7.5, 0, 2, 0), 0.8)
        self.assertGreater(times.seconds(8.5, 0, 2, 0), 3)

    def test_what_comes_behind_a_gate_counts(self):
        one, both = alone(LEVEL, THROUGH_8), table(LEVEL, THROUGH_8, BACK)
        self.assertIsNotNone(both.after.after)
        self.assertGreater(both.seconds(-2, 0, 0, 0), one.seconds(-2, 0, 0, 0) + 4)

    def test_a_gate_is_crossed_from_its_right_hand_side_within_its_ends_and_over_seams(self):
        gate = Gate(LEVEL, [8, 4], [8, -4], False)
        self.assertEqual([gate.crossing(7, 0, 9, 0), gate.crossing(9, 0, 7, 0), gate.crossing(6, 0, 7, 0)], [1, -1, 0])
        self.assertEqual(gate.crossing(7, 5, 9, 5), 0)
        seam = Gate(ground(lambda x, y: 0.0, wraps=True), [14.5, 4], [14.5, -4], False)
        self.assertEqual([seam.crossing(14, 0, -14, 0), seam.crossing(14, 0, 16, 0), seam.crossing(-14, 0, 14, 0)],
                         [1, 1, -1])

    def test_a_gate_in_the_air_wants_the_speed_to_take_off(self):
        bump = ground(lambda x, y: 2 * math.exp(-(x / 5) ** 2))
        low, high = (alone(bump, {"a": [2, 4], "b": [2, -4], "air": air}) for air in (False, True))
        self.assertEqual(low.lift, 0)
        self.assertAlmostEqual(high.lift, math.sqrt(9.81 / (4 / 25)), delta=0.5)
        self.assertGreater(high.seconds(-2, 0, 5, 0), low.seconds(-2, 0, 5, 0) + 1)


class TheRacer(unittest.TestCase):
    def game(self, of, gates):
        return types.SimpleNamespace(mode="race", rules={"gates": gates}, physics=PHYSICS, tick_hz=60, map=lambda: of,
                                     gate=0, round=None, last_ack=None, respawn=lambda: self.fail("it got stuck"))

    def laps(self, of, gates, start, seconds):
        """How many gates it drives through."""
        played = self.game(of, gates)
        racer, motion = Racer(played), Motion(surface_of(of), PHYSICS, of.extent, 60)
        shapes = [Gate(of, gate["a"], gate["b"], False) for gate in gates]
        body, passed = Body(0, *start, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, MAP_VECTOR, HELD, 1, 0.0, 0.0), 0
        for tick in range(0, seconds * 60, 3):
            push = racer.push(seen(Me(body.x, body.y, body.vx, body.vy), tick))
            if push:
                self.assertLessEqual(math.hypot(*push), 1 + 1e-9)
                body = body._replace(tx=push[0], ty=push[1])
            before, body = body, motion.after(body, 3)
            if shapes[played.gate].crossing(before.x, before.y, body.x, body.y) == 1:
                passed, played.gate = passed + 1, (played.gate + 1) % len(gates)
        return passed

    def test_it_drives_to_and_fro(self):
        self.assertGreaterEqual(self.laps(LEVEL, [THROUGH_8, BACK], (0, 0), 20), 3)

    def test_it_knows_that_it_will_be_through_when_its_push_begins(self):
        racer = Racer(self.game(LEVEL, [THROUGH_8, dict(THROUGH_8, a=[13, 4], b=[13, -4])]))
        racer.push(seen(Me(6.0, 0.0, 8.0, 0.0)))
        self.assertGreater(racer.push(seen(Me(7.9, 0.0, 8.5, 0.0), 12))[0], 0, "it would turn round for a gate behind it")

    def test_it_begins_again_where_it_gets_nowhere_and_then_has_all_the_time_anew(self):
        played, respawns = self.game(LEVEL, [THROUGH_8]), []
        played.respawn = lambda: respawns.append(1)
        racer = Racer(played)
        begun = next(tick for tick in range(0, 14 * 60, 20) if racer.push(seen(Me(6.0, 0.0), tick)) is None and respawns)
        self.assertGreater(begun, 11 * 60)
        for tick in range(20, 13 * 60, 20):  # from farther away
            racer.push(seen(Me(-14.0 + tick / 120, 0.0, 0.5, 0.0), begun + tick))
        self.assertEqual(len(respawns), 1)

    def test_it_takes_a_run_up(self):
        self.assertGreaterEqual(self.laps(RAMP, [THROUGH_8], (1, 0), 15), 1)


class TheSketch(unittest.TestCase):
    def test_it_moves_lice_as_the_server_does_but_for_decimetres(self):
        hills = ground(lambda x, y: 1.5 * math.sin(0.4 * x) * math.cos(0.3 * y))
        sketch, motion = Sketch(surface_of(hills), hills, PHYSICS), Motion(surface_of(hills), PHYSICS, hills.extent, 60)
        body = Body(0, -6.0, -3.0, 5.0, 2.0, 1.0, 0.0, 0.6, -0.8, MAP_VECTOR, HELD, 0, 0.0, 0.0)
        rough = (body.x, body.y, body.vx, body.vy, None, 0.0)
        for _ in range(10):
            rough = sketch.on(rough, (0.6, -0.8), 0.1)[0]
        exact = motion.after(body, 60)
        self.assertLess(math.hypot(rough[0] - exact.x, rough[1] - exact.y), 0.3)
        self.assertLess(math.hypot(rough[2] - exact.vx, rough[3] - exact.vy), 0.3)

    def test_a_wall_throws_back(self):
        body, bounced = Sketch(surface_of(LEVEL), LEVEL, PHYSICS).on((14.9, 0.0, 6.0, 0.0, None, 0.0), (0.0, 0.0), 0.1)
        self.assertTrue(bounced)
        self.assertEqual(body[0], 15)
        self.assertLess(body[2], -2.5)


if __name__ == "__main__":
    unittest.main()
