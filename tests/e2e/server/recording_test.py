"""Recordings that a running server wrote: they verify, and an altered one is caught."""

import json
import os
import tempfile
import unittest

from wire import Server, run


class Recording(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.file = os.path.join(self.folder.name, "game.ndjson")

    def tearDown(self):
        self.folder.cleanup()

    def play(self):
        """Two players steer among bots for some seconds, one leaves early, one respawns."""
        with Server("--record", self.file, "--bots", "4", "--ticks", "420", "--seed", "99") as server:
            with server.player("mara") as mara, server.player("timo") as timo:
                for seq in range(1, 40):
                    mara.send({"type": "input", "seq": seq, "thrust": [0.7, -0.2 + seq / 100], "ticks": 20})
                    timo.send({"type": "input", "seq": seq, "thrust": (-1) ** seq})
                    mara.expect("ack", seq=seq)
                mara.send({"type": "respawn"})
                timo.send({"type": "chat", "text": "bye"}, {"type": "leave"})
                timo.until_end()
                mara.until_end()
            self.assertEqual(server.finish()[0], 0)
        with open(self.file) as file:
            return [json.loads(line) for line in file]

    def test_what_was_played_verifies_and_holds_inputs_names_and_every_hash(self):
        lines = self.play()
        code, verdict, errors = run("verify", self.file)
        self.assertEqual((code, verdict), (0, "ok ticks 0 to 420\n"), errors)
        steps = [line for line in lines if "step" in line]
        self.assertEqual([line["step"] for line in steps], list(range(420)))
        self.assertTrue(all("hash" in line for line in steps))
        self.assertEqual([line["keyframe"] for line in lines if "keyframe" in line], [0, 300])
        self.assertGreater(sum(len(line.get("inputs", [])) for line in steps), 78)
        names = json.dumps([line["roster"] for line in steps if "roster" in line])
        for name in ("mara", "timo", "Rolly", "Sherpa"):
            self.assertIn(name, names)

    def test_one_altered_input_is_caught(self):
        self.play()
        with open(self.file) as file:
            text = file.read().splitlines(keepends=True)
        at = next(i for i in range(200, len(text)) if '"inputs"' in text[i] and "step" in text[i])
        line = json.loads(text[at])
        alter_thrust(line["inputs"][0])
        text[at] = json.dumps(line, separators=(",", ":")) + "\n"
        with open(self.file, "w") as file:
            file.writelines(text)
        code, verdict, errors = run("verify", self.file)
        self.assertEqual(code, 1, verdict + errors)
        self.assertNotIn("ok ", verdict)
        self.assertIn(f"differs at tick {line['step'] + 1}:", verdict)

    def test_a_restart_writes_beside_last_nights_game(self):
        for file, numbered in (("game.ndjson", "game.1.ndjson"), ("game.ndjson.zst", "game.1.ndjson.zst")):
            path = os.path.join(self.folder.name, file)
            for ticks in ("20", "30"):
                with Server("--record", path, "--bots", "1", "--ticks", ticks) as server:
                    self.assertEqual(server.finish()[0], 0)
                    errors = server.log()
            self.assertIn(f"{path} is there already: recording to {os.path.join(self.folder.name, numbered)}", errors)
            for name, ticks in ((file, 20), (numbered, 30)):
                self.assertEqual(run("verify", os.path.join(self.folder.name, name))[:2], (0, f"ok ticks 0 to {ticks}\n"))

    def test_several_rooms_have_a_file_each(self):
        with Server("--record", self.file, "--bots", "1", "--ticks", "30", maps=("volcano", "hills")) as server:
            self.assertEqual(server.finish()[0], 0)
        names = sorted(os.listdir(self.folder.name))
        self.assertEqual(names, ["game.hills.ndjson", "game.volcano.ndjson"])
        for name in names:
            self.assertEqual(run("verify", os.path.join(self.folder.name, name))[:2], (0, "ok ticks 0 to 30\n"))

    def test_a_killed_server_leaves_a_recording_that_verifies_up_to_a_second_before(self):
        for name in ("game.ndjson", "game.ndjson.zst"):
            file = os.path.join(self.folder.name, name)
            with self.subTest(name), Server("--record", file, "--bots", "2") as server, server.player() as player:
                for _ in range(50):
                    tick = player.expect("delta")["tick"]
                server.process.kill()
                server.process.wait()
                code, verdict, errors = run("verify", file)
                self.assertEqual((code, verdict.split()[0]), (0, "ok"), verdict + errors)
                self.assertIn("cut off", verdict)
                self.assertGreaterEqual(int(verdict.split()[4].rstrip(",")), tick - 60)
                self.assertEqual(run("inspect", file, "--tick", "60")[0], 0)

    def test_a_disk_that_fails_ends_the_recording_with_a_loud_line_and_a_notice_and_never_the_game(self):
        pipe = os.path.join(self.folder.name, "pipe.ndjson")
        os.mkfifo(pipe)
        disk = os.open(pipe, os.O_RDONLY | os.O_NONBLOCK)
        with Server("--record", pipe, "--bots", "2", ends_with=1) as server, server.player() as player:
            player.expect("delta")
            os.close(disk)
            player.expect("notice", code="recording_ended")
            for _ in range(30):
                player.expect("delta")
            code, _, printed = server.stop()
            self.assertEqual(code, 1)
            self.assertEqual(printed.splitlines()[-1], f"RECORDING LOST: {pipe}: Broken pipe")
            self.assertEqual(server.log().count("RECORDING ENDED"), 1)

    def test_a_packed_recording_is_inspected_at_any_tick_and_tells_who_was_late(self):
        file = os.path.join(self.folder.name, "game.ndjson.zst")
        with Server("--record", file, "--bots", "2") as server, server.player("mara") as mara:
            for _ in range(5):
                mara.expect("delta")
            for seq in range(1, 30):
                late = {"tick": 1} if seq < 5 else {}
                mara.send({"type": "input", "seq": seq, "thrust": [0.5, 0.1], **late})
                mara.expect("ack", seq=seq)
            tick = mara.expect("key")["tick"]
            self.assertEqual(server.stop()[0], 0)
        self.assertEqual(run("verify", "--jobs", "2", file)[0], 0)
        code, state, errors = run("inspect", file, "--tick", str(tick))
        self.assertEqual(code, 0, errors)
        state = json.loads(state)
        self.assertEqual((state["keyframe"], len(state["lice"])), (tick, 3))
        code, summary, errors = run("inspect", file, "--summary")
        self.assertEqual(code, 0, errors)
        code, table, errors = run("inspect", file, "--error")
        self.assertEqual(code, 0, errors)
        self.assertEqual([line.split()[0] for line in table.splitlines()[3:]], ["1", "2", "3", "all"], table)
        self.assertTrue(0.0 < float(table.splitlines()[-1].split()[2]) < 1e-3, table)
        mara = next(line.split() for line in summary.splitlines() if line.endswith("mara"))
        self.assertEqual((mara[1], mara[4], mara[5]), ("player", "29", "4"), summary)

    def test_the_same_seed_gives_the_bots_the_same_game(self):
        hashes = []
        for _ in range(2):
            with Server("--record", self.file, "--bots", "4", "--ticks", "200", "--seed", "7") as server:
                self.assertEqual(server.finish()[0], 0)
            with open(self.file) as file:
                hashes.append([json.loads(line).get("hash") for line in file])
        self.assertEqual(hashes[0], hashes[1])


def alter_thrust(row):
    """Another push, no longer than the one before: player, seq, thrust, margin, ticks."""

    def nearer_to_zero(value):
        return value - 1 if value > 0 else value + 1

    if isinstance(row[2], list):
        at = 0 if row[2][0] else 1
        row[2][at] = nearer_to_zero(row[2][at])
    else:
        row[2] = nearer_to_zero(row[2])


if __name__ == "__main__":
    unittest.main()
