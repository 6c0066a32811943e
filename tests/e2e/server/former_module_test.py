"""Who spoke protocol 1 before there was a resume still plays: the Python module as it was then (tests/e2e/former),
unchanged, against the server of today."""

import os
import sys
import time
import unittest

from wire import PATIENCE, Server

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "former"))
import woodlouse


class FormerModule(unittest.TestCase):
    def until(self, states, done):
        end = time.monotonic() + PATIENCE
        for state in states:
            if done(state):
                return state
            self.assertLess(time.monotonic(), end, state)

    def test_it_drives_past_pings_and_hears_of_its_acks(self):
        with Server("--ping-s", "1", "--vacant-s", "2") as server:
            with woodlouse.connect(server.address, name="ann", fields=["distance", "tx"]) as game:
                self.assertEqual(game.map().name, "volcano")
                self.assertEqual(game.physics["gravity"], 9.81)
                states = game.states()
                begun = self.until(states, lambda state: state.me).tick
                seq = game.thrust((0.5, 0.25))
                state = self.until(states, lambda state: state.tick > begun + 200)  # longer than vacant_s
                self.assertGreater(state.me.distance, 1)
                self.assertEqual(state.me.tx, 0.5, "it answers pings, so its thrust goes on")
                self.assertEqual([(ack["seq"], ack["dropped"]) for ack in game.take_acks()], [(seq, False)])
                self.assertEqual(game.players, {game.id: "ann"})
                self.assertLess(game.ping(), PATIENCE)

    def test_it_talks_and_sees_who_comes_and_goes(self):
        with Server() as server, woodlouse.connect(server.address, name="eve", role="spectator") as watcher:
            with woodlouse.connect(server.address, name="ann") as ann, woodlouse.connect(server.address, name="ann") as other:
                ann.chat("hello")
                ann.respawn()
                kinds = []

                def all_came(_):
                    kinds.extend(event["kind"] for event in watcher.take_events())
                    return "respawned" in kinds

                self.until(watcher.states(), all_came)
                self.assertEqual(watcher.players, {ann.id: "ann", other.id: "ann#2"})
                self.assertEqual([kind for kind in kinds if kind != "joined"], ["chat", "respawned"])
                room, = watcher.rooms()
                self.assertRegex(room.pop("code"), "^[B-Z]{5}$")  # of today's server
                self.assertEqual(room, {"name": "volcano", "map": "volcano", "players": 0, "bots": 2, "spectators": 1})
            self.until(watcher.states(), lambda state: not watcher.players)

    def test_it_verifies_the_keys_of_today(self):
        with Server("--bots", "2") as server:
            with woodlouse.connect(server.address, name="proof", verify=True) as game:
                self.until(game.states(), lambda state: game.verified == 3)

    def test_it_is_told_of_the_end(self):
        with Server() as server, woodlouse.connect(server.address, name="ann") as game:
            next(game.states())
            server.process.terminate()
            for _ in game.states():
                pass
            self.assertEqual(game.bye["code"], "shutdown")


if __name__ == "__main__":
    unittest.main(verbosity=2)
