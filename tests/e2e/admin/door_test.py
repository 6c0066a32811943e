"""The operator's door itself: who may come in, and what no client of it can do to the server."""

import http.client
import os
import signal
import socket
import stat
import tempfile
import time
import unittest

from door import AdminServer, Door
from wire import PATIENCE, map_file, run

TOKEN = "correct-horse-battery"


class UnixHttp(http.client.HTTPConnection):
    def __init__(self, path):
        super().__init__("localhost", timeout=PATIENCE)
        self.path = path

    def connect(self):
        self.sock = socket.socket(socket.AF_UNIX)
        self.sock.settimeout(PATIENCE)
        self.sock.connect(self.path)


def get(connection, path, method="GET", **headers):
    connection.request(method, path, headers=headers)
    answer = connection.getresponse()
    body = answer.read().decode()
    connection.close()
    return answer.status, body


class AUnixSocket(unittest.TestCase):
    def test_is_its_owners_alone_and_goes_with_the_server(self):
        with AdminServer() as server:
            mode = os.stat(server.socket_path)
            self.assertTrue(stat.S_ISSOCK(mode.st_mode))
            self.assertEqual(stat.S_IMODE(mode.st_mode), 0o600)
            self.assertEqual(server.done("status")["rooms"], 1)
            self.assertEqual(server.stop()[0], 0)
            self.assertFalse(os.path.exists(server.socket_path))

    def test_that_a_killed_server_left_is_replaced_and_a_living_ones_is_not(self):
        with AdminServer() as server:
            arguments = ["--map", map_file("volcano"), "--listen", "127.0.0.1:0", "--admin", server.socket_path]
            code, _, err = run(*arguments)
            self.assertEqual(code, 1)
            self.assertIn("another server listens there", err)
            self.assertEqual(server.done("status")["rooms"], 1)
            server.stop(signal.SIGKILL)
            self.assertTrue(os.path.exists(server.socket_path))
            with AdminServer(admin=server.socket_path) as next_one:
                self.assertEqual(next_one.done("status")["rooms"], 1)

    def test_does_not_take_the_place_of_a_file(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "notes")
            with open(path, "w", encoding="utf-8") as file:
                file.write("mine")
            code, _, err = run("--map", map_file("volcano"), "--listen", "127.0.0.1:0", "--admin", path)
            self.assertEqual(code, 1)
            self.assertIn("no socket", err)
            with open(path, encoding="utf-8") as file:
                self.assertEqual(file.read(), "mine")

    def test_that_another_server_put_in_its_place_stays(self):
        with AdminServer() as server:
            os.unlink(server.socket_path)
            with AdminServer(admin=server.socket_path) as other:
                self.assertEqual(server.stop()[0], 0)
                self.assertEqual(other.done("status")["rooms"], 1)


class Lines(unittest.TestCase):
    def test_are_answered_one_after_the_other_and_faults_said(self):
        with AdminServer() as server, server.door() as door:
            for line, code in ((b"xx", "bad_json"), (b"[]", "not_an_object"), (b"{}", "missing_field"),
                               (b'{"type":"bann"}', "unknown_type"),
                               (b'{"type":"ban","who":"ann","second":60}', "bad_field"),
                               (b'{"type":"ban","who":"ann","seconds":-1}', "bad_field"),
                               (b'{"type":"ban","who":""}', "bad_field"), (b'{"type":"ban"}', "missing_field"),
                               (b'{"type":"step","ticks":0}', "bad_field"),
                               (b'{"type":"status","type":"shutdown"}', "duplicate_key"),
                               (b'{"type":"close","room":"nowhere"}', "unknown_room"),
                               (b'{"type":"open","file":"nothing.json"}', "failed")):
                door.socket.sendall(line + b"\n")
                answer = door.answer()
                self.assertEqual((line, answer["type"], answer.get("code")), (line, "refused", code))
                self.assertTrue(answer["text"])
            door.socket.sendall(b'{"type":"status"}\n{"type":"rooms"}\n')
            self.assertIn("uptime_s", door.answer())
            self.assertEqual(door.answer()["rooms"][0]["name"], "volcano")

    def test_a_line_without_end_is_not_read_for_ever(self):
        with AdminServer() as server, server.door() as door:
            try:
                door.socket.sendall(b"{" + b" " * (1 << 20))
            except OSError:
                pass  # it has closed by then
            try:
                answer = door.answer()
            except ConnectionResetError:
                answer = {"code": "line_too_long"}
            self.assertEqual(answer["code"], "line_too_long")
            self.assertEqual(server.done("status")["rooms"], 1)

    def test_who_never_reads_holds_up_nobody_else(self):
        with AdminServer() as server:
            player = server.player()
            with server.door() as deaf:
                deaf.socket.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 2048)
                deaf.socket.setblocking(False)
                sent = 0
                try:
                    for _ in range(100000):
                        sent += deaf.socket.send(b'{"type":"rooms"}\n' * 100)
                except BlockingIOError:
                    pass  # it reads no more until its answers are taken
                self.assertGreater(sent, 0)
                self.assertEqual(server.done("status")["players"], 1)
                tick = player.expect("key")["tick"]
                self.assertGreater(player.expect("key")["tick"], tick)

    def test_a_hundred_connections_are_bounded_and_told_so(self):
        with AdminServer() as server:
            doors = [server.door() for _ in range(100)]
            answers = []
            for door in doors:
                try:
                    answers.append(door.ask("status"))
                except OSError:
                    answers.append(None)
            served = [answer for answer in answers if answer and answer["type"] == "done"]
            told = [answer for answer in answers if answer and answer.get("code") == "too_many_connections"]
            self.assertEqual(len(served), 32)
            self.assertGreater(len(told), 0)
            for door in doors:
                door.__exit__()
            end = time.monotonic() + PATIENCE
            while time.monotonic() < end:
                with server.door() as door:
                    try:
                        if (door.ask("status") or {}).get("type") == "done":
                            return
                    except OSError:
                        pass
            self.fail("the door did not open again")

    def test_commands_while_it_stops_are_answered_or_the_connection_ends(self):
        with AdminServer() as server:
            doors = [server.door() for _ in range(10)]
            for door in doors[1:]:
                for _ in range(20):
                    door.send("pause")
                    door.send("resume")
            doors[0].send("shutdown")
            self.assertEqual(doors[0].answer()["type"], "done")
            for door in doors[1:]:
                try:
                    while door.answer() is not None:
                        pass
                except OSError:
                    pass
            self.assertEqual(server.finish()[0], 0)


class Http(unittest.TestCase):
    def test_get_is_answered_on_the_same_socket(self):
        with AdminServer() as server:
            self.assertEqual(get(UnixHttp(server.socket_path), "/healthz"), (200, "ok\n"))
            self.assertEqual(get(UnixHttp(server.socket_path), "/healthz?a=b", "HEAD"), (200, ""))
            status, body = get(UnixHttp(server.socket_path), "/secret-name")
            self.assertEqual(status, 404)
            self.assertNotIn("secret-name", body)
            self.assertEqual(get(UnixHttp(server.socket_path), "/healthz", "POST")[0], 405)
            self.assertEqual(get(UnixHttp(server.socket_path), "/healthz", X="x" * 9000)[0], 431)
            with server.door() as door:
                door.socket.sendall(b"GET nonsense\r\n\r\n")
                self.assertIn(b" 400 ", door.file.readline())


class APort(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.token = os.path.join(folder.name, "token")
        with open(self.token, "w", encoding="utf-8") as file:
            file.write(TOKEN + "\n")

    def test_is_on_this_machine_alone_and_wants_a_token(self):
        where = ["--map", map_file("volcano"), "--listen", "127.0.0.1:0", "--admin"]
        for arguments, text in ((["127.0.0.1:0"], "--admin-token-file"),
                                (["0.0.0.0:0", "--admin-token-file", self.token], "plain text"),
                                (["./x.sock", "--admin-token-file", self.token], "asks for no token")):
            code, _, err = run(*where, *arguments)
            self.assertNotEqual(code, 0)
            self.assertIn(text, err)
        with AdminServer("--admin-token-file", self.token, admin="127.0.0.1:0") as server:
            server.refused("status", "bad_token")
            server.refused("status", "bad_token", token="x" * 20)
            with server.door() as door:
                self.assertEqual(door.ask("status", token=TOKEN)["type"], "done")
                self.assertEqual(door.ask("rooms")["type"], "done")  # said once
            port = int(server.where.rsplit(":", 1)[1])
            connection = http.client.HTTPConnection("127.0.0.1", port, timeout=PATIENCE)
            self.assertEqual(get(connection, "/nothing", Authorization="Bearer " + TOKEN)[0], 404)
            self.assertEqual(get(connection, "/healthz")[0], 200)
            self.assertEqual(get(connection, "/nothing")[0], 401)
            code, out, err = run("admin", "--connect", server.where, "--token-file", self.token, "status")
            self.assertEqual((code, err), (0, ""))
            self.assertIn("1 rooms", out)
            self.assertNotIn(TOKEN, server.log())

    def test_who_says_nothing_keeps_nobody_out(self):
        with AdminServer("--admin-token-file", self.token, admin="127.0.0.1:0") as server:
            silent = [server.door() for _ in range(40)]
            with server.door() as door:
                self.assertEqual(door.ask("status", token=TOKEN)["type"], "done")
            trusted = []
            for _ in range(32):
                trusted.append(server.door())
                self.assertEqual(trusted[-1].ask("status", token=TOKEN)["type"], "done")
            with server.door() as late:
                self.assertEqual(late.answer()["code"], "too_many_connections")
            for door in silent + trusted:
                door.__exit__()
            # Those who are just being told that they may not keep nobody out either.
            told = []
            for _ in range(60):
                told.append(server.door())
                told[-1].send("status", token="no")
            with server.door() as door:
                self.assertEqual(door.ask("status", token=TOKEN)["code"], "rate_limited")  # so many guesses are
            for door in told:
                door.__exit__()

    def test_wrong_tokens_are_limited_and_then_no_token_is_looked_at(self):
        with AdminServer("--admin-token-file", self.token, admin="127.0.0.1:0") as server:
            for _ in range(5):
                server.refused("status", "bad_token", token="guess-guess")
            server.refused("status", "rate_limited", token="guess-guess")
            server.refused("status", "rate_limited", token=TOKEN)
            with server.door() as door:
                door.ask("status", token="guess-guess")
                self.assertIsNone(door.answer())  # one guess a connection


if __name__ == "__main__":
    unittest.main()
