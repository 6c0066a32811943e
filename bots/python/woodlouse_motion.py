"""The motion of a louse, computed beside the server: docs/physics.md's exact equations by Runge and Kutta's method.

From an exact state - the `you` of an ack, or a row of all columns in exact format - `Motion.after` tells where the louse
will be if its thrust stays as it is. Units: m, m/s, ticks. What it takes is some 10 ms of processor time for half a second
of motion; how far it errs is tested against a server (test_predict.py). Two things it knows but roughly: a louse at walls,
and one that grazes a crest of a unilateral map - whether it hops there hangs on the server's own steps, and half a second
later it may be two centimetres elsewhere.
"""

import collections
from math import floor, hypot, sqrt

LONGEST_S = 1 / 240  # of a step
SHORTEST_S = 1 / 8192  # slower than this resolves, a louse stands
CORE_RADIUS = 1e-3  # [m]: nearer to the origin central gravity grows linearly, as on the server
MOVING, RESTING, FLYING = 0, 1, 2  # phase
ALONG_HEADING, MAP_VECTOR = 1, 2  # thrust_kind
HELD = 4294967295  # ticks_left of a thrust that holds until the next one

Body = collections.namedtuple("Body", "tick x y vx vy heading_x heading_y tx ty thrust_kind ticks_left phase flight_z "
                                      "flight_vz")
Body.__doc__ = "A louse's state at `tick`; the fields are those of docs/protocol.md's columns in exact format."


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
        self._full, self._bounce, self._central = (physics["thrust_max"], physics["edge_restitution"],
                                                   physics["central_gravity"])
        self._wraps, self._flies = physics["edges"] == "wrap", physics["contact"] == "unilateral"
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
        at = (body.x, body.y, body.vx, body.vy)
        ground = self._sample(body.x, body.y)
        along, push = self._drive(body)
        speed, resistance = _in_space(ground, body.vx, body.vy), self._resistance(ground, at, along)
        h = min(left, self._longest)
        while h > SHORTEST_S and self._too_long(ground, at, speed, resistance, h):
            h *= 0.5
        if speed <= resistance * min(h, SHORTEST_S):  # friction or a brake ends what is left, or it stands already
            pull = self._pull_at_rest(ground, body, along, push)
            if _in_space(ground, *pull) <= self._resistance(ground, at[:2] + (0.0, 0.0), along):
                return body._replace(vx=0.0, vy=0.0, phase=RESTING), left
            at = at[:2] + (1e-6 * pull[0], 1e-6 * pull[1])  # off it goes: the speed of a microsecond
        end = self._runge_kutta(at, along, push, h)
        if not self._wraps and self._beyond(end):
            end, h = self._at_wall(at, along, push, h)
        if self._flies and self._lifts_off(end):
            h = _first(lambda t: self._lifts_off(self._runge_kutta(at, along, push, t)), h)
            end = self._runge_kutta(at, along, push, h)
            ground = self._sample(end[0], end[1])
            climb = ground[1] * end[2] + ground[2] * end[3]
            body = body._replace(phase=FLYING, flight_z=ground[0], flight_vz=climb)
        else:
            body = body._replace(phase=MOVING)
        return self._moved(body, end), h

    def _drive(self, body):
        """The thrust: along the velocity [m/s^2], and (direction over the map, along its tangent [m/s^2]) or None."""
        if body.thrust_kind == ALONG_HEADING:
            return body.tx * self._full, None
        size = hypot(body.tx, body.ty)
        return 0.0, ((body.tx, body.ty), size * self._full) if body.thrust_kind == MAP_VECTOR and size else None

    def _acceleration(self, x, y, vx, vy, along, push):
        ground = self._sample(x, y)
        _, zx, zy, _, _, _ = ground
        load = self._load(ground, x, y, vx, vy)
        share = load / (1 + zx * zx + zy * zy)
        resistance = self._drag
        speed = _in_space(ground, vx, vy)
        if speed > 0:
            resistance += (self._friction * abs(load) / sqrt(1 + zx * zx + zy * zy) - along) / speed
        ax, ay = -share * zx - resistance * vx, -share * zy - resistance * vy
        if self._central:
            pull = self._central_pull(x, y)
            ax, ay = ax - pull * x, ay - pull * y
        if push:
            direction, f = push
            f /= _in_space(ground, *direction)
            ax, ay = ax + f * direction[0], ay + f * direction[1]
        return ax, ay

    def _load(self, ground, x, y, vx, vy):
        """The normal force times sqrt(1 + slope^2) [m/s^2]."""
        load = self._gravity + _bend(ground, vx, vy)
        return load - self._central_pull(x, y) * (ground[1] * x + ground[2] * y) if self._central else load

    def _central_pull(self, x, y):
        r2 = max(x * x + y * y, CORE_RADIUS * CORE_RADIUS)
        return self._central / (r2 * sqrt(r2))

    def _resistance(self, ground, at, along):
        """What friction and a brake hold against [m/s^2]."""
        load = abs(self._load(ground, *at))
        return self._friction * load / sqrt(1 + ground[1] ** 2 + ground[2] ** 2) + max(0.0, -along)

    def _pull_at_rest(self, ground, body, along, push):
        heading = ((body.heading_x, body.heading_y), along) if along > 0 else push
        return self._acceleration(body.x, body.y, 0.0, 0.0, 0.0, heading)

    def _too_long(self, ground, at, speed, resistance, h):
        bend = hypot(ground[3], ground[5], ground[4] * 1.5)
        swing = self._gravity * bend + (self._central_pull(at[0], at[1]) if self._central else 0.0)
        return (h * h * swing > 0.0025 or h * speed * bend > 0.1 or h * self._drag > 0.25 or
                h * resistance > 0.25 * speed > 0)

    def _lifts_off(self, at):
        return self._gravity + _bend(self._sample(at[0], at[1]), at[2], at[3]) < 0

    def _runge_kutta(self, at, along, push, h):
        x, y, vx, vy = at
        ax, ay = self._acceleration(x, y, vx, vy, along, push)
        half = 0.5 * h
        ux, uy = vx + half * ax, vy + half * ay
        bx, by = self._acceleration(x + half * vx, y + half * vy, ux, uy, along, push)
        wx, wy = vx + half * bx, vy + half * by
        cx, cy = self._acceleration(x + half * ux, y + half * uy, wx, wy, along, push)
        qx, qy = vx + h * cx, vy + h * cy
        dx, dy = self._acceleration(x + h * wx, y + h * wy, qx, qy, along, push)
        return (x + h / 6 * (vx + 2 * ux + 2 * wx + qx), y + h / 6 * (vy + 2 * uy + 2 * wy + qy),
                vx + h / 6 * (ax + 2 * bx + 2 * cx + dx), vy + h / 6 * (ay + 2 * by + 2 * cy + dy))

    # ---- walls and seams ----

    def _beyond(self, at):
        x0, y0, x1, y1 = self._extent
        return at[0] < x0 or at[0] > x1 or at[1] < y0 or at[1] > y1

    def _at_wall(self, at, along, push, h):
        """Where the step meets a wall, the velocity as the wall leaves it; and when. Who leans on a wall slides along it
        for the whole step, as if there were no corner."""
        x0, y0, x1, y1 = self._extent
        if x0 < at[0] < x1 and y0 < at[1] < y1:
            h = _first(lambda t: self._beyond(self._runge_kutta(at, along, push, t)), h)
        x, y, vx, vy = self._runge_kutta(at, along, push, h)
        _, zx, zy, _, _, _ = self._sample(x, y)
        if x < x0 or x > x1:
            vx, vy = vx - self._hit(vx), vy + self._hit(vx) * zx * zy / (1 + zy * zy)
        if y < y0 or y > y1:
            vx, vy = vx + self._hit(vy) * zx * zy / (1 + zx * zx), vy - self._hit(vy)
        return (min(max(x, x0), x1), min(max(y, y0), y1), vx, vy), max(h, SHORTEST_S)

    def _hit(self, speed):
        return speed * (1 + self._bounce if abs(speed) > 0.05 else 1.0)

    def _moved(self, body, end):
        x, y, vx, vy = end
        if self._wraps:
            x0, y0, x1, y1 = self._extent
            x, y = x - floor((x - x0) / (x1 - x0)) * (x1 - x0), y - floor((y - y0) / (y1 - y0)) * (y1 - y0)
        speed = hypot(vx, vy)
        if speed > 0:
            body = body._replace(heading_x=vx / speed, heading_y=vy / speed)
        return body._replace(x=x, y=y, vx=vx, vy=vy)

    # ---- in the air ----

    def _fly(self, body, left):
        """A piece of the flight: a parabola, up to the ground or a wall."""
        h = min(left, self._longest)
        if self._ends_flight(body, h):
            h = _first(lambda t: self._ends_flight(body, t), h)
        end, x_out, y_out = self._in_air(body, h)
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


def _in_space(ground, ux, uy):
    """The length of the tangent over (ux, uy)."""
    return hypot(ux, uy, ground[1] * ux + ground[2] * uy)


def _bend(ground, vx, vy):
    return (ground[3] * vx + 2 * ground[4] * vy) * vx + ground[5] * vy * vy
