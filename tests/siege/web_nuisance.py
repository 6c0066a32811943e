"""Those at --web who are worse than a browser, over and over: slow heads and long ones, half a TLS hello, frames that lie about their size,
pages of other houses, and a crowd of sockets that say nothing. Then those who ask for much that is theirs: views, and the room's inputs."""
import base64
import json
import os
import socket
import ssl
import struct
import threading
import time

from nuisance import Nuisance

SOURCE, SILENT_SOURCE, GOOD_SOURCE = "127.0.0.78", "127.0.0.79", "127.0.0.80"
PAUSE = 0.02      # s, between two visits
SILENT = 1000     # sockets that say nothing; the address has fewer
SILENT_EVERY = 5.0  # s
GIGABYTE = 1 << 30


class WebNuisance(Nuisance):
    def __init__(self, address):
        super().__init__(address)
        self.silent, self.next_silent = [], 0.0
        self.visits, self.faults = 0, []

    def run(self):
        visits = (self.says_a_long_head, self.leaves_a_head_open, self.says_half_a_hello, self.speaks_garbage_in_tls, self.announces_a_gigabyte,
                  self.does_not_mask, self.comes_from_another_page, self.asks_in_a_row, self.breaks_in_a_frame)
        held = []
        while not self.ends.is_set():
            self.stand_about()
            for visit in visits:
                try:
                    connection = self.connect()
                    held.append(connection)
                    visit(connection)
                    self.visits += 1
                except (OSError, ValueError):
                    pass  # sent away, which is right
                while len(held) > 40:  # most are left as they are: the server has to end them itself
                    held.pop(0).close()
                self.ends.wait(PAUSE)
        for connection in held + self.silent:
            connection.close()

    def connect(self, source=SOURCE):
        return socket.create_connection(self.address, 5.0, (source, 0))

    def stand_about(self):
        if time.monotonic() < self.next_silent:
            return
        self.next_silent = time.monotonic() + SILENT_EVERY
        for connection in self.silent:
            connection.close()
        self.silent = []
        for _ in range(SILENT):
            try:
                self.silent.append(self.connect(SILENT_SOURCE))
            except OSError:
                break

    def upgrade(self, connection, **headers):
        """The status."""
        fields = {"Host": f"127.0.0.1:{self.address[1]}", "Upgrade": "websocket", "Connection": "Upgrade",
                  "Sec-WebSocket-Key": base64.b64encode(os.urandom(16)).decode(), "Sec-WebSocket-Version": "13", **headers}
        connection.sendall(b"GET /ws HTTP/1.1\r\n" + "".join(f"{name}: {value}\r\n" for name, value in fields.items()).encode() + b"\r\n")
        answer = b""
        while b"\r\n\r\n" not in answer:
            part = connection.recv(4096)
            if not part:
                raise ValueError("ended")
            answer += part
        return int(answer.split()[1])

    def says_a_long_head(self, connection):
        connection.sendall(b"GET / HTTP/1.1\r\nX: " + b"x" * (8193 - 19))
        connection.recv(4096)

    def leaves_a_head_open(self, connection):
        connection.sendall(b"GET /rooms HTTP/1.1\r\nHost: loc")

    def says_half_a_hello(self, connection):
        connection.sendall(b"\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03" + os.urandom(32))

    def speaks_garbage_in_tls(self, connection):
        connection.sendall(b"\x16\x03\x01\x00\x40" + os.urandom(64))

    def announces_a_gigabyte(self, connection):
        self.upgrade(connection)
        connection.sendall(struct.pack("!BBQ", 0x81, 0xff, GIGABYTE) + b"mask" + b"x" * 4096)

    def does_not_mask(self, connection):
        self.upgrade(connection)
        connection.sendall(b"\x81\x05hello")

    def comes_from_another_page(self, connection):
        if self.upgrade(connection, Origin="https://elsewhere.example") == 101:
            self.faults.append("a page of another house opened a session")

    def asks_in_a_row(self, connection):
        connection.sendall(b"GET /rooms HTTP/1.1\r\nHost: localhost\r\n\r\n" * 120)
        connection.recv(4096)

    def breaks_in_a_frame(self, connection):
        self.upgrade(connection)
        connection.sendall(b"\x01\xfe\x0f\xa0mask" + os.urandom(100))
        connection.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, struct.pack("ii", 1, 0))
        connection.close()


def frame(text):
    data, mask = text.encode(), os.urandom(4)
    assert len(data) < 126
    return struct.pack("!BB", 0x81, 0x80 | len(data)) + mask + bytes(byte ^ mask[i % 4] for i, byte in enumerate(data))


class Onlooker(threading.Thread):
    """A spectator who reads as fast as it comes: by WebSocket or inside of TLS, a view or the inputs; joins anew where it was sent away."""

    def __init__(self, address, number):
        super().__init__(daemon=True)
        host, port = address.rsplit(":", 1)
        self.address = (host, int(port))
        self.number = number
        self.ends = threading.Event()
        self.bytes, self.times_sent_away = 0, 0

    def join_line(self):
        more = '"stream":"inputs"' if self.number % 2 else '"view":{"x":0,"y":0,"radius":20,"rows":30}'
        return '{"type":"join","protocol":1,"role":"spectator","name":"onlooker",' + more + "}"

    def run(self):
        context = ssl.create_default_context()
        context.check_hostname, context.verify_mode = False, ssl.CERT_NONE
        while not self.ends.is_set():
            try:
                with socket.create_connection(self.address, 5.0, (GOOD_SOURCE, 0)) as plain:
                    connection = context.wrap_socket(plain) if self.number % 4 >= 2 else plain
                    if self.number % 3 == 0:
                        connection.sendall(self.join_line().encode() + b"\n")
                    else:
                        WebNuisance.upgrade(self, connection)
                        connection.sendall(frame(self.join_line()))
                    while not self.ends.is_set() and (data := connection.recv(1 << 18)):
                        self.bytes += len(data)
            except (OSError, ValueError):
                pass
            self.times_sent_away += not self.ends.is_set()
            self.ends.wait(0.5)


class Onlookers:
    def __init__(self, address, many):
        self.all = [Onlooker(address, number) for number in range(many)]

    def __enter__(self):
        for onlooker in self.all:
            onlooker.start()
        return self

    def __exit__(self, *_):
        for onlooker in self.all:
            onlooker.ends.set()
        for onlooker in self.all:
            onlooker.join(10.0)


class Operator(threading.Thread):
    """Types without pause: looks, measures, bans the nuisance's address and lets it in again, mutes, talks."""

    LINES = ({"type": "status"}, {"type": "rooms", "room": "volcano"}, {"type": "ban", "who": SOURCE}, {"type": "say", "text": "patience"},
             {"type": "unban", "who": SOURCE}, {"type": "bans"}, {"type": "mute", "who": "127.0.0.77"}, {"type": "unmute", "who": "127.0.0.77"},
             {"type": "open", "file": "hills", "name": "evening"}, {"type": "close", "room": "evening"}, {"type": "reload"})

    def __init__(self, path):
        super().__init__(daemon=True)
        self.path = path
        self.ends = threading.Event()
        self.done, self.refused, self.scrapes = 0, [], 0

    def __enter__(self):
        self.start()
        return self

    def __exit__(self, *_):
        self.ends.set()
        self.join()

    def run(self):
        while not self.ends.is_set():
            for line in self.LINES:
                with socket.socket(socket.AF_UNIX) as door:
                    door.settimeout(30.0)
                    door.connect(self.path)
                    door.sendall(json.dumps(line).encode() + b"\n")
                    answer = json.loads(door.makefile("rb").readline())
                if answer["type"] == "done":
                    self.done += 1
                else:
                    self.refused.append((line, answer))
                if self.ends.wait(0.2):
                    return
            with socket.socket(socket.AF_UNIX) as door:
                door.connect(self.path)
                door.sendall(b"GET /metrics HTTP/1.1\r\nHost: x\r\nConnection: close\r\n\r\n")
                self.scrapes += door.makefile("rb").read().startswith(b"HTTP/1.1 200")
