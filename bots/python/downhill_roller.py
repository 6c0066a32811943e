#!/usr/bin/env python3
"""Lives to roll: kicks itself uphill, lets go, and coasts until it lies still. [HOST:PORT]

Where something is played, it plays that.
"""
import math
import random

import woodlouse
import woodlouse_play


def roll(game):
    ground = game.map()
    fastest, moved = 0.0, 0
    for state in game.states():
        if not state.me:
            continue
        speed = math.hypot(state.me.vx, state.me.vy)
        if speed > fastest + 0.5:
            fastest = speed
            print("tick %d: %.1f m/s, the fastest yet" % (state.tick, fastest), flush=True)
        if speed > 0.05:
            moved = max(moved, state.tick)
        if state.tick < moved + game.tick_hz:  # slow, but perhaps only turning round halfway up
            continue
        gx, gy = ground.gradient(state.me.x, state.me.y)
        uphill = math.atan2(gy, gx) if math.hypot(gx, gy) > 0.05 else random.uniform(-math.pi, math.pi)
        angle = uphill + random.uniform(-0.5, 0.5)
        game.thrust((math.cos(angle), math.sin(angle)), ticks=3 * game.tick_hz)
        moved = state.tick + 3 * game.tick_hz


def main(address):
    with woodlouse.connect(address, name="Rolly") as game:
        woodlouse_play.play_all(game, roll)


if __name__ == "__main__":
    woodlouse.run(main)
