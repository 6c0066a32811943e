#!/usr/bin/env python3
"""Everything that crowds and bad neighbours do, at once and for long, against one server that records: what healthy players have left.

    tests/siege/siege.py BIN_DIR                  ten minutes; BIN_DIR has woodlouse-server and woodlouse-swarm
    tests/siege/siege.py BIN_DIR --minutes 1      whether it runs

Prints a table and exits with 1 where a healthy client had less than it should. Wants Linux's loopback, two cores, and nothing else on them.
"""
import argparse
import os
import pathlib
import re
import signal
import subprocess
import sys
import tempfile
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from nuisance import Nuisance  # noqa: E402
from web_nuisance import Onlookers, Operator, WebNuisance  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
GAP_P99 = 60.0   # ms; frames come each 50 ms: a client that shows others 100 ms late still has one in hand
GAP_MAX = 250.0  # ms; four frames: lice are carried on by their velocity for so long, and a player notices what is longer
ENDS_WITHIN = 2.0  # s
SERVER = ("--bots", "50", "--bots-alone", "play", "--record-every", "60s", "--record-keep", "200M", "--join-per-s-address", "200")
HEALTHY = "--bots 0 --healthy 5 --healthy-role player --before 0"
STEADY_LOADS = (
    "--chatters 60 --chats-per-second 4 --stalled 10 --bots 60 --askers 10 --ask get_map --churn 10 --healthy 0 --addresses 4",
    "--bots 20 --inputs-per-tick 200 --askers 5 --ask resync --healthy 0 --addresses 2",
)
WAVE, WAVE_EVERY, WAVE_SECONDS = "--spectators 500 --joins-per-second 500 --addresses 4 --healthy 0", 30.0, 10.0
HANGUP_EVERY = 20.0
SAMPLE_EVERY = 5.0
ONLOOKERS = 24
CERTIFICATES = ROOT / "tests" / "tls"


class Besieged:
    """The server, and what it has used up."""

    def __init__(self, programs, folder):
        self.recordings = folder / "recordings"
        self.recordings.mkdir()
        self.log = folder / "log"
        self.verify = [programs / "woodlouse-server", "verify"]
        self.admin = str(folder / "admin.sock")
        command = [programs / "woodlouse-server", "--map", ROOT / "maps" / "volcano.json", "--listen", "127.0.0.1:0", "--web", "127.0.0.1:0",
                   "--tls-cert", CERTIFICATES / "first_certificate.pem", "--tls-key", CERTIFICATES / "first_key.pem",
                   "--admin", self.admin, "--ban-file", folder / "bans", "--record", f"{self.recordings}/", *SERVER]
        with open(self.log, "wb") as log:
            self.process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=log, text=True)
        self.address = self.process.stdout.readline().split()[1]
        self.web_address = re.search(r"//(.*)/", self.process.stdout.readline())[1]
        self.process.stdout.readline()  # admin

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.process.kill()
        self.process.wait()

    def resident_mb(self):
        status = pathlib.Path(f"/proc/{self.process.pid}/status").read_text()
        return int(re.search(r"^VmRSS:\s+(\d+)", status, re.MULTILINE)[1]) / 1024

    def sample(self, began):
        files = len(os.listdir(f"/proc/{self.process.pid}/fd"))
        recorded = sum(file.stat().st_size for file in self.recordings.iterdir()) / 2**20
        return time.monotonic() - began, self.resident_mb(), files, self.log.stat().st_size / 1024, recorded

    def stop(self):
        """What is wrong with how it ends, and its summary."""
        begun = time.monotonic()
        self.process.send_signal(signal.SIGTERM)
        try:
            summary, _ = self.process.communicate(timeout=30)
        except subprocess.TimeoutExpired:
            self.process.kill()
            return ["the server does not end"], self.process.communicate()[0]
        took = time.monotonic() - begun
        faults = []
        if self.process.returncode != 0 or took > ENDS_WITHIN:
            faults.append(f"the server ended with {self.process.returncode} after {took:.1f} s")
        verdict = subprocess.run([*self.verify, *sorted(self.recordings.iterdir())], capture_output=True, text=True, check=False)
        if verdict.returncode != 0:
            faults.append(f"a recording does not verify: {verdict.stdout}{verdict.stderr}")
        return faults, summary


def besiege(server, swarm, seconds):
    """(the healthy clients' report, samples, rows of what was at the new doors, faults). The server may be gone before its time."""
    def start(load, lasts):
        command = [swarm, server.address, *load.split(), "--seconds", str(lasts)]
        return subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)

    began = time.monotonic()
    healthy = start(HEALTHY, seconds)
    time.sleep(1.0)
    loads = [start(load, seconds) for load in STEADY_LOADS]
    samples, next_wave, next_hangup, next_sample = [], began + 5.0, began + HANGUP_EVERY, began
    onlookers = Onlookers(server.web_address, ONLOOKERS)
    with Nuisance(server.address), WebNuisance(server.web_address) as web, onlookers, Operator(server.admin) as operator:
        while healthy.poll() is None and server.process.poll() is None:
            now = time.monotonic()
            if now >= next_wave:
                loads = [load for load in loads if load.poll() is None] + [start(WAVE, WAVE_SECONDS)]
                next_wave = now + WAVE_EVERY
            if now >= next_hangup:
                server.process.send_signal(signal.SIGHUP)
                next_hangup = now + HANGUP_EVERY
            if now >= next_sample:
                samples.append(server.sample(began))
                next_sample = now + SAMPLE_EVERY
            time.sleep(0.1)
    for load in loads:
        load.kill()
        load.communicate()
    sent_away = sum(onlooker.times_sent_away for onlooker in onlookers.all)
    rows = [("bad visits at --web", str(web.visits), ""),
            ("onlookers by view and by inputs", f"{sum(onlooker.bytes for onlooker in onlookers.all) / seconds / ONLOOKERS / 1e3:.1f} KB/s each", ""),
            ("onlookers sent away", str(sent_away), "0"), ("an operator's orders done, scrapes", f"{operator.done}, {operator.scrapes}", "")]
    faults = web.faults[:3] + ([f"{sent_away} onlookers were sent away"] if sent_away else [])
    faults += [f"the operator's {line}: {answer}" for line, answer in operator.refused[:3]]
    faults += [] if operator.scrapes and web.visits else ["nobody was at the new doors"]
    return healthy.communicate()[0], samples, rows, faults


def judged(report):
    """The healthy clients' figures, and what is wrong with them."""
    found = re.search(r"^healthy under load: gap p50 ([\d.]+) p99 ([\d.]+) max ([\d.]+) ms \(\d+\), missed (\d+) of (\d+), ack p50 [\d.]+ p99 ([\d.]+)",
                      report, re.MULTILINE)
    lost = re.search(r"^healthy: .*", report, re.MULTILINE)
    if not found or ", 0 disconnected" not in lost[0]:
        return [], [f"the healthy clients did not last:\n{report}"]
    p50, p99, longest, missed, of, ack = map(float, found.groups())
    rows = [("healthy gap p50 / p99 / max", f"{p50:.1f} / {p99:.1f} / {longest:.1f} ms", f"p99 {GAP_P99:.0f}, max {GAP_MAX:.0f} ms"),
            ("healthy frames missed", f"{missed:.0f} of {of:.0f}", ""), ("healthy ack p99", f"{ack:.1f} ms", "")]
    faults = [f"a healthy gap's {name} is {value:.1f} ms, more than {most:.0f}"
              for name, value, most in (("p99", p99, GAP_P99), ("max", longest, GAP_MAX)) if value > most]
    return rows, faults


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("programs", type=lambda text: pathlib.Path(text).resolve(), metavar="BIN_DIR")
    parser.add_argument("--minutes", type=float, default=10.0)
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as scratch:
        with Besieged(arguments.programs, pathlib.Path(scratch)) as server:
            report, samples, doors, door_faults = besiege(server, arguments.programs / "woodlouse-swarm", 60.0 * arguments.minutes)
            faults, summary = server.stop()
    rows, more = judged(report)
    more += door_faults
    print(f"{'at s':>6} {'memory MB':>10} {'descriptors':>12} {'log KB':>8} {'recorded MB':>12}")
    for at, memory, files, log, recorded in samples[::max(1, len(samples) // 12)]:
        print(f"{at:6.0f} {memory:10.1f} {files:12} {log:8.0f} {recorded:12.1f}")
    for what, figure, most in [*rows, *doors]:
        print(f"{what:<30} {figure:<28} {most}")
    print(summary, end="")
    print("\n".join([*faults, *more]) or "held")
    return 1 if faults or more else 0


if __name__ == "__main__":
    sys.exit(main())
