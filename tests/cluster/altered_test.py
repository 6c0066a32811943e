"""What becomes of a log that somebody has altered: on NATS' disk, or by a batch of his own. Nobody goes on from it, and whoever asks is
told where.

Usage: altered_test.py [TestCase.test ...]"""

import glob
import json
import os
import re
import signal
import sys
import time
import unittest

import faults_test
import nats_wire
import stage

ZSTD = b"\x28\xb5\x2f\xfd"  # a batch begins with it


class Altered(faults_test.Cluster):
    settings = {"silence_ms": 500}

    def check_players_saw_nothing(self, clients):
        for bot in clients.bots:
            self.assertEqual((len(bot.losses), len(bot.welcomes)), (0, 1))
            self.assertLess(time.monotonic() - bot.newest[0], 2)


class Disk(Altered):
    def alter(self, behind):
        """Flips a bit of a batch on the disk of NATS, which is away meanwhile: the last one, or so many before it."""
        self.nats.kill(0, signal.SIGTERM)
        time.sleep(1)  # nothing is on its way any more
        blocks = glob.glob(os.path.join(self.nats.store(0), "**", "*.blk"), recursive=True)
        self.assertEqual(len(blocks), 1, blocks)
        with open(blocks[0], "r+b") as block:
            data = block.read()
            batches = [found.start() for found in re.finditer(re.escape(ZSTD), data)]
            self.assertGreater(len(batches), behind + 1)
            place = batches[-1 - behind] + 60
            block.seek(place)
            block.write(bytes([data[place] ^ 1]))
        self.nats.start(0)

    def check_hole(self):
        """The batch is named, and what stands before and behind it is proven."""
        code, said, proofs = self.nats.joined()
        self.assertEqual(code, 1, said)
        self.assertRegex(said, r"batch \d+: is gone from the log")
        self.assertRegex(said, r"room volcano: HOLE: ticks \d+ to \d+ are missing\n")
        self.assertEqual(len(proofs), 2, said)
        for name, (verified, text) in proofs.items():
            self.assertEqual(verified, 0, f"{name}: {text}")

    def test_a_batch_is_altered(self):
        """NATS gives it out no more. Who stands by has read it, the owner goes on behind it."""
        first, second = self.two_hosts()
        with stage.Clients(4, [first.address]) as clients:
            clients.wait_here()
            time.sleep(3)
            self.alter(10)
            time.sleep(6)  # past the owner's next keyframe
            self.check_players_saw_nothing(clients)
            self.assertIn("host b at " + second.address + ": stands by", self.nats.command("status")[1])
            self.assertNotIn("DIFFERS", second.log())
            self.assertNotIn("HOLE", first.log())
            self.check_hole()

    def test_a_batch_is_altered_while_all_hosts_are_away(self):
        """It stands behind the newest keyframe: the room goes on at the tick before it."""
        first = self.host("a")
        first.wait_for("cluster_owns")
        with stage.Clients(4, [first.address]) as clients:
            clients.wait_here()
            time.sleep(7)
            louse = {bot.name: bot.welcomes[-1][1]["id"] for bot in clients.bots}
            stored = self.nats.tick()
            self.assertGreater(stored, 360)
            first.signal(signal.SIGKILL)
            first.process.wait()
            self.alter(4)
            self.nats.wait_there(0)
            second = self.host("b")
            for bot in clients.bots:
                bot.addresses = [second.address]
            clients.wait_for(lambda bot: len(bot.welcomes) == 2, "not all came back: " + second.log())
            went_on = second.went_on_at()
            self.assertIn(f"LOG HAS A HOLE: room volcano goes on at tick {went_on}, before a batch that is gone", second.log())
            self.assertTrue(stored - 90 < went_on < stored, (went_on, stored))
            for bot in clients.bots:
                self.assertEqual((bot.welcomes[-1][1]["resumed"], bot.welcomes[-1][1]["id"]), (True, louse[bot.name]))
            time.sleep(1)
        _, said, proofs = self.nats.joined()
        self.assertRegex(said, r"batch \d+: is gone from the log")
        self.assertEqual([verified for verified, _ in proofs.values()], [0], said)

    def test_the_last_batch_is_altered(self):
        """The owner finds nothing of its own at the end of the log: it goes on in another epoch, and tells its rooms anew."""
        first, second = self.two_hosts()
        with stage.Clients(4, [first.address]) as clients:
            clients.wait_here()
            time.sleep(3)
            self.alter(0)
            first.wait_for("LOG HAS A HOLE")
            time.sleep(2)
            self.check_players_saw_nothing(clients)
            code, said = self.nats.command("status")
            self.assertEqual(code, 0, said)
            self.assertIn("its last batch is that of epoch 2 of a", said)
            self.assertIn("host b at " + second.address + ": stands by", said)
            self.assertNotIn("DIFFERS", second.log())
            self.check_hole()
            louse = {bot.name: bot.welcomes[-1][1]["id"] for bot in clients.bots}
            for bot in clients.bots:
                bot.addresses = [second.address]
            first.signal(signal.SIGKILL)
            clients.wait_for(lambda bot: len(bot.welcomes) == 2, "not all came back: " + second.log())
            for bot in clients.bots:
                self.assertEqual((bot.welcomes[-1][1]["resumed"], bot.welcomes[-1][1]["id"]), (True, louse[bot.name]))


class Forged(Altered):
    settings = {"silence_ms": 2000}  # longer than an owner is stopped here

    def forge(self, owner):
        """Adds a batch in the owner's name, while it is stopped for a moment: its next one, but the hash of a tick is another one. The
        tick that it leads to."""
        owner.signal(signal.SIGSTOP)
        try:
            with nats_wire.Wire(self.nats.ports[0]) as wire:
                (sequence, frame), before = wire.last("WL_woodlouse_main", "wl.woodlouse.log.main"), 0
                while sequence != before:  # one that was sent before it stopped may still be on its way
                    time.sleep(0.3)
                    before, (sequence, frame) = sequence, wire.last("WL_woodlouse_main", "wl.woodlouse.log.main")
                head, *lines = nats_wire.unpacked(frame).decode().splitlines()
                head = json.loads(head)
                last = next(line for line in reversed(lines) if line.startswith('{"step":'))
                tick = int(re.match(r'\{"step":(\d+)', last)[1]) + int((re.search(r'"steps":(\d+)', last) or [0, 1])[1])
                head["batch"] += 1
                lines = [json.dumps({"room": "volcano"}, separators=(",", ":")), f'{{"step":{tick},"hash":"{0x1234567890abcdef:016x}"}}']
                text = "".join(line + "\n" for line in [json.dumps(head, separators=(",", ":")), *lines])
                answer = wire.ask("wl.woodlouse.log.main", nats_wire.packed(text.encode()))
                self.assertEqual(answer["seq"], sequence + 1, answer)
        finally:
            owner.signal(signal.SIGCONT)
        return tick + 1

    def test_a_forged_batch_is_named_by_room_and_tick_and_nobody_goes_on_from_it(self):
        first, second = self.two_hosts()
        with stage.Clients(4, [first.address]) as clients:
            clients.wait_here()
            tick = self.forge(first)
            second.wait_for("FOLLOWER DIFFERS")
            self.assertIn(f"FOLLOWER DIFFERS: room volcano: tick {tick}: ", second.log())
            time.sleep(6)  # past the owner's next keyframe
            self.check_players_saw_nothing(clients)
            self.assertIn("host b at " + second.address + ": CAN'T TAKE OVER", self.nats.command("status")[1])
            code, said, proofs = self.nats.joined()
            self.assertEqual(code, 1, said)
            self.assertIn(f"the log differs: room volcano: tick {tick}: ", said)
            self.assertNotEqual(proofs["volcano.ndjson"][0], 0, proofs)
            self.assertIn(str(tick), proofs["volcano.ndjson"][1])

            for bot in clients.bots:
                bot.addresses = [second.address]
            first.signal(signal.SIGKILL)
            first.process.wait()
            time.sleep(6)
            self.assertNotIn("cluster_owns", second.log())
            second.end()
            again = self.host("b")  # it begins at the keyframe behind the forged batch
            for bot in clients.bots:
                bot.addresses = [again.address]
            clients.wait_for(lambda bot: len(bot.welcomes) == 2 and bot.welcomes[-1][1]["resumed"], "not all came back: " + again.log())
            self.assertGreater(again.went_on_at(), tick)
            self.assertNotIn("DIFFERS", again.log())


if __name__ == "__main__":
    stage.skip_where_missing()
    if not hasattr(unittest.TestCase, "enterContext"):  # Python 3.11 has it
        sys.exit("Python 3.11 is needed")
    unittest.main(verbosity=2)
