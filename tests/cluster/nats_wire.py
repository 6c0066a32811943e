"""As much of NATS' protocol as a test speaks by itself: what passes on a subject is heard, and a stream's messages are read and
added to, as one could who has come into the private network."""

import base64
import ctypes
import ctypes.util
import json
import socket
import threading
import time


class Wire:
    """A connection to one node. Heard messages come on a thread of its own."""

    def __init__(self, port, address="127.0.0.1"):
        self.socket = socket.create_connection((address, port), timeout=10)
        self.input = self.socket.makefile("rb")
        self.heard = {}  # number of a subscription: who takes its messages
        self.lock = threading.Lock()
        self.say("CONNECT " + json.dumps({"verbose": False, "pedantic": False, "lang": "python", "version": "1", "protocol": 1}))
        self.socket.settimeout(None)
        threading.Thread(target=self.work, daemon=True).start()

    def say(self, line, payload=None):
        with self.lock:
            self.socket.sendall(line.encode() + b"\r\n" + (b"" if payload is None else payload + b"\r\n"))

    def work(self):
        try:
            while line := self.input.readline():
                word, *rest = line.decode().split()
                if word == "PING":
                    self.say("PONG")
                if word == "MSG":
                    payload = self.input.read(int(rest[-1]) + 2)[:-2]
                    self.heard[rest[1]](payload)
        except (OSError, ValueError):
            pass  # closed

    def subscribe(self, subject, taken):
        number = str(len(self.heard) + 1)
        self.heard[number] = taken
        self.say(f"SUB {subject} {number}")

    def ask(self, subject, payload):
        """The answer to a request, as JSON."""
        inbox, answers = f"_INBOX.{id(self)}.{len(self.heard)}", []
        self.subscribe(inbox, answers.append)
        self.say(f"PUB {subject} {inbox} {len(payload)}", payload)
        end = time.monotonic() + 10
        while not answers:
            assert time.monotonic() < end, f"no answer to {subject}"
            time.sleep(0.005)
        return json.loads(answers[0])

    def read(self, stream, sequence):
        answer = self.ask(f"$JS.API.STREAM.MSG.GET.{stream}", json.dumps({"seq": sequence}).encode())
        return base64.b64decode(answer["message"]["data"]) if "message" in answer else None

    def last(self, stream, subject):
        """(sequence number, bytes) of the stream's last message."""
        message = self.ask(f"$JS.API.STREAM.MSG.GET.{stream}", json.dumps({"last_by_subj": subject}).encode())["message"]
        return message["seq"], base64.b64decode(message["data"])

    def close(self):
        self.socket.shutdown(socket.SHUT_RDWR)
        self.socket.close()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()


zstd = ctypes.CDLL(ctypes.util.find_library("zstd"))
for function in (zstd.ZSTD_compress, zstd.ZSTD_decompress, zstd.ZSTD_compressBound):
    function.restype = ctypes.c_size_t


def packed(text):
    room = ctypes.create_string_buffer(zstd.ZSTD_compressBound(ctypes.c_size_t(len(text))))
    size = zstd.ZSTD_compress(room, ctypes.c_size_t(len(room)), text, ctypes.c_size_t(len(text)), 3)
    assert size <= len(room)
    return room.raw[:size]


def unpacked(frame):
    room = ctypes.create_string_buffer(64 << 20)
    size = zstd.ZSTD_decompress(room, ctypes.c_size_t(len(room)), frame, ctypes.c_size_t(len(frame)))
    assert size <= len(room), "that is no zstd frame"
    return room.raw[:size]
