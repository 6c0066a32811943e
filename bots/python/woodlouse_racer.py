"""Drives races, for woodlouse_play.py: plans the coming two seconds, by what they leave to drive.

A plan is a row of pushes. At each decision the one that is being followed and some others - one direction throughout, and
small changes of the best - are tried in a rough copy of the game; whose end is nearest to the finish by the tables of
woodlouse_course.py is followed. Units: m, m/s, s.
"""

import random
from math import cos, hypot, inf, pi, sin, sqrt

from woodlouse_course import Course
from woodlouse_surface import surface_of

STEP_S = 0.1  # of a try
PIECE_S = 0.2  # for which one push of a plan lasts
PIECES = 10  # of a plan
DECISION_S = 0.1  # from one to the next
DELAY_S = 0.05  # from what is seen to what is done about it, at first; then as the acks tell
MOST_DELAY_S = 0.4
DIRECTIONS = 12
CHANGES = 16  # of the best plan, that are tried
ACROSS = 1.5  # [1/s], by which a motion across the way is pushed against
WALL_S = 0.5  # what a bounce costs besides
STUCK_S = 12.0  # without coming nearer to the finish of the gates, after which it begins again
NEARER_S = 0.5


class Racer:
    """Drives through one gate after the other."""

    def __init__(self, game):
        self._game, self._tick_hz = game, game.tick_hz
        ground = game.map()
        try:
            surface = surface_of(ground)
        except ValueError:  # only the server knows it
            surface = KnotSurface(ground)
        self._course = Course(surface, ground, game.physics, game.rules["gates"])
        self._sketch = Sketch(surface, ground, game.physics)
        self._random = random.Random(1)
        self._plan, self._planned = [(0.0, 0.0)] * PIECES, -inf
        self._goal, self._least, self._since = None, inf, 0
        self._delay = DELAY_S

    def push(self, state):
        """The thrust, a pair; None to leave it as it is."""
        gate, tick, me = self._game.gate, state.tick, state.me
        if gate is None or not gate < len(self._course.tables) or tick < self._planned + DECISION_S * self._tick_hz:
            return None
        table = self._course.tables[gate]
        if self._is_stuck(gate, tick, table.seconds(me.x, me.y, me.vx, me.vy)):
            self._game.respawn()
            self._plan, self._goal = [(0.0, 0.0)] * PIECES, None
            return None
        self._measure_delay()
        begin, steps = (me.x, me.y, me.vx, me.vy, None, 0.0), max(1, round(self._delay / STEP_S))
        for _ in range(steps):  # by then it may be through the gate
            begin, table, _ = self._on(begin, self._plan[0], table, self._delay / steps)
        self._shift((tick - self._planned) / self._tick_hz)
        self._planned = tick
        self._plan = self._best(begin, table)
        return self._plan[0]

    def _measure_delay(self):
        """How late after what was seen the last push began: a busy machine makes it late."""
        ack = self._game.last_ack
        if ack and ack["tick"] >= self._planned:
            late = min(MOST_DELAY_S, (ack["tick"] - self._planned) / self._tick_hz)
            self._delay += 0.2 * (late - self._delay)

    def _is_stuck(self, gate, tick, left):
        goal = gate, self._game.round and self._game.round.number
        if goal != self._goal or left < self._least - NEARER_S:
            self._goal, self._least, self._since = goal, left, tick
        return tick - self._since > STUCK_S * self._tick_hz

    def _shift(self, seconds):
        """Leaves away what of the plan has been done."""
        done = int(min(PIECES, seconds / PIECE_S + self._random.random()))
        self._plan = self._plan[done:] + self._plan[-1:] * done

    def _best(self, begin, table):
        """The best of the plans that are tried."""
        turned = 2 * pi * self._random.random()
        angles = [turned + 2 * pi * number / DIRECTIONS for number in range(DIRECTIONS)]
        plans = [self._plan, self._by_table(begin, table)] + [[(cos(angle), sin(angle))] * PIECES for angle in angles]
        least, best = min((self._left(begin, plan, table), plan) for plan in plans)
        for _ in range(CHANGES):
            plan = self._changed(best, begin)
            left = self._left(begin, plan, table)
            if left < least:
                least, best = left, plan
        return best

    def _by_table(self, body, table):
        """The plan of who drives as the table says, square by square."""
        plan = []
        for _ in range(PIECES):
            push = self._sketch.along(body, table.course(*body[:4]))
            plan.append(push)
            for _ in range(round(PIECE_S / STEP_S)):
                body, table, _ = self._on(body, push, table)
        return plan

    def _on(self, body, push, table, seconds=STEP_S):
        """The body so much later, the table of its next gate, and whether it met a wall."""
        after, bounced = self._sketch.on(body, push, seconds)
        if not bounced and table.after and table.gate.crossing(*body[:2], *after[:2]) == 1 and (
                not table.gate.air or body[4] is not None or after[4] is not None):
            table = table.after
        return after, table, bounced

    def _changed(self, plan, begin):
        """Another push for some pieces of it."""
        first, end = sorted((self._random.randrange(PIECES), self._random.randrange(PIECES)))
        if self._random.random() < 0.4:
            first = 0
        x, y = plan[first]
        kind = self._random.random()
        if kind < 0.6 and (x or y):
            angle = self._random.gauss(0, 0.5)
            x, y = x * cos(angle) - y * sin(angle), x * sin(angle) + y * cos(angle)
        elif kind < 0.9:
            angle = self._random.uniform(-pi, pi)
            x, y = cos(angle), sin(angle)
        else:
            speed = max(0.1, hypot(begin[2], begin[3]))
            x, y = -begin[2] / speed, -begin[3] / speed
        return plan[:first] + [(x, y)] * (end + 1 - first) + plan[end + 1:]

    def _left(self, body, plan, table):
        """Seconds to the finish of the gates, at the end of the plan."""
        lost = 0.0
        for push in plan:
            for _ in range(round(PIECE_S / STEP_S)):
                body, table, bounced = self._on(body, push, table)
                lost += WALL_S if bounced else 0.0
        return lost + table.seconds(*body[:4])


class KnotSurface:
    """As good as it can be told from a map's knots: nothing of how it bends."""

    def __init__(self, ground):
        self._ground = ground

    def sample(self, x, y):
        return (self._ground.height(x, y),) + tuple(self._ground.gradient(x, y)) + (0.0, 0.0, 0.0)


class Sketch:
    """How a louse moves, roughly. A body is (x, y, vx, vy, z, vz); z is None on the ground."""

    def __init__(self, surface, ground, physics):
        self._sample, self._extent, self._wraps = surface.sample, ground.extent, ground.wraps
        self._gravity, self._drag, self._friction = physics["gravity"], physics["drag"], physics["friction"]
        self._full, self._bounce = physics["thrust_max"], physics["edge_restitution"]
        self._flies = physics.get("contact") == "unilateral"

    def on(self, body, push, h):
        """The body h later, and whether it met a wall."""
        x, y, vx, vy, z, vz = body
        if z is None:
            ax, ay, load = self._pull(x, y, vx, vy, push)
            if load < 0 and self._flies:
                z, zx, zy = self._sample(x, y)[:3]
                vz = zx * vx + zy * vy
        if z is not None:
            x, y, z, vz = x + h * vx, y + h * vy, z + h * vz - 0.5 * self._gravity * h * h, vz - self._gravity * h
            ground, zx, zy = self._sample(x, y)[:3]
            if z <= ground:  # the speed along the normal is lost
                lost = (vz - zx * vx - zy * vy) / (1 + zx * zx + zy * zy)
                vx, vy, z = vx + lost * zx, vy + lost * zy, None
        else:
            mx, my = vx + 0.5 * h * ax, vy + 0.5 * h * ay  # in the middle of the step
            ax, ay, _ = self._pull(x + 0.5 * h * vx, y + 0.5 * h * vy, mx, my, push)
            x, y, vx, vy = x + h * mx, y + h * my, vx + h * ax, vy + h * ay
        x0, y0, x1, y1 = self._extent
        if self._wraps or (x0 <= x <= x1 and y0 <= y <= y1):
            return (x, y, vx, vy, z, vz), False
        if not x0 <= x <= x1:
            x, vx = min(max(x, x0), x1), -self._bounce * vx
        if not y0 <= y <= y1:
            y, vy = min(max(y, y0), y1), -self._bounce * vy
        return (x, y, vx, vy, z, vz), True

    def along(self, body, way):
        """The push that way; what leads aside is held against first."""
        x, y, vx, vy = body[:4]
        _, zx, zy = self._sample(x, y)[:3]
        size = hypot(*way)
        hx, hy = way[0] / size, way[1] / size
        pull = self._gravity / (1 + zx * zx + zy * zy)
        aside = (pull * (hx * zy - hy * zx) - ACROSS * (hx * vy - hy * vx)) / max(1e-9, self._full)
        aside = max(-0.9, min(0.9, aside))
        onwards = sqrt(1 - aside * aside)
        return onwards * hx - aside * hy, onwards * hy + aside * hx

    def _pull(self, x, y, vx, vy, push):
        """(ax, ay) and the load, below 0 where it lifts off."""
        _, zx, zy, zxx, zxy, zyy = self._sample(x, y)
        steep = 1 + zx * zx + zy * zy
        load = self._gravity + (zxx * vx + 2 * zxy * vy) * vx + zyy * vy * vy
        climb, speed2 = zx * vx + zy * vy, vx * vx + vy * vy
        resistance = self._drag + self._friction * abs(load) / sqrt(steep * max(0.01, speed2 + climb * climb))
        px, py = push
        climb = zx * px + zy * py
        size2 = px * px + py * py
        f = self._full * sqrt(size2 / (size2 + climb * climb)) if size2 else 0.0
        share = load / steep
        return f * px - share * zx - resistance * vx, f * py - share * zy - resistance * vy, load
