"""A second or two of play in every mode: each line either way, and of the recordings, is as the schemas say (traffic.py)."""

import tempfile
import unittest

import traffic


class Traffic(unittest.TestCase):
    def test_a_game_of_every_mode(self):
        seen = traffic.Seen()
        with tempfile.TemporaryDirectory() as folder:
            traffic.play(seen, 0.0, folder)
        self.assertEqual(seen.faults, [])
        wanted = [f"client {kind}" for kind in ("join", "input", "chat", "list", "get_map", "resync", "respawn", "skip", "leave", "ping",
                                                "pong", "list_records", "get_ghost")]
        wanted += [f"server {kind}" for kind in ("hello", "welcome", "key", "delta", "ack", "error", "bye", "rooms", "map", "pong", "ping",
                                                 "records", "event joined", "event chat", "event respawned", "event round",
                                                 "event crumb", "event skip")]
        wanted += [f"stream {kind}" for kind in ("header", "keyframe", "step")]
        wanted += [f"recording {kind}" for kind in ("header", "keyframe", "step", "index", "end")]
        self.assertEqual([kind for kind in wanted if not seen.counts[kind]], [], seen.counts)
        self.assertTrue({"stale_seq", "too_far", "no_louse", "bad_json", "missing_field"} <= set(seen.refusals), seen.refusals)


if __name__ == "__main__":
    unittest.main()
