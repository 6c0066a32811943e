"""woodlouse.py against a scripted server on a socket: python3 -m unittest test_woodlouse"""

import contextlib
import io
import json
import math
import os
import socket
import struct
import sys
import threading
import unittest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import woodlouse

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
    """Listens, and plays script(send, receive) for the first who connects. send takes messages or raw bytes."""

    def __init__(self, script, chunk=None):
        self._script = script
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

                self._script(send, lambda: json.loads(lines.readline()))
        except Exception as failure:
            self.failure = failure


def joined(then, chunk=None):
    """A scripted server that takes a join and goes on with then(send, receive)."""
    def script(send, receive):
        send(HELLO)
        assert receive()["type"] == "join"
        send(WELCOME)
        then(send, receive)
    return Scripted(script, chunk)


def expect(receive, **fields):
    message = receive()
    for name, value in fields.items():
        assert message.get(name) == value, "%r is not %s=%r" % (message, name, value)
    return message


class Joining(unittest.TestCase):
    def test_a_join_carries_what_was_asked_for_and_leaves_out_the_rest(self):
        seen = []

        def script(send, receive):
            send(HELLO)
            seen.append(receive())
            send(WELCOME)
            expect(receive, type="leave")

        with Scripted(script) as server:
            with woodlouse.connect(server.address, name="x", fields=["z"], state_hz=10) as game:
                self.assertEqual(game.id, 2)
                self.assertEqual(game.extent, (-1, -2, 3, 4))
                self.assertEqual(game.players, {1: "ann"})
        self.assertEqual(seen, [{"type": "join", "protocol": 1, "role": "bot", "name": "x", "format": "quantized",
                                 "fields": ["z"], "state_hz": 10}])

    def test_a_refused_join_raises_with_the_servers_code(self):
        def script(send, receive):
            send(HELLO)
            receive()
            send({"type": "error", "code": "unknown_room", "text": "rooms: a", "fatal": False})

        with Scripted(script) as server:
            with self.assertRaises(woodlouse.WoodlouseError) as caught:
                woodlouse.connect(server.address, room="b")
        self.assertEqual(caught.exception.code, "unknown_room")

    def test_another_kind_of_server_is_recognised(self):
        for greeting in (b"SSH-2.0-x\r\n", b'{"type":"welcome"}\n', b"[]\n", b"\xff\n"):
            with Scripted(lambda send, receive: send(greeting)) as server:
                with self.assertRaises(woodlouse.WoodlouseError) as caught:
                    woodlouse.connect(server.address)
                self.assertEqual(caught.exception.code, "protocol")

    def test_nobody_listening_and_bad_addresses_are_told_plainly(self):
        with socket.create_server(("127.0.0.1", 0)) as free:
            port = free.getsockname()[1]
        for address in ("127.0.0.1:%d" % port, "nowhere", "localhost:http", "localhost:0"):
            with self.assertRaises(woodlouse.WoodlouseError) as caught:
                woodlouse.connect(address)
            self.assertEqual(caught.exception.code, "connection")


class Seeing(unittest.TestCase):
    def states(self, *messages, chunk=None):
        """The state after each message; the next is sent when this one was seen."""
        def then(send, receive):
            for message in messages:
                send(message)
                expect(receive, type="chat")
            send(BYE)

        with joined(then, chunk) as server:
            game = woodlouse.connect(server.address)
            seen = []
            for state in game.states():
                seen.append(state)
                game.chat("next")
            game.close()
            self.assertEqual(game.bye["code"], "shutdown")
        return seen

    def test_rows_come_in_units_by_their_names(self):
        state, = self.states(KEY)
        self.assertEqual(state.tick, 60)
        self.assertEqual((state.me.id, state.me.x, state.me.y, state.me.vx, state.me.vy), (2, -2.0, 3.0, 2.0, -2.0))
        self.assertEqual(sorted(state.lice), [1, 2])

    def test_a_delta_is_against_its_key_not_against_the_delta_before(self):
        first = {"type": "delta", "tick": 63, "base": 60, "louse": [[2, 2, 2, 0, 0], [3, 1, 1, 0, 0]], "gone": [1]}
        second = {"type": "delta", "tick": 66, "base": 60, "louse": [[1, 12, 20, 0, 0]]}
        _, after_first, after_second = self.states(KEY, first, second)
        self.assertEqual({i: row.x for i, row in after_first.lice.items()}, {2: 1.0, 3: 0.5})
        self.assertEqual({i: row.x for i, row in after_second.lice.items()}, {1: 6.0, 2: -2.0})

    def test_lines_may_come_in_any_pieces(self):
        for chunk in (1, 7):
            self.assertEqual([state.tick for state in self.states(KEY, dict(KEY, tick=120), chunk=chunk)], [60, 120])

    def test_a_delta_without_its_key_asks_once_for_another(self):
        def then(send, receive):
            send(KEY, {"type": "delta", "tick": 123, "base": 120, "louse": []},
                 {"type": "delta", "tick": 126, "base": 120, "louse": []}, {"type": "ping", "t": 1})
            expect(receive, type="resync")
            expect(receive, type="pong")
            send(dict(KEY, tick=120), {"type": "delta", "tick": 129, "base": 120, "louse": []}, {"type": "ping", "t": 2})
            expect(receive, type="pong")
            send(BYE)

        with joined(then) as server:
            game = woodlouse.connect(server.address)
            self.assertEqual([state.tick for state in game.states()][-1], 129)
            game.close()

    def test_the_last_state_is_shown_though_the_bye_came_with_it(self):
        with joined(lambda send, receive: send(KEY, BYE)) as server:
            game = woodlouse.connect(server.address)
            self.assertEqual([state.tick for state in game.states()], [60])
            game.close()

    def test_a_slow_reader_gets_the_newest_state(self):
        sent = threading.Event()

        def then(send, receive):
            send(KEY)
            expect(receive, type="chat")
            send(*[{"type": "delta", "tick": tick, "base": 60, "louse": []} for tick in range(63, 120, 3)])
            sent.set()
            expect(receive, type="chat")
            send(BYE)

        with joined(then) as server:
            with woodlouse.connect(server.address) as game:
                states = game.states()
                self.assertEqual(next(states).tick, 60)
                game.chat("thinking")
                self.assertTrue(sent.wait(10))
                self.assertEqual(next(states).tick, 117)
                game.chat("done")
                self.assertEqual(list(states), [])

    def test_events_keep_the_players_names_and_unknown_messages_are_passed_over(self):
        def then(send, receive):
            send({"type": "event", "n": 1, "tick": 9, "kind": "joined", "id": 4, "name": "dan", "role": "bot"},
                 {"type": "event", "n": 2, "tick": 9, "kind": "left", "id": 1, "name": "ann"},
                 {"type": "event", "n": 3, "tick": 9, "kind": "comet", "id": 1, "name": ""},
                 {"type": "weather", "rain": True}, KEY)
            expect(receive, type="leave")

        with joined(then) as server:
            with woodlouse.connect(server.address) as game:
                next(game.states())
                self.assertEqual(game.players, {4: "dan"})
                self.assertEqual([event["n"] for event in game.take_events()], [1, 2, 3])
                self.assertEqual(game.take_events(), [])

    def test_a_broken_connection_and_broken_messages_raise(self):
        for last in (b"", b'{"type":"key","tick":1', b'{"type":"key","tick":1,"louse":[[1]]}\n', b"{}\n", b"null\n",
                     b'{"type":"key","louse":[]}\n', b'{"type":"key","tick":1,"louse":{"a":1}}\n', b"\xff\xfe\n"):
            with joined(lambda send, receive, last=last: send(KEY, last)) as server:
                game = woodlouse.connect(server.address)
                with self.assertRaises(woodlouse.WoodlouseError, msg=repr(last)):
                    for _ in game.states():
                        pass
                game.close()


class Verifying(unittest.TestCase):
    ROWS = [[1, 0, 0.1, -0.0, 1e-300, 2, 1, 0, 0.5, 0, 0, 0, 3.25, 1, 4294967295],
            [2, 1, -7.5, 1 / 3, 0, 0, 0, -1, 0, 0, 0, 0, 12, 0, 0]]

    def key(self):
        # Of the rows above by the server's own code: previous 1, inputs 2, tick 60, generator 3.
        return {"type": "key", "tick": 60, "louse": self.ROWS, "hash": "1a1ddc05fc45cd16", "previous": "%016x" % 1,
                "inputs": "%016x" % 2, "generator": "%016x" % 3}

    def verified(self, key):
        welcome = dict(WELCOME, fields=woodlouse.ALL_FIELDS, quantum=[1] * 15, format="exact")

        def script(send, receive):
            send(HELLO)
            expect(receive, type="join", fields="all", format="exact")
            send(welcome, key, BYE)

        with Scripted(script) as server:
            with woodlouse.connect(server.address, verify=True) as game:
                for _ in game.states():
                    pass
        return game.verified

    def test_xxh64_is_that_of_the_c_library_for_every_length_of_rest(self):
        data = bytes((7 * i + 3) & 255 for i in range(100))
        hashes = [woodlouse.xxh64(data[:size]) for size in range(101)]
        self.assertEqual(hashes[0], 0xef46db3751d8e999)
        self.assertEqual(woodlouse.xxh64(b"abc"), 0x44bc2cf5ad770999)
        self.assertEqual(woodlouse.xxh64(struct.pack("<101Q", *hashes)), 0x69278944434abcf6)

    def test_a_key_whose_rows_give_its_hash_is_counted(self):
        self.assertEqual(self.verified(self.key()), 1)

    def test_a_flipped_bit_in_any_number_of_a_row_raises(self):
        for louse in range(2):
            for column in range(15):
                key = self.key()
                key["louse"] = [list(row) for row in self.ROWS]
                value = key["louse"][louse][column]
                if column in (0, 1, 13, 14):
                    key["louse"][louse][column] = value ^ 1
                else:
                    bits, = struct.unpack("<Q", struct.pack("<d", value))
                    key["louse"][louse][column], = struct.unpack("<d", struct.pack("<Q", bits ^ 1))
                with self.assertRaises(woodlouse.WoodlouseError) as caught:
                    self.verified(key)
                self.assertEqual(caught.exception.code, "differs")
                self.assertIn("tick 60", caught.exception.text)

    def test_what_else_went_into_the_hash_counts_too(self):
        for field in ("hash", "previous", "inputs", "generator"):
            with self.assertRaises(woodlouse.WoodlouseError) as caught:
                self.verified(dict(self.key(), **{field: "%016x" % 9}))
            self.assertEqual(caught.exception.code, "differs")

    def test_a_key_without_its_proof_or_with_rows_out_of_shape_is_no_key(self):
        for key in ({k: v for k, v in self.key().items() if k != "inputs"}, dict(self.key(), louse=[[1, 0, 2]]),
                    dict(self.key(), louse=[["1"] + self.ROWS[0][1:]])):
            with self.assertRaises(woodlouse.WoodlouseError) as caught:
                self.verified(key)
            self.assertEqual(caught.exception.code, "protocol")

    def test_fields_of_ones_own_cannot_be_verified(self):
        with self.assertRaises(ValueError):
            woodlouse.connect("127.0.0.1:1", fields=["x"], verify=True)


class Acting(unittest.TestCase):
    def test_thrusts_are_numbered_and_their_acks_come_back(self):
        ack = {"type": "ack", "seq": 1, "tick": 61, "margin_us": 5, "late": False, "dropped": False, "clamped": False}

        def then(send, receive):
            expect(receive, type="input", seq=1, thrust=0.5, ticks=None, tick=None)
            expect(receive, type="input", seq=2, thrust=[0.0, -1.0], ticks=30, tick=99)
            send(ack, dict(ack, seq=2), KEY)
            expect(receive, type="leave")

        with joined(then) as server:
            with woodlouse.connect(server.address) as game:
                self.assertEqual(game.thrust(0.5), 1)
                self.assertEqual(game.thrust((0, -1), ticks=30, tick=99), 2)
                next(game.states())
                self.assertEqual(game.last_ack["seq"], 2)
                self.assertEqual([a["seq"] for a in game.take_acks()], [1, 2])

    def test_a_thrust_that_is_none_is_refused_before_it_is_sent(self):
        with joined(lambda send, receive: expect(receive, type="leave")) as server:
            with woodlouse.connect(server.address) as game:
                for value in (math.nan, math.inf, (1,), (1, 2, 3), (1, math.nan), "fast"):
                    with self.assertRaises(ValueError, msg=repr(value)):
                        game.thrust(value)

    def test_errors_are_told_and_the_game_goes_on_but_fatal_ones_raise(self):
        error = {"type": "error", "code": "bad_field", "text": "no", "fatal": False}

        def then(send, receive):
            send(error, KEY, {"type": "ping", "t": 3})
            expect(receive, type="pong")
            send(dict(error, code="flood", fatal=True))

        with joined(then) as server, contextlib.redirect_stderr(io.StringIO()) as told:
            game = woodlouse.connect(server.address)
            with self.assertRaises(woodlouse.WoodlouseError) as caught:
                for state in game.states():
                    self.assertEqual(state.tick, 60)
            game.close()
        self.assertEqual(caught.exception.code, "flood")
        self.assertIn("bad_field: no", told.getvalue())

    def test_ping_rooms_and_map_wait_for_their_answers_among_frames(self):
        definition = {"name": "a", "terrain": {"origin": [0, 0], "spacing": [1, 2], "heights": [[0, 1], [2, 3]]}}

        def then(send, receive):
            t = expect(receive, type="ping")["t"]
            send(KEY, {"type": "pong", "t": t - 1}, {"type": "pong", "t": t})
            expect(receive, type="list")
            send(KEY, {"type": "rooms", "rooms": [{"name": "a"}]})
            expect(receive, type="get_map")
            send(KEY, {"type": "map", "name": "a", "hash": "0" * 16, "definition": definition})
            expect(receive, type="leave")

        with joined(then) as server:
            with woodlouse.connect(server.address) as game:
                self.assertGreater(game.ping(), 0.0)
                self.assertEqual(game.rooms(), [{"name": "a"}])
                self.assertEqual(game.map().extent, (0, 0, 1, 2))
                self.assertIs(game.map(), game.map())


class TheGround(unittest.TestCase):
    def ground(self, function, columns=9, rows=7):
        heights = [[function(-2 + 0.5 * i, 1 + 0.25 * j) for i in range(columns)] for j in range(rows)]
        return woodlouse.Ground("g", [-2, 1], [0.5, 0.25], heights)

    def test_it_goes_through_its_knots(self):
        ground = self.ground(lambda x, y: math.sin(3 * x) + y * y)
        for j in range(ground.rows):
            for i in range(ground.columns):
                self.assertAlmostEqual(ground.height(-2 + 0.5 * i, 1 + 0.25 * j), ground.heights[j][i], places=12)

    def test_it_is_exact_on_planes_to_the_rim(self):
        ground = self.ground(lambda x, y: 3 * x - 2 * y + 1)
        for k in range(200):
            x, y = -2 + 4 * (k * 0.618 % 1), 1 + 1.5 * (k * 0.414 % 1)
            self.assertAlmostEqual(ground.height(x, y), 3 * x - 2 * y + 1, places=12)
            self.assertAlmostEqual(ground.gradient(x, y)[0], 3, places=11)
            self.assertAlmostEqual(ground.gradient(x, y)[1], -2, places=11)

    def test_its_gradient_is_that_of_its_heights(self):
        ground = self.ground(lambda x, y: math.sin(2 * x) * math.cos(y))
        for k in range(200):
            x, y, h = -1.99 + 3.98 * (k * 0.618 % 1), 1.01 + 1.48 * (k * 0.414 % 1), 1e-6
            gx, gy = ground.gradient(x, y)
            self.assertAlmostEqual(gx, (ground.height(x + h, y) - ground.height(x - h, y)) / (2 * h), places=6)
            self.assertAlmostEqual(gy, (ground.height(x, y + h) - ground.height(x, y - h)) / (2 * h), places=6)

    def test_outside_it_is_its_rim(self):
        ground = self.ground(lambda x, y: x + y)
        self.assertAlmostEqual(ground.height(99, 1.5), 2 + 1.5)
        self.assertAlmostEqual(ground.height(-99, -99), -2 + 1)

    def test_its_summit_is_the_highest_inner_knot(self):
        ground = self.ground(lambda x, y: -(x - 0.5) ** 2 - (y - 1.75) ** 2 + (100 if x == 2 else 0))
        self.assertEqual(ground.summit(), (0.5, 1.75, 0.0))


if __name__ == "__main__":
    unittest.main()
