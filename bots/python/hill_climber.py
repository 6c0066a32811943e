#!/usr/bin/env python3
"""Climbs to the summit; where its thrust does not suffice, it swings itself higher. [HOST:PORT]"""
from math import hypot, inf

import woodlouse


def main(address):
    with woodlouse.connect(address, name="Sherpa") as game:
        ground, gravity, full = game.map(), game.physics["gravity"], game.physics["thrust_max"]
        (top_x, top_y, _), swinging, stalled_at, moved, told = ground.summit(), False, -inf, game.welcome["tick"], -inf
        for state in game.states():
            if not state.me:
                continue
            _, x, y, vx, vy = state.me
            z, (gx, gy) = ground.height(x, y), ground.gradient(x, y)
            speed, far = hypot(vx, vy), hypot(top_x - x, top_y - y)
            pull = gravity / (1 + gx * gx + gy * gy)  # times the gradient: what the slope takes away
            pace = 2 / max(2, far)  # up to 2 m/s, less near the summit
            push = [2 * (pace * (top_x - x) - vx) + pull * gx, 2 * (pace * (top_y - y) - vy) + pull * gy]
            moved = state.tick if speed > 0.3 else moved
            if state.tick > moved + game.tick_hz and far > 1.5:  # stuck for a second
                swinging, stalled_at, moved = True, z, state.tick
            elif hypot(gx, gy) < 0.1 and z > stalled_at + 0.5:
                swinging = False  # over the top: on foot again
            if swinging:
                push = [vx * full / speed, vy * full / speed] if speed > 0.3 else [-full * gx, -full * gy]
            game.thrust([push[0] / full, push[1] / full])
            if z > told + 0.25:
                told = z
                print("tick %d: %.2f m up, %s" % (state.tick, z, "swinging" if swinging else "climbing"), flush=True)


if __name__ == "__main__":
    woodlouse.run(main)
