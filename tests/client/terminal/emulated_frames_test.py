"""Feeds the client's frames to pyte and compares every cell with what was meant.

usage: emulated_frames_test.py PROGRAM     PROGRAM prints frames as emulated_frames.cpp says
"""
import subprocess
import sys

import pyte

BOLD, REVERSE = 1, 2
MODE_16 = 1
NAMES = ["black", "red", "green", "brown", "blue", "magenta", "cyan", "white"]


def normal(glyph, fg, bg, bold, reverse):
    """One spelling for equal looks: a lower half is an upper half with its colours exchanged."""
    if glyph in ("", "\0"):
        return "", None, None, None, None
    if glyph == "\u2584" and not reverse:
        glyph, fg, bg = "\u2580", bg, fg
    if glyph == "\u2580" and not reverse and fg == bg:
        glyph = " "
    if glyph == " " and not reverse:
        fg, bold = "default", False
    return glyph, fg, bg, bold, reverse


def meant(text, mode):
    glyph, fg, bg, attributes = text.split("/")
    attributes = int(attributes, 16)

    def color(value):
        if value == "-":
            return "default"
        return NAMES[int(value) % 8] if mode == MODE_16 else value

    # pyte shows the bright eight as bold, so at 16 colours bold says nothing.
    bold = bool(attributes & BOLD) and mode != MODE_16
    if mode == MODE_16:  # compared before brightness is lost: a bright and a dark half are different
        glyph_is_half = int(glyph, 16) in (0x2580, 0x2584)
        if glyph_is_half and not attributes & REVERSE and fg != bg and color(fg) == color(bg):
            return None
    return normal(chr(int(glyph, 16)), color(fg), color(bg), bold, bool(attributes & REVERSE))


def shown(char, mode):
    return normal(char.data, char.fg, char.bg, char.bold and mode != MODE_16, char.reverse)


def main():
    output = subprocess.run([sys.argv[1]], stdout=subprocess.PIPE, check=True, timeout=60).stdout
    at = frames = cells = 0
    screen = stream = last_mode = None
    while at < len(output):
        end = output.index(b"\n", at)
        word, columns, rows, mode, size = output[at:end].split()
        assert word == b"frame"
        columns, rows, mode, size = int(columns), int(rows), int(mode), int(size)
        if mode != last_mode:
            screen = pyte.Screen(columns, rows)
            stream = pyte.ByteStream(screen)
            last_mode = mode
        if (screen.columns, screen.lines) != (columns, rows):
            screen.resize(lines=rows, columns=columns)
        stream.feed(output[end + 1:end + 1 + size])
        at = end + 1 + size
        for row in range(rows):
            end = output.index(b"\n", at)
            for column, text in enumerate(output[at:end].decode().split()):
                expected = meant(text, mode)
                found = shown(screen.buffer[row][column], mode)
                if expected is not None and expected != found:
                    sys.exit(f"frame {frames}, mode {mode}, row {row}, column {column}: "
                             f"meant {expected}, the terminal shows {found}")
                cells += 1
            at = end + 1
        frames += 1
    if frames < 200:
        sys.exit(f"only {frames} frames came")
    print(f"{frames} frames, {cells} cells as meant")


if __name__ == "__main__":
    main()
