"""Each message, map and line of a recording, altered in each place: removed, misspelt, retyped, one more. The schemas refuse it,
unless the altered one is another good one; which of them are, the programs' own readers say."""

import json
import random
import unittest

from schemas import DOCUMENTS, SOURCE, changed, codec, examples, faults, judge, mutations, row_schema, tables, validator

TABLES = tables()
RS = "\x1e"


class Mutation(unittest.TestCase):
    def compare(self, schema, kind, values, passes_over_unknown, own=lambda value: value, is_finer=lambda value: False):
        """Schema and reader agree about each mutation. passes_over_unknown: the reader takes any further member, the schema
        none. is_finer(mutation): refused by the reader alone, which knows more than the shape."""
        done = [(what, path, mutant) for value in values for what, path, mutant in mutations(value)]
        verdicts = judge(kind, [own(mutant) for _, _, mutant in done])
        counts = {"refused by both": 0, "taken by both": 0, "strict": 0, "finer": 0}
        odd = []
        for (what, path, mutant), verdict in zip(done, verdicts):
            valid, ok = schema.is_valid(mutant), verdict == "ok"
            if valid == ok:
                counts["taken by both" if ok else "refused by both"] += 1
            elif ok and passes_over_unknown and what in ("misspelt", "another member", "removed"):
                counts["strict"] += 1
            elif valid and is_finer(mutant):
                counts["finer"] += 1
            else:
                odd.append(f"{what} {'/'.join(map(str, path))}: the schema {'takes' if valid else 'refuses'}, the reader says {verdict}: "
                           f"{json.dumps(mutant)[:300]}")
            if what in ("misspelt", "another member"):
                self.assertFalse(valid, f"{what} {path} in {mutant}")
        self.assertEqual(odd, [], f"{len(odd)} of {len(done)}")
        return counts

    def required(self, schema, values, optional):
        """Each member whose removal the schema takes is one of those that may be left out."""
        for value in values:
            for what, path, mutant in mutations(value):
                if what == "removed" and schema.is_valid(mutant):
                    self.assertIn(path[-1], optional, value)

    def test_each_message_of_a_client(self):
        values = [*map(json.loads, TABLES["client_samples"]), *examples("client")]
        schema = validator("client")
        counts = self.compare(schema, "client", values, True)
        self.assertGreater(counts["refused by both"], 300)
        self.required(schema, values, {"role", "room", "fields", "format", "resume", "state_hz", "ticks", "tick", "at", "board", "rank", "view", "louse", "stream", "watch",
                                           "radius", "rows", "token", "who", "seconds"})

    def test_each_message_of_a_server(self):
        values = [line for line in [*map(json.loads, TABLES["server_samples"]), *examples("server")]]
        schema = validator("server")
        # Left out by older servers, which the reader still understands; a newer one sends it.
        older = {"name", "resumed", "spectators", "gone", "central_gravity", "core_radius", "tolerance", "equations", "method", "contact", "edges"}
        optional = {"hosts", "address", "code", "rules", "stream", "you", "retry_after_ms", "overview", "knots", "game", "crumbs", "place", "phase", "round", "until", "table"}
        counts = self.compare_server(schema, values)
        self.assertGreater(counts["refused"], 2000)
        in_maps = {"surface", "edges", "physics", "spawns", "race", "forage", "hill", "storage", "fingerprint", "radius", "round_s",
                   "podium_s", "summits", "crumbs", "origin", "scale", "grid"}
        self.required(schema, values, optional | in_maps)
        self.assertFalse(older & optional)

    def test_a_key_that_proves_itself(self):
        """Of who asked for all columns, exact: the reader wants the six members besides, and the row's schema each column."""
        zeros = "0" * 16
        row = [3, 0, 3.25, 0, 0, 0, 1, 0, 0.5, 0, 0, 0, 3.75, 1, 30]
        key = {"type": "key", "tick": 840, "louse": [row], "hash": zeros, "previous": zeros, "inputs": zeros, "roster": zeros, "rules": zeros,
               "link": 839, "generator": zeros}
        schema, rows = validator("server"), validator("row", row_schema(TABLES["all_columns"], "exact"))
        done = list(mutations(key))
        refused = 0
        for (what, path, mutant), verdict in zip(done, judge("all", [mutant for _, _, mutant in done])):
            louse = mutant.get("louse")
            valid = schema.is_valid(mutant) and (not isinstance(louse, list) or all(rows.is_valid(row) for row in louse))
            refused += not valid
            if what == "misspelt" or what == "another member":
                self.assertFalse(valid, path)
            else:
                self.assertEqual(valid, verdict == "ok", f"{what} {path}: {verdict}: {mutant}")
        self.assertGreater(refused, 100)

    def compare_server(self, schema, values):
        """What the reader refuses the schema does; it refuses more, as it is of what servers of this version send. A frame's rows
        are judged by their own schema (codec_test.py), the map in `definition` by its own below."""
        done = [(what, path, mutant) for value in values for what, path, mutant in mutations(value)]
        verdicts = judge("server", [mutant for _, _, mutant in done])
        counts = {"refused": 0, "taken": 0}
        for (what, path, mutant), verdict in zip(done, verdicts):
            valid = schema.is_valid(mutant)
            counts["taken" if valid else "refused"] += 1
            if what in ("misspelt", "another member") or what.startswith("retyped") and verdict != "ok" and path[0] != "louse":
                self.assertFalse(valid, f"{what} {path} in {mutant}")
            if valid and path[0] not in ("louse", "definition", "knots", "base", "tick"):
                self.assertEqual(verdict, "ok", f"{what} {path}: {mutant}")
        return counts

    def test_a_map(self):
        values = [json.loads((SOURCE / "maps" / f"{name}.json").read_text()) for name in
                  ("crater_loop", "picnic", "table", "kepler", "hoffmann_2002", "torus")]
        values.append({"name": "flat", "terrain": {"origin": [0, 0], "spacing": [1, 2], "heights": [[0, 0, 0, 0]] * 4, "scale": 2},
                       "surface": "natural_spline", "edges": "open", "physics": {"contact": "unilateral"},
                       "spawns": [{"position": [1, 1], "heading": [1, 0], "speed": 3}]})
        schema = validator("map")
        self.assertEqual([faults(schema, value) for value in values], [[]] * len(values))
        self.assertEqual(judge("map", values), ["ok"] * len(values))
        # What lies where, and what goes with what, is for the reader; so whatever the schema refuses the reader does.
        counts = self.compare(schema, "map", values, False, is_finer=lambda mutant: True)
        self.assertGreater(counts["refused by both"], 2000)
        self.assertLess(counts["finer"], counts["refused by both"] / 20)

    def test_a_recording_s_lines(self):
        zeros, grid = "0" * 16, [[0, 0, 0, 0]] * 4
        header = {"format": "woodlouse-replay", "version": 3, "behavior": TABLES["numbers"]["behavior"], "build": "of a test", "seed": "42",
                  "tick_hz": 60, "mode": "race", "parent": {"file": "before.ndjson", "tick": 5, "hash": zeros},
                  "map": {"name": "flat", "hash": zeros, "definition": {"name": "flat", "terrain": {"spacing": 1, "heights": grid}}}}
        keyframe = {"keyframe": 1500, "hash": zeros, "previous": zeros, "inputs": zeros, "roster": zeros, "rules": zeros, "link": 1498,
                    "generator": zeros, "next_player": 8, "players": [[3, 17, "anna", "player"], [4, None, "ben", "bot"]],
                    "waiting": [[1510, 3, 17, [32, -64], 12], [1511, 3, 18, None]], "columns": TABLES["all_columns"],
                    "lice": [[3, 0, 3.25, 0, 0, 0, 1, 0, 0.5, 0, 0, 0, 3.75, 1, 30]], "rules_state": "00ff"}
        step = {"step": 1500, "roster": [{"join": 5, "name": "anna", "role": "player"}, {"respawn": 3, "at": "gate"}, {"leave": 2}],
                "inputs": [[3, 17, 64, 8, 12], [4, 2, [32, -64]], [4, 3, None, None, 3]], "hash": zeros}
        quiet = {"step": 1500, "steps": 57, "hash": zeros}
        chat = {"chat": 1500, "player": 5, "name": "anna", "text": "hello"}
        pause = {"pause": 1500, "from": 1764180000, "until": 1764183600}
        end = {"end": 1500, "reason": "SIGTERM", "index": 912334}
        index = {"index": 1500, "inputs": 0, "keyframes": [[1500, 812, 2]], "players": [[3, "anna", "player", 61, None]],
                 "marks": [[60, "join", 3], [1201, "chat", 5]]}
        schema = validator("recording")
        refused = 0
        for before, line, after in (([], header, [keyframe]), ([header], keyframe, []), ([header, keyframe], step, []),
                                    ([header, keyframe], quiet, []), ([header, keyframe], chat, []), ([header, keyframe], pause, []),
                                    ([header, keyframe], index, []), ([header, keyframe, index], end, [])):
            self.assertEqual(faults(schema, line), [], line)
            done = [(what, path, mutant) for what, path, mutant in mutations(line) if "definition" not in path]
            texts = [RS.join(map(json.dumps, [*before, mutant, *after])) + RS for _, _, mutant in [(0, 0, line), *done]]
            verdicts = codec("judge", ["recording\t" + text for text in texts]).splitlines()
            self.assertEqual(verdicts[0], "ok", line)
            for (what, path, mutant), verdict in zip(done, verdicts[1:]):
                valid = schema.is_valid(mutant)
                refused += not valid
                if what in ("misspelt", "another member"):
                    self.assertFalse(valid, f"{what} {path}: {mutant}")
                # Which line may follow which, and an index's rows, are judged elsewhere than where a line is read.
                if valid and path[0] not in ("step", "steps", "keyframe", "chat", "pause", "index", "end", "link"):
                    self.assertEqual(verdict, "ok", f"{what} {path}: {mutant}")
                if not valid and line not in (index, header):
                    self.assertNotEqual(verdict, "ok", f"{what} {path}: {mutant}")
        self.assertGreater(refused, 800)

    def test_random_lines_that_a_server_refuses_for_their_shape(self):
        """Two mutations at once, drawn anew by a seed that is kept."""
        draw = random.Random(20021)
        schema = validator("client")
        values = [*map(json.loads, TABLES["client_samples"]), *examples("client")]
        lines = []
        while len(lines) < 1500:
            _, _, mutant = draw.choice(list(mutations(draw.choice(values))))
            again = list(mutations(mutant))
            lines.append(draw.choice(again)[2] if again else mutant)
        refused = 0
        for line, verdict in zip(lines, judge("client", lines)):
            if verdict != "ok":
                refused += 1
                self.assertFalse(schema.is_valid(line), f"{verdict}: {line}")
        self.assertGreater(refused, 500)


if __name__ == "__main__":
    unittest.main()
