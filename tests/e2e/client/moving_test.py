"""The client goes where its room goes: to where it is sent, or to the hosts that were named when the line is lost."""

import os
import re
import subprocess
import sys
import unittest

from terminal import BIN, InATerminal, LOOK, Server, wait_for

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "support"))
from moving_line import MovingLine


def is_at(line):
    return r"room \S+ is at " + re.escape(line.address) + " now"


class Moving(InATerminal):
    def lines(self, count):
        """To one server, which keeps a louse whichever way its player comes."""
        server = Server(options=("--ping-s", "1", "--vacant-s", "1"))
        self.addCleanup(server.stop)
        lines = [MovingLine(server.address) for _ in range(count)]
        for line in lines:
            self.addCleanup(line.stop)
        return lines

    def join(self, line, arguments="--name mara"):
        self.terminal.run(f"{BIN}/woodlouse {LOOK} {line.address} {arguments}")
        self.terminal.shows(r"PLAYERS \d \(2 bots\)")

    def drives(self):
        way = self.way()
        self.terminal.keys("Space")
        wait_for("a louse that drives", lambda: self.way() is not None and self.way() > way + 1)

    def test_a_player_goes_on_in_his_louse_where_the_room_goes_and_on_from_there(self):
        first, second, third = self.lines(3)
        self.join(first)
        self.drives()
        way = self.way()
        first.move(second.address)
        self.terminal.shows(is_at(second))
        self.terminal.shows(r"PLAYERS 3 \(2 bots\)")
        wait_for("the way it had come", lambda: self.way() is not None and self.way() >= way)
        self.drives()
        second.move(third.address)
        self.terminal.shows(is_at(third))
        self.drives()
        self.assertEqual(len(set(first.tokens + second.tokens + third.tokens)), 1)

    def test_who_joins_at_the_old_place_is_sent_on_twice(self):
        first, second, third = self.lines(3)
        first.sends_on, second.sends_on = second.address, third.address
        self.join(first)
        self.terminal.shows(is_at(third))
        self.drives()
        self.assertEqual([join["name"] for join in first.joins + second.joins], ["mara", "mara"])

    def test_who_is_sent_on_a_third_time_is_told_so(self):
        first, second, third, fourth = self.lines(4)
        first.sends_on, second.sends_on, third.sends_on = second.address, third.address, fourth.address
        self.terminal.run(f"{BIN}/woodlouse {first.address} --name mara")
        self.terminal.shows(re.escape(third.address) + r" does not let you in: sent on from server to server")
        self.assertEqual(self.exit_code(), 69)
        self.assertEqual((len(third.joins), fourth.tokens), (1, []))

    def test_what_is_no_address_is_told_and_the_room_is_looked_for_where_it_was(self):
        [line] = self.lines(1)
        client = subprocess.Popen([f"{BIN}/woodlouse", line.address, "--glyphs", "text", "--name", "mara"],
                                  stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, text=True)
        self.addCleanup(client.stdout.close)
        self.addCleanup(client.wait, 10)
        self.addCleanup(client.kill)
        said = iter(client.stdout)
        self.assertTrue(any("you: " in text for text in said))
        line.move("unix:/tmp/socket")
        self.assertEqual(next(text for text in said if "coming back" in text),
                         'connection lost: the room has moved to "unix:/tmp/socket", which is no HOST:PORT; coming back\n')
        self.assertTrue(any(text == "back in your louse\n" for text in said))

    def test_as_text_it_is_read_out_where_the_room_is(self):
        first, second = self.lines(2)
        self.terminal.run(f"{BIN}/woodlouse {first.address} --glyphs text --name mara")
        self.terminal.shows(r"you: [\d.]+ m (east|west)")
        first.move(second.address)
        self.terminal.shows(is_at(second) + "; back in your louse")
        self.assertNotIn("connection lost", self.terminal.screen(), "it was not")
        self.terminal.keys("q", "y")
        self.assertEqual(self.exit_code(), 0)

    def test_a_watcher_goes_on_watching(self):
        first, second = self.lines(2)
        self.terminal.run(f"{BIN}/woodlouse {LOOK} {first.address} --watch")
        self.terminal.shows(r"state ok \d+")
        first.move(second.address)
        self.terminal.shows(is_at(second))
        self.terminal.shows(r"state ok \d+")

    def test_who_loses_the_line_looks_for_his_louse_at_the_hosts_that_were_named(self):
        first, second, third = self.lines(3)
        second.stop()
        first.hosts = [second.address, third.address]
        self.join(first)
        self.drives()
        first.stop()
        self.terminal.shows(is_at(third))
        self.drives()
        self.assertEqual(len(set(first.tokens + third.tokens)), 1)


if __name__ == "__main__":
    unittest.main(verbosity=2)
