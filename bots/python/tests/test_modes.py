"""The example bots where something is played, on a real server.

Needs the programs: WOODLOUSE_BIN=build/release/bin python3 -m unittest test_modes
"""

import json
import os
import sys
import unittest

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
import woodlouse
from running import ROOT, example, serve

# A small bowl: nothing is far, and everything lies at its bottom some time.
POT = {"name": "pot", "terrain": {"function": "parabolic_pot", "grid": 10, "scale": 8}}
FORAGE = dict(POT, forage={"crumbs": 24, "summits": 0})
HILL = dict(POT, hill={"places": [{"at": [0, 0], "radius": 3}], "edge": "fall", "hold_s": 3, "podium_s": 1})
TICKS = 90 * 60  # a minute and a half of the game


def ring():
    """The map of the scenario of a race: level ground whose edges wrap, three gates one behind the other."""
    with open(os.path.join(ROOT, "tests", "scenarios", "race_ring.json"), encoding="utf-8") as file:
        return json.load(file)["map"]


class WhatIsPlayed(unittest.TestCase):
    def watched(self, address, done):
        """The game of who looks on there, and its events, once done(game, events) is true."""
        events = []
        with woodlouse.connect(address, name="witness", role="spectator") as game:
            begun = None
            for state in game.states():
                begun = begun or state.tick
                events += game.take_events()
                if done(game, events):
                    return game, events
                self.assertLess(state.tick, begun + TICKS, events[-5:])
        self.fail("the server went")

    def test_a_bot_finishes_laps_of_a_ring(self):
        address = serve(self, ring(), "--mode", "race")
        with example("hill_climber", address) as racer:
            game, events = self.watched(address, lambda game, events: any(event["kind"] == "run" for event in events))
            racer.wait_for(r"^tick \d+: lap in [\d.]+ s$")
            racer.wait_for(r"^tick \d+: run in [\d.]+ s$")
        self.assertEqual((game.mode, game.rules["laps"], len(game.rules["gates"])), ("race", 2, 3))
        run = next(event for event in events if event["kind"] == "run")
        laps = [event["time"] for event in events if event["kind"] == "lap"][:2]
        self.assertEqual(run["time"], sum(laps))
        self.assertEqual((run["rank"], run["name"]), (1, "Sherpa"))
        self.assertEqual([event["gate"] for event in events if event["kind"] == "gate"][:6], [0, 1, 2, 0, 1, 2])
        standing = game.standings[run["id"]]
        self.assertLessEqual(standing.best_lap, min(laps))
        self.assertEqual(game.round.table, ((run["id"], standing.score),))
        self.assertLess(game.seconds_of(run["time"]), 60)

    def test_bots_eat_crumbs(self):
        address = serve(self, FORAGE)
        with example("downhill_roller", address + "/pot/forage"), example("predictor", address + "/pot/forage"):
            def both_ate(game, _):
                return len(game.standings) == 2 and min(standing.score for standing in game.standings.values()) >= 4

            game, events = self.watched(address + "/pot/forage", both_ate)
        self.assertEqual(len(game.round.table), 2)
        self.assertLessEqual(len(game.round.crumbs), 24)
        eaten = [event for event in events if event["kind"] == "crumb" and event["name"] == "Rolly"]
        self.assertEqual(eaten[-1]["score"], game.standings[eaten[-1]["id"]].score)

    def test_a_bot_holds_the_hill(self):
        address = serve(self, HILL, "--mode", "hill")
        with example("orbiter", address) as holder:
            game, events = self.watched(address, lambda game, _: game.round and game.round.phase == "podium")
            holder.wait_for(r"^tick \d+: holds the place$")
            holder.wait_for(r"^tick \d+: round 1 ends: Saturn 3.0 s$")
        self.assertEqual((game.round.number, game.round.place), (1, 0))
        self.assertEqual(game.round.table[0][1], 3 * game.tick_hz)

    def test_one_s_own_standing_and_a_way_back_to_the_last_gate(self):
        with woodlouse.connect(serve(self, ring(), "--mode", "race"), name="ann") as game:
            kinds, gates = [], []
            for state in game.states():
                if state.me:
                    gates.append(game.gate)
                    game.thrust((1.0, 0.0))
                kinds += [event["kind"] for event in game.take_events() if event["id"] == game.id]
                if "lap" in kinds and "respawned" not in kinds:
                    self.assertGreater(game.best_lap, 0)
                    game.respawn(at="gate")
                if "respawned" in kinds:
                    break
            self.assertEqual(sorted(set(gates)), [0, 1, 2])
            self.assertEqual(len(state.me), 5)

    def test_all_columns_are_verified_where_something_is_played(self):
        with woodlouse.connect(serve(self, FORAGE, "--mode", "forage", "--bots", "2"), verify=True) as game:
            most = 0  # one that is eaten grows again later
            for state in game.states():
                if state.me and not game.last_ack:
                    game.thrust((0.5, -0.25))
                if game.round:
                    most = max(most, len(game.round.crumbs))
                if game.verified >= 4 and game.round.phase == "play":
                    break
            self.assertEqual((game.mode, game.score, game.fields), ("forage", None, woodlouse.ALL_FIELDS))
            self.assertEqual(most, 24)


if __name__ == "__main__":
    unittest.main()
