"""How the module comes back when the connection breaks, against scripted servers: python3 -m unittest test_woodlouse_door"""

import contextlib
import io
import os
import sys
import time
import unittest
from unittest import mock

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
import woodlouse
import woodlouse_door
from scripted_server import BYE, HELLO, KEY, Scripted, WELCOME, expect

TOKEN = "00ff00ff"


def joins(resume, then, **welcome):
    """A script: a join with that `resume`, a welcome, and `then`."""
    def script(send, receive):
        send(HELLO)
        expect(receive, type="join", name="ann", resume=resume)
        send(dict(WELCOME, name="ann#2", resume_token=TOKEN, **welcome))
        then(send, receive)
    return script


def refuses(**error):
    def script(send, receive):
        send(HELLO)
        expect(receive, type="join")
        send(dict({"type": "error", "text": "not now", "fatal": False}, **error))
    return script


def breaks(send, receive):
    """A frame, and the end without a word."""
    send(KEY)


def ends(send, receive):
    send(dict(KEY, tick=120), BYE)


class ComingBack(unittest.TestCase):
    def setUp(self):
        for name, seconds in (("LONGEST_WAIT_S", 0.1), ("PATIENCE_S", 0.5)):
            quicker = mock.patch.object(woodlouse_door, name, seconds)
            quicker.start()
            self.addCleanup(quicker.stop)
        self.told = io.StringIO()

    def play(self, *scripts, **options):
        """The game at its end, and the ticks that it saw."""
        with Scripted(*scripts) as server, contextlib.redirect_stderr(self.told):
            with woodlouse.connect(server.address, name="ann", **options) as game:
                ticks = [state.tick for state in game.states()]
        return game, ticks

    def test_states_go_on_over_a_break_in_the_louse_that_waited(self):
        game, ticks = self.play(joins(True, breaks), joins(TOKEN, ends, resumed=True))
        self.assertEqual(ticks[-1], 120)  # the one before may have been overtaken
        self.assertEqual((game.comebacks, game.id, game.name, game.welcome["resumed"]), (1, 2, "ann#2", True))
        self.assertEqual(game.players[2], "ann#2", "no event tells of who comes back")
        self.assertRegex(self.told.getvalue(), r"connection: .*: coming back\nwoodlouse: back in louse 2\n")

    def test_a_louse_that_is_gone_is_another_with_another_token(self):
        def script(send, receive):
            send(HELLO)
            expect(receive, type="join", resume=TOKEN)
            send(dict(WELCOME, id=9, name="ann", resume_token="11", resumed=False))

        game, _ = self.play(joins(True, breaks), script, joins("11", ends, resumed=False))
        self.assertEqual(game.comebacks, 2)
        self.assertIn("back, in a new louse, 9\n", self.told.getvalue())

    def test_it_tries_again_while_nobody_answers_or_the_server_says_not_now(self):
        def silent(send, receive):
            pass

        begun = time.monotonic()
        game, ticks = self.play(joins(True, breaks), silent, refuses(code="rate_limited", retry_after_ms=300),
                                refuses(code="too_many_connections"), joins(TOKEN, ends, resumed=True))
        self.assertGreater(time.monotonic() - begun, 0.3)
        self.assertEqual((game.comebacks, ticks[-1]), (1, 120))

    def test_it_gives_up_after_a_while_and_at_a_refusal(self):
        with self.assertRaises(woodlouse.WoodlouseError) as caught:
            self.play(joins(True, breaks), refuses(code="room_full"))
        self.assertEqual(caught.exception.code, "room_full")
        with mock.patch.object(woodlouse_door, "COMES_BACK_S", 0.2), self.assertRaises(woodlouse.WoodlouseError) as caught:
            self.play(joins(True, breaks))
        self.assertEqual(caught.exception.code, "connection")

    def test_inputs_count_anew_and_what_was_sent_into_the_break_is_dropped(self):
        def then(send, receive):
            send(dict(KEY, tick=120))
            expect(receive, type="input", seq=1)
            send(BYE)

        with Scripted(joins(True, breaks), joins(TOKEN, then, resumed=True)) as server:
            with contextlib.redirect_stderr(self.told), woodlouse.connect(server.address, name="ann") as game:
                for _ in range(50):  # into a connection that is no more
                    game.thrust(1)
                    time.sleep(0.002)
                for state in game.states():
                    if state.tick == 120:
                        self.assertEqual(game.thrust(0.5), 1)
        self.assertEqual(game.comebacks, 1)

    def test_a_question_is_asked_again_on_the_new_connection(self):
        def asked(send, receive):
            expect(receive, type="get_map")

        def answers(send, receive):
            expect(receive, type="get_map")
            terrain = {"origin": [0, 0], "spacing": [1, 2], "heights": [[0, 1], [2, 3]]}
            send({"type": "map", "name": "a", "hash": "0" * 16, "definition": {"name": "a", "terrain": terrain}})
            expect(receive, type="leave")

        with Scripted(joins(True, asked), joins(TOKEN, answers, resumed=True)) as server:
            with contextlib.redirect_stderr(self.told), woodlouse.connect(server.address, name="ann") as game:
                ground = game.map()
                self.assertEqual(ground.extent, (0, 0, 1, 2))

    def test_a_map_is_kept_over_a_break_where_it_is_the_same(self):
        def first(send, receive):
            expect(receive, type="get_map")
            terrain = {"origin": [0, 0], "spacing": [1, 2], "heights": [[0, 1], [2, 3]]}
            send({"type": "map", "name": "a", "hash": "0" * 16, "definition": {"name": "a", "terrain": terrain}})

        def then(send, receive):
            send(KEY)
            expect(receive, type="leave")

        with Scripted(joins(True, first), joins(TOKEN, then, resumed=True)) as server:
            with contextlib.redirect_stderr(self.told), woodlouse.connect(server.address, name="ann") as game:
                ground = game.map()
                next(game.states())
                self.assertIs(game.map(), ground)
                self.assertEqual(game.comebacks, 1)

    def test_a_goodbye_that_nobody_asked_for_is_a_break(self):
        left = dict(BYE, code="left")
        game, ticks = self.play(joins(True, lambda send, receive: send(KEY, left)), joins(TOKEN, ends, resumed=True))
        self.assertEqual((game.comebacks, ticks[-1]), (1, 120))
        game, _ = self.play(joins(None, lambda send, receive: send(KEY, left)), resume=False)
        self.assertEqual((game.comebacks, game.bye["code"]), (0, "left"))

    def test_what_the_server_means_it_means(self):
        replaced = dict(BYE, code="replaced")
        game, _ = self.play(joins(True, lambda send, receive: send(KEY, replaced)))
        self.assertEqual((game.bye["code"], game.comebacks), ("replaced", 0))
        fatal = {"type": "error", "code": "flood", "text": "too much", "fatal": True}
        with self.assertRaises(woodlouse.WoodlouseError) as caught:
            self.play(joins(True, lambda send, receive: send(KEY, fatal)))
        self.assertEqual(caught.exception.code, "flood")

    def test_who_does_not_want_it_is_told_of_the_break(self):
        with self.assertRaises(woodlouse.WoodlouseError) as caught:
            self.play(joins(None, breaks), resume=False)
        self.assertEqual(caught.exception.code, "connection")

    def test_a_spectator_joins_again_without_a_token(self):
        def watches(then):
            def script(send, receive):
                send(HELLO)
                expect(receive, type="join", role="spectator", resume=None)
                send(dict(WELCOME, id=0, name="ann", resume_token=""))
                then(send, receive)
            return script

        game, ticks = self.play(watches(breaks), watches(ends), role="spectator")
        self.assertEqual((game.comebacks, ticks[-1]), (1, 120))
        self.assertIn("watching again", self.told.getvalue())


class Joining(unittest.TestCase):
    def test_a_join_that_comes_too_fast_is_made_again_when_the_server_says(self):
        with mock.patch.object(woodlouse_door, "LONGEST_WAIT_S", 0.1):
            begun = time.monotonic()
            with Scripted(refuses(code="rate_limited", retry_after_ms=200), joins(True, ends)) as server:
                with woodlouse.connect(server.address, name="ann") as game:
                    self.assertEqual([state.tick for state in game.states()], [120])
            self.assertGreater(time.monotonic() - begun, 0.2)


if __name__ == "__main__":
    unittest.main()
