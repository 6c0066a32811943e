#!/usr/bin/env python3
"""What crowds and bad neighbours do to a server, against what they should: one table.

    bench/crowd_table.py BIN [FORMER_BIN]          each row three times, of both trees in turns: medians
    bench/crowd_table.py BIN --only 1,4            some rows; 2 is 2a and 2b
    bench/crowd_table.py BIN --only 3 --server-options "--per-room 5000"
    CHURN=3600 bench/crowd_table.py BIN --only 10b an hour of it

BIN is a tree's folder of programs; of FORMER_BIN the server alone is run, the load is always BIN's. The server has core 0, the load core 1, and
nothing else may run on either. Some rows want Linux's loopback (127.0.0.1 to 127.1.3.1), one wants root, for a network of its own.
"""
import argparse
import os
import pathlib
import re
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent / "crowd"))
from lost_player import PATIENCE  # noqa: E402
from programs import Load  # noqa: E402
from rows import ROWS, Bench, medians  # noqa: E402


def wanted(only):
    names = set(only.split(",")) if only else set()
    rows = [row for row in ROWS if not names or row.name in names or re.sub(r"[a-z]", "", row.name) in names]
    unknown = names - {row.name for row in rows} - {re.sub(r"[a-z]", "", row.name) for row in rows}
    if unknown:
        sys.exit(f"crowd_table.py: no row {' '.join(sorted(unknown))}; there are {' '.join(row.name for row in ROWS)}")
    return rows


def figures_of(row, bench, programs, command):
    """One run; None, and why on standard error, where it failed."""
    try:
        return row.measure(bench, programs, command)
    except (RuntimeError, OSError, ValueError) as error:
        print(f"row {row.name}, {programs}: {error}", file=sys.stderr)
        return None


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("programs", type=pathlib.Path, metavar="BIN")
    parser.add_argument("former", type=pathlib.Path, nargs="?", metavar="FORMER_BIN")
    parser.add_argument("--only", help="rows, by comma")
    parser.add_argument("--rounds", type=int, default=3, help="runs of each row and tree")
    parser.add_argument("--seconds", type=float, default=10.0, help="that a load lasts")
    parser.add_argument("--churn", type=float, default=float(os.environ.get("CHURN", 60)), help="seconds of it; or CHURN in the environment")
    parser.add_argument("--server-options", default=os.environ.get("SERVER_OPTIONS", ""),
                        help="more options of BIN's server, as higher limits; or SERVER_OPTIONS in the environment")
    parser.add_argument("--quick", action="store_true", help="every row once and in short: whether it runs, not what it is")
    arguments = parser.parse_args()
    rounds, seconds, churn = (1, 2.0, 6.0) if arguments.quick else (arguments.rounds, arguments.seconds, arguments.churn)
    patience = 20.0 if arguments.quick else PATIENCE
    print(f"{'row':<4} {'what':<63} {'former':<42} {'now':<42} goal")
    with tempfile.TemporaryDirectory() as scratch:
        def bench(options):
            return Bench(Load(arguments.programs.resolve()), pathlib.Path(scratch), seconds, churn, patience, tuple(options.split()))
        trees = [(arguments.former.resolve(), bench(""))] if arguments.former else []
        trees.append((arguments.programs.resolve(), bench(arguments.server_options)))
        for row in wanted(arguments.only):
            command = row.command.format(seconds=seconds, churn=churn)
            runs = [[] for _ in trees]
            for _ in range(rounds):
                for (programs, its_bench), its_runs in zip(trees, runs):
                    its_runs.append(figures_of(row, its_bench, programs, command))
            told = ["-" if not (middle := medians(its_runs)) else row.told(*middle) for its_runs in runs]
            former, now = told if arguments.former else ["-", *told]
            print(f"{row.name:<4} {row.what:<63} {former:<42} {now:<42} {row.goal}\n     {command}", flush=True)


if __name__ == "__main__":
    main()
