"""A room that nobody is in stands still, and goes on as if nothing had been when somebody comes."""

import json
import os
import tempfile
import time
import unittest

from wire import Server, run

ASLEEP = 11.5  # seconds: a room waits for ten


class StandingStill(unittest.TestCase):
    def test_no_tick_passes_nothing_is_written_and_the_first_to_join_finds_the_next_tick(self):
        with tempfile.TemporaryDirectory() as folder:
            file = os.path.join(folder, "game.ndjson")
            with Server("--record", file, "--bots", "2", "--seed", "3") as server:
                time.sleep(ASLEEP)
                size = os.path.getsize(file)
                time.sleep(1.5)
                self.assertEqual(os.path.getsize(file), size)
                with server.player("mara", fields="all", format="exact") as mara:
                    self.assertEqual(mara.welcome["tick"], 600)
                    self.assertEqual(mara.expect("key")["tick"], 600)
                    mara.send({"type": "input", "seq": 1, "thrust": 1})
                    self.assertLess(mara.expect("ack", seq=1)["tick"], 700)
            with open(file) as lines:
                pauses = [json.loads(line) for line in lines if line.startswith('{"pause"')]
            self.assertEqual([pause["pause"] for pause in pauses], [600])
            self.assertTrue(1 <= pauses[0]["until"] - pauses[0]["from"] <= 60, pauses)
            code, verdict, errors = run("verify", "--from-start", "--complete", file)
            self.assertEqual((code, errors), (0, ""), verdict)
            self.assertIn("pauses   1, in which nobody was there", run("inspect", "--summary", file)[1])


if __name__ == "__main__":
    unittest.main()
