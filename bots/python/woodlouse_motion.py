"""The motion of a louse, computed beside the server: docs/physics.md's exact equations by Runge and Kutta's method.

From an exact state - the `you` of an ack, or a row of all columns in exact format - `Motion.after` tells where the louse
will be if its thrust stays as it is. Units: m, m/s, ticks. What it takes is some 10 ms of processor time for half a second
of motion; how far it errs is tested against a server (tests/test_predict.py). Two things it knows but roughly: who comes
to a wall at less than 5 cm/s, whom it does not throw back here, and who grazes a crest of a unilateral map - whether it
hops there hangs on the server's own steps, and half a second later it may be two centimetres elsewhere. Bumps it does not
know, nor what rules of play make of who stands at an open edge.
"""

import collections
from math import floor, hypot, sqrt

from woodlouse_walls import NO_WALLS, bounced, supported

LONGEST_S = 1 / 240  # of a step
SHORTEST_S = 1 / 8192  # slower than this resolves, a louse stands
SLOWEST_BOUNCE = 0.05  # [m/s]
HEADING_LENGTH = 0.3  # [m] of way over the map: how slowly the heading turns into the velocity's direction
MOVING, RESTING, FLYING = 0, 1, 2  # phase
ALONG_HEADING, MAP_VECTOR = 1, 2  # thrust_kind
HELD = 4294967295  # ticks_left of a thrust that holds until the next one

Body = collections.namedtuple("Body", "tick x y vx vy heading_x heading_y tx ty thrust_kind ticks_left phase flight_z "
                                      "flight_vz")
Body.__doc__ = "A louse's state at `tick`; the fields are those of docs/protocol.md's columns in exact format."

Drive = collections.namedtuple("Drive", "push direction turns brake")
Drive.__doc__ = """What a thrust does: it pushes [m/s^2] over a direction of the map, or over the heading, that turns; or it
brakes [m/s^2]."""


def body_of_ack(you):
    """The Body of the `you` of an ack. Raises KeyError where it is none."""
    return Body(you["tick"], you["x"], you["y"], you["vx"], you["vy"], *you["heading"], *you["thrust"],
                you["thrust_kind"], you["thrust_ticks"], you["phase"], you["flight_z"], you["flight_vz"])


def body_of_row(tick, row):
    """The Body of a row at `tick`, from connect(..., fields="all", format="exact"). Raises AttributeError where a column
    is missing."""
    return Body(tick, *(getattr(row, name) for name in Body._fields[1:]))


class Motion:
    """How lice move on one map, as the server moves them.

    surface: has sample(x, y) (woodlouse_surface.surface_of(ground)). physics: game.physics, after game.map(). extent:
    (x_min, y_min, x_max, y_max) [m]. tick_hz: 1 to 1000.
    Raises ValueError where the room uses other equations than the exact ones, or false Euler's method, whose errors
    are above what is computed here.
    """

    def __init__(self, surface, physics, extent, tick_hz):
        if physics["equations"] != "exact" or physics["method"] == "false_euler":
            raise ValueError("the room moves lice by %s equations, method %s: not computed here"
                             % (physics["equations"], physics["method"]))
        self._sample, self._extent, self._tick = surface.sample, extent, 1.0 / tick_hz
        self._gravity, self._drag, self._friction = physics["gravity"], physics["drag"], physics["friction"]
        self._full, self._bounce = physics["thrust_max"], physics["edge_restitution"]
        self._central, self._core = physics["central_gravity"], physics["core_radius"]
        self._wraps, self._opens = physics["edges"] == "wrap", physics["edges"] == "open"
        self._flies = physics["contact"] == "unilateral"
        # The server looks for the ends of contact and of flight where its own steps end, mostly a tick long: who looks more
        # often sees hops over crests that are none there.
        self._longest = self._tick if self._flies else LONGEST_S

    def after(self, body, ticks):
        """The Body `ticks` later. REQUIRES ticks >= 0."""
        for _ in range(ticks):
            body = self._next(body)
        return body

    def _next(self, body):
        left = self._tick
        while left > 1e-12:
            body, used = self._fly(body, left) if body.phase == FLYING else self._slide(body, left)
            left -= used
        kind, ticks_left = body.thrust_kind, body.ticks_left
        if kind and ticks_left != HELD:
            ticks_left -= 1
            if ticks_left == 0:
                return body._replace(tick=body.tick + 1, thrust_kind=0, tx=0.0, ty=0.0, ticks_left=0)
        return body._replace(tick=body.tick + 1, ticks_left=ticks_left)

    # ---- on the ground ----

    def _slide(self, body, left):
        """One step of at most `left` seconds: the body after it, and the time it took."""
        at = (body.x, body.y, body.vx, body.vy, body.heading_x, body.heading_y)
        ground, drive, walls = self._sample(body.x, body.y), self._drive(body), self._leant_on(at)
        ax, ay, load = self._forces(ground, at, drive, walls)
        speed, hold = _in_space(ground, body.vx, body.vy), self._hold(ground, load, drive)
        h = min(left, self._longest)
        while h > SHORTEST_S and self._too_long(ground, at, (ax, ay), speed, hold, drive, h):
            h *= 0.5
        if speed <= hold * min(h, SHORTEST_S):  # friction or a brake ends what is left, or it stands already
            at = at[:2] + (0.0, 0.0) + at[4:]
            ax, ay, load = self._forces(ground, at, drive, self._leant_on(at))
            if _in_space(ground, ax, ay) <= self._hold(ground, load, drive):
                return body._replace(vx=0.0, vy=0.0, phase=RESTING), left
            if self._lets_out(at, (ax, ay)):
                return self._left(body, at, drive), left
            at = at[:2] + (1e-9 * ax, 1e-9 * ay) + at[4:]  # off it goes: the speed of a nanosecond
            walls = self._leant_on(at)
        elif self._lets_out(at, (ax, ay)):
            return self._left(body, at, drive), left
        end = self._runge_kutta(at, drive, walls, h)
        if self._opens and self._beyond(end):
            return self._left(body, self._reached(at, drive, walls, h)[0], drive), left
        if not self._wraps and self._beyond(end):
            end, h = self._at_wall(at, drive, walls, h)
        if self._flies and self._lifts_off(end, drive, walls):
            h = _first(lambda t: self._lifts_off(self._runge_kutta(at, drive, walls, t), drive, walls), h)
            end = self._runge_kutta(at, drive, walls, h)
            ground = self._sample(end[0], end[1])
            climb = ground[1] * end[2] + ground[2] * end[3]
            body = body._replace(phase=FLYING, flight_z=ground[0], flight_vz=climb)
        else:
            body = body._replace(phase=MOVING)
        return self._moved(body, end[:4], end[4:] if drive.turns else None), h

    def _drive(self, body):
        if body.thrust_kind == ALONG_HEADING:
            f = body.tx * self._full
            return Drive(f, None, True, 0.0) if f > 0 else Drive(0.0, None, False, -f)
        size = hypot(body.tx, body.ty) if body.thrust_kind == MAP_VECTOR else 0.0
        return Drive(size * self._full, (body.tx, body.ty), False, 0.0)

    def _forces(self, ground, at, drive, walls):
        """The acceleration as the walls leave it, but for friction and a brake; and the load, the normal force times
        sqrt(1 + slope^2) [m/s^2]."""
        x, y, vx, vy, hx, hy = at
        _, zx, zy, _, _, _ = ground
        load = self._gravity + _bend(ground, vx, vy)
        ax, ay = -self._drag * vx, -self._drag * vy
        if self._central:
            pull = self._central_pull(x, y)
            load -= pull * (zx * x + zy * y)
            ax, ay = ax - pull * x, ay - pull * y
        share = load / (1 + zx * zx + zy * zy)
        ax, ay = ax - share * zx, ay - share * zy
        if drive.push:
            dx, dy = (hx, hy) if drive.turns else drive.direction
            f = drive.push / _in_space(ground, dx, dy)
            ax, ay = ax + f * dx, ay + f * dy
        if walls != NO_WALLS:
            (ax, ay), carried = supported(ground, walls, (ax, ay))
            load += carried
        return ax, ay, load

    def _hold(self, ground, load, drive):
        """What friction and a brake hold against [m/s^2]."""
        return self._friction * abs(load) / sqrt(1 + ground[1] ** 2 + ground[2] ** 2) + drive.brake

    def _central_pull(self, x, y):
        """Its acceleration by the distance from the origin [1/s^2]; within the core it is smooth."""
        r2, core2 = x * x + y * y, self._core * self._core
        if r2 >= core2:
            return self._central / (r2 * sqrt(r2))
        q = r2 / core2
        return self._central / (core2 * self._core) * (35 / 8 - (21 / 4 - 15 / 8 * q) * q)

    def _too_long(self, ground, at, a, speed, hold, drive, h):
        bend = hypot(ground[3], ground[5], ground[4] * 1.5)
        swing = self._gravity * bend + (self._central_pull(at[0], at[1]) if self._central else 0.0)
        return (h * h * swing > 0.0025 or h * speed * bend > 0.1 or h * self._drag > 0.25 or
                h * hold > 0.25 * speed > 0 or
                (drive.turns and h * hypot(at[2], at[3], h * a[0], h * a[1]) > 0.5 * HEADING_LENGTH))

    def _lifts_off(self, at, drive, walls):
        return self._forces(self._sample(at[0], at[1]), at, drive, walls)[2] < 0

    def _rates(self, at, drive, walls):
        x, y, vx, vy, hx, hy = at
        ground = self._sample(x, y)
        ax, ay, load = self._forces(ground, at, drive, walls)
        speed = _in_space(ground, vx, vy)
        if speed > 0:
            resistance = self._hold(ground, load, drive) / speed
            ax, ay = ax - resistance * vx, ay - resistance * vy
        if not drive.turns:
            return vx, vy, ax, ay, 0.0, 0.0
        along = hx * vx + hy * vy
        return vx, vy, ax, ay, (vx - along * hx) / HEADING_LENGTH, (vy - along * hy) / HEADING_LENGTH

    def _runge_kutta(self, at, drive, walls, h):
        a = self._rates(at, drive, walls)
        b = self._rates(_moved_on(at, a, 0.5 * h), drive, walls)
        c = self._rates(_moved_on(at, b, 0.5 * h), drive, walls)
        d = self._rates(_moved_on(at, c, h), drive, walls)
        end = _moved_on(at, [r1 + 2 * (r2 + r3) + r4 for r1, r2, r3, r4 in zip(a, b, c, d)], h / 6)
        return end[:4] + _unit(*end[4:]) if drive.turns else end

    # ---- walls and seams ----

    def _beyond(self, at):
        x0, y0, x1, y1 = self._extent
        return at[0] < x0 or at[0] > x1 or at[1] < y0 or at[1] > y1

    def _touched(self, x, y):
        x0, y0, x1, y1 = self._extent
        return (x >= x1) - (x <= x0), (y >= y1) - (y <= y0)

    def _leant_on(self, at):
        """The walls it touches without a velocity along their normals."""
        if self._wraps or self._opens:
            return NO_WALLS
        x, y = self._touched(at[0], at[1])
        return 0 if at[2] else x, 0 if at[3] else y

    def _at_wall(self, at, drive, walls, h):
        """Where the step meets a wall, with the velocity as the wall throws it back, the heading likewise; and when. Who
        comes slowly keeps no velocity into the wall."""
        (x, y, vx, vy, hx, hy), h = self._reached(at, drive, walls, h)
        ground, touched = self._sample(x, y), self._touched(x, y)
        slow = max(touched[0] * vx, touched[1] * vy) < SLOWEST_BOUNCE
        heading = bounced(ground, touched, (hx, hy), self._bounce)
        return ((x, y) + bounced(ground, touched, (vx, vy), 0.0 if slow else self._bounce) +
                (_unit(*heading) if heading != (0, 0) else (hx, hy))), h

    def _reached(self, at, drive, walls, h):
        """The end of a step that the map's edge ends, and when."""
        h = _first(lambda t: self._beyond(self._runge_kutta(at, drive, walls, t)), h)
        end = self._runge_kutta(at, drive, walls, h)
        x0, y0, x1, y1 = self._extent
        return (min(max(end[0], x0), x1), min(max(end[1], y0), y1)) + end[2:], h

    def _lets_out(self, at, a):
        """Whether an open edge ends a motion there that an acceleration draws on."""
        x, y = self._touched(at[0], at[1]) if self._opens else NO_WALLS
        return x * (at[2] or a[0]) > 0 or y * (at[3] or a[1]) > 0

    def _left(self, body, at, drive):
        """It stands at an open edge for the rest of the tick."""
        heading = at[4:] if drive.turns else _unit(*at[2:4]) if at[2] or at[3] else None
        return self._moved(body._replace(phase=MOVING), at[:2] + (0.0, 0.0), heading)

    def _moved(self, body, end, heading=None):
        """heading: where it has one of its own; left out: the velocity's direction."""
        x, y, vx, vy = end
        if self._wraps:
            x0, y0, x1, y1 = self._extent
            if not (x0 <= x < x1 and y0 <= y < y1):
                x, y = _carried(x, x0, x1), _carried(y, y0, y1)
        if not heading:
            heading = _unit(vx, vy) if vx or vy else (body.heading_x, body.heading_y)
        return body._replace(x=x, y=y, vx=vx, vy=vy, heading_x=heading[0], heading_y=heading[1])

    # ---- in the air ----

    def _fly(self, body, left):
        """A piece of the flight: a parabola, up to the ground or a wall."""
        h = min(left, self._longest)
        if self._ends_flight(body, h):
            h = _first(lambda t: self._ends_flight(body, t), h)
        end, x_out, y_out = self._in_air(body, h)
        if self._opens and (x_out or y_out):  # it falls from there
            return self._moved(end._replace(flight_vz=0.0), (end.x, end.y, 0.0, 0.0), _unit(end.vx, end.vy)), left
        vx, vy = end.vx * (-self._bounce if x_out else 1), end.vy * (-self._bounce if y_out else 1)
        _, zx, zy, _, _, _ = self._sample(end.x, end.y)
        if self._is_down(end):  # the velocity along the normal is lost
            along_normal = (end.flight_vz - zx * vx - zy * vy) / (1 + zx * zx + zy * zy)
            vx, vy = vx + along_normal * zx, vy + along_normal * zy
            end = end._replace(phase=MOVING, flight_z=0.0, flight_vz=0.0)
        return self._moved(end, (end.x, end.y, vx, vy)), max(h, SHORTEST_S)

    def _in_air(self, body, h):
        x, y = body.x + h * body.vx, body.y + h * body.vy
        x0, y0, x1, y1 = self._extent
        x_out, y_out = not self._wraps and not x0 <= x <= x1, not self._wraps and not y0 <= y <= y1
        x, y = (min(max(x, x0), x1) if x_out else x), (min(max(y, y0), y1) if y_out else y)
        rises = h * body.flight_vz - 0.5 * self._gravity * h * h
        return body._replace(x=x, y=y, flight_z=body.flight_z + rises,
                             flight_vz=body.flight_vz - self._gravity * h), x_out, y_out

    def _ends_flight(self, body, h):
        end, x_out, y_out = self._in_air(body, h)
        return x_out or y_out or self._is_down(end)

    def _is_down(self, body):
        # Who has just taken off is at the ground, to rounding.
        return body.flight_z - self._sample(body.x, body.y)[0] < -1e-9


def _first(happens, h):
    """The moment in [0, h] from which on it happens, that does so at h."""
    low = 0.0
    for _ in range(40):
        middle = 0.5 * (low + h)
        low, h = (low, middle) if happens(middle) else (middle, h)
    return h


def _moved_on(at, rates, h):
    x, y, vx, vy, hx, hy = at
    dx, dy, ax, ay, rx, ry = rates
    return x + h * dx, y + h * dy, vx + h * ax, vy + h * ay, hx + h * rx, hy + h * ry


def _carried(p, low, high):
    """Home by whole periods; rounding can put what lies a hair beside a seam on its other side."""
    p -= floor((p - low) / (high - low)) * (high - low)
    return p if low <= p < high else low


def _unit(ux, uy):
    size = hypot(ux, uy)
    return ux / size, uy / size


def _in_space(ground, ux, uy):
    """The length of the tangent over (ux, uy)."""
    return hypot(ux, uy, ground[1] * ux + ground[2] * uy)


def _bend(ground, vx, vy):
    return (ground[3] * vx + 2 * ground[4] * vy) * vx + ground[5] * vy * vy
