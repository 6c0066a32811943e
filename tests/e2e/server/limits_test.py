"""The limits that hello declares hold."""

import socket
import time
import unittest

from wire import PATIENCE, Server, share_missed


class Limits(unittest.TestCase):
    def test_past_the_burst_lines_are_refused_with_the_time_to_wait(self):
        with Server() as server, server.client() as client:
            limits = client.expect("hello")["limits"]
            lines = 2 * limits["burst"]  # they are looked at eight at a time, four times as fast as is allowed for long
            client.send(*[{"type": "ping", "t": i} for i in range(lines)])
            answers = []
            while len(answers) < lines:
                answers.append(client.receive())
            pongs = [m for m in answers if m["type"] == "pong"]
            refused = [m for m in answers if m["type"] == "error"]
            self.assertGreaterEqual(len(pongs), limits["burst"])
            self.assertTrue(refused)
            for error in refused:
                self.assertEqual(error["code"], "rate_limited")
                self.assertFalse(error["fatal"])
            time.sleep(refused[-1]["retry_after_ms"] / 1000 + 0.05)
            client.send({"type": "ping", "t": -1})
            client.expect("pong", t=-1)

    def test_a_sustained_flood_ends_the_connection_and_nobody_else_notices(self):
        with Server("--bots", "1") as server, server.player("steady") as steady, server.player("flood") as flood:
            steady.expect("delta")
            try:
                for _ in range(200):
                    flood.send_bytes(b'{"type":"ping","t":1}\n' * 100)
            except OSError:
                pass  # it was cut off in the middle, as it should be
            ends = [m for m in flood.until_end() if m["type"] == "bye"]
            self.assertEqual([m["code"] for m in ends], ["flood"])
            steady.expect("event", kind="left", name="flood")
            for _ in range(20):
                steady.expect("delta")
            self.assertLess(share_missed(steady.seen, 3), 0.05)

    def test_the_rate_that_hello_declares_is_never_refused(self):
        with Server() as server, server.client() as client:
            limits = client.expect("hello")["limits"]
            period = 1.0 / limits["messages_per_s"]
            begun = time.monotonic()
            count = 4 * limits["messages_per_s"]
            for i in range(count):
                time.sleep(max(0.0, begun + i * period - time.monotonic()))
                client.send({"type": "ping", "t": i})
            kinds = set()
            while True:
                message = client.receive()
                kinds.add(message["type"])
                if message.get("t") == count - 1:
                    break
            self.assertEqual(kinds, {"pong"})

    def test_chat_weighs_more_because_it_goes_out_to_everybody(self):
        with Server() as server, server.player() as player:
            player.send(*[{"type": "chat", "text": "spam"}] * 40)
            player.expect("error", code="rate_limited")
            chats = sum(m["type"] == "event" and m["kind"] == "chat" for m in player.seen)
            self.assertLessEqual(chats, 30)

    def test_who_never_joins_is_sent_away_after_the_handshake_time(self):
        with Server() as server, server.client() as silent, server.client() as chatty:
            seconds = silent.expect("hello")["limits"]["handshake_s"]
            begun = time.monotonic()
            chatty.send({"type": "list"})
            for client in (silent, chatty):
                ends = client.until_end(seconds + PATIENCE)[-2:]
                self.assertEqual([(m["type"], m["code"]) for m in ends],
                                 [("error", "handshake_timeout"), ("bye", "handshake_timeout")])
            self.assertGreater(time.monotonic() - begun, seconds - 1)

    def test_a_half_closed_connection_is_a_gone_one(self):
        with Server() as server, server.player("eye", role="spectator") as eye, server.player("half") as half:
            half.socket.shutdown(socket.SHUT_WR)
            eye.expect("event", kind="left", name="half")

    def test_an_address_gets_its_share_of_connections_and_the_next_is_told(self):
        with Server() as server, server.client() as first:
            share = first.expect("hello")["limits"]["per_address"]
            others = [server.client() for _ in range(share - 1)]
            others[-1].expect("hello")
            with server.client() as refused:
                messages = refused.until_end()
                self.assertEqual([(m["type"], m["code"]) for m in messages],
                                 [("error", "too_many_connections"), ("bye", "too_many_connections")])
            others.pop().socket.close()
            # The server sees the closing a moment later.
            end = time.monotonic() + PATIENCE
            while True:
                with server.client() as again:
                    if again.receive()["type"] == "hello":
                        break
                self.assertLess(time.monotonic(), end)
            for client in others:
                client.socket.close()


if __name__ == "__main__":
    unittest.main()
