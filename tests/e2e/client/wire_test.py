"""The client and a server that is not its own; other terminals, and none."""

import fcntl
import json
import os
import pty
import re
import select
import signal
import socket
import struct
import subprocess
import termios
import time
import unittest

from terminal import BIN, InATerminal, LOOK, PATIENCE, Server, Terminal, wait_for


class OverTheWire(InATerminal):
    def test_a_server_that_is_killed_and_started_again_is_found_again(self):
        server = Server()
        self.terminal.run(f"{BIN}/woodlouse {LOOK} {server.address} --name mara")
        self.terminal.shows(r"PLAYERS 3")
        server.stop(signal.SIGKILL)
        self.terminal.shows(r"connection lost: coming back")
        again = Server(int(server.address.rsplit(":", 1)[1]))
        self.addCleanup(again.stop)
        self.terminal.shows(r"your louse is gone: this is a new one")
        self.terminal.shows(r"PLAYERS 3")
        wait_for("the game again", lambda: not re.search(r"(?i)connection lost", self.terminal.screen()))
        way = self.way()
        self.terminal.keys("Space")
        wait_for("a louse that drives", lambda: self.way() is not None and self.way() != way)
        self.terminal.keys("q", "y")
        wait_for("the shell's screen", lambda: self.terminal.state() == "0 1")

    def test_a_server_that_stops_is_told_with_69_and_not_waited_for(self):
        server = Server()
        self.terminal.run(f"{BIN}/woodlouse {LOOK} {server.address}/volcano --name mara")
        self.terminal.shows(r"PLAYERS 3")
        server.stop()
        self.terminal.shows(r"the server stops\s+when it is up again:  woodlouse 127[.:\d]+/volcano")
        self.assertEqual(self.exit_code(), 69)

    def test_two_clients_see_each_other_and_chat(self):
        server = Server()
        self.addCleanup(server.stop)
        other = Terminal()
        self.addCleanup(other.close)
        self.terminal.run(f"{BIN}/woodlouse {LOOK} {server.address} --name ada")
        other.run(f"{BIN}/woodlouse {LOOK} {server.address} --name lin")
        self.terminal.shows(r"\d \w lin")
        other.shows(r"\d \w ada")
        self.terminal.keys("t")
        self.terminal.type("hello hill")
        self.terminal.keys("Enter")
        other.shows(r"ada.*hello hill")

    def test_nobody_there_is_69_with_a_hint_and_the_screen_untouched(self):
        with socket.socket() as probe:
            probe.bind(("127.0.0.1", 0))
            port = probe.getsockname()[1]
        self.terminal.run(f"{BIN}/woodlouse 127.0.0.1:{port} --name mara")
        self.terminal.shows(r"cannot connect to 127.0.0.1:\d+: connection refused\s+is the server up\?")
        self.assertEqual(self.exit_code(), 69)
        self.assertEqual(self.terminal.state(), "0 1")

    def test_a_server_that_refuses_is_not_said_to_be_down(self):
        server = Server()
        self.addCleanup(server.stop)
        self.terminal.run(f"{BIN}/woodlouse --name mara {server.address}/nope")
        self.terminal.shows(r'127.0.0.1:\d+ does not let you in: no room "nope"; there are: vol')
        self.terminal.shows(r"name one of them:  woodlouse 127.0.0.1:\d+/ROOM")
        self.assertEqual(self.exit_code(), 69)
        self.assertNotIn("is the server up", self.terminal.screen())

    def test_the_louse_of_who_leaves_is_gone_at_once_by_ctrl_c_too(self):
        server = Server()
        self.addCleanup(server.stop)
        other = Terminal()
        self.addCleanup(other.close)
        other.run(f"{BIN}/woodlouse {LOOK} {server.address} --watch")
        for ending in ("q q", "C-c"):
            self.terminal.run(f"{BIN}/woodlouse {LOOK} {server.address} --name mara")
            other.shows(r"\d \w mara")
            self.terminal.keys(*ending.split())
            wait_for("a room without mara", lambda: not re.search(r"\d \w mara", other.screen()), 5)

    def test_the_name_is_asked_for_once_and_kept(self):
        server = Server()
        self.addCleanup(server.stop)
        self.terminal.run(f"{BIN}/woodlouse {LOOK} {server.address}")
        self.terminal.shows(r"What is your louse called\? \[\w+\]")
        self.terminal.run("a name of more than twenty-four bytes")
        self.terminal.shows(r"At most 24 bytes")
        self.terminal.run("ida lou")
        self.terminal.shows(r"@ you|@ ida lou")
        self.terminal.keys("q", "q")
        self.assertEqual(self.exit_code(), 0)
        with open(os.path.join(self.terminal.folder, ".config", "woodlouse", "config.json")) as file:
            self.assertEqual(json.load(file), {"name": "ida lou"})
        self.terminal.run("clear")
        self.terminal.run(f"{BIN}/woodlouse {LOOK} {server.address}")
        self.terminal.shows(r"YOU -")

    def test_the_game_as_text_is_played_with_the_same_keys(self):
        before = self.terminal.stty()
        server = Server()
        self.addCleanup(server.stop)
        self.terminal.run(f"{BIN}/woodlouse {server.address} --glyphs text --name mara --steer heading")
        self.terminal.shows(r"keys: W push")
        self.terminal.shows(r"you: [\d.]+ m (east|west)")
        self.terminal.keys("a")
        self.terminal.shows(r"heading \w+")
        self.terminal.keys("Space")
        self.terminal.shows(r"cruise on")
        self.terminal.keys("Tab")
        self.terminal.shows(r"Rolly: [\d.]+ m")
        self.terminal.keys("t")
        self.terminal.type("hello q")
        self.terminal.keys("Enter")
        self.terminal.shows(r"mara says: hello q")
        self.terminal.keys("q", "y")
        self.assertEqual(self.exit_code(), 0)
        self.assertEqual(self.terminal.stty(), before)


class SpeakingTheKittyProtocol(unittest.TestCase):
    """A terminal of the test's own, which answers the client's question and sends key releases."""

    def setUp(self):
        self.server = Server()
        self.addCleanup(self.server.stop)
        self.pid, self.terminal = pty.fork()
        if self.pid == 0:
            os.environ.update(TERM="xterm-256color", LC_ALL="C.UTF-8")
            os.execv(f"{BIN}/woodlouse", ["woodlouse", self.server.address, "--name", "mara", *LOOK.split()])
        self.addCleanup(os.close, self.terminal)
        fcntl.ioctl(self.terminal, termios.TIOCSWINSZ, struct.pack("HHHH", 24, 80, 0, 0))
        self.said = b""

    def await_bytes(self, pattern, patience=PATIENCE):
        """Reads until the pattern comes; what is before it is forgotten."""
        regex = re.compile(pattern)
        end = time.monotonic() + patience
        while not (found := regex.search(self.said)):
            self.assertLess(time.monotonic(), end, f"no {pattern} in {self.said[-2000:]}")
            if select.select([self.terminal], [], [], 0.1)[0]:
                try:
                    self.said += os.read(self.terminal, 65536)
                except OSError:
                    self.fail(f"the client ended without {pattern}: {self.said[-2000:]}")
        self.said = self.said[found.end():]
        return found

    def test_releases_end_a_push_and_the_flags_are_popped_at_the_end(self):
        self.await_bytes(rb"(?s)\x1b\[\?u.*\x1b\[c")
        os.write(self.terminal, b"\x1b[?0u\x1b[?62c")
        self.await_bytes(rb"\x1b\[>31u")
        self.await_bytes(rb"YOU")
        self.await_bytes(rb"@")                          # there is a louse to drive
        time.sleep(0.5)
        press, release = b"\x1b[119;1:1;119u", b"\x1b[119;1:3u"
        os.write(self.terminal, press)
        self.await_bytes(rb"\+\+\+")
        os.write(self.terminal, release)
        self.await_bytes(rb"none", 0.3)                   # sooner than the pulse would have ended
        os.write(self.terminal, press)
        self.await_bytes(rb"\+\+\+")
        time.sleep(1.0)                                  # longer than a pulse: from now on a hold lasts as long as the key
        os.write(self.terminal, b"\x1b[63;2;63u")        # the help tells what is known of the keys
        self.assertNotRegex(self.await_bytes(rb"hold").string, rb"none")
        self.await_bytes(rb"release")
        os.write(self.terminal, b"\x1b[99;5u")
        self.await_bytes(rb"\x1b\[<u.*\x1b\[c")
        os.write(self.terminal, b"\x1b[99;5:3u\x1b[?62c")  # the release of Ctrl-C, before the last answer: nobody's
        self.await_bytes(rb"\x1b\[\?1049l")
        _, status = os.waitpid(self.pid, 0)
        self.assertEqual(os.waitstatus_to_exitcode(status), 130)


class WithoutATerminal(unittest.TestCase):
    def run_client(self, *arguments, **more):
        return subprocess.run([f"{BIN}/woodlouse", *arguments], stdin=subprocess.DEVNULL, capture_output=True, text=True,
                              timeout=20, **more)

    def test_a_pipe_is_refused_with_a_hint(self):
        done = self.run_client()
        self.assertEqual(done.returncode, 2)
        self.assertIn("woodlouse --watch --glyphs text", done.stderr)
        self.assertEqual(done.stdout, "")

    def test_mistakes_are_two_lines_and_2(self):
        done = self.run_client("--fps", "1000")
        self.assertEqual(done.returncode, 2)
        self.assertEqual(len(done.stderr.splitlines()), 2)

    def test_watching_as_text_tells_of_every_louse_and_ends_with_sigterm(self):
        server = Server()
        self.addCleanup(server.stop)
        client = subprocess.Popen([f"{BIN}/woodlouse", server.address, "--watch", "--glyphs", "text"],
                                  stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, text=True)
        lines = []
        while len([line for line in lines if "travelled" in line]) < 6:
            lines.append(client.stdout.readline())
            self.assertNotEqual(lines[-1], "", lines)
        self.assertRegex(lines[0], r"^joined 127\.0\.0\.1:\d+, map volcano$")
        self.assertTrue(any(re.match(r".*: [\d.]+ m (east|west), [\d.]+ m (north|south), .*travelled \d+ m, number 1$", line) for line in lines))
        client.terminate()
        self.assertEqual(client.wait(timeout=5), -signal.SIGTERM)
        client.stdout.close()

    def test_text_whose_reader_is_gone_ends_with_74(self):
        server = Server()
        self.addCleanup(server.stop)
        client = subprocess.Popen([f"{BIN}/woodlouse", server.address, "--watch", "--glyphs", "text"],
                                  stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
        client.stdout.readline()
        client.stdout.close()
        self.assertEqual(client.wait(timeout=10), 74)


if __name__ == "__main__":
    unittest.main(verbosity=2)
