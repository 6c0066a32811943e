#!/usr/bin/env python3
"""What the same frames cost a server by WebSocket, beside plain TCP: processor time above that of the room alone, in turns.

    bench/web_cost.py BIN [--watchers 300] [--rounds 11] [--seconds 5]

BIN is a tree's folder of programs. The server has core 0, whoever watches core 1, and nothing else may run on either. All watch at 20 Hz
a room of 200 lice; what comes is read and thrown away. Prints each round, then medians and their ratio.
"""
import argparse
import base64
import json
import os
import pathlib
import re
import selectors
import socket
import statistics
import struct
import subprocess
import sys
import time

MAP = pathlib.Path(__file__).resolve().parent.parent / "maps" / "volcano.json"
SETTLED_S = 1.5
STATE_HZ = 20
JOIN = json.dumps({"type": "join", "protocol": 1, "role": "spectator", "name": "watcher", "state_hz": STATE_HZ}).encode()


class Server:
    def __init__(self, programs):
        many = ("--per-address", "4000", "--join-per-s-address", "4000", "--join-per-s-room", "4000")
        self.process = subprocess.Popen(["taskset", "-c", "0", programs / "woodlouse-server", "--map", MAP, "--bots", "200", "--bots-alone", "play",
                                         "--listen", "127.0.0.1:0", "--web", "127.0.0.1:0", *many],
                                        stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
        self.lines_port, self.web_port = (int(re.search(r":(\d+)/?$", self.process.stdout.readline())[1]) for _ in range(2))

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.process.kill()
        self.process.wait()

    def processor_seconds(self):
        """On a processor, by the scheduler's own nanoseconds; /proc/PID/stat counts hundredths of a second."""
        threads = pathlib.Path(f"/proc/{self.process.pid}/task").iterdir()
        return sum(int((thread / "schedstat").read_text().split()[0]) for thread in threads) / 1e9


def by_lines(server):
    watcher = socket.create_connection(("127.0.0.1", server.lines_port))
    watcher.sendall(JOIN + b"\n")
    return watcher


def by_web_socket(server):
    watcher = socket.create_connection(("127.0.0.1", server.web_port))
    key = base64.b64encode(os.urandom(16)).decode()
    watcher.sendall(f"GET /ws HTTP/1.1\r\nHost: 127.0.0.1\r\nUpgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Key: {key}\r\n"
                    "Sec-WebSocket-Version: 13\r\n\r\n".encode())
    answer = b""
    while b"\r\n\r\n" not in answer:
        part = watcher.recv(4096)
        if not part:
            sys.exit("web_cost.py: the server ended a WebSocket at its upgrade")
        answer += part
    mask = os.urandom(4)
    assert len(JOIN) < 126  # else the head has a longer form
    watcher.sendall(struct.pack("!BB", 0x81, 0x80 | len(JOIN)) + mask + bytes(byte ^ mask[i % 4] for i, byte in enumerate(JOIN)))
    return watcher


def watched(server, door, watchers, seconds):
    """(cores of the server, bytes a second) while so many watch by one door."""
    waiting = selectors.DefaultSelector()
    sockets = [door(server) for _ in range(watchers)]
    for watcher in sockets:
        watcher.setblocking(False)
        waiting.register(watcher, selectors.EVENT_READ)

    def read(lasts):
        count, end = 0, time.monotonic() + lasts
        while time.monotonic() < end:
            for key, _ in waiting.select(0.05):
                data = key.fileobj.recv(1 << 18)
                if not data:
                    sys.exit("web_cost.py: the server ended a watcher's connection")
                count += len(data)
        return count

    read(SETTLED_S)
    used, begun = server.processor_seconds(), time.monotonic()
    count = read(seconds)
    lasted = time.monotonic() - begun
    cores = (server.processor_seconds() - used) / lasted
    for watcher in sockets:
        watcher.close()
    waiting.close()
    time.sleep(0.3)
    return cores, count / lasted


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("programs", type=pathlib.Path, metavar="BIN")
    parser.add_argument("--watchers", type=int, default=300)
    parser.add_argument("--rounds", type=int, default=11)
    parser.add_argument("--seconds", type=float, default=5.0)
    arguments = parser.parse_args()
    os.sched_setaffinity(0, {1})
    lines_runs, web_runs = [], []
    with Server(arguments.programs) as server:
        time.sleep(SETTLED_S)
        alone, _ = watched(server, by_lines, 0, 2.0 * arguments.seconds)
        for number in range(arguments.rounds):
            runs = [(by_lines, lines_runs), (by_web_socket, web_runs)]
            for door, its_runs in runs if number % 2 == 0 else reversed(runs):
                its_runs.append(watched(server, door, arguments.watchers, arguments.seconds))
            (lines_cores, lines_bytes), (web_cores, web_bytes) = lines_runs[-1], web_runs[-1]
            print(f"lines {lines_cores:.4f} cores {lines_bytes / 1e6:.1f} MB/s   WebSocket {web_cores:.4f} cores {web_bytes / 1e6:.1f} MB/s   "
                  f"ratio {(web_cores - alone) / (lines_cores - alone):.3f}", flush=True)
    frames = arguments.watchers * STATE_HZ
    lines, web = (statistics.median(cores for cores, _ in runs) - alone for runs in (lines_runs, web_runs))
    ratios = [(w - alone) / (l - alone) for (l, _), (w, _) in zip(lines_runs, web_runs)]
    print(f"room alone {alone:.3f} cores; a frame by lines {1e6 * lines / frames:.2f} us, by WebSocket {1e6 * web / frames:.2f} us; "
          f"median of the ratios {statistics.median(ratios):.3f} (goal 1.15)")


if __name__ == "__main__":
    main()
