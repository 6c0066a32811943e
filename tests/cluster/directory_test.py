"""What each host of a cluster tells of all of its rooms, by lines and by HTTP.

Usage: directory_test.py [TestCase.test ...]"""

import http.client
import json
import os
import pathlib
import signal
import socket
import subprocess
import sys
import time
import unittest

import stage
from faults_test import Cluster

SOURCE = pathlib.Path(stage.MAPS).parent
sys.path.insert(0, str(SOURCE / "bots" / "python"))

import woodlouse  # noqa: E402


class Client:
    """A connection that says lines and gets messages."""

    def __init__(self, address):
        host, port = address.rsplit(":", 1)
        self.socket = socket.create_connection((host, int(port)), stage.PATIENCE)
        self.lines = self.socket.makefile("rb")
        self.hello = self.next("hello")

    def next(self, *kinds):
        """The next message of one of these kinds; None at the end."""
        for line in self.lines:
            message = json.loads(line)
            if message["type"] in kinds:
                return message
            if message["type"] == "ping":
                self.say(type="pong", t=message["t"])
        return None

    def say(self, **message):
        self.socket.sendall(json.dumps(message).encode() + b"\n")

    def rooms(self):
        self.say(type="list")
        return self.next("rooms")["rooms"]

    def join(self, room):
        """The welcome, or the error."""
        self.say(type="join", protocol=1, name="ann", room=room)
        return self.next("welcome", "error")

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.lines.close()
        self.socket.close()


def rooms_at(address):
    with Client(address) as client:
        return client.rooms()


def wait_for_rooms(address, condition):
    """The list of that host, once it is as it should be."""
    end = time.monotonic() + stage.PATIENCE
    while not condition(rooms := rooms_at(address)):
        assert time.monotonic() < end, rooms
        time.sleep(0.05)
    return rooms


class Directory(Cluster):
    def test_who_stands_by_tells_of_rooms_where_they_are_and_follows_them(self):
        first = self.host("a", maps=("volcano", "hills"))
        first.wait_for("cluster_owns")
        second = self.host("b", "--web", "127.0.0.1:0", maps=("volcano", "hills"))
        web = second.process.stdout.readline().split()[1].removeprefix("http://").rstrip("/")
        second.wait_for("cluster_follows")
        told = wait_for_rooms(second.address, lambda rooms: len(rooms) == 2)
        own = {room["name"]: room for room in rooms_at(first.address)}
        self.assertEqual({room["name"]: room["code"] for room in told}, {name: room["code"] for name, room in own.items()})
        self.assertEqual({room["address"] for room in told}, {first.address})
        self.assertTrue(all("address" not in room for room in own.values()), own)
        for room in told:
            self.assertRegex(room["code"], "^[BCDFGHJKMPRSTVXZ]{5}$")

        connection = http.client.HTTPConnection(web, timeout=stage.PATIENCE)
        connection.request("GET", "/rooms")
        self.assertEqual(json.loads(connection.getresponse().read()), told)
        connection.close()

        code = own["hills"]["code"].lower()
        with Client(second.address) as client:
            self.assertEqual(set(client.hello["rooms"]), {"volcano", "hills"})
            self.assertEqual(client.join("no such room")["code"], "unknown_room")
            moved = client.join(code)
        self.assertEqual((moved["code"], moved["address"]), ("moved", first.address))
        with Client(first.address) as client:
            self.assertEqual(client.join(code)["room"], "hills")
        with woodlouse.connect(second.address, name="kit", room=code) as game:
            self.assertEqual(game.room, "hills")
            self.assertEqual({room["name"] for room in game.rooms()}, {"volcano", "hills"})

        with Client(second.address) as watcher:
            watcher.say(type="list", watch=True)
            self.assertEqual({room["address"] for room in watcher.next("rooms")["rooms"]}, {first.address})
            first.signal(signal.SIGTERM)
            rooms = watcher.next("rooms")["rooms"]
            while len(rooms) < 2 or any("address" in room for room in rooms):
                rooms = watcher.next("rooms")["rooms"]
            self.assertEqual({room["name"]: room["code"] for room in rooms}, {name: room["code"] for name, room in own.items()})

    def test_hosts_of_another_shard_tell_of_each_other(self):
        first = self.host("a")
        file = os.path.join(self.nats.folder, "alps.json")
        with open(file, "w") as out:
            json.dump({**self.nats.settings, "shard": "alps"}, out)
        subprocess.run([stage.PROGRAM, "cluster", "init", file], check=True, capture_output=True, timeout=60)
        # The stage's own file is the first shard's.
        main, self.nats.file = self.nats.file, file
        second = self.host("x", maps=("volcano", "hills"))
        self.nats.file = main
        first.wait_for("cluster_owns")
        second.wait_for("cluster_owns")
        rooms = wait_for_rooms(first.address, lambda rooms: len(rooms) == 3)
        self.assertEqual([(room["name"], room.get("address")) for room in rooms],
                         [("volcano", None), ("hills", second.address), ("volcano", second.address)])
        self.assertEqual(len({room["code"] for room in rooms}), 3)
        others = wait_for_rooms(second.address, lambda rooms: len(rooms) == 3)
        self.assertEqual({room["code"] for room in others}, {room["code"] for room in rooms})
        with Client(first.address) as client:
            self.assertEqual(client.hello["rooms"], ["volcano", "hills"])
            self.assertEqual(client.join("hills")["address"], second.address)
        with Client(first.address) as client:  # its namesake here is another one
            self.assertEqual(client.join(rooms[2]["code"])["address"], second.address)
        with Client(second.address) as client:
            self.assertEqual(client.join(rooms[2]["code"])["room"], "volcano")


if __name__ == "__main__":
    stage.skip_where_missing()
    unittest.main(verbosity=2)
