"""A map that is stepped on from its file: played by bots and a player, recorded, verified, and told from another."""

import array
import json
import math
import os
import shutil
import tempfile
import unittest

from wire import Server, run

COLUMNS, ROWS = 400, 300


class BigMap(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.grid = self.path("alps.flt")
        with open(self.path("alps.hdr"), "w") as header:
            header.write(f"ncols {COLUMNS}\nnrows {ROWS}\nxllcenter 0\nyllcenter 0\ncellsize 1\nbyteorder LSBFIRST\n")
        heights = array.array("f", (2 * math.sin(0.11 * i) * math.cos(0.07 * j)
                                    for j in range(ROWS) for i in range(COLUMNS)))
        with open(self.grid, "wb") as grid:
            heights.tofile(grid)
        with open(self.path("alps.json"), "w") as map_file:
            json.dump({"name": "alps", "terrain": {"file": "alps.flt", "storage": "tiles"}}, map_file)

    def tearDown(self):
        self.folder.cleanup()

    def path(self, *name):
        return os.path.join(self.folder.name, *name)

    def play(self):
        """Steers a louse among bots; returns what the server printed at its end, the map's message, the louse's way."""
        recording = self.path("game.ndjson")
        with Server("--record", recording, "--bots", "8", "--ticks", "420", "--seed", "7",
                    maps=(self.path("alps"),)) as server:
            with server.player("mara", role="bot", fields=["x", "y", "z"], format="exact") as mara:
                mara.send({"type": "get_map"})
                told = mara.expect("map")
                for seq in range(1, 20):
                    mara.send({"type": "input", "seq": seq, "thrust": [0.9, 0.3], "ticks": 60})
                    mara.expect("ack", seq=seq)
                mara.until_end()
                rows = [row for m in mara.seen if m["type"] in ("key", "delta") for row in m["louse"] if row[0] == mara.id]
            code, _, printed = server.finish()
            self.assertEqual(code, 0)
        return printed, told, rows

    def test_lice_move_on_tiles_built_ahead_clients_get_an_overview_and_the_recording_verifies(self):
        printed, told, rows = self.play()
        self.assertRegex(printed, r"alps: ticks 420, .*tiles built \d+ \(\d+ ahead\), thrown out 0, read failures 0")
        self.assertIs(told["overview"], True)
        knots = told["knots"]
        self.assertEqual((knots["columns"], knots["rows"]), (257, 257))
        self.assertEqual([len(row) for row in knots["heights"]], [257] * 257)
        self.assertEqual(knots["origin"], [-199.5, -149.5])
        self.assertEqual(told["definition"]["terrain"]["file"], "alps.flt")
        self.assertGreater(math.dist(rows[0][1:3], rows[-1][1:3]), 1.0)
        for _, x, y, z in rows:  # the file's first row is the north
            i, j = x + 199.5, ROWS - 1 - (y + 149.5)
            self.assertAlmostEqual(z, 2 * math.sin(0.11 * i) * math.cos(0.07 * j), places=2)
        self.assertEqual(run("verify", self.path("game.ndjson"))[:2], (0, "ok ticks 0 to 420\n"))
        self.assertLess(os.path.getsize(self.path("game.ndjson")), 2_000_000)

    def test_the_recording_finds_its_map_beside_it_or_where_it_is_told_and_refuses_another_file(self):
        self.play()
        elsewhere = self.path("elsewhere")
        os.mkdir(elsewhere)
        shutil.move(self.path("game.ndjson"), elsewhere)
        recording = os.path.join(elsewhere, "game.ndjson")
        code, verdict, _ = run("verify", recording)  # where it was played from has no say
        self.assertEqual((code, verdict), (1, f"{elsewhere}/alps.json: no such file (put the map it was played on beside "
                                              "the recording, or say --maps FOLDER)\n"))
        self.assertEqual(run("verify", recording, "--maps", self.folder.name)[:2], (0, "ok ticks 0 to 420\n"))
        for name in ("alps.json", "alps.hdr", "alps.flt"):
            shutil.move(self.path(name), elsewhere)
        self.assertEqual(run("verify", recording)[:2], (0, "ok ticks 0 to 420\n"))
        with open(os.path.join(elsewhere, "alps.flt"), "r+b") as grid:
            grid.write(b"\0\0\x40\x40")  # 3 m in the north-western corner
        code, verdict, _ = run("verify", recording)
        self.assertEqual(code, 1)
        self.assertIn("map.hash", verdict)
        os.remove(os.path.join(elsewhere, "alps.hdr"))
        code, verdict, _ = run("verify", recording)
        self.assertEqual(code, 1)
        self.assertIn("alps.hdr: no such file", verdict)

    def test_check_tells_what_is_wrong_with_the_file(self):
        self.assertEqual(run("check", self.path("alps.json"))[:2], (0, self.path("alps.json") + ": ok\n"))
        os.truncate(self.grid, 100)
        code, printed, _ = run("check", self.path("alps.json"))
        self.assertEqual(code, 1)
        self.assertIn("alps.flt: has 100 bytes, its header says 480000", printed)


if __name__ == "__main__":
    unittest.main()
