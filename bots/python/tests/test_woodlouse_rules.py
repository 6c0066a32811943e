"""What woodlouse.py makes of rules of play that a scripted server tells: python3 -m unittest test_woodlouse_rules"""

import os
import sys
import unittest

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
import woodlouse
from scripted_server import BYE, HELLO, KEY, Scripted, WELCOME, expect, joined

STANDING = ["score", "gate", "lap", "lap_start", "best_lap"]
RACE = {"laps": 2, "gates": [{"a": [-15, 4], "b": [-15, -4], "air": False}, {"a": [0, 4], "b": [0, -4], "air": False}]}
OF_RULES = dict(HELLO, features=["exact", "rules"])


def racing(fields=None):
    """A welcome into a race, with these columns and those of a standing."""
    fields = fields or WELCOME["fields"]
    quantum = [1] + [0.5] * (len(fields) - 1) + [1] * len(STANDING)
    return dict(WELCOME, mode="race", rules=RACE, fields=fields + STANDING, quantum=quantum)


def raced(x, score, louse=2):
    return [louse, x, 6, 8, -8, score, 1, 0, 65536, 0]


class Joining(unittest.TestCase):
    def joined_with(self, hello, welcome=WELCOME, **options):
        """The game, and the join that it sent."""
        seen = []

        def script(send, receive):
            send(hello)
            seen.append(receive())
            send(welcome)
            expect(receive, type="leave")

        with Scripted(script) as server:
            with woodlouse.connect(server.address, **options) as game:
                pass
        return game, seen[0]

    def test_a_server_with_rules_is_asked_for_the_standing_besides(self):
        self.assertEqual(self.joined_with(OF_RULES, racing())[1]["fields"], ["x", "y", "vx", "vy"] + STANDING)
        self.assertEqual(self.joined_with(OF_RULES, racing(), fields=["z", "lap"])[1]["fields"],
                         ["z", "lap", "score", "gate", "lap_start", "best_lap"])

    def test_but_where_all_columns_are_wanted_which_are_fixed(self):
        for options in ({"verify": True}, {"fields": "all"}, {"fields": "all", "format": "exact"}):
            welcome = dict(WELCOME, fields=woodlouse.ALL_FIELDS, quantum=[1] * 15)
            self.assertEqual(self.joined_with(OF_RULES, welcome, **options)[1]["fields"], "all")

    def test_a_server_without_them_is_asked_for_what_it_knows(self):
        game, join = self.joined_with(HELLO)
        self.assertNotIn("fields", join)
        self.assertEqual((game.mode, game.rules, game.round, game.score, game.standings), ("roam", {}, None, None, {}))
        self.assertEqual(self.joined_with(HELLO, fields=["z"])[1]["fields"], ["z"])

    def test_who_comes_back_to_a_server_without_them_asks_for_none(self):
        def first(send, receive):
            send(OF_RULES)
            expect(receive, type="join", fields=["x", "y", "vx", "vy"] + STANDING)
            send(dict(racing(), resume_token="ab"))

        def second(send, receive):
            send(HELLO)
            expect(receive, type="join", fields=None, resume="ab")
            send(WELCOME, KEY, BYE)

        with Scripted(first, second) as server:
            game = woodlouse.connect(server.address)
            game.on_lost = game.on_comeback = lambda *_: None
            self.assertEqual(game.mode, "race")
            for state in game.states():
                self.assertEqual(state.me.x, -2.0)
            game.close()
            self.assertEqual((game.mode, game.rules, game.score), ("roam", {}, None))

    def test_mode_and_rules_are_those_of_the_welcome(self):
        game, _ = self.joined_with(OF_RULES, racing())
        self.assertEqual((game.mode, game.rules), ("race", RACE))

    def test_a_row_has_the_columns_that_were_wanted_whatever_the_server_sends(self):
        game, _ = self.joined_with(OF_RULES, racing())
        self.assertEqual(game.fields, ["id", "x", "y", "vx", "vy"])
        game, _ = self.joined_with(OF_RULES, racing(["id", "z", "x", "y"]), fields=["x", "score"])
        self.assertEqual(game.fields, ["id", "x", "score"])


class Playing(unittest.TestCase):
    def seen(self, look, *messages):
        """look(game, state) after each message; the next is sent when this one was seen."""
        def script(send, receive):
            send(OF_RULES)
            receive()
            send(racing())
            for message in messages:
                send(message)
                expect(receive, type="chat")
            send(BYE)

        found = []
        with Scripted(script) as server:
            game = woodlouse.connect(server.address)
            for state in game.states():
                found.append(look(game, state))
                game.chat("next")
            game.close()
        return found

    def key(self, game, tick=60):
        return dict(KEY, tick=tick, louse=[raced(-4, 7)], game=game)

    def delta(self, tick=63, base=60, louse=(), gone=(), **game):
        return {"type": "delta", "tick": tick, "base": base, "louse": list(louse), "gone": list(gone), **game}

    def test_a_round_is_that_of_the_key_but_for_what_the_delta_has_otherwise(self):
        shown = {"phase": "play", "round": 2, "until": 900, "table": [[3, 9], [2, 7]]}
        key, first, second, third = self.seen(
            lambda game, _: game.round, self.key(shown), self.delta(game={"table": [[2, 10]]}),
            self.delta(66, game={"phase": "podium", "until": 1500}), self.delta(69))
        self.assertEqual(key, woodlouse.Round("play", 2, 900, ((3, 9), (2, 7))))
        self.assertEqual(first, woodlouse.Round("play", 2, 900, ((2, 10),)))
        self.assertEqual(second, woodlouse.Round("podium", 2, 1500, ((3, 9), (2, 7))), "not upon the delta before")
        self.assertEqual(third, key)

    def test_crumbs_change_slot_by_slot_and_eaten_ones_lie_nowhere(self):
        shown = {"phase": "play", "round": 1, "until": 9, "crumbs": [[0, 1.5, 2, 1], [1, 4, 4, 3], [2, 0, 0, 0]]}
        _, first, second = self.seen(
            lambda game, _: game.round.crumbs, self.key(shown), self.delta(game={"crumbs": [[1, 4, 4, 0], [2, 5, 6, 1]]}),
            self.delta(66, game={"crumbs": [[0, -1, -2, 3]]}))
        self.assertEqual(first, {0: (1.5, 2, 1), 2: (5, 6, 1)})
        self.assertEqual((first[2].x, first[2].y, first[2].value), (5, 6, 1))
        self.assertEqual(second, {0: (-1, -2, 3), 1: (4, 4, 3)})

    def test_a_hill_has_its_place_and_holder(self):
        shown = {"phase": "play", "round": 1, "until": 9, "table": [], "place": 0, "holder": 3, "contested": False,
                 "moves_at": 2700}
        key, delta = self.seen(lambda game, _: game.round, self.key(shown),
                               self.delta(game={"holder": 0, "contested": True}))
        self.assertEqual((key.place, key.holder, key.contested, key.moves_at), (0, 3, False, 2700))
        self.assertEqual((delta.place, delta.holder, delta.contested, delta.moves_at), (0, 0, True, 2700))

    def test_members_that_nobody_knows_are_passed_over_and_absent_ones_are_none(self):
        key, delta = self.seen(lambda game, _: game.round, self.key({"phase": "overtime", "weather": {"rain": [1]}}),
                               self.delta(game={"weather": None}))
        self.assertEqual(key, woodlouse.Round("overtime"))
        self.assertEqual(delta, key)
        self.assertEqual((key.place, key.crumbs), (None, {}))

    def test_a_game_out_of_shape_is_told(self):
        for game in ([], 1, {"table": 1}, {"table": [[1]]}, {"crumbs": [[1, 2]]}):
            with joined(lambda send, receive, game=game: send(dict(KEY, game=game))) as server:
                seen = woodlouse.connect(server.address)
                with self.assertRaises(woodlouse.WoodlouseError, msg=repr(game)) as caught:
                    next(seen.states())
                seen.close()
            self.assertEqual(caught.exception.code, "protocol")

    def test_the_own_standing_stays_while_the_louse_is_out(self):
        def look(game, state):
            return (state.me and state.me.x), game.score, game.gate, game.lap, game.lap_start, game.best_lap

        shown = {"phase": "play", "round": 1, "until": 9, "table": []}
        there, out, back = self.seen(look, self.key(shown), self.delta(gone=[2]), self.delta(66, louse=[raced(8, 11)]))
        self.assertEqual(there, (-2.0, 7, 1, 0, 65536, 0))
        self.assertEqual(out, (None, 7, 1, 0, 65536, 0))
        self.assertEqual(back, (4.0, 11, 1, 0, 65536, 0))

    def test_all_standings_are_there_and_the_rows_don_t_show_them(self):
        def look(game, state):
            return len(state.me), {louse: standing.score for louse, standing in game.standings.items()}

        found, = self.seen(look, dict(KEY, louse=[raced(-4, 7), raced(2, 12, louse=9)]))
        self.assertEqual(found, (5, {2: 7, 9: 12}))

    def test_events_of_rules_come_with_all_their_fields(self):
        gate = {"type": "event", "n": 16, "tick": 1200, "kind": "gate", "id": 2, "name": "ann", "moment": 78654321,
                "gate": 2, "lap": 0, "split": 12345678, "delta": None}
        podium = {"type": "event", "n": 17, "tick": 18840, "kind": "round", "id": 0, "name": "", "moment": 1234698240,
                  "round": 2, "until": 19440, "phase": "podium", "table": [[7, 181347123], [3, 0]]}

        def then(send, receive):
            send(gate, podium, KEY)
            expect(receive, type="leave")

        with joined(then) as server:
            with woodlouse.connect(server.address) as game:
                next(game.states())
                self.assertEqual(game.take_events(), [gate, podium])
                self.assertEqual(game.players, {1: "ann"})

    def test_moments_are_seconds_by_the_rooms_rate(self):
        with joined(lambda send, receive: expect(receive, type="leave")) as server:
            with woodlouse.connect(server.address) as game:
                self.assertEqual(game.seconds_of(65536 * 90), 1.5)

    def test_a_respawn_at_the_gate_says_so(self):
        def then(send, receive):
            expect(receive, type="respawn", at=None)
            expect(receive, type="respawn", at="gate")
            expect(receive, type="leave")

        with joined(then) as server:
            with woodlouse.connect(server.address) as game:
                game.respawn()
                game.respawn(at="gate")


if __name__ == "__main__":
    unittest.main()
