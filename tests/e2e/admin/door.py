"""A server with an operator's door, and what an operator does at it."""

import json
import os
import socket
import subprocess
import sys
import tempfile
import time

sys.path.insert(0, os.path.join(os.path.dirname(__file__), "..", "server"))

from wire import PATIENCE, PROGRAM, Server  # noqa: E402


def wait_until(is_so):
    end = time.monotonic() + PATIENCE
    while not is_so():
        if time.monotonic() > end:
            raise AssertionError("it never came to that")
        time.sleep(0.02)


class Door:
    """A connection to the door: commands, a line each."""

    def __init__(self, where):
        self.socket = socket.socket(socket.AF_UNIX if isinstance(where, str) else socket.AF_INET)
        self.socket.settimeout(PATIENCE)
        self.socket.connect(where)
        self.file = self.socket.makefile("rb")

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.file.close()
        self.socket.close()

    def send(self, kind, **fields):
        self.socket.sendall(json.dumps({"type": kind, **fields}).encode() + b"\n")

    def answer(self):
        """The next answer; None at the end of the connection."""
        line = self.file.readline()
        return json.loads(line) if line else None

    def ask(self, kind, **fields):
        self.send(kind, **fields)
        return self.answer()


class AdminServer(Server):
    """Its door is a Unix socket, in a folder of its own (`folder`), or `admin`."""

    def __init__(self, *arguments, admin=None, **options):
        self.temporary = tempfile.TemporaryDirectory()
        self.folder = self.temporary.name
        self.socket_path = os.path.join(self.folder, "admin.sock")
        arguments = [argument.replace("FOLDER", self.folder) for argument in arguments]
        super().__init__("--admin", admin or self.socket_path, *arguments, **options)
        line = self.process.stdout.readline()
        if line.startswith("web "):
            self.url = line.split()[1]
            line = self.process.stdout.readline()
        if not line.startswith("admin "):
            self.process.kill()
            raise AssertionError("no `admin`: " + line + self.log())
        self.where = line.split()[1]

    def __exit__(self, *error):
        try:
            super().__exit__(*error)
        finally:
            self.temporary.cleanup()

    def path(self, name):
        return os.path.join(self.folder, name)

    def door(self):
        return Door(self.where if "/" in self.where else ("127.0.0.1", int(self.where.rsplit(":", 1)[1])))

    def done(self, kind, **fields):
        """Has it done; the answer."""
        with self.door() as door:
            answer = door.ask(kind, **fields)
        assert answer and answer["type"] == "done", answer
        return answer

    def refused(self, kind, code, **fields):
        """Is refused with that code; the text."""
        with self.door() as door:
            answer = door.ask(kind, **fields)
        assert answer and answer["type"] == "refused" and answer["code"] == code, answer
        return answer["text"]

    def typed(self, *words):
        """`woodlouse-server admin ...`: (exit code, standard output, standard error)."""
        done = subprocess.run([PROGRAM, "admin", "--socket", self.socket_path, *words], capture_output=True, text=True,
                              timeout=60)
        return done.returncode, done.stdout, done.stderr
