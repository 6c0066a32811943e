"""Tokens by role: who may join, and what moderators may do from their own connection."""

import os
import signal
import socket
import ssl
import subprocess
import sys
import tempfile
import unittest

from door import AdminServer
from wire import PATIENCE, Client, Server, map_file, run

HERE = os.path.dirname(os.path.abspath(__file__))
CERTIFICATES = os.path.join(HERE, "..", "..", "tls")
BOTS = os.path.join(HERE, "..", "..", "..", "bots", "python")
PLAYER, MODERATOR = "correct-horse-battery", "staple-of-the-house"


def another_address():
    """One of this machine that is no loopback; None: it has none."""
    probe = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    try:
        probe.connect(("192.0.2.1", 9))  # nothing is sent
        address = probe.getsockname()[0]
        return None if address.startswith("127.") or address == "0.0.0.0" else address
    except OSError:
        return None
    finally:
        probe.close()


class WithPasswords(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.file = os.path.join(folder.name, "passwords")
        self.write(f"# ours\nplayer {PLAYER}\nmoderator {MODERATOR}\n")

    def write(self, text):
        with open(self.file, "w", encoding="utf-8") as file:
            file.write(text)

    def server(self, *arguments, **options):
        return AdminServer("--password-file", self.file, *arguments, **options)


class Joining(WithPasswords):
    def test_needs_a_token_of_any_role(self):
        with self.server() as server:
            client = server.client()
            client.send({"type": "join", "protocol": 1, "name": "ann"})
            self.assertFalse(client.expect("error", code="bad_token")["fatal"])
            client.send({"type": "join", "protocol": 1, "name": "ann", "token": "wrong-horse"})
            client.expect("error", code="bad_token")
            client.join("ann", token=PLAYER)
            server.player("bob", role="spectator", token=MODERATOR)
            log = server.log()
            for secret in (PLAYER, MODERATOR, "wrong-horse"):
                self.assertNotIn(secret, log)

    def test_wrong_ones_are_limited_by_address(self):
        with self.server() as server:
            client = server.client(source="127.0.0.9")
            for _ in range(5):
                client.send({"type": "join", "protocol": 1, "name": "ann", "token": "guess-guess"})
                client.expect("error", code="bad_token")
            other = server.client(source="127.0.0.9")
            other.send({"type": "join", "protocol": 1, "name": "ann", "token": PLAYER})
            self.assertGreater(other.expect("error", code="rate_limited")["retry_after_ms"], 0)
            server.player("bob", source="127.0.0.10", token=PLAYER)

    def test_the_file_is_read_again_at_hup_and_a_bad_one_changes_nothing(self):
        with self.server() as server:
            self.write("player another-horse\n")
            server.process.send_signal(signal.SIGHUP)
            server.wait_for_log("read again")
            server.player("ann", token="another-horse")
            self.write("player\n")
            self.assertIn("passwords", server.refused("reload", "failed"))
            server.player("bob", token="another-horse")
            self.assertNotIn("another-horse", server.log())

    def test_a_file_that_can_not_be_taken_ends_the_start(self):
        self.write("player short\n")
        code, _, err = run("--map", map_file("volcano"), "--listen", "127.0.0.1:0", "--password-file", self.file)
        self.assertEqual(code, 1)
        self.assertIn("passwords:1", err)
        self.assertNotIn("short", err)

    def test_from_another_machine_it_is_taken_inside_of_tls_alone(self):
        address = another_address()
        if address is None:
            self.skipTest("this machine has no address but its own")
        certificate = ["--tls-cert", os.path.join(CERTIFICATES, "first_certificate.pem"), "--tls-key",
                       os.path.join(CERTIFICATES, "first_key.pem")]
        with self.server("--web", "0.0.0.0:0", *certificate, listen="0.0.0.0:0") as server:
            plain = Client(address, server.port)
            plain.send({"type": "join", "protocol": 1, "name": "ann", "token": PLAYER})
            self.assertIn("TLS", plain.expect("error", code="bad_token")["text"])
            context = ssl.SSLContext(ssl.PROTOCOL_TLS_CLIENT)
            context.check_hostname, context.verify_mode = False, ssl.CERT_NONE
            inside = Client(address, int(server.url.rstrip("/").rsplit(":", 1)[1]))
            inside.socket = context.wrap_socket(inside.socket)
            inside.join("ann", token=PLAYER)
            Client("127.0.0.1", server.port).join("bob", token=PLAYER)
        with self.server("--plain-passwords", listen="0.0.0.0:0") as server:
            Client(address, server.port).join("ann", token=PLAYER)

    def test_our_clients_can_say_it(self):
        with self.server() as server:
            script = ("import sys, woodlouse\n"
                      "with woodlouse.connect(sys.argv[1], token=sys.argv[2]) as game:\n"
                      "    print(next(iter(game.states())).tick)\n")
            done = subprocess.run([sys.executable, "-B", "-c", script, server.address, PLAYER], capture_output=True,
                                  text=True, timeout=PATIENCE, env={**os.environ, "PYTHONPATH": BOTS}, check=False)
            self.assertEqual((done.returncode, done.stderr), (0, ""))


class Moderators(WithPasswords):
    def test_kick_mute_and_say_in_their_own_room(self):
        with self.server(maps=("volcano", "hills")) as server:
            ann = server.player("ann", room="volcano", token=PLAYER)
            far = server.player("far", room="hills", token=PLAYER)
            judge = server.player("judge", role="spectator", room="volcano", token=MODERATOR)
            ann.send({"type": "moderate", "action": "kick", "who": "judge"})
            ann.expect("error", code="no_right")
            judge.send({"type": "moderate", "action": "say", "text": "be good"})
            self.assertEqual(ann.expect("notice", code="operator")["text"], "be good")
            judge.expect("notice", code="moderated")
            judge.send({"type": "moderate", "action": "mute", "who": "ann", "seconds": 60})
            judge.expect("notice", code="moderated")
            ann.send({"type": "chat", "text": "hello"})
            ann.expect("error", code="muted")
            judge.send({"type": "moderate", "action": "unmute", "who": "ann"})
            judge.expect("notice", code="moderated")
            shy = server.player("::1", room="volcano", token=PLAYER)  # a name that looks like an address
            judge.send({"type": "moderate", "action": "mute", "who": "::1"})
            judge.expect("notice", code="moderated")
            shy.send({"type": "chat", "text": "hello"})
            shy.expect("error", code="muted")
            for who in ("far", "127.0.0.1", "nobody"):  # another room's, an address
                judge.send({"type": "moderate", "action": "kick", "who": who})
                judge.expect("error", code="not_moderated")
            judge.send({"type": "moderate", "action": "kick", "who": "ann"})
            judge.expect("notice", code="moderated")
            self.assertEqual(ann.until_end()[-1]["code"], "kicked")
            far.send({"type": "ping", "t": 1})
            far.expect("pong")
            self.assertFalse([m for m in far.seen if m.get("text") == "be good"])

    def test_without_passwords_nobody_is_one(self):
        with Server() as server:
            ann = server.player("ann", token=MODERATOR)
            ann.send({"type": "moderate", "action": "say", "text": "hello"})
            ann.expect("error", code="no_right")
            other = server.client()
            other.send({"type": "moderate", "action": "say", "text": "hello"})
            other.expect("error", code="not_joined")


if __name__ == "__main__":
    unittest.main()
