"""A client that reads too slowly hurts nobody but itself, and is told what it loses."""

import time
import unittest

from wire import PATIENCE, Reader, Server, share_missed


def heavy_reader(server, name):
    """Joins with the widest rows, and with a receive buffer that fills soon."""
    client = server.client(receive_buffer=4096)
    client.join(name, role="spectator", fields="all", format="exact")
    return client


class SlowReader(unittest.TestCase):
    def test_who_stops_reading_goes_half_rate_keys_only_bye_and_others_see_every_frame(self):
        with Server("--bots", "40") as server, server.player("steady") as steady:
            reader = Reader(steady)
            with heavy_reader(server, "stuck") as stuck:
                server.wait_for_log("ended: slow: you read too slowly, even for keys", 40)
                # What the kernel still held ends with the notices and the bye.
                said = [m for m in stuck.until_end() if m["type"] in ("notice", "error", "bye")]
                codes = [(m["type"], m["code"]) for m in said]
                self.assertEqual(codes, [("notice", "rate_lowered"), ("notice", "keys_only"), ("error", "slow"),
                                         ("bye", "slow")])
            self.assertGreater(len(reader.messages("key", "delta")), 100)
            self.assertLess(share_missed(reader.messages("key", "delta"), 3), 0.05)
            self.assertEqual(reader.messages("notice"), [])

    def test_who_reads_a_little_keeps_its_keys_and_gets_the_rate_back_when_it_catches_up(self):
        with Server("--bots", "40") as server, heavy_reader(server, "slow") as slow:
            # The pace of keys: some 8 KB a second; deltas on top would be 160.
            end = time.monotonic() + 60
            while not any(m.get("code") == "keys_only" for m in slow.seen):
                self.assertLess(time.monotonic(), end, slow.seen[-3:])
                slow.socket.settimeout(PATIENCE)
                slow.pending += slow.socket.recv(2048)
                while b"\n" in slow.pending:
                    slow.receive()
                time.sleep(0.15)
            slow.expect("notice", patience=60, code="rate_lowered")
            slow.expect("notice", patience=60, code="rate_restored")
            # Every delta on the way rested on the key it had: wire.Client asserts it.
            slow.expect("delta")


if __name__ == "__main__":
    unittest.main()
