#!/usr/bin/env python3
"""What the parts of a recording cost, packed.

Usage: replay_size.py RECORDING [--level N]

RECORDING is plain or .zst. Its text is packed anew by the zstd program, keyframe to keyframe as the server does, with
and without the parts in question; what a part costs is the difference. `as written` is the file itself, with what the
flushes cost.
"""
import argparse
import json
import os
import re
import subprocess
import sys


def zstd(*arguments, data):
    return subprocess.run(["zstd", "-q", "-c", *arguments], input=data, stdout=subprocess.PIPE, check=True).stdout


def text_of(path):
    with open(path, "rb") as file:
        data = file.read()
    return zstd("-d", data=data) if data[:4] == b"\x28\xb5\x2f\xfd" else data


def stretches(lines):
    """From each keyframe up to the next; the header, the index and the end are left out."""
    stretch = []
    for line in lines:
        if line.startswith(b'{"keyframe"') and stretch:
            yield stretch
            stretch = []
        if line.startswith((b'{"keyframe"', b'{"step"', b'{"chat"')):
            stretch.append(line)
    yield stretch


def without_hash(line):
    return re.sub(rb',"hash":"[0-9a-f]{16}"', b"", line)


def without_margin(line):
    if b'"inputs":[[' not in line or not line.startswith(b'{"step"'):
        return line
    step = json.loads(line)
    for row in step["inputs"]:
        if len(row) > 3:
            row[3] = None
        if len(row) == 4:
            row.pop()
    return json.dumps(step, separators=(",", ":")).encode() + b"\n"


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("recording")
    parser.add_argument("--level", type=int, default=9)
    options = parser.parse_args()
    text = text_of(options.recording)
    parts = list(stretches(text.splitlines(keepends=True)))

    def packed(change, keep=lambda line: True):
        return sum(
            len(zstd(f"-{options.level}", data=b"".join(change(line) for line in part if keep(line)))) for part in parts
        )

    def is_no_keyframe(line):
        return not line.startswith(b'{"keyframe"')

    steps = [json.loads(line) for part in parts for line in part if line.startswith(b'{"step"')]
    inputs = sum(len(step.get("inputs", [])) for step in steps)
    step_count = sum(step.get("steps", 1) for step in steps)  # a line stands for many that did nothing
    if inputs == 0:
        sys.exit("no inputs in this recording")
    whole = packed(lambda line: line)
    steps_alone = packed(lambda line: line, is_no_keyframe)
    inputs_alone = packed(without_hash, is_no_keyframe)
    no_margins = packed(lambda line: without_margin(without_hash(line)), is_no_keyframe)
    print(f"{step_count} steps, {inputs} inputs, {len(parts)} keyframes; zstd level {options.level}")
    print(f"{'':34} {'bytes':>10} {'an input':>9} {'a step':>7}")
    for name, size in (
        ("as written", os.path.getsize(options.recording)),
        ("text, not packed", len(text)),
        ("packed, all", whole),
        ("keyframes", whole - steps_alone),
        ("hashes", steps_alone - inputs_alone),
        ("inputs (and an empty step's line)", inputs_alone),
        ("  of these, margins", inputs_alone - no_margins),
    ):
        print(f"{name:34} {size:10} {size / inputs:9.2f} {size / step_count:7.1f}")


if __name__ == "__main__":
    main()
