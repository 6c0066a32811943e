"""A cluster over NATS as docs/nats-server.conf sets it up: TLS, who is who by certificates, and who may do what.

Usage: accounts_test.py [TestCase.test ...]"""

import json
import os
import pathlib
import re
import shutil
import signal
import socket
import ssl
import subprocess
import sys
import tempfile
import time
import unittest

import stage

SHIPPED = pathlib.Path(stage.MAPS).parent / "docs" / "nats-server.conf"
USERS = ("host", "edge", "admin", "stranger")


def openssl(*arguments):
    done = subprocess.run(["openssl", *map(str, arguments)], capture_output=True, text=True, timeout=60)
    assert done.returncode == 0, done.stderr


class Authority:
    """Makes certificates as docs/cluster.md says it."""

    def __init__(self, folder):
        self.folder = pathlib.Path(folder)
        openssl("req", "-x509", "-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:prime256v1", "-nodes", "-days", 3650,
                "-keyout", self.folder / "ca.key", "-out", self.folder / "ca.pem", "-subj", "/CN=woodlouse")

    def certify(self, name, use, names=""):
        path = self.folder / name
        openssl("req", "-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:prime256v1", "-nodes", "-keyout", f"{path}.key",
                "-out", f"{path}.csr", "-subj", f"/O=woodlouse/CN={name}")
        extensions = self.folder / f"{name}.ext"
        extensions.write_text(f"extendedKeyUsage={use}\n" + (f"subjectAltName={names}\n" if names else ""))
        openssl("x509", "-req", "-days", 825, "-in", f"{path}.csr", "-CA", self.folder / "ca.pem", "-CAkey", self.folder / "ca.key",
                "-CAcreateserial", "-extfile", extensions, "-out", f"{path}.pem")


class SafeNats(stage.Nats):
    """One nats-server by the shipped file: addresses and paths are this test's, nothing else is changed."""

    def __init__(self):
        self.folder = tempfile.mkdtemp(prefix="woodlouse-nats-")
        authority = Authority(self.folder)
        authority.certify("server", "serverAuth,clientAuth", "IP:127.0.0.1")
        for user in USERS:
            authority.certify(user, "clientAuth")
        self.port, = stage.free_ports(1)
        text = SHIPPED.read_text()
        for shipped, here in (("10.0.0.5:4222", f"127.0.0.1:{self.port}"), ('"/var/lib/nats"', f'"{self.folder}/store"'),
                              ("/etc/nats/", f"{self.folder}/")):
            assert shipped in text, shipped
            text = text.replace(shipped, here)
        configuration = os.path.join(self.folder, "nats.conf")
        pathlib.Path(configuration).write_text(text)
        self.commands = [["nats-server", "-c", configuration, "-l", os.path.join(self.folder, "nats.log")]]
        self.processes = [None]
        self.start(0)
        for user in USERS:
            self.settings = {"nats": [f"tls://127.0.0.1:{self.port}"], "silence_ms": 300,
                             "tls": {"ca": self.path("ca.pem"), "cert": self.path(f"{user}.pem"), "key": self.path(f"{user}.key")}}
            pathlib.Path(self.path(f"{user}.json")).write_text(json.dumps(self.settings))
        end = time.monotonic() + stage.PATIENCE
        while self.as_user("admin", "init")[0] != 0:
            assert time.monotonic() < end, self.as_user("admin", "init")
            time.sleep(0.2)
        self.file = self.path("host.json")

    def path(self, name):
        return os.path.join(self.folder, name)

    def as_user(self, user, *arguments):
        self.file = self.path(f"{user}.json")
        return self.command(*arguments)

    def joined(self):
        before, self.file = self.file, self.path("edge.json")
        try:
            return super().joined()
        finally:
            self.file = before


class Wire:
    """A user of NATS that says what it likes."""

    def __init__(self, nats, user):
        plain = socket.create_connection(("127.0.0.1", nats.port), stage.PATIENCE)
        assert plain.recv(4096).startswith(b"INFO ")
        context = ssl.create_default_context(cafile=nats.path("ca.pem"))
        context.load_cert_chain(nats.path(f"{user}.pem"), nats.path(f"{user}.key"))
        self.socket = context.wrap_socket(plain, server_hostname="127.0.0.1")
        self.say(b'CONNECT {"verbose":false,"pedantic":false,"headers":true,"no_responders":true}\r\n')
        said = self.until_pong()
        assert said == b"PONG\r\n", said

    def say(self, data):
        self.socket.sendall(data)

    def until_pong(self):
        self.say(b"PING\r\n")
        said = b""
        while not said.endswith(b"PONG\r\n"):
            part = self.socket.recv(65536)
            if not part:
                break
            said += part
        return said.decode() if not said.endswith(b"PONG\r\n") else said

    def publish(self, subject, body=b"x", reply=""):
        """What NATS says of it: empty where it takes it."""
        self.say(f"PUB {subject} {reply} {len(body)}\r\n".encode() + body + b"\r\n")
        return self.until_pong().removesuffix(b"PONG\r\n").decode()

    def subscribe(self, subject, number=1):
        self.say(f"SUB {subject} {number}\r\n".encode())
        return self.until_pong().removesuffix(b"PONG\r\n").decode()

    def ask(self, subject, body):
        """The answer of JetStream."""
        self.say(b"SUB _INBOX.answer 9\r\n" + f"PUB {subject} _INBOX.answer {len(body)}\r\n".encode() + body + b"\r\n")
        said = b""
        while b"MSG _INBOX.answer" not in said or not said.endswith(b"}\r\n"):
            part = self.socket.recv(65536)
            assert part and b"-ERR" not in part, said + part
            said += part
        self.say(b"UNSUB 9\r\n")
        return json.loads(said[said.index(b"\r\n") + 2:])

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.socket.close()


class Accounts(unittest.TestCase):
    def setUp(self):
        self.nats = self.enterContext(SafeNats())

    def two_hosts(self):
        self.nats.file = self.nats.path("host.json")
        first = self.enterContext(stage.Host(self.nats, "a"))
        first.wait_for("cluster_owns")
        second = self.enterContext(stage.Host(self.nats, "b"))
        second.wait_for("cluster_follows")
        return first, second

    def last_batch(self):
        code, said = self.nats.as_user("admin", "status")
        self.assertEqual(code, 0, said)
        return said

    def test_hosts_play_and_take_over_and_who_looks_on_reads(self):
        first, second = self.two_hosts()
        bot = stage.Bot("ann", [first.address, second.address])

        async def play():
            import asyncio
            running = asyncio.ensure_future(bot.run())
            end = time.monotonic() + stage.PATIENCE
            while not (bot.welcomes and bot.newest and bot.newest[1] > bot.welcomes[0][1]["tick"] + 120):  # and so it is in the log
                assert time.monotonic() < end, first.log()
                await asyncio.sleep(0.05)
            first.signal(signal.SIGKILL)
            while len(bot.welcomes) < 2:
                assert time.monotonic() < end, second.log()
                await asyncio.sleep(0.05)
            bot.stopped = True
            await asyncio.wait([running], timeout=5)

        stage.play(play())
        self.assertTrue(bot.welcomes[1][1]["resumed"])
        # What a host is refused is not answered, and it waits for that while it takes rooms over.
        self.assertNotRegex(pathlib.Path(self.nats.path("nats.log")).read_text(), r'Violation.*"CN=host')
        for user in ("edge", "admin"):
            code, said = self.nats.as_user(user, "status")
            self.assertEqual(code, 0, said)
            self.assertIn("host b at", said)
        code, said, proofs = self.nats.joined()
        self.assertEqual(code, 0, said)
        self.assertIn("epoch 2 of b", said)
        self.assertTrue(proofs)
        for name, (verified, text) in proofs.items():
            self.assertEqual(verified, 0, f"{name}: {text}")

    def test_an_edge_reads_and_writes_nothing(self):
        first, second = self.two_hosts()
        with Wire(self.nats, "edge") as edge:
            for subject in ("wl.woodlouse.log.main", "wl.woodlouse.beat.a", "wl.woodlouse.beat.new", "wl.woodlouse.move.main", "$JS.API.STREAM.DELETE.WL_woodlouse_main",
                            "$JS.API.STREAM.PURGE.WL_woodlouse_main", "$JS.API.STREAM.UPDATE.WL_woodlouse_main", "$JS.API.STREAM.CREATE.other",
                            "$JS.API.STREAM.MSG.DELETE.WL_woodlouse_main", "$JS.API.STREAM.SNAPSHOT.WL_woodlouse_main",
                            "$JS.API.CONSUMER.DURABLE.CREATE.WL_woodlouse_main.d", "_INBOX.anybody"):
                self.assertIn("Permissions Violation for Publish", edge.publish(subject), subject)
            for subject in ("wl.woodlouse.log.main", "wl.>", "$JS.API.>", ">"):
                self.assertIn("Permissions Violation for Subscription", edge.subscribe(subject), subject)
            # NATS sends what is asked for where it is asked to: into the log itself it does not.
            looped = edge.ask("$JS.API.CONSUMER.CREATE.WL_woodlouse_main", json.dumps({
                "stream_name": "WL_woodlouse_main", "config": {
                    "deliver_subject": "wl.woodlouse.log.main", "deliver_policy": "all", "ack_policy": "none", "replay_policy": "instant"}}).encode())
            self.assertIn("error", looped)
            info = edge.ask("$JS.API.STREAM.INFO.WL_woodlouse_main", b"")
            self.assertGreater(info["state"]["last_seq"], 1)
        code, said = self.nats.as_user("edge", "init")
        self.assertEqual(code, 0, said)  # it is there, which an edge may see
        code, said = self.nats.as_user("admin", "fsck")
        self.assertEqual(code, 0, said)
        self.assertNotIn("cluster_fault", first.log() + second.log())

    def test_what_an_edge_has_sent_into_another_shards_log_ends_an_epoch_and_not_the_log(self):
        for user in ("admin", "host"):
            settings = json.loads(pathlib.Path(self.nats.path(f"{user}.json")).read_text())
            pathlib.Path(self.nats.path(f"other-{user}.json")).write_text(json.dumps({**settings, "shard": "other"}))
        code, said = self.nats.as_user("other-admin", "init")
        self.assertEqual(code, 0, said)
        self.nats.file = self.nats.path("other-host.json")
        owner = self.enterContext(stage.Host(self.nats, "x", "--bots", "1", "--bots-alone", "play"))
        owner.wait_for("cluster_owns")
        time.sleep(1)
        with Wire(self.nats, "edge") as edge:  # the first message of the other log, which nobody plays
            made = edge.ask("$JS.API.CONSUMER.CREATE.WL_woodlouse_main", json.dumps({
                "stream_name": "WL_woodlouse_main", "config": {
                    "deliver_subject": "wl.woodlouse.log.other", "deliver_policy": "last", "ack_policy": "none", "replay_policy": "instant"}}).encode())
        self.assertNotIn("error", made)
        owner.wait_for("LOG HAS A HOLE")
        end = time.monotonic() + stage.PATIENCE
        while "epoch 2 of x" not in (said := self.nats.as_user("other-admin", "status")[1]):
            self.assertLess(time.monotonic(), end, said + owner.log())
            time.sleep(0.1)
        before, = re.findall(r"stored up to batch (\d+)", said)
        time.sleep(1)
        after, = re.findall(r"stored up to batch (\d+)", self.nats.as_user("other-admin", "status")[1])
        self.assertGreater(int(after), int(before))
        self.assertEqual(owner.log().count("LOG HAS A HOLE"), 1, owner.log())

    def test_a_host_makes_and_removes_no_log(self):
        with Wire(self.nats, "host") as host:
            for subject in ("$JS.API.STREAM.DELETE.WL_woodlouse_main", "$JS.API.STREAM.PURGE.WL_woodlouse_main",
                            "$JS.API.STREAM.CREATE.WL_woodlouse_other", "$JS.API.STREAM.UPDATE.WL_woodlouse_main"):
                self.assertIn("Permissions Violation for Publish", host.publish(subject), subject)

    def test_whoever_has_spoken_to_nats_ends_well(self):
        """Its threads outlast the connection, and free what they have of OpenSSL while the process ends."""
        commands = [[stage.PROGRAM, "cluster", "init", self.nats.path("admin.json")]] * 4
        for _ in range(30):
            running = [subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) for command in commands]
            self.assertEqual([process.wait(stage.PATIENCE) for process in running], [0] * len(commands))
        first, second = self.two_hosts()
        for host in (first, second):
            host.signal(signal.SIGTERM)
            self.assertEqual(host.process.wait(stage.PATIENCE), 0, host.log())

    def test_who_is_nobody_gets_nothing(self):
        code, said = self.nats.as_user("stranger", "status")
        self.assertEqual(code, 1, said)
        self.assertIn("Authorization Violation", said)
        settings = {"nats": [f"tls://127.0.0.1:{self.nats.port}"], "tls": {"ca": self.nats.path("ca.pem")}}
        pathlib.Path(self.nats.path("nobody.json")).write_text(json.dumps(settings))
        self.assertEqual(self.nats.as_user("nobody", "status")[0], 1)
        # Nor does anybody talk to one who only says that he is NATS.
        pathlib.Path(self.nats.path("nobody.json")).write_text(json.dumps(
            {**self.nats.settings, "nats": [f"tls://localhost:{self.nats.port}"]}))
        code, said = self.nats.as_user("nobody", "status")
        self.assertEqual(code, 1, said)
        self.assertIn("mismatch", said)


if __name__ == "__main__":
    stage.skip_where_missing()
    if shutil.which("openssl") is None:
        print("SKIPPED: openssl is missing:  apt-get install openssl")
        sys.exit(77)
    unittest.main(verbosity=2)
