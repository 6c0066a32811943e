"""Hosts that only show a cluster's rooms: what who watches there sees, and what becomes of him when the room moves.

Usage: edge_test.py [TestCase.test ...]"""

import json
import os
import shutil
import signal
import socket
import subprocess
import threading
import time
import unittest

import stage
from directory_test import Client, woodlouse
from faults_test import Cluster
from metrics import Door
from stage import Clients, EdgeHost


class Watcher:
    """Reads what one who watches is sent, on a thread of its own."""

    def __init__(self, address, **join):
        host, port = address.rsplit(":", 1)
        self.socket = socket.create_connection((host, int(port)))
        self.join = {"type": "join", "protocol": 1, "role": "spectator", "name": "eve", **join}
        self.frames = []    # (time, tick)
        self.hashes = {}    # of keys
        self.lines = []     # of the recording
        self.messages = []  # all others
        self.is_cut = False
        self.thread = threading.Thread(target=self.read)
        self.thread.start()

    def say(self, **message):
        self.socket.sendall(json.dumps(message).encode() + b"\n")

    def read(self):
        try:
            with self.socket.makefile("rb") as lines:
                self.messages.append(json.loads(lines.readline()))
                self.say(**self.join)
                for line in lines:
                    message = json.loads(line)
                    if "type" not in message:
                        self.lines.append(line)
                    elif message["type"] in ("key", "delta"):
                        self.frames.append((time.monotonic(), message["tick"]))
                        if "hash" in message:
                            self.hashes[message["tick"]] = message["hash"]
                    elif message["type"] == "ping":
                        self.say(type="pong", t=message["t"])
                    else:
                        self.messages.append(message)
        except OSError:
            pass
        self.is_cut = True

    def end(self):
        try:
            self.socket.shutdown(socket.SHUT_RDWR)
        except OSError:
            pass
        self.thread.join(stage.PATIENCE)
        self.socket.close()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.end()


class Edge(Cluster):
    def edge(self, *arguments):
        edge = self.enterContext(EdgeHost(self.nats, "e", *arguments))
        edge.wait_for("is shown here")
        return edge

    def watch(self, address, **join):
        return self.enterContext(Watcher(address, **join))

    @staticmethod
    def rooms(host):
        with Client(host.address) as client:
            return client.rooms()

    @staticmethod
    def hello(host):
        name, port = host.address.rsplit(":", 1)
        with socket.create_connection((name, int(port))) as line, line.makefile("rb") as said:
            return json.loads(said.readline())

    def test_it_shows_what_is_played_and_goes_on_with_it_at_the_next_host(self):
        first, second = self.two_hosts()
        edge = self.edge()
        with Clients(8, [first.address, second.address]) as clients:
            clients.wait_here()
            there, here = self.watch(first.address), self.watch(edge.address)
            by_inputs = self.watch(edge.address, stream="inputs")
            time.sleep(4)
            gaps = [b[0] - a[0] for a, b in zip(here.frames, here.frames[1:])]
            self.assertGreater(len(gaps), 60)
            self.assertLess(sorted(gaps)[len(gaps) * 9 // 10], 0.1)
            both = set(there.hashes) & set(here.hashes)
            self.assertGreaterEqual(len(both), 2)
            self.assertEqual([there.hashes[tick] for tick in both], [here.hashes[tick] for tick in both])
            names = {player["name"] for player in here.messages[1]["players"]}
            self.assertEqual(names, {bot.name for bot in clients.bots})
            first.signal(signal.SIGKILL)
            first.process.wait()
            second.wait_for("cluster_owns")
            clients.wait_for(lambda bot: len(bot.welcomes) >= 2, "not all came back")
            went_on = here.frames[-1][1]
            time.sleep(3)
            self.assertFalse(here.is_cut or by_inputs.is_cut, edge.log())
            self.assertGreater(here.frames[-1][1], went_on + 60)
            ticks = [tick for _, tick in here.frames]
            self.assertEqual(ticks, sorted(ticks))
            self.assertEqual([m["type"] for m in here.messages].count("welcome"), 1)
        self.assertTrue(there.is_cut)
        by_inputs.end()
        self.prove(by_inputs)
        self.assertNotIn("DIFFERS", edge.log())
        self.check_log()

    def prove(self, watcher):
        """What was watched by inputs is a recording."""
        path = os.path.join(self.nats.folder, "watched.ndjson")
        with open(path, "wb") as out:
            out.writelines(watcher.lines)
        said = subprocess.run([stage.PROGRAM, "verify", path], capture_output=True, text=True, timeout=300)
        self.assertIn("ok", said.stdout, said.stdout + said.stderr)
        self.assertNotIn("differs", said.stdout)

    def test_who_plays_is_sent_on_and_what_is_said_there_is_answered(self):
        first = self.host("a")
        first.wait_for("cluster_owns")
        edge = self.edge()
        end = time.monotonic() + 10
        while not self.hello(edge).get("hosts"):  # it has not heard the owner yet
            self.assertLess(time.monotonic(), end)
        player = self.watch(edge.address, role="player")
        player.thread.join(10)
        error = next(m for m in player.messages if m["type"] == "error")
        self.assertEqual((error["code"], error["address"]), ("moved", first.address))
        eve = self.watch(edge.address)
        end = time.monotonic() + 10
        while not any(m["type"] == "welcome" for m in eve.messages):
            self.assertLess(time.monotonic(), end)
            time.sleep(0.02)
        eve.say(type="chat", text="hello")
        eve.say(type="get_map")
        eve.say(type="list")
        while not {"error", "map", "rooms"} <= {m["type"] for m in eve.messages}:
            self.assertLess(time.monotonic(), end, eve.messages)
            time.sleep(0.02)
        self.assertEqual(next(m for m in eve.messages if m["type"] == "error")["code"], "only_shown")
        rooms = next(m for m in eve.messages if m["type"] == "rooms")["rooms"]
        self.assertEqual([(room["name"], room["spectators"]) for room in rooms], [("volcano", 1)])
        self.assertEqual(edge.end(), 0)

    def test_who_watches_at_one_that_ends_goes_on_at_another(self):
        first = self.host("a")
        first.wait_for("cluster_owns")
        edges = [self.edge("--ping-s", "1")]
        # Who came before the others began is told of them.
        game = self.enterContext(woodlouse.connect(edges[0].address, name="eve", role="spectator"))
        edges.append(self.edge("--ping-s", "1"))
        end = time.monotonic() + stage.PATIENCE
        while self.hello(edges[0]).get("hosts") != [edges[1].address, first.address]:
            self.assertLess(time.monotonic(), end, self.hello(edges[0]))
            time.sleep(0.05)
        self.assertEqual(self.hello(first).get("hosts"), None)  # who plays has no use for an edge
        code, said = self.nats.command("status")
        self.assertEqual(code, 0, said)
        for edge in edges:
            self.assertRegex(said, rf"(?m)^edge \S+ at {edge.address}: shows the rooms, has read up to batch \d+$")
        self.assertRegex(said, rf"(?m)^host a at {first.address}: owns the rooms, mode play, stored up to batch \d+$")
        states = game.states()
        end = time.monotonic() + 3
        while time.monotonic() < end:
            next(states)
        edges[0].signal(signal.SIGKILL)
        edges[0].process.wait()
        end = time.monotonic() + stage.PATIENCE
        while self.rooms(edges[1])[0]["spectators"] != 1:
            self.assertLess(time.monotonic(), end)
            next(states)
        self.assertEqual(self.rooms(first)[0]["spectators"], 0)
        end = time.monotonic() + stage.PATIENCE
        while self.hello(edges[1]).get("hosts") != [first.address]:  # the other one is forgotten
            self.assertLess(time.monotonic(), end)
            time.sleep(0.1)
        edges[1].signal(signal.SIGTERM)  # an orderly end loses nobody either
        while self.rooms(first)[0]["spectators"] != 1:
            self.assertLess(time.monotonic(), end)
            next(states)
        self.assertEqual(edges[1].end(), 0)
        while "edge " in (said := self.nats.command("status")[1]):
            self.assertLess(time.monotonic(), end, said)

    def test_an_edge_that_shows_nothing_says_so_and_an_address_without_a_port_is_refused(self):
        edge = self.enterContext(EdgeHost(self.nats, "e"))
        end = time.monotonic() + stage.PATIENCE
        while "edge " not in (said := self.nats.command("status")[1]):
            self.assertLess(time.monotonic(), end, said)
        self.assertRegex(said, r"(?m)^edge \S+ at \S+: SHOWS NOTHING \(its log says why\), has read up to batch \d+$")
        for address in ("127.0.0.1:0", "my host:7"):
            said = subprocess.run([stage.PROGRAM, "--cluster", self.nats.file, "--cluster-edge", "--cluster-address", address], capture_output=True, text=True, timeout=30)
            self.assertEqual(said.returncode, 2, said.stderr)
            self.assertIn(f"--cluster-address {address}: is no HOST:PORT", said.stderr)
        self.assertEqual(edge.end(), 0)

    def test_an_edge_that_is_cut_off_is_not_ready(self):
        path = os.path.join(self.nats.folder, "edge.sock")

        def readiness():
            door = Door(path)
            door.request("GET", "/readyz")
            answer = door.getresponse()
            said = answer.status, answer.read().decode().strip()
            door.close()
            return said

        def wait_for(expected):
            end = time.monotonic() + stage.PATIENCE
            while (said := readiness()) != expected:
                self.assertLess(time.monotonic(), end, said)
                time.sleep(0.1)

        edge = self.enterContext(EdgeHost(self.nats, "e", "--admin", path))
        wait_for((503, "no room is shown yet"))
        self.host("a").wait_for("cluster_owns")
        edge.wait_for("is shown here")
        wait_for((200, "ready"))
        self.nats.kill(0)
        wait_for((503, "NATS is not connected: what is shown stands"))
        self.nats.start(0)
        wait_for((200, "ready"))

    def test_a_game_whose_log_was_removed_is_shown_no_more_and_the_next_one_is(self):
        first = self.host("a")
        edge = self.edge()
        with Clients(1, [first.address]) as clients:
            clients.wait_here()
            time.sleep(2)
        self.watch(edge.address)
        first.end()
        self.nats.kill(0)
        shutil.rmtree(self.nats.store(0))
        self.nats.start(0)
        while self.nats.command("init")[0] != 0:
            time.sleep(0.2)
        edge.wait_for("it is another one")
        end = time.monotonic() + stage.PATIENCE
        while self.hello(edge)["rooms"]:
            self.assertLess(time.monotonic(), end, edge.log())
            time.sleep(0.1)
        second = self.host("b")
        edge.wait_for("is shown here", count=2)
        with Clients(1, [second.address]) as clients:
            clients.wait_here()
            eve = self.watch(edge.address)
            time.sleep(2)
            self.assertGreater(len(eve.frames), 10)
            self.assertLess(eve.frames[-1][1], 1000)

    def test_it_shows_nothing_before_there_is_a_room_and_comes_late_to_one(self):
        edge = self.enterContext(EdgeHost(self.nats, "e"))
        nobody = self.watch(edge.address)
        time.sleep(0.5)
        self.assertEqual(nobody.messages[0]["rooms"], [])
        self.assertEqual(nobody.messages[1]["code"], "unknown_room")
        first = self.host("a")
        first.wait_for("cluster_owns")
        edge.wait_for("is shown here")
        with Clients(2, [first.address]) as clients:
            clients.wait_here()
            time.sleep(6)  # past a keyframe
            late = self.enterContext(EdgeHost(self.nats, "f"))
            late.wait_for("is shown here")
            eve = self.watch(late.address)
            time.sleep(2)
            self.assertGreater(len(eve.frames), 20)
            self.assertEqual(len(eve.messages[1]["players"]), 2)


if __name__ == "__main__":
    stage.skip_where_missing()
    unittest.main(verbosity=2)
