"""Live rooms that go on from a tick of a recording."""

import json
import os
import tempfile
import unittest

from wire import Server, run


class Fork(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.game = os.path.join(self.folder.name, "game.ndjson")
        self.fork = os.path.join(self.folder.name, "fork.ndjson")

    def tearDown(self):
        self.folder.cleanup()

    def play(self):
        """Mara and timo push among two bots; returns mara's louse and a tick at which she pushes."""
        with Server("--record", self.game, "--bots", "2", "--seed", "5") as server:
            with server.player("mara") as mara, server.player("timo") as timo:
                for seq in range(1, 6):
                    timo.send({"type": "input", "seq": seq, "thrust": [0.1, 0.9]})
                    mara.send({"type": "input", "seq": seq, "thrust": [0.7, -0.2]})
                    tick = mara.expect("ack", seq=seq)["tick"]
                for _ in range(10):
                    mara.expect("delta")
                self.assertEqual(server.stop()[0], 0)
        return mara.id, tick + 5

    def header_and_keyframes(self):
        with open(self.fork) as file:
            lines = [json.loads(line) for line in file]
        return lines[0], [line for line in lines if "keyframe" in line]

    def test_a_recording_goes_on_live_its_player_moves_again_and_the_new_recording_verifies_by_itself(self):
        louse, tick = self.play()
        state = json.loads(run("inspect", self.game, "--tick", str(tick))[1])
        with Server("--record", self.fork, "--bots", "1", "--shadow", "--adopt-by-name", fork=(self.game, tick)) as server:
            with server.player("eve", role="spectator", fields="all", format="exact") as eve:
                self.assertGreaterEqual(eve.welcome["tick"], tick)
                names = {player["id"]: player["name"] for player in eve.welcome["players"]}
                self.assertEqual([names[id] for id in (1, 2, louse, 7 - louse)], ["Rolly", "Sherpa", "mara", "timo"])
                self.assertEqual(sorted(row[0] for row in eve.expect("key")["louse"]), [1, 2, 3, 4])
                with server.player("mara") as mara, server.player("newcomer") as newcomer:
                    self.assertEqual((mara.id, newcomer.id), (louse, 5))
                    mara.send({"type": "input", "seq": 1, "thrust": [-0.5, 0.75]})
                    first = mara.expect("ack", seq=1)["you"]
                    self.assertEqual((first["id"], first["thrust"]), (louse, [-0.5, 0.75]))
                    for _ in range(6):
                        mara.expect("delta")
                    mara.send({"type": "input", "seq": 2, "thrust": 0}, {"type": "chat", "text": "back again"})
                    second = mara.expect("ack", seq=2)["you"]
                    self.assertNotEqual((first["x"], first["y"]), (second["x"], second["y"]))
                    code, _, printed = server.stop()
                    self.assertEqual(code, 0)
                    self.assertIn(" 0 differences", printed)
        code, verdict, errors = run("verify", self.fork)
        self.assertEqual((code, verdict.split()[0]), (0, "ok"), verdict + errors)
        header, keyframes = self.header_and_keyframes()
        self.assertEqual(header["parent"], {"file": self.game, "tick": tick, "hash": state["hash"]})
        for field in ("keyframe", "hash", "generator", "lice"):
            self.assertEqual(keyframes[0][field], state[field], field)
        counted_anew = [[player[0], None, *player[2:]] for player in state["players"]]
        self.assertEqual(keyframes[0]["players"], counted_anew)
        self.assertEqual(run("verify", self.game)[0], 0)
        with self.subTest("a fork of the fork"), Server("--adopt-by-name", fork=(self.fork, tick + 1)) as server, server.player("timo") as timo:
            self.assertEqual(timo.id, 7 - louse)

    def test_a_fork_ends_after_as_many_ticks_as_were_asked_for(self):
        _, tick = self.play()
        with Server("--record", self.fork, "--ticks", "40", fork=(self.game, tick)) as server:
            self.assertEqual(server.finish()[0], 0)
        self.assertEqual(run("verify", self.fork)[:2], (0, f"ok ticks {tick} to {tick + 40}, the start is taken on trust\n"))

    def test_what_can_not_go_on_is_told_in_one_line_of_what_and_one_of_what_to_do(self):
        _, tick = self.play()
        damaged = os.path.join(self.folder.name, "damaged.ndjson")
        with open(self.game) as good, open(damaged, "w") as bad:
            bad.write(good.read().replace('{"step":3,', '{"step":3;'))
        for arguments, words in (
            ((self.game, "--tick", "100000"), "has no tick 100000, only 0 to "),
            ((damaged, "--tick", str(tick)), damaged + ":"),
            (("/no/such/file", "--tick", "3"), "/no/such/file"),
            ((self.game, "--tick", "-1"), "a whole number from 0 on is wanted, not -1"),
            ((self.game, "--tick", "3", "--state-hz", "25"), "--state-hz 25"),
            ((self.game,), "--tick"),
        ):
            with self.subTest(arguments):
                code, printed, errors = run("fork", *arguments, "--ticks", "1", "--listen", "127.0.0.1:0")
                self.assertNotEqual((code, printed), (0, ""))
                self.assertIn(words, errors)
                self.assertEqual(len(errors.splitlines()), 2, errors)
        self.assertEqual(run("verify", self.game)[0], 0)


if __name__ == "__main__":
    unittest.main()
