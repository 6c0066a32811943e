#!/usr/bin/env python3
"""Writes the seeds of the fuzz target physics into corpus/physics: games that reach what a tick can meet.

    tests/fuzz/physics_seeds.py

The bytes' order is told in physics_game.h.
"""
import pathlib
import random

FUNCTION, FUNCTION_SPLINE, SPLINE, NATURAL_SPLINE, PLANE = range(5)
STANDARD, CHEAP, PRECISE = range(3)
UNILATERAL, WRAP, CENTRAL, DEFAULT_CORE, OPEN, TOLERANCE = 1, 2, 4, 8, 16, 32
WAVES, PARABOLIC_POT, WAVY_POT, VOLCANO, HILLS = range(5)
HELD = 255


def number(value):
    """The nearest that a byte's mantissa and a byte's exponent give."""
    if value == 0:
        return bytes((0, 0))
    exponent = 0
    while exponent < 39 and round(value * 2.0 ** (27 - exponent)) > 255:
        exponent += 1
    return bytes((exponent, min(255, round(value * 2.0 ** (27 - exponent)))))


def signed(value):
    return bytes((value & 255,))


def map_of(ground, method=STANDARD, bits=0, hz=60, gravity=9.81, drag=0.0, friction=0.0, thrust_max=4.0,
           restitution=0.5, pull=0.0, core=0.0, tolerance=0.0, function=WAVES, grid=2, scale=20.0, columns=4, rows=4, dx=2.0,
           dy=0.0, steepness=6, heights=()):
    """The map. A height of 128 is 50 times dx, or dy where that is less, halved `steepness` times."""
    out = bytes((ground, method, bits)) + (hz - 1).to_bytes(2, "little")
    out += b"".join(map(number, (gravity, drag, friction, thrust_max))) + bytes((round(255 * restitution),))
    out += number(pull) + number(core)
    if bits & TOLERANCE:
        out += number(tolerance)
    if ground in (FUNCTION, FUNCTION_SPLINE):
        return out + bytes((function, grid - 2)) + number(scale)
    out += bytes((columns - 4, rows - 4)) + number(dx) + number(dy) + bytes((steepness,))
    if ground == PLANE:
        return out + b"".join(map(signed, () if bits & WRAP else heights or (0, 0)))
    return out + b"".join(map(signed, heights or rough(columns * rows)))


def rough(count):
    source = random.Random(count)
    return [source.randrange(-128, 128) for _ in range(count)]


def louse(x, y, direction=0, speed=0.0, heading=0):
    """x, y: 0 to 1 of the domain; direction, heading: of a turn, 0 to 1."""
    place = b"".join(round(65535 * part).to_bytes(2, "little") for part in (x, y))
    return place + bytes((round(256 * direction) % 256,)) + number(speed) + bytes((round(256 * heading) % 256,))


def vector(x, y, ticks=HELD, which=0):
    return bytes((1 + 8 * which,)) + signed(round(127 * x)) + signed(round(127 * y)) + bytes((ticks,))


def drive(value, ticks=HELD, which=0):
    return bytes((2 + 8 * which,)) + signed(round(127 * value)) + bytes((ticks,))


def comes(*args, **named):
    return bytes((4,)) + louse(*args, **named)


def goes(which=0):
    return bytes((5 + 8 * which,))


WAIT = b"\0"
NO_THRUST = b"\3"


def game(ground, lice, *deeds, ticks=24):
    """deeds: of the ticks, one after the other, WAIT between them."""
    return ground + bytes((len(lice) - 1,)) + b"".join(lice) + bytes((ticks - 1,)) + b"".join(deeds)


CROWD = [louse(0.3, 0.4, 0.1, 5.0), louse(0.6, 0.7, 0.4, 20.0), louse(0.5, 0.5, 0.7, 1.0),
         louse(0.9, 0.2, 0.6, 60.0)]
STEER = [vector(0.6, -0.3), vector(-1, 0, 5, 1), WAIT, drive(1, 9, 2), drive(-1, 9, 3), WAIT, comes(0.2, 0.8), WAIT,
         goes(2)]
STORM = [louse(0, 0, 0.6, 900.0), louse(1, 0, 0.9, 300.0), louse(0.5, 1, 0.3, 700.0), louse(0.99, 0.99, 0.12, 1000.0)]

SEEDS = {
    "standard": game(map_of(SPLINE, drag=0.2, friction=0.05), CROWD, *STEER),
    "cheap": game(map_of(SPLINE, CHEAP, drag=0.2, friction=0.05), CROWD, *STEER),
    "precise": game(map_of(NATURAL_SPLINE, PRECISE, drag=0.2, friction=0.05), CROWD, *STEER),
    "kept": game(map_of(SPLINE, thrust_max=0.0, columns=6), CROWD, ticks=32),
    "function": game(map_of(FUNCTION, function=VOLCANO, friction=0.3), CROWD, *STEER),
    "sampled": game(map_of(FUNCTION_SPLINE, PRECISE, function=WAVY_POT, grid=4), CROWD, *STEER),
    "plane": game(map_of(PLANE, friction=0.2, heights=(40, -90)), CROWD, *STEER),
    "highest_plane": game(map_of(PLANE, dx=1e5, steepness=0, heights=(127, 127)), CROWD, *STEER),
    "wrap": game(map_of(SPLINE, PRECISE, WRAP, thrust_max=8.0, rows=5), CROWD, *STEER),
    "wrapped_flight": game(map_of(FUNCTION, CHEAP, WRAP | UNILATERAL, function=WAVES), CROWD, *STEER),
    "flight": game(map_of(SPLINE, STANDARD, UNILATERAL, hz=20, gravity=3.0), CROWD, *STEER, ticks=32),
    "flown_hills": game(map_of(FUNCTION, PRECISE, UNILATERAL, hz=15, function=HILLS), CROWD, *STEER, ticks=32),
    "wall_friction": game(map_of(PLANE, friction=0.5, restitution=0.0, heights=(-120, 30)),
                          [louse(0, 0.5, 0.25, 3.0), louse(0, 0.2, 0.75, 6.0), louse(1, 0.5)],
                          vector(-1, 0.1), vector(-0.7, -0.7, 30, 1), vector(1, 1, 255, 2)),
    "curved_wall": game(map_of(SPLINE, CHEAP, friction=0.4, restitution=1.0),
                        [louse(0, 0.5, 0.25, 3.0), louse(0.4, 1, 0, 6.0)], vector(-1, 0.1), vector(0.2, 1, 255, 1)),
    "corner": game(map_of(SPLINE, hz=30, restitution=0.9),
                   [louse(0, 0), louse(0.02, 0.02, 0.63, 50.0), louse(1, 1, 0.1, 4.0)],
                   vector(-0.7, -0.7), vector(-0.7, -0.7, 255, 1), drive(1, 255, 2)),
    "central_brake": game(map_of(PLANE, bits=CENTRAL | DEFAULT_CORE, gravity=0.0, thrust_max=20.0, pull=400.0, dx=8.0),
                          [louse(0.52, 0.5, 0.25, 20.0), louse(0.9, 0.5, 0.3, 3.0)], drive(-0.2), drive(-1, 20, 1)),
    "central_pit": game(map_of(SPLINE, PRECISE, CENTRAL, hz=10, friction=0.1, pull=50.0, core=0.5), CROWD, *STEER),
    "number_from_rest": game(map_of(FUNCTION, function=PARABOLIC_POT, friction=0.1),
                             [louse(0.5, 0.5, heading=0.3), louse(0.7, 0.6, heading=0.9)],
                             drive(1), drive(0.2, 12, 1), WAIT, WAIT, WAIT, NO_THRUST),
    "rest": game(map_of(SPLINE, friction=9.0, steepness=9), [louse(0.4, 0.4), louse(0.6, 0.4, 0.5, 2.0)],
                 vector(0.1, 0, 3), WAIT, WAIT, drive(-0.5, 4, 1)),
    "capped": game(map_of(SPLINE, hz=1, gravity=900.0, dx=0.0625, steepness=0), CROWD, ticks=6),
    "capped_cheap": game(map_of(SPLINE, CHEAP, hz=3, friction=2.0, dx=0.001, steepness=1), CROWD, *STEER, ticks=6),
    "bounce_storm": game(map_of(PLANE, hz=1, restitution=1.0, dx=0.01, heights=(100, 70)), STORM, ticks=8),
    "open": game(map_of(SPLINE, bits=OPEN, hz=20, friction=0.1, thrust_max=8.0), CROWD, *STEER, ticks=32),
    "open_flight": game(map_of(FUNCTION, CHEAP, OPEN | UNILATERAL, hz=15, function=HILLS), CROWD, *STEER, ticks=32),
    "open_storm": game(map_of(SPLINE, PRECISE, OPEN | UNILATERAL, hz=2, dx=0.05, steepness=2), STORM, ticks=8),
    "borne": game(map_of(SPLINE, bits=TOLERANCE, hz=15, drag=0.2, friction=0.05, tolerance=1e-4), CROWD, *STEER),
    "borne_flight": game(map_of(SPLINE, CHEAP, TOLERANCE | UNILATERAL | WRAP, gravity=3.0, tolerance=1e-3), CROWD, *STEER),
    "borne_storm": game(map_of(SPLINE, PRECISE, TOLERANCE | OPEN, hz=2, dx=0.05, steepness=2, tolerance=1e-6), STORM,
                        ticks=6),
    "thrown_storm": game(map_of(SPLINE, PRECISE, UNILATERAL, hz=2, restitution=0.99, dx=0.05, steepness=2), STORM,
                         ticks=6),
}


def main():
    folder = pathlib.Path(__file__).resolve().parent / "corpus" / "physics"
    folder.mkdir(parents=True, exist_ok=True)
    for name, seed in SEEDS.items():
        (folder / name).write_bytes(seed)


if __name__ == "__main__":
    main()
