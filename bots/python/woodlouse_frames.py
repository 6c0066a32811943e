"""What a connection's keys and deltas say: the rows of all lice, in units."""

import collections


class Frames:
    """Of one session: its columns, and the key that its deltas refer to. A row has an attribute for each column."""

    def __init__(self, fields, quanta):
        self._make = collections.namedtuple("Louse", fields)._make
        self._quanta = [1 if quantum == 1 else quantum for quantum in quanta]
        self._tick = None  # of the key
        self._lice = {}

    def key(self, message):
        """{id: row}."""
        self._tick, self._lice = message["tick"], self._rows(message)
        return self._lice

    def delta(self, message):
        """{id: row}; None where its key is not here."""
        if self._tick is None or self._tick != message["base"]:
            return None
        lice = dict(self._lice)
        for louse in message.get("gone", ()):
            lice.pop(louse, None)
        lice.update(self._rows(message))
        return lice

    def _rows(self, message):
        rows = (self._make([value * quantum for value, quantum in zip(values, self._quanta)])
                for values in message["louse"])
        return {louse.id: louse for louse in rows}
