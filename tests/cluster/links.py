"""A host's line to NATS is cut while the line of its players is whole; a network of their own for each host.

Usage: links.py [--rounds N] [--ways both,out,in] [--cut SECONDS] [--bots N] [--silence MS]

Each round, for each way: calm, then the line of the owner is cut, by pulling it out (`both`), or so that what the host sends is
lost (`out`) or what it is sent (`in`). The other host takes over; the cut one plays on with its players. Then the line is whole
again, and within 2 s the former owner is fenced and its players are in their lice at the other host. At the end the joined log is
proven, and the ticks while the line was cut are held against those of the calm: none waits for NATS.

Needs network namespaces: root, or a system that lets users have their own."""

import argparse
import math
import os
import shutil
import statistics
import subprocess
import sys
import time

import metrics
import stage

INSIDE = "WOODLOUSE_IN_A_NETWORK_OF_ITS_OWN"
FENCED_WITHIN = 2.0  # seconds after the line is whole
LATE = 0.005         # docs/alarms.yml rings where one tick in a hundred is later
NOBODY = "02:00:00:00:00:01"  # a link-layer address that no interface has: the frame is sent, and nobody takes it


def run(*command):
    done = subprocess.run(command, capture_output=True, text=True)
    assert done.returncode == 0, f"{' '.join(command)}: {done.stderr}"


def enter_a_network():
    """Begins this program again where it may make networks, and where they vanish with it."""
    for tool in ("ip", "unshare", "mount"):
        if shutil.which(tool) is None:
            skip(f"{tool} is missing:  apt-get install {'iproute2' if tool == 'ip' else 'util-linux'}")
    command = ["unshare", "--net", "--mount"] + ([] if os.geteuid() == 0 else ["--user", "--map-root-user"])
    tried = subprocess.run([*command, "sh", "-c", "mount -t tmpfs none /run && ip link set lo up && ip netns add tried"],
                           capture_output=True, text=True)
    if tried.returncode != 0:
        skip("network namespaces can't be made, which root may: " + tried.stderr.strip())
    os.execvpe(command[0], [*command, sys.executable, *sys.argv], {**os.environ, INSIDE: "1"})


def skip(why):
    print("SKIPPED:", why)
    sys.exit(77)


class Lines:
    """A host's two lines to the middle, where NATS and the players are: each a pair of interfaces, with addresses of RFC 2544."""

    def __init__(self, name, number):
        self.name = name
        self.nats, self.host_at_nats = f"198.18.{number}.1", f"198.18.{number}.2"
        self.address = f"198.19.{number}.2"  # for players
        run("ip", "netns", "add", name)
        for line, net in (("nats", 18), ("play", 19)):
            run("ip", "link", "add", f"{name}-{line}", "type", "veth", "peer", "name", line, "netns", name)
            run("ip", "addr", "add", f"198.{net}.{number}.1/30", "dev", f"{name}-{line}")
            run("ip", "-n", name, "addr", "add", f"198.{net}.{number}.2/30", "dev", line)
            run("ip", "link", "set", f"{name}-{line}", "up")
            run("ip", "-n", name, "link", "set", line, "up")
        run("ip", "-n", name, "link", "set", "lo", "up")

    def cut(self, way):
        if way == "both":
            run("ip", "link", "set", f"{self.name}-nats", "down")  # the other end: the host sees that nothing is plugged in
        elif way == "out":
            run("ip", "-n", self.name, "neigh", "replace", self.nats, "lladdr", NOBODY, "dev", "nats", "nud", "permanent")
        else:
            run("ip", "neigh", "replace", self.host_at_nats, "lladdr", NOBODY, "dev", f"{self.name}-nats", "nud", "permanent")

    def heal(self, way):
        if way == "both":
            run("ip", "link", "set", f"{self.name}-nats", "up")
        elif way == "out":
            run("ip", "-n", self.name, "neigh", "del", self.nats, "dev", "nats")
        else:
            run("ip", "neigh", "del", self.host_at_nats, "dev", f"{self.name}-nats")


class Found:
    """What the rounds of a way have told, in seconds."""

    def __init__(self):
        self.takeovers, self.fences, self.returns = [], [], []
        self.calm, self.cut = {}, {}  # ticks' lateness
        self.unaddressed = 0  # players that were sent on without being told where to


def wait(condition, what, patience=stage.PATIENCE):
    end = time.monotonic() + patience
    while not condition():
        assert time.monotonic() < end, what()
        time.sleep(0.005)


class Rounds:
    def __init__(self, nats, lines, hosts, clients, options):
        self.nats, self.lines, self.hosts, self.clients, self.options = nats, lines, hosts, clients, options
        self.owner, self.other = "a", "b"

    def logs(self):
        return "\n".join(f"--- {name}\n{host.log()}" for name, host in self.hosts.items())

    def owners(self):
        return self.nats.command("status")[1].count("owns the rooms")

    def check_here(self, address):
        """Every player sees frames of that host alone, and its line is whole."""
        for bot in self.clients.bots:
            assert bot.newest is not None and time.monotonic() - bot.newest[0] < 1.5, f"{bot.name} sees nothing more:\n{self.logs()}"
            assert bot.frames[-1][1] == address, (bot.name, bot.frames[-1], address)

    def one(self, way, found):
        owner, other = self.hosts[self.owner], self.hosts[self.other]
        lice = {bot.name: bot.welcomes[-1][1]["id"] for bot in self.clients.bots}
        welcomes = {bot.name: len(bot.welcomes) for bot in self.clients.bots}
        losses = {bot.name: len(bot.losses) for bot in self.clients.bots}
        owned, fenced, follows = (log.count(word) for log, word in ((other.log(), "cluster_owns"), (owner.log(), "FENCED"),
                                                                    (owner.log(), "cluster_follows")))
        before = metrics.Metrics(owner.door)
        time.sleep(self.options.cut)
        calm = metrics.Metrics(owner.door)
        acknowledged = self.nats.tick()
        assert acknowledged > 0 and self.owners() == 1, self.logs()

        self.lines[self.owner].cut(way)
        cut_at = time.monotonic()
        wait(lambda: other.log().count("cluster_owns") > owned, lambda: f"{way}: nobody took over:\n{self.logs()}")
        found.takeovers.append(time.monotonic() - cut_at)
        time.sleep(max(0.0, cut_at + self.options.cut - time.monotonic()))
        self.check_here(owner.address)
        for bot in self.clients.bots:
            assert len(bot.losses) == losses[bot.name] and len(bot.welcomes) == welcomes[bot.name], f"{way}: {bot.name} lost its line"
            # Told as soon as the line is known to be cut, which is after three pings of a second.
            assert self.options.cut < 5 or "not_durable" in bot.notices, f"{way}: {bot.name} was told nothing:\n{self.logs()}"
        end = metrics.Metrics(owner.door)
        moves = end.total("woodlouse_room_clock_moves_total") - before.total("woodlouse_room_clock_moves_total")
        assert moves == 0, f"{way}: the clock moved {moves} times"
        readings = [reading.within(metrics.LATENESS) for reading in (before, calm, end)]
        found.calm = metrics.together(found.calm, metrics.since(readings[0], readings[1]))
        found.cut = metrics.together(found.cut, metrics.since(readings[1], readings[2]))

        self.lines[self.owner].heal(way)
        healed_at = time.monotonic()
        wait(lambda: owner.log().count("FENCED") > fenced, lambda: f"{way}: not fenced in time:\n{self.logs()}", FENCED_WITHIN)
        found.fences.append(time.monotonic() - healed_at)
        self.clients.wait_for(lambda bot: len(bot.welcomes) > welcomes[bot.name], f"{way}: not all came back:\n{self.logs()}")
        found.returns.append(max(bot.welcomes[-1][0] for bot in self.clients.bots) - healed_at)
        went_on = other.went_on_at()
        assert went_on >= acknowledged, f"{way}: goes on at tick {went_on}, {acknowledged} was acknowledged"
        for bot in self.clients.bots:
            welcome = bot.welcomes[-1][1]
            assert welcome["resumed"] and welcome["id"] == lice[bot.name], (way, bot.name, welcome)
            # No address where nothing was heard of the other yet: the player asks again where it was.
            assert bot.byes[-1]["code"] == "moved" and bot.byes[-1].get("address", other.address) == other.address, (way, bot.byes)
            found.unaddressed += "address" not in bot.byes[-1]
        owner.wait_for("cluster_follows", follows + 1)
        self.clients.wait_for(lambda bot: bot.frames[-1][1] == other.address, f"{way}: no frames of the new owner came:\n{self.logs()}")
        time.sleep(0.5)
        self.check_here(other.address)
        assert self.owners() == 1, self.nats.command("status")[1]
        self.owner, self.other = self.other, self.owner


def tell(way, found):
    def figures(values):
        return f"median {1000 * statistics.median(values):.0f}, at most {1000 * max(values):.0f}"

    late = [100 * metrics.share_above(counts, LATE) for counts in (found.calm, found.cut)]
    print(f"{way}: {len(found.fences)} cuts; in ms: from the cut to the other's taking over {figures(found.takeovers)}; "
          f"from the line whole again to FENCED {figures(found.fences)}, to the last player back {figures(found.returns)}; "
          f"sent on without an address: {found.unaddressed}")
    print(f"{way}: ticks more than {1000 * LATE:.0f} ms late: calm {late[0]:.2f} %, cut {late[1]:.2f} % of {found.cut[float('inf')]:.0f}; "
          f"99 % within {1000 * metrics.quantile(found.calm, 0.99):.2f} and {1000 * metrics.quantile(found.cut, 0.99):.2f} ms", flush=True)


def is_no_later(all_found):
    """Whether one tick in a hundred more was late while lines were cut, by more than three deviations of what chance does to so few."""
    calm, cut = {}, {}
    for found in all_found:
        calm, cut = metrics.together(calm, found.calm), metrics.together(cut, found.cut)
    ticks = [counts[float("inf")] for counts in (calm, cut)]
    assert min(ticks) > 0
    late = [metrics.share_above(counts, LATE) for counts in (calm, cut)]
    share = (late[0] * ticks[0] + late[1] * ticks[1]) / sum(ticks)
    chance = 3 * math.sqrt(share * (1 - share) * (1 / ticks[0] + 1 / ticks[1]))
    print(f"ticks more than {1000 * LATE:.0f} ms late, of all: calm {100 * late[0]:.2f} %, cut {100 * late[1]:.2f} % of {ticks[1]:.0f}, by chance {100 * chance:.2f} %")
    return late[1] <= late[0] + 0.01 + chance


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--ways", default="both,out,in")
    parser.add_argument("--cut", type=float, default=2.0, help="seconds of a cut, and of the calm before it")
    parser.add_argument("--bots", type=int, default=4)
    parser.add_argument("--silence", type=int, default=300)
    options = parser.parse_args()
    ways = options.ways.split(",")
    assert set(ways) <= {"both", "out", "in"}, ways
    stage.skip_where_missing()
    if INSIDE not in os.environ:
        enter_a_network()
    run("mount", "-t", "tmpfs", "none", "/run")  # where `ip netns` keeps its names
    run("ip", "link", "set", "lo", "up")
    lines = {name: Lines(name, number) for number, name in enumerate("ab", 1)}
    found = {way: Found() for way in ways}
    with stage.Nats(1, address="0.0.0.0", silence_ms=options.silence) as nats:
        hosts, rounds = {}, None
        try:
            for name, its in lines.items():
                hosts[name] = stage.Host(nats, name, prefix=("ip", "netns", "exec", name), listen=its.address, file=nats.file_for(its.nats))
                hosts[name].wait_for("cluster_owns" if name == "a" else "cluster_follows")
            with stage.Clients(options.bots, [host.address for host in hosts.values()]) as clients:
                clients.wait_here()
                rounds = Rounds(nats, lines, hosts, clients, options)
                for number in range(options.rounds):
                    for way in ways:
                        rounds.one(way, found[way])
        finally:
            for name in sorted(hosts, key=lambda name: rounds is not None and name == rounds.owner):
                hosts[name].end()  # the owner last, so that it hands over to nobody
        code, said, proofs = nats.joined()
    for way in ways:
        tell(way, found[way])
    no_later = is_no_later(found.values())
    print("the joined log:", said.strip().splitlines()[-1])
    for name, (verified, text) in proofs.items():
        print(f"{name}: {text.strip()}")
    epochs = options.rounds * len(ways) + 1
    sound = code == 0 and len(proofs) == 1 and all(verified == 0 for verified, _ in proofs.values()) and f"{epochs + 1} epochs" in said
    if not sound:
        print(said)
    sys.exit(0 if sound and no_later else 1)


if __name__ == "__main__":
    main()
