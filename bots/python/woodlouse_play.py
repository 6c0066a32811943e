"""Plays what a room plays: drives races (woodlouse_racer.py), eats crumbs, holds hills. A beginning to improve on.

    import woodlouse, woodlouse_play

    with woodlouse.connect("127.0.0.1:7777/volcano/race") as game:
        woodlouse_play.play_all(game, roam=my_own_way)
"""

from math import hypot, inf, sqrt

from woodlouse_racer import Racer
from woodlouse_ways import Ways

STUCK_S = 5.0  # without coming nearer, after which a forager goes elsewhere
STALLED_S = 1.0  # of standing, after which a louse takes a run-up
SLOW_S = 2.0  # without coming nearer, after which it looks for another way than straight
RUN_UPS = 3  # each of which gets that time anew
TOP_SPEED = 30.0  # [m/s]


def plays(game):
    """Whether its mode is one that is played here."""
    return game.mode in _PLAYERS


def player_of(game):
    """Who plays the game's mode: push(state) is the thrust, a pair as Game.thrust takes it; None to leave it as it is.
    REQUIRES plays(game)."""
    return _PLAYERS[game.mode](game)


def play_all(game, roam):
    """Plays until the server says bye: what is played here, and by roam(game) what is not. Where a room plays several games in
    turns roam returns when states() has ended."""
    while game.bye is None:
        play(game) if plays(game) else roam(game)


def play(game):
    """Plays until the game ends, and prints what comes of it. REQUIRES plays(game)."""
    player = player_of(game)
    for state in game.states():
        for event in game.take_events():
            line = told(game, event)
            if line:
                print("tick %d: %s" % (event["tick"], line), flush=True)
        if state.me:
            push = player.push(state)
            if push:
                game.thrust(push)


def told(game, event):
    """What an event says of your louse, or of the round's end; None where it is nothing."""
    kind = event["kind"]
    if kind == "round" and event["phase"] == "podium":
        scores = ["%s %s" % (game.players.get(louse, louse), _score(game, score)) for louse, score in event["table"]]
        return "round %d ends: %s" % (event["round"], ", ".join(scores) or "nobody was there")
    if event["id"] != game.id:
        return None
    if kind in ("lap", "run"):
        return "%s in %.3f s" % (kind, game.seconds_of(event["time"]))
    if kind == "crumb":
        return "a crumb of %d, %d in all" % (event["value"], event["score"])
    return {"holds": "holds the place", "fell": "fell off the map"}.get(kind)


def _score(game, score):
    if game.mode == "forage":
        return "%d" % score
    if game.mode == "race":
        return "%.3f s" % game.seconds_of(score) if score else "none"
    return "%.1f s" % (score / game.tick_hz)


class Driver:
    """Steers to places, as fast as can be braked: straight, where that gets nowhere by a way that is less steep, and where
    it comes to a stand with a run-up."""

    def __init__(self, game):
        self._ground, self._tick_hz = game.map(), game.tick_hz
        self._gravity, self._drag, self._full = (game.physics[name] for name in ("gravity", "drag", "thrust_max"))
        self._ways = Ways(self._ground, game.physics)
        self.head_for(None, 0)

    def head_for(self, goal, tick):
        """Goes for another goal from now on; the progress counts anew. goal: anything that can be compared."""
        self._goal, self._nearest, self._since, self._moved = goal, inf, tick, tick
        self._swings, self._swings_until = 0, -inf

    def stuck_s(self, tick):
        """For how long it has not come nearer to its goal [s]."""
        return (tick - self._since) / self._tick_hz

    def way(self, me, place):
        """(dx, dy) [m] to the place, and how far that is."""
        dx, dy = self._ground.way(me.x, me.y, *place)
        return dx, dy, hypot(dx, dy)

    def push(self, tick, me, place, speed_there, goal=None):
        """The thrust towards a place [m], to be there with so many m/s. goal: whose progress it is, the place's own where it
        is left out."""
        dx, dy, far = self.way(me, place)
        goal = place if goal is None else goal
        if goal != self._goal:
            self.head_for(goal, tick)
        left = self._ways.cost(me.x, me.y, place)
        if left < self._nearest - 0.5:
            self._nearest, self._since = left, tick
        speed, (gx, gy) = hypot(me.vx, me.vy), self._ground.gradient(me.x, me.y)
        pull = self._gravity / (1 + gx * gx + gy * gy)  # times the gradient: what the slope takes away
        if speed > 0.5 or (far < 1 and speed_there == 0):  # it drives, or is where it is to stay
            self._moved = tick
        if tick - self._moved > STALLED_S * self._tick_hz:  # a run-up, longer each time
            self._swings, self._moved = self._swings + 1, tick
            self._since = tick if self._swings <= RUN_UPS else self._since
            self._swings_until = tick + (0.5 + self._swings) * self._tick_hz
        if tick < self._swings_until:
            if speed > 0.5:
                return me.vx / speed, me.vy / speed
            return (-gx, -gy) if hypot(gx, gy) > 0.05 else (-dx / max(far, 0.1), -dy / max(far, 0.1))  # down, or back
        if far > 1 and (speed < 2 or self.stuck_s(tick) > SLOW_S) and not self._ways.carries(me, place):
            dx, dy, far = self.way(me, self._ways.on_the_way(me, place))
            speed_there = max(speed_there, speed, 4.0)  # it will want it uphill
        wanted = min(TOP_SPEED, sqrt(speed_there * speed_there + self._full * far))  # braking with half of the thrust
        along = (dx / far, dy / far) if far > 0.01 else (0.0, 0.0)
        wanted = min(wanted, 2 * far + speed_there)
        return self._drive(me, (gx, gy), pull, along, wanted)

    def _drive(self, me, gradient, pull, along, speed):
        """The thrust that makes the velocity `speed` along a direction; what it takes across goes first, lest it is carried
        off."""
        ax, ay = (3 * (speed * along[i] - v) + pull * gradient[i] + self._drag * v for i, v in enumerate((me.vx, me.vy)))
        size = hypot(ax, ay)
        if size < 1e-6:
            return 0.0, 0.0
        slope = (gradient[0] * ax + gradient[1] * ay) / size
        share = sqrt(1 + slope * slope) / (self._full or 1.0)
        ax, ay = ax * share, ay * share
        if hypot(ax, ay) <= 1 or along == (0.0, 0.0):
            return ax, ay
        across = max(-0.95, min(0.95, along[0] * ay - along[1] * ax))
        onwards = sqrt(1 - across * across)
        if along[0] * ax + along[1] * ay < 0:
            onwards = -onwards
        return onwards * along[0] - across * along[1], onwards * along[1] + across * along[0]


class Forager:
    """Goes for the crumb that gives most for the time it takes."""

    def __init__(self, game):
        self._game, self._driver = game, Driver(game)
        self._target, self._given_up = None, set()

    def push(self, state):
        crumbs = self._game.round.crumbs if self._game.round else {}
        wanted = {crumb for crumb in crumbs.values() if crumb not in self._given_up}
        if self._driver.stuck_s(state.tick) > STUCK_S and self._target in wanted:
            wanted.discard(self._target)
            self._given_up.add(self._target)
        if not wanted:
            self._given_up.clear()
            return (0.0, 0.0) if not crumbs else None
        best = max(wanted, key=lambda crumb: self._worth(state.me, crumb) * (1.5 if crumb == self._target else 1))
        if best != self._target:
            self._target = best
            self._driver.head_for((best.x, best.y), state.tick)
        return self._driver.push(state.tick, state.me, (best.x, best.y), 3.0)

    def _worth(self, me, crumb):
        dx, dy, far = self._driver.way(me, (crumb.x, crumb.y))
        forth = (me.vx * dx + me.vy * dy) / max(far, 0.1)  # [m/s] of its speed that lead there
        return crumb.value / (1.0 + hypot(dx - 0.7 * me.vx, dy - 0.7 * me.vy) - 0.3 * max(-1.0, min(3.0, forth)))


class Holder:
    """Goes to the place that counts, and stays in its middle; to the next one when it moves soon and is another's. Who
    contests it is charged."""

    def __init__(self, game):
        self._game, self._driver, self._places = game, Driver(game), game.rules["places"]
        self._contested_since = None

    def push(self, state):
        played = self._game.round
        if not played or played.place is None:
            return None
        place = played.place
        soon = 0 < played.moves_at - state.tick < 4 * self._game.tick_hz
        if soon and played.holder != self._game.id:
            place += 1
        other = self._contester(state, self._places[played.place]) if played.contested and not soon else None
        if other:
            return self._charge(state, other)
        self._contested_since = None
        return self._driver.push(state.tick, state.me, tuple(self._places[place % len(self._places)]["at"]), 0.0)

    def _contester(self, state, place):
        """The nearest other louse on the place, where it is on it itself."""
        ways = {louse: self._driver.way(row, place["at"])[2] for louse, row in state.lice.items()}
        there = [row for louse, row in state.lice.items() if louse != self._game.id and ways[louse] <= place["radius"]]
        if not there or ways[self._game.id] > place["radius"]:
            return None
        return min(there, key=lambda row: self._driver.way(state.me, (row.x, row.y))[2])

    def _charge(self, state, other):
        """Two seconds at it, one back."""
        if self._contested_since is None:
            self._contested_since = state.tick
        if (state.tick - self._contested_since) % (3 * self._game.tick_hz) < 2 * self._game.tick_hz:
            return self._driver.push(state.tick, state.me, (other.x, other.y), 5.0, "charge")
        dx, dy, far = self._driver.way(state.me, (other.x, other.y))
        return -dx / max(far, 0.1), -dy / max(far, 0.1)


_PLAYERS = {"race": Racer, "forage": Forager, "hill": Holder}
