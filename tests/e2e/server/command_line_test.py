"""What people type, and what they are told."""

import json
import os
import tempfile
import unittest

from wire import MAPS, Server, map_file, run


class CommandLine(unittest.TestCase):
    def test_help_is_printable_and_numbers_are_told_in_words(self):
        for command in ([], ["check"], ["make-map"], ["verify"], ["inspect"], ["fork"]):
            code, printed, _ = run(*command, "--help")
            self.assertEqual(code, 0)
            self.assertTrue(all(c.isprintable() or c == "\n" for c in printed), printed)
        for arguments, words in ((("inspect", "x", "--tick", "-1"), "--tick: a whole number from 0 on is wanted, not -1"),
                                 (("inspect", "x", "--at", "-1"), "--at: seconds, 0 or more, are wanted, not -1"),
                                 (("inspect", "x", "--at", "nan"), "not nan"),
                                 (("fork", "x", "--tick", "99999999999999999999"), "not 99999999999999999999"),
                                 (("verify", "x", "--jobs", "0"), "from 1 to 256 is wanted, not 0"),
                                 (("make-map", "x", "--scale", "0"), "from 1e-6 to 1e6 is wanted, not 0"),
                                 (("make-map", "x", "--scale", "nan"), "not nan"),
                                 (("make-map", "x", "--crop", "0,0,nan,1"), "not nan"),
                                 (("make-map", "x", "--crop=-1,-1,1"), "--crop"),
                                 (("--map", "volcano", "--seed", "-1"), "not -1"),
                                 (("--map", "volcano", "--tick-hz", "60.5"), "not 60.5"),
                                 (("--map", "volcano", "--log-format", "xml"), "xml")):
            code, printed, errors = run(*arguments)
            self.assertEqual((code, printed), (2, ""))
            self.assertIn(words, errors)
            self.assertEqual(len(errors.splitlines()), 2, errors)

    def test_check_says_ok_of_every_map_that_is_shipped(self):
        files = sorted(os.path.join(MAPS, name) for name in os.listdir(MAPS) if name.endswith(".json"))
        self.assertGreaterEqual(len(files), 5)
        code, printed, errors = run("check", *files)
        self.assertEqual((code, errors), (0, ""))
        wanted = []
        for file in files:
            wanted.append(file + ": ok")
            with open(file) as opened:
                author_ms = json.load(opened).get("race", {}).get("author_ms")
            if author_ms:
                ghost = "ghosts/" + os.path.basename(file)
                with open(os.path.join(MAPS, ghost)) as opened:
                    name = json.load(opened)["name"]
                wanted.append(f'{file}: note: race.author_ms: proved by {ghost} ("{name}", {author_ms / 1000:.3f} s)')
        self.assertEqual(printed.splitlines(), wanted)
        self.assertEqual(len(wanted) - len(files), 5)

    def test_check_notes_from_which_rate_a_small_core_is_resolved(self):
        with tempfile.TemporaryDirectory() as folder:
            file = os.path.join(folder, "planet.json")
            with open(file, "w") as out:
                out.write('{"name": "planet", "terrain": {"spacing": 8, "heights": [%s]}, "spawns": [{"position": [9, 9]}],'
                          '"physics": {"central_gravity": 100, "core_radius": 0.01}}' % ", ".join(["[0, 0, 0, 0]"] * 4))
            code, printed, _ = run("check", file)
            self.assertEqual(code, 0)
            ok, note = printed.splitlines()
            self.assertEqual(ok, file + ": ok")
            # sqrt(35/8 k / R^3) / 12.8
            self.assertRegex(note, "note: physics.core_radius: 0.01 m is resolved from 1635 ticks a second on.*0.228 m")

    def test_check_names_file_field_and_line_of_what_is_wrong(self):
        with tempfile.TemporaryDirectory() as folder:
            file = os.path.join(folder, "bad.json")
            with open(file, "w") as out:
                out.write('{\n"name": "bad",\n"terrain": {"function": "volcano"},\n"physics": {"gravity": "much"}\n}\n')
            code, printed, _ = run("check", map_file("volcano"), file)
            self.assertEqual(code, 1)
            self.assertIn(map_file("volcano") + ": ok", printed)
            self.assertIn(file + ":4", printed)
            self.assertIn("gravity", printed)
            code, printed, _ = run("check", os.path.join(folder, "missing.json"))
            self.assertEqual(code, 1)
            self.assertIn("missing.json", printed)

    def test_a_port_in_use_is_told_in_two_lines(self):
        with Server() as server:
            code, printed, errors = run("--map", map_file("volcano"), "--listen", server.address)
            self.assertEqual((code, printed), (1, ""))
            self.assertEqual(
                errors.splitlines(),
                [f"woodlouse-server: cannot listen on {server.address}: address already in use",
                 "      another woodlouse server?   try the same with  --listen 127.0.0.1:0   (picks a free port)"],
            )

    def test_what_cannot_start_is_told_in_one_line_of_what_and_one_of_what_to_do(self):
        for arguments, words in (
            ([], "--map"),
            (["--map", "/no/such/map.json"], "/no/such/map.json"),
            (["--map", map_file("volcano"), "--state-hz", "25"], "--state-hz"),
            (["--map", map_file("volcano"), "--listen", "127.0.0.1:99999"], "99999"),
            (["--map", map_file("volcano"), "--listen", "127.0.0.1:0", "--record", "/no/such/folder/f"], "/no/such/folder/f"),
            (["verify", "/no/such/recording"], "/no/such/recording"),
        ):
            code, printed, errors = run(*arguments)
            self.assertNotEqual(code, 0, arguments)
            self.assertIn(words, errors + printed)
            told = [line for line in (errors + printed).splitlines() if " info " not in line]
            self.assertLessEqual(len(told), 2, told)

    def test_variables_and_a_config_file_configure_it_too(self):
        with tempfile.TemporaryDirectory() as folder:
            file = os.path.join(folder, "server.json")
            with open(file, "w") as out:
                json.dump({"map": [map_file("hills")], "listen": "127.0.0.1:0", "ticks": 500, "bots": 1}, out)
            environment = dict(os.environ, WOODLOUSE_TICKS="20", WOODLOUSE_CONFIG=file)
            code, printed, errors = run("--tick-hz", "100", env=environment)
            self.assertEqual(code, 0, errors)
            self.assertTrue(printed.startswith("listening 127.0.0.1:"))
            self.assertIn("hills: ticks 20,", printed)

    def test_the_json_log_is_one_object_a_line(self):
        with Server("--log-format", "json") as server, server.player('q"uote') as player:
            player.expect("delta")
            server.stop()
            entries = [json.loads(line) for line in server.log().splitlines()]
            self.assertTrue(any('q"uote' in entry["message"] for entry in entries))
            self.assertTrue(all({"time", "level", "event", "message"} == set(entry) for entry in entries))


if __name__ == "__main__":
    unittest.main()
