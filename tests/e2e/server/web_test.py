"""The port on which the client speaks first: lines, HTTP, WebSockets, and what is none of them."""

import base64
import hashlib
import http.client
import json
import os
import shutil
import signal
import socket
import ssl
import struct
import tempfile
import unittest

from wire import PATIENCE, Client, Server

CERTIFICATES = os.path.join(os.path.dirname(__file__), "..", "..", "tls")
PING = b'{"type":"ping","t":1}\n'


class WebServer(Server):
    """A server with a web port, whose address it prints in its second line."""

    def __init__(self, *arguments, web="127.0.0.1:0", **options):
        super().__init__("--web", web, *arguments, **options)
        second = self.process.stdout.readline()
        if not second.startswith("web http://") or not second.endswith("/\n"):
            raise AssertionError("no `web`: " + second + self.log())
        self.url = second.split()[1]
        self.web_port = int(self.url.rstrip("/").rsplit(":", 1)[1])

    def web(self):
        return Client(self.host, self.web_port)

    def socket(self, tls=None, **headers):
        return WebSocket(self, tls, **headers)

    def ask(self, method, path, **headers):
        """One request: (status, the answer's fields, its body)."""
        connection = http.client.HTTPConnection(self.host, self.web_port, timeout=PATIENCE)
        connection.request(method, path, headers=headers)
        answer = connection.getresponse()
        body = answer.read().decode()
        connection.close()
        return answer.status, answer.headers, body


class WebSocket(Client):
    """A WebSocket made by hand. Lines come as on any connection; `closed` is the code of the close frame that came."""

    TEXT, BINARY, CLOSE, PING, PONG = 1, 2, 8, 9, 10

    def __init__(self, server, tls=None, source=None, **headers):
        super().__init__(server.host, server.web_port, source=source)
        self.socket = tls.wrap_socket(self.socket) if tls else self.socket
        self.bytes_read = b""
        self.frames = []
        self.closed = None
        key = base64.b64encode(os.urandom(16)).decode()
        fields = {"Host": f"{server.host}:{server.web_port}", "Upgrade": "websocket", "Connection": "Upgrade",
                  "Sec-WebSocket-Key": key, "Sec-WebSocket-Version": "13", **headers}
        head = "".join(f"{name}: {value}\r\n" for name, value in fields.items())
        self.socket.sendall(f"GET /ws HTTP/1.1\r\n{head}\r\n".encode())
        while b"\r\n\r\n" not in self.bytes_read:
            self.bytes_read += self.socket.recv(4096)
        answer, self.bytes_read = self.bytes_read.split(b"\r\n\r\n", 1)
        self.status = int(answer.split()[1])
        if self.status == 101:
            accepted = hashlib.sha1((key + "258EAFA5-E914-47DA-95CA-C5AB0DC85B11").encode()).digest()
            assert base64.b64encode(accepted) in answer, answer

    def send(self, *messages):
        for message in messages:
            self.send_frame(json.dumps(message).encode())

    def send_frame(self, payload, opcode=TEXT, final=True, masked=True, first_bits=0):
        size = len(payload)
        long = size if size < 126 else 126 if size < 65536 else 127
        head = struct.pack("!BB", final << 7 | first_bits | opcode, masked << 7 | long)
        head += b"" if size < 126 else struct.pack("!H" if size < 65536 else "!Q", size)
        mask = os.urandom(4) if masked else b""
        self.socket.sendall(head + mask + bytes(b ^ mask[i % 4] if mask else b for i, b in enumerate(payload)))

    def take(self, size):
        while len(self.bytes_read) < size:
            data = self.socket.recv(65536)
            if not data:
                raise EOFError
            self.bytes_read += data
        taken, self.bytes_read = self.bytes_read[:size], self.bytes_read[size:]
        return taken

    def receive_frame(self):
        first, size = self.take(2)
        assert first & 0x80 and size < 128, "the server's frames are whole and not masked"
        if size > 125:
            size, = struct.unpack("!H", self.take(2)) if size == 126 else struct.unpack("!Q", self.take(8))
        frame = first & 0x0f, self.take(size)
        self.frames.append(frame)
        return frame

    def receive(self):
        while b"\n" not in self.pending:
            try:
                opcode, payload = self.receive_frame()
            except (EOFError, ConnectionResetError):
                return None
            if opcode == self.CLOSE:
                self.closed = struct.unpack("!H", payload[:2])[0]
                return None
            if opcode == self.TEXT:
                assert payload.endswith(b"\n"), "whole lines alone"
                self.pending += payload
        return super().receive()


def is_closed_in_silence(client):
    try:
        return client.socket.recv(1) == b""
    except ConnectionResetError:  # what it said was not read
        return True


class Lines(unittest.TestCase):
    def test_hello_follows_the_first_line_and_then_it_is_as_on_the_other_port(self):
        with WebServer() as server, server.web() as client, server.client() as other:
            other.expect("hello")
            client.socket.settimeout(0.3)
            self.assertRaises(TimeoutError, client.socket.recv, 1)
            client.socket.settimeout(PATIENCE)
            client.send_bytes(PING)
            self.assertEqual(client.receive()["type"], "hello")
            self.assertEqual(client.receive(), {"type": "pong", "t": 1})
            client.join()
            client.send({"type": "input", "seq": 1, "thrust": 1})
            client.expect("ack", seq=1)
            client.expect("delta")
            client.send({"type": "leave"})
            self.assertEqual(client.until_end()[-1]["code"], "left")

    def test_who_joins_at_once_is_told_hello_first(self):
        with WebServer() as server, server.web() as client:
            client.join()
            self.assertEqual(client.seen[0]["type"], "hello")
            self.assertEqual(client.seen[1]["type"], "welcome")

    def test_what_nobody_speaks_here_is_closed_without_a_word(self):
        with WebServer() as server:
            for said in (b"\x00", b"hello\n", b"\x80\x81"):
                with server.web() as client:
                    client.send_bytes(said)
                    self.assertTrue(is_closed_in_silence(client))

    def test_who_still_says_nothing_when_the_server_stops_keeps_it_from_nothing(self):
        with WebServer() as server, server.web() as silent, server.web() as client:
            client.join()
            code, seconds, _ = server.stop()
            self.assertEqual(code, 0)
            self.assertEqual(client.until_end()[-1]["code"], "shutdown")
            self.assertTrue(is_closed_in_silence(silent))
            self.assertNotIn("did not stop", server.log())

    def test_connections_of_both_ports_count_together(self):
        with WebServer("--per-address", "2") as server, server.client(), server.web() as second:
            second.send_bytes(PING)
            second.expect("pong")
            with server.web() as third:
                third.send_bytes(PING)
                ends = third.until_end()
                self.assertEqual([(m["type"], m["code"]) for m in ends],
                                 [("error", "too_many_connections"), ("bye", "too_many_connections")])

    def test_http_on_the_port_of_lines_is_told_where_the_page_is(self):
        with WebServer() as server, server.client() as client:
            client.send_bytes(b"GET / HTTP/1.1\r\n")
            self.assertIn("open " + server.url, client.expect("error", code="bad_json")["text"])
        with Server() as server, server.client() as client:
            client.send_bytes(b"GET / HTTP/1.1\r\n")
            self.assertIn("--web", client.expect("error", code="bad_json")["text"])


class Http(unittest.TestCase):
    def test_two_requests_on_one_socket(self):
        with WebServer() as server:
            connection = http.client.HTTPConnection(server.host, server.web_port, timeout=PATIENCE)
            connection.request("GET", "/about")
            page = connection.getresponse()
            text, kept = page.read().decode(), connection.sock
            connection.request("GET", "/rooms")
            rooms = json.loads(connection.getresponse().read())
            self.assertIs(connection.sock, kept)
            connection.close()
            self.assertTrue(page.headers["Content-Type"].startswith("text/html"))
            self.assertIn("default-src 'none'", page.headers["Content-Security-Policy"])
            self.assertEqual(page.headers["X-Content-Type-Options"], "nosniff")
            self.assertEqual(page.headers["Cross-Origin-Opener-Policy"], "same-origin")
            self.assertIn(f"nc {server.host} {server.port}", text)
            self.assertEqual([room["name"] for room in rooms], ["volcano"])

    def test_what_is_asked_is_answered_and_nothing_of_it_comes_back(self):
        with WebServer("--web-host", "lice.example.org") as server:
            self.assertEqual(server.ask("GET", "/healthz")[::2], (200, "ok\n"))
            self.assertEqual(server.ask("GET", "/readyz")[0], 200)
            status, headers, body = server.ask("HEAD", "/")
            self.assertEqual((status, body), (200, ""))
            self.assertGreater(int(headers["Content-Length"]), 100)
            status, headers, _ = server.ask("POST", "/")
            self.assertEqual((status, headers["Allow"]), (405, "GET, HEAD"))
            status, _, body = server.ask("GET", "/marzipan")
            self.assertEqual(status, 404)
            self.assertNotIn("marzipan", body)
            self.assertEqual(server.ask("GET", "/", Host="lice.example.org")[0], 200)
            status, _, body = server.ask("GET", "/", Host="evil.example.org")
            self.assertEqual(status, 403)
            self.assertIn("--web-host", body)
            self.assertEqual(server.ask("GET", "/", A="a" * 8193)[0], 431)

    def test_an_address_has_so_many_sockets_of_http(self):
        with WebServer() as server:
            kept = []
            for _ in range(129):
                connection = http.client.HTTPConnection(server.host, server.web_port, timeout=PATIENCE)
                connection.request("GET", "/healthz")
                answer = connection.getresponse()
                answer.read()
                kept.append(connection)
            self.assertEqual(answer.status, 503)
            with server.client() as client:
                client.join()
            for connection in kept:
                connection.close()

    def test_slow_heads_hold_up_nobody_and_no_end(self):
        with WebServer() as server, server.web() as slow, server.client() as player:
            slow.send_bytes(b"GET / HT")
            player.join()
            self.assertEqual(server.ask("GET", "/healthz")[0], 200)
            slow.send_bytes(b"TP/1.1\r\nHost: localhost\r\n\r\n")
            self.assertTrue(slow.socket.recv(4096).startswith(b"HTTP/1.1 200 "))
            self.assertEqual(server.stop()[0], 0)
            self.assertNotIn("did not stop", server.log())


class WebSockets(unittest.TestCase):
    def test_a_game_over_a_websocket(self):
        with WebServer() as server, server.socket(Origin="http://127.0.0.1:1") as stranger:
            self.assertEqual(stranger.status, 403)
            with server.socket(**{"Sec-WebSocket-Version": "12"}) as old:
                self.assertGreaterEqual(old.status, 400)
            with server.socket(Origin=server.url.rstrip("/")) as page:
                page.expect("hello")
                page.join()
                page.expect("delta")
                page.send({"type": "input", "seq": 1, "thrust": 1})
                page.expect("ack", seq=1)
                page.send_frame(b'{"type":"pi', final=False)
                page.send_frame(b"", opcode=0, final=False)
                page.send_frame(b"between", opcode=page.PING)
                page.send_frame(b'ng","t":7}', opcode=0)
                page.expect("pong", t=7)
                self.assertIn((page.PONG, b"between"), page.frames)
                page.send({"type": "leave"})
                self.assertEqual(page.until_end()[-1]["code"], "left")
                self.assertEqual(page.closed, 1000)

    def test_a_websocket_that_is_closed_or_gone_leaves_the_room(self):
        with WebServer() as server, server.player("eye", role="spectator") as eye:
            with server.socket() as page, server.socket() as other:
                page.join("page")
                other.join("other")
                page.send_frame(struct.pack("!H", 1001), opcode=page.CLOSE)
                eye.expect("event", kind="left", name="page")
                page.until_end()
                self.assertEqual(page.closed, 1001)
            eye.expect("event", kind="left", name="other")

    def test_hostile_frames_end_their_connection_alone(self):
        huge = struct.pack("!BBQ", 0x81, 0xff, 1 << 30) + b"mask"
        with WebServer() as server, server.socket() as good:
            good.join()
            for code, say in ((1003, lambda s: s.send_frame(b"\x00", opcode=s.BINARY)),
                              (1009, lambda s: s.send_bytes(huge)),
                              (1002, lambda s: s.send_frame(b"{}", masked=False)),
                              (1002, lambda s: s.send_frame(b"{}", first_bits=0x40)),
                              (1002, lambda s: s.send_frame(b"{}", opcode=3)),
                              (1007, lambda s: s.send_frame(b"\xff\xfe")),
                              (1009, lambda s: s.send_frame(b"x" * 5000))):
                with server.socket() as bad:
                    bad.expect("hello")
                    say(bad)
                    bad.until_end()
                    self.assertEqual(bad.closed, code)
            with server.socket() as flood:
                flood.expect("hello")
                try:
                    for _ in range(1000):
                        flood.send_frame(b"", opcode=flood.PING)
                except OSError:
                    pass  # it was cut off
                flood.until_end()
            good.send({"type": "ping", "t": 3})
            good.expect("pong", t=3)

    def test_the_end_of_the_server_is_a_bye_and_a_normal_close(self):
        with WebServer() as server, server.socket() as page:
            page.join()
            code, _, _ = server.stop()
            self.assertEqual(code, 0)
            self.assertEqual(page.until_end()[-1]["code"], "shutdown")
            self.assertEqual(page.closed, 1000)
            self.assertNotIn("did not stop", server.log())


class Tls(unittest.TestCase):
    def use(self, folder, name):
        """One of the tests' certificates, as the server will read it; a client's side that believes in it alone."""
        for part in ("certificate", "key"):
            shutil.copy(os.path.join(CERTIFICATES, f"{name}_{part}.pem"), os.path.join(folder, part))
        context = ssl.create_default_context(cafile=os.path.join(folder, "certificate"))
        context.check_hostname = False
        return context

    def test_the_same_three_are_spoken_inside_of_tls_and_a_new_certificate_is_read_at_hup(self):
        with tempfile.TemporaryDirectory() as folder:
            first = self.use(folder, "first")
            with WebServer("--tls-cert", folder + "/certificate", "--tls-key", folder + "/key") as server:
                origin = server.url[:-1]
                with server.web() as client, server.socket(first, Origin=origin.replace("http", "https")) as page:
                    client.socket = first.wrap_socket(client.socket)
                    for player in (client, page):
                        player.join()
                        self.assertEqual(player.seen[0]["type"], "hello")
                        player.expect("delta")
                        player.send({"type": "leave"})
                        self.assertEqual(player.until_end()[-1]["code"], "left")
                    self.assertEqual(page.closed, 1000)
                with server.socket(first, Origin=origin) as insecure:
                    self.assertEqual(insecure.status, 403)
                second = self.use(folder, "second")
                server.process.send_signal(signal.SIGHUP)
                server.wait_for_log("SIGHUP")
                with server.socket(second) as fresh:
                    self.assertEqual(fresh.status, 101)
                self.assertRaises(ssl.SSLError, server.socket, first)
                self.assertEqual(server.ask("GET", "/healthz")[0], 200)


if __name__ == "__main__":
    unittest.main()
