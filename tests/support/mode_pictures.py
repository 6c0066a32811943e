#!/usr/bin/python3
"""Pictures of the modes of play: docs/pictures/race-*, forage-*, hill-*, podium-* and the flight, made anew.

    tests/support/mode_pictures.py build/release/bin [-o docs/pictures] [FILE ...]

Each is of a game of its own, on a server of its own with the house's bots. The client is played by keys as tests/siege/played.py
plays it, from what its screen says; of all whole frames the one that shows most of what the picture is of is kept. A first
picture takes a minute or two, as somebody must have won a race before there are ghosts. Look at them before they are
committed. Debian's own Python: pyte and Pillow are packages of it.
"""
import argparse
import contextlib
import json
import os
import re
import subprocess
import sys
import tempfile
import time

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [HERE, os.path.join(HERE, "..", "siege")]
from played import LOOKS, REACTION, Player, Stage, read_some  # noqa: E402
from terminal_picture import Painter, compact  # noqa: E402

GHOST = re.compile(r"author \d|your best|[A-Z]\w+(?: \d)? \d:\d\d\.\d{3}")


class Photographer:
    """Sees each frame, and keeps the picture of the one of most worth."""

    def __init__(self, worth, columns):
        self.worth = worth
        self.map = columns - (33 if columns < 160 else 38)  # columns of it
        self.begun = False
        self.stage = None
        self.best, self.picture, self.text = 0.0, None, ""
        self.since = None  # a frame of any worth

    def see(self, lines, _overlay, _buffer):
        worth = self.worth(lines, "\n".join(line[:self.map] for line in lines[3:-1]))
        if worth <= 0.0 or not re.search(r"srv \d\d  fps \d\d $", lines[0]):  # the last word of the first row
            return
        self.since = self.since or time.monotonic()
        if worth > self.best:
            self.best, self.text = worth, self.stage.text()
            self.picture = Painter(8).picture(self.stage.screen)


def number(pattern, text, otherwise=0.0):
    found = re.search(pattern, text)
    return float(found.group(1)) if found else otherwise


# ---- what a picture is to show, as a number: of the lines of the screen, and of the map in it --------------------------

def worth_of_ghosts(lines, picture):
    seconds = number(r"lap 1/3 run 0:(\d\d\.\d+)", lines[2])
    gate = re.search(r"gate (\w+): \S+ (\d+) m", lines[1])
    ghosts = len(set(GHOST.findall(picture)))
    if not gate or not 2.0 < seconds < 25.0 or ghosts < 2:
        return 0.0
    seen = f"[{gate.group(1)}]" in picture
    metres = abs(int(gate.group(2)) - 12)
    return 4.0 * min(ghosts, 3) + 6.0 * seen + min(2, len(re.findall(r"\w\*", picture))) + 2.0 * ("you" in picture) - metres / 8.0


def worth_of_race(lines, picture):
    gate = re.search(r"gate (\w+): \S+ (\d+) m", lines[1])
    if not gate or f"[{gate.group(1)}]" not in picture or "run 0:" not in lines[2]:
        return 0.0
    lice = len(set(re.findall(r"\b([a-f])\b", picture)))
    return 1.0 + 3.0 * min(2, len(GHOST.findall(picture))) + lice - abs(int(gate.group(2)) - 12) / 10.0


def worth_of_podium(lines, picture):
    if "next round in" not in lines[1]:
        return 0.0
    return 1.0 + 5.0 * ("nothing of yours" not in picture) + picture.count("GOLD") + picture.count("SILVER")


def worth_of_forage(lines, picture):
    score = number(r"score (\d+)", lines[2])
    metres = number(r" (\d+) m", lines[1])
    if not score or not 6.0 <= metres <= 12.0:
        return 0.0
    return 1.0 + 4.0 * (" x2 " in lines[2] or " x3 " in lines[2]) + len(set(re.findall(r"\w\*", picture))) + 2.0 * (score >= 5)


def worth_of_hill(lines, picture):
    if "moves in" not in lines[1]:
        return 0.0
    held = number(r"held (\d+\.\d)", lines[2])
    return 0.1 + 5.0 * ("YOU HOLD IT" in lines[2]) + 2.0 * (held >= 2.0) + len(set(re.findall(r"\w\*", picture)))


def worth_of_flight(lines, picture):
    height = number(r"flies +(\d+\.\d) m", "\n".join(lines))
    if height < 1.0:
        return 0.0
    return min(height, 6.0) + 2.0 * ("fly through" in lines[1]) + 2.0 * len(re.findall(r"\[\w\]", picture))


class Take:
    """A game that a picture is of."""

    def __init__(self, file, mode, worth, maps, options, **more):
        self.file, self.mode, self.worth, self.map, self.options = file, mode, worth, maps, options
        self.bots = more.get("bots", 3)
        self.skill = more.get("skill", "fair")
        self.ghosts = more.get("ghosts", False)  # a lap is driven first, and begun again
        self.change = more.get("change")  # of the map's mode
        self.before = more.get("before", 0.0)  # s that the bots play before
        self.most = more.get("most", 90.0)  # s until there must be a picture
        self.look_on = more.get("look_on", 15.0)  # s for a better one
        columns, rows = re.search(r"(\d+)x(\d+)", file).groups()
        self.size = int(columns), int(rows)


COLOUR, PLAIN = LOOKS["colour"], LOOKS["ascii"]
TAKES = [
    Take("race-ghosts-120x36.png", "race", worth_of_ghosts, "crater_loop", [*COLOUR, "--view", "follow"], bots=3, ghosts=True,
         before=75.0, most=150.0),
    Take("race-80x24.png", "race", worth_of_race, "crater_loop", [*PLAIN, "--view", "map"], bots=4, before=75.0, most=60.0),
    Take("podium-120x36.png", "race", worth_of_podium, "crater_loop", [*COLOUR, "--view", "oblique"], bots=2, skill="easy",
         change={"laps": 1, "round_s": 110, "author_ms": 21700}, most=140.0, look_on=3.0),
    Take("forage-120x36.png", "forage", worth_of_forage, "picnic", COLOUR),
    Take("forage-80x24.png", "forage", worth_of_forage, "picnic", [*PLAIN, "--view", "map"]),
    Take("hill-120x36.png", "hill", worth_of_hill, "table", COLOUR, skill="easy", look_on=60.0),
    Take("hill-80x24.png", "hill", worth_of_hill, "table", [*PLAIN, "--view", "map"], skill="easy", look_on=60.0),
    Take("long-jump-flight-120x36.png", "race", worth_of_flight, "long_jump", [*COLOUR, "--view", "follow"], bots=4, look_on=45.0),
]


def changed_map(take, folder):
    """The map's name, or a copy of its file with other rules."""
    if not take.change:
        return take.map
    with open(os.path.join(HERE, "..", "..", "maps", f"{take.map}.json"), encoding="utf-8") as file:
        content = json.load(file)
    content[take.mode].update(take.change)
    path = os.path.join(folder, f"{take.map}.json")
    with open(path, "w", encoding="utf-8") as file:
        json.dump(content, file)
    return path


@contextlib.contextmanager
def server_of(take, binaries, folder):
    command = [os.path.join(binaries, "woodlouse-server"), "--map", changed_map(take, folder), "--mode", take.mode, "--listen",
               "127.0.0.1:0", "--bots", str(take.bots), "--bots-skill", take.skill, "--bots-alone", "play",
               "--records", os.path.join(folder, "records")]
    server = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
    try:
        line = server.stdout.readline().split()
        if len(line) < 2:
            sys.exit(f"no server: {' '.join(command)}")
        yield line[1]
    finally:
        server.terminate()
        server.wait(timeout=20)


def play(take, stage, player, photographer):
    """Until there is a picture, and nothing better has come for some time."""
    begin = time.monotonic()
    has_begun_again = not take.ghosts
    alive = read_some(stage, 2.0)
    while alive and (now := time.monotonic()) - begin < take.most:
        if not has_begun_again and "lap 2/3" in stage.lines()[2]:
            has_begun_again = True
            photographer.best, photographer.since = 0.0, None
            begin = now
            stage.press(b"r")
        if has_begun_again and photographer.since and now - photographer.since > take.look_on:
            break
        stage.press(player.keys(stage.lines(), now))
        alive = read_some(stage, REACTION)


def make(take, binaries, out):
    with tempfile.TemporaryDirectory(prefix="woodlouse-pictures-") as folder:
        data = os.path.join(folder, "home", ".local/share/woodlouse")
        os.makedirs(data)
        with open(os.path.join(data, "lesson"), "w", encoding="ascii") as mark:
            mark.write("done\n")
        environment = {k: v for k, v in os.environ.items()
                       if not k.startswith(("WOODLOUSE_", "XDG_", "TMUX")) and k != "NO_COLOR"}
        environment.update(TERM="xterm-256color", LC_ALL="C.UTF-8", HOME=os.path.join(folder, "home"))
        photographer, player = Photographer(take.worth, take.size[0]), Player(take.mode)
        with server_of(take, binaries, folder) as address:
            time.sleep(take.before)
            stage = Stage([os.path.join(binaries, "woodlouse"), "--name", "mara", *take.options, address], environment, photographer,
                          player, take.size)
            photographer.stage = stage
            try:
                play(take, stage, player, photographer)
                last = stage.text()
            finally:
                stage.close()
    if photographer.picture is None:
        print(f"{take.file}: nothing worth a picture came; the last screen:\n{last}", file=sys.stderr)
        return False
    compact(photographer.picture).save(os.path.join(out, take.file), optimize=True)
    print(f"{take.file}: worth {photographer.best:.1f}", flush=True)
    return True


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("binaries", help="the folder of woodlouse and woodlouse-server")
    parser.add_argument("files", nargs="*", metavar="FILE", help="only these")
    parser.add_argument("-o", "--output", default=os.path.join(HERE, "..", "..", "docs", "pictures"))
    arguments = parser.parse_args()
    unknown = set(arguments.files) - {take.file for take in TAKES}
    if unknown:
        parser.error(f"no such picture: {' '.join(sorted(unknown))}")
    wanted = [take for take in TAKES if not arguments.files or take.file in arguments.files]
    return 0 if all([make(take, arguments.binaries, arguments.output) for take in wanted]) else 1


if __name__ == "__main__":
    sys.exit(main())
