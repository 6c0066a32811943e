"""One client that does what the load tool is too well behaved to do, over and over: lines that are none, floods, tokens used twice."""
import json
import socket
import struct
import threading

SOURCE = "127.0.0.77"
PAUSE = 0.02  # s, between two visits


class Nuisance(threading.Thread):
    def __init__(self, address):
        super().__init__(daemon=True)
        host, port = address.rsplit(":", 1)
        self.address = (host, int(port))
        self.ends = threading.Event()

    def __enter__(self):
        self.start()
        return self

    def __exit__(self, *_):
        self.ends.set()
        self.join()

    def run(self):
        visits = (self.speaks_another_language, self.floods, self.comes_twice, self.joins_and_breaks, self.says_half_a_line)
        while not self.ends.is_set():
            for visit in visits:
                try:
                    with self.connect() as connection:
                        visit(connection)
                except (OSError, ValueError):
                    pass  # sent away, which is right
                self.ends.wait(PAUSE)

    def connect(self):
        return socket.create_connection(self.address, 5.0, (SOURCE, 0))

    @staticmethod
    def send(connection, **message):
        connection.sendall(json.dumps(message).encode() + b"\n")

    def enter(self, connection, **more):
        """The welcome; a ValueError where there is none."""
        self.send(connection, type="join", protocol=1, name="nuisance", **more)
        for line in connection.makefile("rb"):
            message = json.loads(line)
            if message["type"] == "welcome":
                return message
            if message["type"] == "error":
                break
        raise ValueError("no welcome")

    def speaks_another_language(self, connection):
        connection.sendall(b"GET / HTTP/1.1\r\nHost: x\r\n\r\n")
        connection.recv(4096)

    def floods(self, connection):
        connection.sendall(b'{"type":"ping","t":1}\n' * 5000)

    def comes_twice(self, connection):
        token = self.enter(connection, resume=True)["resume_token"]
        with self.connect() as other:
            self.enter(other, resume=token)
            self.send(other, type="input", seq=1, thrust=1)

    def joins_and_breaks(self, connection):
        self.enter(connection, resume=True)
        connection.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, struct.pack("ii", 1, 0))

    def says_half_a_line(self, connection):
        connection.sendall(b'{"type":"join","proto')
