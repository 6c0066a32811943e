"""Games that are re-run beside themselves."""

import os
import re
import tempfile
import unittest

from wire import Server, run


class Shadow(unittest.TestCase):
    def test_every_room_is_shadowed_and_no_tick_differs(self):
        with tempfile.TemporaryDirectory() as folder:
            file = os.path.join(folder, "game.ndjson")
            with Server(
                "--shadow", "--record", file, "--bots", "6", "--ticks", "300", maps=("volcano", "hills")
            ) as server, server.player("mara") as mara:
                for seq in range(1, 30):
                    mara.send({"type": "input", "seq": seq, "thrust": [0.9, 0.1], "ticks": 9})
                    mara.expect("ack", seq=seq)
                mara.send({"type": "respawn"})
                mara.until_end()
                code, _, printed = server.finish()
                self.assertEqual(code, 0)
                self.assertNotIn("SHADOW", server.log())
            for room in ("volcano", "hills"):
                line = next(line for line in printed.splitlines() if line.startswith(room))
                found = re.search(r", (\d+) ticks shadowed, 0 differences$", line)
                # The last ones may still wait when the server stops on a busy machine.
                self.assertTrue(found and 200 <= int(found[1]) <= 300, line)
            self.assertEqual(sorted(os.listdir(folder)), ["game.hills.ndjson", "game.volcano.ndjson"])
            self.assertEqual(run("verify", os.path.join(folder, "game.volcano.ndjson"))[0], 0)

    def test_rooms_whose_ticks_threads_may_share_are_shadowed_alike(self):
        """From how many lice on they do, and that the bits are those of one: tests/match/team_test.cpp."""
        with Server(
            "--shadow", "--step-threads", "3", "--bots", "200", "--ticks", "300", maps=("volcano", "hills")
        ) as server, server.player("mara", state_hz=1) as mara:
            for seq in range(1, 4):
                mara.send({"type": "input", "seq": seq, "thrust": [0.9, 0.1]})
            mara.until_end()
            code, _, printed = server.finish()
            self.assertEqual(code, 0, server.log())
            self.assertNotIn("SHADOW", server.log())
            self.assertEqual(server.log().count(", steps by 3 threads"), 2)
        for room in ("volcano", "hills"):
            line = next(line for line in printed.splitlines() if line.startswith(room))
            found = re.search(r", (\d+) ticks shadowed, 0 differences$", line)
            self.assertTrue(found and 100 <= int(found[1]) <= 300, line)


if __name__ == "__main__":
    unittest.main()
