"""A joined connection that comes back when it breaks; the base of woodlouse.Game."""

import collections

from woodlouse_lines import WoodlouseError


class Session:
    """Takes messages from the lines that a Door opens, and opens again: each goes to the method _on_TYPE of who inherits, if
    there is one. Who inherits has room, on_lost(error) and on_comeback(), too."""

    def __init__(self, door):
        self._door = door
        self.comebacks = 0
        self.bye = None
        self._recorded = collections.deque()
        self._told = None  # the address, before the connection broke

    @property
    def address(self):
        """HOST:PORT of the server: a room may move to another one."""
        return self._door.address

    def whereabouts(self):
        """Where the room is, in words, behind others; empty where it was there before the connection broke."""
        room = "".join(letter for letter in self.room if letter.isprintable())
        return "" if self.address == self._told else "; room %s is at %s now" % (room, self.address)

    def recorded(self):
        """Of who watches by inputs: yields the lines of the room's recording as they come, text without newlines: a header,
        a keyframe, then every step; a further keyframe where some steps did not come or resync() asked for it, a further
        header where another game or connection begins. Each keyframe with its header begins a recording: save_stream.py.
        Raises WoodlouseError "no_stream" where the server shows frames alone."""
        while self.bye is None:
            while self._recorded:
                yield self._recorded.popleft()
            if not self._lines.has_recording:
                raise WoodlouseError("no_stream", "the server shows frames alone")
            self._receive()
        yield from self._recorded

    def resync(self):
        """Asks for the newest key; of who watches by inputs, for a new keyframe."""
        self._send({"type": "resync"})

    def close(self):
        """Leaves; the louse goes with you."""
        try:
            if self.bye is None:
                self._lines.send({"type": "leave"})
        except WoodlouseError:
            pass  # it is gone already, and so are we
        self._lines.close()

    def _begin(self, lines, hello, welcome):
        self._lines, self.hello = lines, hello
        try:
            self._take(welcome)
        except BaseException:
            lines.close()
            raise

    def _come_back(self, error):
        self._lines.close()
        self._told = self.address
        self.on_lost(error)
        self._begin(*self._door.come_back(error))
        self.comebacks += 1
        self.on_comeback()

    def _send(self, message):
        try:
            self._lines.send(message)
        except WoodlouseError as error:  # it is dropped; whoever looks for the next state comes back
            if not self._door.brings_back(error):
                raise

    def _ask(self, question, done):
        """Asks once on each connection."""
        asked = None
        while not done():
            if self.bye is not None:
                raise WoodlouseError(self.bye.get("code", "bye"), self.bye.get("text", ""))
            if asked != self.comebacks:
                asked = self.comebacks
                self._send(question)
            self._receive()

    def _receive(self):
        try:
            self._take(self._lines.message())
        except WoodlouseError as error:
            if self.bye is not None or not self._door.brings_back(error):
                raise
            self._come_back(error)

    def _take(self, message):
        handler = getattr(self, "_on_" + str(message["type"]), None)
        try:
            if handler:  # types of later versions are passed over
                handler(message)
        except (KeyError, TypeError, ValueError, IndexError) as error:
            raise WoodlouseError("protocol", "a %s out of shape (%s)" % (message["type"], error)) from None

    def _on_recorded(self, message):
        self._recorded.append(message["line"])

    def _on_ping(self, message):
        self._send({"type": "pong", "t": message["t"]})
        if isinstance(message.get("hosts"), list):
            self._door.named(message["hosts"])

    def _on_bye(self, message):
        unasked = WoodlouseError(message["code"], message["text"], address=message.get("address", ""))
        # left: something between us and the server ended our side; who leaves does not listen any more.
        if message["code"] in ("left", "moved") and self._door.brings_back(unasked):
            raise unasked
        self.bye = message
