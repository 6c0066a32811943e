#!/usr/bin/env python3
"""What the terminal client costs: bytes and processor time a second by look, size and mode, and how long a key takes to the screen.

    bench/screen_cost.py BIN [--seconds 8] [--presses 25]

BIN is a tree's folder of programs. Each row: a server on core 0 plays a map with 12 of its own bots; the client, on core 1, plays in
a pseudo terminal that answers no question, as over a plain line. Bytes are those written to it; they and the presses go on while the
louse drives. "Key" is from a press of a push on the keyboard to the write after which the panel says that it is on, as a terminal
emulator (Debian's python3-pyte) reads it: at once, and over a line of 150 ms there and back with up to 40 ms of jitter each way and a stall of
0.3 s each 5 s. Nothing else may run on either core.
"""
import argparse
import fcntl
import os
import pathlib
import pty
import re
import select
import signal
import statistics
import struct
import subprocess
import sys
import tempfile
import termios
import time

import pyte

ROOT = pathlib.Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "tests" / "support"))
from slow_line import SlowLine  # noqa: E402

LOOKS = (("ascii", "mono", 80, 24), ("half", "truecolor", 80, 24), ("half", "truecolor", 120, 36), ("half", "truecolor", 200, 60))
PLAYED = (("volcano", None), ("crater_loop", "race"), ("orchard", "forage"), ("crater_king", "hill"))
PUSH = b"w"
AWAY, JITTER, STALLS = 0.075, 0.02, (5.0, 0.3)
SETTLED_S = 4.0


class Server:
    def __init__(self, programs, name, mode):
        command = ["taskset", "-c", "0", programs / "woodlouse-server", "--map", ROOT / "maps" / f"{name}.json", "--listen", "127.0.0.1:0",
                   "--bots", "12", *(["--mode", mode] if mode else [])]
        self.process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
        self.address = self.process.stdout.readline().split()[1]

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.process.kill()
        self.process.wait()


class Client:
    """The client in a terminal of that size. What it writes is counted, and read by an emulator only where `is_read`."""

    def __init__(self, programs, address, home, look, is_read):
        glyphs, color, columns, rows = look
        self.screen = pyte.Screen(columns, rows) if is_read else None
        self.stream = pyte.ByteStream(self.screen) if is_read else None
        self.bytes = 0
        environment = {**os.environ, "HOME": home, "XDG_CONFIG_HOME": home, "XDG_DATA_HOME": home, "TERM": "xterm-256color", "LC_ALL": "C.UTF-8"}
        self.child, self.terminal = pty.fork()
        if self.child == 0:
            fcntl.ioctl(0, termios.TIOCSWINSZ, struct.pack("HHHH", rows, columns, 0, 0))
            os.sched_setaffinity(0, {1})
            os.execve(programs / "woodlouse", ["woodlouse", address, "--name", "mara", "--glyphs", glyphs, "--color", color, "--view", "map",
                                               "--steer", "heading"], environment)

    def read(self, lasts, until=None):
        """When `until` was true of the screen, or None at the end of the time."""
        end = time.monotonic() + lasts
        while (left := end - time.monotonic()) > 0:
            if not select.select([self.terminal], [], [], left)[0]:
                continue
            try:
                data = os.read(self.terminal, 1 << 18)
            except OSError:
                sys.exit("screen_cost.py: the client has ended" + (":\n" + "\n".join(self.screen.display) if self.screen else ""))
            at = time.monotonic()
            self.bytes += len(data)
            if self.stream:
                self.stream.feed(data)
                if until and until("\n".join(self.screen.display)):
                    return at
        return None

    def press(self, key):
        os.write(self.terminal, key)

    def processor_seconds(self):
        return sum(int((thread / "schedstat").read_text().split()[0]) for thread in pathlib.Path(f"/proc/{self.child}/task").iterdir()) / 1e9

    def end(self):
        os.kill(self.child, signal.SIGTERM)
        try:
            while os.read(self.terminal, 1 << 18):
                pass
        except OSError:
            pass  # it has gone
        os.waitpid(self.child, 0)
        os.close(self.terminal)


def prepared(home):
    """Who has played before: the first minute's lesson would lie over the picture."""
    folder = pathlib.Path(home) / "woodlouse"
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "lesson").write_text("done\n")
    return home


def costs(programs, home, look, played, seconds):
    """(bytes a second, share of a core)"""
    with Server(programs, *played) as server:
        client = Client(programs, server.address, home, look, False)
        client.read(SETTLED_S)
        before, used, begun = client.bytes, client.processor_seconds(), time.monotonic()
        for press in range(int(2 * seconds)):
            client.press(PUSH if press % 3 else b"d")
            client.read(0.5)
        lasted = time.monotonic() - begun
        figures = (client.bytes - before) / lasted, (client.processor_seconds() - used) / lasted
        client.end()
        return figures


def key_times(programs, home, look, address, presses):
    """[ms], sorted."""
    client = Client(programs, address, home, look, True)
    client.read(SETTLED_S)
    times = []
    for press in range(presses):
        if client.read(10.0, lambda text: re.search(r"push +none", text)) is None:
            sys.exit("screen_cost.py: the push does not end:\n" + "\n".join(client.screen.display))
        client.read(0.05 + 0.037 * (press % 7))
        begun = time.monotonic()
        client.press(PUSH)
        at = client.read(5.0, lambda text: re.search(r"push +\+", text))
        if at is None:
            sys.exit("screen_cost.py: a press was not shown:\n" + "\n".join(client.screen.display))
        times.append(1e3 * (at - begun))
    client.end()
    return sorted(times)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("programs", type=lambda text: pathlib.Path(text).resolve(), metavar="BIN")
    parser.add_argument("--seconds", type=float, default=8.0, help="of each row")
    parser.add_argument("--presses", type=int, default=25, help="of a key, at each distance")
    arguments = parser.parse_args()
    os.sched_setaffinity(0, {0})
    with tempfile.TemporaryDirectory() as folder:
        home = prepared(folder)
        print(f"{'map, mode':<22} {'look':<24} {'KB/s':>7} {'KB a frame of 30':>17} {'core':>6}")
        for played in PLAYED:
            for look in LOOKS:
                rate, core = costs(arguments.programs, home, look, played, arguments.seconds)
                print(f"{', '.join(filter(None, played)):<22} {look[0] + ' ' + look[1] + f' {look[2]}x{look[3]}':<24} {rate / 1e3:7.1f} {rate / 30e3:17.2f} "
                      f"{100 * core:5.1f}%", flush=True)
        for look in LOOKS[0], LOOKS[2]:
            with Server(arguments.programs, *PLAYED[1]) as server:
                with SlowLine(server.address, AWAY, JITTER, STALLS) as line:
                    for where, address in (("here", server.address), ("150 ms away, jitter, stalls", line.address)):
                        times = key_times(arguments.programs, home, look, address, arguments.presses)
                        print(f"key to screen, {look[0]} {look[2]}x{look[3]}, {where}: median {statistics.median(times):.1f}, "
                              f"p95 {times[int(0.95 * (len(times) - 1))]:.1f}, max {times[-1]:.1f} ms", flush=True)


if __name__ == "__main__":
    main()
