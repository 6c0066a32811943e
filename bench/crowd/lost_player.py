#!/usr/bin/env python3
"""A player who vanishes without a word: for how long his louse goes on pushing, and whether he gets it back.

    bench/crowd/lost_player.py HOST PORT      plays, until it is stopped: prints its louse's id
"""
import os
import pathlib
import signal
import subprocess
import sys
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from line_client import LineClient, Watched  # noqa: E402

PATIENCE = 120.0  # s; a louse that still pushes is told as that
AWAY = 25.0       # s, of one who comes back


def play(host, port):
    client = LineClient(host, port)
    print(client.join(name="lost")["id"], flush=True)
    due, seq = 0.0, 0
    for message in client.lines(3600.0):
        if message and message["type"] == "ping":
            client.send(type="pong", t=message["t"])
        if time.monotonic() >= due:
            due = time.monotonic() + 0.2
            seq += 1
            client.send(type="input", seq=seq, thrust=[0.5, 0])


def seconds_until_it_rests(watcher, watched, patience):
    begin = time.monotonic()
    for message in watcher.lines(patience):
        if message and message["type"] in ("key", "delta"):
            watched.take(message)
            if not watched.pushes():
                return time.monotonic() - begin
    return patience


def measure(server, vanish, prefix=(), host=None, patience=PATIENCE):
    """How long a louse pushes after vanish(player's process) [s]. prefix: what the player is started by."""
    watcher = LineClient("127.0.0.1", server.port)
    watcher.join(name="watcher", role="spectator", fields=["tx", "ty"])
    command = [*prefix, sys.executable, __file__, host or "127.0.0.1", str(server.port)]
    player = subprocess.Popen(command, stdout=subprocess.PIPE, text=True)
    try:
        watched = Watched(int(player.stdout.readline()))
        for message in watcher.lines(7.0):  # in which the server has asked, and been told, that the player is there
            if message and message["type"] in ("key", "delta"):
                watched.take(message)
        if not watched.pushes():
            raise RuntimeError("the louse of a player who pushes does not push")
        vanish(player)
        return seconds_until_it_rests(watcher, watched, patience)
    finally:
        player.kill()
        player.wait()
        watcher.socket.close()


def stopped(server, patience=PATIENCE):
    return measure(server, lambda player: player.send_signal(signal.SIGSTOP), patience=patience)


class Cable:
    """A network of its own with a cable to it that can be pulled; needs root."""

    def __init__(self):
        self.name = f"lost{os.getpid()}"
        self.outside, self.inside = f"lo{os.getpid()}", f"li{os.getpid()}"
        self.host, self.player = "10.213.77.1", "10.213.77.2"

    @staticmethod
    def run(*command):
        return subprocess.run(command, check=True, capture_output=True, text=True).stdout.strip()

    def __enter__(self):
        inside = ("ip", "netns", "exec", self.name)
        self.run("ip", "netns", "add", self.name)
        self.run("ip", "link", "add", self.outside, "type", "veth", "peer", "name", self.inside, "netns", self.name)
        self.run("ip", "address", "add", f"{self.host}/24", "dev", self.outside)
        self.run("ip", "link", "set", self.outside, "up")
        self.run(*inside, "ip", "address", "add", f"{self.player}/24", "dev", self.inside)
        self.run(*inside, "ip", "link", "set", self.inside, "up")
        end = self.run(*inside, "cat", f"/sys/class/net/{self.inside}/address")
        self.run("ip", "neighbour", "replace", self.player, "lladdr", end, "dev", self.outside, "nud", "permanent")
        return self

    def __exit__(self, *_):
        subprocess.run(("ip", "link", "delete", self.outside), capture_output=True)
        subprocess.run(("ip", "netns", "delete", self.name), capture_output=True)

    def pull(self):
        """Packets go out and nobody is there: none comes back, and no error either."""
        self.run("ip", "netns", "exec", self.name, "ip", "address", "flush", "dev", self.inside)


def cut_off(server, patience=PATIENCE):
    """The same for one whose packets are lost; None where a network can't be made."""
    try:
        with Cable() as cable:
            return measure(server, lambda _: cable.pull(), ("ip", "netns", "exec", cable.name), cable.host, patience)
    except (subprocess.CalledProcessError, FileNotFoundError, PermissionError):
        return None


def back_in_the_same(server, away=AWAY):
    """1 when who breaks off and comes back with his token has his louse again, 0 when not; None: no token is given."""
    first = LineClient("127.0.0.1", server.port)
    welcome = first.join(name="back", resume=True)
    if not welcome["resume_token"]:
        return None
    first.abort()
    time.sleep(away)
    second = LineClient("127.0.0.1", server.port)
    again = second.join(name="back", resume=welcome["resume_token"])
    second.socket.close()
    return 1 if again["id"] == welcome["id"] else 0


if __name__ == "__main__":
    play(sys.argv[1], int(sys.argv[2]))
