"""Rooms that move because somebody wants it: `cluster move`, `cluster drain`, a rolling restart of three hosts under load.

Usage: moves_test.py [TestCase.test ...]"""

import signal
import time
import unittest

import nats_wire
import stage
from faults_test import Cluster
from stage import Clients

ARGUMENTS = ["--join-per-s-address", "100000", "--join-per-s-room", "100000"]


class Moves(Cluster):
    def three_hosts(self):
        hosts = {"a": self.host("a", *ARGUMENTS)}
        hosts["a"].wait_for("cluster_owns")
        for name in "bc":
            hosts[name] = self.host(name, *ARGUMENTS)
            hosts[name].wait_for("cluster_follows")
        time.sleep(0.3)
        return hosts

    def owner(self):
        owners = [line.split()[1] for line in self.nats.command("status")[1].splitlines() if "owns the rooms" in line]
        self.assertEqual(len(owners), 1)
        return owners[0]

    def check_all_are_back(self, clients, louse, times):
        clients.wait_for(lambda bot: len(bot.welcomes) >= times + 1 and bot.newest[0] > bot.welcomes[-1][0], "not all came back")
        for bot in clients.bots:
            self.assertEqual([bye["code"] for bye in bot.byes], ["moved"] * times)
            self.assertTrue(bot.welcomes[-1][1]["resumed"])
            self.assertEqual(bot.welcomes[-1][1]["id"], louse[bot.name])

    def test_rooms_go_where_they_are_told_to_and_a_drained_host_takes_none(self):
        hosts = self.three_hosts()
        addresses = [host.address for host in hosts.values()]
        with Clients(8, addresses) as clients:
            clients.wait_here()
            louse = {bot.name: bot.welcomes[-1][1]["id"] for bot in clients.bots}
            code, said = self.nats.command("move", "--to", "c")
            self.assertEqual(code, 0, said)
            self.assertIn(f"are at c, {hosts['c'].address}", said)
            self.check_all_are_back(clients, louse, 1)
            self.assertEqual(self.owner(), "c")
            code, said = self.nats.command("move", "--to", "c")
            self.assertEqual(code, 1, said)
            self.assertIn("already", said)
            code, said = self.nats.command("move", "--to", "nobody")
            self.assertEqual(code, 1, said)
            code, said = self.nats.command("drain", "nobody")
            self.assertEqual(code, 1, said)
            self.assertIn("nobody: no host of that name is heard", said)
            code, said = self.nats.command("drain", "a")  # which has no room
            self.assertEqual(code, 0, said)
            self.assertIn("a takes none", said)
            code, said = self.nats.command("drain", "c")
            self.assertEqual(code, 0, said)
            self.check_all_are_back(clients, louse, 2)
            self.assertEqual(self.owner(), "b")
            status = self.nats.command("status")[1]
            self.assertEqual(status.count("takes no rooms any more"), 2, status)
            code, said = self.nats.command("move")  # nobody is left to take them
            self.assertEqual(code, 1, said)
            self.assertEqual(self.owner(), "b")
        self.check_log()

    def test_a_hundred_rooms_are_in_one_log_and_move_together(self):
        maps = ["volcano"] * 100
        first = self.host("a", maps=maps)
        first.wait_for("cluster_owns")
        second = self.host("b", maps=maps)
        second.wait_for("cluster_follows")
        with Clients(4, [first.address, second.address], room="volcano-100") as clients:
            clients.wait_here()
            self.assertEqual(self.nats.command("status")[1].count("\nroom volcano"), 100)
            louse = {bot.name: bot.welcomes[-1][1]["id"] for bot in clients.bots}
            code, said = self.nats.command("move", "--to", "b")
            self.assertEqual(code, 0, said)
            self.check_all_are_back(clients, louse, 1)
            self.assertIn("100 rooms go on", second.log())
        self.assertIn(" 0 holes", self.nats.command("fsck")[1])

    def test_a_room_that_nobody_takes_goes_on_where_it_was(self):
        """The host that is to take it stands still in the same moment."""
        first, second = self.two_hosts()
        with Clients(4, [first.address]) as clients:
            clients.wait_here()
            second.signal(signal.SIGSTOP)  # it was heard just now
            order = b'{"from":"","to":"b"}'
            nats_wire.Wire(self.nats.ports[0]).say(f"PUB wl.woodlouse.move.main {len(order)}", order)
            clients.wait_for(lambda bot: len(bot.welcomes) >= 2 and bot.newest[0] > bot.welcomes[-1][0],
                             "nobody plays on: " + first.log())
            self.assertEqual(self.owner(), "a")
        self.check_log()

    def test_three_hosts_are_restarted_one_by_one_under_load(self):
        hosts = self.three_hosts()
        with Clients(20, [host.address for host in hosts.values()]) as clients:
            clients.wait_here()
            louse = {bot.name: bot.welcomes[-1][1]["id"] for bot in clients.bots}
            moves = 0
            for name in "abc":
                moves += self.owner() == name
                hosts[name].signal(signal.SIGTERM)
                self.assertEqual(hosts[name].process.wait(stage.PATIENCE), 0)
                hosts[name].process.stdout.close()
                hosts[name] = self.host(name, *ARGUMENTS)
                hosts[name].wait_for("cluster_follows")
                for bot in clients.bots:
                    bot.addresses = [host.address for host in hosts.values()]
                self.check_all_are_back(clients, louse, moves)
                time.sleep(0.5)
            self.assertGreaterEqual(moves, 1)
        self.assertIn(f": {moves + 2} epochs", self.check_log())  # init, the first host, one a move: never two


if __name__ == "__main__":
    stage.skip_where_missing()
    unittest.main(verbosity=2)
