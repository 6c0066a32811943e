"""What befalls a room and its connections breaks no stream: slow readers, a server that stands still, crowds, other games."""

import json
import os
import signal
import threading
import time
import unittest

from watching import Company, StreamTest
from wire import Server, map_file


class Strain(StreamTest):
    def test_who_does_not_read_for_five_seconds_goes_on_from_a_new_keyframe(self):
        with Server("--bots", "30", "--outbox-bytes", "16384") as server, Company(server, count=12, period=0.005):
            watcher = self.watcher(server, receive_buffer=4096)
            steady = self.watcher(server, "steady")
            steady_reader = threading.Thread(target=steady.watch, args=(14,), daemon=True)
            steady_reader.start()
            watcher.watch(1)
            self.assertEqual(len(watcher.files), 1)
            # So small a window opens late once it has been shut, and he may fall behind again meanwhile; and where the machine
            # is busy the crowd says less, of which five seconds may fit into what lies under way.
            for _ in range(4):
                files = len(watcher.files)
                time.sleep(5)
                watcher.watch(60, until=lambda: len(watcher.files) > files and len(watcher.files[-1]) > 20)
                last = [json.loads(file[-1]) for file in watcher.files[:-1]]
                missed = [json.loads(file[1])["keyframe"] - line.get("step", line.get("keyframe"))
                          for line, file in zip(last, watcher.files[1:])]
                if max(missed, default=0) > 60:
                    break
            self.assertGreater(max(missed), 60)
            steady_reader.join(20)
            self.assertEqual(len(steady.files), 1)  # the slow one is nobody else's matter
            self.assertGreater(steady.steps, 500)
        self.assert_proven(watcher.save(self.folder), 100)
        self.assertFalse(any(m["type"] in ("error", "bye", "notice") for m in watcher.seen), watcher.seen[-3:])

    def test_a_server_that_was_stopped_and_goes_on_misses_no_step(self):
        with Server("--bots", "4") as server, Company(server):
            watcher = self.watcher(server)
            watcher.watch(1)
            for _ in range(3):
                server.process.send_signal(signal.SIGSTOP)
                time.sleep(1.2)
                server.process.send_signal(signal.SIGCONT)
                watcher.watch(1)
            self.assertEqual(len(watcher.files), 1)
        self.assert_proven(watcher.save(self.folder), 120)

    def test_a_storm_of_joins_and_of_watchers(self):
        with Server("--bots", "2") as server:
            first = self.watcher(server)
            watchers = []
            players = []
            for k in range(60):
                watchers.append(self.watcher(server, "eye%d" % k))
                players.append(server.player("louse%d" % k) if k % 2 else None)
            for watcher in watchers:
                watcher.watch(until=lambda w=watcher: w.steps > 30)
                self.assertEqual(len(watcher.files), 1)
            first.watch(1)
            self.assertEqual(len(first.files), 1)
            for number, watcher in enumerate([first, watchers[0], watchers[30], watchers[-1]]):
                folder = os.path.join(self.folder, str(number))
                os.mkdir(folder)
                self.assert_proven(watcher.save(folder), 30)
            for player in players:
                if player:
                    player.socket.close()

    def test_rounds_of_each_mode_are_re_run(self):
        for map_name, mode, ends in (("crater_loop", "race", {"round_s": 3}), ("picnic", "forage", {"round_s": 3}),
                                     ("table", "hill", {"hold_s": 1})):
            with open(map_file(map_name), encoding="utf-8") as file:
                definition = json.load(file)
            definition[mode].update(ends, podium_s=1)
            definition[mode].pop("author_ms", None)
            short = os.path.join(self.folder, map_name)
            with open(short + ".json", "w", encoding="utf-8") as file:
                json.dump(definition, file)
            bots = "1" if mode == "hill" else "5"  # more of them let nobody hold a place
            with self.subTest(mode=mode), Server("--bots", bots, "--mode", mode, "--seed", "3", maps=(short,)) as server:
                watcher = self.watcher(server)
                rounds = lambda: [m for m in watcher.seen if m["type"] == "event" and m["kind"] == "round"]
                watcher.watch(60, until=lambda: sum(m["phase"] == "podium" for m in rounds()) >= 2)
                watcher.watch(1)
                self.assertIn('"mode":"%s"' % mode, watcher.files[0][0])
                folder = os.path.join(self.folder, mode)
                os.mkdir(folder)
                self.assert_proven(watcher.save(folder), 300)

    def test_another_game_is_a_new_header(self):
        with Server("--rotate", "3", "--bots", "2", maps=("crater_loop", "table")) as server:
            watcher = self.watcher(server)
            with server.player("mara") as mara:
                for _ in range(2):
                    watcher.watch(1)
                    mara.send({"type": "skip"})
                    mara.expect("welcome")
                    mara.key = None
            watcher.watch(until=lambda: len(watcher.files) == 3 and len(watcher.files[-1]) > 30)
            welcomes = [m for m in watcher.seen if m["type"] == "welcome"]
            self.assertEqual([m["stream"] for m in welcomes], ["inputs"] * 3)
            self.assertEqual(len({file[0] for file in watcher.files}), 3)
        self.assert_proven(watcher.save(self.folder), 100)

    def test_a_room_whose_next_map_is_of_tiles_goes_over_to_frames_and_back(self):
        with Server("--rotate", "3", "--bots", "2", maps=("volcano", self.tiled_map())) as server:
            watcher = self.watcher(server)
            with server.player("mara") as mara:
                for turn in range(2):
                    watcher.watch(until=lambda: watcher.steps > 30)
                    mara.send({"type": "skip"})
                    mara.expect("welcome")
                    mara.key = None
                    watcher.steps = 0
                    if turn == 0:
                        self.assertNotIn("stream", watcher.expect("welcome"))
                        watcher.expect("key")
                        watcher.expect("delta")
                        watcher.steps = 31
                watcher.watch(until=lambda: watcher.steps > 30)
                ask = len(watcher.seen)
                watcher.watch(1)
                self.assertFalse([m for m in watcher.seen[ask:] if m["type"] in ("key", "delta")])
        self.assert_proven(watcher.save(self.folder), 60)


if __name__ == "__main__":
    unittest.main()
