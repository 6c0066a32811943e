"""The ground of a map, as its knots tell it: heights and slopes between them."""


class Ground:
    """The map's heights between its knots: Catmull-Rom, which goes through the knots and has a smooth gradient.

    The server's own surface is a spline through the same knots; near a knot both agree, between two knots they
    differ by a few per cent of the relief within the cell.
    """

    def __init__(self, name, origin, spacing, heights):
        self.name = name
        self.origin = origin
        self.spacing = spacing
        self.heights = heights  # heights[j][i]: row j from the south, column i from the west [m]
        self.columns = len(heights[0])
        self.rows = len(heights)
        self.extent = (origin[0], origin[1], origin[0] + (self.columns - 1) * spacing[0],
                       origin[1] + (self.rows - 1) * spacing[1])

    def height(self, x, y):
        """z at (x, y) [m]; outside the extent, at the nearest point of its rim."""
        return self._blend(x, y, _value, _value)

    def gradient(self, x, y):
        """(dz/dx, dz/dy) at (x, y): points uphill; its length is the slope."""
        return self._blend(x, y, _slope, _value) / self.spacing[0], self._blend(x, y, _value, _slope) / self.spacing[1]

    def summit(self):
        """(x, y, z) of the highest knot that is not on the rim."""
        z, j, i = max((self.heights[j][i], j, i) for j in range(1, self.rows - 1) for i in range(1, self.columns - 1))
        return self.origin[0] + i * self.spacing[0], self.origin[1] + j * self.spacing[1], z

    def _blend(self, x, y, along_x, along_y):
        i, u = _cell((x - self.origin[0]) / self.spacing[0], self.columns)
        j, v = _cell((y - self.origin[1]) / self.spacing[1], self.rows)
        weights = along_x(u)
        columns = [sum(w * self._knot(i + a, j + b) for a, w in enumerate(weights, -1)) for b in (-1, 0, 1, 2)]
        return sum(w * z for w, z in zip(along_y(v), columns))

    def _knot(self, i, j):
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


def _cell(position, knots):
    position = min(max(position, 0.0), knots - 1.0)
    index = min(int(position), knots - 2)
    return index, position - index


def _value(t):
    return (-0.5 * t + t * t - 0.5 * t ** 3, 1 - 2.5 * t * t + 1.5 * t ** 3,
            0.5 * t + 2 * t * t - 1.5 * t ** 3, -0.5 * t * t + 0.5 * t ** 3)


def _slope(t):
    return (-0.5 + 2 * t - 1.5 * t * t, -5 * t + 4.5 * t * t, 0.5 + 4 * t - 4.5 * t * t, -t + 1.5 * t * t)
