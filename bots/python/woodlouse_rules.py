"""What is played in a room beside roaming, as its keys and deltas tell it: docs/protocol.md, "Rules of play"."""

import collections
import dataclasses
from typing import Dict, Optional, Tuple

MOMENTS_PER_TICK = 65536  # how finely rules count time
DEFAULT_FIELDS = ["x", "y", "vx", "vy"]  # beside id, of who asks for no columns

Standing = collections.namedtuple("Standing", "score gate lap lap_start best_lap")
Standing.__doc__ = """How a louse stands; 0 where a mode has none. score: points of forage, ticks for which the place was
held, of a race the best run of the round [moments]; gate: the next one, from 0; lap: of the run, from 0; lap_start: when it
began [moments], 0 where the clock does not run; best_lap: of the round [moments], 0 where there is none."""

Crumb = collections.namedtuple("Crumb", "x y value")
Crumb.__doc__ = "What lies at (x, y) [m] to be eaten, and what it is worth."


@dataclasses.dataclass(frozen=True)
class Round:
    """What is played at a tick. A mode's own members are None in the others, and crumbs are {}."""

    phase: str = "gather"  # "gather" (nobody plays), "countdown" and "podium" (lice drive, nothing counts), or "play"
    number: int = 0  # from 1
    until: int = 0  # the tick at which the phase ends
    table: Tuple[Tuple[int, int], ...] = ()  # (louse, score) of the best ten, first first
    crumbs: Dict[int, Crumb] = dataclasses.field(default_factory=dict)  # forage: those that lie there, by slot
    place: Optional[int] = None  # hill: which of game.rules["places"] counts
    holder: Optional[int] = None  # hill: the louse that holds it; 0: nobody
    contested: Optional[bool] = None  # hill: whether several are on it
    moves_at: Optional[int] = None  # hill: the tick at which the next place counts


def round_of(shown):
    """The Round of a key's `game`, or of a merged one. Members of later versions are passed over. Raises TypeError or
    ValueError where it is none."""
    if not isinstance(shown, dict):
        raise TypeError("game is no object")
    return Round(phase=shown.get("phase", "gather"), number=shown.get("round", 0), until=shown.get("until", 0),
                 table=tuple((louse, score) for louse, score in shown.get("table", ())),
                 crumbs={slot: Crumb(x, y, value) for slot, x, y, value in shown.get("crumbs", ()) if value},
                 place=shown.get("place"), holder=shown.get("holder"), contested=shown.get("contested"),
                 moves_at=shown.get("moves_at"))


def merged(of_key, of_delta):
    """A key's `game` with what a delta to it says: members that are otherwise, of the crumbs those slots alone."""
    shown = dict(of_key, **of_delta)
    if "crumbs" in of_delta and "crumbs" in of_key:
        by_slot = {crumb[0]: crumb for crumb in of_key["crumbs"]}
        by_slot.update((crumb[0], crumb) for crumb in of_delta["crumbs"])
        shown["crumbs"] = list(by_slot.values())
    return shown


def with_standing(fields):
    """The columns to ask for where the server has rules; None where those that are wanted can't be added to."""
    if fields is None:
        fields = DEFAULT_FIELDS
    if not isinstance(fields, (list, tuple)):
        return None  # "all" is a louse's hashed record, and no more
    return list(fields) + [column for column in Standing._fields if column not in fields]
