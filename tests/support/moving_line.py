"""A line to a server that stands in for one whose rooms move elsewhere: several of them lead to the same server, so that what
was at the one goes on at the other. Standard library only."""

import json
import socket

from breakable_line import BreakableLine


def moved(kind, address):
    """As a line: a `bye` or an `error` of that code."""
    word = {"type": kind, "code": "moved", "text": "the room has moved"}
    word.update({"resumable": True} if kind == "bye" else {"fatal": True})
    if address:
        word["address"] = address
    return json.dumps(word).encode() + b"\n"


class MovingLine(BreakableLine):
    """hosts: that each hello names from then on. sends_on: where whoever joins from then on is sent; empty: nowhere.
    joins: of those who were sent on, as they came."""

    def __init__(self, server):
        self.hosts = []
        self.sends_on = ""
        self.joins = []
        super().__init__(server)

    def move(self, address):
        """Says so to everybody who is there, and ends. The server hears nothing of it: a louse waits."""
        with self._lock:
            for end in self._ends[1::2]:  # the server's
                end.last_word = moved("bye", address)

    def _serve_one(self, client):
        if not self.sends_on:
            return super()._serve_one(client)
        with client, socket.create_connection(self._server) as server, server.makefile("rb") as said, client.makefile("rb") as asked:
            try:
                client.sendall(self._look(said.readline()))
                self.joins.append(json.loads(asked.readline() or "{}"))
                client.sendall(moved("error", self.sends_on) + moved("bye", self.sends_on))
                client.shutdown(socket.SHUT_WR)
                asked.read()  # until the client has gone
            except OSError:
                pass  # it did not wait

    def _look(self, data):
        greeting = b'{"type":"hello",'
        if self.hosts and data.startswith(greeting):
            data = greeting + b'"hosts":' + json.dumps(self.hosts).encode() + b"," + data[len(greeting):]
        return super()._look(data)
