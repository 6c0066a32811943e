#!/usr/bin/env python3
"""Pushes about, foretells where that takes it in half a second, and says how far it was wrong. [HOST:PORT]

Where something is played, it plays that, and foretells as far as it lets a push act.
"""
from math import cos, hypot, sin

import woodlouse
import woodlouse_play
from woodlouse_motion import Motion, body_of_ack
from woodlouse_surface import surface_of

AHEAD_S = 0.5
WHILE_PLAYING_S = 0.1  # so that it steers often enough


def foretell(game):
    if game.physics["equations"] != "exact":
        raise SystemExit("this room moves lice by the paper's equations (%s): only the exact ones are foretold here"
                         % game.physics["equations"])
    player = woodlouse_play.player_of(game) if woodlouse_play.plays(game) else None
    ahead = round((WHILE_PLAYING_S if player else AHEAD_S) * game.tick_hz)
    ground, every = game.map(), game.tick_hz // game.state_hz
    motion = Motion(surface_of(ground), game.physics, game.extent, game.tick_hz)
    waiting, told, pushes = False, None, 0
    for state in game.states():
        for ack in game.take_acks():
            if "you" not in ack:  # it was dropped
                waiting = False
            else:  # the exact state after the step that took the push
                me = body_of_ack(ack["you"])
                told = motion.after(me, ahead + -(me.tick + ahead) % every)  # a tick that will be shown
        if told and state.me and state.tick >= told.tick:
            if state.tick == told.tick:  # else we were busy, and that state was replaced by a newer one
                wrong = hypot(*ground.way(told.x, told.y, state.me.x, state.me.y))
                print("tick %d: at (%.3f, %.3f), %.1e m from where it was foretold"
                      % (state.tick, state.me.x, state.me.y, wrong), flush=True)
            waiting, told = False, None
        if state.me and not waiting:
            push = player.push(state) if player else (cos(pushes), sin(pushes))
            if push:
                waiting, pushes = True, pushes + 1
                game.thrust(push)


def main(address):
    with woodlouse.connect(address, name="Delphi", format="exact") as game:
        while game.bye is None:
            foretell(game)


if __name__ == "__main__":
    woodlouse.run(main)
