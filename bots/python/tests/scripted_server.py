"""For the tests: a server that says what a test wants, on a real socket."""

import json
import socket
import threading

HELLO = {"type": "hello", "protocol": 1, "behavior": 1, "server": "scripted", "session": "1", "rooms": ["a"],
         "features": [], "limits": {"line": 4096}}
WELCOME = {"type": "welcome", "id": 2, "resume_token": "", "room": "a", "tick": 5, "tick_hz": 60, "state_hz": 20,
           "fields": ["id", "x", "y", "vx", "vy"], "quantum": [1, 0.5, 0.5, 0.25, 0.25], "format": "quantized",
           "map": {"name": "a", "hash": "0123456789abcdef", "extent": [-1, -2, 3, 4], "bytes": 10},
           "physics": {"gravity": 9.81, "drag": 0.2, "friction": 0.05, "thrust_max": 4, "edge_restitution": 0.5},
           "mode": "roam", "players": [{"id": 1, "name": "ann", "role": "bot"}]}
KEY = {"type": "key", "tick": 60, "louse": [[1, 10, 20, 0, 0], [2, -4, 6, 8, -8]], "hash": "00000000000000ff"}
BYE = {"type": "bye", "code": "shutdown", "text": "enough", "resumable": False}


class Scripted:
    """Listens, and plays script(send, receive) for the first who connects, of several scripts one after the other; the
    connection ends with its script. send takes messages or raw bytes."""

    def __init__(self, *scripts, chunk=None):
        self._scripts = scripts
        self._chunk = chunk
        self._listener = socket.create_server(("127.0.0.1", 0))
        self.address = "127.0.0.1:%d" % self._listener.getsockname()[1]
        self.failure = None
        self._thread = threading.Thread(target=self._serve, daemon=True)

    def __enter__(self):
        self._thread.start()
        return self

    def __exit__(self, *exception):
        self._thread.join(10)
        self._listener.close()
        if self.failure and exception[0] is None:
            raise self.failure

    def _serve(self):
        try:
            for script in self._scripts:
                self._play(script)
        except Exception as failure:
            self.failure = failure

    def _play(self, script):
        connection, _ = self._listener.accept()
        connection.settimeout(10)
        connection.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        with connection, connection.makefile("rb") as lines:
            def send(*messages):
                for message in messages:
                    line = message if isinstance(message, bytes) else json.dumps(message).encode() + b"\n"
                    step = self._chunk or max(1, len(line))
                    for begin in range(0, len(line), step):
                        connection.sendall(line[begin:begin + step])

            try:
                script(send, lambda: json.loads(lines.readline()))
            except (BrokenPipeError, ConnectionResetError):
                pass  # the client had seen enough: what it makes of it is for the test to judge


def joined(then, chunk=None):
    """A scripted server that takes a join and goes on with then(send, receive)."""
    def script(send, receive):
        send(HELLO)
        assert receive()["type"] == "join"
        send(WELCOME)
        then(send, receive)
    return Scripted(script, chunk=chunk)


def expect(receive, **fields):
    message = receive()
    for name, value in fields.items():
        assert message.get(name) == value, "%r is not %s=%r" % (message, name, value)
    return message
