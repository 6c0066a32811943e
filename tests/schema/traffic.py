"""Servers under play in every mode, and every line that they and their players say to each other held against the schemas.

    WOODLOUSE_SERVER=.. WOODLOUSE_CODEC=.. WOODLOUSE_MAPS=.. WOODLOUSE_SOURCE_DIR=.. python3 traffic.py SECONDS

plays for so long (an hour: 3600) and says what it saw; the exit code is 1 where a line did not fit. traffic_test.py does so for a
second or two. WOODLOUSE_CODEC is not asked.
"""

import collections
import json
import os
import random
import sys
import tempfile
import time

from schemas import SOURCE, faults, row_schema, validator

sys.path.insert(0, str(SOURCE / "tests" / "e2e" / "server"))
import wire  # noqa: E402  (it stands with the tests that use it most)

SENT, CAME, LINES = validator("client"), validator("server"), validator("recording")
FLAT = [[0] * 9 for _ in range(5)]
# Level ground that wraps: a push of a second laps it, so that runs and records come soon.
RING = {
    "name": "ring",
    "terrain": {"spacing": 5, "heights": FLAT},
    "edges": "wrap",
    "physics": {"drag": 0, "friction": 0, "thrust_max": 60},
    "spawns": [{"position": [-16, 1]}, {"position": [-17, -1]}],
    "race": {"laps": 1, "gates": [{"a": [-15, 4], "b": [-15, -4]}, {"a": [0, 4], "b": [0, -4]}], "round_s": 3, "podium_s": 1},
    # What is small has more bumps, falls and crumbs a second.
    "hill": {"places": [{"at": [-14, 0], "radius": 3}, {"at": [0, 0]}], "hold_s": 2, "move_s": 6},
    "forage": {"crumbs": 64, "radius": 3, "round_s": 4, "podium_s": 1},
}
BAD = [  # refused for what they are, whenever they come
    {"type": "input", "seq": -1, "thrust": 1}, {"type": "input", "seq": "1", "thrust": 1}, {"type": "input", "thrust": 1},
    {"type": "input", "seq": 1, "thrust": [1, 2, 3]}, {"type": "input", "seq": 1, "thrust": None}, {"type": "input", "seq": 1, "thrust": 1, "ticks": 0},
    {"type": "chat"}, {"type": "chat", "text": 5}, {"type": "chat", "text": ""}, {"type": "respawn", "at": "home"}, {"type": "ping"},
    {"type": "ping", "t": "now"}, {"type": "get_ghost", "rank": 0}, {"type": "get_ghost", "rank": 101}, {"type": "list_records", "board": "cats"},
    {"type": "none"}, {"type": 7}, {}, {"type": "join", "protocol": 1, "name": "x", "role": "king"}, {"type": "join", "protocol": 1, "name": 5},
    {"type": "join", "protocol": 1, "name": "x", "state_hz": 0}, {"type": "join", "protocol": 1, "name": "x", "fields": ["x", "x"]},
    {"type": "join", "protocol": 1, "name": "x", "fields": "some"}, {"type": "join", "protocol": 1, "name": "x", "resume": 1},
    [], 7, "text", None,
]
STRUCTURAL = {"bad_field", "missing_field", "unknown_type", "not_an_object", "bad_json"}


class Seen:
    """What was said, counted by kind, and what did not fit."""

    def __init__(self):
        self.counts = collections.Counter()
        self.faults = []
        self.refusals = collections.Counter()

    def note(self, side, kind, wrong, message):
        self.counts[f"{side} {kind}"] += 1
        if wrong and len(self.faults) < 20:
            self.faults.append(f"{side}: {wrong[0]} in {json.dumps(message)[:500]}")


class Witness(wire.Client):
    """A client whose every line either way is held against the schemas, rows by the columns of its welcome."""

    def __init__(self, seen, server):
        super().__init__(server.host, server.port)
        self.witness = seen
        self.row = None

    def send(self, *messages):
        for message in messages:
            self.witness.note("client", message["type"], faults(SENT, message), message)
        super().send(*messages)

    def look(self, message):
        if "type" not in message:  # of who watches by inputs
            kind = "header" if "format" in message else next(iter(message))
            self.witness.note("stream", kind, faults(LINES, message), message)
            message["type"] = kind
            return
        kind = message["type"] + (" " + message["kind"] if message["type"] == "event" else "")
        wrong = faults(CAME, message)
        if message["type"] == "welcome":
            self.row = validator("row", row_schema(message["fields"], message["format"]))
            self.rows, self.key = {}, None
        elif message["type"] in ("key", "delta"):
            wrong += [f for row in message["louse"] for f in faults(self.row, row)]
        elif message["type"] == "error":
            self.witness.refusals[message["code"]] += 1
        self.witness.note("server", kind, wrong, message)

    def drain(self):
        """Takes what has come, without waiting for more."""
        self.socket.settimeout(0.001)
        try:
            while self.receive() is not None:
                pass
        except (TimeoutError, BlockingIOError):
            pass
        finally:
            self.socket.settimeout(wire.PATIENCE)
        del self.seen[:]


def bad_lines(seen, server):
    """Each bad line is refused by the server for its shape, and by the schema. One connection a few: many are a flood."""
    for first in range(0, len(BAD), 8):
        with Witness(seen, server) as client:
            client.expect("hello")
            for line in BAD[first:first + 8]:
                client.send_bytes(json.dumps(line).encode() + b"\n")
                code = client.expect("error")["code"]
                if code not in STRUCTURAL:
                    seen.faults.append(f"the server says {code} to {line}")
                if not faults(SENT, line):
                    seen.faults.append(f"the server refuses, and the schema takes {line}")
            client.send_bytes(b'{"type":"li\n')
            client.expect("error", code="bad_json")
            client.send({"type": "leave"})
            client.expect("bye")


def ask(client, draw, seq):
    """Something that a player may do; the next seq."""
    what = draw.randrange(17)
    if what == 0:
        client.send({"type": "chat", "text": draw.choice(["hello", "Grüße", "\\ \" 日本", "x" * 500])})
    elif what == 1:
        client.send({"type": draw.choice(["list", "get_map", "resync"])})
    elif what == 2:
        client.send({"type": "respawn", **draw.choice([{}, {"at": "gate"}, {"at": "spawn"}])})
    elif what == 3:
        client.send({"type": "list_records", "board": draw.choice(["people", "bots", "handed_in"])}, {"type": "get_ghost"})
    elif what == 4:
        client.send({"type": "ping", "t": draw.randrange(-2**53, 2**53)}, {"type": "pong", "t": 1})
    elif what == 5:
        client.send({"type": "input", "seq": 0, "thrust": 1})  # stale
    elif what == 6:
        client.send({"type": "input", "seq": seq, "thrust": 1, "tick": 2**53})  # too far
    elif what == 7:
        client.send({"type": "skip"})
    elif what == 8:
        client.send({"type": "view", **draw.choice([{}, {"rows": 2}, {"radius": 3.5}, {"x": -3, "y": 2.5, "rows": 1}, {"louse": 3, "radius": 9}])})
    else:
        thrust = draw.choice([draw.uniform(-3, 3), [draw.uniform(-2, 2), draw.uniform(-2, 2)], 1, [1, 0], [1, 0]])
        more = draw.choice([{}, {"ticks": draw.randrange(1, 90)}, {"tick": 0}])
        client.send({"type": "input", "seq": seq, "thrust": thrust, **more})
        return seq + 1
    return seq


def ask_all(racer, forager, turner, watcher):
    """Each thing once, with its answer; and what a round brings."""
    racer.send({"type": "chat", "text": "hello"}, {"type": "list"}, {"type": "get_map"}, {"type": "resync"}, {"type": "ping", "t": 5},
               {"type": "pong", "t": 1}, {"type": "respawn"}, {"type": "list_records"}, {"type": "get_ghost", "rank": 100},
               {"type": "input", "seq": 1, "thrust": 1, "tick": 2**53}, {"type": "input", "seq": 2, "thrust": 1}, {"type": "input", "seq": 2, "thrust": 1})
    waited = {"ack", "stale_seq", "too_far", "no_records", "rooms", "map", "pong", "records", "chat", "respawned"}
    while waited:
        message = racer.receive()
        waited -= {message["type"], message.get("kind"), message.get("code")}
    watcher.send({"type": "input", "seq": 1, "thrust": 1})
    watcher.expect("error", code="no_louse")
    turner.send({"type": "skip"})
    turner.expect("event", kind="skip")
    turner.expect("welcome")
    forager.expect("event", kind="round", phase="play")
    forager.expect("event", kind="crumb")


JOINS = [  # in turn
    {"role": "player"}, {"role": "player", "resume": True, "fields": "all", "format": "exact"}, {"role": "spectator"},
    {"role": "bot", "fields": ["x", "y", "z", "yaw", "pitch", "roll", "speed", "score", "gate", "lap", "lap_start", "best_lap"], "state_hz": 10,
     "view": {"rows": 2}},
    {"role": "player", "fields": ["tx", "ty", "thrust_kind", "ticks_left", "phase", "distance"], "format": "exact"},
    {"role": "spectator", "fields": "all", "format": "exact", "state_hz": 1},
    {"role": "spectator", "stream": "inputs", "state_hz": 20},
]


def play(seen, seconds, folder, seed=1):
    """Games in every mode for so long, in rounds of at most half a minute."""
    draw = random.Random(seed)
    with open(os.path.join(folder, "ring.json"), "w") as file:
        json.dump(RING, file)
    ring = os.path.join(folder, "ring")
    end = time.monotonic() + seconds
    while True:
        games = dict(maps=(ring, "table", "volcano", "kepler"))
        options = ("--bots", "3", "--bots-skill", "hard", "--ping-s", "1", "--state-hz", "10", "--per-address", "100")
        stored = ("--records", os.path.join(folder, "records"), "--record", os.path.join(folder, "{room}.ndjson"))
        with wire.Server(*options, *stored, **games) as rooms, wire.Server("--rotate", "1", *options, maps=(ring, "table")) as turns:
            bad_lines(seen, rooms)
            clients = []
            for k, room in enumerate(["ring/race", "ring/forage", "ring/hill", "table/hill", "volcano", "kepler", ""] * 2):
                client = Witness(seen, rooms if room else turns)
                client.join(f"player {k}", **JOINS[(k + k // 7) % len(JOINS)], **({"room": room} if room else {}))
                clients.append([client, 3])
            asked = [next(client for client, _ in clients if client.welcome["room"] == room and client.id) for room in
                     ("ring/race", "ring/forage", "rotation")]
            ask_all(*asked, next(client for client, _ in clients if not client.id))
            until = max(min(end, time.monotonic() + 30), time.monotonic() + 1)
            while time.monotonic() < until:
                for entry in clients:
                    entry[1] = ask(entry[0], draw, entry[1])
                    entry[0].drain()
                time.sleep(0.02)
            # Away without a word and back by the token; then one leaves, and the server ends the others.
            lost = next(client for client, _ in clients if client.welcome["resume_token"])
            token, room = lost.welcome["resume_token"], lost.welcome["room"]
            lost.socket.close()
            back = Witness(seen, turns if room == "rotation" else rooms)
            back.join("player 1", room=room, resume=token)
            clients = [entry for entry in clients if entry[0] is not lost] + [[back, 3]]
            back.send({"type": "leave"})
            back.expect("bye", code="left")
            rooms.stop()
            turns.stop()
            for client, _ in clients:
                client.until_end(patience=300)  # all that it was sent and we have not looked at yet
                client.socket.close()
        for name in sorted(os.listdir(folder)):
            if not name.endswith(".ndjson"):
                continue
            with open(os.path.join(folder, name)) as file:
                for line in map(json.loads, file):
                    kind = "header" if "format" in line else next(iter(line))
                    seen.note("recording", kind, faults(LINES, line), line)
            os.remove(os.path.join(folder, name))
        for name in os.listdir(os.path.join(folder, "records")):
            with open(os.path.join(folder, "records", name)) as file:
                for line in list(map(json.loads, file))[1:]:
                    seen.note("board", line["type"], faults(CAME, line), line)
        if time.monotonic() >= end:
            return


def main(seconds):
    seen = Seen()
    with tempfile.TemporaryDirectory() as folder:
        play(seen, seconds, folder, seed=random.randrange(2**32))
    for name, count in sorted(seen.counts.items()):
        print(f"{count:9} {name}")
    print(f"refused: {dict(seen.refusals)}")
    print("\n".join(seen.faults) or f"{sum(seen.counts.values())} lines, all as the schemas say")
    return 1 if seen.faults else 0


if __name__ == "__main__":
    sys.exit(main(float(sys.argv[1])))
