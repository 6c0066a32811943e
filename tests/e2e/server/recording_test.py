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
        self.assertEqual((code, verdict), (0, "ok 420 ticks\n"), errors)
        steps = [line for line in lines if "step" in line]
        self.assertEqual([line["step"] for line in steps], list(range(420)))
        self.assertTrue(all("hash" in line for line in steps))
        self.assertEqual(sum("keyframe" in line for line in lines), 1)
        self.assertGreater(sum(len(line.get("inputs", [])) for line in steps), 78)
        names = json.dumps([line["roster"] for line in steps if "roster" in line])
        for name in ("mara", "timo", "Rolly", "Sherpa"):
            self.assertIn(name, names)

    def test_one_altered_input_is_caught(self):
        self.play()
        with open(self.file) as file:
            text = file.read().splitlines(keepends=True)
        # The first input of a step in the middle, whatever way it is written: its thrust's first digit changes.
        at = next(i for i in range(200, len(text)) if '"inputs"' in text[i])
        line = json.loads(text[at])
        alter_a_number(line["inputs"][0])
        text[at] = json.dumps(line, separators=(",", ":")) + "\n"
        with open(self.file, "w") as file:
            file.writelines(text)
        code, verdict, errors = run("verify", self.file)
        self.assertEqual(code, 1, verdict + errors)
        self.assertNotIn("ok ", verdict)
        self.assertIn(f"differs at tick {line['step'] + 1}:", verdict)

    def test_several_rooms_have_a_file_each(self):
        with Server("--record", self.file, "--bots", "1", "--ticks", "30", maps=("volcano", "hills")) as server:
            self.assertEqual(server.finish()[0], 0)
        names = sorted(os.listdir(self.folder.name))
        self.assertEqual(names, ["game.hills.ndjson", "game.volcano.ndjson"])
        for name in names:
            self.assertEqual(run("verify", os.path.join(self.folder.name, name))[:2], (0, "ok 30 ticks\n"))

    def test_a_killed_server_leaves_a_recording_that_verifies_as_far_as_it_goes(self):
        with Server("--record", self.file, "--bots", "2") as server, server.player() as player:
            for _ in range(50):
                player.expect("delta")
            server.process.kill()
            server.process.wait()
        code, verdict, errors = run("verify", self.file)
        self.assertEqual((code, verdict.split()[0]), (0, "ok"), verdict + errors)

    def test_a_full_disk_ends_the_recording_with_a_loud_line_and_never_the_game(self):
        with Server("--record", "/dev/full", "--bots", "2") as server, server.player() as player:
            server.wait_for_log("RECORDING ENDED")
            for _ in range(30):
                player.expect("delta")
            self.assertEqual(server.stop()[0], 0)
            self.assertEqual(server.log().count("RECORDING ENDED"), 1)

    def test_the_same_seed_gives_the_bots_the_same_game(self):
        hashes = []
        for _ in range(2):
            with Server("--record", self.file, "--bots", "4", "--ticks", "200", "--seed", "7") as server:
                self.assertEqual(server.finish()[0], 0)
            with open(self.file) as file:
                hashes.append([json.loads(line).get("hash") for line in file])
        self.assertEqual(hashes[0], hashes[1])


def alter_a_number(entry):
    """Flips the sign of the first fraction found, or adds to the last whole number: another push."""
    items = list(entry.items() if isinstance(entry, dict) else enumerate(entry))
    for key, value in items:
        if isinstance(value, list):
            return alter_a_number(value)
        if isinstance(value, float) and value != 0:
            entry[key] = -value
            return None
    for key, value in reversed(items):
        if isinstance(value, int) and not isinstance(value, bool):
            entry[key] = value + 1
            return None
    raise AssertionError(f"no number in {entry}")


if __name__ == "__main__":
    unittest.main()
