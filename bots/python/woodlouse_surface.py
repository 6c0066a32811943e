"""The server's own ground: heights, slopes and curvatures as it computes them, to rounding.

Where a map's `surface` is "function", the function itself; else the bicubic spline through the knots
(shared/terrain/bicubic_spline.h): "spline" has not-a-knot ends, "natural_spline" none of its curvature there, and
where the edges wrap both axes are periodic. Lengths in metres.
"""

from math import cos, floor, pi, sin


def surface_of(ground):
    """The surface of a Ground that came over the wire (game.map()): what the server steps lice on.

    Raises ValueError where only the server knows it: of a map that is too big to be sent, or whose function is not
    among those here.
    """
    terrain = ground.definition.get("terrain", {})
    kind = ground.definition.get("surface", "spline")
    if ground.overview:
        raise ValueError("%s was sent as an overview: its ground between the knots is not known" % ground.name)
    if kind == "function":
        if terrain.get("function") not in _FUNCTIONS:
            raise ValueError("no such function here: %r" % terrain.get("function"))
        return FunctionSurface(terrain["function"], terrain.get("scale", 20.0))
    ends = "periodic" if ground.wraps else {"spline": "not_a_knot", "natural_spline": "natural"}.get(kind)
    if ends is None:
        raise ValueError("no such surface here: %r" % kind)
    return SplineSurface(ground.origin, ground.spacing, ground.heights, ends)


class SplineSurface:
    """The bicubic spline through heights[j][i] [m], row j from the south, column i from the west.

    origin: (x, y) of heights[0][0] [m]; spacing: (dx, dy) [m], above 0; ends: "not_a_knot" or "periodic" (at least 4
    knots each way), or "natural" (at least 2). Periodic: the last row and column are taken to be the first.
    """

    def __init__(self, origin, spacing, heights, ends="not_a_knot"):
        self._origin, self._spacing, self._wraps = origin, spacing, ends == "periodic"
        self._columns, self._rows = len(heights[0]) - 1, len(heights) - 1  # of cells
        if self._wraps:
            heights = [list(row[:-1]) + [row[0]] for row in heights]
            heights[-1] = heights[0]
        self._z = heights
        self._zx = [spline_slopes(row, spacing[0], ends) for row in heights]
        self._zy = _along_columns(heights, spacing[1], ends)
        self._zxy = _along_columns(self._zx, spacing[1], ends)
        self._cells = {}  # made when somebody comes there

    def sample(self, x, y):
        """(z, zx, zy, zxx, zxy, zyy) at (x, y): height [m], gradient, second derivatives [1/m]. Outside the knots: the
        opposite edge's side where the ends are periodic, else the outermost cell's polynomial goes on."""
        i, u = _cell((x - self._origin[0]) / self._spacing[0], self._columns, self._wraps)
        j, v = _cell((y - self._origin[1]) / self._spacing[1], self._rows, self._wraps)
        cell = self._cells.get((i, j)) or self._make(i, j)
        u, v = u * self._spacing[0], v * self._spacing[1]
        values, slopes, bends = [], [], []
        for a0, a1, a2, a3 in cell:  # cubics in u, one for each power of v
            values.append(a0 + u * (a1 + u * (a2 + u * a3)))
            slopes.append(a1 + u * (2 * a2 + u * 3 * a3))
            bends.append(2 * a2 + 6 * u * a3)
        b0, b1, b2, b3 = values
        s0, s1, s2, s3 = slopes
        c0, c1, c2, c3 = bends
        return (b0 + v * (b1 + v * (b2 + v * b3)), s0 + v * (s1 + v * (s2 + v * s3)), b1 + v * (2 * b2 + v * 3 * b3),
                c0 + v * (c1 + v * (c2 + v * c3)), s1 + v * (2 * s2 + v * 3 * s3), 2 * b2 + 6 * v * b3)

    def _make(self, i, j):
        def along_x(z, zx, row):
            return _hermite(z[row][i], z[row][i + 1], zx[row][i], zx[row][i + 1], self._spacing[0])

        ends = zip(along_x(self._z, self._zx, j), along_x(self._z, self._zx, j + 1),
                   along_x(self._zy, self._zxy, j), along_x(self._zy, self._zxy, j + 1))
        columns = [_hermite(*four, self._spacing[1]) for four in ends]
        self._cells[i, j] = cell = tuple(zip(*columns))
        return cell


def spline_slopes(values, spacing, ends):
    """The slopes at its knots of the cubic spline through values, `spacing` apart; ends as for SplineSurface."""
    n, k = len(values), 3.0 / spacing
    if ends == "periodic":
        return _periodic_slopes(values, k)
    right = [0.0] + [k * (values[i + 1] - values[i - 1]) for i in range(1, n - 1)] + [0.0]
    below, diagonal, above = [1.0] * n, [4.0] * n, [1.0] * n
    if ends == "natural":
        diagonal[0] = diagonal[-1] = 2.0
        right[0], right[-1] = k * (values[1] - values[0]), k * (values[-1] - values[-2])
    else:
        # The third derivative goes on over the second knot: with the second knot's own row it is this one.
        diagonal[0] = diagonal[-1] = 1.0
        above[0] = below[-1] = 2.0
        right[0] = (-5 * values[0] + 4 * values[1] + values[2]) / (2 * spacing)
        right[-1] = (5 * values[-1] - 4 * values[-2] - values[-3]) / (2 * spacing)
    return _tridiagonal(below, diagonal, above, right)


def _periodic_slopes(values, k):
    # A cyclic system is a tridiagonal one and a correction of rank one (Sherman and Morrison).
    p = len(values) - 1
    right = [k * (values[(i + 1) % p] - values[i - 1 if i else p - 1]) for i in range(p)]
    ones, diagonal = [1.0] * p, [8.0] + [4.0] * (p - 2) + [4.25]
    y = _tridiagonal(ones, diagonal, ones, right)
    q = _tridiagonal(ones, diagonal, ones, [-4.0] + [0.0] * (p - 2) + [1.0])
    factor = (y[0] - 0.25 * y[-1]) / (1 + q[0] - 0.25 * q[-1])
    slopes = [a - factor * b for a, b in zip(y, q)]
    return slopes + slopes[:1]


def _tridiagonal(below, diagonal, above, right):
    """x of below[i] x[i-1] + diagonal[i] x[i] + above[i] x[i+1] = right[i]."""
    upper, x = [above[0] / diagonal[0]], [right[0] / diagonal[0]]
    for i in range(1, len(right)):
        pivot = diagonal[i] - below[i] * upper[-1]
        upper.append(above[i] / pivot)
        x.append((right[i] - below[i] * x[-1]) / pivot)
    for i in range(len(right) - 2, -1, -1):
        x[i] -= upper[i] * x[i + 1]
    return x


def _along_columns(rows, spacing, ends):
    return list(zip(*(spline_slopes(column, spacing, ends) for column in zip(*rows))))


def _hermite(f0, f1, d0, d1, h):
    secant = (f1 - f0) / h
    return f0, d0, (3 * secant - 2 * d0 - d1) / h, (d0 + d1 - 2 * secant) / (h * h)


def _cell(position, cells, wraps):
    if wraps:
        position -= cells * floor(position / cells)
    index = min(max(floor(position), 0), cells - 1)
    return index, position - index


class FunctionSurface:
    """A named function of maps/README.md on [-scale, scale]^2 [m]: z(x, y) = scale f(x / scale, y / scale).

    Raises ValueError for a name that is none of them.
    """

    def __init__(self, name, scale=20.0):
        if name not in _FUNCTIONS:
            raise ValueError("no such function: %r; there are %s" % (name, ", ".join(_FUNCTIONS)))
        self._function, self._scale = _FUNCTIONS[name], scale

    def sample(self, x, y):
        """(z, zx, zy, zxx, zxy, zyy) at (x, y), as SplineSurface gives them; exact everywhere."""
        s = self._scale
        z, zx, zy, zxx, zxy, zyy = self._function(x / s, y / s)
        return s * z, zx, zy, zxx / s, zxy / s, zyy / s


def _parabolic_pot(x, y):
    return 0.5 * (x * x + y * y), x, y, 1.0, 0.0, 1.0


def _wavy_pot(x, y):
    waves = _product(0.03, _cosine(2 * pi, x), _cosine(2 * pi, y))
    return tuple(a + b for a, b in zip(_parabolic_pot(x, y), waves))


def _volcano(x, y):
    d = x * x + y * y + 0.1
    first, second = -0.04 / (d * d), 0.16 / d ** 3  # of 0.02 / d: once and twice by the square of the radius, halved
    return (0.5 * (d - 0.1) + 0.02 / d, (1 + first) * x, (1 + first) * y, 1 + first + second * x * x, second * x * y,
            1 + first + second * y * y)


def _hills(x, y):
    z, zx, zy, zxx, zxy, zyy = _product(0.3, _sine(2.3, x, 0.4), _cosine(1.7, y, -0.2))
    return z + 0.1 * x * y, zx + 0.1 * y, zy + 0.1 * x, zxx, zxy + 0.1, zyy


def _waves(x, y):
    return tuple(a + b for a, b in zip(_product(0.12, _cosine(pi, x), _cosine(pi, y)),
                                       _product(0.03, _sine(2 * pi, x), _sine(3 * pi, y))))


def _sine(k, t, phase=0.0):
    s, c = sin(k * t + phase), cos(k * t + phase)
    return s, k * c, -k * k * s


def _cosine(k, t, phase=0.0):
    return _sine(k, t, phase + 0.5 * pi)


def _product(factor, along_x, along_y):
    (f, fx, fxx), (g, gy, gyy) = along_x, along_y
    return factor * f * g, factor * fx * g, factor * f * gy, factor * fxx * g, factor * fx * gy, factor * f * gyy


_FUNCTIONS = {"parabolic_pot": _parabolic_pot, "wavy_pot": _wavy_pot, "volcano": _volcano, "hills": _hills,
              "waves": _waves}
