"""Recordings of a whole night: cut into files, bounded, and what is left of them when a disk fails."""

import fcntl
import json
import os
import resource
import signal
import subprocess
import tempfile
import threading
import time
import unittest

from wire import Server, run

F_SETPIPE_SZ = 1031
RECORDING = '{"format":"woodlouse-replay",'


class Pipe:
    """A FIFO of one page, for a recording; from which nothing is read, or a page each 0.4 s."""

    def __init__(self, path, is_read):
        os.mkfifo(path)
        self.descriptor = os.open(path, os.O_RDONLY | os.O_NONBLOCK)
        fcntl.fcntl(self.descriptor, F_SETPIPE_SZ, 4096)
        self.ends = threading.Event()
        self.thread = threading.Thread(target=self.read, daemon=True)
        if is_read:
            self.thread.start()

    def read(self):
        while not self.ends.wait(0.4):
            try:
                os.read(self.descriptor, 4096)
            except BlockingIOError:
                pass

    def close(self):
        self.ends.set()
        if self.thread.is_alive():
            self.thread.join()
        os.close(self.descriptor)


class RecordingFiles(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        """Two that take 5 s and more run while the others do."""
        cls.night = tempfile.TemporaryDirectory()
        slow = ("--tick-hz", "10", "--state-hz", "10", "--bots", "2")
        cls.hourly = Server("--record", cls.night.name, "--record-every", "10s", "--ticks", "110", *slow, maps=("volcano", "hills"))
        cls.asked = Server("--record", os.path.join(cls.night.name, "asked.ndjson"), "--ticks", "60", *slow)
        cls.asked.process.send_signal(signal.SIGUSR1)

    @classmethod
    def tearDownClass(cls):
        for server in (cls.hourly, cls.asked):
            server.__exit__()
        cls.night.cleanup()

    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()

    def tearDown(self):
        self.folder.cleanup()

    def path(self, name=""):
        return os.path.join(self.folder.name, name)

    def assert_verifies(self, *files):
        code, verdict, errors = run("verify", "--complete", *files)
        self.assertEqual(code, 0, verdict + errors)
        return verdict

    def assert_follows(self, before, after, tick):
        """Plain or not: whether the second goes on where the first ends, and says so."""
        self.assert_verifies(before, after)
        lines = []
        for file in (before, after):
            states = [json.loads(run("inspect", file, "--tick", str(tick))[1])]
            with open(file, "rb") as data:
                packed = data.read()
            text = subprocess.run(["zstdcat"], input=packed, capture_output=True, check=True).stdout if file.endswith(".zst") else packed
            lines.append([states[0], *map(json.loads, text.splitlines())])
        self.assertEqual(lines[0][0], lines[1][0])
        self.assertEqual(lines[0][-1]["end"], tick)
        self.assertEqual(lines[0][-1]["reason"], f"continued in {after}")
        self.assertEqual(lines[1][1]["parent"], {"file": before, "tick": tick, "hash": lines[0][0]["hash"]})

    def test_a_disk_that_stands_still_costs_the_other_rooms_nothing_and_holds_up_no_end(self):
        for is_read in (False, True):
            folder = self.path(f"read {is_read}")
            os.mkdir(folder)
            stuck, healthy = (os.path.join(folder, name) for name in ("volcano.ndjson", "hills.ndjson"))
            pipe = Pipe(stuck, is_read)
            arguments = ("--record", os.path.join(folder, "{room}.ndjson"), "--bots", "150", "--bots-alone", "play")
            with Server(*arguments, maps=("volcano", "hills"), ends_with=1) as server:
                with server.player() as player:
                    for _ in range(30):
                        player.expect("delta")
                    code, seconds, printed = server.stop()
                self.assertEqual(code, 1, server.log())
                self.assertLess(seconds, 1.5)
                self.assertIn(f"RECORDING LOST: {stuck}: ", printed.splitlines()[-1])
                self.assertNotIn(healthy, printed)
                self.assertEqual(server.log().count(f"RECORDING UNFINISHED: {stuck}") + server.log().count(
                    f"RECORDING ENDED: cannot write {stuck}"), 1, server.log())
            self.assert_verifies(healthy)
            pipe.close()

    def test_a_full_disk_is_told_to_those_who_join_later_and_by_the_exit_code(self):
        file = self.path("game.ndjson")
        with Server("--record", file, "--bots", "20", ends_with=1) as server, server.player() as player:
            resource.prlimit(server.process.pid, resource.RLIMIT_FSIZE, (20000, 20000))
            player.expect("notice", code="recording_ended")
            with server.player("late") as late:
                late.expect("notice", code="recording_ended")
                late.expect("delta")
            code, _, printed = server.stop()
            self.assertEqual(code, 1)
            self.assertEqual(printed.splitlines()[-1], f"RECORDING LOST: {file}: File too large")
            self.assertEqual(server.log().count("RECORDING ENDED"), 1)
        self.assertIn("cut off", run("verify", file)[1])

    def test_a_killed_server_loses_a_second_of_each_room(self):
        with Server("--record", self.path(), "--bots", "2", "--bots-alone", "play", maps=("volcano", "hills")) as server:
            with server.player() as player:
                for _ in range(25):
                    tick = player.expect("delta")["tick"]
            server.process.kill()
            server.process.wait()
        files = sorted(os.listdir(self.path()))
        self.assertEqual([name.split("-")[0] for name in files], ["hills", "volcano"])
        for name in files:
            code, verdict, errors = run("verify", self.path(name))
            self.assertEqual(code, 0, verdict + errors)
            self.assertGreaterEqual(int(verdict.split()[4].rstrip(",")), tick - 60)

    def test_the_oldest_recordings_make_room_and_nothing_else_does(self):
        names = ["volcano-2001.ndjson", "hills-2002.ndjson", "hills-2003.1.ndjson", "hills-2004.txt", "notes-2005.ndjson"]
        for age, name in enumerate(names):
            with open(self.path(name), "w") as out:
                out.write((RECORDING if name != names[-1] else "my own") + " " * 20000)
            os.utime(self.path(name), (age, age))
        with Server("--record", self.path("{room}-%Y.ndjson"), "--record-keep", "58K", "--bots", "3", "--ticks", "90") as server:
            self.assertEqual(server.finish()[0], 0)
            self.assertEqual(server.log().count("of the oldest recordings"), 1, server.log())
        kept = sorted(os.listdir(self.path()))
        new = f"volcano-{time.gmtime().tm_year}.ndjson"
        self.assertEqual(kept, sorted([*names[1:], new]))
        self.assert_verifies(self.path(new))

    def test_a_recording_that_alone_is_more_than_all_may_have_ends_whole_and_loudly(self):
        file = self.path("game.ndjson")
        with Server("--record", file, "--record-keep", "9000", "--bots", "5", "--ticks", "120", ends_with=1) as server:
            code, _, printed = server.finish()
            self.assertEqual(code, 1)
            self.assertIn(f"RECORDING LOST: {file}: all that --record-keep grants is used up", printed.splitlines()[-1])
            self.assertEqual(server.log().count("RECORDING ENDED"), 1)
        self.assert_verifies(file)

    def test_new_files_are_asked_for_where_nothing_is_recorded(self):
        with Server() as server, server.player() as player:
            server.process.send_signal(signal.SIGUSR1)
            server.wait_for_log("SIGUSR1: no room is recorded")
            player.expect("delta")
            self.assertEqual(server.stop()[0], 0)
            self.assertIn("no room is recorded", server.log())
        before = signal.signal(signal.SIGUSR1, signal.SIG_IGN)
        try:
            with Server("--ticks", "30") as server:
                server.process.send_signal(signal.SIGUSR1)
                self.assertEqual(server.finish()[0], 0)
                self.assertNotIn("SIGUSR1", server.log())
        finally:
            signal.signal(signal.SIGUSR1, before)

    def test_what_cannot_name_a_recording_is_refused_with_what_could(self):
        for record, code, words in (("%T", 2, "%T is no field"), ("{map}", 2, "{room}"), ("%Y/x", 2, "in its folder"),
                                    (self.path("none/"), 1, "mkdir -p")):
            done = run("--map", "volcano", "--listen", "127.0.0.1:0", "--record", record)
            self.assertEqual(done[0], code, done)
            self.assertIn(words, done[2])
            self.assertLessEqual(len([line for line in done[2].splitlines() if " info " not in line]), 2)

    def test_zz_a_file_follows_when_it_is_time_or_asked_for(self):
        self.assertEqual(self.asked.finish()[0], 0)
        asked = [os.path.join(self.night.name, name) for name in ("asked.ndjson", "asked.1.ndjson")]
        self.assert_follows(*asked, 50)
        self.assertEqual(self.hourly.finish()[0], 0)
        for room in ("volcano", "hills"):
            files = sorted(name for name in os.listdir(self.night.name) if name.startswith(room))
            self.assertEqual(len(files), 2, files)
            self.assert_follows(*(os.path.join(self.night.name, name) for name in files), 100)


if __name__ == "__main__":
    unittest.main()
