"""make-map over files that differ in everything: each becomes a map, is played by bots for 600 ticks, and its
recording verifies; a part is cropped in the file's own coordinates."""
import array
import json
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


def counted(i, j):
    """Of the knot in column i from the west and row j from the south: a height that tells both."""
    return i + 20 * j


def counted_bytes(kind, columns, rows, swapped):
    """The northern row first."""
    heights = array.array(kind, (counted(i, j) for j in reversed(range(rows)) for i in range(columns)))
    if swapped:
        heights.byteswap()
    return heights.tobytes()


class Crop(unittest.TestCase):
    """Each kind of file is cropped in its own coordinates, to the same knots: columns 3 to 8, rows 2 to 6."""

    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory(prefix="woodlouse-crop-")
        cls.addClassCleanup(cls.folder.cleanup)
        cls.path = path = pathlib.Path(cls.folder.name)
        from_south = lambda i, j: counted(i, 9 - j)
        ascii_grid(path / "metres.asc", 12, 10, "xllcorner 500000\nyllcorner 5000000\ncellsize 10", from_south)
        ascii_grid(path / "centre.asc", 12, 10, "xllcenter 0\nyllcenter -90\ndx 10\ndy 20", from_south)
        # What is cut off of a rim moves nothing else.
        ascii_grid(path / "rim.asc", 12, 10, "xllcorner 0\nyllcorner 0\ncellsize 10\nNODATA_value -9999",
                   lambda i, j: -9999 if i < 2 else from_south(i, j))
        ascii_grid(path / "degrees.asc", 12, 10, "xllcorner -84.2\nyllcorner 36.5\ncellsize 0.001", from_south)
        with open(path / "surfer.grd", "w") as file:
            file.write("DSAA\n12 10\n1000 1110\n2000 2090\n0 200\n")
            file.writelines(f"{counted(i, j)}\n" for j in range(10) for i in range(12))
        (path / "metres.hdr").write_text("ncols 12\nnrows 10\nulxmap 300\nulymap 450\nxdim 3\nydim 5\nnodata -1\n")
        (path / "degrees.hdr").write_text("ncols 12\nnrows 10\nxllcorner 11\nyllcorner 47\ncellsize 0.001\n")
        for name in ("metres.flt", "degrees.flt"):
            (path / name).write_bytes(counted_bytes("f", 12, 10, sys.byteorder == "big"))
        (path / "N47E011.hgt").write_bytes(counted_bytes("h", 1201, 1201, sys.byteorder == "little"))

    def make(self, file, crop):
        out = self.path / "made.json"
        out.unlink(missing_ok=True)
        made = run("make-map", self.path / file, f"--crop={crop}", "--out", out)
        return made, json.loads(out.read_text())["terrain"] if out.exists() else None

    def test_by_its_own_coordinates(self):
        second = 1 / 1200
        for file, crop, spacing in (
                ("metres.asc", "500035,5000025,500085,5000065", [10, 10]),
                ("metres.asc", "500026,5000016,500094,5000074", [10, 10]),
                ("centre.asc", "30,-50,80,30", [10, 20]),
                ("rim.asc", "35,25,85,65", [10, 10]),
                ("degrees.asc", "-84.1965,36.5025,-84.1915,36.5065", [89.57, 110.97]),
                ("surfer.grd", "1030,2020,1080,2060", [10, 10]),
                ("metres.flt", "309,415,324,435", [3, 5]),
                ("degrees.flt", "11.0035,47.0025,11.0085,47.0065", [76.05, 111.17]),
                ("N47E011.hgt", f"{11 + 3 * second},{47 + 2 * second},{11 + 8 * second},{47 + 6 * second}", [63.38, 92.64])):
            with self.subTest(file=file, crop=crop):
                made, terrain = self.make(file, crop)
                self.assertEqual(made.returncode, 0, made.stdout + made.stderr)
                self.assertEqual(terrain["heights"], [[counted(i, j) for i in range(3, 9)] for j in range(2, 7)])
                for axis in (0, 1):
                    self.assertAlmostEqual(terrain["spacing"][axis], spacing[axis], delta=0.005 * spacing[axis])

    def test_what_does_not_lie_in_the_grid_is_told_where_that_lies(self):
        for file, crop, range_ in (
                ("metres.asc", "500035,5000025,500185,5000065", "500005,5000005,500115,5000095 (metres)"),
                ("metres.asc", "-40,-40,40,40", "500005,5000005,500115,5000095 (metres)"),
                ("centre.asc", "30,-150,80,30", "0,-90,110,90 (metres)"),
                ("degrees.asc", "0,0,50,50", "-84.1995,36.5005,-84.1885,36.5095 (degrees)"),
                ("surfer.grd", "900,2020,1080,2060", "1000,2000,1110,2090 (metres)"),
                ("metres.flt", "0,0,10,10", "300,405,333,450 (metres)"),
                ("degrees.flt", "47,11,47.01,11.01", "11.0005,47.0005,11.0115,47.0095 (degrees)"),
                ("N47E011.hgt", "10.9,47.2,11.2,47.4", "11,47,12,48 (degrees)")):
            with self.subTest(file=file, crop=crop):
                made, terrain = self.make(file, crop)
                self.assertEqual(made.returncode, 1)
                self.assertEqual(made.stdout, "--crop: reaches past the grid (west,south,east,north; the grid's heights "
                                              f"lie within {range_})\n")
                self.assertIsNone(terrain)
                # What is told is a crop itself: of everything.
                whole, terrain = self.make(file, range_.split()[0])
                self.assertEqual(whole.returncode, 0, whole.stdout)
                self.assertEqual(len(terrain["heights"][0]), 1201 if file.endswith("hgt") else 12)

    def test_what_is_turned_round_or_too_small_is_refused(self):
        for crop, wanted in (("500085,5000025,500035,5000065", "its west is not west of its east"),
                             ("500035,5000065,500085,5000025", "its south is not south of its north"),
                             ("500035,5000025,500055,5000065", "leaves 3 by 5 knots, 4 each way are wanted"),
                             ("500037,5000025,500042,5000065", "leaves 0 by 5 knots")):
            made, _ = self.make("metres.asc", crop)
            self.assertEqual(made.returncode, 1)
            self.assertIn("--crop: " + wanted, made.stdout)
            self.assertIn("lie within 500005,5000005,500115,5000095 (metres)", made.stdout)
        # The corners of the outermost cells, as the header has them, are no mistake.
        made, terrain = self.make("metres.asc", "500000,5000000,500120,5000100")
        self.assertEqual(made.returncode, 0, made.stdout)
        self.assertEqual(len(terrain["heights"]), 10)


class MakeMap(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory(prefix="woodlouse-make-map-")
        self.addCleanup(self.folder.cleanup)
        self.path = pathlib.Path(self.folder.name)

    def make(self, file, *options):
        made = run("make-map", self.path / file, "--out", self.path / (file + ".json"), *options)
        self.assertEqual(made.returncode, 0, made.stdout + made.stderr)
        return made.stdout

    def play(self, *files, mode="roam"):
        """All at once: each plays for 600 ticks of its own. Their logs."""
        games, logs = [], {}
        for file in files:
            record = self.path / (file + ".ndjson.zst")
            written = self.path / (file + ("" if mode == "roam" else f".{mode}") + ".ndjson.zst")
            games.append((written, subprocess.Popen(
                [SERVER, "--map", self.path / (file + ".json"), "--mode", mode, "--listen", "127.0.0.1:0", "--seed", "5", "--bots", "8",
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

    def write_five_grids(self):
        """They differ in everything. Their names."""
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
        return "steep.asc", "holes.asc", "degrees.asc", "surfer.grd", "flat.flt"

    def test_five_grids_that_differ_in_everything_are_played(self):
        files = self.write_five_grids()
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

    def test_bots_drive_through_the_gates_that_it_lays(self):
        self.write_five_grids()
        # The ground between the cliffs of the fifth is no way for anybody.
        for file, scale in (("holes.asc", "0.5"), ("degrees.asc", "0.05"), ("surfer.grd", "1"), ("flat.flt", "0.5")):
            self.make(file, "--modes", "--scale", scale)
        self.play("holes.asc", "degrees.asc", "surfer.grd", "flat.flt", mode="race")
        for file in ("holes", "degrees", "surfer", "flat"):
            (record,) = self.path.glob(file + ".???.race.ndjson.zst")
            rulings = [line.split() for line in run("inspect", "--rulings", record).stdout.splitlines()]
            with self.subTest(file):
                self.assertTrue(any(ruling[1] == "gate" for ruling in rulings), rulings)

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
                                      ("N47E011.hgt", ("--crop", "0,0,1,1"), "--crop: reaches past the grid")):
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
