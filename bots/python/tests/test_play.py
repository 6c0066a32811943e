"""The example bots, the C++ bot, the shell bot and the load tool against a real server.

Needs the programs: WOODLOUSE_BIN=build/release/bin python3 -m unittest test_play
"""

import math
import os
import shutil
import sys
import time
import unittest

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
import woodlouse
from running import PATIENCE_S, ROOT, Running, Witness, example, program, readme_bot, serve


# A small bowl with some friction: who rolls in it lies still soon.
POT = {"name": "small_pot", "terrain": {"function": "parabolic_pot", "grid": 10, "scale": 10},
       "physics": {"friction": 0.1}}


class OfTheModule:
    """Owns what runs beside all tests (serve's and Witness's owner)."""

    addCleanup = staticmethod(unittest.addModuleCleanup)


def setUpModule():
    """The two that take a quarter of a minute begin first; who judges them comes last."""
    global witness
    address = serve(OfTheModule(), POT)
    witness = Witness(OfTheModule(), address, ["x", "y", "z", "vx", "vy"])
    for name in ("downhill_roller", "orbiter"):
        unittest.addModuleCleanup(example(name, address).__exit__)


class TheModule(unittest.TestCase):
    def test_the_keys_of_moving_lice_have_the_hashes_of_their_rows(self):
        address = serve(self, "volcano")
        with woodlouse.connect(address, name="proof", verify=True) as game:
            for state in game.states():
                if state.me and not game.last_ack:
                    game.thrust((0.5, -0.25))
                if game.verified >= 3:
                    break
            self.assertGreater(state.me.distance, 0.0)


class ThePrograms(unittest.TestCase):
    def test_an_example_says_plainly_that_nobody_listens(self):
        with example("orbiter", "127.0.0.1:1") as orbiter:
            orbiter.wait_for(r"connection: no server at 127.0.0.1:1")
            self.assertEqual(orbiter.result(), 1)

    def test_the_bot_in_readme_ends_at_ctrl_c_without_a_word(self):
        address = serve(self, "volcano")
        with readme_bot(address) as bot, woodlouse.connect(address, role="spectator") as game:
            next(state for state in game.states() if "uphill" in game.players.values())
            bot.interrupt()
            self.assertEqual(bot.result(), 130)
        self.assertEqual(bot.lines, [])

    def test_the_chaser_comes_near_the_louse_it_chases(self):
        address = serve(self, "parabolic_pot")
        with woodlouse.connect(address, name="hare") as hare, Running(program("woodlouse-chaser"), address) as chaser:
            it = int(chaser.wait_for(r"^louse (\d+) in room").group(1))
            deadline = time.monotonic() + PATIENCE_S
            for state in hare.states():
                self.assertLess(time.monotonic(), deadline, "it never came")
                row = state.lice.get(it)
                if state.me and row and (row.x - state.me.x) ** 2 + (row.y - state.me.y) ** 2 < 1.0:
                    break

    @unittest.skipUnless(shutil.which("nc"), "needs nc")
    def test_the_shell_bot_joins_pushes_and_sees_rows(self):
        host, port = serve(self, "volcano").split(":")
        with Running("sh", os.path.join(ROOT, "bots", "shell", "push.sh"), host, port, "1") as push:
            push.wait_for(r'^\{"type":"welcome"')
            push.wait_for(r'^\{"type":"ack","seq":1,.*"dropped":false')
            push.wait_for(r'^\{"type":"(key|delta)".*"louse":\[\[\d+,-?\d+')
            push.wait_for(r'^\{"type":"bye","code":"left"')

    def test_the_swarm_gets_its_ticks_and_its_acks(self):
        with Running(program("woodlouse-swarm"), "--bots", "20", "--seconds", "2", serve(self, "volcano")) as swarm:
            self.assertEqual(swarm.result(), 0, "\n".join(swarm.lines))
            swarm.wait_for(r"lost +0 not joined, 0 disconnected")
            self.assertGreater(float(swarm.wait_for(r"distinct ticks/s per bot +min +([\d.]+)").group(1)), 10.0)
            self.assertGreater(int(swarm.wait_for(r"(\d+) inputs sent").group(1)), 50)

    def test_the_swarm_says_plainly_that_nobody_listens(self):
        with Running(program("woodlouse-swarm"), "--bots", "2", "127.0.0.1:1") as swarm:
            self.assertEqual(swarm.result(), 69)
            swarm.wait_for(r"no bot could join: connect: Connection refused")


class WhatTheExamplesDo(unittest.TestCase):
    """What their names say, as a witness sees it. (The climber: test_climbing.py.)"""

    def test_the_roller_rolls_down_and_from_each_kick_back_down(self):
        def rests(rows):
            """The heights at which it lay still for most of a second, having been above 1 m before: friction holds it
            where the slope is under 0.1, in this bowl below 0.05 m; a little higher it creeps."""
            heights, high, still_since = [], False, None
            for tick, row in rows:
                high = high or row.z > 1.0
                if math.hypot(row.vx, row.vy) > 0.05:
                    still_since = None
                elif still_since is None:
                    still_since = tick
                if high and still_since is not None and tick - still_since > 0.8 * witness.tick_hz:
                    heights, high = heights + [row.z], False
            return heights

        rows = witness.see("Rolly", lambda rows: len(rests(rows)) == 2, seconds=180)
        self.assertLess(max(rests(rows)), 0.1)
        self.assertGreater(max(math.hypot(row.vx, row.vy) for _, row in rows), 3.5, "from 1.8 m, 5.9 m/s at most")

    def test_the_orbiter_goes_round_the_middle_at_one_distance(self):
        def turns(rows):
            angles = [math.atan2(row.y, row.x) for _, row in rows]
            return sum(math.remainder(b - a, 2 * math.pi) for a, b in zip(angles, angles[1:])) / (2 * math.pi)

        rows = witness.see("Saturn", lambda rows: turns(rows) > 2, seconds=90)
        once = next(i for i in range(0, len(rows), 10) if turns(rows[:i + 1]) > 1)
        for tick, row in rows[once:]:  # the first round is for finding to the orbit, a fifth of the side
            self.assertAlmostEqual(math.hypot(row.x, row.y), 4.0, delta=1.0, msg="tick %d" % tick)


if __name__ == "__main__":
    unittest.main()
