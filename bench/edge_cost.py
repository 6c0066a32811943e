#!/usr/bin/env python3
"""What a watched frame costs at an edge of a cluster, beside the room's own host and beside a bare loop of send(): processor time above that
of host and edge alone, in turns.

    bench/edge_cost.py BIN [--watchers 2000] [--rounds 5] [--seconds 8]

BIN is a tree's folder of programs. Host, edge and nats-server have core 0, whoever watches (woodlouse-swarm) core 1, and nothing else may run
on either. All watch at 20 Hz a room of 200 lice. The bare loop (woodlouse-send-floor) sends as many bytes to as many readers, as often. Prints
each round, then medians, the ratio of edge and host and what both take above the bare loop; what host, edge and nats-server take alone; and
what the room's log is on its way, beside one watcher's frames.
"""
import argparse
import json
import os
import pathlib
import re
import statistics
import subprocess
import sys
import tempfile
import time

from crowd.programs import Load, number
from web_cost import MAP, SETTLED_S, STATE_HZ, Server

JOINS_PER_SECOND, SETTLED_AFTER_S, ADDRESSES = 500, 3, 8


class Process(Server):
    def __init__(self, command, port=None):
        self.process = subprocess.Popen(["taskset", "-c", "0", *map(str, command)], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
        self.lines_port = port or int(re.search(r":(\d+)$", self.process.stdout.readline())[1])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("programs", type=pathlib.Path)
    parser.add_argument("--watchers", type=int, default=2000)
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--seconds", type=float, default=8)
    options = parser.parse_args()
    server, folder = options.programs / "woodlouse-server", pathlib.Path(tempfile.mkdtemp(prefix="edge-cost-"))
    os.sched_setaffinity(0, {1})
    port = 42222
    many = ("--listen", "127.0.0.1:0", "--per-address", "4000", "--join-per-s-address", "4000", "--join-per-s-room", "4000")
    with Process(["nats-server", "-a", "127.0.0.1", "-p", port, "-js", "-sd", folder / "store", "-l", folder / "nats.log"], port) as nats:
        time.sleep(1)
        file = folder / "cluster.json"
        file.write_text(json.dumps({"nats": [f"nats://127.0.0.1:{port}"]}))
        subprocess.run([server, "cluster", "init", file], check=True, stdout=subprocess.DEVNULL)
        with Process([server, "--map", MAP, "--mode", "roam", "--bots", "200", "--bots-alone", "play", "--cluster", file, "--cluster-host", "a", *many]) as host, \
                Process([server, "--cluster", file, "--cluster-edge", *many]) as edge:
            time.sleep(3 + SETTLED_S)
            alone = {}
            begun, before = time.monotonic(), [one.processor_seconds() for one in (host, edge, nats)]
            stored = log_bytes(server, file)
            time.sleep(2 * options.seconds)
            passed = time.monotonic() - begun
            for name, one, was in zip(("host", "edge", "nats-server"), (host, edge, nats), before):
                alone[name] = (one.processor_seconds() - was) / passed
            log = (log_bytes(server, file) - stored) / passed
            load = Load(options.programs)
            costs = {"host": [], "edge": [], "bare loop": []}
            for _ in range(options.rounds):
                said = []
                for name, one in (("host", host), ("edge", edge)):
                    each, size = cost_of_a_frame(load, one, alone[name], options)
                    costs[name].append(each)
                    said.append(f"{name} {each:.2f} us a frame of {size} bytes")
                costs["bare loop"].append(load.send_floor(options.watchers, size, STATE_HZ, options.seconds))
                said.append(f"bare loop {costs['bare loop'][-1]:.2f}")
                print("   ".join(said), f"  ratio {costs['edge'][-1] / costs['host'][-1]:.3f}", flush=True)
            ratio = statistics.median(e / h for e, h in zip(costs["edge"], costs["host"]))
            print(", ".join(f"{name} {statistics.median(its):.2f} us a frame" for name, its in costs.items()) + f"; median of the ratios {ratio:.3f}")
            print("above the bare loop, median of the rounds: " + ", ".join(
                f"{name} {statistics.median(c - b for c, b in zip(costs[name], costs['bare loop'])):.2f} us" for name in ("host", "edge")) + " (goal 1.5)")
            print("alone: " + ", ".join(f"{name} {cores:.4f} cores" for name, cores in alone.items()) + f"; the log {log / 1e3:.1f} KB/s")


def cost_of_a_frame(load, server, alone, options):
    """(processor time that the server takes for a frame of one watcher above what it takes alone [us], the frame's bytes)."""
    swarm = load.start("woodlouse-swarm", f"127.0.0.1:{server.lines_port}", "--spectators", options.watchers, "--addresses", ADDRESSES,
                       "--joins-per-second", JOINS_PER_SECOND, "--healthy", 0, "--seconds", options.seconds)
    time.sleep(options.watchers / JOINS_PER_SECOND + SETTLED_AFTER_S)  # their coming, of which all are told, is left out
    before, begun = server.processor_seconds(), time.monotonic()
    time.sleep(options.seconds - SETTLED_AFTER_S)
    cores = (server.processor_seconds() - before) / (time.monotonic() - begun)
    report, error = swarm.communicate()
    assert swarm.returncode == 0, error
    missed, due = number(r"^others: .*missed (\d+)", report), number(r"^others: .*missed \d+ of (\d+)", report)
    came = options.watchers * STATE_HZ * (1 - missed / due)
    return 1e6 * (cores - alone) / came, round(number(r"^others received (\d+)", report) / came)


def log_bytes(server, file):
    said = subprocess.run([server, "cluster", "status", file], capture_output=True, text=True, check=True).stdout
    return int(re.search(r"(\d+) bytes", said)[1])


if __name__ == "__main__":
    sys.exit(main())
