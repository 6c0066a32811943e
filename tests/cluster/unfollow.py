"""Leaves a log while its messages come, again and again, with freed memory overwritten: what libnats still looks at then shows.
Usage: unfollow.py [ROUNDS]"""

import os
import subprocess
import sys

import stage


def main():
    stage.skip_where_missing()
    rounds = sys.argv[1] if len(sys.argv) > 1 else "1500"
    with stage.Nats() as nats:
        sys.exit(subprocess.run([os.environ["WOODLOUSE_UNFOLLOW"], nats.file, rounds], env={**os.environ, "MALLOC_PERTURB_": "170"}).returncode)


if __name__ == "__main__":
    main()
