"""The ground of a map, as its knots tell it: heights and slopes between them."""

import math

_MAP_DEFAULTS = {"equations": "exact", "method": "standard", "contact": "bilateral", "edges": "walls",
                 "central_gravity": 0, "tolerance": 0}


class Ground:
    """The map's heights between its knots: Catmull-Rom, which goes through the knots and has a smooth gradient.

    The server's own surface is a spline through the same knots; near a knot both agree, between two knots they
    differ by a few per cent of the relief within the cell. woodlouse_surface.py has the spline itself.

    Attributes: name; origin (x, y) of the first knot [m]; spacing (dx, dy) [m]; heights[j][i], row j from the south,
    column i from the west [m]; columns, rows; extent (x_min, y_min, x_max, y_max) [m]; wraps: the edges do, so that the
    last column and row are the first again; definition: the whole map file as the server sent it; overview: the map is
    too big to be sent, and these knots are but some of its own.
    """

    def __init__(self, name, origin, spacing, heights, wraps=False, definition=None, overview=False):
        self.name = name
        self.origin = origin
        self.spacing = spacing
        self.heights = heights
        self.wraps = wraps
        self.definition = definition or {}
        self.overview = overview
        self.columns = len(heights[0])
        self.rows = len(heights)
        self.extent = (origin[0], origin[1], origin[0] + (self.columns - 1) * spacing[0],
                       origin[1] + (self.rows - 1) * spacing[1])

    def height(self, x, y):
        """z at (x, y) [m]; outside the extent, at the nearest point of its rim, or where the edges wrap as many sides
        of the map away as it takes."""
        return self._blend(x, y, _value, _value)

    def gradient(self, x, y):
        """(dz/dx, dz/dy) at (x, y): points uphill; its length is the slope. Outside the extent as height()."""
        return self._blend(x, y, _slope, _value) / self.spacing[0], self._blend(x, y, _value, _slope) / self.spacing[1]

    def summit(self):
        """(x, y, z) of the highest summit [m]: a knot that is not on the rim (where the edges wrap there is none) and
        higher than its 8 neighbours; of several equally high ones side by side that are so together, one. None where
        the map has no summit: a bowl, a slope or level ground. highest() is there for those."""
        looked_at = set()
        for z, j, i in sorted(((z, j, i) for j, row in enumerate(self.heights) for i, z in enumerate(row)), reverse=True):
            if self.wraps and (i == self.columns - 1 or j == self.rows - 1):
                continue  # the first one again
            if (i, j) not in looked_at and self._stands_out(i, j, looked_at):
                return self._place(i, j)
        return None

    def highest(self):
        """(x, y, z) of the highest knot of all [m], be it on the rim."""
        return self._place(*max(((i, j) for j in range(self.rows) for i in range(self.columns)),
                                key=lambda knot: self.heights[knot[1]][knot[0]]))

    def way(self, x, y, to_x, to_y):
        """(dx, dy) [m] from (x, y) to (to_x, to_y): straight, and where the edges wrap the shortest, over a seam or not."""
        x_min, y_min, x_max, y_max = self.extent
        if not self.wraps:
            return to_x - x, to_y - y
        return math.remainder(to_x - x, x_max - x_min), math.remainder(to_y - y, y_max - y_min)

    def _place(self, i, j):
        return self.origin[0] + i * self.spacing[0], self.origin[1] + j * self.spacing[1], self.heights[j][i]

    def _stands_out(self, i, j, looked_at):
        """Whether the level ground around that knot is inside the map and all around it lies lower."""
        level, waiting, around, rim = self.heights[j][i], [(i, j)], [], False
        while waiting:
            i, j = waiting.pop()
            if (i, j) in looked_at:
                continue
            looked_at.add((i, j))
            for a, b in ((i + a, j + b) for a in (-1, 0, 1) for b in (-1, 0, 1) if a or b):
                if self.wraps:
                    a, b = a % (self.columns - 1), b % (self.rows - 1)
                if not (0 <= a < self.columns and 0 <= b < self.rows):
                    rim = True
                elif self.heights[b][a] == level:
                    waiting.append((a, b))
                else:
                    around.append(self.heights[b][a])
        return not rim and bool(around) and max(around) < level

    def _blend(self, x, y, along_x, along_y):
        i, u = _cell((x - self.origin[0]) / self.spacing[0], self.columns, self.wraps)
        j, v = _cell((y - self.origin[1]) / self.spacing[1], self.rows, self.wraps)
        weights = along_x(u)
        columns = [sum(w * self._knot(i + a, j + b) for a, w in enumerate(weights, -1)) for b in (-1, 0, 1, 2)]
        return sum(w * z for w, z in zip(along_y(v), columns))

    def _knot(self, i, j):
        if self.wraps:
            return self.heights[j % (self.rows - 1)][i % (self.columns - 1)]
        # Past the rim the last two knots go on in a straight line.
        if i < 0:
            return 2 * self._knot(0, j) - self._knot(1, j)
        if i >= self.columns:
            return 2 * self._knot(self.columns - 1, j) - self._knot(self.columns - 2, j)
        if j < 0:
            return 2 * self.heights[0][i] - self.heights[1][i]
        if j >= self.rows:
            return 2 * self.heights[self.rows - 1][i] - self.heights[self.rows - 2][i]
        return self.heights[j][i]


def _cell(position, knots, wraps):
    position = position % (knots - 1) if wraps else min(max(position, 0.0), knots - 1.0)
    index = min(int(position), knots - 2)
    return index, position - index


def _value(t):
    return (-0.5 * t + t * t - 0.5 * t ** 3, 1 - 2.5 * t * t + 1.5 * t ** 3,
            0.5 * t + 2 * t * t - 1.5 * t ** 3, -0.5 * t * t + 0.5 * t ** 3)


def _slope(t):
    return (-0.5 + 2 * t - 1.5 * t * t, -5 * t + 4.5 * t * t, 0.5 + 4 * t - 4.5 * t * t, -t + 1.5 * t * t)


def complete(physics, definition):
    """Fills in what an older server's welcome leaves out of the physics, from the map's definition."""
    for field, value in _MAP_DEFAULTS.items():
        of_map = definition if field == "edges" else definition.get("physics", {})
        physics.setdefault(field, of_map.get(field, value))
    central = physics["central_gravity"]
    physics.setdefault("core_radius", definition.get("physics", {}).get("core_radius", _core_radius(central)))


def _core_radius(central_gravity):
    """That of a map that names none [m]: maps/README.md."""
    return (35 / 8 * central_gravity / (15 * 256 * 0.05) ** 2) ** (1 / 3)
