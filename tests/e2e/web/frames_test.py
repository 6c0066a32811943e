"""Batches, answers to the WebSocket's own pings and a close go out on one connection: each frame whole, whatever the reader does."""

import os
import socket
import sys
import time
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "server"))
from hostile_test import TLS  # noqa: E402
from web_test import WebServer, WebSocket  # noqa: E402
import ssl  # noqa: E402


def tls():
    context = ssl.SSLContext(ssl.PROTOCOL_TLS_CLIENT)
    context.check_hostname, context.verify_mode = False, ssl.CERT_NONE
    return context


class Frames(unittest.TestCase):
    def ply(self, page, seconds):
        """Pings of both kinds all the while; reads in fits and starts, so that batches wait half written."""
        page.socket.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 16384)
        asked, end = 0, time.monotonic() + seconds
        while time.monotonic() < end:
            for _ in range(3):
                asked += 1
                page.send_frame(b"%d" % asked, opcode=page.PING)
                page.send({"type": "ping", "t": asked})
            time.sleep(0.05 if asked % 4 else 0.4)
            answered = page.expect("pong")["t"]
            while answered < asked - 6:
                answered = page.expect("pong")["t"]
        while answered < asked:
            answered = page.expect("pong")["t"]
        return asked

    def judge(self, page, asked):
        """What came: receive() has parsed each frame, and each line of it."""
        pongs = [int(payload) for opcode, payload in page.frames if opcode == page.PONG]
        self.assertEqual(pongs, sorted(set(pongs)))
        self.assertEqual([m["t"] for m in page.seen if m["type"] == "pong"], list(range(1, asked + 1)))
        ticks = [m["tick"] for m in page.seen if m["type"] in ("key", "delta")][2:]
        self.assertEqual(ticks, sorted(set(ticks)))
        self.assertGreater(len(ticks), 8)  # he reads slowly
        keys = {m["tick"] for m in page.seen if m["type"] == "key"}
        self.assertLessEqual({m["base"] for m in page.seen if m["type"] == "delta"}, keys)

    def test_a_reader_in_fits_and_starts_that_pings_gets_every_frame_whole(self):
        with WebServer(*TLS, "--bots", "200", "--messages-per-s", "200", "--burst", "400") as server:
            for context in (None, tls()):
                with WebSocket(server, context) as page:
                    page.join("page", fields="all")
                    asked = self.ply(page, 4)
                    self.judge(page, asked)
                    page.send_frame(b"\x03\xe8", opcode=page.CLOSE)
                    while page.receive() is not None:
                        pass
                    self.assertEqual(page.closed, 1000)


if __name__ == "__main__":
    unittest.main()
