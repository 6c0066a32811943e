"""Players who stop, are cut off, come back or come twice; disks that stand still: what becomes of lice, and of others."""

import os
import pathlib
import signal
import socket
import struct
import subprocess
import sys
import tempfile
import unittest

from crowd import frames_missed_in_a_row
from wire import MAPS, PATIENCE, Server, run

sys.path.insert(0, str(pathlib.Path(MAPS).parent / "bench" / "crowd"))
from lost_player import Cable  # noqa: E402

HERE = pathlib.Path(__file__).resolve().parent
SOON = ("--ping-s", "1", "--vacant-s", "2", "--resume-s", "30")
LAST_SEQ = 2**32 - 1


class Steady:
    """steady_player.py beside a watcher of its louse's thrust."""

    def __init__(self, server, prefix=(), host="127.0.0.1"):
        self.eye = server.player("eye", role="spectator", fields=["tx"])
        self.process = subprocess.Popen([*prefix, sys.executable, "-B", HERE / "steady_player.py", host, str(server.port)],
                                        stdout=subprocess.PIPE, text=True)
        self.louse = int(self.process.stdout.readline())

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.process.kill()
        self.process.wait()
        self.process.stdout.close()
        self.eye.socket.close()

    def wait_until(self, pushes):
        """Frames that it took."""
        for frame in range(int(PATIENCE * 20)):
            while self.eye.receive()["type"] not in ("key", "delta"):
                pass
            if self.louse in self.eye.rows and (self.eye.rows[self.louse][1] != 0) == pushes:
                return frame
        raise AssertionError(f"louse {self.louse} {'stands' if pushes else 'pushes'} on")


def reset(client):
    """Ends the connection as a crash does."""
    client.socket.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, struct.pack("ii", 1, 0))
    client.socket.close()


class Vanishing(unittest.TestCase):
    def test_the_louse_of_a_stopped_program_rests_and_goes_on_with_it(self):
        with Server(*SOON) as server, Steady(server) as steady:
            steady.wait_until(True)
            steady.process.send_signal(signal.SIGSTOP)
            self.assertGreater(steady.wait_until(False), 10)  # not at once: 2 s less what had just been said
            steady.process.send_signal(signal.SIGCONT)
            steady.wait_until(True)
            self.assertLessEqual(frames_missed_in_a_row(steady.eye.seen), 1)
            self.assertEqual([m for m in steady.eye.seen if m["type"] == "event" and m["kind"] == "left"], [])

    def test_the_louse_of_a_player_who_is_cut_off_rests(self):
        try:
            cable = Cable().__enter__()
        except (subprocess.CalledProcessError, OSError) as error:
            self.skipTest(f"no network of its own can be made here: {error}")
        try:
            with Server(*SOON, listen="0.0.0.0:0") as server:
                server.host = "127.0.0.1"
                with Steady(server, ("ip", "netns", "exec", cable.name), cable.host) as steady:
                    steady.wait_until(True)
                    cable.pull()
                    steady.wait_until(False)
                    self.assertLessEqual(frames_missed_in_a_row(steady.eye.seen), 1)
        finally:
            cable.__exit__()

    def test_who_comes_back_finds_his_louse_and_who_comes_twice_replaces_himself(self):
        with Server() as server, server.player("eye", role="spectator") as eye:
            first = server.player("ann", resume=True)
            token = first.welcome["resume_token"]
            first.send({"type": "input", "seq": LAST_SEQ, "thrust": [1, 0]})
            first.expect("ack", seq=LAST_SEQ)
            reset(first)
            second = server.player("other name", resume=token)
            self.assertEqual((second.id, second.welcome["resumed"], second.welcome["name"]), (first.id, True, "ann"))
            second.send({"type": "input", "seq": 0, "thrust": [0, 1]})
            self.assertEqual(second.expect("ack", seq=0)["you"]["thrust"], [0, 1])
            third = server.player("ann", resume=second.welcome["resume_token"])
            self.assertEqual((third.id, third.welcome["resumed"]), (first.id, True))
            self.assertEqual(second.until_end()[-1]["code"], "replaced")
            third.send({"type": "input", "seq": 1, "thrust": [1, 0]})
            self.assertEqual(third.expect("ack", seq=1)["you"]["thrust"], [1, 0])
            third.send({"type": "leave"})
            third.until_end()
            late = server.player("ann", resume=third.welcome["resume_token"])
            self.assertEqual((late.welcome["resumed"], late.id != first.id), (False, True))
            eye.expect("event", kind="joined", id=late.id)
            self.assertEqual([(m["kind"], m["id"]) for m in eye.seen if m["type"] == "event"],
                             [("joined", first.id), ("left", first.id), ("joined", late.id)])
            for client in (second, third, late):
                client.socket.close()

    def test_a_louse_whose_last_seq_was_the_last_there_is_obeys_after_a_fork(self):
        with tempfile.TemporaryDirectory() as folder:
            file = os.path.join(folder, "game.ndjson")
            with Server("--record", file) as server, server.player("ann") as ann:
                ann.send({"type": "input", "seq": LAST_SEQ, "thrust": [1, 0], "ticks": 10})
                tick = ann.expect("ack", seq=LAST_SEQ)["tick"] + 5
                for _ in range(8):
                    ann.expect("delta")
                self.assertEqual(server.stop()[0], 0)
            with Server("--adopt-by-name", fork=(file, tick)) as server, server.player("ann") as again:
                self.assertEqual(again.id, ann.id)
                for seq, thrust in ((0, [0, 1]), (LAST_SEQ, [0, -1])):
                    again.send({"type": "input", "seq": seq, "thrust": thrust})
                    self.assertEqual(again.expect("ack", seq=seq)["you"]["thrust"], thrust)

    def test_what_a_lost_player_had_filed_ahead_leaves_the_recording_whole(self):
        """A keyframe, at tick 300, may tell of such inputs or come after they were told to be dropped."""
        with tempfile.TemporaryDirectory() as folder:
            file = os.path.join(folder, "game.ndjson")
            with Server("--record", file) as server, server.player("eye", role="spectator") as eye:
                before, after, greedy = (server.player(name, resume=True) for name in ("before", "after", "greedy"))

                def wait_for(tick):
                    while eye.receive().get("tick", 0) < tick:
                        pass

                wait_for(240)
                for client, count in ((before, 1), (after, 3), (greedy, 8)):
                    client.send(*[{"type": "input", "seq": seq, "thrust": [1, 0], "tick": 340} for seq in range(count)], {"type": "ping", "t": 1})
                    client.expect("pong")
                reset(before)
                wait_for(303)
                reset(after)
                greedy.send({"type": "input", "seq": 8, "thrust": [0, 1], "tick": 340})
                self.assertTrue(greedy.expect("ack", seq=8)["dropped"])
                self.assertEqual(greedy.expect("ack", seq=7)["you"]["thrust"], [1, 0])
                wait_for(345)
                with server.player("all", role="spectator", fields=["tx"]) as everything:
                    everything.expect("key")
                    self.assertEqual([everything.rows[louse.id][1] for louse in (before, after)], [0, 0])
                self.assertEqual(server.stop()[0], 0)
                greedy.socket.close()
            code, verdict, errors = run("verify", "--complete", file)
            self.assertEqual(code, 0, verdict + errors)

    def test_a_recording_that_stands_still_keeps_no_frame_from_any_room(self):
        with tempfile.TemporaryDirectory() as folder:
            stuck = os.path.join(folder, "volcano.ndjson")
            os.mkfifo(stuck)
            pipe = os.open(stuck, os.O_RDONLY | os.O_NONBLOCK)
            with Server("--record", os.path.join(folder, "{room}.ndjson"), "--bots", "100", "--bots-alone", "play",
                        maps=("volcano", "hills"), ends_with=1) as server:
                eyes = [server.player("eye", role="spectator", room=room) for room in ("volcano", "hills")]
                eyes[0].expect("notice", code="recording_ended")
                for eye in eyes:
                    for _ in range(30):
                        eye.expect("delta")
                    self.assertLessEqual(frames_missed_in_a_row(eye.seen), 1)
                self.assertEqual([m for m in eyes[1].seen if m["type"] == "notice"], [])
                for eye in eyes:
                    eye.socket.close()
            os.close(pipe)


if __name__ == "__main__":
    unittest.main()
