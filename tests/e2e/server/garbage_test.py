"""Lines that are wrong: each is answered, only the hopeless end the connection, and nobody else notices."""

import random
import unittest

from wire import Server

WRONG_LINES = [
    (b"", "bad_json"),
    (b"hello?", "bad_json"),
    (b"[1,2]", "not_an_object"),
    (b'{"type":"list","type":"list"}', "duplicate_key"),
    (b'{"a":' + b"[" * 20 + b"]" * 20 + b"}", "too_deep"),
    (b'{"type":"jump"}', "unknown_type"),
    (b"{}", "missing_field"),
    (b'{"type":"input"}', "missing_field"),
    (b'{"type":"input","seq":1.5,"thrust":1}', "bad_field"),
    (b'{"type":"input","seq":1,"thrust":"up"}', "bad_field"),
    (b'{"type":"input","seq":1,"thrust":NaN}', "bad_json"),
    (b'{"type":"chat","text":"\xff\xfe"}', "bad_json"),
    (b'{"type":"join","protocol":1,"name":"x","fields":["wings"]}', "bad_field"),
    (b'{"type":"input","seq":1,"thrust":1}', "not_joined"),
    (b'{"type":"join","protocol":1,"name":"x","room":"nowhere"}', "unknown_room"),
]


class Garbage(unittest.TestCase):
    def test_every_wrong_line_is_answered_with_its_code_and_the_connection_lives(self):
        with Server() as server, server.client() as client:
            for line, code in WRONG_LINES:
                client.send_bytes(line + b'\n{"type":"list"}\n')
                error = client.expect("error")
                self.assertEqual(error["code"], code, (line, error))
                self.assertFalse(error["fatal"])
                self.assertTrue(error["text"])
                client.expect("rooms")
            client.join()
            client.expect("delta")

    def test_three_lines_running_that_are_no_json_end_the_connection_with_a_bye(self):
        with Server() as server, server.client() as client:
            client.send_bytes(b"GET / HTTP/1.1\r\nHost: x\r\n\r\n")
            last = client.until_end()[-4:]
            self.assertEqual([(m["type"], m["code"]) for m in last],
                             [("error", "bad_json")] * 3 + [("bye", "bad_json")])
            self.assertEqual([m["fatal"] for m in last[:3]], [False, False, True])

    def test_another_protocol_version_ends_the_connection(self):
        with Server() as server, server.client() as client:
            client.send({"type": "join", "protocol": 2, "name": "x"})
            self.assertEqual(client.until_end()[-1]["code"], "bad_protocol")

    def test_an_oversize_line_ends_the_connection_even_without_its_newline(self):
        for data in (b'{"type":"chat","text":"' + b"x" * 5000 + b'"}\n', b"x" * 100_000):
            with Server() as server, server.client() as client:
                client.expect("hello")
                client.send_bytes(data)
                if not data.endswith(b"\n"):
                    client.send_bytes(b"\n")
                last = client.until_end()[-2:]
                self.assertEqual([(m["type"], m["code"]) for m in last],
                                 [("error", "line_too_long"), ("bye", "line_too_long")])

    def test_random_bytes_harm_nobody(self):
        generator = random.Random(4711)
        with Server("--bots", "1") as server, server.player("steady") as steady:
            for _ in range(30):
                with server.client() as client:
                    client.expect("hello")
                    try:
                        for _ in range(20):
                            client.send_bytes(generator.randbytes(generator.randrange(1, 3000)))
                    except OSError:
                        pass
            before = steady.expect("delta")["tick"]
            steady.send({"type": "ping", "t": 1})
            steady.expect("pong")
            self.assertGreater(steady.expect("delta")["tick"], before)
            self.assertIsNone(server.process.poll())


if __name__ == "__main__":
    unittest.main()
