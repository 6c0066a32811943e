"""Runs woodlouse-lab and reads its tables."""
import csv
import io
import os
import subprocess

LAB = os.environ["WOODLOUSE_LAB"]
REFERENCE = os.environ["WOODLOUSE_REFERENCE"]


def run(*arguments, text=None, **options):
    """The finished process; `text` goes to its standard input."""
    return subprocess.run([LAB, *map(str, arguments)], input=text, capture_output=True, text=True, timeout=120, **options)


def table(*arguments, text=None):
    """Its standard output as a list of dicts; fails loudly."""
    done = run(*arguments, text=text)
    if done.returncode != 0:
        raise AssertionError(f"{arguments}: {done.stderr}")
    return list(csv.DictReader(io.StringIO(done.stdout)))


def reference(name):
    with open(os.path.join(REFERENCE, name), newline="") as file:
        return list(csv.DictReader(file))


def groups(rows, *keys):
    """Rows by the values of these columns, in order."""
    result = {}
    for row in rows:
        result.setdefault(tuple(row[key] for key in keys), []).append(row)
    return result
