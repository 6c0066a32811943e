"""What the walls at a map's edge do to who meets them or leans on them: docs/physics.md's walls, for woodlouse_motion.py.

ground: (z, zx, zy, zxx, zxy, zyy) at the place, as a surface's sample(x, y) gives it. walls: (x, y), each -1 for the wall at
the low end, 1 for that at the high end, 0 for none. u, a: pairs over the map.
"""

NO_WALLS = (0, 0)


def bounced(ground, walls, u, restitution):
    """u thrown back by the walls that it points into."""
    for _ in range(9):  # at most 8 impacts, between the two walls of a corner
        if walls[0] * u[0] > 0:
            u = _react_x(ground, u, 1 + restitution)
        elif walls[1] * u[1] > 0:
            u = _react_y(ground, u, 1 + restitution)
        else:
            return u
    return (0.0, 0.0)


def supported(ground, walls, a):
    """What the walls leave of an acceleration without friction, and what they add to the load (the normal force times
    sqrt(1 + slope^2)) [m/s^2]: a wall carries."""
    _, zx, zy, _, _, _ = ground
    w2 = 1 + zx * zx + zy * zy
    into_x, into_y = walls[0] * a[0] > 0, walls[1] * a[1] > 0
    if into_x:
        left = _react_x(ground, a, 1.0)
        if not walls[1] * left[1] > 0:
            return left, -zx * a[0] * w2 / (1 + zy * zy)
    if into_y:
        left = _react_y(ground, a, 1.0)
        if not walls[0] * left[0] > 0:
            return left, -zy * a[1] * w2 / (1 + zx * zx)
    if into_x or into_y:
        return (0.0, 0.0), -w2 * (zx * a[0] + zy * a[1])
    return a, 0.0


def _react_x(ground, u, factor):
    """u less `factor` times what a wall x = const takes: 1 leaves nothing along its normal."""
    impulse = factor * u[0]
    return u[0] - impulse, u[1] + impulse * ground[1] * ground[2] / (1 + ground[2] ** 2)


def _react_y(ground, u, factor):
    impulse = factor * u[1]
    return u[0] + impulse * ground[1] * ground[2] / (1 + ground[1] ** 2), u[1] - impulse
