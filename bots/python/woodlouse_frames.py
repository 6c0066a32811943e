"""What a connection's keys and deltas say: the rows of all lice, in units, how they stand, and what is played."""

import collections

from woodlouse_rules import Standing, merged, round_of

Frame = collections.namedtuple("Frame", "lice standings round")
Frame.__doc__ = """lice: {id: row}. standings: {id: Standing}; {} where the columns are not there. round: a Round; None where
nothing is played."""


class Frames:
    """Of one session: its columns, and the key that its deltas refer to. shown: those that a row has an attribute for, in
    this order."""

    def __init__(self, fields, quanta, shown):
        self._make = collections.namedtuple("Louse", shown)._make
        quanta = [1 if quantum == 1 else quantum for quantum in quanta]
        self._shown = [(i, quanta[i]) for i in map(fields.index, shown)]
        self._standing = [fields.index(field) for field in Standing._fields if field in fields]
        self._has_standing = len(self._standing) == len(Standing._fields)
        self._id = fields.index("id")
        self._tick = None  # of the key
        self._key, self._game = Frame({}, {}, None), None

    def key(self, message):
        """The Frame."""
        lice, standings = self._rows(message)
        game = message.get("game")
        self._tick, self._game = message["tick"], game
        self._key = Frame(lice, standings, None if game is None else round_of(game))
        return self._key

    def delta(self, message):
        """The Frame; None where its key is not here."""
        if self._tick is None or self._tick != message["base"]:
            return None
        lice, standings = dict(self._key.lice), dict(self._key.standings)
        for louse in message.get("gone", ()):
            lice.pop(louse, None)
            standings.pop(louse, None)
        for mine, news in zip((lice, standings), self._rows(message)):
            mine.update(news)
        if "game" not in message:
            return Frame(lice, standings, self._key.round)
        return Frame(lice, standings, round_of(merged(self._game or {}, message["game"])))

    def _rows(self, message):
        rows = message["louse"]
        lice = {values[self._id]: self._make([values[i] * quantum for i, quantum in self._shown]) for values in rows}
        if not self._has_standing:
            return lice, {}
        return lice, {values[self._id]: Standing._make([values[i] for i in self._standing]) for values in rows}
