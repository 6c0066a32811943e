"""Behind proxies: who is believed when he says whose connection or request he passes on, and that it counts as that address's."""

import http.client
import json
import os
import socket
import ssl
import struct
import sys
import time
import unittest

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(HERE, "..", "server"))
from web_test import CERTIFICATES, WebServer, WebSocket, is_closed_in_silence  # noqa: E402
from wire import PATIENCE, Client, run  # noqa: E402

PROXY, STRANGER = "127.0.0.7", "127.0.0.9"
SIGNATURE = b"\r\n\r\n\0\r\nQUIT\n"
JOIN = {"type": "join", "protocol": 1, "name": "mara"}


def header(source, target="127.0.0.1", command=0x21, family=None, tlvs=b""):
    kind = socket.AF_INET6 if ":" in source else socket.AF_INET
    addresses = socket.inet_pton(kind, source) + socket.inet_pton(kind, "::1" if ":" in source else target) + struct.pack("!HH", 4711, 7777)
    family = (0x21 if ":" in source else 0x11) if family is None else family
    return SIGNATURE + struct.pack("!BBH", command, family, len(addresses + tlvs)) + addresses + tlvs


class Proxies(unittest.TestCase):
    def server(self, *arguments, **options):
        return WebServer("--trusted-proxy", PROXY, "--log-level", "debug", *arguments, **options)

    def lines(self, server, data=b"", source=PROXY, web=False):
        client = Client(server.host, server.web_port if web else server.port, source=source)
        self.addCleanup(client.socket.close)
        client.send_bytes(data)
        return client

    def ask(self, server, path="/healthz", source=PROXY, **fields):
        connection = http.client.HTTPConnection(server.host, server.web_port, timeout=PATIENCE, source_address=(source, 0))
        self.addCleanup(connection.close)
        connection.request("GET", path, headers=fields)
        answer = connection.getresponse()
        answer.read()
        return answer.status, connection

    # ---- the PROXY protocol -----------------------------------------------------------------------------

    def test_the_address_behind_counts_on_the_port_where_the_server_speaks_first(self):
        with self.server("--per-address", "2") as server:
            kept = [self.lines(server, header(source)) for source in ("192.0.2.1", "192.0.2.1", "192.0.2.2", "2001:db8::1", "2001:db8::2")]
            for client in kept:
                self.assertEqual(client.receive()["type"], "hello")
            third = self.lines(server, header("192.0.2.1"))
            self.assertEqual([m.get("code") for m in third.until_end()], ["too_many_connections"] * 2)
            # Of one network as IPv6 has it there are two already.
            sixth = self.lines(server, header("2001:db8::3"))
            self.assertEqual([m.get("code") for m in sixth.until_end()], ["too_many_connections"] * 2)
            kept[0].join("mara")
            kept[0].expect("delta")
            self.assertIn("for 192.0.2.1", server.log())
            self.assertNotIn("192.0.2.1: a PROXY", server.log())

    def test_the_address_behind_counts_on_the_web_port_in_whatever_is_spoken(self):
        with self.server("--per-address", "2") as server:
            line = self.lines(server, header("192.0.2.1") + json.dumps(JOIN).encode() + b"\n", web=True)
            line.expect("welcome")
            asked = self.lines(server, header("192.0.2.1") + b"GET /healthz HTTP/1.1\r\nHost: localhost\r\n\r\n", web=True)
            self.assertIn(b"200 OK", asked.socket.recv(4096))
            third = self.lines(server, header("192.0.2.1") + b"GET /healthz HTTP/1.1\r\nHost: localhost\r\n\r\n", web=True)
            self.assertIn(b" 503 ", third.socket.recv(4096))
            other = self.lines(server, header("192.0.2.2", tlvs=b"\x04\0\x02xx") + b"GET /healthz HTTP/1.1\r\nHost: localhost\r\n\r\n", web=True)
            self.assertIn(b"200 OK", other.socket.recv(4096))

    def test_a_proxy_may_pass_tls_on_and_what_is_said_inside_counts_too(self):
        context = ssl.create_default_context()
        context.check_hostname, context.verify_mode = False, ssl.CERT_NONE
        certificate = [os.path.join(CERTIFICATES, f"first_{part}.pem") for part in ("certificate", "key")]
        asked = b"GET /healthz HTTP/1.1\r\nHost: localhost\r\n%b\r\n"
        with self.server("--tls-cert", certificate[0], "--tls-key", certificate[1], "--per-address", "1") as server:
            for before, fields, address in ((header("192.0.2.1"), b"", "192.0.2.1"), (b"", b"X-Forwarded-For: 192.0.2.2\r\n", "192.0.2.2"),
                                            # Who is no proxy says nothing of others.
                                            (header("192.0.2.3"), b"X-Forwarded-For: 192.0.2.9\r\n", "192.0.2.3")):
                client = self.lines(server, before, web=True)
                client.socket = context.wrap_socket(client.socket)
                self.addCleanup(client.socket.close)
                client.send_bytes(asked.replace(b"%b", fields))
                self.assertIn(b"200 OK", client.socket.recv(4096))
                server.wait_for_log(f"for {address}")
            self.assertNotIn("192.0.2.9", server.log())

    def test_a_stranger_s_header_is_believed_by_nobody(self):
        with self.server() as server:
            with self.lines(server, header("192.0.2.1"), source=STRANGER) as client:
                self.assertEqual(client.receive()["type"], "hello")
                self.assertEqual(client.expect("error")["code"], "bad_json")
            with self.lines(server, header("192.0.2.1") + b"{}\n", source=STRANGER, web=True) as client:
                client.expect("error", code="bad_json")
            self.assertNotIn("192.0.2.1", server.log())

    def test_headers_that_can_t_be_used_are_closed_and_the_log_says_why(self):
        bad = {"version 1": b"PROXY TCP4 192.0.2.1 192.0.2.2 4711 7777\r\n", "longer than": SIGNATURE + b"\x21\x11\xff\xff", "family": header("192.0.2.1", family=0x12),
               "command": header("192.0.2.1", command=0x22), "too short": SIGNATURE + b"\x21\x11\0\x04\x7f\0\0\1", "TLVs": header("192.0.2.1", tlvs=b"\x04\xff")}
        for web in (False, True):
            with self.server() as server, server.player("eye", "spectator", source=STRANGER) as eye:
                for why, data in bad.items():
                    client = self.lines(server, data, web=web)
                    self.assertTrue(is_closed_in_silence(client), why)
                for why in bad:
                    server.wait_for_log(why)
                eye.expect("key")

    def test_a_header_that_is_cut_off_ends_and_local_and_unix_are_the_proxy_s_own(self):
        with self.server("--per-address", "3") as server:
            whole = header("192.0.2.1")
            for size in (1, 12, 15, 16, len(whole) - 1):
                with self.lines(server, whole[:size]) as client:
                    client.socket.shutdown(socket.SHUT_WR)
                    self.assertTrue(is_closed_in_silence(client), size)
            slow = self.lines(server, whole[:20])
            own = [header("192.0.2.1", command=0x20), SIGNATURE + b"\x21\x31\0\xd8" + bytes(216), SIGNATURE + b"\x20\0\0\0"]
            kept = [self.lines(server, data) for data in own]
            for client in kept:
                self.assertEqual(client.receive()["type"], "hello")
            fourth = self.lines(server, own[0])
            self.assertEqual(fourth.until_end()[-1]["code"], "too_many_connections")
            self.assertTrue(is_closed_in_silence(slow))  # in its time, however long it waits
            server.wait_for_log("it was cut off")

    def test_a_proxy_that_says_nothing_of_whom_it_is_for_is_a_client_as_any(self):
        with self.server("--per-address", "2") as server:
            silent = self.lines(server)
            self.assertEqual(silent.receive()["type"], "hello")  # in a moment
            plain = self.lines(server, json.dumps(JOIN).encode() + b"\n")
            plain.expect("welcome")
            third = self.lines(server, b'{"type":"list"}\n', web=True)
            self.assertEqual(third.until_end()[-1]["code"], "too_many_connections")

    def test_the_end_of_the_server_does_not_wait_for_headers(self):
        with self.server() as server:
            waiting = [self.lines(server, data, web=web) for data in (b"", SIGNATURE) for web in (False, True)]
            code, _, _ = server.stop()
            self.assertEqual(code, 0)
            self.assertNotIn("did not stop", server.log())
            for client in waiting:
                self.assertTrue(is_closed_in_silence(client))

    # ---- X-Forwarded-For --------------------------------------------------------------------------------

    def test_requests_count_for_whom_each_is_also_on_one_socket(self):
        fields = {"X-Forwarded-For": "203.0.113.5, 192.0.2.1"}
        with self.server() as server:
            kept = []
            for _ in range(129):
                status, connection = self.ask(server, **fields)
                kept.append(connection)
            self.assertEqual(status, 503, "of one address 128 at a time")
            self.assertEqual(self.ask(server, **{"X-Forwarded-For": "192.0.2.2"})[0], 200)
            # The first socket is another one's with its next request, and so there is room again.
            kept[0].request("GET", "/healthz", headers={"X-Forwarded-For": "192.0.2.3"})
            self.assertEqual(kept[0].getresponse().read(), b"ok\n")
            self.assertEqual(self.ask(server, **fields)[0], 200)
            self.assertEqual(self.ask(server, **fields)[0], 503)
            # What a stranger says of others is nothing.
            self.assertEqual(self.ask(server, source=STRANGER, **fields)[0], 200)
            self.assertNotIn("203.0.113.5", server.log())

    def test_a_page_s_session_is_of_who_stands_behind(self):
        with self.server("--per-address", "1") as server:
            pages = []
            for forwarded, status in (("192.0.2.1", 101), ("192.0.2.2, 127.0.0.7", 101), ("192.0.2.1", 503), ("nonsense", 101), ("[2001:db8::1]:443", 101)):
                page = self.page(server, forwarded)
                self.assertEqual(page.status, status, forwarded)
                pages.append(page)
            pages[0].join("mara")
            pages[0].expect("delta")
            pages[0].send({"type": "leave"})
            pages[0].until_end()
            for page in pages[:3]:
                page.socket.close()
            end = time.monotonic() + PATIENCE
            while (page := self.page(server, "192.0.2.1")).status != 101:  # once it is seen that they have gone
                page.socket.close()
                self.assertLess(time.monotonic(), end)
                time.sleep(0.05)

    def page(self, server, forwarded):
        """A WebSocket through the proxy."""
        page = WebSocket(server, source=PROXY, **{"X-Forwarded-For": forwarded})
        self.addCleanup(page.socket.close)
        return page

    def test_bytes_of_answers_are_charged_to_who_stands_behind(self):
        with self.server("--answer-bytes-per-s-address", "1024", maps=("volcano",)) as server:
            first, second = {"X-Forwarded-For": "192.0.2.1"}, {"X-Forwarded-For": "192.0.2.2"}
            statuses = [self.ask(server, "/", **first)[0] for _ in range(30)]
            self.assertEqual((statuses[0], statuses[-1]), (200, 429))
            self.assertEqual(self.ask(server, "/", **second)[0], 200)

    def test_what_is_no_proxy_is_an_error_at_the_start(self):
        for text, what in (("proxy.example.org", "is no address"), ("10.0.0.1/33", "prefix"), ("0.0.0.0/0", "everybody")):
            code, _, errors = run("--map", "volcano", "--trusted-proxy", text, "--listen", "127.0.0.1:0")
            self.assertEqual(code, 2)
            self.assertIn(what, errors)


if __name__ == "__main__":
    unittest.main()
