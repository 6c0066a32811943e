"""Ways over a map's ground that a thrust can climb, for woodlouse_play.py: the cheapest over a grid of cells."""

import heapq
from math import hypot, sqrt

CELLS = 48  # a side
KEPT = 64  # ways that are remembered
EASY = 0.8  # of the thrust: what a way may ask for against the slope
STEPS = ((1, 0), (-1, 0), (0, 1), (0, -1), (1, 1), (1, -1), (-1, 1), (-1, -1))


class Ways:
    def __init__(self, ground, physics):
        """physics: game.physics."""
        x0, y0, x1, y1 = ground.extent
        self._ground, self._origin, self._wraps = ground, (x0, y0), ground.wraps
        self._size = (x1 - x0) / CELLS, (y1 - y0) / CELLS
        self._gravity, self._drag, self._full = (physics[name] for name in ("gravity", "drag", "thrust_max"))
        self._friction = physics["friction"]
        self._limit = max(0.01, EASY * self._full / max(self._gravity, 1e-9) - self._friction)  # the slope that is easy
        self._slopes = [ground.gradient(*self._middle(cell)) for cell in range(CELLS * CELLS)]
        self._fields = {}

    def carries(self, me, place):
        """Whether it comes straight to the place, by its speed and its thrust."""
        dx, dy = self._ground.way(me.x, me.y, *place)
        far = hypot(dx, dy)
        if far < 0.5:
            return True
        hx, hy = dx / far, dy / far
        pieces = max(2, min(60, int(far / min(self._size)) + 1))
        length, speed2 = far / pieces, max(0.0, me.vx * hx + me.vy * hy) ** 2
        for piece in range(pieces):
            share = (piece + 0.5) * length
            gx, gy = self._slopes[self._cell(me.x + share * hx, me.y + share * hy)]
            up, aside = gx * hx + gy * hy, abs(gy * hx - gx * hy)
            pull = self._gravity / (1 + gx * gx + gy * gy)
            held = min(1.0, pull * aside / max(self._full, 1e-9))  # of the thrust, lest it is carried off
            push = 0.95 * self._full * sqrt(1 - held * held)
            resistance = self._drag * sqrt(speed2) + self._friction * self._gravity
            speed2 += 2 * length * (sqrt(1 + up * up) * (push - resistance) - self._gravity * up)  # energies
            if speed2 < 0.1:
                return False
            speed2 = min(speed2, 400.0)
        return True

    def cost(self, x, y, place):
        """Of the way from there to the place: metres, more where it is steep."""
        cell = self._cell(x, y)
        if cell == self._cell(*place):
            return hypot(*self._ground.way(x, y, *place))
        return self._field(place)[0][cell] + 0.5 * hypot(*self._ground.way(x, y, *self._middle(cell)))

    def on_the_way(self, me, place):
        """A place on the way to it, as far on as a louse comes straight."""
        onwards, cell, places = self._field(place)[1], self._cell(me.x, me.y), []
        while len(places) < 12 and onwards[cell] is not None:
            cell = onwards[cell]
            places.append(self._middle(cell) if onwards[cell] is not None else place)
        for ahead in (11, 7, 4):
            if ahead < len(places) and self.carries(me, places[ahead]):
                return places[ahead]
        return places[min(2, len(places) - 1)] if places else place

    def _field(self, place):
        """Of each cell the cost from there to the place, and the next cell of that way."""
        goal = self._cell(*place)
        if goal not in self._fields:
            if len(self._fields) >= KEPT:
                del self._fields[next(iter(self._fields))]
            self._fields[goal] = self._spread(goal)
        return self._fields[goal]

    def _spread(self, goal):
        costs, onwards, waiting = [float("inf")] * (CELLS * CELLS), [None] * (CELLS * CELLS), [(0.0, goal)]
        costs[goal] = 0.0
        while waiting:
            cost, cell = heapq.heappop(waiting)
            if cost > costs[cell]:
                continue
            for a, b in STEPS:
                other = self._beside(cell, a, b)
                if other is None:
                    continue
                found = cost + self._step(other, -a * self._size[0], -b * self._size[1])
                if found < costs[other]:
                    costs[other], onwards[other] = found, cell
                    heapq.heappush(waiting, (found, other))
        return costs, onwards

    def _step(self, cell, dx, dy):
        length, (gx, gy) = hypot(dx, dy), self._slopes[cell]
        up, aside = (gx * dx + gy * dy) / length / self._limit, abs(gy * dx - gx * dy) / length / self._limit
        return length * (1 + 0.5 * max(0.0, up) + 8 * max(0.0, up - 1) + 4 * max(0.0, aside - 1))

    def _beside(self, cell, a, b):
        i, j = cell % CELLS + a, cell // CELLS + b
        if self._wraps:
            i, j = i % CELLS, j % CELLS
        elif not (0 <= i < CELLS and 0 <= j < CELLS):
            return None
        return j * CELLS + i

    def _cell(self, x, y):
        i, j = int((x - self._origin[0]) // self._size[0]), int((y - self._origin[1]) // self._size[1])
        if self._wraps:
            return j % CELLS * CELLS + i % CELLS
        return max(0, min(CELLS - 1, j)) * CELLS + max(0, min(CELLS - 1, i))

    def _middle(self, cell):
        i, j = cell % CELLS, cell // CELLS
        return self._origin[0] + (i + 0.5) * self._size[0], self._origin[1] + (j + 0.5) * self._size[1]
