"""A cluster that shows nobody what its log has not, and logs that no message of NATS has room for.

Usage: strict_test.py [TestCase.test ...]"""

import json
import os
import random
import re
import signal
import tempfile
import time
import unittest

import stage
from faults_test import Cluster


class Strict(Cluster):
    """Nobody is shown what the log has not, and none of it is lost."""
    settings = {"silence_ms": 300, "mode": "strict"}

    def test_no_tick_that_was_seen_is_lost(self):
        owner, other = self.two_hosts()
        with stage.Clients(4, [owner.address, other.address]) as clients:
            for _ in range(2):
                clients.wait_here()
                returns = {bot: len(bot.welcomes) for bot in clients.bots}
                owner.signal(signal.SIGKILL)
                owner.process.wait()
                other.wait_for("goes on from the log of main")
                clients.wait_for(lambda bot: len(bot.welcomes) > returns[bot], "not all came back: " + other.log())
                for bot in clients.bots:
                    seen = max(tick for at, tick in bot.ticks if at < bot.welcomes[-1][0])
                    self.assertLessEqual(seen, other.went_on_at())
                    self.assertTrue(bot.welcomes[-1][1]["resumed"])
                owner, other = other, self.host("c")
                other.wait_for("cluster_follows")
                for bot in clients.bots:
                    bot.addresses = [owner.address, other.address]
        self.check_log()

    def test_nothing_is_played_that_can_not_be_stored(self):
        first, second = self.two_hosts()
        with stage.Clients(4, [first.address]) as clients:
            clients.wait_here()
            self.nats.kill(0)
            time.sleep(1)  # what was on its way has come
            stood = {bot: bot.newest[1] for bot in clients.bots}
            time.sleep(2)
            for bot in clients.bots:
                self.assertEqual(bot.newest[1], stood[bot])
                self.assertEqual((bot.losses, bot.notices), ([], ["paused"]))
            self.nats.start(0)
            clients.wait_for(lambda bot: bot.newest[1] > stood[bot] + 60, "it does not go on: " + first.log())
            for bot in clients.bots:
                self.assertEqual((bot.losses, bot.notices), ([], ["paused", "resumed"]))
            self.assertNotIn("cluster_owns", second.log())
            late = [int(ms) for ms in re.findall(r"came (\d+) ms late", first.log())]  # of a busy machine, not of the wait
            self.assertTrue(all(ms < 1000 for ms in late), first.log())
        self.check_log()


class Long(Cluster):
    def test_rooms_that_no_message_has_room_for_are_in_the_log_as_any_other(self):
        folder = self.enterContext(tempfile.TemporaryDirectory())
        numbers = random.Random(7)
        side, maps = 330, ("long0", "long1", "long2", "long3")
        for name in maps:  # each nearly as long as may be, and nothing that packs well
            heights = [[round(numbers.random(), 6) for _ in range(side)] for _ in range(side)]
            with open(os.path.join(folder, name + ".json"), "w") as out:
                json.dump({"name": name, "terrain": {"origin": [0, 0], "spacing": 20, "heights": heights}, "surface": "spline"}, out)
        first = self.host("a", folder=folder, maps=maps)
        first.wait_for("cluster_owns")
        with stage.Clients(3, [first.address]) as clients:
            clients.wait_here()
            end = time.monotonic() + stage.PATIENCE
            while self.nats.stored() < 1_400_000:
                self.assertLess(time.monotonic(), end, first.log())
            second = self.host("b", folder=folder, maps=maps)  # which begins to read at the parts
            second.wait_for("cluster_follows")
            for bot in clients.bots:
                bot.addresses = [second.address]
            time.sleep(6)  # past a keyframe
            first.signal(signal.SIGKILL)
            second.wait_for("goes on from the log of main", count=len(maps))
            clients.wait_for(lambda bot: len(bot.welcomes) == 2 and bot.welcomes[-1][1]["resumed"], "not all came back: " + second.log())
        self.assertNotIn("cluster_hole", first.log() + second.log())
        self.check_log()


if __name__ == "__main__":
    stage.skip_where_missing()
    unittest.main(verbosity=2)
