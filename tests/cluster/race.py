"""A canary for each version of NATS: writers race for a log of three replicas, while its leader is killed again and
again. Usage: race.py [--rounds N] [--writers N]"""

import argparse
import os
import subprocess
import sys
import time

import stage


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--rounds", type=int, default=300)
    parser.add_argument("--writers", type=int, default=4)
    options = parser.parse_args()
    stage.skip_where_missing()
    with stage.Nats(3) as nats:
        race = subprocess.Popen([os.environ["WOODLOUSE_RACE"], nats.file, str(options.rounds), str(options.writers)],
                                stdout=subprocess.PIPE, text=True)
        kills = 0
        while race.poll() is None:
            time.sleep(0.5)
            leader = nats.leader()
            if race.poll() is None and leader is not None:
                nats.kill(leader)
                time.sleep(1)
                nats.start(leader)
                kills += 1
                time.sleep(5)
        print(race.stdout.read().strip() + f"; its leader killed {kills} times")
        sys.exit(race.returncode)


if __name__ == "__main__":
    main()
