"""A TCP line between a client and a server that breaks when a test says so. Standard library only."""

import re
import socket
import struct
import threading

_RESETS = struct.pack("ii", 1, 0)  # SO_LINGER: to close is to reset


class BreakableLine:
    """Listens at `address` and passes on what comes to and from `server`. tokens: the resume_token of each welcome."""

    def __init__(self, server):
        host, port = server.rsplit(":", 1)
        self._server = host, int(port)
        self._listener = socket.create_server(("127.0.0.1", 0))
        self.address = "127.0.0.1:%d" % self._listener.getsockname()[1]
        self.tokens = []
        self._ends = []
        self._passes = True
        self._lock = threading.Lock()
        self._thread = threading.Thread(target=self._serve, daemon=True)
        self._thread.start()

    def cut(self):
        """Resets every connection, both ways, and each that comes, until mend()."""
        with self._lock:
            self._passes = False
            self._reset()

    def mend(self):
        with self._lock:
            self._passes = True

    def reset(self):
        """Resets every connection; the next one passes."""
        with self._lock:
            self._reset()

    def hush(self):
        """Passes on nothing more of the connections that there are, and says so to nobody."""
        with self._lock:
            for end in self._ends:
                end.hushed = True

    def stop(self):
        self.cut()
        try:
            self._listener.shutdown(socket.SHUT_RDWR)
        except OSError:
            pass  # it listened to nobody any more
        self._listener.close()
        self._thread.join(10)

    def _reset(self):
        for end in self._ends:
            end.reset()
        self._ends = []

    def _serve(self):
        while True:
            try:
                client, _ = self._listener.accept()
            except OSError:
                return  # stopped
            threading.Thread(target=self._serve_one, args=(client,), daemon=True).start()

    def _serve_one(self, client):
        with self._lock:
            ends = [_End(client)]
            try:
                ends += [_End(socket.create_connection(self._server))] if self._passes else []
            except OSError:
                pass  # there is no server: nobody is there for the client
            if len(ends) < 2:
                return ends[0].reset()
            self._ends += ends
        for end, other, look in ((ends[0], ends[1], None), (ends[1], ends[0], self._look)):
            threading.Thread(target=end.carry, args=(other, look), daemon=True).start()

    def _look(self, data):
        """What is passed on of what the server has said."""
        self.tokens += [token.decode() for token in re.findall(rb'"resume_token":"([0-9a-f]+)"', data)]
        return data


class _End:
    def __init__(self, connection):
        self._socket = connection
        self.hushed = False
        self.last_word = b""  # passed on behind the next whole line instead of all that follows

    def carry(self, other, look):
        try:
            while data := self._socket.recv(65536):
                if look:
                    data = look(data)
                if not (self.hushed or other.hushed):
                    other._socket.sendall(data)
                if self.last_word and data.endswith(b"\n"):
                    other._socket.sendall(self.last_word)
                    other._socket.shutdown(socket.SHUT_WR)
                    return self.reset()
            if not self.hushed:
                other._socket.shutdown(socket.SHUT_WR)
        except OSError:
            pass  # an end has gone

    def reset(self):
        self.hushed = True  # its end is no end of what it sends
        try:
            self._socket.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, _RESETS)
            self._socket.shutdown(socket.SHUT_RD)  # wakes who reads from it
        except OSError:
            pass  # it has ended already
        self._socket.close()
