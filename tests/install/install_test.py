"""`cmake --install`: the game runs from where it was put, and a stranger's project builds with what it finds there."""

import json
import os
import pathlib
import socket
import subprocess
import tempfile
import unittest

BUILD = os.environ["WOODLOUSE_BUILD"]
SOURCE = pathlib.Path(__file__).resolve().parent.parent.parent


def run(*command, **options):
    return subprocess.run([str(word) for word in command], capture_output=True, text=True, timeout=300, **options)


class Installed(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.prefix = pathlib.Path(cls.folder.name, "prefix")
        done = run("cmake", "--install", BUILD, "--prefix", cls.prefix)
        assert done.returncode == 0, done.stderr

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def test_everything_is_where_a_packager_looks(self):
        for path in ("bin/woodlouse", "bin/woodlouse-server", "bin/woodlouse-swarm", "bin/woodlouse-scenario",
                     "share/woodlouse/maps/volcano.json", "share/woodlouse/maps/maunga_whau.asc",
                     "share/woodlouse/maps/ghosts/crater_loop.json",
                     "share/woodlouse/python/woodlouse.py", "share/doc/woodlouse/README.md",
                     "share/doc/woodlouse/docs/protocol.md", "include/woodlouse/shared/replay/verify.h",
                     "include/woodlouse/bots/cpp/line_client.h"):
            self.assertTrue((self.prefix / path).is_file(), path)
        self.assertEqual(list(self.prefix.rglob("*test*")), [])
        found = run("grep", "-rlI", str(SOURCE), self.prefix)
        self.assertEqual(found.stdout, "", "no text of it names the folder it was built in")

    def test_the_server_finds_its_maps_and_the_python_module_plays_on_it(self):
        server = subprocess.Popen([self.prefix / "bin" / "woodlouse-server", "--map", "hoffmann_2002", "volcano", "--listen",
                                   "127.0.0.1:0", "--record", pathlib.Path(self.folder.name, "game.ndjson")],
                                  cwd=self.folder.name, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
        try:
            address = server.stdout.readline().split()[1]
            bot = run("python3", "-c", f"""
import sys
sys.path.insert(0, {str(self.prefix / "share/woodlouse/python")!r})
import woodlouse
with woodlouse.connect({address!r}, name="stranger") as game:
    for state in game.states():
        if state.me:
            print(state.me.id)
            break
""", cwd=self.folder.name)
            self.assertEqual(bot.stdout, "1\n", bot.stderr)
            host, port = address.rsplit(":", 1)
            with socket.create_connection((host, int(port)), 10) as wire:
                wire.sendall(b'{"type":"join","protocol":1,"name":"x"}\n')
                lines = wire.makefile()
                lines.readline()
                physics = json.loads(lines.readline())["physics"]
            self.assertEqual((physics["equations"], physics["method"]), ("as_printed", "false_euler"))
        finally:
            server.terminate()
            server.wait(30)
            server.stdout.close()
        game = pathlib.Path(self.folder.name, "game.hoffmann_2002.ndjson")
        verdict = run(self.prefix / "bin" / "woodlouse-server", "verify", "--from-start", "--complete", game)
        self.assertEqual((verdict.returncode, verdict.stdout[:11]), (0, "ok ticks 0 "), verdict.stdout)

    def test_the_time_to_beat_of_an_installed_race_is_proved_where_it_lies(self):
        track = self.prefix / "share/woodlouse/maps/crater_loop.json"
        checked = run(self.prefix / "bin" / "woodlouse-server", "check", track)
        self.assertEqual((checked.returncode, checked.stderr), (0, ""))
        self.assertIn("race.author_ms: proved by ghosts/crater_loop.json", checked.stdout)

    def test_a_strangers_project_builds_proves_a_recording_and_runs_its_scenarios(self):
        for with_bot in ("OFF", "ON"):
            build = pathlib.Path(self.folder.name, "build" + with_bot)
            made = run("cmake", "-S", SOURCE / "tests/install/stranger", "-B", build, "-DCMAKE_BUILD_TYPE=Release",
                       f"-DCMAKE_PREFIX_PATH={self.prefix}", f"-DWITH_BOT={with_bot}", "-DCMAKE_CXX_FLAGS=-Wall")
            self.assertEqual(made.returncode, 0, made.stderr)
            built = run("cmake", "--build", build, "--parallel", "2")
            self.assertEqual(built.returncode, 0, built.stdout + built.stderr)
            tested = run("ctest", "--test-dir", build, "--output-on-failure")
            self.assertEqual(tested.returncode, 0, tested.stdout)
            self.assertIn("100% tests passed, 0 tests failed out of 2", tested.stdout)
            linked = run("ldd", build / "prove").stdout
            self.assertNotIn("boost", linked)

    def test_another_version_is_not_taken(self):
        folder = pathlib.Path(self.folder.name, "other")
        folder.mkdir()
        (folder / "CMakeLists.txt").write_text("cmake_minimum_required(VERSION 3.25)\nproject(other LANGUAGES CXX)\n"
                                               "find_package(woodlouse 99.0 REQUIRED)\n")
        made = run("cmake", "-S", folder, "-B", folder / "build", f"-DCMAKE_PREFIX_PATH={self.prefix}")
        self.assertNotEqual(made.returncode, 0)
        self.assertIn("99.0", made.stderr)


if __name__ == "__main__":
    unittest.main()
