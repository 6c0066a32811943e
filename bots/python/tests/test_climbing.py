"""README's ten-line bot and the hill climber climb, on every shipped map that has a hill, on a real server.

Needs the programs: WOODLOUSE_BIN=build/release/bin python3 -m unittest test_climbing

What climbing is. The goal is the highest summit, or where the rim is higher all around, the rim's lowest place: whoever
is there, no hollow of the map holds. (The rim's corners are no goal: in a bowl they are twice as high as what lies
between them, more than the thrust has energy for.) A bot climbs if it starts at the lowest of the map's spawns and comes to
have nine tenths of the height from there to the goal behind it. Nine tenths, because the last one may be narrower than
a louse is steered at 20 states a second. A push straight uphill gets below 0 in each of the bowls: from the lowest spawn it slides
down. On maunga_whau it stops at 0.8.
"""

import json
import os
import sys
import unittest

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
import woodlouse
from running import ROOT, Running, Witness, example, program, readme_bot, readme_code, serve

MAPS = ("hills", "jumps", "maunga_whau", "parabolic_pot", "torus", "volcano", "wavy_pot")
LEVEL = ("arena", "kepler")
COURSES = ("crater_king", "crater_loop", "endless", "figure_eight", "jacksboro", "long_jump", "maunga_climb", "maunga_crumbs", "orchard",
           "picnic", "table")  # made to be played by rules: tests/tracks, test_modes
PAPER = ("hoffmann_2002",)  # by the paper's equations, which make and lose energy: its dents hold who pushes uphill
SHARE = 0.9
SECONDS = 240  # of the game. They take 6 to 60: on rough ground a run of bad luck may double that


def goal(ground):
    """The height that is to be climbed to [m], as told above."""
    summit = ground.summit()
    heights = [summit[2]] if summit else []
    if not ground.wraps:
        rows = ground.heights
        heights.append(min(min(rows[0]), min(rows[-1]), min(row[0] for row in rows), min(row[-1] for row in rows)))
    return max(heights)


def from_its_lowest_spawn(ground):
    """That map, its only spawn the lowest that it has; that spawn's height and the goal's [m]."""
    spawn = min(ground.definition["spawns"], key=lambda spawn: ground.height(*spawn["position"]))
    return dict(ground.definition, spawns=[spawn]), ground.height(*spawn["position"]), goal(ground)


def grounds():
    """{name: Ground} of MAPS, as a server sends them."""
    files = [os.path.join(ROOT, "maps", name + ".json") for name in MAPS]
    found = {}
    with Running(program("woodlouse-server"), "--listen", "127.0.0.1:0", "--map", *files) as server:
        address = server.wait_for(r"^listening (\S+)$").group(1)
        for name in MAPS:
            with woodlouse.connect(address, room=name) as game:
                found[name] = game.map()
    return found


class Climbing(unittest.TestCase):
    """All maps at once: a hill takes its time."""

    @classmethod
    def setUpClass(cls):
        cls.slopes, cls.witnesses = {}, {}
        for name, ground in grounds().items():
            definition, low, high = from_its_lowest_spawn(ground)
            address = serve(cls, definition)
            cls.slopes[name], cls.witnesses[name] = (low, high), Witness(cls, address, ["x", "y", "z", "speed"])
            for bot in (readme_bot(address), example("hill_climber", address)):
                cls.addClassCleanup(bot.__exit__)

    def climb_all(self, bot):
        for name in MAPS:
            with self.subTest(name):
                low, high = self.slopes[name]
                enough = low + SHARE * (high - low)
                rows = self.witnesses[name].see(bot, lambda rows: rows[-1][1].z >= enough, SECONDS)
                self.assertLess(rows[0][1].z, low + 0.1 * (high - low), "it did not start low")

    def test_the_bot_in_readme_climbs_on_every_map_that_has_a_hill(self):
        self.climb_all("uphill")

    def test_the_hill_climber_climbs_on_every_map_that_has_a_hill(self):
        self.climb_all("Sherpa")

    def test_the_hill_climber_stays_on_the_summit_it_goes_for(self):
        for name in ("hills", "jumps", "torus"):
            with self.subTest(name):
                ground = self.witnesses[name].ground
                place = ground.summit()[:2]

                def stands(rows):
                    last = [row for _, row in rows[-40:]]  # two seconds
                    return len(last) == 40 and all(max(map(abs, ground.way(row.x, row.y, *place))) < max(ground.spacing)
                                                   and row.speed < 0.5 for row in last)

                self.witnesses[name].see("Sherpa", stands, SECONDS)


class TheReadme(unittest.TestCase):
    def test_every_shipped_map_is_climbed_or_level_or_the_papers(self):
        shipped = {file[:-5] for file in os.listdir(os.path.join(ROOT, "maps")) if file.endswith(".json")}
        self.assertEqual(shipped, set(MAPS) | set(LEVEL) | set(PAPER) | set(COURSES))
        for course in COURSES:
            with open(os.path.join(ROOT, "maps", course + ".json"), encoding="utf-8") as file:
                self.assertTrue({"race", "forage", "hill"} & set(json.load(file)), course)

    def test_its_bot_has_about_ten_lines_and_is_that_of_the_bots_readme(self):
        code = readme_code()
        self.assertLessEqual(len([line for line in code.splitlines() if line]), 11)
        self.assertEqual(code, readme_code("bots"))


if __name__ == "__main__":
    unittest.main()
