#!/usr/bin/env python3
"""Climbs to the summit; where its thrust does not suffice, it swings itself higher. [HOST:PORT]

Where something is played, it plays that.
"""
from math import hypot, inf

import woodlouse
import woodlouse_play


class Climber:
    """Where to push, from one state to the next. Goes for the highest summit; where that lies no higher than it starts
    (the dent in the middle of a bowl), for the highest place of the rim."""

    def __init__(self, game):
        self._ground, self._gravity, self._full = game.map(), game.physics["gravity"], game.physics["thrust_max"]
        self._patience = game.tick_hz  # a second
        self._top, self._moved, self._stalled_at, self.swinging = None, -inf, -inf, False

    def push(self, tick, x, y, vx, vy):
        """The thrust of a louse there: a pair, as Game.thrust takes it."""
        z, (gx, gy) = self._ground.height(x, y), self._ground.gradient(x, y)
        if self._top is None:
            summit = self._ground.summit()
            self._top, self._moved = summit if summit and summit[2] > z else self._ground.highest(), tick
        dx, dy = self._ground.way(x, y, *self._top[:2])
        pull = self._gravity / (1 + gx * gx + gy * gy)  # times the gradient: what the slope takes away
        speed, far = hypot(vx, vy), hypot(dx, dy)
        if speed > 0.3:
            self._moved = tick
        if tick > self._moved + self._patience and far > 1.5:  # stuck
            self.swinging, self._stalled_at, self._moved = True, z, tick
        elif pull * hypot(gx, gy) < 0.7 * self._full and z > self._stalled_at + 0.5:
            self.swinging = False  # past the steep part: on foot again
        if self.swinging:
            return (vx / speed, vy / speed) if speed > 0.3 else (-gx, -gy)
        pace = 2 / max(2, far)  # up to 2 m/s, less near the summit
        return ((2 * (pace * dx - vx) + pull * gx) / self._full, (2 * (pace * dy - vy) + pull * gy) / self._full)


def climb(game):
    climber, ground, told = Climber(game), game.map(), -inf
    for state in game.states():
        if not state.me:
            continue
        game.thrust(climber.push(state.tick, *state.me[1:]))
        z = ground.height(state.me.x, state.me.y)
        if z > told + 0.25:
            told = z
            print("tick %d: %.2f m up, %s" % (state.tick, z, "swinging" if climber.swinging else "climbing"),
                  flush=True)


def main(address):
    with woodlouse.connect(address, name="Sherpa") as game:
        woodlouse_play.play_all(game, climb)


if __name__ == "__main__":
    woodlouse.run(main)
