"""The game in a terminal: keys, screens, views."""

import fcntl
import os
import pty
import re
import signal
import struct
import termios
import time
import unittest

from terminal import BIN, InATerminal, LOOK, Server, wait_for


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

    def test_at_first_the_keys_push_that_way_in_the_picture_and_c_changes_it(self):
        self.start(look="--color mono --glyphs ascii --view map")
        self.terminal.shows(r"WASD push")
        self.terminal.keys("d")
        self.terminal.shows(r"@>")
        self.terminal.keys("a")
        self.terminal.shows(r"<@")
        self.terminal.keys("c")
        self.terminal.shows(r"W push S brake A/D turn")

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
        self.start(look="--color 256 --glyphs half")
        wait_for("half blocks", lambda: "\N{LOWER HALF BLOCK}" in self.terminal.screen())


    def test_the_introduction_takes_a_question_mark_for_help_and_q_for_leaving(self):
        self.terminal.run(f"{BIN}/woodlouse {LOOK} --name mara")
        self.terminal.shows(r"Any key starts")
        self.terminal.type("?")
        self.terminal.shows(r"HELP")
        self.terminal.keys("C-c")
        wait_for("the shell's screen", lambda: self.terminal.state() == "0 1")
        self.terminal.run("clear")
        wait_for("an empty screen", lambda: "Any key starts" not in self.terminal.screen())
        self.terminal.run(f"{BIN}/woodlouse {LOOK} --name mara")
        self.terminal.shows(r"Any key starts")
        self.terminal.keys("q")
        self.assertEqual(self.exit_code(), 0)

    def test_a_space_that_comes_after_the_introduction_has_gone_by_itself_does_not_cruise_at_once(self):
        self.terminal.run(f"{BIN}/woodlouse {LOOK} --name mara")
        self.terminal.shows(r"Any key starts")
        self.terminal.shows(r"YOU -")
        self.terminal.keys("Space")
        self.terminal.shows(r"you play already")
        self.assertNotIn("cruise", self.line_of("push"))
        self.terminal.keys("Space")
        self.terminal.shows(r"push\s.*cruise")

    def test_a_terminal_that_answers_nothing_has_its_first_picture_half_a_second_later(self):
        server = Server()
        self.addCleanup(server.stop)
        pid, master = pty.fork()
        if pid == 0:
            os.execve(f"{BIN}/woodlouse", ["woodlouse", server.address, "--name", "mara", "--view", "map"],
                      {"TERM": "xterm-256color", "HOME": self.terminal.folder})
        self.addCleanup(os.close, master)
        self.addCleanup(os.waitpid, pid, 0)
        self.addCleanup(os.kill, pid, signal.SIGKILL)
        fcntl.ioctl(master, termios.TIOCSWINSZ, struct.pack("HHHH", 24, 80, 0, 0))

        def reads(text):
            written = b""
            while text not in written:
                written += os.read(master, 4096)
            return time.monotonic()
        asked = reads(b"\x1b[c")
        self.assertLess(reads(b"\x1b[?1049h") - asked, 0.85)  # 0.5 s, and what a busy machine adds

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

    def test_a_first_game_begins_with_a_lesson_that_escape_ends_for_good(self):
        data = os.path.join(self.terminal.folder, ".local/share/woodlouse")
        os.remove(os.path.join(data, "lesson"))
        self.play()
        self.terminal.shows(r"1/3 PUSH")
        self.terminal.keys("Space")
        self.terminal.shows(r"2/3 TURN")
        self.terminal.keys("Escape")
        wait_for("the end of the lesson", lambda: "TURN" not in self.terminal.screen())
        self.assertEqual(os.listdir(data), ["lesson"])

    def test_a_race_shows_its_gates_its_clock_and_the_way_to_the_next_one(self):
        self.terminal.run(f"{BIN}/woodlouse {LOOK} --name mara --map crater_loop --room crater_loop/race")
        self.terminal.shows(r"Any key starts")
        self.terminal.keys("Space")
        self.terminal.shows(r"lap 1/3 starts at S")
        screen = self.terminal.shows(r"gate S: NE \d+ m").string
        self.assertRegex(screen, r"\[S\]")
        self.assertRegex(screen, r"\(3\)")
        self.terminal.keys("Space")  # it faces the gate, wherever it rolls
        self.terminal.shows(r"lap 1/3 (run )?0:0\d\.\d\d\d")
        self.terminal.shows(r"gate 1: \w+ \d+ m")


if __name__ == "__main__":
    unittest.main(verbosity=2)
