"""The rows of bench/crowd_table.py: what each measures, and how its figures are told."""
import dataclasses
import statistics
import subprocess
import time

from log_flood import log_bytes_per_second
from lost_player import back_in_the_same, cut_off, stopped
from programs import Server, ack, gap, number, refused

STEADY = "--bots 200 --bots-alone play"  # the server's: 200 lice that move, also where spectators are alone
CROWD_SIZES = (1000, 2000, 3000, 4000, 4500)
SETTLING = 1.3  # s, after the last has come
SEATS = 1000  # of a room, where a server has no option for it


@dataclasses.dataclass(frozen=True)
class Bench:
    """What a row is measured with."""
    load: object         # programs.Load
    scratch: object      # a folder that is thrown away
    seconds: float       # that a load lasts
    churn: float         # that clients come and vanish
    patience: float      # for a louse to rest
    options: tuple = ()  # more of the server's, where it has them

    def server(self, programs, options="", **more):
        return Server(programs, self.scratch, *options.split(), *self.options, **more)


@dataclasses.dataclass(frozen=True)
class Row:
    name: str
    what: str
    command: str    # of the load; {seconds}, {churn}
    goal: str
    measure: object  # (bench, programs, command) -> figures, or None where this server can't
    told: object     # figures -> text


def under_load(server_options, **more):
    """Runs the row's load beside a server of these options; what they said to each other."""
    def run(bench, programs, command, extra=""):
        with bench.server(programs, server_options, **more) as server:
            report = bench.load.swarm(server.address, command + extra)
        return report, server
    return run


def gaps(bench, programs, command):
    report, _ = under_load(STEADY.replace("200", "20"))(bench, programs, command)
    return gap(report, "p99"), gap(report, "max"), refused(report)


def gaps_text(p99, longest, away):
    return f"{p99:.0f} / {longest:.0f} ms" + (f" ({away:.0f} refused)" if away else "")


def crowd_of(bench, programs, command, size):
    """The report, the server and the rooms: one, or as many as it takes where one has not the seats."""
    load = command.format(size=size, addresses=size // 125)
    for rooms in (1, -(-size // SEATS)):
        names = " --room volcano " + " ".join(f"volcano-{room}" for room in range(2, rooms + 1)) if rooms > 1 else ""
        report, server = under_load(STEADY, maps=rooms)(bench, programs, load, names)
        if refused(report) == 0:
            break
    return report, server, rooms


def largest_crowd(bench, programs, command):
    """The largest crowd whose ticks' lateness has a p99 below 5 ms, its coming included; the largest that leaves five healthy watchers,
    once it is there, every frame and a gap's p99 below 60 ms; rooms of the largest."""
    by_lateness = by_gap = 0
    most = 1
    is_on_time = is_smooth = True
    for size in CROWD_SIZES:
        report, server, rooms = crowd_of(bench, programs, command, size)
        all_in = refused(report) == 0
        is_on_time = is_on_time and all_in and server.lateness("p99") < 5.0
        missed = number(r"^healthy while it lasts: .*missed (\d+)", report)
        is_smooth = is_smooth and all_in and missed == 0 and gap(report, "p99", "while it lasts") < 60.0
        if not is_on_time and not is_smooth:
            break
        most = rooms
        by_lateness = size if is_on_time else by_lateness
        by_gap = size if is_smooth else by_gap
    return by_lateness, by_gap, most


def above_the_floor(bench, programs, command):
    """CPU of a frame sent, of a bare send of as many bytes to as many clients, and the difference [us]; bytes. The crowd's coming, whose
    events go to all, is left out."""
    clients = int(number(r"--spectators (\d+)", command))
    with bench.server(programs, STEADY) as server:
        load = bench.load.start("woodlouse-swarm", server.address, *command.split())
        time.sleep(clients / number(r"--joins-per-second (\d+)", command) + SETTLING)
        before, begin = server.cpu_seconds(), time.monotonic()
        time.sleep(bench.seconds - 0.5)
        spent, took = server.cpu_seconds() - before, time.monotonic() - begin
        report, _ = load.communicate()
    came = clients * 20 * (1 - number(r"^others: .*missed (\d+)", report) / number(r"^others: .*missed \d+ of (\d+)", report))
    size = round(number(r"^others received (\d+)", report) / came)
    floor = bench.load.send_floor(clients, size, 20, bench.seconds)
    each = 1e6 * spent / (came * took)
    return each, floor, each - floor, size


def stalled(bench, programs, command):
    """p99 of gaps and of acks [ms]: none stalled, some stalled."""
    figures = []
    for load in (command.split("--stalled")[0] + f"--seconds {bench.seconds}", command):
        report, _ = under_load("")(bench, programs, load)
        figures += [gap(report, "p99"), ack(report, "p99")]
    return tuple(figures)


def stalled_text(gap_before, ack_before, gap_after, ack_after):
    return f"gap {gap_before:.1f} -> {gap_after:.1f}, ack {ack_before:.1f} -> {ack_after:.1f} ms"


def filed(bench, programs, command):
    _, server = under_load("")(bench, programs, command)
    return server.lateness("p99"), server.lateness("max")


def answers(bench, programs, command):
    report, _ = under_load(STEADY)(bench, programs, command)
    return (number(r"([\d.]+) bytes out a byte in", report), number(r"^others received ([\d.]+)", report))


def lost(how):
    def measure(bench, programs, _):
        with bench.server(programs, "", host="0.0.0.0") as server:
            seconds = how(server, bench.patience)
        return None if seconds is None else (seconds, bench.patience)
    return measure


def lost_text(seconds, patience):
    return f"{seconds:.1f} s" if seconds < patience else f"> {patience:.0f} s"


def comes_back(bench, programs, _):
    with bench.server(programs) as server:
        same = back_in_the_same(server)
    return None if same is None else (same,)


def logged(bench, programs, _):
    with bench.server(programs) as server:
        return log_bytes_per_second(server, bench.seconds)


def memory_of_watchers(bench, programs, command):
    """What each of them takes of the server [KB]."""
    clients = int(number(r"--spectators (\d+)", command))
    with bench.server(programs, STEADY) as server:
        before = server.resident_kb()
        load = bench.load.start("woodlouse-swarm", server.address, *command.split())
        time.sleep(clients / number(r"--joins-per-second (\d+)", command) + 1.0 + 0.5 * bench.seconds)
        each = (server.resident_kb() - before) / clients
        load.communicate()
    return (each,)


def memory_of_churn(bench, programs, command):
    """Resident at a quarter, a half and the end [MB]."""
    with bench.server(programs, f"--record {bench.scratch / 'churn.ndjson.zst'}") as server:
        begin = time.monotonic()
        load = bench.load.start("woodlouse-swarm", server.address, *command.split())
        figures = []
        for share in (0.25, 0.5, 1.0):
            time.sleep(max(0.0, begin + share * bench.churn - time.monotonic()))
            figures.append(server.resident_kb() / 1024)
        try:
            load.communicate(timeout=60)
        except subprocess.TimeoutExpired:
            load.kill()
    for file in bench.scratch.glob("churn*"):
        file.unlink()
    return tuple(figures)


def plain(text):
    return lambda *figures: text.format(*figures)


ROWS = (
    Row("1", "healthy gap p99 / max, 120 of one address chat 12/s",
        "--chatters 120 --chats-per-second 12 --healthy 5 --seconds {seconds}", "60 / 150 ms", gaps, gaps_text),
    Row("2a", "... 1,000 spectators join in a second, 8 addresses",
        "--spectators 1000 --addresses 8 --joins-per-second 1000 --healthy 5 --seconds {seconds}", "60 / 150 ms", gaps, gaps_text),
    Row("2b", "... 2,000 spectators join in a second, 16 addresses",
        "--spectators 2000 --addresses 16 --joins-per-second 2000 --healthy 5 --seconds {seconds}", "60 / 250 ms", gaps, gaps_text),
    Row("3", "spectators of 200 lice at 20 Hz, lateness p99 < 5 ms",
        "--spectators {{size}} --addresses {{addresses}} --joins-per-second 500 --healthy 5 --seconds {seconds}", "4500", largest_crowd,
        plain("{0:.0f}; once there {1:.0f}; {2:.0f} room(s)")),
    Row("4", "CPU of a frame sent, above a bare send of its bytes",
        "--spectators 1000 --addresses 8 --joins-per-second 500 --seconds {seconds}", "1.5 us", above_the_floor,
        plain("{2:.2f} us ({0:.2f} - {1:.2f}; {3:.0f} bytes)")),
    Row("5a", "healthy gap and ack p99, 10 % of 200 stalled",
        "--bots 200 --healthy 20 --healthy-role player --stalled 10 --seconds {seconds}", "not worse, +5 %", stalled, stalled_text),
    Row("5b", "healthy gap and ack p99, 50 % of 200 stalled",
        "--bots 200 --healthy 20 --healthy-role player --stalled 50 --seconds {seconds}", "not worse, +5 %", stalled, stalled_text),
    Row("6", "lateness p99 / max, 250 players file all they may for one tick",
        "--bots 250 --addresses 2 --inputs-per-tick 220 --seconds {seconds}", "max 5 ms", filed, plain("{0:.1f} / {1:.1f} ms")),
    *(Row(f"7{letter}", f"bytes out a byte in, {ask} as fast as allowed",
          f"--askers 1 --ask {ask} --healthy 0 --seconds {{seconds}}", "the declared budget", answers, plain("{0:.0f} ({1:.0f} bytes/s)"))
      for letter, ask in zip("abc", ("get_map", "resync", "list"))),
    Row("8a", "a stopped player's thrust ends", "SIGSTOP to a player", "15 s", lost(stopped), lost_text),
    Row("8b", "a cut off player's thrust ends", "a player's packets are lost", "15 s", lost(cut_off), lost_text),
    Row("8c", "back in one's louse after 25 s", "a player breaks off and comes back with his token", "1", comes_back, plain("{0:.0f}")),
    Row("9", "log by one hostile client", "connects, joins, breaks, floods, lines out of shape, for {seconds} s", "1000 bytes/s", logged,
        plain("{0:.0f} bytes/s ({1:.0f} visits/s)")),
    Row("10a", "memory a spectator, 1,000 of them",
        "--spectators 1000 --addresses 8 --joins-per-second 500 --seconds {seconds}", "16 KB", memory_of_watchers, plain("{0:.1f} KB")),
    Row("10b", "memory after 1/4, 1/2, 1 of a churn, recorded",
        "--churn 20 --healthy 0 --seconds {churn}", "flat", memory_of_churn, plain("{0:.1f}, {1:.1f}, {2:.1f} MB")),
)


def medians(runs):
    """Figure by figure; None where this server can't, or nothing was run."""
    runs = [run for run in runs if run is not None]
    return tuple(statistics.median(figures) for figures in zip(*runs)) if runs else None
