"""--no-files: who plays from another's account, through ssh, makes the client open none of its files."""

import ctypes
import os
import struct
import unittest

from terminal import BIN, LOOK, Server, Terminal, wait_for

IN_ACCESS, IN_OPEN, IN_CREATE = 0x1, 0x20, 0x100


class Watch:
    """What is opened, read or made in some folders: the kernel's own word (inotify)."""

    def __init__(self, *folders):
        self.libc = ctypes.CDLL(None, use_errno=True)
        self.descriptor = self.libc.inotify_init1(os.O_NONBLOCK | os.O_CLOEXEC)
        if self.descriptor < 0:
            raise OSError(ctypes.get_errno(), "inotify_init1")
        self.folders = {}
        for folder in folders:
            number = self.libc.inotify_add_watch(self.descriptor, folder.encode(), IN_ACCESS | IN_OPEN | IN_CREATE)
            if number < 0:
                raise OSError(ctypes.get_errno(), folder)
            self.folders[number] = folder

    def close(self):
        os.close(self.descriptor)

    def seen(self):
        """The names, as they came."""
        try:
            data = os.read(self.descriptor, 65536)
        except BlockingIOError:
            return []
        names = []
        while data:
            number, _, _, size = struct.unpack("iIII", data[:16])
            names.append(os.path.join(self.folders[number], data[16:16 + size].rstrip(b"\0").decode()))
            data = data[16 + size:]
        return names


class NoFiles(unittest.TestCase):
    def setUp(self):
        self.server = Server()
        self.addCleanup(self.server.stop)
        self.terminal = Terminal()
        self.addCleanup(self.terminal.close)
        self.home = os.path.join(self.terminal.folder, "home")
        self.settings = os.path.join(self.home, ".config", "woodlouse")
        os.makedirs(self.settings)
        with open(os.path.join(self.settings, "config.json"), "w") as file:
            file.write('{"name": "mallory", "fps": "many"}')

    def start(self, options):
        """The client at its end or in the game; what was opened from its start on."""
        watch = Watch(self.home, self.settings, os.path.dirname(self.settings))
        self.addCleanup(watch.close)
        self.terminal.shows(r"[$#]")  # the shell is there
        self.terminal.run(f"clear; cd {self.home}; HOME={self.home} USER=game {BIN}/woodlouse {LOOK} {options}")
        return watch

    def test_without_it_the_config_file_is_opened(self):
        watch = self.start(self.server.address)
        self.terminal.shows(r"fps\s*:\s+it is not")
        self.assertIn(os.path.join(self.settings, "config.json"), watch.seen())

    def test_no_file_of_the_account_s_is_opened_made_or_held(self):
        watch = self.start(f"--no-files --name=mara {self.server.address}")
        self.terminal.shows(r"PLAYERS 3")
        client = wait_for("the client", lambda: self.terminal.process("woodlouse"))
        self.terminal.keys("w", "v", "Tab", "?", "?", "t")
        self.terminal.type("hello hill")
        self.terminal.keys("Enter")
        self.terminal.shows(r"mara.*hello hill")
        held = {os.readlink(f"/proc/{client}/fd/{number}") for number in os.listdir(f"/proc/{client}/fd")}
        self.assertEqual([name for name in held if not name.startswith(("socket:", "pipe:", "anon_inode:", "/dev/pts/", "/dev/null"))], [])
        self.terminal.keys("q", "y")
        wait_for("the end", lambda: not self.terminal.process("woodlouse"))
        self.assertEqual(watch.seen(), [])
        self.assertEqual(os.listdir(self.home), [".config"])

    def test_what_would_need_a_file_is_refused(self):
        for options, words in (("--no-files replay game.ndjson", "a recording is a file"), ("--no-files", "starts none here"),
                               (f"--no-files --name={'x' * 25} {self.server.address}", "24 bytes")):
            watch = self.start(options)
            self.terminal.shows(words)
            self.assertEqual(watch.seen(), [])


if __name__ == "__main__":
    unittest.main()
