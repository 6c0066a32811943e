"""A server under test and clients that speak raw lines to it."""

import json
import os
import signal
import socket
import subprocess
import tempfile
import threading
import time

PROGRAM = os.environ["WOODLOUSE_SERVER"]
MAPS = os.environ["WOODLOUSE_MAPS"]
# Generous: a sanitizer build on a busy machine is slow, and nothing is gained by failing early.
PATIENCE = 20.0


def map_file(name):
    return os.path.join(MAPS, name + ".json")


def share_missed(messages, period):
    """The share of a stream's keys and deltas that did not come, after its first two (a newcomer's)."""
    ticks = [m["tick"] for m in messages if m["type"] in ("key", "delta")][2:]
    wanted = (ticks[-1] - ticks[0]) // period + 1
    assert ticks == sorted(set(ticks)) and len(ticks) > 1, ticks
    return 1 - len(ticks) / wanted


def run(*arguments, **options):
    """Runs the program to its end: (exit code, standard output, standard error)."""
    done = subprocess.run([PROGRAM, *arguments], capture_output=True, text=True, timeout=60, **options)
    return done.returncode, done.stdout, done.stderr


class Server:
    """A running woodlouse-server on a free loopback port; ended with the `with` block. fork: a recording and a tick to
    go on from, instead of maps. ends_with: the exit code it is to have."""

    def __init__(self, *arguments, maps=("volcano",), listen="127.0.0.1:0", fork=None, ends_with=0):
        self.ends_with = ends_with
        games = ["fork", fork[0], "--tick", str(fork[1])] if fork else ["--map", *map(map_file, maps)]
        command = [PROGRAM, *games, "--listen", listen, *arguments]
        self.errors = tempfile.TemporaryFile()
        self.process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=self.errors, text=True)
        first = self.process.stdout.readline()
        if not first.startswith("listening "):
            self.process.wait(PATIENCE)
            raise AssertionError("no `listening`: " + first + self.log())
        self.address = first.split()[1]
        host, port = self.address.rsplit(":", 1)
        self.host, self.port = host.strip("[]"), int(port)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        if self.process.poll() is None:
            self.process.terminate()
        try:
            code = self.process.wait(PATIENCE)
            # However the test went, the server itself must have ended well (or have been killed by the test).
            if code not in (self.ends_with, -signal.SIGKILL):
                raise AssertionError(f"the server ended with {code}:\n{self.log()}")
        finally:
            self.process.kill()
            self.process.stdout.close()
            self.errors.close()

    def log(self):
        # Not by seeking: the place in the file is the server's too, who would write over what is there.
        return os.pread(self.errors.fileno(), os.fstat(self.errors.fileno()).st_size, 0).decode()

    def wait_for_log(self, text, patience=PATIENCE):
        end = time.monotonic() + patience
        while text not in self.log():
            if time.monotonic() > end:
                raise AssertionError(f"the log never said {text!r}:\n{self.log()}")
            time.sleep(0.02)

    def stop(self, by=signal.SIGTERM):
        """Signals it; returns (exit code, seconds it took, what it printed)."""
        begun = time.monotonic()
        self.process.send_signal(by)
        return self.finish(begun)

    def finish(self, begun=None):
        begun = begun or time.monotonic()
        printed = self.process.stdout.read()
        code = self.process.wait(PATIENCE)
        return code, time.monotonic() - begun, printed

    def client(self, **options):
        return Client(self.host, self.port, **options)

    def player(self, name="mara", role="player", source=None, **fields):
        client = self.client(source=source)
        client.join(name, role, **fields)
        return client


class Client:
    """A connection. Every message that came is kept in `seen`. source: the address it comes from."""

    def __init__(self, host, port, receive_buffer=None, source=None):
        family = socket.AF_INET6 if ":" in host else socket.AF_INET
        self.socket = socket.socket(family, socket.SOCK_STREAM)
        if receive_buffer:
            self.socket.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, receive_buffer)
        self.socket.settimeout(PATIENCE)
        if source:
            self.socket.bind((source, 0))
        try:
            self.socket.connect((host, port))
        except OSError:
            self.socket.close()
            raise
        self.pending = b""
        self.seen = []
        self.rows = {}
        self.key = None

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.socket.close()

    def send(self, *messages):
        self.send_bytes(b"".join(json.dumps(m).encode() + b"\n" for m in messages))

    def send_bytes(self, data):
        self.socket.sendall(data)

    def receive(self):
        """The next message; None at the end of the connection."""
        while b"\n" not in self.pending:
            try:
                data = self.socket.recv(65536)
            except ConnectionResetError:
                return None
            if not data:
                return None
            self.pending += data
        line, self.pending = self.pending.split(b"\n", 1)
        message = json.loads(line)
        self.seen.append(message)
        self.look(message)
        return message

    def look(self, message):
        """Keeps `rows` as the keys and deltas say, checking that deltas rest on the key that is held."""
        if message["type"] == "key":
            self.key = {row[0]: row for row in message["louse"]}
            self.base = message["tick"]
            self.rows = dict(self.key)
        elif message["type"] == "delta":
            assert self.key is not None and message["base"] == self.base, message
            self.rows = dict(self.key)
            self.rows.update({row[0]: row for row in message["louse"]})
            for gone in message["gone"]:
                del self.rows[gone]

    def expect(self, kind, /, patience=PATIENCE, **fields):
        """Receives until a message of that type and with those fields comes."""
        end = time.monotonic() + patience
        while time.monotonic() < end:
            message = self.receive()
            if message is None:
                break
            if message["type"] == kind and all(message.get(k) == v for k, v in fields.items()):
                return message
        raise AssertionError(f"no {kind} {fields}; last: {self.seen[-5:]}")

    def join(self, name="mara", role="player", **fields):
        self.send({"type": "join", "protocol": 1, "role": role, "name": name, **fields})
        self.welcome = self.expect("welcome")
        self.id = self.welcome["id"]
        return self.welcome

    def until_end(self, patience=PATIENCE):
        """Everything that comes until the server closes."""
        end = time.monotonic() + patience
        messages = []
        while time.monotonic() < end:
            message = self.receive()
            if message is None:
                return messages
            messages.append(message)
        raise AssertionError(f"the connection was not ended; last: {self.seen[-5:]}")


class Reader(threading.Thread):
    """Reads a client in the background until its end."""

    def __init__(self, client):
        super().__init__(daemon=True)
        self.client = client
        self.came = []
        self.start()

    def run(self):
        try:
            while (message := self.client.receive()) is not None:
                self.came.append(message)
        except OSError:
            pass

    def messages(self, *kinds):
        return [message for message in list(self.came) if message["type"] in kinds]
