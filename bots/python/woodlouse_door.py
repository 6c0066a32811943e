"""The way into a room, and back into it when the connection breaks or the room moves to another server."""

import random
import time

from woodlouse_lines import SILENCE_S, WoodlouseError, is_this_machine, open_lines, told_address

COMES_BACK_S = 60.0  # longer than a server that is left as it is keeps the louse: another one takes the room over
FIRST_WAIT_S, LONGEST_WAIT_S = 0.05, 2.0  # from one attempt to the next
PATIENCE_S = 5.0  # with a server at an attempt to come back
SETTLED_S = 5.0  # so long after a welcome what comes is no longer running
MOST_MOVES = 2  # running; who is sent on once more has lost the connection
MOST_HOSTS = 16
_PASSING = {"connection", "idle", "slow", "left", "rate_limited", "too_many_connections", "handshake_timeout", "moved"}
_OF_ONE_SERVER = {"unknown_room", "room_full", "shutdown", "draining", "bad_token", "protocol"}


class Whereabouts:
    """Where a room is joined, and where it is looked for next. place: HOST:PORT of the one that is joined or tried."""

    def __init__(self, asked):
        self.asked = self.place = asked
        self._places = [asked]
        self._moves = self._waits = 0  # running
        self._joined_at = None

    def has_others(self):
        return len(self._places) > 1

    def is_joined(self):
        return self._joined_at is not None

    def welcomed(self, hosts):
        """It is joined at place; hosts: of the hello there."""
        self.named(hosts)
        self._joined_at = time.monotonic()

    def named(self, hosts):
        """hosts: as the server names them where it is joined."""
        told = [host for host in map(told_address, hosts[:MOST_HOSTS] if isinstance(hosts, list) else ()) if host]
        self._places = list(dict.fromkeys([self.place, *told]))

    def moved(self, error):
        """Whether place is another one now, to be tried at once. Else the error says why not."""
        self._settle()
        address = told_address(error.address)
        if address and self._moves < MOST_MOVES:
            self._moves += 1
            self.place, self._joined_at = address, None
            if address not in self._places:
                self._places = [address, *self._places][:MOST_HOSTS + MOST_MOVES]
            return True
        if address:
            error.text = "sent on from server to server, to %s last" % address
        elif error.address:
            error.text = "the room has moved to %r, which is no HOST:PORT" % str(error.address)[:80]
        error.args = ("%s: %s" % (error.code, error.text),)
        return False

    def lost(self):
        """The line was lost, or an attempt has failed. For how many seconds to wait before place is tried."""
        self._settle()
        if self._joined_at is None and self.place in self._places:
            self.place = self._places[(self._places.index(self.place) + 1) % len(self._places)]
        self._joined_at, self._moves = None, 0
        wait = min(LONGEST_WAIT_S, FIRST_WAIT_S * 2 ** min(self._waits, 10))
        self._waits += 1
        return wait * random.uniform(0.5, 1.5)

    def _settle(self):
        if self._joined_at is not None and time.monotonic() - self._joined_at >= SETTLED_S:
            self._moves = self._waits = 0


class Door:
    """Joins, and joins again. resumes: the louse is to wait when the connection breaks, and is asked for then. fields: asked
    for instead of the join's own where the server has rules of play; None: nothing instead."""

    def __init__(self, address, join, resumes, fields=None):
        self._places = Whereabouts(address)
        self._join = dict(join)
        self._resumes = resumes
        self._fields = fields
        if resumes and join["role"] != "spectator":
            self._join["resume"] = True

    @property
    def address(self):
        """HOST:PORT of the server that was joined last."""
        return self._places.place

    def enter(self):
        """(lines, hello, welcome). Waits where the server says that too many join just now, and goes where it says that the
        room is. Raises WoodlouseError."""
        return self._try(lambda error: error.code == "rate_limited", SILENCE_S)

    def named(self, hosts):
        """Where the room may be found, as the server says while it is joined."""
        self._places.named(hosts)

    def look(self, view):
        """What a join to come asks to be shown."""
        self._join["view"] = view

    def brings_back(self, error):
        """Whether who was stopped by this error may come back."""
        return self._resumes and error.code in _PASSING

    def come_back(self, error):
        """The same as enter(), after what ended the connection: at once where the room has moved; else where it was and at
        the hosts that were named there in turn, soon, then later and later, for COMES_BACK_S. Raises WoodlouseError."""
        wait = 0.0 if error.code == "moved" and self._places.moved(error) else self._places.lost()
        time.sleep(max(wait, error.retry_after_s))
        return self._try(self._passes_on_the_way_back, PATIENCE_S)

    def _passes_on_the_way_back(self, error):
        return self.brings_back(error) or (self._places.has_others() and error.code in _OF_ONE_SERVER)

    def _try(self, passes, patience_s):
        until = time.monotonic() + COMES_BACK_S
        while True:
            try:
                return self._join_once(patience_s)
            except WoodlouseError as error:
                if error.code == "moved" and self._places.moved(error):
                    continue
                wait = max(self._places.lost(), error.retry_after_s)
                if not passes(error) or time.monotonic() + wait > until:
                    raise
            time.sleep(wait)

    def _join_once(self, patience_s):
        place = self._places.place
        lines = open_lines(place)
        try:
            lines.wait_at_most(patience_s)
            hello = lines.message()
            raise_refusal(hello)
            if hello["type"] != "hello":
                raise WoodlouseError("protocol", "this is no woodlouse server: it began with %r" % hello["type"])
            lines.send(self._join_for(place, hello))
            while True:
                message = lines.message()
                raise_refusal(message)
                if message["type"] == "ping" and isinstance(message.get("hosts"), list):
                    hello["hosts"] = message["hosts"]
                if message["type"] == "welcome":
                    self._on_welcome(hello, message)
                    lines.wait_at_most(SILENCE_S)
                    return lines, hello, message
        except BaseException:
            lines.close()
            raise

    def _join_for(self, place, hello):
        join = dict(self._join)
        if self._fields is not None and "rules" in hello.get("features", ()):
            join["fields"] = self._fields
        if place != self._places.asked and not is_this_machine(place):
            join.pop("token", None)  # a password is for the server that was asked for: to another it would go as plain text
        return join

    def _on_welcome(self, hello, welcome):
        self._places.welcomed(hello.get("hosts"))
        if welcome.get("resume_token"):
            self._join["resume"] = welcome["resume_token"]
        if welcome.get("room"):
            self._join["room"] = welcome["room"]  # the first one of another server may be another


def raise_refusal(message):
    """WoodlouseError, where it is an error or a bye."""
    if message["type"] in ("error", "bye"):
        raise WoodlouseError(message.get("code", "error"), message.get("text", ""), message.get("retry_after_ms", 0) / 1000,
                             message.get("address", ""))
