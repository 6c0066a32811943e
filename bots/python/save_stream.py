#!/usr/bin/env python3
"""Watches a room by inputs and saves what comes: a recording that woodlouse-server verify and woodlouse replay take.

usage: save_stream.py HOST:PORT[/ROOM] FILE [SECONDS]

Where the stream goes on from a new keyframe (it does after a gap, and here every 2000 steps, as a recording has no more
than 5000 behind one) or with another game, FILE.1, FILE.2 and so on follow: game.ndjson, game.1.ndjson ...
"""
import json
import os
import sys
import time

import woodlouse

STEPS_A_FILE = 2000


class Files:
    """Where a stream's lines go: takes them one by one."""

    def __init__(self, name):
        self._stem, self._end = os.path.splitext(name)
        self._header, self._out = None, None
        self.names = []
        self.steps = 0  # in the file that is open

    def take(self, line):
        if line.startswith('{"format":'):
            self._header = line
            return
        if line.startswith('{"keyframe":'):
            self._open()
        if self._out is None:
            raise woodlouse.WoodlouseError("protocol", "a step came before any keyframe")
        self._out.write(line + "\n")
        if line.startswith('{"step":'):
            self.steps += json.loads(line).get("steps", 1)

    def close(self):
        if self._out is not None:
            self._out.close()
        self._out = None

    def _open(self):
        if self._header is None:
            raise woodlouse.WoodlouseError("protocol", "a keyframe came before any header")
        self.close()
        number = len(self.names)
        name = self._stem + (".%d" % number if number else "") + self._end
        self._out = open(name, "x", encoding="utf-8", newline="\n")  # never over a file that is there
        self._out.write(self._header + "\n")
        self.names.append(name)
        self.steps = 0


def save(address, name, seconds=float("inf")):
    """The names of the files that it made."""
    files = Files(name)
    end = time.monotonic() + seconds
    try:
        with woodlouse.connect(address, name="recorder", role="spectator", stream="inputs") as game:
            is_asked = False
            for line in game.recorded():
                files.take(line)
                if files.steps < STEPS_A_FILE:
                    is_asked = False
                elif not is_asked:
                    is_asked = True
                    game.resync()
                if time.monotonic() >= end:
                    break
    finally:
        files.close()
    return files.names


if __name__ == "__main__":
    if not 3 <= len(sys.argv) <= 4:
        sys.exit(__doc__)
    try:
        print("saved", *save(*sys.argv[1:3], *map(float, sys.argv[3:])))
    except (OSError, ValueError, woodlouse.WoodlouseError) as error:
        sys.exit("%s: %s" % (sys.argv[0], error))
    except KeyboardInterrupt:
        sys.exit(130)
