"""The example bots, the C++ bot, the shell bot and the load tool against a real server.

Needs the programs: WOODLOUSE_BIN=build/release/bin python3 -m unittest test_play
"""

import os
import re
import shutil
import signal
import subprocess
import sys
import threading
import time
import unittest

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(os.path.dirname(HERE))
sys.path.insert(0, HERE)
import woodlouse

PATIENCE_S = 60.0  # only a failing test takes so long


def program(name):
    return os.path.join(os.environ["WOODLOUSE_BIN"], name)


class Running:
    """A program whose lines can be waited for; ended at the end of the `with`."""

    def __init__(self, *command):
        self._process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        self.lines = []
        self._changed = threading.Condition()
        self._ended = False
        self._reader = threading.Thread(target=self._read, daemon=True)
        self._reader.start()

    def _read(self):
        for line in self._process.stdout:
            with self._changed:
                self.lines.append(line.rstrip("\n"))
                self._changed.notify_all()
        with self._changed:
            self._ended = True
            self._changed.notify_all()

    def wait_for(self, pattern, accept=lambda match: True):
        """The first match of `pattern` in a line that `accept` takes."""
        deadline = time.monotonic() + PATIENCE_S
        seen = 0
        with self._changed:
            while True:
                for line in self.lines[seen:]:
                    match = re.search(pattern, line)
                    if match and accept(match):
                        return match
                seen = len(self.lines)
                if self._ended or not self._changed.wait(deadline - time.monotonic()):
                    raise AssertionError("no line with %r in:\n%s" % (pattern, "\n".join(self.lines[-20:])))

    def result(self):
        """Its exit code, once it ended by itself."""
        return self._process.wait(PATIENCE_S)

    def __enter__(self):
        return self

    def __exit__(self, *exception):
        if self._process.poll() is None:
            self._process.send_signal(signal.SIGINT)
            try:
                self._process.wait(5)
            except subprocess.TimeoutExpired:
                self._process.kill()
                self._process.wait()
        self._reader.join(5)
        self._process.stdout.close()


def serve(owner, name):
    """The address of a server of that map, which ends with `owner`, a TestCase or its class."""
    server = Running(program("woodlouse-server"), "--map", os.path.join(ROOT, "maps", name + ".json"), "--listen",
                     "127.0.0.1:0", "--seed", "3")
    add = owner.addClassCleanup if isinstance(owner, type) else owner.addCleanup
    add(server.__exit__)
    return server.wait_for(r"^listening (\S+)$").group(1)


def example(name, address):
    return Running(sys.executable, "-B", os.path.join(HERE, name + ".py"), address)


class TheExamples(unittest.TestCase):
    """All at once: a hill takes its time."""

    @classmethod
    def setUpClass(cls):
        pot, hills = serve(cls, "parabolic_pot"), serve(cls, "hills")
        cls.bots = {(name, place): example(name, address) for name, place, address in (
            ("hill_climber", "hills", hills), ("hill_climber", "pot", pot), ("downhill_roller", "pot", pot),
            ("orbiter", "pot", pot))}
        for bot in cls.bots.values():
            cls.addClassCleanup(bot.__exit__)

    def climbs(self, place, start_below, to):
        climber, heights = self.bots["hill_climber", place], r"tick \d+: (-?[\d.]+) m up"
        self.assertLess(float(climber.wait_for(heights).group(1)), start_below)
        climber.wait_for(heights, lambda match: float(match.group(1)) > to)

    def test_the_hill_climber_climbs_where_its_thrust_suffices(self):
        self.climbs("hills", 4.0, 5.5)  # the summit is 6.1 m up

    def test_the_hill_climber_swings_itself_up_where_its_thrust_does_not_suffice(self):
        self.climbs("pot", 4.0, 6.0)  # on foot 1.6 m at most, where the slope is 0.4

    def test_the_roller_rolls(self):
        self.bots["downhill_roller", "pot"].wait_for(r": ([\d.]+) m/s", lambda match: float(match.group(1)) > 2.0)

    def test_the_orbiter_goes_round(self):
        self.bots["orbiter", "pot"].wait_for(r"1 times round")


class TheModule(unittest.TestCase):
    def test_the_keys_of_moving_lice_have_the_hashes_of_their_rows(self):
        address = serve(self, "volcano")
        with woodlouse.connect(address, name="proof", verify=True) as game:
            for state in game.states():
                if state.me and not game.last_ack:
                    game.thrust((0.5, -0.25))
                if game.verified >= 3:
                    break
            self.assertGreater(state.me.distance, 0.0)


class ThePrograms(unittest.TestCase):
    def test_an_example_says_plainly_that_nobody_listens(self):
        with example("orbiter", "127.0.0.1:1") as orbiter:
            orbiter.wait_for(r"connection: no server at 127.0.0.1:1")
            self.assertEqual(orbiter.result(), 1)

    def test_the_chaser_comes_near_the_louse_it_chases(self):
        sys.path.insert(0, HERE)
        import woodlouse
        address = serve(self, "parabolic_pot")
        with woodlouse.connect(address, name="hare") as hare, Running(program("woodlouse-chaser"), address) as chaser:
            it = int(chaser.wait_for(r"^louse (\d+) in room").group(1))
            deadline = time.monotonic() + PATIENCE_S
            for state in hare.states():
                self.assertLess(time.monotonic(), deadline, "it never came")
                row = state.lice.get(it)
                if state.me and row and (row.x - state.me.x) ** 2 + (row.y - state.me.y) ** 2 < 1.0:
                    break

    @unittest.skipUnless(shutil.which("nc"), "needs nc")
    def test_the_shell_bot_joins_pushes_and_sees_rows(self):
        host, port = serve(self, "volcano").split(":")
        with Running("sh", os.path.join(ROOT, "bots", "shell", "push.sh"), host, port, "1") as push:
            push.wait_for(r'^\{"type":"welcome"')
            push.wait_for(r'^\{"type":"ack","seq":1,.*"dropped":false')
            push.wait_for(r'^\{"type":"(key|delta)".*"louse":\[\[\d+,-?\d+')
            push.wait_for(r'^\{"type":"bye","code":"left"')

    def test_the_swarm_gets_its_ticks_and_its_acks(self):
        with Running(program("woodlouse-swarm"), "--bots", "20", "--seconds", "2", serve(self, "volcano")) as swarm:
            self.assertEqual(swarm.result(), 0, "\n".join(swarm.lines))
            swarm.wait_for(r"lost +0 not joined, 0 disconnected")
            self.assertGreater(float(swarm.wait_for(r"distinct ticks/s per bot +min +([\d.]+)").group(1)), 10.0)
            self.assertGreater(int(swarm.wait_for(r"(\d+) inputs sent").group(1)), 50)

    def test_the_swarm_says_plainly_that_nobody_listens(self):
        with Running(program("woodlouse-swarm"), "--bots", "2", "127.0.0.1:1") as swarm:
            self.assertEqual(swarm.result(), 69)
            swarm.wait_for(r"no bot could join: connect: Connection refused")


if __name__ == "__main__":
    unittest.main()
