"""However the client ends, the terminal is the user's again and no server is left."""

import os
import re
import signal
import time
import unittest

from terminal import InATerminal, alive, wait_for


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

    def test_in_the_background_it_waits_and_leaves_the_terminal_to_the_shell(self):
        _, server = self.play()
        self.terminal.keys("C-z")
        wait_for("the shell's screen", lambda: self.terminal.state() == "0 1")
        self.terminal.run("bg; sleep 0.3; echo shell=$?.")
        self.terminal.shows(r"shell=0\.")
        self.assertEqual(self.terminal.state(), "0 1")
        self.terminal.run("fg")
        self.terminal.shows(r"YOU -")
        self.terminal.keys("q", "q")
        self.assert_given_back(server)

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
    # Each signal there is ends the guard in tests/client/terminal; here a few end the whole program.
    for name in ("INT", "HUP", "SEGV", "USR1"):
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


if __name__ == "__main__":
    unittest.main(verbosity=2)
