"""Records of a race: driven live, shown, proven by files alone, kept through kill -9, refused when altered."""

import json
import os
import signal
import tempfile
import time
import unittest

from wire import PATIENCE, Server, run

FLAT = [[0] * 9 for _ in range(5)]
# Level ground that wraps, without friction: a push of a second laps it forever.
RING = {
    "name": "ring",
    "terrain": {"spacing": 5, "heights": FLAT},
    "edges": "wrap",
    "physics": {"drag": 0, "friction": 0, "thrust_max": 60},
    "spawns": [{"position": [-16, 1]}, {"position": [-17, -1]}],
    "race": {
        "laps": 2,
        "gates": [{"a": [-15, 4], "b": [-15, -4]}, {"a": [0, 4], "b": [0, -4]}, {"a": [15, 4], "b": [15, -4]}],
        "round_s": 600,
    },
}


class Records(unittest.TestCase):
    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.folder = os.path.join(self.temporary.name, "records")
        self.map = os.path.join(self.temporary.name, "ring.json")
        with open(self.map, "w") as file:
            json.dump(RING, file)

    def tearDown(self):
        self.temporary.cleanup()

    def server(self, *arguments, **options):
        return Server("--records", self.folder, "--mode", "race", *arguments, maps=(self.map[:-5],), **options)

    def file(self):
        (name,) = os.listdir(self.folder)
        return os.path.join(self.folder, name)

    def lines(self):
        with open(self.file()) as file:
            return file.read().splitlines(keepends=True)

    def drive(self, client, seq, push):
        """From a spawn through two laps. The run's event."""
        client.send({"type": "respawn"})
        tick = client.expect("event", kind="respawned", id=client.id)["tick"]
        client.send({"type": "input", "seq": seq, "thrust": [push, 0], "ticks": 60})
        client.send({"type": "input", "seq": seq + 1, "thrust": [0, 0.125], "ticks": 1, "tick": tick + 100})
        return client.expect("event", kind="run", id=client.id)

    def rows(self, client, board="people", count=None):
        """Rows come to the board once they are re-run."""
        end = time.monotonic() + PATIENCE
        while True:
            client.send({"type": "list_records", "board": board})
            answer = client.expect("records", board=board)
            if count is None or len(answer["rows"]) == count or time.monotonic() > end:
                return answer["rows"]
            time.sleep(0.1)

    def one_record(self):
        """Driven, then killed without a word. Its ghost as it was answered."""
        with self.server() as server:
            with server.player("mara") as mara:
                mara.expect("event", kind="joined", id=mara.id)
                ended = self.drive(mara, 1, 0.75)
                told = mara.expect("event", kind="record", id=mara.id)
                self.assertEqual((told["time"], told["bots"]), (ended["time"], 0))
                mara.send({"type": "get_ghost"})
                ghost = mara.expect("ghost")
                end = time.monotonic() + PATIENCE
                while len(self.lines()) < 2 and time.monotonic() < end:
                    time.sleep(0.05)
                server.process.send_signal(signal.SIGKILL)
                mara.until_end()
        return ghost

    def test_a_run_is_a_record_and_stands_after_kill_9(self):
        ghost = self.one_record()
        self.assertEqual((ghost["name"], ghost["role"], ghost["board"]), ("mara", "player", "people"))
        self.assertEqual(len(ghost["splits"]), 6)
        self.assertEqual(ghost["splits"][-1], ghost["time"])
        self.assertEqual([row[1:] for row in ghost["inputs"]], [[2, 0.75, 0, 60], [2, 0, 0.125, 1]])
        self.assertEqual(json.loads(self.lines()[1]), ghost)
        code, told, errors = run("records", "verify", self.folder)
        self.assertEqual(code, 0, told + errors)
        self.assertIn("1 runs re-run, all the same", told)
        with open(self.file(), "a") as file:
            file.write('{"type":"ghost","board":"peo')
        with self.server() as server:
            server.wait_for_log("the last line was cut off")
            with server.player("timo", role="spectator") as timo:
                (row,) = self.rows(timo, count=1)
                self.assertEqual((row["name"], row["time"], row["rank"]), ("mara", ghost["time"], 1))
                self.assertEqual(self.rows(timo, "bots"), [])
                timo.send({"type": "get_ghost", "rank": 2})
                timo.expect("error", code="no_records")
                timo.send({"type": "get_ghost", "rank": 1})
                self.assertEqual(timo.expect("ghost"), ghost)
        self.assertEqual(len(self.lines()), 2)

    def test_only_a_better_run_takes_a_name_s_row_and_bots_have_a_board_of_their_own(self):
        with self.server() as server:
            with server.player("mara") as mara, server.player("robo", role="bot") as robo:
                first = self.drive(mara, 1, 0.5)["time"]
                mara.expect("event", kind="record")
                worse = self.drive(mara, 3, 0.4375)["time"]
                better = self.drive(mara, 5, 1)["time"]
                self.assertTrue(better < first < worse)
                mara.expect("event", kind="record", time=better)
                by_bot = self.drive(robo, 1, 0.875)["time"]
                self.assertEqual(robo.expect("event", kind="record", id=robo.id)["bots"], 1)
                self.assertEqual([row["time"] for row in self.rows(mara)], [better])
                self.assertEqual([(row["name"], row["time"]) for row in self.rows(mara, "bots")], [("robo", by_bot)])
            self.assertEqual(server.stop()[0], 0)
        self.assertEqual(len(self.lines()), 4)  # the header, two of mara's, one of robo's
        code, told, errors = run("records", "list", self.folder)
        self.assertEqual(code, 0, told + errors)
        self.assertEqual((told.count("mara"), told.count("robo")), (1, 1))
        code, told, errors = run("records", "prune", self.folder, "--keep", "5")
        self.assertEqual(code, 0, told + errors)
        self.assertIn("2 of 3 runs kept", told)
        self.assertEqual(len(self.lines()), 3)
        self.assertEqual(run("records", "verify", self.folder)[0], 0)

    def test_one_altered_input_is_named_by_row_gate_and_tick(self):
        self.one_record()
        header, row = self.lines()
        ghost = json.loads(row)
        ghost["inputs"][0][2] -= 1 / 128
        with open(self.file(), "w") as file:
            file.write(header + json.dumps(ghost, separators=(",", ":")) + "\n")
        code, told, _ = run("records", "verify", self.folder)
        self.assertEqual(code, 1, told)
        self.assertRegex(told, r':2: DIFFERENT: people, "mara", [0-9.]+ s: gate 0, where the clock starts, is said to be '
                               r"driven through at tick \d+\.\d\d, but re-run that is at tick \d+\.\d\d")
        with self.server() as server:
            server.wait_for_log("RECORD REFUSED")
            with server.player("timo") as timo:
                self.assertEqual(self.rows(timo), [])
        self.assertEqual(len(self.lines()), 2)

    def test_what_is_handed_in_has_a_board_of_its_own_and_is_refused_when_altered(self):
        ghost = self.one_record()
        handed = os.path.join(self.temporary.name, "ghost.json")
        with open(handed, "w") as file:
            json.dump({**ghost, "name": "tool"}, file, indent=1)
        code, told, errors = run("records", "add", self.folder, handed, "--map", self.map)
        self.assertEqual(code, 0, told + errors)
        self.assertIn("number 1 of those handed in", told)
        code, told, _ = run("records", "add", self.folder, handed, "--map", self.map)
        self.assertEqual(code, 1, told)
        faster = json.loads(json.dumps(ghost))
        faster["inputs"][0][2] = 1
        with open(handed, "w") as file:
            json.dump(faster, file)
        code, told, _ = run("records", "add", self.folder, handed, "--map", self.map)
        self.assertEqual(code, 1, told)
        self.assertIn("REFUSED: gate 0", told)
        with self.server() as server:
            with server.player("timo") as timo:
                self.assertEqual([row["name"] for row in self.rows(timo, "handed_in", 1)], ["tool"])
                self.assertEqual([row["name"] for row in self.rows(timo)], ["mara"])
            code, told, _ = run("records", "add", self.folder, handed, "--map", self.map)
            self.assertEqual(code, 1)

    def test_a_ghost_beside_a_map_proves_its_author_s_time_or_is_an_error(self):
        ghost = self.one_record()
        author_ms = -(-ghost["time"] * 1000 // (65536 * 60))
        beside = os.path.join(self.temporary.name, "ghosts", "ring.json")

        def check(author_ms=author_ms):
            with open(self.map, "w") as file:
                json.dump({**RING, "race": {**RING["race"], "author_ms": author_ms}}, file)
            code, told, errors = run("check", self.map)
            self.assertEqual(errors, "")
            return code, told

        def lay(text):
            with open(beside, "w") as file:
                file.write(text)

        level = f"{self.map}: ok\n{self.map}: note: race: full thrust climbs every stretch from rest: no gate wants a run-up\n"
        note = f"{self.map}: note: race.author_ms: "
        self.assertEqual(check(), (0, f"{level}{note}nothing proves it: there is no ghosts/ring.json beside the map\n"))
        self.assertEqual(check(0), (0, level))
        os.mkdir(os.path.dirname(beside))
        lay(json.dumps(ghost))
        self.assertEqual(check(), (0, f'{level}{note}proved by ghosts/ring.json ("mara", {author_ms / 1000:.3f} s)\n'))
        self.assertEqual(check(author_ms + 1), (1, f"{self.map}: race.author_ms: is {author_ms + 1}, but ghosts/ring.json proves "
                                                   f"{author_ms} (make it {author_ms}, or take the ghost away)\n"))
        lay(json.dumps({**ghost, "behavior": ghost["behavior"] - 1}))
        self.assertEqual(check(), (0, f"{level}{note}ghosts/ring.json is of behavior {ghost['behavior'] - 1}, can't be re-run here\n"))
        (at, kind, push, *others), *rest = ghost["inputs"]
        lay(json.dumps({**ghost, "inputs": [[at, kind, push - 1 / 128, *others], *rest]}))
        code, told = check()
        self.assertEqual(code, 1)
        self.assertIn(f"{beside}: does not prove the map's race.author_ms: gate 0, where the clock starts, is said", told)
        for text in ("", "{}", json.dumps(ghost) + " " * (5 << 20)):
            lay(text)
            code, told = check()
            self.assertEqual((code, told[:len(beside)]), (1, beside))
        os.remove(beside)
        os.mkfifo(beside)
        code, told = check()
        self.assertEqual((code, told[:len(beside)]), (1, beside))
        os.remove(beside)
        os.symlink(os.path.join(self.folder, os.listdir(self.folder)[0]), beside)
        self.assertEqual(check()[0], 1)

    def test_a_board_of_another_behavior_stays_readable(self):
        self.one_record()
        header, row = self.lines()
        old = json.loads(header)
        old["behavior"] -= 1
        os.remove(self.file())
        with open(os.path.join(self.folder, "0123456789abcdef.ndjson"), "w") as file:
            file.write(json.dumps({**old, "key": "0123456789abcdef"}) + "\n" + row)
        for command in ("list", "verify"):
            code, told, errors = run("records", command, self.folder)
            self.assertEqual(code, 0, told + errors)
            self.assertIn(f"behavior {old['behavior']}: can't be re-run here", told)
        self.assertIn("mara", run("records", "list", self.folder)[1])
        with self.server() as server:
            with server.player("timo") as timo:
                self.assertEqual(self.rows(timo), [])

    def test_two_servers_do_not_write_one_board(self):
        with self.server():
            code, _, errors = run("--records", self.folder, "--mode", "race", "--map", self.map, "--listen", "127.0.0.1:0")
            self.assertEqual(code, 1)
            self.assertIn("another server writes to it", errors)

    def test_without_records_there_are_none(self):
        with Server(maps=(self.map[:-5],)) as server:
            for room in ("ring", "ring/race"):
                with server.player("timo", room=room) as timo:
                    for ask in ("list_records", "get_ghost"):
                        timo.send({"type": ask})
                        timo.expect("error", code="no_records", fatal=False)

    def test_a_folder_that_goes_away_costs_no_record(self):
        with self.server() as server:
            with server.player("mara") as mara:
                os.rename(self.folder, self.folder + ".gone")
                self.drive(mara, 1, 0.75)
                mara.expect("event", kind="record")
                server.wait_for_log("RECORDS NOT WRITTEN")
                os.rename(self.folder + ".gone", self.folder)
                self.drive(mara, 3, 1)
                mara.expect("event", kind="record")
                server.wait_for_log("written again, nothing is lost")
        self.assertEqual(run("records", "verify", self.folder)[0], 0)

    def test_what_could_not_be_written_is_named_at_the_end(self):
        with self.server(ends_with=1) as server:
            with server.player("mara") as mara:
                os.rename(self.folder, self.folder + ".gone")
                self.drive(mara, 1, 0.75)
                mara.expect("event", kind="record")
                server.wait_for_log("RECORDS NOT WRITTEN")
            code, _, printed = server.stop()
            self.assertEqual(code, 1)
            self.assertRegex(printed, r'RECORD LOST: .*"mara"\'s run of \d+\.\d\d ticks')


if __name__ == "__main__":
    unittest.main()
