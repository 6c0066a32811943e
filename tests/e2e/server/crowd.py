"""Many clients of one address, read by one thread, and what a healthy watcher beside them sees."""

import collections
import json
import selectors
import socket
import threading


class Crowd(threading.Thread):
    """count clients that join, each with those fields; what comes to them is counted by type and code (or kind)."""

    def __init__(self, server, count, source, fields=lambda number: {}):
        super().__init__(daemon=True)
        self.counts = collections.Counter()
        self.bytes = collections.Counter()  # by type
        self.welcomes = []
        self.refusals = []  # errors rate_limited
        self.ends = threading.Event()
        self.selector = selectors.DefaultSelector()
        self.sockets = []
        for number in range(count):
            client = socket.create_connection((server.host, server.port), 20.0, (source, 0))
            client.settimeout(20.0)
            self.sockets.append(client)
            self.selector.register(client, selectors.EVENT_READ, bytearray())
            self.say(number, {"type": "join", "protocol": 1, "role": "spectator", "name": "crowd", **fields(number)})
        self.start()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.ends.set()
        self.join()
        for client in self.sockets:
            client.close()

    def say(self, number, *messages):
        try:
            self.sockets[number].sendall(b"".join(json.dumps(m).encode() + b"\n" for m in messages))
        except OSError:
            pass  # sent away: that is counted where its bye comes

    def say_all(self, *messages):
        for number in range(len(self.sockets)):
            self.say(number, *messages)

    def run(self):
        while not self.ends.is_set():
            for ready, _ in self.selector.select(0.05):
                try:
                    read = ready.fileobj.recv(1 << 18)
                except OSError:
                    read = b""
                if not read:
                    self.selector.unregister(ready.fileobj)
                    continue
                ready.data.extend(read)
                *lines, rest = ready.data.split(b"\n")
                ready.data[:] = rest
                for line in lines:
                    self.take(bytes(line))

    def take(self, line):
        message = json.loads(line)
        kind = message["type"]
        self.counts[kind] += 1
        self.counts[message.get("code") or message.get("kind") or ""] += 1
        self.bytes[kind] += len(line) + 1
        if kind == "welcome":
            self.welcomes.append(message)
        if message.get("code") == "rate_limited":
            self.refusals.append(message)


def frames_missed_in_a_row(messages, period=3):
    """The most due frames between two that came, after the first two (a newcomer's)."""
    ticks = [m["tick"] for m in messages if m["type"] in ("key", "delta")][2:]
    assert len(ticks) > 2 and ticks == sorted(set(ticks)), ticks
    return max(after - before for before, after in zip(ticks, ticks[1:])) // period - 1


def events_in_a_row(messages):
    """The most events that came with no frame between them."""
    longest = row = 0
    for message in messages:
        row = row + 1 if message["type"] == "event" else 0 if message["type"] in ("key", "delta") else row
        longest = max(longest, row)
    return longest
