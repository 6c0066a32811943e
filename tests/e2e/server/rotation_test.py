"""A room that plays its games in turns: who is here goes along, each game has a recording of its own that verifies."""

import os
import subprocess
import sys
import tempfile
import unittest

from wire import MAPS, Server, run

BOTS = os.path.join(os.path.dirname(MAPS), "bots", "python")


class Rotation(unittest.TestCase):
    def next_game(self, voter, others=()):
        """Votes, and waits for the welcome of everybody."""
        voter.send({"type": "skip"})
        welcomes = [member.expect("welcome") for member in (voter, *others)]
        for member in (voter, *others):
            member.key, member.rows = None, {}
        return welcomes

    def test_players_bots_and_watchers_go_from_game_to_game_and_each_game_is_recorded_whole(self):
        with tempfile.TemporaryDirectory() as folder:
            with Server("--rotate", "3", "--bots", "2", "--record", os.path.join(folder, ""), "--shadow", "--seed", "5",
                        maps=("crater_loop", "table")) as server:
                with server.player("mara") as mara, server.player("eye", "spectator") as eye:
                    self.assertEqual(mara.welcome["room"], "rotation")
                    played = [(mara.welcome["map"]["name"], mara.welcome["mode"])]
                    mara.send({"type": "input", "seq": 1, "thrust": 1})
                    self.assertEqual(mara.expect("ack", seq=1)["dropped"], False)
                    for turn in range(4):
                        mine, its = self.next_game(mara, (eye,))
                        self.assertEqual([w["tick"] for w in (mine, its)], [0, 0])
                        self.assertEqual(mine["map"], its["map"])
                        self.assertEqual(sorted(p["role"] for p in mine["players"]), ["bot", "bot", "player"])
                        played.append((mine["map"]["name"], mine["mode"]))
                        for member in (mara, eye):
                            self.assertLess(member.expect("key")["tick"], 60)
                        mara.send({"type": "input", "seq": 2 + turn, "thrust": 1})
                        ack = mara.expect("ack", seq=2 + turn)
                        self.assertEqual((ack["dropped"], ack["you"]["id"]), (False, mine["id"]))
                    games = [("crater_loop", "roam"), ("crater_loop", "race"), ("table", "roam"), ("table", "hill")]
                    self.assertEqual(played, [*games, games[0]])
                    mara.send({"type": "list"})
                    self.assertEqual([r["map"] for r in mara.expect("rooms")["rooms"]], ["crater_loop"])
                    mara.send({"type": "get_map"})
                    self.assertEqual(mara.expect("map")["name"], "crater_loop")
                code, _, printed = server.stop()
                self.assertEqual(code, 0)
                self.assertIn(" 0 differences", printed)
            files = sorted(os.path.join(folder, name) for name in os.listdir(folder))
            self.assertEqual(len(files), 5)
            code, verdict, errors = run("verify", "--from-start", "--complete", *files)
            self.assertEqual((code, errors), (0, ""), verdict)

    def test_the_kits_examples_play_one_game_after_the_other(self):
        with Server("--rotate", "1", maps=("table", "picnic")) as server:
            climber = subprocess.Popen([sys.executable, os.path.join(BOTS, "hill_climber.py"), server.address],
                                       stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
            try:
                with server.player("mara") as mara:
                    while not any(m.get("name") == "Sherpa" for m in [*mara.welcome["players"], *mara.seen]):
                        mara.receive()
                    for _ in range(4):
                        (welcome,) = self.next_game(mara)
                        self.assertIn("Sherpa", [p["name"] for p in welcome["players"]])
                        its = next(p["id"] for p in welcome["players"] if p["name"] == "Sherpa")
                        begun = {}
                        for _ in range(400):  # it drives in each
                            frame = mara.receive()
                            for row in frame.get("louse", ()) if frame["type"] in ("key", "delta") else ():
                                if row[0] == its:
                                    begun.setdefault("at", row[1:3])
                                    begun["now"] = row[1:3]
                            if begun.get("now") != begun.get("at"):
                                break
                        self.assertNotEqual(begun["now"], begun["at"], welcome["mode"])
            finally:
                server.stop()
                _, errors = climber.communicate(timeout=20)
            self.assertNotIn("Traceback", errors)

    def test_a_disk_that_takes_no_recording_costs_the_recording_and_not_the_next_game(self):
        with tempfile.TemporaryDirectory() as folder:
            inside = os.path.join(folder, "nights")
            os.mkdir(inside)
            with Server("--rotate", "1", "--record", os.path.join(inside, "a.ndjson"), maps=("table", "picnic")) as server:
                with server.player("mara") as mara:
                    os.rename(inside, inside + ".gone")
                    (welcome,) = self.next_game(mara)
                    self.assertEqual(welcome["tick"], 0)
                    server.wait_for_log("NOT WRITTEN")
                    mara.expect("key")

    def test_one_game_alone_has_no_turns(self):
        code, _, errors = run("--map", "volcano", "--rotate", "2", "--listen", "127.0.0.1:0")
        self.assertEqual(code, 1)
        self.assertIn("one game alone", errors)


if __name__ == "__main__":
    unittest.main()
