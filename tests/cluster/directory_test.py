"""What each host of a cluster tells of all of its rooms, by lines, by HTTP and in figures.

Usage: directory_test.py [TestCase.test ...]"""

import http.client
import json
import os
import pathlib
import re
import signal
import socket
import subprocess
import sys
import time
import unittest

import stage
from faults_test import Cluster

CLIENT = os.environ["WOODLOUSE_CLIENT"]
SOURCE = pathlib.Path(stage.MAPS).parent
sys.path.insert(0, str(SOURCE / "bots" / "python"))
sys.path[:0] = [str(SOURCE / "tests" / "e2e" / part) for part in ("metrics", "server")]

import woodlouse  # noqa: E402
from scrape import Scrape, UnixConnection, documented  # noqa: E402


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

        listed = subprocess.run([CLIENT, "--no-files", "--rooms", second.address], capture_output=True, text=True, timeout=30)
        self.assertEqual(listed.returncode, 0, listed.stderr)
        self.assertRegex(listed.stdout, rf"(?m)^hills +hills +\d+ +\d+ +\d+  {own['hills']['code']}  {re.escape(first.address)}$")

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
        with open(self.nats.file) as main, open(file, "w") as out:
            json.dump({**json.load(main), "shard": "alps"}, out)
        subprocess.run([stage.PROGRAM, "cluster", "init", file], check=True, capture_output=True, timeout=60)
        second = self.host("x", maps=("volcano", "hills"), file=file)
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


class Figures(Cluster):
    def scrape(self, host):
        connection = UnixConnection(host.door)
        connection.request("GET", "/metrics")
        text = connection.getresponse().read().decode()
        connection.close()
        return Scrape(text)

    def wait_for_figures(self, host, condition):
        end = time.monotonic() + stage.PATIENCE
        while not condition(scrape := self.scrape(host)):
            assert time.monotonic() < end, scrape.text
            time.sleep(0.05)
        return scrape

    def test_each_host_tells_its_part(self):
        first = self.host("a")
        first.wait_for("cluster_owns")
        second = self.host("b")
        second.wait_for("cluster_follows")
        with Client(first.address) as client:
            client.join("volcano")
            owner = self.wait_for_figures(first, lambda s: s["woodlouse_cluster_hosts", "stands_by"] == 1 and
                                          s["woodlouse_cluster_batches_stored_total"] > 3)
        told = {name: (owner.types[name], labels) for name, labels in owner.labels.items() if "_cluster_" in name}
        self.assertEqual(told, {name: what for name, what in documented().items() if "_cluster_" in name})
        for name, value in (("owns", 1), ("ready", 0), ("connected", 1), ("differs", 0), ("takeovers_total", 1), ("fenced_total", 0),
                            ("holes_total", 0)):
            self.assertEqual(owner["woodlouse_cluster_" + name], value, name)
        self.assertLess(owner["woodlouse_cluster_unacknowledged_seconds"], 2)
        follower = self.wait_for_figures(second, lambda s: s["woodlouse_cluster_ready"] == 1 and s["woodlouse_cluster_hosts", "owns"] == 1)
        self.assertEqual(follower["woodlouse_cluster_owns"], 0)
        self.assertEqual(follower["woodlouse_cluster_batches_stored_total"], 0)
        self.assertGreaterEqual(follower["woodlouse_cluster_batch"], owner["woodlouse_cluster_batch"] - 5)

        first.signal(signal.SIGSTOP)
        second.wait_for("cluster_owns")
        first.signal(signal.SIGCONT)
        fenced = self.wait_for_figures(first, lambda s: s["woodlouse_cluster_fenced_total"] == 1 and s["woodlouse_cluster_ready"] == 1)
        self.assertEqual(fenced["woodlouse_cluster_owns"], 0)
        self.assertEqual(self.scrape(second)["woodlouse_cluster_takeovers_total"], 1)

        said = subprocess.run([stage.PROGRAM, "admin", "--socket", second.door, "status"], capture_output=True, text=True, timeout=30)
        self.assertRegex(said.stdout, r"cluster: shard main: owns its rooms, stored up to batch \d+, .*1 stand by.*takeovers 1", said.stderr)

        with Client(second.address) as client:
            client.join("volcano")
            self.nats.kill(0)
            cut = self.wait_for_figures(second, lambda s: s["woodlouse_cluster_unacknowledged_seconds"] > 2)
            self.assertEqual(cut["woodlouse_cluster_connected"], 0)
            self.assertGreater(cut["woodlouse_cluster_batches_waiting"], 5)
            self.nats.start(0)
            back = self.wait_for_figures(second, lambda s: s["woodlouse_cluster_connected"] == 1 and
                                         s["woodlouse_cluster_batches_waiting"] <= 1)
            self.assertLess(back["woodlouse_cluster_unacknowledged_seconds"], 2)
            self.assertEqual(back["woodlouse_cluster_holes_total"], 0)


if __name__ == "__main__":
    stage.skip_where_missing()
    unittest.main(verbosity=2)
