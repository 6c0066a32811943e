"""bench/crowd_table.py takes the right figures out of what programs say, and sees when a louse stops pushing.

Usage: crowd_table_test.py SOURCE_DIR
"""
import pathlib
import sys
import unittest

ROOT = pathlib.Path(sys.argv.pop(1)).resolve()
sys.path[:0] = [str(ROOT / "bench" / "crowd"), str(ROOT / "bench")]
from crowd_table import wanted  # noqa: E402
from line_client import Watched  # noqa: E402
from programs import Server, ack, gap, number, refused  # noqa: E402
from rows import ROWS, medians  # noqa: E402

REPORT = """healthy: 5 clients, 5 joined, 0 disconnected, 0 stalled, 0 connects tried again
healthy before the load: gap p50 50.00 p99 50.06 max 50.07 ms (295), missed 0 of 300, ack p50 7.00 p99 16.00 max 17.00 ms (76)
healthy while it lasts: gap p50 50.01 p99 54.57 max 61.00 ms (305), missed 0 of 300, ack p50 7.10 p99 16.10 max 17.10 ms (74)
healthy under load: gap p50 50.02 p99 55.00 max 62.00 ms (430), missed 3 of 425, ack p50 7.20 p99 16.20 max 17.20 ms (150)
others join refused: 981 x room_full
others lost: 981 x room_full: join: room volcano is full (1024); try again later or another room
others lost: 2 x read: End of file
"""


def frame(kind, rows, **more):
    return {"type": kind, "louse": rows, **more}


class CrowdTable(unittest.TestCase):
    def test_figures_of_a_report(self):
        self.assertEqual(gap(REPORT, "p99"), 55.0)
        self.assertEqual(gap(REPORT, "max"), 62.0)
        self.assertEqual(gap(REPORT, "p99", "while it lasts"), 54.57)
        self.assertEqual(ack(REPORT, "p99"), 16.2)
        self.assertEqual(refused(REPORT), 983)
        self.assertRaises(RuntimeError, number, r"^nothing (\d+)", REPORT)

    def test_the_latest_room_counts(self):
        server = Server.__new__(Server)
        server.summary = ("volcano: ticks 9, lateness p50 0.1 ms p99 2.5 ms max 3.5 ms, work p50 9.0 ms p99 99.0 ms, clock moves 0\n"
                          "volcano-2: ticks 9, lateness p50 0.1 ms p99 4.5 ms max 4.75 ms, work p50 9.0 ms p99 99.0 ms, clock moves 0\n")
        self.assertEqual(server.lateness("p99"), 4.5)
        self.assertEqual(server.lateness("max"), 4.75)

    def test_medians_are_of_what_was_run(self):
        self.assertEqual(medians([(1, 9), None, (3, 8), (2, 7)]), (2, 8))
        self.assertIsNone(medians([None, None]))
        self.assertIsNone(medians([]))

    def test_rows_go_by_name_and_by_number(self):
        self.assertEqual([row.name for row in wanted("2,8c")], ["2a", "2b", "8c"])
        self.assertEqual(wanted(None), list(ROWS))
        self.assertRaises(SystemExit, wanted, "1,77")

    def test_a_louse_pushes_as_its_last_frame_says(self):
        watched = Watched(7)
        self.assertFalse(watched.pushes())
        watched.take(frame("key", [[3, 0, 0], [7, 64, 0]]))
        self.assertTrue(watched.pushes())
        watched.take(frame("delta", [[3, 1, 1]]))
        self.assertTrue(watched.pushes())
        watched.take(frame("delta", [[7, 0, 0]], gone=[]))
        self.assertFalse(watched.pushes())
        watched.take(frame("delta", [[3, 1, 1]]))
        self.assertTrue(watched.pushes())
        watched.take(frame("delta", [], gone=[7]))
        self.assertFalse(watched.pushes())


if __name__ == "__main__":
    unittest.main()
