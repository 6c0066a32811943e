"""woodlouse.py against a scripted server on a socket: python3 -m unittest test_woodlouse"""

import contextlib
import io
import math
import os
import socket
import sys
import threading
import unittest

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
import woodlouse
from scripted_server import BYE, HELLO, KEY, Scripted, WELCOME, expect, joined


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
                                 "fields": ["z"], "state_hz": 10, "resume": True}])

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

    def test_another_game_of_the_room_ends_the_states_and_begins_anew_but_for_the_seqs(self):
        other = dict(WELCOME, id=9, mode="race", rules={"gates": []}, tick=0,
                     map=dict(WELCOME["map"], name="b", hash="00000000000000bb"), players=[])
        again = dict(other, id=4)

        def script(send, receive):
            send(HELLO)
            receive()
            send(WELCOME, KEY)
            self.assertEqual(receive()["seq"], 1)
            send(other, dict(KEY, tick=0, louse=[[9, 2, 2, 0, 0]]))
            self.assertEqual(receive()["seq"], 2)
            self.assertEqual(receive(), {"type": "skip"})
            send(again, dict(KEY, tick=3, louse=[[4, 2, 2, 0, 0]]), BYE)

        with Scripted(script) as server, woodlouse.connect(server.address, resume=False) as game:
            seen = []
            while game.bye is None:
                for state in game.states():
                    seen.append((game.games, game.mode, game.id, state.tick, state.me.id))
                    if game.games < 3:
                        game.thrust(1)
                    if game.games == 2:
                        game.skip()
            self.assertEqual(seen, [(1, "roam", 2, 60, 2), (2, "race", 9, 0, 9), (3, "race", 4, 3, 4)])
            self.assertEqual(game.players, {})

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

    def test_spectators_share_an_id_and_are_told_apart_by_name(self):
        def event(n, kind, name):
            return {"type": "event", "n": n, "tick": 9, "kind": kind, "id": 0, "name": name, "role": "spectator"}

        there = WELCOME["players"] + [{"id": 0, "name": name, "role": "spectator"} for name in ("eve", "fay")]

        def script(send, receive):
            send(HELLO)
            receive()
            send(dict(WELCOME, players=there), event(1, "joined", "gus"), event(2, "joined", "gus"),
                 event(3, "left", "eve"), event(4, "left", "gus"), event(5, "left", "who came before"), KEY)
            expect(receive, type="leave")

        with Scripted(script) as server:
            with woodlouse.connect(server.address) as game:
                self.assertEqual((game.players, game.spectators), ({1: "ann"}, ["eve", "fay"]))
                next(game.states())
                self.assertEqual((game.players, game.spectators), ({1: "ann"}, ["fay", "gus"]))

    def test_a_broken_connection_and_broken_messages_raise(self):
        for last in (b"", b'{"type":"key","tick":1', b'{"type":"key","tick":1,"louse":[[1]]}\n', b"{}\n", b"null\n",
                     b'{"type":"key","louse":[]}\n', b'{"type":"key","tick":1,"louse":{"a":1}}\n', b"\xff\xfe\n"):
            with joined(lambda send, receive, last=last: send(KEY, last)) as server:
                game = woodlouse.connect(server.address, resume=False)
                with self.assertRaises(woodlouse.WoodlouseError, msg=repr(last)):
                    for _ in game.states():
                        pass
                game.close()


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


class TheMap(unittest.TestCase):
    TERRAIN = {"origin": [0, 0], "spacing": [1, 2], "heights": [[0, 1], [2, 3]]}
    OF_TODAY = {"gravity": 9.81, "drag": 0.2, "friction": 0.05, "thrust_max": 4, "edge_restitution": 0.5}

    def joined(self, physics, **message):
        """The game that has asked for its map, of a welcome with that physics."""
        def script(send, receive):
            send(HELLO)
            receive()
            send(dict(WELCOME, physics=physics))
            expect(receive, type="get_map")
            send(dict({"type": "map", "name": "a", "hash": "0" * 16}, **message))
            expect(receive, type="leave")

        with Scripted(script) as server:
            with woodlouse.connect(server.address) as game:
                game.map()
        return game

    def test_what_the_welcome_says_of_the_physics_holds_whatever_the_map_says(self):
        told = dict(self.OF_TODAY, equations="local_plane", method="false_euler", contact="unilateral", edges="wrap",
                    central_gravity=3, core_radius=0.5, tolerance=1e-6)
        game = self.joined(told, definition={"name": "a", "terrain": self.TERRAIN})
        self.assertEqual(game.physics, told)
        self.assertTrue(game.map().wraps)

    def test_what_the_welcome_leaves_out_comes_from_the_maps_definition(self):
        definition = {"name": "a", "terrain": self.TERRAIN, "edges": "wrap",
                      "physics": {"gravity": 1, "method": "cheap", "contact": "unilateral", "central_gravity": 7,
                                  "core_radius": 2, "tolerance": 1e-4}}
        game = self.joined(self.OF_TODAY, definition=definition)
        self.assertEqual(game.physics, dict(self.OF_TODAY, equations="exact", method="cheap", contact="unilateral",
                                            edges="wrap", central_gravity=7, core_radius=2, tolerance=1e-4))
        self.assertEqual(game.welcome["physics"], self.OF_TODAY)

    def test_what_neither_says_is_the_formats_default(self):
        game = self.joined(self.OF_TODAY, definition={"name": "a", "terrain": self.TERRAIN})
        self.assertEqual(game.physics, dict(self.OF_TODAY, equations="exact", method="standard", contact="bilateral",
                                            edges="walls", central_gravity=0, core_radius=0, tolerance=0))
        self.assertFalse(game.map().wraps)

    def test_a_core_that_nobody_names_is_as_large_as_a_room_of_15_ticks_a_second_resolves(self):
        definition = {"name": "a", "terrain": self.TERRAIN, "physics": {"central_gravity": 100}}
        core = self.joined(self.OF_TODAY, definition=definition).physics["core_radius"]
        self.assertAlmostEqual(math.sqrt(35 / 8 * 100 / core ** 3) / 12.8, 15)

    def test_the_ground_keeps_the_whole_definition_and_knows_an_overview(self):
        definition = {"name": "a", "terrain": {"file": "a.flt"}, "later": [1]}
        ground = self.joined(self.OF_TODAY, definition=definition, overview=True, knots=self.TERRAIN).map()
        self.assertEqual((ground.definition, ground.overview), (definition, True))


if __name__ == "__main__":
    unittest.main()
