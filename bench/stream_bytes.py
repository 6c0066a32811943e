#!/usr/bin/env python3
"""Bytes a second to who watches a room by inputs, beside who watches it by frames.

    bench/stream_bytes.py BIN [--lice 12,200,1000] [--inputs 0,2,10] [--seconds 10]

BIN is a tree's folder of programs. Each louse sends so many inputs a second: by numbers and by pairs, held and for 12 ticks,
in rooms of their own. Bytes are those behind the first five seconds, so that no keyframe and no map is among them; "begins
with" is what comes before the first step by inputs: welcome, header and keyframe. Bytes hang on no clock: the machine need not be quiet, as
long as the server keeps its pace (what it printed of late ticks is said).
"""
import argparse
import json
import os
import pathlib
import random
import selectors
import socket
import subprocess
import sys
import time

MAPS = pathlib.Path(__file__).resolve().parent.parent / "maps"
STEERINGS = ("numbers, held", "numbers, 12 ticks", "pairs, held", "pairs, 12 ticks")
SETTLED_S = 5.0


class Member:
    """A connection that reads all and keeps nothing but a count of bytes."""

    def __init__(self, port, number, **join):
        self.socket = socket.socket()
        self.socket.bind(("127.0.0.%d" % (1 + number % 8), 0))
        self.socket.connect(("127.0.0.1", port))
        self.socket.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        self.bytes, self.seq, self.tail = 0, 0, b""
        self.start = None  # bytes before the first step
        self.is_slowed = False
        self.socket.sendall(json.dumps({"type": "join", "protocol": 1, "name": "m%d" % number, **join}).encode() + b"\n")
        while b'{"type":"welcome"' not in self.tail:
            data = self.socket.recv(1 << 20)
            if not data:
                sys.exit("stream_bytes.py: the server refused a member: %r" % self.tail[-300:])
            self.tail += data
        self.is_watched = join.get("stream") == "inputs"
        self.bytes = len(self.tail)
        self.socket.setblocking(False)

    def read(self):
        data = self.socket.recv(1 << 20)
        if not data:
            sys.exit("stream_bytes.py: the server ended a connection")
        self.bytes += len(data)
        self.is_slowed = self.is_slowed or b'"type":"notice"' in data
        if self.is_watched and self.start is None:
            self.tail += data
            step = self.tail.find(b'\n{"step":')
            self.start = step + 1 if step >= 0 else None

    def push(self, steering):
        self.seq += 1
        quanta = random.randint(-90, 90) or 1
        thrust = quanta / 128 if steering.startswith("numbers") else [quanta / 128, random.randint(-90, 90) / 128]
        line = {"type": "input", "seq": self.seq, "thrust": thrust}
        if steering.endswith("12 ticks"):
            line["ticks"] = 12
        try:
            self.socket.sendall(json.dumps(line, separators=(",", ":")).encode() + b"\n")
        except BlockingIOError:
            pass  # the server reads slower than this; the input is not counted


def measure(folder, lice, rate, steering, seconds):
    """(start bytes, bytes/s by inputs, bytes/s by frames, inputs/s, what the server said)"""
    process = subprocess.Popen(
        [os.path.join(folder, "woodlouse-server"), "--map", str(MAPS / "volcano.json"), "--listen", "127.0.0.1:0", "--bots", "0",
         "--max-bots", "2000", "--per-address", "2000", "--join-per-s-address", "100000", "--join-per-s-room", "100000",
         "--log-level", "error"], stdout=subprocess.PIPE, text=True)
    members = []
    try:
        port = int(process.stdout.readline().split()[1].rsplit(":", 1)[1])
        for k in range(lice):
            members.append(Member(port, k, role="bot", state_hz=1, fields=["id"]))
        by_inputs = Member(port, 9990, role="spectator", stream="inputs")
        by_frames = Member(port, 9991, role="spectator")
        select = selectors.DefaultSelector()
        for member in (*members, by_inputs, by_frames):
            select.register(member.socket, selectors.EVENT_READ, member)
        begun = time.monotonic()
        sent, marks = 0, None
        while True:
            now = time.monotonic() - begun
            if marks is None and now >= SETTLED_S:
                marks, sent_before, at = (by_inputs.bytes, by_frames.bytes), sent, now
            if now >= SETTLED_S + seconds:
                break
            due = int(now * rate * lice)
            while sent < due and lice:
                members[sent % lice].push(steering)
                sent += 1
            for key, _ in select.select(0.002):
                key.data.read()
        spent = now - at
        result = (by_inputs.start or 0, (by_inputs.bytes - marks[0]) / spent, (by_frames.bytes - marks[1]) / spent,
                  (sent - sent_before) / spent)
    finally:
        for member in members:
            member.socket.close()
        process.terminate()
        printed = process.communicate(timeout=20)[0]
    moves = [word for word in printed.split(", ") if "clock" in word and not word.endswith(" 0")]
    if by_frames.is_slowed:
        moves.append("its frames were slowed down: this machine is too slow, or busy")
    return (*result, "; ".join(moves))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("bin")
    parser.add_argument("--lice", default="12,200,1000")
    parser.add_argument("--inputs", default="0,2,10")
    parser.add_argument("--seconds", type=float, default=10.0)
    asked = parser.parse_args()
    print("lice  inputs/s each  steering            begins with  by inputs     by frames     inputs/s came")
    for lice in map(int, asked.lice.split(",")):
        for rate in map(float, asked.inputs.split(",")):
            for steering in STEERINGS if rate else ("none",):
                start, inputs, frames, came, said = measure(asked.bin, lice, rate, steering, asked.seconds)
                print("%4d  %13g  %-18s  %8.1f KB  %6.1f KB/s  %8.1f KB/s  %9.0f  %s"
                      % (lice, rate, steering, start / 1e3, inputs / 1e3, frames / 1e3, came, said), flush=True)


if __name__ == "__main__":
    main()
