"""A client of the wire by hand: lines in, lines out, blocking. For what the load tool is too well behaved to do."""
import json
import socket
import struct
import time


class LineClient:
    def __init__(self, host, port, timeout=10.0, source=None):
        self.socket = socket.create_connection((host, port), timeout, (source, 0) if source else None)
        self.rest = b""

    def send(self, **message):
        self.socket.sendall(json.dumps(message).encode() + b"\n")

    def lines(self, seconds):
        """Messages as they come, None now and then, for that long or until the server ends it."""
        until = time.monotonic() + seconds
        self.socket.settimeout(0.05)
        while time.monotonic() < until:
            try:
                read = self.socket.recv(1 << 16)
            except TimeoutError:
                yield None
                continue
            if not read:
                return
            *whole, self.rest = (self.rest + read).split(b"\n")
            yield from map(json.loads, whole)

    def join(self, **more):
        """Joins and gives the welcome; an error or the end of the connection is a RuntimeError."""
        self.send(type="join", protocol=1, **more)
        for message in self.lines(10.0):
            if message and message["type"] == "welcome":
                return message
            if message and message["type"] in ("error", "bye"):
                raise RuntimeError(f"join: {message}")
        raise RuntimeError("no welcome")

    def abort(self):
        """As when the machine has crashed and come back: the server's next byte is answered by a reset."""
        self.socket.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, struct.pack("ii", 1, 0))
        self.socket.close()


class Watched:
    """One louse's thrust as a watcher sees it: keys, and deltas over them."""

    def __init__(self, louse):
        self.louse = louse
        self.in_key = None
        self.thrust = None  # (tx, ty); None: the louse is not there

    def take(self, message):
        rows = {row[0]: tuple(row[1:3]) for row in message["louse"]}
        if message["type"] == "key":
            self.in_key = rows.get(self.louse)
            self.thrust = self.in_key
        else:
            self.thrust = None if self.louse in message.get("gone", ()) else rows.get(self.louse, self.in_key)

    def pushes(self):
        return self.thrust is not None and self.thrust != (0, 0)
