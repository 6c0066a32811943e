#!/usr/bin/env python3
"""The terminal client in a real terminal (tmux), against a real server. Standard library only.

Usage: test_client.py BIN_FOLDER [unittest arguments]; BIN_FOLDER holds woodlouse and woodlouse-server.
"""

import fcntl
import os
import pty
import re
import select
import shutil
import signal
import socket
import struct
import subprocess
import sys
import tempfile
import termios
import time
import unittest

BIN = ""
MAPS = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "maps")
LOOK = "--color mono --glyphs ascii --view map"
PATIENCE = 15.0  # seconds for anything to appear; the machine may be busy


def wait_for(what, predicate, patience=PATIENCE):
    """The first true value of predicate(), which is asked again and again."""
    end = time.monotonic() + patience
    while True:
        value = predicate()
        if value:
            return value
        if time.monotonic() > end:
            raise AssertionError(f"waited {patience} s in vain for {what}")
        time.sleep(0.03)


def children_of(pid):
    """Its children's names (the kernel's 15 characters) by pid."""
    children = {}
    for entry in os.listdir("/proc"):
        if not entry.isdigit():
            continue
        try:
            with open(f"/proc/{entry}/stat") as stat:
                name, rest = stat.read().split("(", 1)[1].rsplit(")", 1)
        except (FileNotFoundError, ProcessLookupError):
            continue  # ended while we looked
        if int(rest.split()[1]) == pid:
            children[int(entry)] = name
    return children


def alive(pid):
    try:
        with open(f"/proc/{pid}/stat") as stat:
            return stat.read().rsplit(")", 1)[1].split()[0] != "Z"
    except (FileNotFoundError, ProcessLookupError):
        return False


class Terminal:
    """A shell in a tmux of its own."""

    def __init__(self, columns=80, rows=24):
        self.folder = tempfile.mkdtemp(prefix="woodlouse-e2e-")
        self.socket = os.path.join(self.folder, "tmux")
        environment = {k: v for k, v in os.environ.items()
                       if not k.startswith(("WOODLOUSE_", "TMUX", "XDG_CONFIG")) and k != "NO_COLOR"}
        environment.update(TERM="xterm-256color", HOME=self.folder, PS1="$ ", LC_ALL="C.UTF-8")
        subprocess.run(["tmux", "-S", self.socket, "-f", "/dev/null", "new-session", "-d", "-x", str(columns),
                        "-y", str(rows), "sh"], env=environment, check=True, cwd=self.folder)
        self.shell = int(self.tmux("display", "-p", "#{pane_pid}"))

    def close(self):
        subprocess.run(["tmux", "-S", self.socket, "kill-server"], stderr=subprocess.DEVNULL)
        shutil.rmtree(self.folder, ignore_errors=True)

    def tmux(self, *arguments):
        return subprocess.run(["tmux", "-S", self.socket, *arguments], check=True, capture_output=True,
                              text=True).stdout.rstrip("\n")

    def keys(self, *keys):
        self.tmux("send-keys", *keys)

    def type(self, text):
        self.tmux("send-keys", "-l", text)

    def run(self, command):
        self.type(command)
        self.keys("Enter")

    def screen(self):
        return self.tmux("capture-pane", "-p")

    def shows(self, pattern, patience=PATIENCE):
        regex = re.compile(pattern)
        try:
            return wait_for(pattern, lambda: regex.search(self.screen()), patience)
        except AssertionError as error:
            raise AssertionError(f"{error}; the screen:\n{self.screen()}") from None

    def resize(self, columns, rows):
        self.tmux("resize-window", "-x", str(columns), "-y", str(rows))

    def state(self):
        """Alternate screen and cursor, as tmux sees them: '0 1' is a shell's."""
        return self.tmux("display", "-p", "#{alternate_on} #{cursor_flag}")

    def stty(self):
        """Every setting of the terminal, asked from inside it."""
        answer = os.path.join(self.folder, f"stty-{time.monotonic_ns()}")
        self.run(f"stty -a > {answer}.part; mv {answer}.part {answer}")
        wait_for("stty", lambda: os.path.exists(answer))
        with open(answer) as file:
            return re.sub(r"rows \d+; columns \d+", "", file.read())

    def process(self, name):
        """The pid of the shell's child of that name, or 0."""
        return next((pid for pid, comm in children_of(self.shell).items() if comm == name), 0)


class InATerminal(unittest.TestCase):
    def setUp(self):
        self.terminal = Terminal()
        self.addCleanup(self.terminal.close)

    def start(self, arguments="--name mara"):
        """Starts the client with a server of its own; waits until it plays. Returns (client, server) pids.
        The Space that ends the introduction is nothing to the game."""
        self.before = self.terminal.stty()
        self.terminal.run(f"{BIN}/woodlouse {LOOK} {arguments}")
        self.terminal.shows(r"Any key starts")
        self.terminal.keys("Space")
        self.terminal.shows("(YOU|ROOM) [-\N{BOX DRAWINGS LIGHT HORIZONTAL}]")
        wait_for("the alternate screen", lambda: self.terminal.state().startswith("1"))
        client = wait_for("the client", lambda: self.terminal.process("woodlouse"))
        server = next(pid for pid, comm in children_of(client).items() if comm.startswith("woodlouse-serve"))
        return client, server

    def play(self):
        pids = self.start()
        self.terminal.shows(r"@")
        self.assertNotIn("cruise", self.line_of("push"))
        return pids

    def line_of(self, label):
        """The panel's line that begins with a label."""
        found = re.search(rf"\|\s+{label}\b.*", self.terminal.screen())
        return found.group(0) if found else ""

    def way(self):
        """How far the own louse has travelled, in metres, as the panel shows it."""
        found = re.search(r"way\s+([\d.]+) m", self.terminal.screen())
        return float(found.group(1)) if found else None

    def own_cell(self):
        """Column and row of the '@' on the map."""
        for row, line in enumerate(self.terminal.screen().splitlines()[1:22], 1):
            column = line[:46].find("@")
            if column >= 0:
                return column, row
        return None

    def assert_given_back(self, server):
        wait_for("the shell's screen", lambda: self.terminal.state() == "0 1")
        self.assertEqual(self.terminal.stty(), self.before)
        wait_for("the end of the local server", lambda: not alive(server))

    def exit_code(self):
        wait_for("the end of the client", lambda: not self.terminal.process("woodlouse"))
        self.terminal.run("echo code=$?.")
        return int(self.terminal.shows(r"code=(\d+)\.").group(1))


class Playing(InATerminal):
    def test_the_hill_and_moving_lice_appear_within_five_seconds_of_the_command(self):
        begin = time.monotonic()
        self.terminal.run(f"{BIN}/woodlouse {LOOK} --name mara")
        self.terminal.shows(r"PLAYERS 4 \(3 bots\)")
        self.assertLess(time.monotonic() - begin, 5.0)
        self.terminal.shows(r"WOODLOUSE\s+volcano")
        hill = "".join(line[:46] for line in self.terminal.screen().splitlines()[1:22])
        self.assertGreater(sum(hill.count(glyph) for glyph in "-_/|\\"), 100, "contour lines of the hill")
        first = self.terminal.screen()
        ways = re.findall(r"\*\s+(\d+) m", first)
        self.assertEqual(len(ways), 3, first)
        wait_for("bots on the move", lambda: re.findall(r"\*\s+(\d+) m", self.terminal.screen()) != ways)

    def test_cruise_drives_the_louse_across_the_screen_and_a_second_space_ends_it(self):
        self.play()
        at, way = self.own_cell(), self.way()
        self.terminal.keys("Space")
        self.terminal.shows(r"push\s.*cruise")
        wait_for("the louse elsewhere", lambda: self.own_cell() not in (None, at))
        wait_for("metres of way", lambda: self.way() > way + 2)
        self.terminal.keys("Space")
        wait_for("the end of cruise", lambda: "cruise" not in self.line_of("push"))

    def test_w_pushes_for_a_moment_and_s_brakes(self):
        self.play()
        self.terminal.keys("w")
        self.terminal.shows(r"push\s+\+")
        wait_for("the end of the pulse", lambda: not re.search(r"push\s+\+", self.terminal.screen()))
        self.terminal.keys("Up")
        self.terminal.shows(r"push\s+\+")
        self.terminal.keys("s")
        self.terminal.shows(r"push\s+-")

    def test_a_and_d_turn_the_heading(self):
        self.play()

        def heading():
            cell = self.own_cell()
            if cell is None:
                return None
            lines = self.terminal.screen().splitlines()
            around = {}
            for dx in (-1, 0, 1):
                for dy in (-1, 0, 1):
                    row, column = cell[1] + dy, cell[0] + dx
                    if (dx or dy) and 1 <= row < 22 and column >= 0 and column < len(lines[row][:46]):
                        around[dx, dy] = lines[row][column]
            marks = {(1, 0): ">", (-1, 0): "<", (0, -1): "^", (0, 1): "v",
                     (1, -1): "/", (-1, 1): "/", (1, 1): "\\", (-1, -1): "\\"}
            return frozenset(place for place, glyph in around.items() if glyph == marks[place])

        seen = [wait_for("a heading", heading)]
        for key in ("a", "a", "a", "a"):
            self.terminal.keys(key)
            time.sleep(0.15)
            seen.append(heading())
        self.assertGreater(len(set(seen)), 1, f"four times A turns by 90 degrees: {seen}")

    def test_help_scoreboard_and_views_come_and_go(self):
        self.play()
        self.terminal.type("?")
        self.terminal.shows(r"HELP")
        self.terminal.keys("x")
        wait_for("no help", lambda: "HELP" not in self.terminal.screen())
        self.terminal.keys("Tab")
        self.terminal.shows(r"SCORES")
        self.terminal.keys("Tab")
        wait_for("no scoreboard", lambda: "SCORES" not in self.terminal.screen())
        for _ in range(4):
            before = self.terminal.screen()
            self.terminal.keys("v")
            wait_for("another picture", lambda: self.terminal.screen() != before)

    def test_chat_takes_what_is_typed_wasd_and_umlauts_included_and_escape_cancels(self):
        self.play()
        way = self.way()
        self.terminal.keys("t")
        self.terminal.type("wwww sad käfer q")
        self.terminal.shows(r"sad")
        self.terminal.keys("Enter")
        self.terminal.shows(r"mara.*wwww sad")
        self.assertEqual(self.terminal.state()[0], "1", "q in the chat does not leave")
        self.terminal.keys("t")
        self.terminal.type("unsaid")
        self.terminal.shows(r"unsaid")
        self.terminal.keys("Escape")
        wait_for("no entry line", lambda: "unsaid" not in self.terminal.screen())
        self.assertLess(self.way() - way, 8.0, "the w of the chat did not push")

    def test_a_terminal_too_small_says_so_and_comes_back(self):
        self.play()
        self.terminal.resize(52, 14)
        self.terminal.shows(r"60 ?x ?20")
        self.terminal.resize(80, 24)
        self.terminal.shows(r"YOU -")
        self.terminal.resize(132, 40)
        wait_for("the wider panel", lambda: max(map(len, self.terminal.screen().splitlines())) > 100)
        self.terminal.resize(60, 20)
        self.terminal.shows(r"WOODLOUSE")

    def test_watching_needs_no_louse(self):
        self.start("--watch")
        self.terminal.shows(r"PLAYERS 3 \(3 bots\)|3 bots")
        self.assertIsNone(self.own_cell())
        self.terminal.keys("v", "n", "w")
        self.terminal.keys("q", "y")
        wait_for("the shell's screen", lambda: self.terminal.state() == "0 1")

    def test_colour_and_half_blocks_draw_too(self):
        global LOOK
        before, LOOK = LOOK, "--color 256 --glyphs half"
        try:
            self.start()
            wait_for("half blocks", lambda: "\N{LOWER HALF BLOCK}" in self.terminal.screen())
        finally:
            LOOK = before


    def test_the_introduction_takes_a_question_mark_for_help_and_q_for_leaving(self):
        self.terminal.run(f"{BIN}/woodlouse {LOOK}")
        self.terminal.shows(r"Any key starts")
        self.terminal.type("?")
        self.terminal.shows(r"HELP")
        self.terminal.keys("C-c")
        wait_for("the shell's screen", lambda: self.terminal.state() == "0 1")
        self.terminal.run("clear")
        wait_for("an empty screen", lambda: "Any key starts" not in self.terminal.screen())
        self.terminal.run(f"{BIN}/woodlouse {LOOK}")
        self.terminal.shows(r"Any key starts")
        self.terminal.keys("q")
        self.assertEqual(self.exit_code(), 0)

    def test_r_begins_again_at_a_spawn_point(self):
        self.play()
        self.terminal.keys("Space")
        wait_for("a louse on its way", lambda: self.way() > 3)
        self.terminal.keys("r")
        self.terminal.shows(r"mara starts again")
        self.terminal.shows(r"speed\s+[01]\.\d+ m/s")
        self.assertNotIn("cruise", self.line_of("push"))
        way = self.way()
        self.terminal.keys("Space")
        wait_for("a louse that can be driven on", lambda: self.way() > way + 1)


class GivingTheTerminalBack(InATerminal):
    def test_q_asks_and_leaves_everything_as_it_was(self):
        _, server = self.play()
        self.terminal.keys("q")
        self.terminal.shows(r"LEAVE")
        self.terminal.keys("Escape")
        wait_for("no question", lambda: "LEAVE" not in self.terminal.screen())
        self.terminal.keys("q")
        self.terminal.shows(r"LEAVE")
        self.terminal.keys("y")
        wait_for("the shell's screen", lambda: self.terminal.state() == "0 1")
        self.assertEqual(self.exit_code(), 0)
        self.assert_given_back(server)

    def test_ctrl_c_leaves_at_once_with_130(self):
        _, server = self.play()
        self.terminal.keys("C-c")
        wait_for("the shell's screen", lambda: self.terminal.state() == "0 1")
        self.assertEqual(self.exit_code(), 130)
        self.assert_given_back(server)

    def test_ctrl_z_and_fg(self):
        client, server = self.play()
        self.terminal.keys("C-z")
        wait_for("the shell's screen", lambda: self.terminal.state() == "0 1")
        self.assertEqual(self.terminal.stty(), self.before)
        time.sleep(0.5)
        self.terminal.run("fg")
        wait_for("the game's screen", lambda: self.terminal.state().startswith("1"))
        self.terminal.shows(r"YOU -")
        way = self.way()
        self.terminal.keys("Space")
        wait_for("a louse that drives", lambda: self.way() is not None and self.way() != way)
        self.terminal.keys("q", "y")
        self.assert_given_back(server)
        self.assertFalse(alive(client))

    def test_sigstop_and_continue_redraw_the_game(self):
        client, server = self.play()
        os.kill(client, signal.SIGSTOP)
        wait_for("the shell", lambda: re.search(r"topped", self.terminal.screen()))
        self.terminal.keys("f", "g", "C-j")  # the shell has our raw terminal: Enter is no line's end there
        wait_for("no word of the shell's", lambda: "topped" not in self.terminal.screen())
        self.terminal.shows(r"YOU -")
        self.terminal.keys("q", "y")
        self.assert_given_back(server)


def add_signal_tests():
    for name in ("INT", "TERM", "HUP", "QUIT", "SEGV", "ABRT", "BUS", "ILL", "FPE"):
        def test(self, name=name):
            client, server = self.play()
            os.kill(client, getattr(signal, "SIG" + name))
            wait_for("the end of the client", lambda: not alive(client))
            self.assert_given_back(server)
        setattr(GivingTheTerminalBack, f"test_sig{name.lower()}_gives_the_terminal_back", test)


add_signal_tests()


class KilledWithoutAWord(InATerminal):
    def test_the_end_of_the_local_server_is_told_with_69(self):
        _, server = self.play()
        os.kill(server, signal.SIGKILL)
        self.terminal.shows(r"the server started here has ended")
        self.assertEqual(self.exit_code(), 69)
        self.assert_given_back(server)

    def test_sigkill_leaves_no_server_behind(self):
        client, server = self.play()
        os.kill(client, signal.SIGKILL)
        wait_for("the end of the local server", lambda: not alive(server))


class Server:
    """A woodlouse-server of the test's own."""

    def __init__(self, port=0):
        self.process = subprocess.Popen(
            [f"{BIN}/woodlouse-server", "--map", f"{MAPS}/volcano.json", "--listen", f"127.0.0.1:{port}", "--bots", "2"],
            stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
        self.address = self.process.stdout.readline().split()[1]

    def stop(self):
        self.process.terminate()
        self.process.wait(timeout=10)
        self.process.stdout.close()


class OverTheWire(InATerminal):
    def test_a_lost_connection_counts_down_and_comes_back(self):
        server = Server()
        self.terminal.run(f"{BIN}/woodlouse {LOOK} {server.address} --name mara")
        self.terminal.shows(r"PLAYERS 3")
        server.stop()
        self.terminal.shows(r"(?i)lost")
        again = Server(int(server.address.rsplit(":", 1)[1]))
        self.addCleanup(again.stop)
        self.terminal.shows(r"PLAYERS 3")
        wait_for("the game again", lambda: not re.search(r"(?i)connection lost", self.terminal.screen()))
        way = self.way()
        self.terminal.keys("Space")
        wait_for("a louse that drives", lambda: self.way() is not None and self.way() != way)
        self.terminal.keys("q", "y")
        wait_for("the shell's screen", lambda: self.terminal.state() == "0 1")

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
        self.terminal.run(f"{BIN}/woodlouse 127.0.0.1:{port}")
        self.terminal.shows(r"cannot connect to 127.0.0.1:\d+: connection refused\s+is the server up\?")
        self.assertEqual(self.exit_code(), 69)
        self.assertEqual(self.terminal.state(), "0 1")


    def test_the_game_as_text_is_played_with_the_same_keys(self):
        before = self.terminal.stty()
        server = Server()
        self.addCleanup(server.stop)
        self.terminal.run(f"{BIN}/woodlouse {server.address} --glyphs text --name mara")
        self.terminal.shows(r"keys: W push")
        self.terminal.shows(r"number \d, you: [\d.]+ m (east|west)")
        self.terminal.keys("a")
        self.terminal.shows(r"heading \w+")
        self.terminal.keys("Space")
        self.terminal.shows(r"cruise on")
        self.terminal.keys("Tab")
        self.terminal.shows(r"number \d, Rolly")
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
            os.execv(f"{BIN}/woodlouse", ["woodlouse", self.server.address, *LOOK.split()])
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
        self.await_bytes(rb"\x1b\[\?u\x1b\[c")
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
        self.await_bytes(rb"\x1b\[<u.*\x1b\[\?1049l")
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
        self.assertTrue(any(re.match(r"number 1, .*: [\d.]+ m (east|west), [\d.]+ m (north|south)", line) for line in lines))
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
    BIN = os.path.abspath(sys.argv.pop(1))
    if shutil.which("tmux") is None:
        sys.exit("test_client.py: tmux is missing; packages.txt lists it")
    unittest.main(verbosity=2)
