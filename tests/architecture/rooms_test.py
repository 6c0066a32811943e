"""Fails on a folder of more than 25 nouns and on a source file of more than 350 lines.

Usage: rooms_test.py SOURCE_DIR

A noun is a file's name without its ending: louse.h and louse.cpp are one, louse_test.cpp is another. Folders count for
themselves, without those in them.
"""
import collections
import pathlib
import sys

FOLDERS = ("shared", "server", "client", "bench", "tests", "bots")
ENDINGS = (".h", ".cpp", ".py")
MOST_NOUNS = 25
MOST_LINES = 350


def sources(root):
    for folder in FOLDERS:
        for file in sorted((root / folder).rglob("*")):
            if file.suffix in ENDINGS and file.is_file():
                yield file.relative_to(root)


def main(root):
    nouns = collections.defaultdict(set)
    faults = []
    for path in sources(root):
        nouns[path.parent].add(path.stem)
        lines = len((root / path).read_text().splitlines())
        if lines > MOST_LINES:
            faults.append(f"{path}: {lines} lines, at most {MOST_LINES}: split it by what it does")
    for folder, names in sorted(nouns.items()):
        if len(names) > MOST_NOUNS:
            faults.append(f"{folder}: {len(names)} nouns, at most {MOST_NOUNS}: find the rooms in it")
    print("\n".join(faults) or f"{len(nouns)} folders have at most {MOST_NOUNS} nouns of at most {MOST_LINES} lines")
    return 1 if faults or not nouns else 0


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1])))
