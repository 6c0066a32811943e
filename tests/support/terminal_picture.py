#!/usr/bin/python3
"""Pictures of what a program shows in a terminal: docs/pictures is made with it.

    tests/support/terminal_picture.py --size 120x36 --press 'wait=2 hold=w:3 shot' -o hills.png -- \\
        build/release/bin/woodlouse --map hills --color truecolor --glyphs half

The program runs in a terminal of that size (a pty, judged by pyte) until --press has been gone through; then it is
sent Ctrl-C. A picture is what stood on the screen at a `shot`; without one, what stood there at the end.

    --press  wait=SECONDS | until=TEXT (at most 15 s) | shot | shot=FILE | resize=COLUMNSxROWS | hold=KEY:SECONDS
             or a key: Space Enter Tab Esc Up Down Left Right, or characters, which are typed

The ending of a file says what is made: .png by a monospace font (python3-pil, fonts-dejavu-core), .txt characters
alone. Block elements are drawn as rectangles, as terminals do. Debian's own Python: pyte and Pillow are packages of it.
"""
import argparse
import fcntl
import os
import pty
import select
import signal
import struct
import sys
import termios
import time

import pyte
from PIL import Image, ImageDraw, ImageFont

FONTS = "/usr/share/fonts/truetype/dejavu/DejaVuSansMono{}.ttf"
KEYS = {"Space": b" ", "Enter": b"\r", "Tab": b"\t", "Esc": b"\x1b", "Up": b"\x1b[A", "Down": b"\x1b[B",
        "Right": b"\x1b[C", "Left": b"\x1b[D"}
# xterm's sixteen; the names are pyte's.
NAMED = {"black": "000000", "red": "cd0000", "green": "00cd00", "brown": "cdcd00", "blue": "2b4fee",
         "magenta": "cd00cd", "cyan": "00cdcd", "white": "e5e5e5", "brightblack": "7f7f7f", "brightred": "ff0000",
         "brightgreen": "00ff00", "brightbrown": "ffff00", "brightyellow": "ffff00", "brightblue": "5c5cff",
         "brightmagenta": "ff00ff", "brightcyan": "00ffff", "brightwhite": "ffffff"}
GROUND, INK = "0c0e14", "d6d8de"

# Parts of a cell that a block element fills: left, upper, right, lower edge in eighths.
BLOCKS = {"\u2580": [(0, 0, 8, 4)], "\u2588": [(0, 0, 8, 8)], "\u2590": [(4, 0, 8, 8)], "\u2594": [(0, 0, 8, 1)],
          "\u2595": [(7, 0, 8, 8)]}
BLOCKS.update({chr(0x2580 + n): [(0, 8 - n, 8, 8)] for n in range(1, 8)})
BLOCKS.update({chr(0x2590 - n): [(0, 0, n, 8)] for n in range(1, 8)})
_QUADRANTS = {1: (0, 0, 4, 4), 2: (4, 0, 8, 4), 4: (0, 4, 4, 8), 8: (4, 4, 8, 8)}
for _code, _bits in zip(range(0x2596, 0x25A0), (4, 8, 1, 13, 9, 7, 11, 2, 6, 14)):
    BLOCKS[chr(_code)] = [part for bit, part in _QUADRANTS.items() if _bits & bit]
# Arms of lines: left, up, right, down.
LINES = {"\u2500": "1010", "\u2502": "0101", "\u250c": "0011", "\u2510": "1001", "\u2514": "0110", "\u2518": "1100",
         "\u251c": "0111", "\u2524": "1101", "\u252c": "1011", "\u2534": "1110", "\u253c": "1111"}


def rgb(color, otherwise):
    text = NAMED.get(color, otherwise if color == "default" else color)
    return tuple(int(text[i:i + 2], 16) for i in (0, 2, 4))


def looks(char):
    """Foreground and background; pyte shows the bright eight as bold ones of the eight."""
    fg = "bright" + char.fg if char.bold and "bright" + char.fg in NAMED else char.fg
    ink, ground = rgb(fg, INK), rgb(char.bg, GROUND)
    return (ground, ink) if char.reverse else (ink, ground)


class Painter:
    """Draws pyte's screens as pictures; `cell` is a column's width in pixels."""

    def __init__(self, cell=8):
        self.width, self.height = cell, 2 * cell
        size = int(cell * 1.66)  # a column is 0.602 of the size wide
        self.fonts = {bold: ImageFont.truetype(FONTS.format("-Bold" if bold else ""), size) for bold in (False, True)}

    def picture(self, screen):
        image = Image.new("RGB", (screen.columns * self.width, screen.lines * self.height), rgb("default", GROUND))
        draw = ImageDraw.Draw(image)
        for row in range(screen.lines):
            for column in range(screen.columns):
                self._cell(draw, column, row, screen.buffer[row][column])
        return image

    def _cell(self, draw, column, row, char):
        if char.data == "":  # the right half of a wide character
            return
        wide = 2 if pyte.screens.wcwidth(char.data[0]) == 2 else 1
        x, y, width = column * self.width, row * self.height, wide * self.width
        ink, ground = looks(char)
        draw.rectangle((x, y, x + width - 1, y + self.height - 1), fill=ground)
        if char.data in BLOCKS:
            for left, upper, right, lower in BLOCKS[char.data]:
                draw.rectangle((x + left * self.width // 8, y + upper * self.height // 8,
                                x + right * self.width // 8 - 1, y + lower * self.height // 8 - 1), fill=ink)
        elif char.data in LINES:
            middle_x, middle_y = x + self.width // 2, y + self.height // 2
            ends = ((x, middle_y), (middle_x, y), (x + width - 1, middle_y), (middle_x, y + self.height - 1))
            for arm, end in zip(LINES[char.data], ends):
                if arm == "1":
                    draw.line((middle_x, middle_y, *end), fill=ink)
        elif char.data != " ":
            draw.text((x + (width - self.width * wide) // 2, y + self.height * 13 // 16), char.data, fill=ink,
                      font=self.fonts[bool(char.bold)], anchor="ls")


class Session:
    """A program in an emulated terminal, which knows synchronized updates: a frame that is large has a beginning and an end."""

    ASKED, ANSWER = b"\x1b[?2026$p", b"\x1b[?2026;2$y"
    BEGIN, END = b"\x1b[?2026h", b"\x1b[?2026l"
    recent, in_frame = b"", False

    def __init__(self, command, columns, rows, environment):
        self.screen = pyte.Screen(columns, rows)
        self.stream = pyte.ByteStream(self.screen)
        self.pid, self.master = pty.fork()
        if self.pid == 0:
            try:
                os.execvpe(command[0], command, environment)
            except OSError as error:
                os.write(2, f"{command[0]}: {error.strerror}\r\n".encode())
                os._exit(127)
        self.screen.write_process_input = lambda text: self.write(text.encode())  # answers to queries
        self._tell_size()

    def _tell_size(self):
        fcntl.ioctl(self.master, termios.TIOCSWINSZ,
                    struct.pack("HHHH", self.screen.lines, self.screen.columns, 0, 0))

    def resize(self, columns, rows):
        self.screen.resize(lines=rows, columns=columns)
        self._tell_size()

    def write(self, data):
        os.write(self.master, data)

    def read(self, seconds, done=lambda: False):
        """Feeds what comes for so long, or until done(); False once the program has ended."""
        end = time.monotonic() + seconds
        while not done():
            left = end - time.monotonic()
            if left <= 0:
                return True
            if not select.select([self.master], [], [], left)[0]:
                continue
            try:
                data = os.read(self.master, 1 << 16)
            except OSError:
                return False
            if not data:
                return False
            self._heed(data)
            self.stream.feed(data)
        return True

    def _heed(self, data):
        if self.ASKED in data:
            self.write(self.ANSWER)
        self.recent = self.recent[-len(self.BEGIN):] + data
        begin, end = self.recent.rfind(self.BEGIN), self.recent.rfind(self.END)
        if begin >= 0 or end >= 0:
            self.in_frame = begin > end

    def settle(self):
        """Reads on until a frame is whole: it has ended, and nothing has come for 8 ms; at most 5 s."""
        end = time.monotonic() + 5.0
        while time.monotonic() < end and (select.select([self.master], [], [], 0.008)[0] or self.in_frame):
            if not self.read(0.05, done=iter((False, True)).__next__):  # once
                return

    def text(self):
        return "\n".join(line.rstrip() for line in self.screen.display) + "\n"

    def close(self):
        """Ctrl-C, then, if that is not heard, the end."""
        for stop in (lambda: self.write(b"\x03"), lambda: os.kill(self.pid, signal.SIGKILL)):
            try:
                stop()
            except (OSError, ProcessLookupError):
                pass
            if not self.read(5.0):
                break
        os.waitpid(self.pid, 0)
        os.close(self.master)


def compact(image):
    """The same with a palette, where 256 colours are all of it."""
    return image.quantize(256, dither=Image.Dither.NONE) if len(image.getcolors(1 << 24)) <= 256 else image


def save(session, path, cell):
    session.settle()
    if path.endswith(".png"):
        compact(Painter(cell).picture(session.screen)).save(path, optimize=True)
    else:
        with open(path, "w", encoding="utf-8") as file:
            file.write(session.text())
    print(path)


def press(session, step, output, cell):
    """One word of --press; True if it saved a picture. Exits where the program has ended or shows nothing."""
    word, _, value = step.partition("=")
    alive = True
    if word == "wait" and value:
        alive = session.read(float(value))
    elif word == "until" and value:
        alive = session.read(15.0, lambda: value in session.text())
        if value not in session.text():
            sys.exit(f"no {value!r} came; the screen:\n{session.text()}")
    elif word == "resize" and value:
        session.resize(*(int(n) for n in value.split("x")))
    elif word == "hold" and value:
        key, seconds = value.rsplit(":", 1)
        end = time.monotonic() + float(seconds)
        while alive and time.monotonic() < end:
            session.write(KEYS.get(key, key.encode()))
            alive = session.read(0.05)
    elif word == "shot":
        save(session, value or output, cell)
        return True
    else:
        session.write(KEYS.get(step, step.encode()))
        alive = session.read(0.15)
    if not alive:
        sys.exit(f"it ended at {step}; the screen:\n{session.text()}")
    return False


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("-o", "--output", default="terminal.png")
    parser.add_argument("--size", default="80x24", help="COLUMNSxROWS")
    parser.add_argument("--press", default="wait=2", help="what is done, in words (above)")
    parser.add_argument("--cell", type=int, default=8, help="pixels a column is wide; a row is twice as high")
    parser.add_argument("command", nargs="+")
    arguments = parser.parse_args()
    columns, rows = (int(n) for n in arguments.size.split("x"))
    environment = {k: v for k, v in os.environ.items()
                   if not k.startswith(("WOODLOUSE_", "XDG_CONFIG", "TMUX")) and k != "NO_COLOR"}
    environment.update(TERM="xterm-256color", COLORTERM="truecolor", LC_ALL="C.UTF-8")
    session = Session(arguments.command, columns, rows, environment)
    try:
        shots = [press(session, step, arguments.output, arguments.cell) for step in arguments.press.split()]
        if not any(shots):
            save(session, arguments.output, arguments.cell)
    finally:
        session.close()


if __name__ == "__main__":
    main()
