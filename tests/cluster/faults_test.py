"""What becomes of a cluster's rooms when something of it fails, and what players see. Short here; longer by hand:

Usage: faults_test.py [TestCase.test ...]      SECONDS_AWAY=300 faults_test.py Nats.test_away"""

import asyncio
import json
import os
import re
import signal
import sys
import time
import unittest

import metrics
import nats_wire
import stage

LAME_DUCK_GAP = 0.5


class Acknowledgements:
    """When a host was told that more of its log is stored, by its beats (ten a second at least), heard at one node of NATS."""

    def __init__(self, nats, node, host):
        self.times, self.number = [], 0
        self.wire = nats_wire.Wire(nats.ports[node])
        self.wire.subscribe(f"wl.woodlouse.beat.{host}", self.take)

    def take(self, payload):
        number = json.loads(payload)["sequence"]
        if number > self.number:
            self.times.append(time.monotonic())
        self.number = number

    def largest_gap(self):
        assert len(self.times) > 10, "nothing is stored"
        return max(later - sooner for sooner, later in zip(self.times, self.times[1:]))

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.wire.close()


class Cluster(unittest.TestCase):
    replicas = 1
    settings = {"silence_ms": 300}
    jetstream = ""

    def setUp(self):
        self.nats = self.enterContext(stage.Nats(self.replicas, jetstream=self.jetstream, **self.settings))

    def host(self, name, *arguments, **options):
        return self.enterContext(stage.Host(self.nats, name, *arguments, **options))

    def two_hosts(self):
        first = self.host("a")
        first.wait_for("cluster_owns")
        second = self.host("b")
        second.wait_for("cluster_follows")
        return first, second

    def check_log(self, holes=0):
        code, said, proofs = self.nats.joined()
        self.assertEqual(code, 0 if holes == 0 else 1, said)
        self.assertIn(f"{holes} holes", said)
        self.assertTrue(proofs, said)
        for name, (verified, text) in proofs.items():
            self.assertEqual(verified, 0, f"{name}: {text}")
        return said


class Hosts(Cluster):
    def test_a_host_that_stood_still_is_fenced_and_its_players_are_sent_on(self):
        first, second = self.two_hosts()
        with stage.Clients(8, [first.address]) as clients:
            clients.wait_here()
            louse = {bot.name: bot.welcomes[-1][1]["id"] for bot in clients.bots}
            first.signal(signal.SIGSTOP)
            second.wait_for("cluster_owns")
            time.sleep(float(os.environ.get("SECONDS_STOPPED", "2")))
            for bot in clients.bots:
                bot.addresses = [second.address]
            went_on = time.monotonic()
            first.signal(signal.SIGCONT)
            first.wait_for("FENCED")
            clients.wait_for(lambda bot: len(bot.welcomes) == 2, "not all came back: " + first.log() + second.log())
            for bot in clients.bots:
                self.assertEqual([bye["code"] for bye in bot.byes], ["moved"])
                self.assertEqual(bot.byes[0]["address"], second.address)
                self.assertTrue(bot.welcomes[-1][1]["resumed"])
                self.assertEqual(bot.welcomes[-1][1]["id"], louse[bot.name])
            stale = sum(at > went_on and address == first.address for bot in clients.bots for at, address in bot.frames)
            self.assertEqual(stale, 0, "frames of a room that was another host's by then")
        first.wait_for("cluster_follows")  # and stands by again
        said = self.check_log()
        self.assertIn("epoch 2 of b", said)

    def test_two_hosts_begin_at_once_and_one_owns(self):
        hosts = [self.host(name) for name in "abc"]
        end = time.monotonic() + stage.PATIENCE
        while sum("cluster_owns" in host.log() for host in hosts) != 1 or not all(
                "cluster_owns" in host.log() or "cluster_follows" in host.log() for host in hosts):
            self.assertLess(time.monotonic(), end, [host.log() for host in hosts])
            time.sleep(0.05)
        time.sleep(1)
        self.assertEqual(sum("cluster_owns" in host.log() for host in hosts), 1)

    def test_all_hosts_gone_and_back_go_on_with_the_last_tick(self):
        first = self.host("a")
        first.wait_for("cluster_owns")
        with stage.Clients(3, [first.address]) as clients:
            clients.wait_here()
            time.sleep(6)  # past a keyframe
            first.signal(signal.SIGKILL)
            first.process.wait()
            second = self.host("b")
            second.wait_for("goes on from the log of main")
            for bot in clients.bots:
                bot.addresses = [second.address]
            clients.wait_for(lambda bot: len(bot.welcomes) == 2 and bot.welcomes[-1][1]["resumed"], second.log())
        self.check_log()

    def test_who_asks_a_host_that_stands_by_is_told_where_the_room_is(self):
        first, second = self.two_hosts()
        time.sleep(0.3)

        async def ask(join):
            reader, writer = await asyncio.open_connection(*second.address.rsplit(":", 1))
            await reader.readline()
            writer.write(join)
            said = await reader.read(65536)
            writer.close()
            return said.decode()

        said = asyncio.run(ask(b'{"type":"join","protocol":1,"name":"ann","room":"volcano"}\n'))
        self.assertIn('"code":"moved"', said)
        self.assertIn(f'"address":"{first.address}"', said)
        said = asyncio.run(ask(b'{"type":"join","protocol":1,"name":"ann"}\n'))
        self.assertIn(f'"address":"{first.address}"', said)


class Nats(Cluster):
    def test_away(self):
        """Nobody stores what is played: rooms go on, players hear of it after 10 s, and all is stored when NATS is back."""
        first, second = self.two_hosts()
        with stage.Clients(4, [first.address]) as clients:
            clients.wait_here()
            self.nats.kill(0)
            away = float(os.environ.get("SECONDS_AWAY", "12"))
            time.sleep(away)
            for bot in clients.bots:
                self.assertEqual(len(bot.losses), 0)
                self.assertLess(time.monotonic() - bot.newest[0], 2)
            first.wait_for("NOT DURABLE")
            self.assertEqual(first.log().count("cluster_owns"), 1)
            self.nats.start(0)
            first.wait_for("cluster_durable")
            end = time.monotonic() + stage.PATIENCE
            while self.nats.tick() < clients.bots[0].newest[1] - 60:
                self.assertLess(time.monotonic(), end, first.log())
            self.assertNotIn("cluster_owns", second.log())
        # What waited is stored, and where there was too much of it that is told.
        print(self.check_log(holes=first.log().count("LOG HAS A HOLE")).splitlines()[-1])


class Refused(Cluster):
    def write(self, users):
        """NATS takes those who have a password, or all."""
        self.nats.configure(0, "")
        with open(self.nats.configuration(0), "a") as out:
            out.write("server_name: n0\n" + ("authorization { user: somebody, password: else }\n" if users else ""))
        self.nats.processes[0].send_signal(signal.SIGHUP)

    def test_hosts_that_nats_refuses_for_a_while_come_back(self):
        """libnats gives a line up after the second refusal."""
        first, second = self.two_hosts()
        edge = self.enterContext(stage.EdgeHost(self.nats, "e"))
        edge.wait_for("is shown here")
        with stage.Clients(2, [first.address, second.address]) as clients:
            clients.wait_here()
            self.write(users=True)
            for host in (first, second, edge):
                host.wait_for("NATS is not connected" if host is not first else "NOT DURABLE")
            time.sleep(3)
            self.write(users=False)
            first.wait_for("cluster_durable")
            for host in (first, second, edge):
                host.wait_for("NATS takes this host again")
            second.wait_for("cluster_follows", count=3)
            acked = self.nats.tick()
            first.signal(signal.SIGKILL)
            second.wait_for("cluster_owns")
            self.assertGreaterEqual(second.went_on_at(), acked)
            clients.wait_for(lambda bot: len(bot.welcomes) == 2 and bot.welcomes[-1][1]["resumed"], "not all came back: " + second.log())
        self.check_log()


class Full(Cluster):
    """NATS may store no more: what it says to each batch is an error, and only a restart with a larger store makes room."""
    jetstream = "max_file_store: 64KB"

    def fill(self, owner):
        owner.wait_for("insufficient resources", patience=120)

    def make_room(self):
        self.nats.configure(0, "max_file_store: 64MB")
        self.nats.kill(0, signal.SIGTERM)
        self.nats.start(0)

    def test_rooms_go_on_and_all_is_stored_once_there_is_room(self):
        first, second = self.two_hosts()
        with stage.Clients(8, [first.address]) as clients:
            clients.wait_here()
            self.fill(first)
            full = time.monotonic()
            memory = metrics.Metrics(first.door).total("process_resident_memory_bytes")
            clients.wait_for(lambda bot: "not_durable" in bot.notices, "nobody was told")
            lasts = float(os.environ.get("SECONDS_FULL", "12"))
            time.sleep(max(0.0, full + lasts - time.monotonic()))
            more = metrics.Metrics(first.door).total("process_resident_memory_bytes") - memory
            print(f"memory of {time.monotonic() - full:.0f} s: {more / 1e6:.1f} MB")
            self.assertLess(more, 16e6)
            for bot in clients.bots:
                self.assertEqual(len(bot.losses), 0)
                self.assertLess(time.monotonic() - bot.newest[0], 2)
            self.make_room()
            clients.wait_for(lambda bot: bot.notices[-1] == "durable", "nobody was told that all is well:\n" + first.log())
            time.sleep(1)
            self.assertNotIn("cluster_owns", second.log())
            self.assertEqual(first.log().count("cluster_owns"), 1)
        self.check_log(holes=0 if lasts < 50 else 1)

    def test_nobody_takes_over_before_there_is_room(self):
        first, second = self.two_hosts()
        with stage.Clients(8, [first.address, second.address]) as clients:
            clients.wait_here()
            self.fill(first)
            time.sleep(1)
            stored = self.nats.tick()
            first.signal(signal.SIGKILL)
            first.process.wait()
            second.wait_for("did not take this host's first batch")
            self.assertNotIn("cluster_owns", second.log())
            self.make_room()
            second.wait_for("goes on from the log of main")
            self.assertEqual(second.went_on_at(), stored)
            clients.wait_for(lambda bot: len(bot.welcomes) == 2 and bot.welcomes[-1][1]["resumed"], second.log())
        self.check_log()


class Replicas(Cluster):
    replicas = 3
    settings = {"silence_ms": 1000}

    def test_leader_of_the_log_killed(self):
        first, second = self.two_hosts()
        with stage.Clients(4, [first.address]) as clients:
            clients.wait_here()
            leader = self.nats.leader()
            self.assertIsNotNone(leader)
            self.nats.kill(leader)
            time.sleep(8)
            for bot in clients.bots:
                self.assertEqual(len(bot.losses), 0)
                self.assertLess(time.monotonic() - bot.newest[0], 2)
            self.nats.start(leader)
            time.sleep(1)
            self.assertNotIn("cluster_owns", second.log())
            self.assertEqual(first.log().count("cluster_owns"), 1, first.log())
        self.check_log()

    def test_each_node_in_lame_duck_mode_in_turn(self):
        """As an operator upgrades NATS: nobody takes over, nothing is missing, and nothing waits for long to be stored."""
        first, second = self.two_hosts()
        gaps = []
        with stage.Clients(4, [first.address]) as clients:
            clients.wait_here()
            for number in range(self.replicas):
                with Acknowledgements(self.nats, (number + 1) % self.replicas, "a") as stored:
                    time.sleep(1)
                    self.nats.processes[number].send_signal(signal.SIGUSR2)
                    time.sleep(3)
                    self.nats.kill(number, signal.SIGTERM)  # it would go by itself once all its clients have: two minutes
                    time.sleep(1)
                    self.nats.start(number)
                    self.wait_for_replicas()
                gaps.append(stored.largest_gap())
            for bot in clients.bots:
                self.assertEqual(len(bot.losses), 0)
                self.assertLess(time.monotonic() - bot.newest[0], 2)
                self.assertNotIn("not_durable", bot.notices)
            self.assertNotIn("cluster_owns", second.log())
            self.assertEqual(first.log().count("cluster_owns"), 1, first.log())
        print("largest gaps between acknowledgements [ms]:", " ".join(f"{1000 * gap:.0f}" for gap in gaps))
        self.assertLess(max(gaps), LAME_DUCK_GAP, first.log())
        self.check_log()

    def wait_for_replicas(self):
        end = time.monotonic() + stage.PATIENCE
        while f"{self.replicas} of {self.replicas} replicas have all, led by" not in (said := self.nats.command("status")[1]):
            self.assertLess(time.monotonic(), end, said)
            time.sleep(0.2)


if __name__ == "__main__":
    stage.skip_where_missing()
    if not hasattr(unittest.TestCase, "enterContext"):  # Python 3.11 has it
        sys.exit("Python 3.11 is needed")
    unittest.main(verbosity=2)
