"""The bots over a line to a real server that is cut in the middle of the game.

Needs the programs: WOODLOUSE_BIN=build/release/bin python3 -m unittest test_coming_back
"""

import contextlib
import io
import os
import sys
import threading
import time
import unittest

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
import woodlouse
from running import ROOT, Running, program, serve

sys.path.insert(0, os.path.join(ROOT, "tests", "support"))
from breakable_line import BreakableLine
from moving_line import MovingLine


class ComingBack(unittest.TestCase):
    def line(self):
        line = BreakableLine(serve(self, "volcano", "--ping-s", "1", "--vacant-s", "1"))
        self.addCleanup(line.stop)
        return line

    def test_a_python_bot_drives_on_in_its_louse(self):
        line = self.line()
        with contextlib.redirect_stderr(io.StringIO()) as told:
            with woodlouse.connect(line.address, name="ann", fields=["x", "y", "distance"]) as game:
                louse, ground = game.id, game.map()
                way_at_the_cut = None
                for state in game.states():
                    if not state.me:
                        continue
                    if game.comebacks == 0 and state.me.distance > 1 and way_at_the_cut is None:
                        way_at_the_cut = state.me.distance
                        line.cut()
                        threading.Timer(1.5, line.mend).start()
                    game.thrust((0.5, 0.5))
                    if game.comebacks and game.last_ack["seq"] == 3:
                        break
                self.assertEqual((game.comebacks, game.id, game.players[louse]), (1, louse, "ann"))
                self.assertTrue(game.welcome["resumed"])
                self.assertGreaterEqual(state.me.distance, way_at_the_cut)
                self.assertIs(game.map(), ground)
        self.assertRegex(told.getvalue(), r"^woodlouse: connection: .*: coming back\nwoodlouse: back in louse %d\n$" % louse)

    def test_a_bot_that_thinks_for_long_finds_its_louse_where_it_was_left(self):
        """Who sends no pong meanwhile is vacant after a second; what it sends then counts again."""
        line = self.line()
        with woodlouse.connect(line.address, name="ann") as game:
            states = game.states()
            begun = next(states).tick
            while next(states).tick < begun + 100:
                pass  # it answers a ping, and so is expected to answer the next
            time.sleep(2.5)
            seq = game.thrust(0.5)
            end = time.monotonic() + 20
            while not game.last_ack or game.last_ack["seq"] != seq:
                state = next(states)
                self.assertLess(time.monotonic(), end, (seq, game.last_ack, game.comebacks, begun, state.tick))
            self.assertFalse(game.last_ack["dropped"])
            self.assertEqual(game.comebacks, 0)

    def test_the_chaser_chases_on_in_its_louse(self):
        line = self.line()
        with Running(program("woodlouse-chaser"), line.address) as chaser:
            louse = chaser.wait_for(r"^louse (\d+) in room").group(1)
            line.cut()
            chaser.wait_for(r"connection: .*; coming back")
            time.sleep(1.2)
            line.mend()
            self.assertEqual(chaser.wait_for(r"^back in louse (\d+) in room").group(1), louse)
            chaser.interrupt()

    def test_the_chaser_waits_where_too_many_join(self):
        address = serve(self, "volcano", "--join-per-s-address", "1")
        with contextlib.redirect_stderr(io.StringIO()):
            for _ in range(8):  # what is saved up
                woodlouse.connect(address, name="crowd").close()
        begun = time.monotonic()
        with Running(program("woodlouse-chaser"), address) as chaser:
            chaser.wait_for(r"^louse \d+ in room")
            self.assertGreater(time.monotonic() - begun, 0.5)
            with woodlouse.connect(address, name="late") as game:
                self.assertIn("Chaser", game.players.values())


class Moving(unittest.TestCase):
    """The chaser goes where its room goes. The Python module does so in test_woodlouse_moving."""

    def lines(self, count):
        server = serve(self, "volcano", "--ping-s", "1", "--vacant-s", "1")
        lines = [MovingLine(server) for _ in range(count)]
        for line in lines:
            self.addCleanup(line.stop)
        return lines

    def test_the_chaser_goes_on_in_its_louse_where_the_room_goes(self):
        first, second = self.lines(2)
        with Running(program("woodlouse-chaser"), first.address) as chaser:
            louse = chaser.wait_for(r"^louse (\d+) in room volcano$").group(1)
            first.move(second.address)
            chaser.wait_for(r"moved: the room has moved; coming back$")
            chaser.wait_for(r"^back in louse %s in room volcano, which is at %s now$" % (louse, second.address))
            chaser.interrupt()

    def test_a_python_bot_does_too(self):
        first, second = self.lines(2)
        with contextlib.redirect_stderr(io.StringIO()) as told, woodlouse.connect(first.address, name="ann") as game:
            louse, states = game.id, game.states()
            next(states)
            first.move(second.address)
            while not game.comebacks:
                next(states)
            self.assertEqual((game.id, game.welcome["resumed"], game.address), (louse, True, second.address))
        self.assertIn("back in louse %d; room volcano is at %s now\n" % (louse, second.address), told.getvalue())

    def test_the_chaser_is_sent_on_twice_and_no_more(self):
        first, second, third, fourth = self.lines(4)
        first.sends_on, second.sends_on = second.address, third.address
        with Running(program("woodlouse-chaser"), first.address) as chaser:
            chaser.wait_for(r"^louse \d+ in room volcano, which is at %s now$" % third.address)
            chaser.interrupt()
        third.sends_on = fourth.address
        with Running(program("woodlouse-chaser"), first.address) as chaser:
            chaser.wait_for("moved: sent on from server to server, to %s last$" % fourth.address)
            self.assertEqual(chaser.result(), 1)
        self.assertEqual(fourth.tokens, [])

    def test_the_chaser_goes_to_no_place_that_is_none(self):
        [line] = self.lines(1)
        with Running(program("woodlouse-chaser"), line.address) as chaser:
            louse = chaser.wait_for(r"^louse (\d+) in room").group(1)
            line.move("/tmp/socket")
            chaser.wait_for('moved: the room has moved to "/tmp/socket", which is no HOST:PORT; coming back$')
            chaser.wait_for("^back in louse %s in room volcano$" % louse)
            chaser.interrupt()

    def test_the_chaser_looks_for_its_louse_at_the_hosts_that_were_named(self):
        first, second, third = self.lines(3)
        second.stop()
        first.hosts = [second.address, third.address]
        with Running(program("woodlouse-chaser"), first.address) as chaser:
            louse = chaser.wait_for(r"^louse (\d+) in room").group(1)
            first.stop()
            chaser.wait_for("^back in louse %s in room volcano, which is at %s now$" % (louse, third.address))
            chaser.interrupt()


if __name__ == "__main__":
    unittest.main()
