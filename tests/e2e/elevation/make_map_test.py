"""make-map over files that differ in everything: each becomes a map, is played by bots for 600 ticks, and its
recording verifies."""
import array
import math
import os
import pathlib
import random
import subprocess
import sys
import tempfile
import unittest

SERVER = os.environ["WOODLOUSE_SERVER"]
TICKS = 600


def run(*arguments):
    return subprocess.run([SERVER, *map(str, arguments)], capture_output=True, text=True, timeout=150)


def ascii_grid(path, columns, rows, header, height):
    with open(path, "w") as file:
        file.write(f"ncols {columns}\nnrows {rows}\n{header}\n")
        for j in range(rows):
            file.write(" ".join(f"{height(i, j):.3f}" for i in range(columns)) + "\n")


def hills(i, j, high=40.0, wide=30.0):
    return high * math.sin(i / wide) * math.cos(j / wide)


def tile(path, side):
    """An SRTM tile: hills of some hundred metres, a void of 80 knots, and many of one."""
    rng = random.Random(7)
    row_of = [[int(300 + 120 * math.sin(i / 61) * math.cos(j / 43)) for i in range(side)] for j in range(97)]
    with open(path, "wb") as file:
        for j in range(side):
            row = array.array("h", row_of[j % 97])
            if side // 2 - 40 < j < side // 2 + 40:
                for i in range(side // 2 - 40, side // 2 + 40):
                    row[i] = -32768
            for _ in range(20):
                row[rng.randrange(side)] = -32768
            if sys.byteorder == "little":
                row.byteswap()
            file.write(row.tobytes())


class MakeMap(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory(prefix="woodlouse-make-map-")
        self.addCleanup(self.folder.cleanup)
        self.path = pathlib.Path(self.folder.name)

    def make(self, file, *options):
        made = run("make-map", self.path / file, "--out", self.path / (file + ".json"), *options)
        self.assertEqual(made.returncode, 0, made.stdout + made.stderr)
        return made.stdout

    def play(self, *files):
        """All at once: each plays for 600 ticks of its own. Their logs."""
        games, logs = [], {}
        for file in files:
            record = self.path / (file + ".ndjson.zst")
            games.append((record, subprocess.Popen(
                [SERVER, "--map", self.path / (file + ".json"), "--mode", "roam", "--listen", "127.0.0.1:0", "--seed", "5", "--bots", "8",
                 "--bots-alone", "play", "--ticks", str(TICKS), "--record", record],
                stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)))
        for record, game in games:
            out, err = game.communicate(timeout=150)
            self.assertEqual(game.returncode, 0, out + err)
            logs[record.name.split(".")[0]] = err
            verified = run("verify", record)
            self.assertEqual(verified.returncode, 0, verified.stdout + verified.stderr)
            self.assertIn(str(TICKS), verified.stdout)
        return logs

    def test_five_grids_that_differ_in_everything_are_played(self):
        ascii_grid(self.path / "steep.asc", 60, 40, "xllcorner 0\nyllcorner 0\ncellsize 10",
                   lambda i, j: hills(i, j, 200.0, 5.0))
        rng = random.Random(3)
        ascii_grid(self.path / "holes.asc", 90, 120, "xllcorner 5e5\nyllcorner 5e6\ncellsize 2\nNODATA_value -9999",
                   lambda i, j: -9999 if rng.random() < 0.4 else hills(i, j, 8.0))
        ascii_grid(self.path / "degrees.asc", 80, 80, "xllcorner 174.7\nyllcorner -36.9\ncellsize 0.000277777777778",
                   lambda i, j: -9999 if i < 3 else hills(i, j, 90.0, 20.0))
        with open(self.path / "surfer.grd", "w") as file:
            file.write("DSAA\n40 40\n0 39\n0 39\n0 1\n")
            file.writelines(f"{hills(i, j, 1.5, 6.0):.3f}\n" for j in range(40) for i in range(40))
        (self.path / "flat.hdr").write_text("ncols 64\nnrows 50\nulxmap 0\nulymap 0\nxdim 3\nydim 5\nbyteorder I\n")
        heights = array.array("f", (0.01 * (i % 64) for i in range(64 * 50)))
        if sys.byteorder == "big":
            heights.byteswap()
        (self.path / "flat.flt").write_bytes(heights.tobytes())
        files = ("steep.asc", "holes.asc", "degrees.asc", "surfer.grd", "flat.flt")
        said = {file: self.make(file, "--modes") for file in files}
        self.assertIn("were filled from their shores", said["holes.asc"])
        self.assertIn("degrees at latitude", said["degrees.asc"])
        self.assertIn("3 columns in the west", said["degrees.asc"])
        for text in said.values():
            for figure in ("size: ", "relief: ", "steepest slope: ", "largest curvature: ", "overshoot: ", "a louse's step: "):
                self.assertIn(figure, text)
        # A map by hand names the file itself, whose holes the server fills as it starts.
        (self.path / "by_hand.json").write_text('{"name": "by_hand", "terrain": {"file": "holes.asc"}}')
        logs = self.play(*files, "by_hand")
        self.assertRegex(logs["by_hand"], "room_opened: .*; its ground: .*were filled from their shores")

    def test_a_tile_of_one_arc_second_with_voids_whole_and_cropped(self):
        tile(self.path / "S37E174.hgt", 3601)
        whole = self.make("S37E174.hgt")
        self.assertIn("3601 by 3601 knots", whole)
        (self.path / "S37E174.hgt.json").rename(self.path / "whole.json")
        middle = "174.48,-36.52,174.52,-36.48"
        cropped = self.make("S37E174.hgt", "--crop", middle, "--scale", "0.1", "--name", "my_hill", "--modes")
        self.assertIn("heights were filled from their shores", cropped)
        (self.path / "S37E174.hgt.json").rename(self.path / "cropped.json")
        self.play("whole", "cropped")
        again = run("make-map", self.path / "S37E174.hgt", "--out", self.path / "whole.json")
        self.assertEqual(again.returncode, 1)
        self.assertIn("is there already", again.stdout)

    def test_what_can_not_be_made_is_one_line(self):
        (self.path / "p.tif").write_bytes(b"II*\0" + bytes(100))
        (self.path / "hill.hgt").write_bytes(bytes(2 * 1201 * 1201))
        tile(self.path / "N47E011.hgt", 1201)
        for file, options, wanted in (("p.tif", (), "gdal_translate -of AAIGrid p.tif p.asc"),
                                      ("hill.hgt", (), "does not say by its name where it lies"),
                                      ("none.asc", (), "no such file"),
                                      ("N47E011.hgt", ("--crop", "0,0,1,1"), "leaves less than 4 knots")):
            made = run("make-map", self.path / file, *options)
            self.assertEqual(made.returncode, 1)
            self.assertEqual(made.stdout.count("\n"), 1, made.stdout)
            self.assertIn(wanted, made.stdout)

    def test_a_small_level_map_has_no_race_and_says_so(self):
        ascii_grid(self.path / "yard.asc", 5, 5, "xllcorner 0\nyllcorner 0\ncellsize 3", lambda i, j: 3.0)
        made = self.make("yard.asc", "--modes")
        self.assertIn("no race: it wants a map 20 m across", made)
        self.assertIn("largest curvature: none", made)


if __name__ == "__main__":
    unittest.main()
