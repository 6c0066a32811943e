"""Fails on a folder of more than 25 nouns, on a source file of more than 350 lines, and on a test case that would not run.

Usage: rooms_test.py SOURCE_DIR

A noun is a file's name without its ending: louse.h and louse.cpp are one, louse_test.cpp is another. Folders count for
themselves, without those in them.
"""
import collections
import pathlib
import re
import sys

FOLDERS = ("shared", "server", "client", "bench", "tests", "bots", "web/core")
ENDINGS = (".h", ".cpp", ".py")
MOST_NOUNS = 25
MOST_LINES = 350
# Of a test case, over several lines too. CTest keeps names in a list, whose separator is the semicolon: a name with one is
# asked for by its first half, and nothing runs.
TEST_NAME = re.compile(r'TEST_CASE\(\s*((?:"(?:[^"\\]|\\.)*"\s*)+)')


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
        text = (root / path).read_text()
        lines = len(text.splitlines())
        faults += [f"{path}: a semicolon in the name of {name[:40]}...: CTest would not run it"
                   for name in TEST_NAME.findall(text) if ";" in name]
        if lines > MOST_LINES:
            faults.append(f"{path}: {lines} lines, at most {MOST_LINES}: split it by what it does")
    for folder, names in sorted(nouns.items()):
        if len(names) > MOST_NOUNS:
            faults.append(f"{folder}: {len(names)} nouns, at most {MOST_NOUNS}: find the rooms in it")
    print("\n".join(faults) or f"{len(nouns)} folders have at most {MOST_NOUNS} nouns of at most {MOST_LINES} lines")
    return 1 if faults or not nouns else 0


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1])))
