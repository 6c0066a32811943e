"""bench/compare tells what moved from what scatters, pairs the runs of two trees, and says what it lacks.

Usage: compare_test.py SOURCE_DIR
"""
import importlib.machinery
import importlib.util
import pathlib
import random
import subprocess
import sys
import tempfile
import unittest

COMPARE = pathlib.Path(sys.argv.pop(1)).resolve() / "bench" / "compare"
loader = importlib.machinery.SourceFileLoader("compare", str(COMPARE))
compare = importlib.util.module_from_spec(importlib.util.spec_from_loader("compare", loader))
sys.modules["compare"] = compare
sys.dont_write_bytecode = True
loader.exec_module(compare)


def noisy(ns, share, seed, count=9):
    draw = random.Random(seed)
    return [ns * (1.0 + share * draw.gauss(0.0, 1.0)) for _ in range(count)]


class Compare(unittest.TestCase):
    def test_what_only_scatters_has_not_moved(self):
        for seed in range(50):
            self.assertFalse(compare.judge(noisy(50, 0.005, seed), noisy(50, 0.005, seed + 1000)).moved)

    def test_what_moved_is_told_with_its_direction(self):
        for seed in range(50):
            self.assertEqual(compare.judge(noisy(50, 0.01, seed), noisy(60, 0.01, seed + 1000)).word, "slower")
            self.assertEqual(compare.judge(noisy(50, 0.01, seed), noisy(40, 0.01, seed + 1000)).word, "faster")

    def test_a_machine_that_slows_down_on_the_way_moves_both(self):
        slow = [1.0, 1.0, 1.4, 1.4, 1.4, 1.0, 1.0]
        verdict = compare.judge([50 * s for s in slow], [45 * s for s in slow])
        self.assertAlmostEqual(verdict.ratio, 0.9)
        self.assertTrue(verdict.moved)

    def test_one_wild_round_moves_nothing(self):
        self.assertFalse(compare.judge([50] * 7, [50, 50, 500, 50, 50, 50, 50]).moved)

    def test_who_begins_alternates_and_what_one_tree_lacks_is_left_out(self):
        calls = []

        def measure(build):
            calls.append(build)
            return {"both": 1.0, "new only": 2.0} if build == "new" else {"both": 1.0}

        times = compare.in_turns(["old", "new"], measure, 3)
        self.assertEqual(calls, ["old", "new", "new", "old", "old", "new"])
        self.assertEqual(times, {"both": ([1.0] * 3, [1.0] * 3)})

    def test_a_folder_without_the_program_is_named(self):
        with tempfile.TemporaryDirectory() as folder:
            run = subprocess.run([sys.executable, "-B", COMPARE, folder, folder], capture_output=True, text=True)
        self.assertEqual(run.returncode, 2)
        self.assertIn("no bin/woodlouse-speed in it", run.stderr)


if __name__ == "__main__":
    unittest.main()
