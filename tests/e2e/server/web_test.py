"""The port on which the client speaks first: lines, and what is none of them."""

import json
import socket
import unittest

from wire import PATIENCE, Client, Server

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
            for bytes_of_it in (b"\x00", b"hello\n", b"\x80\x81"):
                with server.web() as client:
                    client.send_bytes(bytes_of_it)
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


if __name__ == "__main__":
    unittest.main()
