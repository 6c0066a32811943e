"""Whatever bytes a file, its name, an option or a player's name holds: what the programs print stays text in lines."""

import json
import os
import subprocess
import tempfile
import unittest

from wire import PROGRAM, map_file

SCENARIO = os.environ["WOODLOUSE_SCENARIO"]
SWARM = os.environ["WOODLOUSE_SWARM"]

# What a terminal obeys: ESC and BEL and DEL; newline; return, NEL and separators; C1's CSI, an override, an isolate, marks, what has no
# shape, a tag. Few together: a program is started for each, and none may hide behind where a long text is cut.
NASTY = ["\x1b[2J\x1b]0;title\x07\x7f", "\n", "\r\u0085\u2028\u2029",
         "\u009b31m\u202e\u2066\u200e\u200f\u061c\ufeff\u200b\u00ad\U000e0061"]
FORBIDDEN = [range(0x00, 0x0a), range(0x0b, 0x20), range(0x7f, 0xa0), range(0x200b, 0x2010), range(0x2028, 0x202f),
             range(0x2060, 0x2070), [0xad, 0x61c, 0xfeff], range(0xe0000, 0xe1000)]


def run(program, *arguments, environment=None):
    done = subprocess.run([program, *arguments], capture_output=True, timeout=60, env={**os.environ, **(environment or {})})
    return done.returncode, done.stdout + done.stderr


class OutsideText(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def path(self, name):
        return os.path.join(self.folder.name, name)

    def write(self, name, text):
        """A file of these bytes: its path."""
        with open(self.path(name), "wb") as out:
            out.write(text if isinstance(text, bytes) else text.encode())
        return self.path(name)

    def assert_text(self, printed, lines=None):
        text = printed.decode()  # UTF-8, or an error
        self.assertTrue(text.endswith("\n"), text)
        found = {hex(ord(c)) for c in text if any(ord(c) in codes for codes in FORBIDDEN)}
        self.assertEqual(found, set(), repr(text))
        if lines is not None:
            self.assertEqual(len(text.splitlines()), lines, repr(text))

    def test_maps(self):
        for nasty in NASTY:
            quoted = json.dumps(nasty)
            for name, text in (("m.json", f'{{"name":{quoted},"terrain":{{"function":{quoted}}},{quoted}:1}}'),
                               ("m.json", f'{{"name":"m","terrain":{{"file":{quoted}}}}}'),
                               ("m.json", f'{{"a":1,{quoted}:1,{quoted}:2}}'),
                               ("m.json", '{"name":' + nasty),
                               ("m.json", b'{"name":"\x9b\xff\x1b"}'),
                               (f"m{nasty}.json", "{}")):
                code, printed = run(PROGRAM, "check", self.write(name, text))
                self.assertEqual(code, 1)
                self.assert_text(printed)
            code, printed = run(PROGRAM, "check", self.path(f"none{nasty}.json"))
            self.assertEqual(code, 1)
            self.assert_text(printed, 1)
            good = self.write(f"good{nasty}.json", '{"name":"m","terrain":{"function":"hills"}}')
            code, printed = run(PROGRAM, "check", good)
            self.assertEqual(code, 0)
            self.assert_text(printed, 1)

    def test_ghosts_beside_maps(self):
        os.mkdir(self.path("ghosts"))
        race = '{"gates":[{"a":[-4,4],"b":[-4,-4]},{"a":[4,4],"b":[4,-4]}],"spawns":[{"position":[-7,0]}],"author_ms":9000}'
        for nasty in NASTY:
            file = self.write(f"m{nasty}.json", f'{{"name":"m","terrain":{{"function":"hills"}},"race":{race}}}')
            code, printed = run(PROGRAM, "check", file)
            self.assertEqual(code, 0)
            self.assert_text(printed)
            self.assertIn(b"nothing proves it", printed)
            ghost = {"type": "ghost", "board": "bots", "name": nasty, "role": "bot", "time": 1, "splits": [1], "when": 0, "start": 0,
                     "behavior": 0, "tick_hz": 60, "spawn": 0, "ticks": 0, "inputs": []}
            for text in (json.dumps(ghost), json.dumps({**ghost, nasty: 1}), json.dumps({**ghost, "board": nasty}), nasty):
                self.write(os.path.join("ghosts", f"m{nasty}.json"), text)
                self.assert_text(run(PROGRAM, "check", file)[1])

    def test_grids(self):
        for nasty in NASTY:
            whole = self.write("m.json", '{"name":"m","terrain":{"file":"g.asc"}}')
            floats = self.write("f.json", '{"name":"m","terrain":{"file":"g.flt"}}')
            self.write("g.asc", f"ncols 4\nnrows x{nasty}\n{nasty}key 4\n")
            self.write("g.flt", "")
            self.write("g.hdr", f"ncols x{nasty}x\n")
            for file in (whole, floats):
                code, printed = run(PROGRAM, "check", file)
                self.assertEqual(code, 1)
                self.assert_text(printed)
            self.write("g.hdr", f"a{nasty}b 4\n")
            self.assert_text(run(PROGRAM, "check", floats)[1])

    def test_config_files_and_options(self):
        for nasty in NASTY:
            for text in (f'{{{json.dumps(nasty)}:1}}', f'{{"listen":{json.dumps(nasty)},"map":"volcano"}}',
                         f'{{"tick_hz":{json.dumps(nasty)}}}', f'{{"bots":{{"a":{json.dumps(nasty)}}}}}',
                         f'{{"map":{json.dumps(nasty)}}}', '{"a":' + nasty, b'{"a":"\x1b\xff\x9b"}', b'\x00\x1b\x9b'):
                code, printed = run(PROGRAM, "--config", self.write("c.json", text))
                self.assertIn(code, (1, 2))
                self.assert_text(printed)
            for arguments in (("--config", self.path("none" + nasty)), ("--tick-hz", nasty), (nasty,), ("--" + nasty,),
                              ("--map", nasty), ("--map", "volcano", "--listen", nasty), ("verify", "x", "--jobs", nasty),
                              ("verify", "x", "--maps", nasty), ("inspect", "x", "--at", nasty),
                              ("--map", "volcano", "--listen", ":0", "--record", self.path(f"no{nasty}/game"))):
                code, printed = run(PROGRAM, *arguments)
                self.assertIn(code, (1, 2), arguments)
                self.assert_text(printed)
            code, printed = run(PROGRAM, "--map", "volcano", environment={"WOODLOUSE_TICK_HZ": nasty})
            self.assertEqual(code, 2)
            self.assert_text(printed)
            for program in (SCENARIO, SWARM):
                code, printed = run(program, "--" + nasty)
                self.assertEqual(code, 2)
                self.assert_text(printed)

    def test_scenarios(self):
        for nasty in NASTY:
            quoted = json.dumps(nasty)
            for name, text in (("s.json", f'{{{quoted}:1}}'), ("s.json", f'{{"behavior":0,"map":{quoted},"script":[],"hashes":{{"1":null}}}}'),
                               ("s.json", f'{{"behavior":0,"map":"volcano","script":[{{{quoted}:0}}],"hashes":{{{quoted}:null}}}}'),
                               ("s.json", '{"map":' + nasty), (f"s{nasty}.json", "{}")):
                code, printed = run(SCENARIO, "run", "--maps", os.path.dirname(map_file("volcano")), self.write(name, text))
                self.assertEqual(code, 2)
                self.assert_text(printed)
                os.remove(self.path(name))
            self.assert_text(run(SCENARIO, "run", self.path("none" + nasty))[1])
            name = f"good{nasty}.json"
            good = self.write(name, '{"behavior":0,"map":"volcano","script":[],"hashes":{"1":null}}')
            code, printed = run(SCENARIO, "run", "--maps", os.path.dirname(map_file("volcano")), "--update", "--table", good)
            self.assertEqual(code, 0, printed)
            self.assert_text(printed)
            os.remove(good)
            self.write("goldens.txt", f"1 a{nasty}b\n")
            good = self.write("good.json", '{"behavior":0,"map":"volcano","script":[],"hashes":{"1":null}}')
            self.assert_text(run(SCENARIO, "run", "--maps", os.path.dirname(map_file("volcano")), good)[1])
            os.remove(self.path("goldens.txt"))
            os.remove(good)

    def recording(self):
        """The lines of a short game."""
        code, printed = run(PROGRAM, "--map", map_file("volcano"), "--listen", "127.0.0.1:0", "--bots", "1", "--ticks", "30",
                            "--record", self.path("game.ndjson"))
        self.assertEqual(code, 0, printed)
        with open(self.path("game.ndjson"), encoding="utf-8") as lines:
            return lines.read().splitlines()

    def test_recordings(self):
        lines = self.recording()
        commands = [("inspect",), ("inspect", "--tick", "20"), ("inspect", "--summary"), ("verify",), ("fork", "--tick", "999"),
                    ("fork", "--tick", "20", "--ticks", "1", "--listen", "127.0.0.1:0")]
        for nasty in NASTY:
            quoted = json.dumps(nasty, ensure_ascii=False)
            build = json.loads(lines[0])["build"]
            steps = [json.loads(line) for line in lines if line.startswith('{"step"')]
            bot = next(entry["name"] for step in steps for entry in step.get("roster", []) if "join" in entry)
            broken = {
                "build": [line.replace(f'"{build}"', quoted) for line in lines],
                "name": [line.replace(f'"{bot}"', json.dumps(bot + nasty, ensure_ascii=False)) for line in lines],
                "reason": [line.replace('"ticks done"', quoted) for line in lines],
                "hash": [lines[0].replace('"hash":"', '"hash":' + quoted + ',"x":"', 1), *lines[1:]],
                "file": [lines[0][:lines[0].index('"definition":')] + f'"file":{quoted}}}}}', *lines[1:]],
                "key": [lines[0], "{" + quoted + ":1}"],
                "syntax": [lines[0], '{"keyframe":' + nasty],
                "step": [*lines[:5], '{"step":' + quoted + "}"],
            }
            for name, text in broken.items():
                file = self.write(f"r{name}{nasty}.ndjson", "\n".join(text) + "\n")
                for command, *options in commands:
                    code, printed = run(PROGRAM, command, file, *options)
                    if printed:
                        self.assert_text(printed)
                self.assert_text(run(PROGRAM, "verify", file, file)[1])
                os.remove(file)
        for name in ("\x1b[2J", "a\nb"):
            self.assert_text(run(PROGRAM, "inspect", self.path("none" + name))[1], 1)

    def test_a_servers_log_and_summary(self):
        for nasty in ("\x1b[2J\n", "\u009b\u202e"):
            file = self.write(f"m{nasty}.json", json.dumps({"name": "a\u202eb", "terrain": {"function": "hills"}}))
            for log in ("text", "json"):
                code, printed = run(PROGRAM, "--map", file, "--listen", "127.0.0.1:0", "--ticks", "3", "--log-format", log,
                                    "--record", self.path(f"game{nasty}"))
                self.assertEqual(code, 0)
                self.assert_text(printed)


if __name__ == "__main__":
    unittest.main()
