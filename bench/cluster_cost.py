#!/usr/bin/env python3
"""What a cluster costs: a tick with its log and without, in turns; NATS; a host that stands by; and many small rooms in one server.

    bench/cluster_cost.py BIN [--rounds 5] [--seconds 10] [--only tick,shard,rooms]

BIN is a tree's folder of programs. The server that is measured has core 0; the load, NATS and who stands by have core 1, and nothing else may
run on either. Shares are of a core, by the scheduler's own nanoseconds. A tick's work is that of its room's strand
(woodlouse_room_tick_work_seconds); lines, packing and NATS are another thread's, in the server's share. Medians of all rounds.
"""
import argparse
import contextlib
import os
import pathlib
import statistics
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent
SETTLED_S = 5.0
MEASURED_CORE, OTHER_CORE = "0", "1"
SHARD_ROOMS, MANY_ROOMS = 16, 1000  # a server has at most 1,024, and so has a shard
HOUSE = ("--bots", "8", "--bots-alone", "play")
LATENESS, WORK = "woodlouse_room_tick_lateness_seconds", "woodlouse_room_tick_work_seconds"


class Server:
    """A server on a core; cluster: the file of one, or nothing."""

    def __init__(self, scratch, name, *options, rooms=1, cluster=None, core=MEASURED_CORE):
        self.door = os.path.join(scratch, f"{time.monotonic_ns()}.sock")
        self.log_file = self.door + ".log"
        command = ["taskset", "-c", core, stage.PROGRAM, "--mode", "roam", "--listen", "127.0.0.1:0", "--admin", self.door, "--log-file", self.log_file]
        command += [part for _ in range(rooms) for part in ("--map", os.path.join(stage.MAPS, "volcano.json"))]
        command += ["--join-per-s-address", "4000", "--join-per-s-room", "4000", "--per-address", "4000", *options]
        command += ["--cluster", cluster, "--cluster-host", name] if cluster else []
        self.process = subprocess.Popen(command, stdout=subprocess.PIPE, text=True)
        first = self.process.stdout.readline()
        if not first.startswith("listening "):
            raise RuntimeError(first + self.log())
        self.address = first.split()[1]

    def log(self):
        return pathlib.Path(self.log_file).read_text() if os.path.exists(self.log_file) else ""

    def wait_for(self, word):
        end = time.monotonic() + 30
        while word not in self.log():
            if time.monotonic() > end:
                raise RuntimeError(f"the server never said {word}:\n{self.log()}")
            time.sleep(0.05)

    def metrics(self):
        return metrics.Metrics(self.door)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.process.terminate()
        self.process.communicate()  # a line of each room


def processor_seconds(process):
    """On a processor, by the scheduler's own nanoseconds; /proc/PID/stat counts hundredths of a second."""
    threads = pathlib.Path(f"/proc/{process.pid}/task").iterdir()
    return sum(int((thread / "schedstat").read_text().split()[0]) for thread in threads) / 1e9


def megabytes(process):
    for line in pathlib.Path(f"/proc/{process.pid}/status").read_text().splitlines():
        if line.startswith("VmRSS:"):
            return int(line.split()[1]) / 1024
    raise RuntimeError("no VmRSS")


def quantile_ms(counts, share):
    """Between the two bounds of the histogram that it lies in, as if all there were spread evenly; past the last one: that one."""
    wanted, before, below = share * counts[float("inf")], 0.0, 0.0
    for bound, count in sorted(counts.items()):
        if count >= wanted:
            return 1e3 * (below if bound == float("inf") else below + (bound - below) * (wanted - before) / max(1.0, count - before))
        before, below = count, bound
    raise RuntimeError("an empty histogram")


def measured(server, seconds, others=()):
    """While so long: figures of the server, and of other processes {name: process}."""
    processes = {"server": server.process, **dict(others)}
    before, used, begun = server.metrics(), {name: processor_seconds(process) for name, process in processes.items()}, time.monotonic()
    time.sleep(seconds)
    used = {name: processor_seconds(process) - used[name] for name, process in processes.items()}
    lasted, after = time.monotonic() - begun, server.metrics()
    ticks = after.total(WORK + "_count") - before.total(WORK + "_count")
    late = metrics.since(before.within(LATENESS), after.within(LATENESS))
    found = {"work us": 1e6 * (after.total(WORK + "_sum") - before.total(WORK + "_sum")) / ticks, "ticks/s": ticks / lasted,
             "late p50 ms": quantile_ms(late, 0.5), "late p99 ms": quantile_ms(late, 0.99)}
    for name, process in processes.items():
        found[f"{name} core %"] = 100 * used[name] / lasted
        found[f"{name} MB"] = megabytes(process)
    return found


def on_other_core(process):
    for thread in pathlib.Path(f"/proc/{process.pid}/task").iterdir():
        os.sched_setaffinity(int(thread.name), {int(OTHER_CORE)})


@contextlib.contextmanager
def swarm(address, bots, seconds):
    """So many bots that steer, for so long at least."""
    load = subprocess.Popen(["taskset", "-c", OTHER_CORE, os.path.join(os.path.dirname(stage.PROGRAM), "woodlouse-swarm"), address, "--bots", str(bots),
                             "--seconds", str(seconds + 2 * SETTLED_S)], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    try:
        yield
    finally:
        load.kill()
        load.wait()


class Setting:
    """What is measured: of `rooms` rooms with so many bots by wire, or the house's."""

    def __init__(self, scratch, seconds, rooms, bots):
        self.scratch, self.seconds, self.rooms, self.bots = scratch, seconds, rooms, bots

    def run(self, server, others=()):
        if self.bots == 0:
            time.sleep(SETTLED_S)
            return measured(server, self.seconds, others)
        with swarm(server.address, self.bots, self.seconds):
            time.sleep(SETTLED_S)
            return measured(server, self.seconds, others)

    def options(self):
        return () if self.bots else HOUSE

    def alone(self):
        with Server(self.scratch, "alone", *self.options(), rooms=self.rooms) as server:
            return self.run(server)

    def logged(self, with_follower):
        with stage.Nats(1) as nats:
            on_other_core(nats.processes[0])
            with Server(self.scratch, "a", *self.options(), rooms=self.rooms, cluster=nats.file) as owner, contextlib.ExitStack() as more:
                owner.wait_for("cluster_owns")
                others = {"nats": nats.processes[0]}
                if with_follower:
                    follower = more.enter_context(Server(self.scratch, "b", *self.options(), rooms=self.rooms, cluster=nats.file, core=OTHER_CORE))
                    follower.wait_for("cluster_follows")
                    others["follower"] = follower.process
                stored, begun = nats.stored(), time.monotonic()
                found = self.run(owner, others)
                found["log kB/s"] = (nats.stored() - stored) / (time.monotonic() - begun) / 1e3
                return found


def medians(runs):
    return {name: statistics.median(run[name] for run in runs) for name in runs[0]}


def tell(what, found):
    print(f"{what:<34} " + "  ".join(f"{name} {value:.1f}" if value >= 20 else f"{name} {value:.3f}" for name, value in found.items()), flush=True)


def in_turns(what, setting, rounds):
    """Alone, logged, logged with a follower, again and again."""
    ways = {"alone": setting.alone, "logged": lambda: setting.logged(False), "logged and followed": lambda: setting.logged(True)}
    runs = {way: [] for way in ways}
    for number in range(rounds):
        for way in ways if number % 2 == 0 else reversed(ways):
            runs[way].append(ways[way]())
    for way in ways:
        tell(f"{what}, {way}", medians(runs[way]))
    for way in list(ways)[1:]:
        for figure in ("work us", "server core %"):
            ratios = [one[figure] / other[figure] for one, other in zip(runs[way], runs["alone"])]
            print(f"{what}, {way} / alone: {figure.split()[0]} median {statistics.median(ratios):.3f} of {' '.join(f'{ratio:.2f}' for ratio in sorted(ratios))}", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("programs", type=pathlib.Path, metavar="BIN")
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--seconds", type=float, default=10.0)
    parser.add_argument("--only", default="tick,shard,rooms")
    arguments = parser.parse_args()
    wanted = set(arguments.only.split(","))
    if wanted - {"tick", "shard", "rooms"}:
        parser.error("--only takes tick, shard, rooms")
    os.environ["WOODLOUSE_SERVER"] = str(arguments.programs.resolve() / "woodlouse-server")
    os.environ["WOODLOUSE_MAPS"] = str(ROOT / "maps")
    sys.path.insert(0, str(ROOT / "tests" / "cluster"))
    global stage, metrics
    import metrics
    import stage
    if stage.missing():
        sys.exit("cluster_cost.py: " + stage.missing())
    with tempfile.TemporaryDirectory() as scratch:
        if "tick" in wanted:
            in_turns("1 room, 200 bots", Setting(scratch, arguments.seconds, 1, 200), arguments.rounds)
        if "shard" in wanted:
            in_turns(f"{SHARD_ROOMS} rooms of 8", Setting(scratch, arguments.seconds, SHARD_ROOMS, 0), arguments.rounds)
        if "rooms" in wanted:
            in_turns(f"{MANY_ROOMS:,} rooms of 8", Setting(scratch, arguments.seconds, MANY_ROOMS, 0), arguments.rounds)


if __name__ == "__main__":
    main()
