"""woodlouse_play.py and the ways it looks for, without a server: python3 -m unittest test_woodlouse_play"""

import collections
import math
import os
import sys
import types
import unittest

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
import woodlouse
import woodlouse_play
from woodlouse_ways import Ways

PHYSICS = {"gravity": 9.81, "drag": 0.2, "friction": 0.05, "thrust_max": 4, "edge_restitution": 0.5}
Me = collections.namedtuple("Me", "x y vx vy", defaults=(0.0, 0.0))


def ground(height, wraps=False):
    """30 m by 30 m, a knot each metre, around (0, 0)."""
    heights = [[height(i - 15, j - 15) for i in range(31)] for j in range(31)]
    return woodlouse.Ground("a", (-15, -15), (1, 1), heights, wraps)


LEVEL = ground(lambda x, y: 0.0)
# A wall of 3 m, with a gap in the north.
RIDGE = ground(lambda x, y: 3.0 if 2 <= x <= 4 and y < 8 else 0.0)


def game(mode, rules, of=LEVEL, **standing):
    """As much of a Game as a player looks at; respawns counts."""
    made = types.SimpleNamespace(id=2, mode=mode, rules=rules, physics=PHYSICS, tick_hz=60, map=lambda: of, respawns=0,
                                 round=None, players={}, last_ack=None,
                                 seconds_of=lambda moments: moments / 65536 / 60, **standing)

    def respawn():
        made.respawns += 1

    made.respawn = respawn
    return made


def seen(me, tick=0):
    return woodlouse.State(tick, {2: me}, me)


class TheWays(unittest.TestCase):
    def test_level_ground_is_crossed_straight(self):
        ways = Ways(LEVEL, PHYSICS)
        self.assertTrue(ways.carries(Me(-10, -10), (10, 10)))
        self.assertAlmostEqual(ways.cost(-10, 0, (10, 0)), 20, delta=1)
        x, y = ways.on_the_way(Me(-10, 0), (10, 0))
        self.assertGreater(x, -8)
        self.assertAlmostEqual(y, 0, delta=1)

    def test_a_steep_ridge_is_gone_round_but_not_by_who_is_fast(self):
        ways = Ways(RIDGE, PHYSICS)
        self.assertFalse(ways.carries(Me(-2, 0), (10, 0)))
        self.assertTrue(ways.carries(Me(-2, 0, 15.0, 0.0), (10, 0)))
        at, highest = Me(-2, 0), -math.inf
        for _ in range(30):
            at = Me(*ways.on_the_way(at, (10, 0)))
            highest = max(highest, at.y)
        self.assertEqual((at.x, at.y), (10, 0))
        self.assertGreater(highest, 7)

    def test_the_way_leads_over_a_seam_where_that_is_shorter(self):
        ways = Ways(ground(lambda x, y: 0.0, wraps=True), PHYSICS)
        self.assertAlmostEqual(ways.cost(-13, 0, (13, 0)), 4, delta=1)


class Playing(unittest.TestCase):
    GATES = [{"a": [0, 4], "b": [0, -4], "air": False}, {"a": [10, 4], "b": [10, -4], "air": False}]

    def test_roaming_and_modes_to_come_are_not_played(self):
        for mode in ("roam", "chess"):
            self.assertFalse(woodlouse_play.plays(game(mode, {})))
        for mode in ("race", "forage", "hill"):
            self.assertTrue(woodlouse_play.plays(game(mode, {})))

    def test_a_racer_drives_through_from_the_right_hand_side(self):
        player = woodlouse_play.player_of(game("race", {"gates": self.GATES}, gate=0))
        x, y = player.push(seen(Me(-5, 0)))
        self.assertGreater(x, 0.5)
        self.assertAlmostEqual(y, 0, delta=0.1)
        self.assertIsNone(player.push(seen(Me(-4.9, 0, 0.2), 3)), "it has decided just now")
        x, _ = player.push(seen(Me(3, 0), 12))
        self.assertLess(x, -0.5, "it is past the line: back")
        x, _ = player.push(seen(Me(-3, 0), 24))
        self.assertGreater(x, 0.5)

    def test_a_racer_that_does_not_get_on_begins_again(self):
        played = game("race", {"gates": self.GATES}, gate=0)
        player = woodlouse_play.player_of(played)
        for tick in range(0, 9 * 60, 3):
            player.push(seen(Me(-5, 0, 0.6, 0), tick))
        self.assertEqual(played.respawns, 0)
        for tick in range(9 * 60, 15 * 60, 3):
            player.push(seen(Me(-5, 0, 0.6, 0), tick))
        self.assertEqual(played.respawns, 1)

    def test_a_forager_goes_for_worth_and_nearness(self):
        played = game("forage", {})
        player = woodlouse_play.player_of(played)
        played.round = woodlouse.Round("play", crumbs={0: woodlouse.Crumb(-4, 0, 1), 1: woodlouse.Crumb(5, 0, 3)})
        self.assertGreater(player.push(seen(Me(0, 0)))[0], 0.5)
        played.round = woodlouse.Round("play", crumbs={0: woodlouse.Crumb(-4, 0, 1)})
        self.assertLess(player.push(seen(Me(0, 0), 3))[0], -0.5)
        played.round = woodlouse.Round("play")
        self.assertEqual(player.push(seen(Me(0, 0), 6)), (0.0, 0.0))

    def test_a_holder_goes_to_the_place_that_counts_and_ahead_of_others(self):
        played = game("hill", {"places": [{"at": [5, 0], "radius": 3}, {"at": [-5, 0], "radius": 3}]})
        player = woodlouse_play.player_of(played)
        played.round = woodlouse.Round("play", place=0, holder=2, contested=False, moves_at=100)
        self.assertGreater(player.push(seen(Me(0, 0)))[0], 0.5)
        played.round = woodlouse.Round("play", place=0, holder=9, contested=False, moves_at=100)
        self.assertLess(player.push(seen(Me(0, 0)))[0], -0.5)
        played.round = woodlouse.Round("play", place=1, holder=9, contested=False, moves_at=0)
        self.assertLess(player.push(seen(Me(0, 0)))[0], -0.5)

    def test_who_is_kept_off_its_place_takes_a_run_up(self):
        played = game("hill", {"places": [{"at": [5, 0], "radius": 3}]})
        player = woodlouse_play.player_of(played)
        played.round = woodlouse.Round("play", place=0, holder=9, contested=True, moves_at=0)
        pushes = [player.push(seen(Me(3.4, 0), tick))[0] for tick in range(0, 120, 3)]
        self.assertGreater(pushes[0], 0.5)
        self.assertLess(pushes[-1], -0.5)

    def test_a_holder_charges_who_is_on_the_place_as_well_and_backs_off_between(self):
        played = game("hill", {"places": [{"at": [0, 0], "radius": 3}]})
        player = woodlouse_play.player_of(played)
        played.round = woodlouse.Round("play", place=0, holder=0, contested=True, moves_at=0)
        me, other = Me(0, 0), Me(-2, 0)
        pushes = [player.push(woodlouse.State(tick, {2: me, 9: other}, me))[0] for tick in range(0, 180, 3)]
        self.assertLess(pushes[0], -0.5)
        self.assertGreater(pushes[-1], 0.5)

    def test_no_push_is_longer_than_one(self):
        played = game("hill", {"places": [{"at": [10, 3], "radius": 3}]}, of=RIDGE)
        played.round = woodlouse.Round("play", place=0, holder=0, contested=False, moves_at=0)
        player = woodlouse_play.player_of(played)
        for tick in range(0, 600, 3):
            me = Me(12 * math.sin(tick), 12 * math.cos(2.3 * tick), 9 * math.sin(3 * tick), 9 * math.cos(5 * tick))
            self.assertLessEqual(math.hypot(*player.push(seen(me, tick))), 1 + 1e-9)

    def test_what_happened_is_told(self):
        played = game("race", {"gates": self.GATES})
        lap = {"kind": "lap", "id": 2, "lap": 0, "time": 65536 * 90, "best": 1}
        self.assertEqual(woodlouse_play.told(played, lap), "lap in 1.500 s")
        self.assertIsNone(woodlouse_play.told(played, dict(lap, id=3)))
        self.assertIsNone(woodlouse_play.told(played, {"kind": "comet", "id": 2}))
        podium = {"kind": "round", "id": 0, "round": 1, "phase": "podium", "table": [[2, 65536 * 60], [3, 0]]}
        self.assertEqual(woodlouse_play.told(played, podium), "round 1 ends: 2 1.000 s, 3 none")


if __name__ == "__main__":
    unittest.main()
