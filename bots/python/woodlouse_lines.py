"""A connection's JSON lines, and what may go wrong with them."""

import ipaddress
import json
import re
import select
import socket

DEFAULT_ADDRESS = "127.0.0.1:7777"
MAX_LINE_BYTES = 128 << 20
MAX_ADDRESS = 261  # of HOST:PORT, as a server tells it
SILENCE_S = 15.0  # a server that says nothing for so long is gone


class WoodlouseError(Exception):
    """What went wrong; `code` is the server's (docs/protocol.md), or "connection", "protocol" or "differs" (a key
    that was verified). retry_after_s: for so long it is of no use to ask again; 0 where the server did not say. address: of
    "moved", where the room is, as a stranger told it; empty where it was not told."""

    def __init__(self, code, text, retry_after_s=0.0, address=""):
        super().__init__("%s: %s" % (code, text))
        self.code = code
        self.text = text
        self.retry_after_s = retry_after_s
        self.address = address


class Lines:
    """One JSON object a line, both ways. Not thread safe."""

    def __init__(self, connection):
        self._socket = connection
        self._socket.settimeout(SILENCE_S)
        self._bytes = bytearray()
        self._searched = 0  # of _bytes, without a newline
        self.has_recording = False  # lines without a `type` may come: a recording's
        self._cut = False  # in the middle of a line to the server

    def wait_at_most(self, seconds):
        """For the next bytes, either way; SILENCE_S until told otherwise."""
        self._socket.settimeout(seconds)

    def close(self):
        self._socket.close()

    def send(self, message):
        """Raises WoodlouseError when the connection is lost."""
        line = json.dumps(message, ensure_ascii=False, allow_nan=False, separators=(",", ":")) + "\n"
        try:
            self._socket.sendall(line.encode("utf-8", "replace"))
        except OSError as error:
            self._cut = isinstance(error, socket.timeout)
            raise WoodlouseError("connection", "lost while sending (%s)" % error) from None

    def waiting(self):
        """Whether something can be read without waiting."""
        return self._bytes.find(b"\n", self._searched) >= 0 or bool(select.select([self._socket], [], [], 0)[0])

    def _line(self):
        if self._cut:
            raise WoodlouseError("connection", "the server took nothing for %g s" % SILENCE_S)
        while True:
            end = self._bytes.find(b"\n", self._searched)
            if end >= 0:
                line = bytes(self._bytes[:end])
                del self._bytes[:end + 1]
                self._searched = 0
                return line
            self._searched = len(self._bytes)
            if self._searched > MAX_LINE_BYTES:
                raise WoodlouseError("protocol", "a line of more than %d bytes" % MAX_LINE_BYTES)
            try:
                chunk = self._socket.recv(1 << 16)
            except socket.timeout:
                raise WoodlouseError("connection", "the server said nothing for %g s"
                                     % self._socket.gettimeout()) from None
            except OSError as error:
                raise WoodlouseError("connection", "lost (%s)" % error) from None
            if not chunk:
                raise WoodlouseError("connection", "the server closed it")
            self._bytes += chunk

    def message(self):
        """The next message, waiting for it; of a line of a recording {"type": "recorded", "line": its text}. Raises
        WoodlouseError: silence, a lost connection, no message."""
        line = self._line()
        if self.has_recording and not line.startswith(b'{"type":'):
            return {"type": "recorded", "line": line.decode("utf-8", "replace")}
        try:
            message = json.loads(line)
            message["type"]
        except (ValueError, TypeError, KeyError):
            raise WoodlouseError("protocol", "not a message: %r" % line[:80]) from None
        return message


def told_address(text):
    """Of a HOST:PORT that a server told: the same text, where it is one and nothing else - no link, no path, no port left
    out; else None. IPv6 stands in brackets."""
    if not isinstance(text, str) or len(text) > MAX_ADDRESS:
        return None
    parts = re.fullmatch(r"(?:\[([0-9A-Fa-f:.]+)\]|([A-Za-z0-9][A-Za-z0-9._-]*)):([1-9][0-9]{0,4})", text, re.ASCII)
    if not parts or int(parts[3]) > 65535:
        return None
    try:
        if parts[1]:
            ipaddress.IPv6Address(parts[1])
        elif not re.search(r"[^0-9.]", parts[2]):
            ipaddress.IPv4Address(parts[2])
    except ValueError:
        return None
    return text


def is_this_machine(address):
    """Whether HOST:PORT names it as such."""
    host = address.rpartition(":")[0].strip("[]")
    try:
        return ipaddress.ip_address(host or "127.0.0.1").is_loopback
    except ValueError:
        return host == "localhost"


def open_lines(address):
    """Connects to HOST:PORT. Raises WoodlouseError."""
    host, colon, port = address.rpartition(":")
    if not colon or not port.isdigit() or not 0 < int(port) < 65536:
        raise WoodlouseError("connection", "the address %r is not HOST:PORT, as %s" % (address, DEFAULT_ADDRESS))
    try:
        connection = socket.create_connection((host.strip("[]") or "127.0.0.1", int(port)), timeout=10)
    except OSError as error:
        raise WoodlouseError("connection", "no server at %s (%s); start one: woodlouse-server --map maps/volcano.json"
                             % (address, error)) from None
    connection.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
    return Lines(connection)
