"""Steer a wood-louse: one module, no dependencies, Python 3.9 or later.

    import woodlouse

    with woodlouse.connect("127.0.0.1:7777", name="uphill") as game:
        ground = game.map()
        for state in game.states():
            if state.me:
                game.thrust(ground.gradient(state.me.x, state.me.y))

The wire is documented in docs/protocol.md; this module hides lines, keys and deltas, nothing else.
Not thread safe: one thread per connection. Units: m, m/s, rad, ticks.
"""

import collections
import json
import math
import os
import select
import socket
import struct
import sys
import time

DEFAULT_ADDRESS = "127.0.0.1:7777"
HELD = 4294967295  # ticks_left of a thrust that holds until the next one
MAX_LINE_BYTES = 128 << 20
SILENCE_S = 15.0  # a server that says nothing for so long is gone


class WoodlouseError(Exception):
    """What went wrong; `code` is the server's (docs/protocol.md), or "connection", "protocol" or "differs" (a key
    that was verified)."""

    def __init__(self, code, text):
        super().__init__("%s: %s" % (code, text))
        self.code = code
        self.text = text


State = collections.namedtuple("State", "tick lice me")
State.__doc__ = """The world at `tick`. lice: {id: row}; a row has an attribute for each of the game's fields (row.x,
row.vx ...), in units. me: your own row; None for a spectator, and before your louse is on the map."""


class Ground:
    """The map's heights between its knots: Catmull-Rom, which goes through the knots and has a smooth gradient.

    The server's own surface is a spline through the same knots; near a knot both agree, between two knots they
    differ by a few per cent of the relief within the cell.
    """

    def __init__(self, name, origin, spacing, heights):
        self.name = name
        self.origin = origin
        self.spacing = spacing
        self.heights = heights  # heights[j][i]: row j from the south, column i from the west [m]
        self.columns = len(heights[0])
        self.rows = len(heights)
        self.extent = (origin[0], origin[1], origin[0] + (self.columns - 1) * spacing[0],
                       origin[1] + (self.rows - 1) * spacing[1])

    def height(self, x, y):
        """z at (x, y) [m]; outside the extent, at the nearest point of its rim."""
        return self._blend(x, y, _value, _value)

    def gradient(self, x, y):
        """(dz/dx, dz/dy) at (x, y): points uphill; its length is the slope."""
        return self._blend(x, y, _slope, _value) / self.spacing[0], self._blend(x, y, _value, _slope) / self.spacing[1]

    def summit(self):
        """(x, y, z) of the highest knot that is not on the rim."""
        z, j, i = max((self.heights[j][i], j, i) for j in range(1, self.rows - 1) for i in range(1, self.columns - 1))
        return self.origin[0] + i * self.spacing[0], self.origin[1] + j * self.spacing[1], z

    def _blend(self, x, y, along_x, along_y):
        i, u = _cell((x - self.origin[0]) / self.spacing[0], self.columns)
        j, v = _cell((y - self.origin[1]) / self.spacing[1], self.rows)
        weights = along_x(u)
        columns = [sum(w * self._knot(i + a, j + b) for a, w in enumerate(weights, -1)) for b in (-1, 0, 1, 2)]
        return sum(w * z for w, z in zip(along_y(v), columns))

    def _knot(self, i, j):
        # Past the rim the last two knots go on in a straight line.
        if i < 0:
            return 2 * self._knot(0, j) - self._knot(1, j)
        if i >= self.columns:
            return 2 * self._knot(self.columns - 1, j) - self._knot(self.columns - 2, j)
        if j < 0:
            return 2 * self.heights[0][i] - self.heights[1][i]
        if j >= self.rows:
            return 2 * self.heights[self.rows - 1][i] - self.heights[self.rows - 2][i]
        return self.heights[j][i]


def _cell(position, knots):
    position = min(max(position, 0.0), knots - 1.0)
    index = min(int(position), knots - 2)
    return index, position - index


def _value(t):
    return (-0.5 * t + t * t - 0.5 * t ** 3, 1 - 2.5 * t * t + 1.5 * t ** 3,
            0.5 * t + 2 * t * t - 1.5 * t ** 3, -0.5 * t * t + 0.5 * t ** 3)


def _slope(t):
    return (-0.5 + 2 * t - 1.5 * t * t, -5 * t + 4.5 * t * t, 0.5 + 4 * t - 4.5 * t * t, -t + 1.5 * t * t)


ALL_FIELDS = ["id", "phase", "x", "y", "vx", "vy", "heading_x", "heading_y", "tx", "ty", "flight_z", "flight_vz",
              "distance", "thrust_kind", "ticks_left"]
_LOUSE = struct.Struct("<II11dII")  # a louse's hashed record: ALL_FIELDS in this order
_64_BITS = (1 << 64) - 1


def state_hash(previous, inputs, tick, rows, generator):
    """The hash of a tick, as docs/determinism.md lays it out. rows: of all lice by ascending id, each ALL_FIELDS."""
    return xxh64(struct.pack("<QQQ", previous, inputs, tick) + b"".join(_LOUSE.pack(*row) for row in rows) +
                 struct.pack("<Q", generator))


def xxh64(data):
    """XXH64 with seed 0 of bytes."""
    p1, p2, p3, p4, p5 = (0x9E3779B185EBCA87, 0xC2B2AE3D27D4EB4F, 0x165667B19E3779F9, 0x85EBCA77C2B2AE63,
                          0x27D4EB2F165667C5)

    def rotated(value, bits):
        return (value << bits | value >> 64 - bits) & _64_BITS

    def lane(accumulator, word):
        return rotated((accumulator + word * p2) & _64_BITS, 31) * p1 & _64_BITS

    whole = len(data) & ~31  # stripes of 32 bytes, a word for each of four accumulators
    if whole:
        a, b, c, d = (p1 + p2) & _64_BITS, p2, 0, -p1 & _64_BITS
        for w, x, y, z in struct.iter_unpack("<4Q", data[:whole]):
            a, b, c, d = lane(a, w), lane(b, x), lane(c, y), lane(d, z)
        value = rotated(a, 1) + rotated(b, 7) + rotated(c, 12) + rotated(d, 18) & _64_BITS
        for accumulator in (a, b, c, d):
            value = ((value ^ lane(0, accumulator)) * p1 + p4) & _64_BITS
    else:
        value = p5
    value = value + len(data) & _64_BITS
    rest = data[whole:]
    for (word,) in struct.iter_unpack("<Q", rest[:len(rest) & ~7]):
        value = (rotated(value ^ lane(0, word), 27) * p1 + p4) & _64_BITS
    rest = rest[len(rest) & ~7:]
    if len(rest) >= 4:
        value = (rotated(value ^ int.from_bytes(rest[:4], "little") * p1 & _64_BITS, 23) * p2 + p3) & _64_BITS
        rest = rest[4:]
    for byte in rest:
        value = rotated(value ^ byte * p5 & _64_BITS, 11) * p1 & _64_BITS
    value = (value ^ value >> 33) * p2 & _64_BITS
    value = (value ^ value >> 29) * p3 & _64_BITS
    return value ^ value >> 32


def connect(address=DEFAULT_ADDRESS, name="louse", role="bot", room=None, fields=None, format="quantized", state_hz=None,
            verify=False):
    """Connects to HOST:PORT and joins. Raises WoodlouseError. Use it in a `with`: that leaves at the end.

    role: "bot", "player" or "spectator". fields: names of columns, or "all"; id x y vx vy when left out.
    state_hz: how many states a second; the room's own when left out.
    verify: recompute the hash of every key from its rows. Asks for all fields in exact format, so leave out `fields`
    and `format`; game.verified counts the keys, and one that differs raises WoodlouseError with the code "differs".
    """
    if verify:
        if fields is not None:
            raise ValueError("verify needs all fields: leave out `fields`")
        fields, format = "all", "exact"
    join = {"type": "join", "protocol": 1, "role": role, "name": name, "format": format}
    for field, value in (("room", room), ("fields", fields), ("state_hz", state_hz)):
        if value is not None:
            join[field] = value
    return Game(_open(address), join, verify)


def run(main):
    """Calls main(address) with the address of the command line; turns errors and Ctrl-C into a clean end."""
    arguments = sys.argv[1:]
    if len(arguments) > 1 or (arguments and arguments[0].startswith("-")):
        sys.exit("usage: %s [HOST:PORT]      (default %s)" % (sys.argv[0], DEFAULT_ADDRESS))
    try:
        main(arguments[0] if arguments else DEFAULT_ADDRESS)
    except WoodlouseError as error:
        sys.exit("%s: %s" % (sys.argv[0], error))
    except KeyboardInterrupt:
        sys.exit(130)
    except BrokenPipeError:  # who read our output has gone; Python would complain once more at the end
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        sys.exit(141)


def _open(address):
    host, colon, port = address.rpartition(":")
    if not colon or not port.isdigit() or not 0 < int(port) < 65536:
        raise WoodlouseError("connection", "the address %r is not HOST:PORT, as %s" % (address, DEFAULT_ADDRESS))
    try:
        connection = socket.create_connection((host.strip("[]") or "127.0.0.1", int(port)), timeout=10)
    except OSError as error:
        raise WoodlouseError("connection", "no server at %s (%s); start one: woodlouse-server --map maps/volcano.json"
                             % (address, error)) from None
    connection.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
    return connection


class Game:
    """A joined session. Attributes: id (your louse; 0 for a spectator), room, fields, tick_hz, state_hz, physics
    {gravity, drag, friction, thrust_max, edge_restitution}, extent (x_min, y_min, x_max, y_max), players
    {id: name}, hello and welcome as they came, last_ack, verified (how many keys were right; 0 unless asked to verify),
    and bye once the server said it."""

    def __init__(self, connection, join, verify=False):
        self._socket = connection
        self._socket.settimeout(SILENCE_S)
        self._bytes = bytearray()
        self._searched = 0
        self._seq = 0
        self._verifies = verify
        self.verified = 0
        self._key = None  # (tick, {id: row}) that deltas refer to
        self._resyncing = False
        self._ground = None
        self._pongs = {}
        self._rooms = None
        self._events = collections.deque(maxlen=1024)
        self._acks = collections.deque(maxlen=1024)
        self._state = None
        self.errors = collections.deque(maxlen=100)
        self.last_ack = None
        self.bye = None
        self.welcome = None
        self.players = {}
        try:
            self.hello = self._next("hello")
            self._send(join)
            while self.welcome is None:
                self._receive()
                if self.errors:
                    raise WoodlouseError(self.errors[0]["code"], self.errors[0]["text"])
        except BaseException:
            connection.close()
            raise

    def __enter__(self):
        return self

    def __exit__(self, *exception):
        self.close()

    def close(self):
        """Leaves; the louse goes with you."""
        try:
            if self.bye is None:
                self._send({"type": "leave"})
        except WoodlouseError:
            pass  # it is gone already, and so are we
        self._socket.close()

    # ---- what you see ----

    def states(self):
        """Yields a State for each frame, always the newest: one that came while you were thinking replaces those
        before it. Ends when the server says bye; raises WoodlouseError when the connection breaks."""
        while self.bye is None:
            self._state = None
            while self.bye is None and (self._state is None or self._waiting()):
                self._receive()
            if self._state is not None:
                yield self._state

    def map(self):
        """The Ground of this room; asked for once."""
        if self._ground is None:
            self._send({"type": "get_map"})
            self._until(lambda: self._ground is not None)
        return self._ground

    def rooms(self):
        """[{name, map, players, bots, spectators}] of the server."""
        self._rooms = None
        self._send({"type": "list"})
        self._until(lambda: self._rooms is not None)
        return self._rooms

    def take_events(self):
        """The events since the last call, oldest first: dicts with n, tick, kind (joined, left, chat, respawned), id, name."""
        return _drain(self._events)

    def take_acks(self):
        """The acks since the last call, oldest first: dicts with seq, tick, margin_us, late, dropped, clamped, you."""
        return _drain(self._acks)

    def ping(self):
        """The round-trip time [s]."""
        start = time.monotonic_ns() % (1 << 53)
        self._send({"type": "ping", "t": start})
        self._until(lambda: start in self._pongs)
        return (self._pongs.pop(start) - start) * 1e-9

    # ---- what you do ----

    def thrust(self, value, ticks=None, tick=None):
        """Pushes. A number in [-1, 1] drives along the heading (negative brakes); a pair (x, y) of length at most 1
        pushes in that direction of the map. 1 is physics["thrust_max"]. ticks: for how long; else until the next
        thrust. tick: the step that shall take it. Returns the seq that its ack will carry."""
        pair = isinstance(value, (tuple, list))
        numbers = [float(v) for v in value] if pair else [float(value)]
        if len(numbers) > 2 or (pair and len(numbers) != 2) or not all(map(math.isfinite, numbers)):
            raise ValueError("thrust is a finite number or a pair of them, not %r" % (value,))
        self._seq += 1
        message = {"type": "input", "seq": self._seq, "thrust": numbers if pair else numbers[0]}
        if ticks is not None:
            message["ticks"] = int(ticks)
        if tick is not None:
            message["tick"] = int(tick)
        self._send(message)
        return self._seq

    def chat(self, text):
        """Says something to everybody in the room."""
        self._send({"type": "chat", "text": text})

    def respawn(self):
        """Goes back to a spawn point."""
        self._send({"type": "respawn"})

    def on_error(self, error):
        """Called for each `error` of the server that does not end the session; override or assign it."""
        print("woodlouse: %s: %s" % (error.get("code"), error.get("text")), file=sys.stderr)

    # ---- the wire ----

    def _send(self, message):
        line = json.dumps(message, ensure_ascii=False, allow_nan=False, separators=(",", ":")) + "\n"
        try:
            self._socket.sendall(line.encode("utf-8", "replace"))
        except OSError as error:
            raise WoodlouseError("connection", "lost while sending (%s)" % error) from None

    def _waiting(self):
        """Whether something can be read without waiting."""
        return self._bytes.find(b"\n", self._searched) >= 0 or bool(select.select([self._socket], [], [], 0)[0])

    def _line(self):
        while True:
            end = self._bytes.find(b"\n", self._searched)
            if end >= 0:
                line = bytes(self._bytes[:end])
                del self._bytes[:end + 1]
                self._searched = 0
                return line
            self._searched = len(self._bytes)
            if self._searched > MAX_LINE_BYTES:
                raise WoodlouseError("protocol", "a line of more than %d bytes" % MAX_LINE_BYTES)
            try:
                chunk = self._socket.recv(1 << 16)
            except socket.timeout:
                raise WoodlouseError("connection", "the server said nothing for %g s" % SILENCE_S) from None
            except OSError as error:
                raise WoodlouseError("connection", "lost (%s)" % error) from None
            if not chunk:
                raise WoodlouseError("connection", "the server closed it")
            self._bytes += chunk

    def _message(self):
        line = self._line()
        try:
            message = json.loads(line)
            message["type"]
        except (ValueError, TypeError, KeyError):
            raise WoodlouseError("protocol", "not a message: %r" % line[:80]) from None
        return message

    def _next(self, kind):
        message = self._message()
        if message["type"] in ("error", "bye"):
            raise WoodlouseError(message.get("code", "error"), message.get("text", ""))
        if message["type"] != kind:
            raise WoodlouseError("protocol", "this is no woodlouse server: it began with %r" % message["type"])
        return message

    def _until(self, done):
        while not done():
            if self.bye is not None:
                raise WoodlouseError(self.bye.get("code", "bye"), self.bye.get("text", ""))
            self._receive()

    def _receive(self):
        message = self._message()
        handler = getattr(self, "_on_" + str(message["type"]), None)
        try:
            if handler:  # types of later versions are passed over
                handler(message)
        except (KeyError, TypeError, ValueError, IndexError) as error:
            raise WoodlouseError("protocol", "a %s out of shape (%s)" % (message["type"], error)) from None

    def _on_welcome(self, message):
        self.welcome = message
        self.id = message["id"]
        self.room = message["room"]
        self.tick_hz = message["tick_hz"]
        self.state_hz = message["state_hz"]
        self.fields = message["fields"]
        self.physics = message["physics"]
        self.extent = tuple(message["map"]["extent"])
        self.players = {player["id"]: player["name"] for player in message["players"]}
        self._row = collections.namedtuple("Louse", self.fields)
        self._quanta = [1 if quantum == 1 else quantum for quantum in message["quantum"]]

    def _rows(self, message):
        quanta, row = self._quanta, self._row._make
        rows = (row([value * quantum for value, quantum in zip(values, quanta)]) for values in message["louse"])
        return {louse.id: louse for louse in rows}

    def _on_key(self, message):
        if self._verifies:
            self._verify(message)
        self._key = (message["tick"], self._rows(message))
        self._resyncing = False
        self._show(message["tick"], self._key[1])

    def _verify(self, key):
        if self.fields != ALL_FIELDS:
            raise WoodlouseError("protocol", "the columns are %s, not those of the hash" % " ".join(self.fields))
        try:
            found = state_hash(int(key["previous"], 16), int(key["inputs"], 16), key["tick"], key["louse"],
                               int(key["generator"], 16))
        except struct.error as error:
            raise WoodlouseError("protocol", "a key out of shape (%s)" % error) from None
        if "%016x" % found != key["hash"]:
            raise WoodlouseError("differs", "the key of tick %d says %s, its rows give %016x"
                                 % (key["tick"], key["hash"], found))
        self.verified += 1

    def _on_delta(self, message):
        if self._key is None or self._key[0] != message["base"]:
            if not self._resyncing:
                self._resyncing = True
                self._send({"type": "resync"})
            return
        lice = dict(self._key[1])
        for louse in message.get("gone", ()):
            lice.pop(louse, None)
        lice.update(self._rows(message))
        self._show(message["tick"], lice)

    def _show(self, tick, lice):
        self._state = State(tick, lice, lice.get(self.id))

    def _on_ack(self, message):
        self.last_ack = message
        self._acks.append(message)

    def _on_event(self, message):
        if message["kind"] == "joined":
            self.players[message["id"]] = message["name"]
        elif message["kind"] == "left":
            self.players.pop(message["id"], None)
        self._events.append(message)

    def _on_error(self, message):
        if message["fatal"]:
            raise WoodlouseError(message["code"], message["text"])
        self.errors.append(message)
        if self.welcome is not None:
            self.on_error(message)

    def _on_bye(self, message):
        self.bye = message
        if self.welcome is None:
            raise WoodlouseError(message["code"], message["text"])

    def _on_map(self, message):
        knots = message.get("knots") or message["definition"]["terrain"]
        self._ground = Ground(message["name"], knots["origin"], knots["spacing"], knots["heights"])

    def _on_rooms(self, message):
        self._rooms = message["rooms"]

    def _on_ping(self, message):
        self._send({"type": "pong", "t": message["t"]})

    def _on_pong(self, message):
        self._pongs[message["t"]] = time.monotonic_ns() % (1 << 53)
        while len(self._pongs) > 16:
            del self._pongs[next(iter(self._pongs))]


def _drain(queue):
    items = list(queue)
    queue.clear()
    return items
