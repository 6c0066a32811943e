"""How long the way through a race's gates takes, from wherever a louse is and however fast it goes: tables for
woodlouse_racer.py.

The ground is cut into squares of some metres. From the middle of a square eight courses lead to its neighbours; what a
drive along one takes at full thrust, and how fast one is at its end, is a matter of energies. Where a slope stops the
drive, it leads back, faster by what the thrust gave both ways: a run-up. Dijkstra's search backwards from a gate then
knows the least time from everywhere. Units: m, m/s, s.
"""

from heapq import heappop, heappush
from math import atan2, floor, hypot, inf, pi, sqrt

SQUARE = 2.0  # [m], about; more on large maps
MOST_SQUARES = 36  # along the longer side
SPEEDS = (0.0, 2.0, 4.5, 7.5, 11.0, 16.0)  # in space [m/s]
LEVELS = len(SPEEDS)
COURSES = ((1, 0), (1, 1), (0, 1), (-1, 1), (-1, 0), (-1, -1), (0, -1), (1, -1))  # counter-clockwise from east
PARTS = 3  # of a drive to the next square
PASSING = 5.0  # from which speed on a pull aside is held against less [m/s]
TURN = 0.8  # of the time in which the thrust gives the speed: what 45 degrees take
SETTLED = 0.05  # a change that is none [s]
FAR = 200.0  # a time that stands for never [s]
POWER = 1.0  # of the thrust, that is counted upon
RUN_IN = 12.0  # how far before a gate in the air one takes off, at most [m]


class Course:
    """A table for each gate, each knowing what comes after it."""

    def __init__(self, surface, ground, physics, gates):
        """surface: has sample(x, y), as those of woodlouse_surface.py; physics: game.physics; gates: game.rules["gates"]."""
        moves = Moves(surface, ground, physics)
        gates = [Gate(ground, gate["a"], gate["b"], gate.get("air", False)) for gate in gates]
        # Backwards: the table of a gate needs that of the gate behind it. Those of the first two that the last ones need know
        # less far ahead.
        after = None
        for gate in (gates + gates[:2])[:len(gates) - 1:-1]:
            after = Table(moves, gate, after)
        self.tables = []
        for gate in reversed(gates):
            after = Table(moves, gate, after)
            self.tables.insert(0, after)


class Gate:
    """A segment that is driven through from its right-hand side to its left."""

    def __init__(self, ground, a, b, air):
        self._ground, self.air = ground, air
        self._dx, self._dy = b[0] - a[0], b[1] - a[1]
        self.length = hypot(self._dx, self._dy)
        self.middle = (a[0] + b[0]) / 2, (a[1] + b[1]) / 2
        self.way = -self._dy / self.length, self._dx / self.length  # through it

    def far(self, x, y):
        """How far it is from there to its middle [m]."""
        return hypot(*self._ground.way(x, y, *self.middle))

    def crossing(self, x, y, to_x, to_y):
        """Of the straight way: 1 it leads through, -1 it leads through backwards, 0 it does neither."""
        mx, my = self._ground.way(*self.middle, x, y)
        ox, oy = mx + 0.5 * self._dx, my + 0.5 * self._dy  # from a
        px, py = self._ground.way(x, y, to_x, to_y)
        here = self._dx * oy - self._dy * ox
        there = here + self._dx * py - self._dy * px
        if (here < 0) == (there < 0):
            return 0
        share = here / (here - there)
        along = ((ox + share * px) * self._dx + (oy + share * py) * self._dy) / self.length ** 2
        if not 0 <= along <= 1:
            return 0
        return 1 if here < 0 else -1


class Moves:
    """What it takes to drive from a square to the next, for each course and speed. A state is (square * 8 + course) * LEVELS +
    level of speed."""

    def __init__(self, surface, ground, physics):
        x0, y0, x1, y1 = ground.extent
        wanted = max(SQUARE, max(x1 - x0, y1 - y0) / MOST_SQUARES)
        self.columns, self.rows = (max(3, round(side / wanted)) for side in (x1 - x0, y1 - y0))
        self._corner, self._size = (x0, y0), ((x1 - x0) / self.columns, (y1 - y0) / self.rows)
        self.sample, self.wraps = surface.sample, ground.wraps
        self.gravity, self._drag = physics["gravity"], physics["drag"]
        self.thrust = max(0.05, POWER * physics["thrust_max"] - physics["friction"] * self.gravity)  # beside friction [m/s^2]
        self.states = self.columns * self.rows * 8 * LEVELS
        self.drives = [None] * self.states  # (state at the next lower speed, share of the next higher one, seconds), or None
        self.before = [[] for _ in range(self.states)]  # of a state: which drives end there, with what share
        for square in range(self.columns * self.rows):
            for course in range(8):
                self._measure(square, course)

    def middle(self, square):
        """(x, y) of it."""
        return (self._corner[0] + (square % self.columns + 0.5) * self._size[0],
                self._corner[1] + (square // self.columns + 0.5) * self._size[1])

    def step(self, course):
        """(dx, dy) to the next middle."""
        return COURSES[course][0] * self._size[0], COURSES[course][1] * self._size[1]

    def around(self, x, y):
        """The four squares whose middles are around a place, each with its weight; those add up to 1."""
        u, v = (x - self._corner[0]) / self._size[0] - 0.5, (y - self._corner[1]) / self._size[1] - 0.5
        i, j = floor(u), floor(v)
        u, v = u - i, v - j
        return ((self._square(i, j), (1 - u) * (1 - v)), (self._square(i + 1, j), u * (1 - v)),
                (self._square(i, j + 1), (1 - u) * v), (self._square(i + 1, j + 1), u * v))

    def _square(self, i, j):
        if self.wraps:
            return j % self.rows * self.columns + i % self.columns
        return min(max(j, 0), self.rows - 1) * self.columns + min(max(i, 0), self.columns - 1)

    def _measure(self, square, course):
        i, j = square % self.columns + COURSES[course][0], square // self.columns + COURSES[course][1]
        if not self.wraps and not (0 <= i < self.columns and 0 <= j < self.rows):
            return
        (x, y), (dx, dy) = self.middle(square), self.step(course)
        length, z = hypot(dx, dy), self.sample(x, y)[0]
        hx, hy, parts = dx / length, dy / length, []
        for part in range(1, PARTS + 1):
            there, zx, zy = self.sample(x + part / PARTS * dx, y + part / PARTS * dy)[:3]
            aside = abs(zy * hx - zx * hy) * self.gravity / (1 + zx * zx + zy * zy)
            parts.append((hypot(length / PARTS, there - z), there - z, aside))
            z = there
        to = self._square(i, j)
        for level, speed in enumerate(SPEEDS):
            seconds, end, turns_back = self._drive(parts, speed)
            if seconds is None:
                continue
            first = ((square * 8 + (course + 4) % 8) if turns_back else (to * 8 + course)) * LEVELS
            low, share = between(end)
            here, low = (square * 8 + course) * LEVELS + level, first + low
            self.drives[here] = low, share, seconds
            if share < 1:
                self.before[low].append((here, low + 1, 1 - share, share, seconds))
            if share > 0:
                self.before[low + 1].append((here, low, share, 1 - share, seconds))

    def _drive(self, parts, speed):
        """Of the drive over those parts - each (length, rise, pull aside) - from that speed: (seconds, speed at its end,
        whether it turns back); the seconds are None where it gets nowhere."""
        energy, seconds, own = 0.5 * speed * speed, 0.0, self.thrust
        for number, (length, rise, aside) in enumerate(parts, 1):
            v = sqrt(2 * energy)
            aside *= min(1.0, PASSING * PASSING / max(1e-9, v * v))
            thrust = sqrt(max(0.0, own * own - aside * aside))
            gain = thrust - max(0.0, aside - own) - self._drag * v - self.gravity * rise / length
            after = energy + gain * length
            if after < 0.02:  # up until it stands, and back to where it came from
                fall, up = self.gravity * rise / length + thrust, max(0.05, -gain)
                if speed == 0 or rise <= 0:
                    return None, 0.0, False
                back = v * sqrt(max(0.1, fall / up))
                most = sqrt(speed * speed + 4 * thrust * length * number)
                return (2 * seconds + v / up + back / max(0.1, fall),
                        min(sqrt(max(0.0, speed * speed + back * back - v * v)), most), True)
            end = sqrt(2 * after)
            seconds, energy = seconds + 2 * length / (v + end), after
        return seconds, sqrt(2 * energy), False


class Table:
    """The least time to and through a gate, and through those after it."""

    def __init__(self, moves, gate, after):
        """after: the table of the gate behind it; None: nothing comes."""
        self._moves, self.gate, self.after = moves, gate, after
        self.lift = self._lift() if gate.air else 0.0  # the least speed with which it counts
        self._times = [FAR] * moves.states
        self._waiting, self._leads_through = [], set()  # the drives that do
        self._begin()
        self._search()

    def seconds(self, x, y, vx, vy):
        """From there, and so fast over the map; FAR where it is not known."""
        _, zx, zy = self._moves.sample(x, y)[:3]
        low, share = between(hypot(vx, vy, zx * vx + zy * vy))
        turned = atan2(vy, vx) * 4 / pi
        course = floor(turned)
        turned, course = turned - course, course % 8
        nearby, total, weights = self._near(x, y), 0.0, 0.0
        for square, weight in self._moves.around(x, y):
            # Who is before the gate is not where those behind it are, nor the other way round.
            side = self.gate.crossing(x, y, *self._moves.middle(square)) if nearby else 0
            if side < 0 or weight == 0:
                continue
            times = self.after._times if side > 0 and self.after else self._times
            one, other = (square * 8 + course) * LEVELS + low, (square * 8 + (course + 1) % 8) * LEVELS + low
            time = 0.0
            if side <= 0 or self.after:
                time = ((1 - turned) * ((1 - share) * times[one] + share * times[one + 1]) +
                        turned * ((1 - share) * times[other] + share * times[other + 1]))
            total, weights = total + weight * time, weights + weight
        return total / weights if weights else FAR

    def course(self, x, y, vx, vy):
        """(dx, dy) of the drive that leads on best from there."""
        moves, speed = self._moves, hypot(vx, vy)
        square = max(moves.around(x, y), key=lambda share: share[1])[0]
        low, share = between(speed)
        level, own = low + (share >= 0.5), round(atan2(vy, vx) * 4 / pi)
        best, least = own, inf
        for turn in (0, 1, -1, 2, -2) if level else range(8):
            drive = moves.drives[(square * 8 + (own + turn) % 8) * LEVELS + level]
            if drive:
                state, share, seconds = drive
                passes = (square * 8 + (own + turn) % 8) * LEVELS + level in self._leads_through
                if not passes:
                    seconds += (1 - share) * self._times[state] + share * self._times[state + 1]
                elif self.after:
                    seconds += (1 - share) * self.after._times[state] + share * self.after._times[state + 1]
                seconds += abs(turn) * TURN * speed / moves.thrust if level else 0.0
                if seconds < least:
                    best, least = own + turn, seconds
        return moves.step(best % 8)

    def _near(self, x, y):
        """Whether a way to a neighbour may lead through the gate."""
        return self.gate.far(x, y) < 0.5 * self.gate.length + 2 * max(self._moves.step(1))

    def _lift(self):
        """At which one takes off before the gate: where the ground bends away faster than one falls."""
        least, (hx, hy) = inf, self.gate.way
        for step in range(int(2 * RUN_IN) + 1):
            _, _, _, zxx, zxy, zyy = self._moves.sample(self.gate.middle[0] - 0.5 * step * hx,
                                                        self.gate.middle[1] - 0.5 * step * hy)
            bend = zxx * hx * hx + 2 * zxy * hx * hy + zyy * hy * hy
            if bend < 0:
                least = min(least, self._moves.gravity / -bend)
        return min(SPEEDS[-1] - 1, sqrt(least))

    def _begin(self):
        """From the drives that lead through the gate."""
        moves = self._moves
        for square in range(moves.columns * moves.rows):
            x, y = moves.middle(square)
            if not self._near(x, y):
                continue
            for course in range(8):
                dx, dy = moves.step(course)
                if self.gate.crossing(x, y, x + dx, y + dy) != 1:
                    continue
                for state in range((square * 8 + course) * LEVELS, (square * 8 + course + 1) * LEVELS):
                    if moves.drives[state]:
                        self._begin_with(state, course)

    def _begin_with(self, state, course):
        low, share, seconds = self._moves.drives[state]
        level = low % LEVELS
        if low // LEVELS % 8 != course or SPEEDS[level] + share * (SPEEDS[level + 1] - SPEEDS[level]) < self.lift:
            return  # it turns back before it, or does not fly
        self._leads_through.add(state)
        if self.after:
            seconds += (1 - share) * self.after._times[low] + share * self.after._times[low + 1]
        if seconds < self._times[state]:
            self._times[state] = seconds
            heappush(self._waiting, (seconds, state))

    def _search(self):
        times, waiting, before, leads_through = self._times, self._waiting, self._moves.before, self._leads_through
        thrust = self._moves.thrust
        turns = [TURN * speed / thrust for speed in SPEEDS]
        slower = [(b - a) / thrust for a, b in zip(SPEEDS, SPEEDS[1:])]
        while waiting:
            time, state = heappop(waiting)
            if time > times[state]:
                continue
            for other, partner, weight, rest, seconds in before[state]:
                found = seconds + weight * time + rest * times[partner]
                if found < times[other] - SETTLED and other not in leads_through:
                    times[other] = found
                    heappush(waiting, (found, other))
            level = state % LEVELS
            course = state // LEVELS % 8
            turned = time + turns[level]
            for other in (state + (LEVELS if course < 7 else -7 * LEVELS), state - (LEVELS if course else -7 * LEVELS)):
                if turned < times[other] - SETTLED:
                    times[other] = turned
                    heappush(waiting, (turned, other))
            if level < LEVELS - 1 and time + slower[level] < times[state + 1]:
                times[state + 1] = time + slower[level]
                heappush(waiting, (times[state + 1], state + 1))


def between(speed):
    """The level of speed below it, and what share of the way to the next one it is."""
    low = 0
    while low + 2 < LEVELS and SPEEDS[low + 1] <= speed:
        low += 1
    return low, min(1.0, (speed - SPEEDS[low]) / (SPEEDS[low + 1] - SPEEDS[low]))
