"""The way into a room, and back into it when the connection breaks."""

import time

from woodlouse_lines import SILENCE_S, WoodlouseError, open_lines

COMES_BACK_S = 30.0  # for so long a server that is left as it is keeps the louse
ATTEMPT_S = 1.0  # from one attempt to the next
PATIENCE_S = 5.0  # with a server at an attempt to come back
_PASSING = {"connection", "idle", "slow", "left", "rate_limited", "too_many_connections", "handshake_timeout"}


class Door:
    """Joins, and joins again. resumes: the louse is to wait when the connection breaks, and is asked for then. fields: asked
    for instead of the join's own where the server has rules of play; None: nothing instead."""

    def __init__(self, address, join, resumes, fields=None):
        self._address = address
        self._join = dict(join)
        self._resumes = resumes
        self._fields = fields
        if resumes and join["role"] != "spectator":
            self._join["resume"] = True

    def enter(self):
        """(lines, hello, welcome). Waits where the server says that too many join just now. Raises WoodlouseError."""
        return self._try(lambda error: error.code == "rate_limited", SILENCE_S)

    def look(self, view):
        """What a join to come asks to be shown."""
        self._join["view"] = view

    def brings_back(self, error):
        """Whether who was stopped by this error may come back."""
        return self._resumes and error.code in _PASSING

    def come_back(self):
        """The same as enter(), at once and then once a second for COMES_BACK_S. Raises WoodlouseError."""
        return self._try(self.brings_back, PATIENCE_S)

    def _try(self, passes, patience_s):
        until = time.monotonic() + COMES_BACK_S
        while True:
            again = time.monotonic() + ATTEMPT_S
            try:
                return self._join_once(patience_s)
            except WoodlouseError as error:
                again = max(again, time.monotonic() + error.retry_after_s)
                if not passes(error) or again > until:
                    raise
            time.sleep(max(0.0, again - time.monotonic()))

    def _join_once(self, patience_s):
        lines = open_lines(self._address)
        try:
            lines.wait_at_most(patience_s)
            hello = lines.message()
            _raise_refusal(hello)
            if hello["type"] != "hello":
                raise WoodlouseError("protocol", "this is no woodlouse server: it began with %r" % hello["type"])
            has_rules = self._fields is not None and "rules" in hello.get("features", ())
            lines.send(dict(self._join, fields=self._fields) if has_rules else self._join)
            while True:
                message = lines.message()
                _raise_refusal(message)
                if message["type"] == "welcome":
                    if message.get("resume_token"):
                        self._join["resume"] = message["resume_token"]
                    lines.wait_at_most(SILENCE_S)
                    return lines, hello, message
        except BaseException:
            lines.close()
            raise


def _raise_refusal(message):
    if message["type"] in ("error", "bye"):
        raise WoodlouseError(message.get("code", "error"), message.get("text", ""), message.get("retry_after_ms", 0) / 1000)
