"""For the tests: programs that run, and who watches a room of theirs.

Needs the programs: WOODLOUSE_BIN=build/release/bin
"""

import json
import os
import re
import signal
import subprocess
import sys
import tempfile
import threading
import time

KIT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
ROOT = os.path.dirname(os.path.dirname(KIT))
sys.path.insert(0, KIT)
import woodlouse

PATIENCE_S = 60.0  # only a failing test takes so long


def program(name):
    return os.path.join(os.environ["WOODLOUSE_BIN"], name)


class Running:
    """A program whose lines can be waited for; ended at the end of the `with`."""

    def __init__(self, *command):
        self._process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        self.lines = []
        self._changed = threading.Condition()
        self._ended = False
        self._reader = threading.Thread(target=self._read, daemon=True)
        self._reader.start()

    def _read(self):
        for line in self._process.stdout:
            with self._changed:
                self.lines.append(line.rstrip("\n"))
                self._changed.notify_all()
        with self._changed:
            self._ended = True
            self._changed.notify_all()

    def wait_for(self, pattern, accept=lambda match: True):
        """The first match of `pattern` in a line that `accept` takes."""
        deadline = time.monotonic() + PATIENCE_S
        seen = 0
        with self._changed:
            while True:
                for line in self.lines[seen:]:
                    match = re.search(pattern, line)
                    if match and accept(match):
                        return match
                seen = len(self.lines)
                if self._ended or not self._changed.wait(deadline - time.monotonic()):
                    raise AssertionError("no line with %r in:\n%s" % (pattern, "\n".join(self.lines[-20:])))

    def interrupt(self):
        """As Ctrl-C does."""
        self._process.send_signal(signal.SIGINT)

    def result(self):
        """Its exit code, once it ended by itself."""
        return self._process.wait(PATIENCE_S)

    def __enter__(self):
        return self

    def __exit__(self, *exception):
        if self._process.poll() is None:
            self._process.send_signal(signal.SIGINT)
            try:
                self._process.wait(5)
            except subprocess.TimeoutExpired:
                self._process.kill()
                self._process.wait()
        self._reader.join(5)
        self._process.stdout.close()


def serve(owner, played, *options):
    """The address of a server of that map - a shipped one's name, or a definition - with those options. It ends with
    `owner`, a TestCase or its class."""
    with tempfile.TemporaryDirectory() as folder:
        if isinstance(played, str):
            file = os.path.join(ROOT, "maps", played + ".json")
        else:
            file = os.path.join(folder, "map.json")
            with open(file, "w", encoding="utf-8") as out:
                json.dump(played, out)
        server = Running(program("woodlouse-server"), "--map", file, "--listen", "127.0.0.1:0", "--seed", "3", *options)
        add = owner.addClassCleanup if isinstance(owner, type) else owner.addCleanup
        add(server.__exit__)
        return server.wait_for(r"^listening (\S+)$").group(1)  # it has read the file


def example(name, address):
    return Running(sys.executable, "-B", os.path.join(KIT, name + ".py"), address)


def readme_code(*path):
    """The lines of the section "A bot in ten lines" of a README, without their indent."""
    with open(os.path.join(ROOT, *path, "README.md"), encoding="utf-8") as file:
        section = re.search(r"^## A bot in ten lines\n\n((?:    .*\n|\n)+)", file.read(), re.MULTILINE).group(1)
    return re.sub(r"^    ", "", section, flags=re.MULTILINE).strip() + "\n"


def readme_bot(address):
    return Running("env", "PYTHONPATH=" + KIT, sys.executable, "-B", "-c", readme_code(), address)


class Witness:
    """Watches a room from its own thread and keeps what each louse did, whatever its bot says of it. It is there once
    it is made; it leaves with `owner`, as serve's server does."""

    def __init__(self, owner, address, fields):
        self._rows = {}  # {name: [(tick, row)]}
        self._changed = threading.Condition()
        self._failure = None
        self._game = woodlouse.connect(address, name="witness", role="spectator", fields=fields)
        self.tick_hz, self.extent = self._game.tick_hz, self._game.extent
        self.ground = self._game.map()
        self._leaving = False
        self._thread = threading.Thread(target=self._watch, daemon=True)
        self._thread.start()
        add = owner.addClassCleanup if isinstance(owner, type) else owner.addCleanup
        add(self._leave)

    def _watch(self):
        try:
            for state in self._game.states():
                with self._changed:
                    for louse, row in state.lice.items():
                        self._rows.setdefault(self._game.players.get(louse), []).append((state.tick, row))
                    self._changed.notify_all()
                if self._leaving:
                    break
            self._game.close()
        except Exception as failure:
            with self._changed:
                self._failure = failure
                self._changed.notify_all()

    def _leave(self):
        self._leaving = True
        self._thread.join(10)

    def see(self, name, done, seconds):
        """The rows [(tick, row)] of the louse of that name, oldest first, once done(rows) is true. AssertionError when
        it is not after so many seconds of the game - the room's clock counts, however slow the machine - since the louse
        came, or when nothing happens for long."""
        deadline = time.monotonic() + PATIENCE_S + 2 * seconds
        with self._changed:
            while True:
                rows = list(self._rows.get(name, ()))
                if rows and done(rows):
                    return rows
                late = rows and rows[-1][0] - rows[0][0] > seconds * self.tick_hz
                if late or self._failure or not self._changed.wait(deadline - time.monotonic()):
                    raise AssertionError("%s: %s; seen last: %s"
                                         % (name, self._failure or "not within %g s" % seconds, rows[-1:]))
