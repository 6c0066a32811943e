"""The client comes back when its connection breaks: into its louse, or it says that it can't."""

import json
import os
import re
import signal
import socket
import subprocess
import sys
import time
import unittest

from terminal import BIN, InATerminal, LOOK, Server, wait_for

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "support"))
from breakable_line import BreakableLine

LOST = r"connection lost: coming back \.\.\. \d+"


def resume(address, token):
    """Takes over the louse of a token."""
    host, port = address.rsplit(":", 1)
    connection = socket.create_connection((host, int(port)))
    join = {"type": "join", "protocol": 1, "name": "elsewhere", "resume": token}
    connection.sendall(json.dumps(join).encode() + b"\n")
    return connection


class ComingBack(InATerminal):
    def line(self, *options):
        server = Server(options=("--ping-s", "1", "--vacant-s", "1", *options))
        self.addCleanup(server.stop)
        line = BreakableLine(server.address)
        self.addCleanup(line.stop)
        return line

    def join(self, line, arguments="--name mara"):
        self.terminal.run(f"{BIN}/woodlouse {LOOK} {line.address} {arguments}")
        self.terminal.shows(r"PLAYERS \d \(2 bots\)")

    def drives(self):
        way = self.way()
        self.terminal.keys("Space")
        wait_for("a louse that drives", lambda: self.way() is not None and self.way() > way + 1)

    def test_a_line_that_is_cut_for_a_while_keeps_the_picture_and_the_louse(self):
        line = self.line()
        self.join(line)
        self.drives()
        way = self.way()
        line.cut()
        self.terminal.shows(LOST)
        self.terminal.shows(r"connection reset")
        self.assertIsNotNone(self.own_cell(), "the picture stays")
        line.mend()
        self.terminal.shows(r"back in your louse")
        wait_for("the line", lambda: not re.search(LOST, self.terminal.screen()))
        wait_for("the way it had come", lambda: self.way() is not None and self.way() >= way)
        self.terminal.shows(r"1 @ you|2 @ you|3 @ you")
        self.assertNotIn("cruise", self.line_of("push"), "a push does not come back")
        self.drives()
        self.assertEqual(len(set(line.tokens)), 1)

    def test_a_line_that_falls_silent_is_given_up_for_a_new_one(self):
        line = self.line("--resume-s", "20")
        self.join(line)
        line.hush()
        self.terminal.shows(r"back in your louse")
        self.drives()

    def test_a_louse_that_is_gone_is_a_new_one_and_that_is_said(self):
        line = self.line("--resume-s", "1")
        self.join(line)
        line.cut()
        self.terminal.shows(LOST)
        time.sleep(2.0)
        line.mend()
        self.terminal.shows(r"your louse is gone: this is a new one")
        self.terminal.shows(r"PLAYERS 3 \(2 bots\)")
        self.drives()

    def test_q_and_escape_leave_unasked_while_it_tries(self):
        line = self.line()
        for key in ("q", "Escape"):
            line.mend()
            self.join(line)
            line.cut()
            self.terminal.shows(LOST)
            self.terminal.keys(key)
            self.assertEqual(self.exit_code(), 0)
            self.terminal.run("clear")

    def test_who_came_back_elsewhere_is_told_so_and_ends(self):
        line = self.line()
        self.join(line)
        wait_for("a token", lambda: line.tokens)
        with resume(line.address, line.tokens[0]):
            self.terminal.shows(r"you came back over another connection")
            self.assertEqual(self.exit_code(), 69)

    def test_a_watcher_watches_again(self):
        line = self.line()
        self.terminal.run(f"{BIN}/woodlouse {LOOK} {line.address} --watch")
        self.terminal.shows(r"PLAYERS 2 \(2 bots\)")
        line.cut()
        self.terminal.shows(LOST)
        line.mend()
        self.terminal.shows(r"watching again")

    def test_as_text_it_is_read_out(self):
        line = self.line()
        self.terminal.run(f"{BIN}/woodlouse {line.address} --glyphs text --name mara")
        self.terminal.shows(r"you: [\d.]+ m (east|west)")
        line.reset()
        self.terminal.shows(r"connection lost: .+; coming back")
        self.terminal.shows(r"back in your louse")
        line.cut()
        self.terminal.shows(r"connection lost: .+; coming back[^$]+connection lost: .+; coming back")
        self.terminal.keys("q")
        self.assertEqual(self.exit_code(), 0)

    def test_who_was_stopped_for_too_long_is_told_that_its_louse_is_gone(self):
        line = self.line("--resume-s", "1")
        client = subprocess.Popen([f"{BIN}/woodlouse", line.address, "--glyphs", "text", "--name", "mara"],
                                  stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, text=True)
        self.addCleanup(client.stdout.close)
        self.addCleanup(client.wait, 10)
        self.addCleanup(client.kill)
        said = iter(client.stdout)
        self.assertTrue(any("you: " in text for text in said))
        client.send_signal(signal.SIGSTOP)
        time.sleep(4.0)
        client.send_signal(signal.SIGCONT)
        self.assertRegex(next(text for text in said if "coming back" in text),
                         r"^connection lost: nothing came from you for 2 s; coming back")
        self.assertTrue(any(text == "your louse is gone: this is a new one\n" for text in said))

    def test_a_join_that_comes_too_fast_is_made_again(self):
        line = self.line("--join-per-s-address", "1")
        host, port = line.address.rsplit(":", 1)
        refused = None
        while refused is None:
            with socket.create_connection((host, int(port))) as crowd, crowd.makefile("rb") as lines:
                crowd.sendall(b'{"type":"join","protocol":1,"name":"crowd","role":"bot"}\n')
                lines.readline()
                refused = b"rate_limited" in lines.readline() or None
        self.terminal.run(f"{BIN}/woodlouse {LOOK} {line.address} --name mara")
        self.terminal.shows(r"YOU -")
        self.terminal.shows(r"@ you")


if __name__ == "__main__":
    unittest.main(verbosity=2)
