"""One short game, again and again: each time another call to the system fails (tests/inject)."""

import concurrent.futures
import dataclasses
import os
import select
import signal
import subprocess
import tempfile
import time
import unittest

from wire import PROGRAM, Client, map_file, run

LIBRARY = os.environ.get("WOODLOUSE_FAILING_CALLS")
AT_ONCE = 2
STOPS_WITHIN = 2.0   # s, of a SIGTERM or of the call that failed
STARVES_AFTER = 5.0  # s without a byte: such a client has been forgotten, not sent away
ALLOCATIONS = 60
RECORDS_ALONE = ["sync", "rename", "cut"]  # kinds that such a game has not: records_injection_test.py


@dataclasses.dataclass
class Game:
    """What came of one."""
    order: str
    failed: bool = False   # the call was made
    listened: bool = False
    code: int = 0
    took: float = 0.0      # s, of the end
    printed: str = ""
    log: str = ""
    lost: tuple = ()       # clients that were sent away before they had all they wanted
    starved: tuple = ()    # ... that waited in vain
    noticed: bool = False  # the watcher was told that the recording ended, and had frames after that
    recording: str = ""    # nothing, "verifies", or why not
    counts: dict = dataclasses.field(default_factory=dict)

    def said(self):
        """The lines of the log that are not a game's everyday."""
        return [line for line in self.log.splitlines() if " info " not in line]


def steer(player):
    player.join()
    player.send({"type": "input", "seq": 1, "thrust": 1}, {"type": "chat", "text": "hello"}, {"type": "get_map"})
    wanted = {"ack", "event", "map", "delta"}
    while wanted:
        wanted -= {player.expect_any()["type"]}
    player.send({"type": "leave"})
    player.expect("bye", code="left")


def look_on(watcher, until):
    while time.monotonic() < until or watcher.frames_since < 2:
        message = watcher.expect_any()
        watcher.frames_since += message["type"] in ("key", "delta")
        if message.get("code") == "recording_ended":
            watcher.noticed, watcher.frames_since = True, 0


class Guest(Client):
    """A client that knows whether it was sent away or forgotten."""

    def __init__(self, host, port):
        super().__init__(host, port)
        self.socket.settimeout(STARVES_AFTER)
        self.frames_since = 0
        self.noticed = False

    def play(self, part):
        self.latest = time.monotonic() + STARVES_AFTER
        part(self)

    def receive(self):
        if time.monotonic() > self.latest:
            raise TimeoutError("starved")
        return super().receive()

    def expect_any(self):
        message = self.receive()
        if message is None:
            raise ConnectionError("ended")
        return message


class Play:
    """A server whose calls fail as ordered, and its guests: a watcher, then a player beside him."""

    def __init__(self, order, folder, seconds=0.25, options=()):
        self.game = Game(order)
        self.seconds = seconds
        self.calls = os.path.join(folder, "calls")
        self.recording = os.path.join(folder, "game.ndjson")
        self.command = [PROGRAM, "--map", map_file("volcano"), "--listen", "127.0.0.1:0", "--bots", "2", "--seed", "1",
                        "--record", self.recording, *options]

    def run(self):
        environment = {**os.environ, "LD_PRELOAD": LIBRARY, "WOODLOUSE_CALLS": self.calls, "WOODLOUSE_FAIL": self.game.order}
        if not self.game.order:
            del environment["WOODLOUSE_FAIL"]
        with tempfile.TemporaryFile("w+") as log:
            process = subprocess.Popen(self.command, env=environment, stdout=subprocess.PIPE, stderr=log, text=True)
            try:
                first = process.stdout.readline() if select.select([process.stdout], [], [], STARVES_AFTER)[0] else ""
                self.game.listened = first.startswith("listening ")
                if self.game.listened:
                    self.receive_guests(process, *first.split()[1].rsplit(":", 1))
                begun = time.monotonic()
                self.game.code = self.end(process)
                self.game.took = time.monotonic() - begun
            finally:
                process.kill()
                process.wait()
            self.game.printed = process.stdout.read()
            process.stdout.close()
            log.seek(0)
            self.game.log = log.read()
        self.look_at_what_is_left()
        return self.game

    def end(self, process):
        """Its exit code; None where it does not end. One that is at its end by itself is left alone: it takes signals no more."""
        try:
            if self.is_ending():
                return process.wait(STOPS_WITHIN / 2)
        except subprocess.TimeoutExpired:
            pass
        process.send_signal(signal.SIGTERM)
        try:
            return process.wait(STARVES_AFTER)
        except subprocess.TimeoutExpired:
            return None

    def is_ending(self):
        return not self.game.listened or len(self.game.lost) == 2

    def receive_guests(self, process, host, port):
        until = time.monotonic() + self.seconds
        parts = (("watcher", lambda guest: guest.join("eye", role="spectator")), ("player", steer),
                 ("watcher", lambda guest: look_on(guest, until)))
        guests = {}
        for name, part in parts:
            if process.poll() is not None or name in self.game.lost or name in self.game.starved:
                continue
            try:
                if name not in guests:
                    guests[name] = Guest(host, int(port))
                guest = guests[name]
                guest.play(part)
            except TimeoutError:
                self.game.starved += (name,)
            except (OSError, AssertionError):  # of expect(): the connection ended
                self.game.lost += (name,)
        if "watcher" in guests:
            self.game.noticed = guests["watcher"].noticed
        for guest in guests.values():
            guest.socket.close()

    def look_at_what_is_left(self):
        if os.path.exists(self.calls):
            with open(self.calls, encoding="ascii") as calls:
                words = [line.split() for line in calls]
            self.game.failed = any(line[0] == "failed" for line in words)
            self.game.counts = {line[0]: int(line[1]) for line in words if line[0] != "failed"}
        if os.path.exists(self.recording) and os.path.getsize(self.recording) > 0:
            code, verdict, errors = run("verify", self.recording)
            self.game.recording = "verifies" if code == 0 else verdict + errors


def play(order, **options):
    with tempfile.TemporaryDirectory() as folder:
        return Play(order, folder, **options).run()


def all_of(kind, count, error, reach=""):
    return [f"{kind}:{number}{reach}:{error}" for number in range(1, count + 1)]


def some_of(kind, count, error, reach="", most=12):
    """The first and the last, and as many between them, the more the earlier."""
    numbers = {round(count ** (k / (most - 1))) for k in range(most)} if count > most else range(1, count + 1)
    return [f"{kind}:{number}{reach}:{error}" for number in sorted(numbers)]


@unittest.skipUnless(LIBRARY, "this build has no library for it (tests/inject)")
class Injection(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.whole = play("")
        cls.counts = cls.whole.counts

    def play_each(self, orders, look, **options):
        """look(game) is what is asserted of each, beside that it ends well. How many failed as ordered."""
        with concurrent.futures.ThreadPoolExecutor(AT_ONCE) as pool:
            games = list(pool.map(lambda order: play(order, **options), orders))
        for game in games:
            with self.subTest(game.order):
                self.assert_ends_well(game)
                look(game)
        return sum(game.failed for game in games)

    def assert_ends_well(self, game):
        """Whatever failed: no signal, no hang, a reason, and a recording that holds what it holds."""
        self.assertIn(game.code, (0, 1), game)
        self.assertLess(game.took, STOPS_WITHIN, game)
        self.assertEqual(game.starved, (), game)
        self.assertIn(game.recording, ("", "verifies"), game)
        if game.code == 1 and "RECORDING LOST" not in game.printed:
            errors = [line for line in game.said() if line.startswith("woodlouse-server: ")]
            self.assertEqual(len(errors), 1, game)

    def assert_goes_on(self, game, may_lose=0):
        """The game was played to its end by all but so many guests."""
        self.assertTrue(game.listened, game)
        self.assertTrue(game.code == 0 or "RECORDING LOST" in game.printed, game)
        self.assertLessEqual(len(game.lost), may_lose, game)
        self.assertEqual(game.recording, "verifies", game)

    def test_a_game_in_which_nothing_fails(self):
        self.assert_ends_well(self.whole)
        self.assert_goes_on(self.whole)
        self.assertEqual((self.whole.code, self.whole.said()), (0, []))
        self.assertEqual([kind for kind, count in self.counts.items() if count == 0], RECORDS_ALONE)

    def test_no_memory_ends_it_with_one_line(self):
        """The resolver and who makes threads say in words of their own that there is none; a few can do without."""
        ended = []

        def look(game):
            ended.append(game.code)
            if game.code == 0:
                self.assert_goes_on(game)
            else:
                self.assertRegex(game.said()[0], "^woodlouse-server: (out of memory$|.*Cannot allocate memory|Resource temporarily)", game)

        self.play_each(some_of("alloc", self.counts["alloc"], "ENOMEM", most=ALLOCATIONS), look)
        self.assertGreater(sum(ended), ALLOCATIONS / 2)  # a game is not the same each time

    def test_what_cannot_be_opened_or_started_ends_it_with_one_line_or_is_done_without(self):
        ended = []

        def look(game):
            ended.append(game.code)
            if game.code == 0:
                self.assert_goes_on(game, may_lose=1)

        self.play_each([*all_of("open", self.counts["open"], "EACCES"), *all_of("lock", self.counts["lock"], "EWOULDBLOCK"),
                        *all_of("thread", self.counts["thread"], "EAGAIN"),
                        *all_of("descriptor", self.counts["descriptor"], "EMFILE")], look)
        self.assertGreater(sum(ended), 4)

    def test_a_connection_that_fails_is_that_connection_alone(self):
        def look(game):
            if game.listened:
                self.assert_goes_on(game, may_lose=game.order.split(":")[0] in ("send", "recv", "epoll"))

        orders = [*all_of("accept", self.counts["accept"], "EMFILE"), "accept:2:ECONNABORTED", *all_of("option", self.counts["option"], "EINVAL"),
                  *some_of("send", self.counts["send"], "ECONNRESET", "@"), "send:5:ENOBUFS",
                  *some_of("recv", self.counts["recv"], "ECONNRESET", "@"), *some_of("close", self.counts["close"], "EIO"),
                  *all_of("epoll", self.counts["epoll"], "ENOMEM")]
        self.assertGreater(self.play_each(orders, look), len(orders) / 2)

    def test_a_recording_that_cannot_be_written_ends_and_the_game_does_not(self):
        def look(game):
            self.assertTrue(game.failed, game)
            self.assertEqual(game.lost, (), game)
            is_lost = game.order.startswith("write") and "EINTR" not in game.order
            self.assertEqual((game.code, game.log.count("RECORDING ENDED")), (is_lost, is_lost), game)
            self.assertEqual(game.printed.splitlines()[-1].startswith("RECORDING LOST: "), is_lost, game)
            if game.order.startswith("write:1+"):
                self.assertTrue(game.noticed, game)

        self.play_each(["write:1+:ENOSPC", "write:2:EIO", "write:3:EIO", "write:1:EINTR", "log:1+:EIO"], look, seconds=1.3)


if __name__ == "__main__":
    unittest.main()
