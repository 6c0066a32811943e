"""The proof that a key is what the server's state is (docs/determinism.md): a louse's fields, and the hash of a tick."""

import struct

ALL_FIELDS = ["id", "phase", "x", "y", "vx", "vy", "heading_x", "heading_y", "tx", "ty", "flight_z", "flight_vz",
              "distance", "thrust_kind", "ticks_left"]
_LOUSE = struct.Struct("<II11dII")  # a louse's hashed record: ALL_FIELDS in this order
_BLOCK = 64  # lice that are hashed together
_64_BITS = (1 << 64) - 1


def state_hash(key):
    """The hash of a key, as docs/determinism.md lays it out. key: the message, or a recording's keyframe with its
    lice as `louse`; its rows are of all lice by ascending id, each ALL_FIELDS."""
    previous, inputs, roster, rules, generator = (
        int(key[name], 16) for name in ("previous", "inputs", "roster", "rules", "generator"))
    rows = [_LOUSE.pack(*row) for row in key["louse"]]
    if not (rows or previous or inputs or roster or rules or key["link"]):
        return 0  # no step has done anything
    blocks = [xxh64(b"".join(rows[first:first + _BLOCK])) for first in range(0, len(rows), _BLOCK)]
    return xxh64(struct.pack("<%dQ" % (6 + len(blocks)), previous, inputs, roster, rules, key["link"], generator,
                             *blocks))


def xxh64(data):
    """XXH64 with seed 0 of bytes."""
    p1, p2, p3, p4, p5 = (0x9E3779B185EBCA87, 0xC2B2AE3D27D4EB4F, 0x165667B19E3779F9, 0x85EBCA77C2B2AE63,
                          0x27D4EB2F165667C5)

    def rotated(value, bits):
        return (value << bits | value >> 64 - bits) & _64_BITS

    def lane(accumulator, word):
        return rotated((accumulator + word * p2) & _64_BITS, 31) * p1 & _64_BITS

    whole = len(data) & ~31  # stripes of 32 bytes, a word for each of four accumulators
    if whole:
        a, b, c, d = (p1 + p2) & _64_BITS, p2, 0, -p1 & _64_BITS
        for w, x, y, z in struct.iter_unpack("<4Q", data[:whole]):
            a, b, c, d = lane(a, w), lane(b, x), lane(c, y), lane(d, z)
        value = rotated(a, 1) + rotated(b, 7) + rotated(c, 12) + rotated(d, 18) & _64_BITS
        for accumulator in (a, b, c, d):
            value = ((value ^ lane(0, accumulator)) * p1 + p4) & _64_BITS
    else:
        value = p5
    value = value + len(data) & _64_BITS
    rest = data[whole:]
    for (word,) in struct.iter_unpack("<Q", rest[:len(rest) & ~7]):
        value = (rotated(value ^ lane(0, word), 27) * p1 + p4) & _64_BITS
    rest = rest[len(rest) & ~7:]
    if len(rest) >= 4:
        value = (rotated(value ^ int.from_bytes(rest[:4], "little") * p1 & _64_BITS, 23) * p2 + p3) & _64_BITS
        rest = rest[4:]
    for byte in rest:
        value = rotated(value ^ byte * p5 & _64_BITS, 11) * p1 & _64_BITS
    value = (value ^ value >> 33) * p2 & _64_BITS
    value = (value ^ value >> 29) * p3 & _64_BITS
    return value ^ value >> 32
