"""Two runs of a race, again and again: each time another call that a board's file needs fails (tests/inject)."""

import concurrent.futures
import json
import os
import subprocess
import tempfile
import unittest

from records_test import RING
from wire import PROGRAM, Client, run

LIBRARY = os.environ.get("WOODLOUSE_FAILING_CALLS")
AT_ONCE = 2


class Game:
    """Of a server whose calls fail as ordered; of calls from where it listens on, on a board that is there, or of all."""

    def __init__(self, order, has_board=True):
        self.order = order
        with tempfile.TemporaryDirectory() as folder:
            with open(os.path.join(folder, "ring.json"), "w") as file:
                json.dump({**RING, "race": {**RING["race"], "laps": 1}}, file)
            self.records = os.path.join(folder, "records")
            os.mkdir(self.records)
            command = ["--map", os.path.join(folder, "ring.json"), "--mode", "race", "--records", self.records,
                       "--listen", "127.0.0.1:0"]
            environment = {**os.environ, "LD_PRELOAD": LIBRARY, "WOODLOUSE_FAIL": order}
            if has_board:
                environment["WOODLOUSE_FAIL_LISTENING"] = "1"
                run(*command, "--ticks", "1")
            with tempfile.TemporaryFile("w+") as log:
                process = subprocess.Popen([PROGRAM, *command], env=environment, stdout=subprocess.PIPE, stderr=log,
                                           text=True)
                try:
                    first = process.stdout.readline()
                    self.listened = first.startswith("listening ")
                    if self.listened:
                        self.play(*first.split()[1].rsplit(":", 1))
                        process.terminate()
                    self.printed = process.stdout.read()
                    self.code = process.wait(20)
                finally:
                    process.kill()
                    process.wait()
                    process.stdout.close()
                log.seek(0)
                self.log = log.read()
            self.verified = run("records", "verify", self.records) if self.listened else None
            self.rest = [name for name in os.listdir(self.records) if not name.endswith(".ndjson")]

    def play(self, host, port):
        self.times = []
        with Client(host, int(port)) as mara:
            mara.join("mara")
            for seq, push in ((1, 0.5), (2, 1)):
                mara.send({"type": "respawn"})
                mara.expect("event", kind="respawned", id=mara.id)
                mara.send({"type": "input", "seq": seq, "thrust": [push, 0], "ticks": 60})
                self.times.append(mara.expect("event", kind="record")["time"])
            mara.send({"type": "list_records"})
            self.rows = mara.expect("records")["rows"]

    def __repr__(self):
        return f"{self.order}: {self.code}\n{self.printed}\n{self.log}\n{self.verified}"


@unittest.skipUnless(LIBRARY, "this build has no library for it (tests/inject)")
class RecordsInjection(unittest.TestCase):
    def games(self, orders, **options):
        with concurrent.futures.ThreadPoolExecutor(AT_ONCE) as pool:
            return list(pool.map(lambda order: Game(order, **options), orders))

    def assert_played(self, game):
        """Whatever failed, the game and its board went on, and what is in the file is whole."""
        self.assertTrue(game.listened, game)
        self.assertEqual([row["time"] for row in game.rows], [min(game.times)], game)
        self.assertEqual(game.verified[0], 0, game)
        self.assertEqual(game.rest, [], game)

    def test_one_call_that_fails_costs_nothing(self):
        for game in self.games(["write:1:ENOSPC", "write:2:EIO", "sync:1:EIO", "sync:2:EIO", "write:1:EINTR", "write:1:EFBIG"]):
            with self.subTest(game.order):
                self.assert_played(game)
                self.assertEqual(game.code, 0, game)
                self.assertIn("runs re-run, all the same", game.verified[1], game)

    def test_calls_that_fail_on_and_on_are_told_once_and_named_at_the_end(self):
        for game in self.games(["write:1+:ENOSPC", "sync:1+:EIO", "write:2+:EIO"]):
            with self.subTest(game.order):
                self.assert_played(game)
                self.assertEqual((game.code, game.log.count("RECORDS NOT WRITTEN")), (1, 1), game)
                self.assertIn("RECORD LOST: ", game.printed, game)

    def test_a_server_that_can_t_have_its_board_does_not_begin(self):
        refused = [game for game in self.games(["lock:1:EWOULDBLOCK", "sync:1:EIO", "write:1:ENOSPC"],
                                               has_board=False) if not game.listened]
        self.assertEqual(len(refused), 3)
        for game in refused:
            with self.subTest(game.order):
                self.assertEqual(game.code, 1, game)
                self.assertIn("woodlouse-server: cannot write records to ", game.log)


if __name__ == "__main__":
    unittest.main()
