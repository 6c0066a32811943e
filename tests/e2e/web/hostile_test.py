"""Who asks badly at --web: slowly, for too much, for what is not his, or not in the protocol's words. Each is refused, nothing of
what he said comes back, and who plays beside him is shown every frame in its order."""

import os
import resource
import socket
import ssl
import struct
import sys
import time
import unittest

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(HERE, "..", "server"))
from crowd import frames_missed_in_a_row  # noqa: E402
from web_test import CERTIFICATES, WebServer, WebSocket, is_closed_in_silence  # noqa: E402
from wire import PATIENCE, Client, Reader  # noqa: E402

HOSTILE, OTHER = "127.0.0.9", "127.0.0.2"
WORD = b"marzipan"  # what nobody wants to read again
TLS = ("--tls-cert", os.path.join(CERTIFICATES, "first_certificate.pem"), "--tls-key", os.path.join(CERTIFICATES, "first_key.pem"))


class Healthy:
    """Two beside the attack, from an address of their own: a player of --listen and a page's socket. They have played on when
    it is over: frames in order, hardly one left out, and an answer to each input, in order."""

    def __init__(self, test, server):
        self.test = test
        self.player = server.player("mara", source=OTHER)
        self.page = WebSocket(server)
        self.page.join("page")
        self.readers = [Reader(client) for client in (self.player, self.page)]
        self.seq = 0

    def play(self):
        self.seq += 1
        for reader in self.readers:
            reader.client.send({"type": "input", "seq": self.seq, "thrust": 0.5})

    def __enter__(self):
        self.play()
        return self

    def __exit__(self, kind, *_):
        try:
            if kind is None:
                self.judge()
        finally:
            for reader in self.readers:
                reader.client.socket.shutdown(socket.SHUT_RDWR)
                reader.join(PATIENCE)
                reader.client.socket.close()

    def judge(self):
        self.play()
        end = time.monotonic() + PATIENCE
        for reader in self.readers:
            begun = len(reader.messages("key", "delta"))
            while len(reader.messages("key", "delta")) < begun + 20:
                self.test.assertTrue(reader.is_alive() and time.monotonic() < end, "no further frames")
                time.sleep(0.01)
            ticks = [m["tick"] for m in reader.messages("key", "delta")][2:]
            self.test.assertEqual(ticks, sorted(set(ticks)))
            self.test.assertLessEqual(frames_missed_in_a_row(list(reader.client.seen)), 1)
            self.test.assertEqual([m["seq"] for m in reader.messages("ack")], list(range(1, self.seq + 1)))


def said(client):
    """All that comes until the end."""
    data = b""
    try:
        while part := client.socket.recv(65536):
            data += part
    except (ConnectionResetError, ssl.SSLError):
        pass
    return data


def status_of(answer):
    return int(answer.split(b" ", 2)[1]) if answer.startswith(b"HTTP/1.1 ") else None


class Hostile(unittest.TestCase):
    def visit(self, server, source=HOSTILE):
        client = Client(server.host, server.web_port, source=source)
        self.addCleanup(client.socket.close)
        return client

    def ask(self, server, head):
        client = self.visit(server)
        try:
            client.send_bytes(head)
        except OSError:
            pass  # it was not read to its end
        return said(client)

    def test_who_is_slow_is_ended_however_he_goes_about_it(self):
        with WebServer(*TLS, "--handshake-s", "1") as server, Healthy(self, server) as healthy:
            slow = {
                "nothing": b"", "a method": b"GET / HT", "a head without an end": b"GET / HTTP/1.1\r\nHost: localhost\r\n",
                "half a TLS hello": b"\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03" + os.urandom(20), "a TLS record's type": b"\x16",
            }
            waiting = {}
            for name, data in slow.items():
                waiting[name] = self.visit(server)
                waiting[name].send_bytes(data)
            # A byte from time to time is no head: it is the whole that has its time.
            trickle = self.visit(server)
            trickle.send_bytes(b"GET / HTTP/1.1\r\nX: ")
            bytes_sent, ended = 0, time.monotonic() + PATIENCE
            trickle.socket.setblocking(False)
            while time.monotonic() < ended:
                try:
                    if trickle.socket.recv(1) == b"":
                        break
                except BlockingIOError:
                    trickle.socket.send(b"x")
                    bytes_sent += 1
                    healthy.play()
                    time.sleep(0.5)
                except ConnectionResetError:
                    break
            self.assertLess(time.monotonic(), ended, "the trickle was listened to")
            self.assertGreater(bytes_sent, 3)
            # A head inside of TLS that stays away, and a page that opens a session and says nothing.
            context = ssl.create_default_context()
            context.check_hostname, context.verify_mode = False, ssl.CERT_NONE
            inside = self.visit(server)
            inside.socket = context.wrap_socket(inside.socket)
            self.addCleanup(inside.socket.close)
            silent = WebSocket(server)
            self.addCleanup(silent.socket.close)
            self.assertEqual(silent.until_end()[-1]["code"], "handshake_timeout")
            for name, client in waiting.items():
                client.socket.settimeout(PATIENCE)
                self.assertTrue(is_closed_in_silence(client), name)
            self.assertEqual(said(inside), b"")

    def test_heads_that_are_too_long(self):
        with WebServer() as server, Healthy(self, server):
            for head in (b"GET / HTTP/1.1\r\nHost: localhost\r\nX: " + b"x" * 8193 + b"\r\n\r\n",
                         b"GET /" + b"x" * 8193 + b" HTTP/1.1\r\nHost: localhost\r\n\r\n",
                         b"GET / HTTP/1.1\r\n" + b"X: y\r\n" * 2000 + b"\r\n", b"G" * 8193,
                         b"GET / HTTP/1.1\r\nHost: localhost\r\n" + b"x" * 100_000):
                answer = self.ask(server, head)
                self.assertIn(status_of(answer), (431, 400), head[:40])
                self.assertNotIn(b"xxxx", answer)
            # Just as long as a head may be.
            start = b"GET /healthz HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\nX: "
            fits = start + b"x" * (8192 - len(start) - 4) + b"\r\n\r\n"
            self.assertEqual(status_of(self.ask(server, fits)), 200)

    def test_a_thousand_sockets_of_one_address(self):
        soft, hard = resource.getrlimit(resource.RLIMIT_NOFILE)
        resource.setrlimit(resource.RLIMIT_NOFILE, (min(hard, max(soft, 4096)), hard))
        self.addCleanup(resource.setrlimit, resource.RLIMIT_NOFILE, (soft, hard))
        request = b"GET /healthz HTTP/1.1\r\nHost: localhost\r\n\r\n"
        with WebServer() as server, Healthy(self, server):
            statuses = {}
            clients = [self.visit(server) for _ in range(1000)]
            for client in clients:
                try:
                    client.send_bytes(request)
                    answer = client.socket.recv(4096)
                except (BrokenPipeError, ConnectionResetError):
                    answer = b""
                status = status_of(answer)
                statuses[status] = statuses.get(status, 0) + 1
            # 128 of HTTP at a time; no more than 256 and those that are told why are let in at all, though who was refused makes room.
            self.assertEqual(statuses[200], 128, statuses)
            self.assertEqual(sum(statuses.values()), 1000)
            self.assertLessEqual(set(statuses), {200, 503, None})
            self.assertGreater(statuses[503], 0)
            # Others are let in meanwhile, and the same one once they have gone.
            self.assertEqual(server.ask("GET", "/healthz")[0], 200)
            for client in clients:
                client.socket.close()
            end = time.monotonic() + PATIENCE
            while status_of(self.ask(server, request.replace(b"\r\n\r\n", b"\r\nConnection: close\r\n\r\n"))) != 200:
                self.assertLess(time.monotonic(), end)
                time.sleep(0.05)

    def test_frames_that_break_the_rules(self):
        giant = struct.pack("!BBQ", 0x81, 0xff, 1 << 30) + b"mask"
        with WebServer() as server, Healthy(self, server):
            for name, code, say in (
                    ("1 GB", 1009, lambda s: s.send_bytes(giant)),
                    ("1 GB in parts", 1009, lambda s: s.send_bytes(b"\x01" + giant[1:])),
                    ("more than 2^63", 1009, lambda s: s.send_bytes(struct.pack("!BBQ", 0x81, 0xff, 1 << 63) + b"mask")),
                    ("unmasked", 1002, lambda s: s.send_frame(b'{"type":"list"}', masked=False)),
                    ("a ping of 126 bytes", 1002, lambda s: s.send_frame(b"x" * 126, opcode=s.PING)),
                    ("a ping in parts", 1002, lambda s: s.send_frame(b"x", opcode=s.PING, final=False)),
                    ("what goes on without a beginning", 1002, lambda s: s.send_frame(b"{}", opcode=0)),
                    ("a reserved bit", 1002, lambda s: s.send_frame(b"{}", first_bits=0x20)),
                    ("a close of one byte", 1002, lambda s: s.send_frame(b"\x03", opcode=s.CLOSE)),
                    ("no UTF-8", 1007, lambda s: s.send_frame(b'{"type":"\xed\xa0\x80"}'))):
                bad = WebSocket(server)
                self.addCleanup(bad.socket.close)
                bad.expect("hello")
                say(bad)
                bad.until_end()
                self.assertEqual(bad.closed, code, name)

    def test_what_is_no_text_behind_a_goodbye(self):
        context = ssl.create_default_context()
        context.check_hostname, context.verify_mode = False, ssl.CERT_NONE
        with WebServer(*TLS) as server, Healthy(self, server):
            for tls in (None, context):
                for last in ({"type": "leave"}, {"type": "join", "protocol": 99, "name": "x"}):
                    for opcodes in ((WebSocket.BINARY,), (WebSocket.BINARY,) * 3, (WebSocket.PING, WebSocket.BINARY), (WebSocket.CLOSE, WebSocket.BINARY)):
                        page = WebSocket(server, tls)
                        self.addCleanup(page.socket.close)
                        try:
                            page.send(last)
                            for opcode in opcodes:
                                page.send_frame(b"hi" if opcode != WebSocket.CLOSE else b"\x03\xe8", opcode)
                            page.until_end()
                        except (OSError, ssl.SSLError):
                            pass  # it has hung up
            self.assertIsNone(server.process.poll(), server.log())

    def test_pages_that_may_not(self):
        with WebServer() as server, Healthy(self, server):
            for fields in ({"Origin": "null"}, {"Origin": "http://evil.example.org"}, {"Origin": ""}, {"Origin": "file://"},
                           {"Origin": server.url.rstrip("/").replace("http:", "https:")}, {"Origin": "http://127.0.0.1.evil.org"},
                           {"Host": "evil.example.org"}, {"Host": ""}, {"Sec-WebSocket-Version": "8"}, {"Sec-WebSocket-Key": ""},
                           {"Upgrade": "h2c"}):
                page = WebSocket(server, **fields)
                self.addCleanup(page.socket.close)
                self.assertTrue(400 <= page.status < 500, (fields, page.status))
            twice = (f"GET /ws HTTP/1.1\r\nHost: {server.host}:{server.web_port}\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
                     "Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: AAAAAAAAAAAAAAAAAAAAAA==\r\n"
                     f"Origin: {server.url[:-1]}\r\nOrigin: null\r\n\r\n").encode()
            self.assertEqual(status_of(self.ask(server, twice)), 403)
            # Who sends before he was let in may want another to read it.
            early = twice.replace(b"Origin: null\r\n", b"") + b'\x81\x02{}'
            self.assertEqual(status_of(self.ask(server, early)), 403)

    def test_nothing_of_what_was_asked_comes_back(self):
        asked = [b"GET /%b HTTP/1.1\r\nHost: localhost\r\n\r\n", b"GET /?%b HTTP/1.1\r\nHost: localhost\r\n\r\n",
                 b"GET / HTTP/1.1\r\nHost: %b.example.org\r\n\r\n", b"GET / HTTP/1.1\r\nHost: localhost\r\nHost: %b\r\n\r\n",
                 b"GET / HTTP/1.1\r\nHost: localhost\r\n%b: 1\r\nCookie: %b\r\n\r\n", b"%b / HTTP/1.1\r\nHost: localhost\r\n\r\n",
                 b"POST /%b HTTP/1.1\r\nHost: localhost\r\nContent-Length: 8\r\n\r\n%b", b"GET / HTTP/1.1\r\n%b\r\n\r\n",
                 b"GET http://%b/ HTTP/1.1\r\nHost: localhost\r\n\r\n", b"GET / HTTP/%b\r\nHost: localhost\r\n\r\n",
                 b"GET /../../%b HTTP/1.1\r\nHost: localhost\r\n\r\n", b"GET /%%00%b HTTP/1.1\r\nHost: localhost\r\n\r\n",
                 b"GET /<script>%b</script> HTTP/1.1\r\nHost: localhost\r\n\r\n", b"CONNECT %b:443 HTTP/1.1\r\nHost: localhost\r\n\r\n",
                 b"TRACE / HTTP/1.1\r\nHost: localhost\r\nX: %b\r\n\r\n", b"OPTIONS * HTTP/1.1\r\nHost: localhost\r\nX: %b\r\n\r\n",
                 b"GET /ws HTTP/1.1\r\nHost: localhost\r\nUpgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Version: 13\r\n"
                 b"Sec-WebSocket-Key: AAAAAAAAAAAAAAAAAAAAAA==\r\nOrigin: http://%b.org\r\n\r\n",
                 b"GET / HTTP/1.1\r\nHost: localhost\r\nTransfer-Encoding: chunked\r\n\r\n8\r\n%b\r\n0\r\n\r\n",
                 b"GET / HTTP/1.1\r\nHost: localhost\r\nContent-Length: 0\r\nContent-Length: 8\r\n\r\n%b"]
        with WebServer("--log-level", "debug") as server, Healthy(self, server):
            for head in asked:
                head = head.replace(b"%b", WORD).replace(b"%%", b"%").replace(b"\r\n\r\n", b"\r\nConnection: close\r\n\r\n", 1)
                answer = self.ask(server, head)
                self.assertNotIn(WORD, answer, head)
                status = status_of(answer)
                known = head.startswith((b"GET /?", b"GET / HTTP/1.1\r\nHost: localhost\r\nmarzipan:"))
                self.assertEqual(status == 200, known, (head, answer[:100]))
            self.assertNotIn(WORD.decode(), server.log())


if __name__ == "__main__":
    unittest.main()
