"""Who watches by inputs gets the room's recording as it is written: whole, provable, and nothing that is to come."""

import json
import os
import unittest

from watching import Company, StreamTest, verdict
from wire import Server

import save_stream


class Watching(StreamTest):
    def test_a_stream_saved_to_a_file_is_a_recording_and_an_altered_line_is_told_with_its_tick(self):
        with Server("--bots", "3", "--seed", "5") as server, Company(server):
            names = save_stream.save(server.address, os.path.join(self.folder, "game.ndjson"), 20)
            self.assertEqual(len(names), 1)
        self.assert_proven(names, 900)
        with open(names[0], encoding="utf-8") as file:
            lines = file.read().splitlines()
        text = "\n".join(lines)
        for what in ('"inputs":', '"join":', '"leave":', '"respawn":'):
            self.assertIn(what, text)
        self.assertNotIn('"chat"', text)  # an event tells it
        at = next(k for k, line in enumerate(lines) if k > 300 and '"inputs":[[' in line)
        step = json.loads(lines[at])
        step["inputs"][0][2] = 1 if step["inputs"][0][2] != 1 else 2
        lines[at] = json.dumps(step, separators=(",", ":"))
        altered = os.path.join(self.folder, "altered.ndjson")
        with open(altered, "w", encoding="utf-8") as file:
            file.write("\n".join(lines) + "\n")
        code, said = verdict([altered])
        self.assertEqual(code, 1, said)
        self.assertIn("tick %d" % (step["step"] + 1), said)

    def test_it_is_the_lines_that_the_server_records(self):
        recording = os.path.join(self.folder, "room.ndjson")
        with Server("--bots", "2", "--record", recording) as server, Company(server):
            watcher = self.watcher(server)
            watcher.watch(3)
        with open(recording, encoding="utf-8") as file:
            recorded = set(file.read().splitlines())
        streamed = [line for line in watcher.files[0][2:] if '"steps"' not in line]
        self.assertGreater(len(streamed), 100)
        self.assertEqual([line for line in streamed if line not in recorded], [])

    def test_nothing_that_waits_for_a_step_to_come_is_told(self):
        with Server() as server, server.player("late") as player:
            at = player.expect("key")["tick"] + 110
            player.send({"type": "input", "seq": 1, "thrust": [0.25, 0.5], "tick": at})
            player.send({"type": "ping", "t": 1})
            player.expect("pong")
            watcher = self.watcher(server)
            watcher.watch(until=lambda: watcher.due and watcher.due > at)
            self.assertLess(json.loads(watcher.files[0][1])["keyframe"], at)
            told = [json.loads(line)["step"] for line in watcher.files[0][2:] if "[32,64]" in line]
            self.assertEqual(told, [at])
            self.assert_proven(watcher.save(self.folder), 20)

    def test_a_game_that_goes_on_from_a_recording(self):
        recording = os.path.join(self.folder, "first.ndjson")
        with Server("--bots", "3", "--record", recording) as server, Company(server):
            self.watcher(server).watch(3)
        with Server(fork=(recording, 100)) as server:
            watcher = self.watcher(server)
            watcher.watch(2)
            self.assertNotIn(self.folder, "\n".join(map("\n".join, watcher.files)))  # no path of the host's
        self.assert_proven(watcher.save(self.folder), 60)

    def test_a_quiet_room_is_told_in_few_bytes_and_none_of_its_steps_is_missing(self):
        with Server() as server:
            watcher = self.watcher(server)
            watcher.watch(until=lambda: watcher.steps >= 240)
            lines = watcher.files[0][2:]
            self.assertLess(len(lines), 20)
            self.assertIn('"steps":', lines[-1])

    def test_resync_brings_a_keyframe_and_the_lines_after_it(self):
        with Server("--bots", "2") as server:
            watcher = self.watcher(server)
            watcher.watch(2)
            watcher.send({"type": "resync"})
            watcher.watch(until=lambda: len(watcher.files) == 2 and len(watcher.files[-1]) > 30)
            self.assert_proven(watcher.save(self.folder), 100)

    def test_a_map_of_tiles_is_watched_by_frames(self):
        with Server("--bots", "2", maps=(self.tiled_map(),)) as server:
            with server.client() as client:
                join = {"type": "join", "protocol": 1, "name": "eye", "role": "spectator", "stream": "inputs"}
                client.send(join)
                self.assertIn("watch by frames", client.expect("error", code="bad_field", fatal=False)["text"])
                client.send({**join, "stream": "frames"})
                self.assertNotIn("stream", client.expect("welcome"))
                client.expect("delta")

    def test_players_are_refused(self):
        with Server() as server:
            for role in ("player", "bot"):
                client = server.client()
                client.send({"type": "join", "protocol": 1, "name": "ann", "role": role, "stream": "inputs"})
                self.assertIn("spectator", client.expect("error", code="bad_field")["text"])
                client.send({"type": "join", "protocol": 1, "name": "ann", "role": "spectator", "stream": "lines"})
                self.assertIn("join.stream", client.expect("error", code="bad_field")["text"])
                client.socket.close()


if __name__ == "__main__":
    unittest.main()
