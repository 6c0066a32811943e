"""Steer a wood-louse: no dependencies, Python 3.9 or later. Take this file and the woodlouse_*.py beside it.

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
import math
import os
import sys
import time

from woodlouse_door import Door
from woodlouse_frames import Frames
from woodlouse_ground import Ground, complete
from woodlouse_lines import DEFAULT_ADDRESS, MAX_LINE_BYTES, SILENCE_S, WoodlouseError
from woodlouse_proof import ALL_FIELDS, prove, state_hash, xxh64
from woodlouse_rules import DEFAULT_FIELDS, MOMENTS_PER_TICK, Crumb, Round, Standing, with_standing
from woodlouse_session import Session

__all__ = ["ALL_FIELDS", "Crumb", "DEFAULT_ADDRESS", "Game", "Ground", "HELD", "MAX_LINE_BYTES", "Round", "SILENCE_S",
           "Standing", "State", "WoodlouseError", "connect", "run", "state_hash", "xxh64"]

HELD = 4294967295  # ticks_left of a thrust that holds until the next one

State = collections.namedtuple("State", "tick lice me")
State.__doc__ = """The world at `tick`. lice: {id: row}; a row has an attribute for each of the game's fields (row.x,
row.vx ...), in units. me: your own row; None for a spectator, and before your louse is on the map."""


def connect(address=DEFAULT_ADDRESS, name="louse", role="bot", room=None, fields=None, format="quantized", state_hz=None,
            verify=False, resume=True, view=None, token=None, stream="frames"):
    """Connects to HOST:PORT, or HOST:PORT/ROOM, and joins. Raises WoodlouseError. Use it in a `with`: that leaves at the
    end.

    role: "bot", "player" or "spectator". fields: names of columns, or "all"; id x y vx vy when left out. A server with rules
    of play is asked for those of a Standing besides, but with "all", for game.score and the like; rows don't show them.
    state_hz: how many states a second; the room's own when left out.
    view: states show a part of the room: a dict of what look() takes, as {"rows": 30} for your own louse and those next to
    it. Left out: everybody.
    verify: recompute the hash of every key from its rows. Asks for all fields in exact format, so leave out `fields`
    and `format`; game.verified counts the keys, and one that differs raises WoodlouseError with the code "differs".
    resume: where the connection breaks, come back within 60 s, into the louse if it has waited (30 s, of a server left as it
    is), and where the room moves to another server, go on there; what is sent meanwhile is dropped. That is what a loop over
    states() is written for, so it is the default; with False a broken connection raises WoodlouseError, and the louse goes
    with it.
    token: a password, where the server has some.
    stream: "inputs", of a spectator: the room's recording instead of states; take recorded() then, not states().
    """
    if verify:
        if fields is not None:
            raise ValueError("verify needs all fields: leave out `fields`")
        fields, format = "all", "exact"
    address, _, of_address = address.partition("/")
    room = room or of_address or None
    join = {"type": "join", "protocol": 1, "role": role, "name": name, "format": format}
    if verify and view is not None:
        raise ValueError("verify needs all lice: leave out `view`")
    for field, value in (("room", room), ("fields", fields), ("state_hz", state_hz), ("view", view),
                         ("token", token), ("stream", None if stream == "frames" else stream)):
        if value is not None:
            join[field] = value
    return Game(Door(address, join, resume, with_standing(fields)), name, verify, fields)


def run(main):
    """Calls main(address) with the address of the command line; turns errors and Ctrl-C into a clean end."""
    arguments = sys.argv[1:]
    if len(arguments) > 1 or (arguments and arguments[0].startswith("-")):
        sys.exit("usage: %s [HOST:PORT[/ROOM]]      (default %s)" % (sys.argv[0], DEFAULT_ADDRESS))
    try:
        main(arguments[0] if arguments else DEFAULT_ADDRESS)
    except WoodlouseError as error:
        sys.exit("%s: %s" % (sys.argv[0], error))
    except KeyboardInterrupt:
        sys.exit(130)
    except BrokenPipeError:  # who read our output has gone; Python would complain once more at the end
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        sys.exit(141)


class Game(Session):
    """A joined session. Attributes: id (your louse; 0 for a spectator), name (yours here: "ann#2" where there was an ann),
    room, fields, tick_hz, state_hz, extent (x_min, y_min, x_max, y_max) [m], players {id: name} of who has a louse,
    spectators [name] of who has none (of a former server; today's counts them: welcome["spectators"], rooms()), hello and
    welcome as they came, last_ack, verified (how many keys were right; 0 unless asked to verify), comebacks (how often
    the connection broke and came back; welcome["resumed"] is true where it came back to its louse, else id is another),
    games (how many it is in since it joined: some rooms play several in turns, and each is as if it had joined anew; only
    seqs go on), and bye once the server said it.

    What is played: mode ("roam", "race", "forage", "hill"), rules (the mode as the map has it, its defaults filled in:
    rules["gates"], rules["places"] ...; {} in roam), round (the newest Round; None in roam and before the first state),
    standings {id: Standing} of all lice on the map, and score, gate, lap, lap_start, best_lap as the own one has them, or
    had them while it is out. These five are None before the louse is on the map and for a spectator; they, and standings
    {}, also of a server that knows no rules, and where "all" columns were asked for.

    physics: gravity [m/s^2], drag [1/s], friction (Coulomb's), thrust_max [m/s^2], edge_restitution (0 to 1); equations
    ("exact", "local_plane", "as_printed"), method ("standard", "cheap", "precise", "false_euler"), contact ("bilateral",
    "unilateral"), edges ("walls", "wrap", "open"), central_gravity (k of k / r^2 [m^3/s^2]; 0: none), core_radius (within
    which that pull is smooth [m]; 0 where there is none), tolerance (how far astray its steps may lead [m/s of play]; 0:
    no step asks). Of a server that does not send the last seven they are there once map() has asked for the map, from its definition."""

    def __init__(self, door, name, verify=False, fields=None):
        super().__init__(door)
        self.name = name
        self._verifies = verify
        self._wanted = fields
        self.verified = 0
        self._ground = None
        self._pongs = {}
        self._rooms = None
        self._events = collections.deque(maxlen=1024)
        self._acks = collections.deque(maxlen=1024)
        self._state = None
        self.errors = collections.deque(maxlen=100)
        self.last_ack = None
        self.welcome = None
        self.games = 0
        self._welcomed_on = None
        self.players = {}
        self.spectators = []
        self._begin(*door.enter())

    def __enter__(self):
        return self

    def __exit__(self, *exception):
        self.close()

    # ---- what you see ----

    def states(self):
        """Yields a State for each frame, always the newest: one that came while you were thinking replaces those
        before it. Ends when the server says bye, and when the room begins another game (games): call it again, and map(), for
        that. Goes on over breaks of the connection that it comes back from, and raises WoodlouseError at others."""
        games = self.games
        while self.bye is None and self.games == games:
            self._state = None
            while self.bye is None and self.games == games and (self._state is None or self._lines.waiting()):
                self._receive()
            if self._state is not None and self.games == games:
                yield self._state

    def map(self):
        """The Ground of what the room plays; asked for once a map."""
        if self._ground is None:
            self._ask({"type": "get_map"}, lambda: self._ground is not None)
        return self._ground

    def rooms(self):
        """[{name, map, players, bots, spectators, code}] of the server and, with the address where they are, of its cluster's
        others. connect(room=...) takes a name or a code, and follows to where the room is. A former server tells no codes."""
        self._rooms = None
        self._ask({"type": "list"}, lambda: self._rooms is not None)
        return self._rooms

    def take_events(self):
        """The events since the last call, oldest first: dicts with n, tick, kind (joined, left, chat, respawned, skip), id
        (0 for each spectator: the name tells them apart), name. Those of rules of play (gate, lap, run, crumb, harvest,
        bump, holds, contested, moving, fell, returned, round) have moment and the fields of docs/protocol.md besides."""
        return _drain(self._events)

    def take_acks(self):
        """The acks since the last call, oldest first: dicts with seq, tick, margin_us, late, dropped, clamped, you."""
        return _drain(self._acks)

    def seconds_of(self, moments):
        """Of a time that rules tell, [s]."""
        return moments / MOMENTS_PER_TICK / self.tick_hz

    score = property(lambda self: self._standing and self._standing.score)
    gate = property(lambda self: self._standing and self._standing.gate)
    lap = property(lambda self: self._standing and self._standing.lap)
    lap_start = property(lambda self: self._standing and self._standing.lap_start)
    best_lap = property(lambda self: self._standing and self._standing.best_lap)

    def ping(self):
        """The round-trip time [s]."""
        start = time.monotonic_ns() % (1 << 53)
        self._ask({"type": "ping", "t": start}, lambda: start in self._pongs)
        return (self._pongs.pop(start) - start) * 1e-9

    # ---- what you do ----

    def thrust(self, value, ticks=None, tick=None):
        """Pushes. A pair (x, y) of length at most 1 pushes along the ground's tangent over that direction of the map; a
        number above 0, at most 1, over the heading, which meanwhile turns into the velocity's direction within some 0.3 m
        of way, and is where the louse looks while it stands; a number below 0, at least -1, brakes. 1 is
        physics["thrust_max"], in space: on a slope less of it is seen on the map (bots/README.md). ticks: for how long;
        else until the next thrust. tick: the step that shall take it. Returns the seq that its ack will carry; they
        begin anew with each comeback."""
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

    def look(self, x=None, y=None, louse=None, radius=None, rows=None):
        """What states show from now on, or where they showed everybody within a second: lice around (x, y), or around that
        louse, or around your own; within `radius` [m] of it; at most `rows`, the nearest. Without arguments everybody."""
        view = {"x": x, "y": y, "louse": louse, "radius": radius, "rows": rows}
        view = {field: value for field, value in view.items() if value is not None}
        self._door.look(view)
        self._send(dict(view, type="view"))

    def skip(self):
        """Votes for the room's next game, if it plays several in turns; players may, bots not."""
        self._send({"type": "skip"})

    def chat(self, text):
        """Says something to everybody in the room."""
        self._send({"type": "chat", "text": text})

    def respawn(self, at=None):
        """Goes back to a spawn point; in a race with at="gate" to where you drove through your last gate, as fast as then:
        the run is practice from there on."""
        self._send({"type": "respawn"} if at is None else {"type": "respawn", "at": at})

    def on_error(self, error):
        """Called for each `error` of the server that does not end the session; override or assign it."""
        print("woodlouse: %s: %s" % (error.get("code"), error.get("text")), file=sys.stderr)

    def on_lost(self, error):
        """Called when the connection broke, before it comes back; override or assign it."""
        print("woodlouse: %s: coming back" % error, file=sys.stderr)

    def on_comeback(self):
        """Called when it is back; override or assign it."""
        back = "back in louse %d" if self.welcome.get("resumed") else "back, in a new louse, %d"
        print("woodlouse: " + (back % self.id if self.id else "watching again") + self.whereabouts(), file=sys.stderr)

    # ---- the wire ----

    def _on_welcome(self, message):
        self._lines.has_recording = message.get("stream") == "inputs"
        before, is_comeback = self.welcome, self._lines is not self._welcomed_on
        if before is None or before["map"]["hash"] != message["map"]["hash"]:
            self._ground, self.physics = None, dict(message["physics"])
        if is_comeback:
            self._seq, self._welcomed_on = 0, self._lines
        if before is None or not is_comeback or before["map"]["hash"] != message["map"]["hash"] or before.get("mode") != message.get("mode"):
            self.games += 1
        self._resyncing, self._state = False, None
        self.welcome = message
        self.id = message["id"]
        self.name = message.get("name", self.name)
        self.room = message["room"]
        self.tick_hz = message["tick_hz"]
        self.state_hz = message["state_hz"]
        self.fields = self._columns(message["fields"])
        self.mode, self.rules = message.get("mode", "roam"), message.get("rules") or {}
        self.round, self.standings, self._standing = None, {}, None
        self.extent = tuple(message["map"]["extent"])
        # All spectators have the id 0, which therefore names none of them.
        self.players = {player["id"]: player["name"] for player in message["players"] if player["id"]}
        if self.id and "name" in message:
            self.players[self.id] = self.name
        self.spectators = [player["name"] for player in message["players"] if not player["id"]]
        self._frames = Frames(message["fields"], message["quantum"], self.fields)

    def _columns(self, fields):
        """Those of the columns that were asked for, where they are there: a room with many choices may send more."""
        asked = fields if self._wanted == "all" else list(DEFAULT_FIELDS if self._wanted is None else self._wanted)
        asked = ["id"] + [field for field in asked if field != "id"]
        return asked if set(asked) <= set(fields) else fields

    def _on_key(self, message):
        if self._verifies:
            prove(message, self.fields)
            self.verified += 1
        self._resyncing = False
        self._show(message["tick"], self._frames.key(message))

    def _on_delta(self, message):
        frame = self._frames.delta(message)
        if frame is not None:
            return self._show(message["tick"], frame)
        if not self._resyncing:
            self._resyncing = True
            self._send({"type": "resync"})

    def _show(self, tick, frame):
        self.round, self.standings = frame.round, frame.standings
        self._standing = frame.standings.get(self.id, self._standing)
        self._state = State(tick, frame.lice, frame.lice.get(self.id))

    def _on_ack(self, message):
        self.last_ack = message
        self._acks.append(message)

    def _on_event(self, message):
        who, name = message["id"], message["name"]
        if message["kind"] == "joined":
            if who:
                self.players[who] = name
            else:
                self.spectators.append(name)
        elif message["kind"] == "left":
            if who:
                self.players.pop(who, None)
            elif name in self.spectators:
                self.spectators.remove(name)
        self._events.append(message)

    def _on_error(self, message):
        if message["fatal"]:
            raise WoodlouseError(message["code"], message["text"], address=message.get("address", ""))
        self.errors.append(message)
        self.on_error(message)

    def _on_map(self, message):
        definition = message["definition"]
        knots = message.get("knots") or definition["terrain"]
        complete(self.physics, definition)
        self._ground = Ground(message["name"], knots["origin"], knots["spacing"], knots["heights"],
                              self.physics["edges"] == "wrap", definition, message.get("overview", False))

    def _on_rooms(self, message):
        self._rooms = message["rooms"]

    def _on_pong(self, message):
        self._pongs[message["t"]] = time.monotonic_ns() % (1 << 53)
        while len(self._pongs) > 16:
            del self._pongs[next(iter(self._pongs))]


def _drain(queue):
    items = list(queue)
    queue.clear()
    return items
