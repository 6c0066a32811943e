"""What the tests of watching by inputs share: a watcher of raw lines, company that plays, a verdict on what was saved."""

import array
import json
import math
import os
import re
import sys
import tempfile
import threading
import time
import unittest

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [os.path.join(HERE, "..", "server"), os.path.join(HERE, "..", "..", "..", "bots", "python")]

from wire import PATIENCE, Client, run  # noqa: E402


class Watcher(Client):
    """A spectator by inputs. `files` are the recordings that came, one a keyframe: lists of lines."""

    def __init__(self, server, **options):
        super().__init__(server.host, server.port, **options)
        self.files, self.header, self.steps = [], None, 0
        self.due = None  # the step that is to come

    def receive(self):
        while True:
            while b"\n" not in self.pending:
                data = self.socket.recv(65536)
                if not data:
                    return None
                self.pending += data
            line, self.pending = self.pending.split(b"\n", 1)
            if not line.startswith(b'{"type":'):
                self.take(line.decode())
                continue
            message = json.loads(line)
            if message["type"] == "welcome":
                self.header = self.due = None
            self.seen.append(message)
            self.look(message)
            return message

    def take(self, text):
        line = json.loads(text)
        if "format" in line:
            self.header = text
            self.due = None
        elif "keyframe" in line:
            assert self.header, "a keyframe without a header"
            assert line["waiting"] == [], line["waiting"]
            self.files.append([self.header, text])
            self.due = line["keyframe"]
        else:
            assert line["step"] == self.due, (line, self.due)  # none is missing, none comes twice
            self.due += line.get("steps", 1)
            self.steps += line.get("steps", 1)
            self.files[-1].append(text)

    def watch(self, seconds=None, until=None):
        """Reads for so long, or until until() holds."""
        end = time.monotonic() + (PATIENCE if seconds is None else seconds)
        self.socket.settimeout(0.1)
        while time.monotonic() < end and not (until and until()):
            try:
                if self.receive() is None:
                    raise AssertionError(f"the connection ended; last: {self.seen[-3:]}")
            except TimeoutError:
                pass
        self.socket.settimeout(PATIENCE)
        assert until is None or until(), f"it never came; last: {self.seen[-3:]}"

    def save(self, folder):
        """The names of the files that hold it."""
        names = []
        for number, lines in enumerate(self.files):
            names.append(os.path.join(folder, "stream.%d.ndjson" % number))
            with open(names[-1], "w", encoding="utf-8", newline="\n") as out:
                out.write("\n".join(lines) + "\n")
        return names


class Company(threading.Thread):
    """Players and bots that steer by numbers and by pairs, now and for later, speak, respawn, come and go until stop()."""

    def __init__(self, server, count=4, period=0.02):
        super().__init__(daemon=True)
        self.server, self.count, self.period = server, count, period
        self.is_over, self.fault, self.turns = False, None, 0
        self.start()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.stop()

    def run(self):
        members, seqs = [], {}
        try:
            while not self.is_over:
                self.turns += 1
                if len(members) < self.count or self.turns % 60 == 0:
                    members.append(self.server.player("louse%d" % self.turns, "bot" if self.turns % 2 else "player"))
                if len(members) > self.count:
                    gone = members.pop(0)
                    gone.send({"type": "leave"})
                    gone.until_end()
                    gone.socket.close()
                for k, member in enumerate(members):
                    seq = seqs[member] = seqs.get(member, 0) + 1
                    push = (self.turns * 7 + k * 31) % 129 / 128
                    thrust = (push, -push, [push * 0.7, -push * 0.7])[(self.turns + k) % 3]
                    extra = ({}, {"ticks": 12}, {"tick": member.seen[-1].get("tick", 0) + 60})[self.turns % 3]
                    member.send({"type": "input", "seq": seq, "thrust": thrust, **extra})
                    if seq % 50 == 0:
                        member.send({"type": "chat", "text": 'push "%d"' % seq}, {"type": "respawn"})
                    self.read(member)
                time.sleep(self.period)
        except (AssertionError, OSError) as fault:
            self.fault = fault
        for member in members:
            member.socket.close()

    @staticmethod
    def read(member):
        member.socket.setblocking(False)
        try:
            while member.receive() is not None:
                pass
        except (BlockingIOError, InterruptedError):
            pass
        finally:
            member.socket.settimeout(PATIENCE)

    def stop(self):
        self.is_over = True
        self.join(PATIENCE)
        assert self.fault is None and not self.is_alive(), self.fault


def verdict(names):
    """(exit code, what it printed) of verify."""
    code, printed, errors = run("verify", *names)
    return code, printed + errors


class StreamTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def watcher(self, server, name="eye", **options):
        fields = {k: options.pop(k) for k in ("state_hz", "room") if k in options}
        watcher = Watcher(server, **options)
        self.addCleanup(watcher.socket.close)
        watcher.join(name, "spectator", stream="inputs", **fields)
        self.assertEqual(watcher.welcome["stream"], "inputs")
        return watcher

    def assert_proven(self, names, ticks):
        code, said = verdict(names)
        self.assertEqual(code, 0, said)
        spans = re.findall(r"ok ticks (\d+) to (\d+)", said)
        self.assertEqual(len(spans), len(names), said)
        self.assertGreaterEqual(sum(int(last) - int(first) for first, last in spans), ticks, said)

    def tiled_map(self):
        columns, rows = 64, 48
        path = os.path.join(self.folder, "alps.json")
        with open(os.path.join(self.folder, "alps.hdr"), "w", encoding="utf-8") as header:
            header.write(f"ncols {columns}\nnrows {rows}\nxllcenter 0\nyllcenter 0\ncellsize 1\nbyteorder LSBFIRST\n")
        with open(os.path.join(self.folder, "alps.flt"), "wb") as grid:
            array.array("f", (math.sin(0.3 * i) for _ in range(rows) for i in range(columns))).tofile(grid)
        with open(path, "w", encoding="utf-8") as file:
            json.dump({"name": "alps", "terrain": {"file": "alps.flt", "storage": "tiles"}}, file)
        return path[:-len(".json")]
