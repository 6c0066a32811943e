"""How the module follows a room to another server, against scripted ones: python3 -m unittest test_woodlouse_moving"""

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
from woodlouse_lines import told_address

TOKEN = "00ff00ff"


def joins(resume, *said, hosts=None, **welcome):
    """A script: a join with that `resume`, a welcome, and what is said then."""
    def script(send, receive):
        send(dict(HELLO, hosts=hosts) if hosts else HELLO)
        expect(receive, type="join", name="ann", resume=resume, room="a" if resume == TOKEN else None)
        send(dict(WELCOME, resume_token=TOKEN, **welcome))
        send(*said)
    return script


def sends_on(address):
    """A script: whoever joins is told that the room is there."""
    def script(send, receive):
        send(HELLO)
        expect(receive, type="join", name="ann")
        send({"type": "error", "code": "moved", "text": "there", "fatal": True, "address": address}, moved(address))
    return script


def moved(address):
    return {"type": "bye", "code": "moved", "text": "there", "resumable": True, "address": address}


END = (dict(KEY, tick=120), BYE)


class Moving(unittest.TestCase):
    def setUp(self):
        self.told = io.StringIO()
        patience = mock.patch.object(woodlouse_door, "PATIENCE_S", 1.0)
        patience.start()
        self.addCleanup(patience.stop)

    def play(self, first, *others, **options):
        """The game at its end. The others are servers, too."""
        with contextlib.ExitStack() as stack:
            stack.enter_context(contextlib.redirect_stderr(self.told))
            for server in (first, *others):
                stack.enter_context(server)
            with woodlouse.connect(first.address, name="ann", **options) as game:
                self.ticks = [state.tick for state in game.states()]
        return game

    def test_who_is_in_a_room_that_moves_goes_on_there_at_once(self):
        second = Scripted(joins(TOKEN, *END, resumed=True))
        begun = time.monotonic()
        game = self.play(Scripted(joins(True, KEY, moved(second.address))), second)
        self.assertLess(time.monotonic() - begun, 2)
        self.assertEqual((game.comebacks, game.address, game.bye["code"], self.ticks[-1]), (1, second.address, "shutdown", 120))
        self.assertIn("back in louse 2; room a is at %s now\n" % second.address, self.told.getvalue())

    def test_who_joins_at_the_old_place_is_sent_on_twice(self):
        third = Scripted(joins(True, *END))
        second = Scripted(sends_on(third.address))
        game = self.play(Scripted(sends_on(second.address)), second, third)
        self.assertEqual((game.comebacks, game.address), (0, third.address))

    def test_who_is_sent_on_a_third_time_is_told_so(self):
        third = Scripted(sends_on("127.0.0.1:9"))
        second = Scripted(sends_on(third.address))
        with self.assertRaises(woodlouse.WoodlouseError) as caught:
            self.play(Scripted(sends_on(second.address)), second, third)
        self.assertEqual(str(caught.exception), "moved: sent on from server to server, to 127.0.0.1:9 last")

    def test_who_was_in_the_room_goes_on_after_a_wait(self):
        fourth = Scripted(joins(TOKEN, *END, resumed=True))
        third = Scripted(*[sends_on(fourth.address)] * 2)
        second = Scripted(joins(TOKEN, moved(third.address), resumed=True))
        game = self.play(Scripted(joins(True, KEY, moved(second.address))), second, third, fourth)
        self.assertEqual((game.address, self.ticks[-1]), (fourth.address, 120))

    def test_what_is_no_address_is_followed_by_nobody_and_told(self):
        for address in ("/tmp/socket", "127.0.0.1", "http://127.0.0.1:7777", 7777, ["127.0.0.1:7777"], "a\x1b[2J:1"):
            first = Scripted(joins(True, KEY, moved(address)), joins(TOKEN, *END, resumed=True))
            game = self.play(first)
            self.assertEqual((game.comebacks, game.address, self.ticks[-1]), (1, first.address, 120))
            with self.assertRaises(woodlouse.WoodlouseError) as caught:
                self.play(Scripted(sends_on(address)))
            self.assertRegex(str(caught.exception), r"^moved: the room has moved to ['\"].+['\"], which is no HOST:PORT$")
            self.assertTrue(str(caught.exception).isprintable())

    def test_a_line_that_is_lost_is_looked_for_at_the_hosts_that_were_named(self):
        nobody = Scripted()
        third = Scripted(joins(TOKEN, *END, resumed=True))
        first = Scripted(joins(True, KEY, hosts=[nobody.address, "/tmp/socket", third.address]))
        with contextlib.redirect_stderr(self.told), third:
            with first:
                game = woodlouse.connect(first.address, name="ann")
            nobody._listener.close()  # and so is the first one, by now
            with game:
                ticks = [state.tick for state in game.states()]
        self.assertEqual((game.comebacks, game.address, ticks[-1]), (1, third.address, 120))

    def test_hosts_that_were_named_since_take_the_place_of_the_others(self):
        nobody = Scripted()
        third = Scripted(joins(TOKEN, *END, resumed=True))
        first = Scripted(joins(True, {"type": "ping", "t": 1, "hosts": [third.address]}, KEY, hosts=[nobody.address]))
        with contextlib.redirect_stderr(self.told), third:
            with first:
                game = woodlouse.connect(first.address, name="ann")
            with game:
                ticks = [state.tick for state in game.states()]
        self.assertEqual((game.comebacks, game.address, ticks[-1]), (1, third.address, 120))

    def test_a_server_without_the_room_is_passed_by_where_there_are_others(self):
        def has_none(send, receive):
            send(HELLO)
            expect(receive, type="join")
            send({"type": "error", "code": "unknown_room", "text": "none", "fatal": False})

        second = Scripted(joins(TOKEN, *END, resumed=True))
        game = self.play(Scripted(joins(True, KEY, hosts=[second.address]), has_none), second)
        self.assertEqual((game.comebacks, game.address), (1, second.address))

    def test_who_does_not_come_back_is_told_where_the_room_is(self):
        game = self.play(Scripted(joins(None, KEY, moved("127.0.0.1:9"))), resume=False)
        self.assertEqual((game.comebacks, game.bye["address"]), (0, "127.0.0.1:9"))

    def test_a_password_is_not_said_to_another_machine(self):
        door = woodlouse_door.Door("farm.example:7777", {"type": "join", "role": "bot", "token": "horse"}, True)
        for place, is_said in (("farm.example:7777", True), ("127.0.0.1:7777", True), ("[::1]:1", True),
                               ("farm.example:7778", False), ("10.0.0.6:7777", False), ("127.evil.example:1", False)):
            self.assertEqual("token" in door._join_for(place, HELLO), is_said, place)


class Addresses(unittest.TestCase):
    def test_an_address_is_a_host_and_a_port(self):
        for text in ("farm.example:7777", "10.0.0.6:7777", "[2001:db8::7]:7778", "[::ffff:10.0.0.6]:1", "localhost:65535"):
            self.assertEqual(told_address(text), text)
        for text in ("", ":", "host", "host:", ":7777", "host:0", "host:65536", "host:07777", "host:+1", "host:7777 ", "host:7777\n",
                     "http://host:7777", "/tmp/socket:1", "user@host:1", "-h:1", "h\u00f6st:1", "host:\u0661", "::1:7777", "[::1]",
                     "[host]:1", "[1::2::3]:1", "[fe80::1%eth0]:1", "10.0.0:1", "10.0.0.256:1", "a" * 300 + ":1", None, 7, b"a:1"):
            self.assertIsNone(told_address(text), text)

    def test_waits_grow_and_are_never_the_same_for_all(self):
        places = woodlouse_door.Whereabouts("a:1")
        places.welcomed(["b:2", "no host", "a:1", 7, "c:3"])
        waits, tried = [], []
        for _ in range(10):
            waits.append(places.lost())
            tried.append(places.place)
        self.assertEqual(tried[:6], ["a:1", "b:2", "c:3", "a:1", "b:2", "c:3"])
        for wait, middle in zip(waits, (0.05, 0.1, 0.2, 0.4, 0.8, 1.6, 2, 2, 2, 2)):
            self.assertTrue(0.5 * middle <= wait <= 1.5 * middle, waits)
        self.assertGreater(len(set(waits[6:])), 1)


if __name__ == "__main__":
    unittest.main()
