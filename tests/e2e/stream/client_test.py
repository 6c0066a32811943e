"""The terminal client watches by inputs, proves what it shows, and says where what comes parts from what it re-ran."""

import os
import re
import socket
import subprocess
import sys
import threading
import unittest

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(HERE, "..", "client"))

from terminal import BIN, LOOK, InATerminal, Server  # noqa: E402


class Between:
    """Stands between clients and a server, and alters lines of the server's: alter(line) gives what goes on."""

    def __init__(self, server, alter):
        self._server, self._alter = server, alter
        self._listener = socket.create_server(("127.0.0.1", 0))
        self.address = "127.0.0.1:%d" % self._listener.getsockname()[1]
        self._sockets = []
        self.joins = []  # the lines that clients joined with
        threading.Thread(target=self._serve, daemon=True).start()

    def stop(self):
        for end in [self._listener, *self._sockets]:
            try:
                end.shutdown(socket.SHUT_RDWR)
            except OSError:
                pass  # it has ended already
            end.close()

    def _serve(self):
        while True:
            try:
                client, _ = self._listener.accept()
                host, port = self._server.rsplit(":", 1)
                server = socket.create_connection((host, int(port)))
            except OSError:
                return
            self._sockets += [client, server]
            threading.Thread(target=self._carry, args=(client.makefile("rb"), server, self._heard), daemon=True).start()
            threading.Thread(target=self._carry, args=(server.makefile("rb"), client, self._alter), daemon=True).start()

    @staticmethod
    def _carry(lines, to, altered):
        try:
            for line in lines:
                to.sendall(altered(line))
            to.shutdown(socket.SHUT_WR)
        except OSError:
            pass  # an end has gone

    def _heard(self, line):
        if line.startswith(b'{"type":"join"'):
            self.joins.append(line.decode())
        return line


class Altered:
    """One input of a step some seconds on is another one."""

    def __init__(self):
        self.steps = 0
        self.step = None

    def __call__(self, line):
        if not line.startswith(b'{"step":'):
            return line
        self.steps += 1
        if self.step is not None or self.steps < 100 or b'"inputs":[[' not in line:
            return line
        self.step = int(re.match(rb'{"step":(\d+)', line).group(1))
        return re.sub(rb'("inputs":\[\[\d+,)(\d+)', lambda m: m.group(1) + b"%d" % (int(m.group(2)) + 1), line)


class Watching(InATerminal):
    def server(self):
        server = Server()
        self.addCleanup(server.stop)
        return server

    def between(self, alter):
        between = Between(self.server().address, alter)
        self.addCleanup(between.stop)
        return between

    def watch(self, address):
        self.terminal.run(f"{BIN}/woodlouse {LOOK} {address} --watch")

    def quit(self):
        self.terminal.keys("q", "y")
        return self.exit_code()

    def test_each_tick_of_an_honest_server_is_proven_from_its_inputs(self):
        between = self.between(lambda line: line)
        self.watch(between.address)
        self.terminal.shows(r"watching  state ok [1-9]\d\d\b")
        self.terminal.shows(r"PLAYERS 2")
        self.assertEqual(self.quit(), 0)
        self.assertIn('"stream":"inputs"', between.joins[0])

    def test_an_altered_line_is_told_with_its_tick_and_the_room_is_shown_by_frames_from_then_on(self):
        alter = Altered()
        between = self.between(alter)
        self.watch(between.address)
        self.terminal.shows(r"state DIFFERS at tick \d+")
        self.terminal.shows(r"watching by frames now")
        self.terminal.shows(r"PLAYERS 2")
        self.assertRegex(self.terminal.screen(), r"state DIFFERS at tick %d\b" % (alter.step + 1))
        self.assertEqual(self.quit(), 1)
        self.terminal.shows(r"woodlouse: state DIFFERS at tick %d: hash [0-9a-f]{16} recorded" % (alter.step + 1))
        self.assertEqual(['"stream":"inputs"' in join for join in between.joins], [True, False])

    def test_as_text_ticks_are_counted_and_a_difference_is_a_line(self):
        alter = Altered()
        between = self.between(alter)
        client = subprocess.Popen([f"{BIN}/woodlouse", between.address, "--watch", "--glyphs", "text"],
                                  stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.addCleanup(client.kill)
        lines = []
        for line in client.stdout:
            lines.append(line.rstrip("\n"))
            if len(between.joins) == 2 and line.rstrip().endswith("number 2"):
                break
        said = "\n".join(lines)
        self.assertRegex(said, r"(?m)^state DIFFERS at tick \d+: .*")
        client.kill()
        client.communicate(timeout=20)

    def test_a_server_that_cannot_or_moves_lice_otherwise_is_watched_by_frames(self):
        for alter in (lambda line: line.replace(b',"inputs"]', b"]", 1) if b'"hello"' in line else line,
                      lambda line: re.sub(rb'"behavior":\d+', b'"behavior":9999', line) if b'"hello"' in line else line):
            between = self.between(alter)
            self.watch(between.address)
            self.terminal.shows(r"PLAYERS 2")
            self.assertNotIn("state ok", self.terminal.screen())
            self.assertEqual(self.quit(), 0)
            self.assertNotIn('"stream"', between.joins[0])
            self.terminal.run("clear")


if __name__ == "__main__":
    unittest.main()
