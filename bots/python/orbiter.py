#!/usr/bin/env python3
"""Circles the middle of the map, as fast as the slope holds it on its orbit. [HOST:PORT]

Where something is played, it plays that.
"""
from math import atan2, hypot, pi, remainder, sqrt

import woodlouse
import woodlouse_play


def orbit(game):
    ground, gravity, full = game.map(), game.physics["gravity"], game.physics["thrust_max"]
    x0, y0, x1, y1 = game.extent
    orbit = 0.2 * min(x1 - x0, y1 - y0)
    angle, rounds = 0.0, 0
    for state in game.states():
        if not state.me:
            continue
        x, y, vx, vy = state.me.x - (x0 + x1) / 2, state.me.y - (y0 + y1) / 2, state.me.vx, state.me.vy
        r = max(hypot(x, y), 0.1)
        ox, oy = x / r, y / r  # outwards; (-oy, ox) is along the orbit
        gx, gy = ground.gradient(state.me.x, state.me.y)
        pull = gravity / (1 + gx * gx + gy * gy)
        speed = min(6.0, max(3.0, sqrt(max(0.0, pull * (gx * ox + gy * oy) * r))))
        home = max(-2.0, min(2.0, 0.8 * (orbit - r)))
        turn = speed * speed / max(r, orbit)  # inwards, to stay on the circle
        push = (2 * (home * ox - speed * oy - vx) + pull * gx - turn * ox,
                2 * (home * oy + speed * ox - vy) + pull * gy - turn * oy)
        game.thrust((push[0] / full, push[1] / full))
        angle += remainder(atan2(y, x) - angle, 2 * pi)  # goes on past pi
        if angle > 2 * pi * (rounds + 1):
            rounds += 1
            print("tick %d: %d times round" % (state.tick, rounds), flush=True)


def main(address):
    with woodlouse.connect(address, name="Saturn") as game:
        woodlouse_play.play_all(game, orbit)


if __name__ == "__main__":
    woodlouse.run(main)
