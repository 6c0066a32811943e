"""What the client can prove, in a real terminal: keys verified while watching, recordings re-run. Standard library only.
"""

import os
import re
import shutil
import signal
import socket
import struct
import subprocess
import tempfile
import threading
import unittest

from terminal import BIN, LOOK, MAPS, InATerminal, Server, wait_for


class Meddler:
    """Stands between a client and a server, and flips the lowest bit of one x in the fifth key that passes."""

    def __init__(self, server):
        self._server = server
        self._listener = socket.create_server(("127.0.0.1", 0))
        self.address = "127.0.0.1:%d" % self._listener.getsockname()[1]
        self._keys = 0
        self._sockets = []
        self._thread = threading.Thread(target=self._serve, daemon=True)
        self._thread.start()

    def stop(self):
        for end in [self._listener, *self._sockets]:
            try:
                end.shutdown(socket.SHUT_RDWR)
            except OSError:
                pass  # it has ended already
            end.close()
        self._thread.join(10)

    def _serve(self):
        try:
            client, _ = self._listener.accept()
            host, port = self._server.rsplit(":", 1)
            server = socket.create_connection((host, int(port)))
        except OSError:
            return  # stopped before anybody came
        self._sockets += [client, server]
        threading.Thread(target=self._carry, args=(client.makefile("rb"), server), daemon=True).start()
        self._carry(server.makefile("rb"), client, self._altered)

    def _carry(self, lines, to, altered=lambda line: line):
        try:
            for line in lines:
                to.sendall(altered(line))
        except OSError:
            pass  # an end has gone

    def _altered(self, line):
        if not line.startswith(b'{"type":"key"'):
            return line
        self._keys += 1
        return re.sub(rb'(?<="louse":\[\[)(\d+,\d),([^,]+)', self._flip, line) if self._keys == 5 else line

    @staticmethod
    def _flip(match):
        bits, = struct.unpack("<Q", struct.pack("<d", float(match.group(2))))
        x, = struct.unpack("<d", struct.pack("<Q", bits ^ 1))
        return match.group(1) + b"," + repr(x).encode()


class Watching(InATerminal):
    def test_every_key_of_an_honest_server_is_verified(self):
        server = Server()
        self.addCleanup(server.stop)
        self.terminal.run(f"{BIN}/woodlouse {LOOK} {server.address} --watch --verify")
        self.terminal.shows(r"watching  state ok [3-9]\b")
        self.terminal.shows(r"PLAYERS 2")
        self.terminal.keys("q", "y")
        self.assertEqual(self.exit_code(), 0)

    def test_a_bit_flipped_on_the_way_is_told_loudly_and_is_the_exit_code(self):
        server = Server()
        self.addCleanup(server.stop)
        meddler = Meddler(server.address)
        self.addCleanup(meddler.stop)
        self.terminal.run(f"{BIN}/woodlouse {LOOK} {meddler.address} --watch --verify")
        self.terminal.shows(r"state DIFFERS at tick \d+")
        self.terminal.keys("q", "y")
        self.assertEqual(self.exit_code(), 1)
        self.terminal.shows(r"woodlouse: state DIFFERS at tick \d+: the key says [0-9a-f]{16}")

    def watch_as_text(self, address):
        return subprocess.Popen([f"{BIN}/woodlouse", address, "--watch", "--verify", "--glyphs", "text"],
                                stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)

    def test_as_text_the_count_is_a_line_and_a_difference_ends_it_with_1(self):
        server = Server()
        self.addCleanup(server.stop)
        meddler = Meddler(server.address)
        self.addCleanup(meddler.stop)
        out, err = self.watch_as_text(meddler.address).communicate(timeout=30)
        self.assertRegex(out, r"(?m)^state ok, [1-4] keys? verified$")
        self.assertRegex(out, r"(?m)^state DIFFERS at tick \d+: the key says [0-9a-f]{16}, its rows give [0-9a-f]{16}$")
        self.assertRegex(err, r"^woodlouse: state DIFFERS at tick")


class AtTheReplay(InATerminal):
    """Five seconds of two bots, recorded once by a server that ends by itself."""

    TICKS = 300

    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.mkdtemp(prefix="woodlouse-replay-")
        cls.addClassCleanup(shutil.rmtree, cls.folder)
        cls.file = os.path.join(cls.folder, "game.ndjson")
        subprocess.run([f"{BIN}/woodlouse-server", "--map", f"{MAPS}/volcano.json", "--listen",
                        "127.0.0.1:0", "--bots", "2", "--seed", "5", "--ticks", str(cls.TICKS), "--record", cls.file],
                       check=True, timeout=60, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)

    def watch(self, file=None, look=LOOK):
        self.before = self.terminal.stty()
        self.terminal.run(f"{BIN}/woodlouse replay {look} {file or self.file}")
        self.terminal.shows(r"REPLAY  \w+\.ndjson  \d (lice|louse)")
        return wait_for("the client", lambda: self.terminal.process("woodlouse"))

    def seconds(self):
        found = re.search(r"(?m)^ (?:\|>|\|\|)  (\d\d):(\d\d\.\d) \[", self.terminal.screen())
        return int(found.group(1)) * 60 + float(found.group(2)) if found else None

    def shows_seconds(self, seconds):
        wait_for(f"{seconds} s", lambda: self.seconds() == seconds)

    def assert_given_back(self):
        wait_for("the shell's screen", lambda: self.terminal.state() == "0 1")
        self.assertEqual(self.terminal.stty(), self.before)

    def test_it_plays_pauses_jumps_steps_and_proves_every_tick(self):
        self.watch()
        self.terminal.shows(rf"state ok [0-9a-f]{{4}} {self.TICKS}/{self.TICKS}")
        self.terminal.shows(r"(?m)^ \|\|  00:05\.0 \[[+#]+\]  00:05\.0   x1\.0")
        self.terminal.keys("Space")
        self.terminal.shows(r"(?m)^ \|>  00:0[0-4]")
        self.terminal.shows(r"PLAYERS 2 \(2 bots\)")
        self.terminal.keys("Space")
        self.terminal.shows(r"(?m)^ \|\|  ")
        self.terminal.keys("5")
        self.shows_seconds(2.5)
        self.terminal.keys(*["."] * 6)
        self.shows_seconds(2.6)
        self.terminal.keys(*[","] * 12)
        self.shows_seconds(2.4)
        self.terminal.keys("Right")
        self.shows_seconds(5.0)
        self.terminal.keys("<")
        self.shows_seconds(0.0)
        self.terminal.keys("]", "]")
        self.terminal.shows(r"x4\.0")
        self.terminal.keys("n", "f")
        self.terminal.shows(r"- [ab] \w+\*? -")
        self.terminal.keys("?")
        self.terminal.shows(r"x0\.25 to x16")
        self.terminal.keys("x", "q")
        self.assertEqual(self.exit_code(), 0)
        self.assert_given_back()

    def test_it_is_resized_and_too_small_comes_back(self):
        self.watch()
        self.terminal.resize(120, 40)
        wait_for("the time line at the foot",
                 lambda: re.match(r" (\|>|\|\|)  ", "".join(self.terminal.screen().splitlines()[38:39])))
        self.terminal.resize(50, 12)
        self.terminal.shows(r"needs 60 x 20")
        self.terminal.resize(80, 24)
        self.terminal.shows(r"state ok")

    def test_colour_and_half_blocks_have_the_time_line_too(self):
        self.terminal.resize(120, 40)
        self.watch(look="--color truecolor --glyphs half")
        self.terminal.shows("\N{UPPER HALF BLOCK}")
        self.terminal.shows(r"\]  00:05\.0   x1\.0")

    def test_killed_it_gives_the_terminal_back(self):
        for name in ("SIGTERM", "SIGHUP", "SIGSEGV"):
            client = self.watch()
            wait_for("the alternate screen", lambda: self.terminal.state().startswith("1"))
            os.kill(client, getattr(signal, name))
            self.assert_given_back()
            self.terminal.run("clear")

    def test_ctrl_c_leaves_with_130(self):
        self.watch()
        self.terminal.keys("C-c")
        self.assertEqual(self.exit_code(), 130)
        self.assert_given_back()

    def test_an_altered_hash_is_told_with_its_tick_and_is_the_exit_code(self):
        altered = os.path.join(self.folder, "altered.ndjson")
        with open(self.file) as whole, open(altered, "w") as out:
            for line in whole:
                if line.startswith('{"step":200,'):
                    line = re.sub(r'(?<="hash":")(.)', lambda digit: "1" if digit.group(1) == "0" else "0", line)
                out.write(line)
        self.watch(altered)
        self.terminal.shows(r"state DIFFERS at tick 201")
        self.terminal.keys("q")
        self.assertEqual(self.exit_code(), 1)
        self.terminal.shows(r"woodlouse: state DIFFERS at tick 201: [0-9a-f]{16} recorded, [0-9a-f]")

    def test_what_is_no_recording_is_told_before_the_screen_is_touched(self):
        self.terminal.run(f"{BIN}/woodlouse replay {BIN}/nothing")
        self.terminal.shows(r"woodlouse: \S+/nothing: no such file")
        self.assertEqual(self.exit_code(), 74)
        self.terminal.run(f"{BIN}/woodlouse replay {MAPS}/volcano.json")
        self.terminal.shows(r"woodlouse: \S+volcano\.json")
        self.assertEqual(self.exit_code(), 74)

    def test_without_a_terminal_it_says_what_to_run_instead(self):
        done = subprocess.run([f"{BIN}/woodlouse", "replay", self.file], stdin=subprocess.DEVNULL,
                              capture_output=True, text=True, timeout=20)
        self.assertEqual(done.returncode, 2)
        self.assertIn(f"woodlouse-server verify {self.file}", done.stderr)
        self.assertEqual(done.stdout, "")


if __name__ == "__main__":
    unittest.main(verbosity=2)
