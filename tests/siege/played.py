#!/usr/bin/python3
"""Plays the real client by keys in each mode of play, for minutes, and judges every frame it draws.

    tests/siege/played.py build/release/bin [--seconds 300] [--keep FOLDER] [--look ascii|colour] [MODE ...]

A server of its own records; house bots play along. The client runs in a terminal of 80x24 (pyte), following its louse. What
is pressed is decided from the screen alone: the goal's line ("gate 3: NE 27 m"), the speed, who holds the place. Each frame,
told from the next as the client writes them, is looked at: a whole one (title, frame of the panel, key line),
with the louse in the picture, with the goal's line where there are rules. Then the recording is verified. Prints a table;
exit status 1 where a frame or a recording was wrong, or nothing was achieved. Debian's own Python: pyte is a package of it.
"""
import argparse
import os
import random
import re
import subprocess
import sys
import tempfile
import time

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "support"))
from terminal_picture import Session  # noqa: E402

ROOMS = {"race": "crater_loop/race", "forage": "picnic/forage", "hill": "table/hill", "roam": "volcano"}
WINDS = {"north": b"w", "NE": b"wd", "east": b"d", "SE": b"sd", "south": b"s", "SW": b"sa", "west": b"a", "NW": b"wa"}
# A terminal that knows true colour, UTF-8 and synchronized updates, and reports no releases of keys.
ANSWERS = b"\x1b[?2026;2$y\x1bP1$r0;48:2::1:2:3m\x1b\\\x1b[5;2R\x1b[5;2R"
LAST_QUESTION, LAST_ANSWER = b"\x1b[c", b"\x1b[?62;22c"
FRAME_BEGIN, FRAME_END = b"\x1b[?2026h", b"\x1b[?2026l"
LOOKS = {"ascii": ["--color", "mono", "--glyphs", "ascii"], "colour": ["--color", "truecolor", "--glyphs", "half"]}
SHADES = {"c72c57", "8f1f3f"}  # of your louse's colour, where it is lit from the side
LIT = "ff3870"  # and in full light, as its trail is: a body has a head beside it
HEADS = {"fffffa", "c7c7c3", "8f8f8c"}
PANEL = 47  # the column in which the panel begins at 80x24
REACTION = 0.2  # seconds between two looks at the screen


class Judge:
    """What was wrong with frames, and the first one of each kind."""

    def __init__(self, mode, look):
        self.mode, self.look = mode, look
        self.frames = 0
        self.wrong = {}
        self.begun = False

    def see(self, lines, overlay, buffer):
        self.frames += 1
        for what in self.faults(lines, overlay, buffer):
            count, first = self.wrong.get(what, (0, "\n".join(lines)))
            self.wrong[what] = count + 1, first

    def faults(self, lines, overlay, buffer):
        if not lines[0].startswith(" WOODLOUSE") or "quit" not in lines[-1]:
            yield "torn"
        edge = {line[PANEL:PANEL + 1] for line in lines[1:22]}
        if not overlay and not edge <= set("|+" if self.look == "ascii" else " \u2500"):
            yield "panel torn"
        if self.mode != "roam" and not lines[1].startswith(f" {self.mode}"):
            yield "no goal line"
        if overlay or "out: back at a spawn" in lines[2] or "next round in" in lines[1]:
            return
        picture = "\n".join(line[:PANEL] for line in lines[1:23])
        if self.look == "ascii" and picture.count("@") != 1:
            yield "no louse"
        # Its name, which a big figure may hide, or its body.
        if self.look == "colour" and "you" not in picture and not self.shows_body(buffer):
            yield "no louse"

    @staticmethod
    def shows_body(buffer):
        pixels = {}
        for row in range(1, 23):
            for column in range(PANEL):
                cell = buffer[row][column]
                above, below = {"\u2580": (cell.fg, cell.bg), "\u2584": (cell.bg, cell.fg)}.get(cell.data, (cell.bg, cell.bg))
                pixels[2 * row, column], pixels[2 * row + 1, column] = above, below
        return any(colour in SHADES or colour == LIT and any(pixels.get((y + down, x + right)) in HEADS
                                                             for down, right in ((1, 0), (-1, 0), (0, 1), (0, -1)))
                   for (y, x), colour in pixels.items())


class Player:
    """Looks at the screen, and presses keys."""

    def __init__(self, mode):
        self.mode = mode
        self.random = random.Random(7)
        self.pressed = 0
        self.ways = []  # (time, metres) to the goal, of the last second
        self.goal = ""
        self.gates, self.falls, self.best, self.laps = 0, 0, "", 0
        self.was_out = False
        self.wandering = (0.0, b"w")

    def note(self, lines):
        """Counts what was achieved."""
        goal = re.search(rf"  (gate \w+:|crumb(?: worth 3)?:|place) (?:{'|'.join(WINDS)})\b", lines[1])
        if goal and goal.group(1) != self.goal:
            self.gates += self.goal.startswith("gate") and goal.group(1).startswith("gate")
            self.goal = goal.group(1)
            self.ways = []
        out = "out: back at a spawn" in lines[2]
        self.falls += out and not self.was_out
        self.was_out = out
        own = next((line[PANEL:] for line in lines[2:12] if re.search(r"@ you|you ", line[PANEL:])), "")
        measure = r"(\d+:\d\d\.\d+)" if self.mode == "race" else r"(\d+\.\d s|\d+)"
        if found := re.search(rf"@ you.*? {measure}$", own.rstrip(" |")):
            self.best = found.group(1)

    def keys(self, lines, now):
        """What a person would press now."""
        speed = re.search(r"speed\s+([\d.]+) m/s", "\n".join(lines))
        speed = float(speed.group(1)) if speed else 0.0
        aim = re.search(rf" ({'|'.join(WINDS)}) (\d+) m", lines[1])
        if self.mode == "roam" or not aim:
            return self.wander(now)
        wind, metres = aim.group(1), float(aim.group(2))
        self.ways = [(t, m) for t, m in self.ways if now - t < 0.9] + [(now, metres)]
        elapsed = now - self.ways[0][0]
        nearing = (self.ways[0][1] - metres) / elapsed if elapsed > 0.5 else speed
        if self.mode == "hill" and metres <= 2:
            return b"x" if speed > 0.6 else b""
        if speed > 1.5 and nearing < 0.3 * speed:
            return b"x"  # it rolls elsewhere
        stops = speed * speed / 3.0  # metres, by a brake
        if self.mode != "race" and stops > metres + 2:
            return b"x"
        return WINDS[wind]

    def wander(self, now):
        until, keys = self.wandering
        if now > until:
            keys = self.random.choice(list(WINDS.values()))
            self.wandering = now + self.random.uniform(2.0, 5.0), keys
        return keys

    def achieved(self):
        if self.mode == "race":
            return f"{self.gates} gates, best run {self.best or '--'}", self.gates > 0
        if self.mode == "forage":
            return f"{self.best} points in the last round", self.best not in ("", "0")
        if self.mode == "hill":
            return f"held {self.best}, fell {self.falls} times", True
        return "", True


class Stage(Session):
    """The client in its terminal, frame by frame."""

    def __init__(self, command, environment, judge, player, size=(80, 24)):
        super().__init__(command, *size, environment)
        self.screen.write_process_input = lambda text: None
        self.judge, self.player = judge, player
        self.overlay = False
        self.rest = b""

    def lines(self):
        return self.screen.display

    def feed(self, data):
        if LAST_QUESTION in data:  # at the start behind all others, at the end alone
            self.write((b"" if self.judge.begun else ANSWERS) + LAST_ANSWER)
        self.rest += data
        if self.rest.count(FRAME_BEGIN) > self.rest.count(FRAME_END) or any(
                self.rest.endswith(FRAME_BEGIN[:k]) for k in range(1, len(FRAME_BEGIN))):
            return  # a large frame comes in parts, and so may its beginning; what is small is written at once
        frame, self.rest = self.rest, b""
        self.stream.feed(frame)
        if not self.judge.begun:
            self.judge.begun = "WOODLOUSE" in self.lines()[0] and "waiting for the map" not in self.text()
        elif b"\x1b[?1049l" not in frame:
            lines = self.lines()
            self.judge.see(lines, self.overlay, self.screen.buffer)
            self.player.note(lines)

    def press(self, keys):
        for key in keys:
            self.write(bytes([key]))
            self.player.pressed += 1


def read_some(stage, seconds):
    """True while the client lives."""
    import select
    end = time.monotonic() + seconds
    while (left := end - time.monotonic()) > 0:
        if not select.select([stage.master], [], [], left)[0]:
            continue
        try:
            data = os.read(stage.master, 1 << 16)
        except OSError:
            return False
        if not data:
            return False
        stage.feed(data)
    return True


def start_server(binaries, mode, folder):
    name = ROOMS[mode].split("/")[0]
    command = [os.path.join(binaries, "woodlouse-server"), "--map", name, "--mode", mode, "--listen", "127.0.0.1:0", "--bots", "2",
               "--bots-skill", "easy", "--seed", "5", "--record", os.path.join(folder, f"{mode}.ndjson.zst")]
    server = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
    line = server.stdout.readline().split()
    if len(line) < 2:
        sys.exit(f"no server: {' '.join(command)}")
    return server, line[1]


def play(binaries, mode, seconds, folder, look):
    """A row of the table, and whether all was well."""
    home = os.path.join(folder, "home")
    os.makedirs(os.path.join(home, ".local/share/woodlouse"), exist_ok=True)
    with open(os.path.join(home, ".local/share/woodlouse/lesson"), "w", encoding="ascii") as mark:
        mark.write("done\n")
    environment = {k: v for k, v in os.environ.items()
                   if not k.startswith(("WOODLOUSE_", "XDG_", "TMUX")) and k != "NO_COLOR"}
    environment.update(TERM="xterm-256color", LC_ALL="C.UTF-8", HOME=home)
    server, address = start_server(binaries, mode, folder)
    judge, player = Judge(mode, look), Player(mode)
    stage = Stage([os.path.join(binaries, "woodlouse"), address, "--name", "ida", "--view", "follow", "--fps", "15", *LOOKS[look]],
                  environment, judge, player)
    try:
        alive = read_some(stage, 3.0)
        end = time.monotonic() + seconds
        last = 0.0
        while alive and (now := time.monotonic()) < end:
            stage.press(player.keys(stage.lines(), now))
            if mode == "roam" and now - last > 20.0:  # what else there is
                last = now
                for key in (b"\t", b"\t", b"?", b"z", b"b", b"g"):
                    stage.overlay = True
                    stage.press(key)
                    alive = alive and read_some(stage, 0.3)
                stage.overlay = False
            alive = alive and read_some(stage, REACTION)
        ended_early = not alive
        way = re.search(r"way\s+([\d.]+ k?m)", "\n".join(stage.lines()))
    finally:
        stage.close()
        server.terminate()
        server.wait(timeout=20)
    recording = next(os.path.join(folder, name) for name in os.listdir(folder) if name.startswith(f"{mode}."))
    verified = subprocess.run([os.path.join(binaries, "woodlouse-server"), "verify", recording], capture_output=True, text=True,
                              check=False)
    words, is_something = player.achieved()
    words = ", ".join(part for part in (words, f"{way.group(1)} driven" if way else "") if part)
    row = (mode, ROOMS[mode], judge.frames, sum(count for count, _ in judge.wrong.values()), player.pressed, words,
           verified.stdout.strip().splitlines()[-1] if verified.stdout.strip() else verified.stderr.strip(),
           os.path.getsize(recording))
    for what, (count, first) in judge.wrong.items():
        print(f"{mode}: {what}: {count} of {judge.frames} frames; the first one:\n{first}\n", file=sys.stderr)
    if ended_early:
        print(f"{mode}: the client ended; its screen:\n{stage.text()}", file=sys.stderr)
    return row, not judge.wrong and not ended_early and verified.returncode == 0 and judge.frames > 3 * seconds and is_something


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("binaries", help="the folder of woodlouse and woodlouse-server")
    parser.add_argument("modes", nargs="*", metavar="MODE", help="race forage hill roam; all, if none is named")
    parser.add_argument("--seconds", type=float, default=300.0)
    parser.add_argument("--keep", help="a folder for the recordings")
    parser.add_argument("--look", choices=sorted(LOOKS), default="ascii")
    arguments = parser.parse_args()
    unknown = set(arguments.modes) - set(ROOMS)
    if unknown:
        parser.error(f"no such mode: {' '.join(sorted(unknown))}")
    fine = True
    print("mode    room              frames  wrong  keys  what was achieved; the recording; its bytes")
    with tempfile.TemporaryDirectory(prefix="woodlouse-played-") as own:
        folder = arguments.keep or own
        os.makedirs(folder, exist_ok=True)
        for mode in arguments.modes or ROOMS:
            row, is_well = play(arguments.binaries, mode, arguments.seconds, folder, arguments.look)
            fine = fine and is_well
            print("{:<7} {:<17} {:>6} {:>6} {:>5}  {}; {}; {}".format(*row), flush=True)
    return 0 if fine else 1


if __name__ == "__main__":
    sys.exit(main())
