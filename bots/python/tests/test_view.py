"""A view of the room on a real server: who is near is seen as by who sees everybody, tick by tick.

Needs the programs: WOODLOUSE_BIN=build/release/bin python3 -m unittest test_view
"""

import os
import sys
import unittest

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
import woodlouse
from running import ROOT, Running, program

FIELDS = ["x", "y", "vx", "vy", "score"]


def server(*arguments, maps=("volcano",)):
    files = [os.path.join(ROOT, "maps", name + ".json") for name in maps]
    return Running(program("woodlouse-server"), "--listen", "127.0.0.1:0", "--bots", "40", *arguments, "--map", *files)


def until(states, tick, seen):
    """Goes on to the state of that tick or a later one; keeps all in seen[tick]."""
    for state in states:
        seen[state.tick] = state
        if state.tick >= tick:
            return state
    raise AssertionError("the server went")


def nearest(lice, place, size, count=None, radius=None):
    """The ids, by their definition, on a map whose edges wrap if it has a size."""
    def square(louse):
        ways = [abs(louse.x - place[0]), abs(louse.y - place[1])]
        if size:
            ways = [min(way, length - way) for way, length in zip(ways, size)]
        return ways[0] ** 2 + ways[1] ** 2
    found = sorted((square(louse), id) for id, louse in lice.items())
    return [id for far, id in found if radius is None or far <= radius ** 2][:count]


class View(unittest.TestCase):
    def compare(self, game, states, seen, everybody, wanted, size):
        """Ten states of the game against all lice at their ticks. wanted(lice, me): the ids that the view asks for; those
        whose order hangs on half a quantum may be others."""
        compared, first = 0, seen_tick(everybody)
        while compared < 10:
            state = until(states, first, {})
            whole = seen.get(state.tick) or until(everybody[0], state.tick, seen)
            whole = seen.get(state.tick, whole)
            if whole.tick != state.tick:
                continue
            compared += 1
            ids = wanted(whole.lice, game.id, size)
            self.assertEqual(len(state.lice), len(ids), state.tick)
            self.assertLessEqual(len(set(ids) - set(state.lice)), 1)
            for id, louse in state.lice.items():
                self.assertEqual(louse, whole.lice[id])
        return state

    def test_a_view_shows_who_is_near_wherever_it_is_moved_and_what_it_shows_is_so(self):
        for name, arguments in (("volcano", ()), ("torus", ())):
            with server(*arguments, maps=(name,)) as running:
                address = running.wait_for(r"^listening (\S+)$").group(1)
                with woodlouse.connect(address, role="spectator", name="eye", fields=FIELDS) as eye, \
                        woodlouse.connect(address, name="ada", fields=FIELDS, view={"rows": 7}) as ada:
                    low_x, low_y, high_x, high_y = ada.extent
                    size = (high_x - low_x, high_y - low_y) if ada.physics["edges"] == "wrap" else None
                    self.assertEqual(ada.welcome["view"], {"rows": 1000000})
                    all_states, seen = eye.states(), {}
                    states = ada.states()
                    ada.thrust(1)
                    everybody = (all_states, seen)
                    while next(states).me is None:
                        pass
                    self.compare(ada, states, seen, everybody, lambda lice, me, size: nearest(
                        lice, (lice[me].x, lice[me].y), size, 7), size)
                    corner = (low_x + 0.1, low_y + 0.1)
                    ada.look(*corner, radius=12)
                    settle(states, ada)
                    self.compare(ada, states, seen, everybody, lambda lice, me, size: sorted(set(
                        nearest(lice, corner, size, None, 12)) | {me}), size)
                    ada.look(louse=2, rows=3)
                    settle(states, ada)
                    self.compare(ada, states, seen, everybody, lambda lice, me, size: sorted(
                        nearest({id: l for id, l in lice.items() if id != me}, (lice[2].x, lice[2].y), size, 2) + [me]), size)
                    ada.look()
                    settle(states, ada)
                    self.compare(ada, states, seen, everybody, lambda lice, me, size: list(lice), size)
                    self.assertEqual(list(ada.errors), [])

    def test_where_the_server_says_so_a_frame_has_no_more_rows_for_anybody(self):
        with server("--frame-rows", "5") as running:
            address = running.wait_for(r"^listening (\S+)$").group(1)
            with woodlouse.connect(address, name="bob") as bob, \
                    woodlouse.connect(address, name="eye", role="spectator") as eye:
                self.assertEqual((bob.welcome["view"], eye.welcome["view"]), ({"rows": 5},) * 2)
                for game in (bob, eye):
                    for state in game.states():
                        self.assertLessEqual(len(state.lice), 5)
                        if state.tick > game.welcome["tick"] + 60 and (state.me or not game.id):
                            self.assertEqual(len(state.lice), 5)
                            break

    def test_who_sees_all_turns_to_a_part_and_back_without_a_gap(self):
        with server() as running:
            address = running.wait_for(r"^listening (\S+)$").group(1)
            with woodlouse.connect(address, name="bob") as bob:
                sizes, ticks = [], []
                for state in bob.states():
                    if len(state.lice) not in sizes[-1:]:
                        sizes.append(len(state.lice))
                    ticks.append(state.tick)
                    if len(ticks) == 5:
                        bob.look(rows=3)
                    if len(ticks) == 40:
                        bob.look()
                    if len(ticks) == 80:
                        break
                self.assertEqual(sizes[-3:], [41, 3, 41])
                self.assertEqual(list(bob.errors), [])
                self.assertEqual(bob._resyncing, False)


def seen_tick(everybody):
    """A tick that is shown to both."""
    states, seen = everybody
    return until(states, 0, seen).tick


def settle(states, game):
    """Till what is shown is of the view asked for last: the pong comes behind it."""
    game.ping()
    for _ in range(3):
        next(states)


if __name__ == "__main__":
    unittest.main()
