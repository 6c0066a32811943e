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
from nats_wire import Wire

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


    def test_who_has_just_begun_is_told_of_the_rooms_at_once(self):
        """An owner tells his rooms once a second: who comes between does not wait for that."""
        first = self.host("a", maps=("volcano", "hills"))
        first.wait_for("cluster_owns")
        beats = []  # (who, whether its rooms are in it)
        with Wire(self.nats.ports[0]) as wire:
            def take(payload):
                beat = json.loads(payload)
                beats.append((beat["host"], beat["process"], "rooms" in beat))
            for kind in ("beat", "edge"):
                wire.subscribe(f"wl.woodlouse.{kind}.*", take)
            time.sleep(4)  # past the time in which he tells them in each
            self.assertIn(("a", False), {(who, has_rooms) for who, _, has_rooms in beats})
            for k in range(6):
                late = self.enterContext(stage.EdgeHost(self.nats, "e")) if k % 2 else self.host(f"n{k}", maps=("volcano", "hills"))
                late.wait_for("cluster_follows")
                time.sleep(0.5)
                late.signal(signal.SIGKILL)  # no word from it
            owner = next(process for who, process, _ in beats if who == "a")
            seen, fresh = {owner}, 0
            for at, (_, process, _) in enumerate(list(beats)):
                if process in seen:
                    continue
                seen.add(process)
                fresh += 1
                own = [has_rooms for _, other, has_rooms in beats[at:] if other == owner][:6]
                self.assertIn(True, own, f"{fresh} of {len(seen)}")
            self.assertEqual(fresh, 6)

    def test_who_is_muted_is_so_at_the_next_host(self):
        first, second = self.two_hosts()
        said = subprocess.run([stage.PROGRAM, "admin", "--socket", first.door, "mute", "nobody"], capture_output=True, text=True, timeout=30)
        self.assertNotEqual(said.returncode, 0)
        tokens = {}
        for name in ("mallory", "ann", "bob"):
            client = self.enterContext(Client(first.address))
            client.say(type="join", protocol=1, name=name, room="volcano", resume=True)
            tokens[name] = client.next("welcome")["resume_token"]
        for order in (["mute", "mallory"], ["mute", "bob", "--for", "1h"], ["mute", "ann"], ["unmute", "ann"]):
            subprocess.run([stage.PROGRAM, "admin", "--socket", first.door, *order], check=True, capture_output=True, timeout=30)
        time.sleep(0.5)
        first.signal(signal.SIGTERM)
        second.wait_for("goes on from the log of main")
        words = {}
        for name, token in tokens.items():
            client = self.enterContext(Client(second.address))
            client.say(type="join", protocol=1, name=name, room="volcano", resume=token)
            self.assertTrue(client.next("welcome")["resumed"])
            client.say(type="chat", text="hello")
            message = client.next("error", "event")
            while message.get("kind") not in (None, "chat"):
                message = client.next("error", "event")
            words[name] = message.get("text", "")
        self.assertRegex(words["mallory"], "you have been muted as long as you are here")
        self.assertRegex(words["bob"], r"you have been muted for another 3[56]\d\d s")
        self.assertEqual(words["ann"], "hello")

    def test_a_host_of_another_mode_or_other_rooms_is_told_so(self):
        first = self.host("a")
        first.wait_for("cluster_owns")
        file = os.path.join(self.nats.folder, "strict.json")
        with open(self.nats.file) as main, open(file, "w") as out:
            json.dump({**json.load(main), "mode": "strict"}, out)
        second = self.host("b", maps=("volcano", "hills"), file=file)
        second.wait_for('a plays in mode play, this host in mode strict: "mode" is to be the same in the file of each')
        second.wait_for("the cluster does not play hills, which this host would: opened once its rooms are here")
        self.assertRegex(self.nats.command("status")[1], r"(?m)^host b at \S+: stands by, mode strict, ")
        first.signal(signal.SIGKILL)
        second.wait_for("cluster_owns")
        wait_for_rooms(second.address, lambda rooms: {room["name"] for room in rooms} == {"volcano", "hills"})


class KnownHosts(Cluster):
    """Of who plays, and knows what his server told him alone."""

    def played(self, address):
        """(game, play(seconds))"""
        game = self.enterContext(woodlouse.connect(address, name="eve"))
        states = game.states()

        def play(seconds=0.0, until=None):
            end = time.monotonic() + (seconds if until is None else stage.PATIENCE)
            while time.monotonic() < end and not (until and until()):
                next(states)
            self.assertTrue(until is None or until())
        play(until=lambda: True)
        return game, play

    def test_a_host_that_began_later_is_known_to_who_was_there(self):
        first = self.host("a", "--ping-s", "1")
        first.wait_for("cluster_owns")
        game, play = self.played(first.address)
        play(1)
        second = self.host("b")
        second.wait_for("cluster_follows")
        play(3)
        first.signal(signal.SIGKILL)
        first.process.wait()
        play(until=lambda: game.address == second.address)

    def test_the_other_host_is_known_while_nats_is_away(self):
        first = self.host("a", "--ping-s", "1")
        first.wait_for("cluster_owns")
        second = self.host("b")
        second.wait_for("cluster_follows")
        game, play = self.played(first.address)
        play(3)
        self.nats.kill(0)
        play(8)
        first.signal(signal.SIGKILL)
        first.process.wait()
        self.nats.start(0)
        play(until=lambda: game.address == second.address)


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
            self.assertGreater(cut["woodlouse_cluster_batches_waiting"], 0)
            later = self.wait_for_figures(second, lambda s: s["woodlouse_cluster_unacknowledged_seconds"] > 4)
            for name in ("batch", "batches_stored_total"):
                self.assertEqual(later["woodlouse_cluster_" + name], cut["woodlouse_cluster_" + name], name)
            self.nats.start(0)
            stored = cut["woodlouse_cluster_batches_stored_total"]
            back = self.wait_for_figures(second, lambda s: s["woodlouse_cluster_connected"] == 1 and
                                         s["woodlouse_cluster_batches_stored_total"] > stored + 5)
            self.assertLess(back["woodlouse_cluster_unacknowledged_seconds"], 2)
            self.assertEqual(back["woodlouse_cluster_holes_total"], 0)


if __name__ == "__main__":
    stage.skip_where_missing()
    unittest.main(verbosity=2)
