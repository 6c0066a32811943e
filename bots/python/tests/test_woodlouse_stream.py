"""Watching by inputs with the module, against scripted servers: python3 -m unittest test_woodlouse_stream"""

import os
import sys
import tempfile
import unittest

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
import save_stream
import woodlouse
from scripted_server import BYE, HELLO, Scripted, WELCOME, expect

HEADER = '{"format":"woodlouse-replay","version":3}'
EVENT = {"type": "event", "n": 1, "tick": 7, "kind": "chat", "id": 1, "name": "ann", "text": "hello"}


def keyframe(tick):
    return '{"keyframe":%d,"lice":[]}' % tick


def step(tick, steps=None):
    return '{"step":%d,%s"hash":"00ff"}' % (tick, '"steps":%d,' % steps if steps else "")


def streams(*what):
    """A script: a join by inputs, a welcome, and these: lines as text, messages as dicts."""
    def script(send, receive):
        send(HELLO)
        expect(receive, type="join", role="spectator", stream="inputs")
        send(dict(WELCOME, id=0, stream="inputs"))
        send(*((part + "\n").encode() if isinstance(part, str) else part for part in what))
    return script


def watch(server, **options):
    return woodlouse.connect(server.address, name="eye", role="spectator", stream="inputs", **options)


class Recorded(unittest.TestCase):
    def test_lines_come_as_they_are_and_events_beside_them(self):
        for chunk in (None, 3):
            with Scripted(streams(HEADER, keyframe(6), EVENT, step(6), step(7, 5), BYE), chunk=chunk) as server:
                with watch(server) as game:
                    self.assertEqual(list(game.recorded()), [HEADER, keyframe(6), step(6), step(7, 5)])
                    self.assertEqual([event["text"] for event in game.take_events()], ["hello"])

    def test_a_server_that_shows_frames_alone_is_told(self):
        def script(send, receive):
            send(HELLO)
            expect(receive, type="join", stream="inputs")
            send(dict(WELCOME, id=0))
            expect(receive, type="leave")
        with Scripted(script) as server, watch(server) as game:
            with self.assertRaises(woodlouse.WoodlouseError) as raised:
                next(game.recorded())
            self.assertEqual(raised.exception.code, "no_stream")

    def test_who_comes_back_goes_on_from_a_new_header(self):
        with Scripted(streams(HEADER, keyframe(6), step(6)), streams(HEADER, keyframe(90), step(90), BYE)) as server:
            game = watch(server)
            game.on_lost = lambda error: None
            game.on_comeback = lambda: None
            with game:
                self.assertEqual(list(game.recorded()),
                                 [HEADER, keyframe(6), step(6), HEADER, keyframe(90), step(90)])

    def test_who_watches_frames_has_no_line_without_a_type(self):
        def script(send, receive):
            send(HELLO)
            expect(receive, type="join")
            send(WELCOME)
            send((step(6) + "\n").encode())
        with Scripted(script) as server, woodlouse.connect(server.address, name="eye", resume=False) as game:
            with self.assertRaises(woodlouse.WoodlouseError) as raised:
                next(game.states())
            self.assertEqual(raised.exception.code, "protocol")


class Saved(unittest.TestCase):
    def test_each_keyframe_begins_a_file_and_none_is_written_over(self):
        with tempfile.TemporaryDirectory() as folder:
            name = os.path.join(folder, "game.ndjson")
            with Scripted(streams(HEADER, keyframe(6), step(6), step(7, 5), keyframe(90), step(90), BYE)) as server:
                names = save_stream.save(server.address, name)
            self.assertEqual(names, [name, os.path.join(folder, "game.1.ndjson")])
            read = []
            for each in names:
                with open(each, encoding="utf-8") as file:
                    read.append(file.read().splitlines())
            self.assertEqual(read, [[HEADER, keyframe(6), step(6), step(7, 5)], [HEADER, keyframe(90), step(90)]])
            with Scripted(streams(HEADER, keyframe(6), BYE)) as server:
                with self.assertRaises(FileExistsError):
                    save_stream.save(server.address, name)

    def test_a_new_keyframe_is_asked_for_once_before_a_recording_has_too_many_steps(self):
        def script(send, receive):
            send(HELLO)
            expect(receive, type="join")
            send(dict(WELCOME, id=0, stream="inputs"))
            send(*((line + "\n").encode() for line in (HEADER, keyframe(6), step(6, 1999), step(2005), step(2006))))
            expect(receive, type="resync")
            send(*((line + "\n").encode() for line in (keyframe(2007), step(2007))), BYE)
        with tempfile.TemporaryDirectory() as folder, Scripted(script) as server:
            self.assertEqual(len(save_stream.save(server.address, os.path.join(folder, "game.ndjson"))), 2)

    def test_steps_without_a_keyframe_are_told(self):
        with tempfile.TemporaryDirectory() as folder, Scripted(streams(HEADER, step(6), BYE)) as server:
            with self.assertRaises(woodlouse.WoodlouseError):
                save_stream.save(server.address, os.path.join(folder, "game.ndjson"))


if __name__ == "__main__":
    unittest.main()
