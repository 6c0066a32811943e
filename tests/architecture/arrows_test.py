"""Reads every #include and fails on one that follows no arrow of ARCHITECTURE.md, and on a room that has become a
cupboard.

Usage: arrows_test.py SOURCE_DIR
"""
import pathlib
import re
import sys

# room: the rooms it may include besides itself. A room is a folder; those of shared/ go by their own name alone.
ARROWS = {
    "core": set(),
    "state": {"core"},
    "json": {"core"},
    "terrain": {"core"},
    "elevation": {"core", "json", "terrain"},
    "physics": {"core", "state", "terrain"},
    "physics/lanes": {"core", "state", "terrain", "physics"},
    "document": {"core", "state", "terrain", "physics"},
    "map": {"core", "json", "state", "terrain", "elevation", "physics", "document"},
    "protocol": {"core", "json", "state", "terrain"},
    "rules": {"core", "state", "terrain", "physics", "map"},
    "match": {"core", "state", "terrain", "physics", "map", "rules"},
    "replay": {"core", "json", "state", "terrain", "physics", "map", "rules", "match", "protocol"},
    "follow": {"core", "state", "map", "rules", "match", "protocol", "replay"},
}
LIBRARY = set(ARROWS)
SHARED = LIBRARY - {"physics/lanes"}  # reached through physics/batch.h
ARROWS |= {
    "server/logging": SHARED,
    "server/timing": SHARED,
    "server/frames": SHARED,
    "server/bots": SHARED,
    "server/stream": SHARED | {"server/frames"},
    "server/room": SHARED | {"server/access", "server/bots", "server/frames", "server/logging", "server/stream", "server/timing"},
    "server/watchers": SHARED | {"server/logging", "server/room", "server/stream", "server/timing"},
    "server/records": SHARED | {"server/frames", "server/logging", "server/room", "server/timing", "server/watchers"},
    "server/proxies": SHARED | {"server/timing"},
    "server/web": SHARED | {"server/room"},
    "server/net": SHARED | {"server/access", "server/frames", "server/logging", "server/proxies", "server/room", "server/stream", "server/timing", "server/web"},
    "server/access": SHARED | {"server/timing"},
    "server/admin": SHARED | {"server/access", "server/logging", "server/net", "server/timing", "server/web"},
    "server/metrics": SHARED | {"server/room", "server/timing", "server/watchers"},
    "server/relay": SHARED | {"server/logging", "server/room", "server/stream", "server/timing"},
    "server/cluster": SHARED | {"server/access", "server/logging", "server/room", "server/stream", "server/timing"},
    "server/commands": SHARED | {"server/admin", "server/net", "server/records", "server/room"},
    "client/cells": SHARED,
    "client/ground": SHARED | {"client/cells"},
    "client/drawing": SHARED | {"client/cells", "client/ground", "client/drawing/course"},
    "client/drawing/course": SHARED | {"client/cells", "client/ground", "client/drawing"},
    "client/terminal": SHARED | {"client/cells", "client/drawing"},
    "client/controls": SHARED | {"client/drawing", "client/terminal"},
    "client/net": SHARED,
    "client/play": SHARED | {"client/cells", "client/controls", "client/drawing", "client/terminal", "client/net", "client/play/modes"},
    "client/play/modes": SHARED | {"client/cells", "client/controls", "client/drawing", "client/drawing/course", "client/play"},
    "client/watch": SHARED | {"client/cells", "client/controls", "client/drawing", "client/terminal", "client/play", "client/play/modes"},
}
for program in ("server", "client"):
    ARROWS[program] = SHARED | {room for room in ARROWS if room.startswith(program + "/")}
PROGRAMS = set(ARROWS) - LIBRARY
ARROWS["bots"] = SHARED
ARROWS["web/core"] = SHARED
ARROWS["bench"] = LIBRARY | PROGRAMS

# outside header: the rooms or files that may include it. tests may include everything.
OUTSIDE = {
    "boost/": {room for room in PROGRAMS if room not in ("client/cells", "client/ground", "client/drawing")} | {"bots", "bench"},
    "boost/beast/": {"server/net", "server/admin"},
    "boost/asio/ssl": {"server/net"},
    "openssl/": {"server/net", "server/access", "server/main.cpp"},
    "nats/": {"server/cluster/nats_link.cpp"},
    "prometheus/": {"server/metrics"},
    "nlohmann/": {"shared/json/parser.cpp", "server/config_file.cpp", "client/config.cpp"},
    "Eigen/": {"bench"},
    "xxhash.h": {"core"},
    "zstd.h": {"replay"},
    "spdlog/": {room for room in PROGRAMS if room.startswith("server")},
    "CLI/": {"server", "client", "bots", "bench"},
    "benchmark/": {"bench"},
}
# shared/ runs where there are no files, threads or clocks (a browser). What opens files stands in *_file units.
OPERATING_SYSTEM = {"filesystem", "fstream", "thread", "mutex", "chrono"}
ONLY_WITH_ONE = {"shared/core/clock.h", "shared/core/lock.h", "shared/core/thread_team.h", "shared/replay/parallel_verify.cpp"}
# Step code must give the same bits everywhere: nothing here but sqrt and fabs.
STEP_ROOMS = {"core", "state", "terrain", "elevation", "physics", "physics/lanes", "document", "map", "rules", "match"}
# Calls with std::, with :: and with neither, of any precision. (sqrt, floor and the like round exactly everywhere.)
LIBM = re.compile(r"(?<![\w.>])(?:std::|::)?(?:a?(?:sin|cos|tan)h?|atan2|sincos|exp2?|exp10|expm1|log(?:2|10|1p)?|pow|cbrt|hypot|fma"
                  r"|fmod|remainder|erfc?|[lt]gamma|lerp)[fl]?\s*\(")
LIBM_ALLOWED = {"shared/physics/attitude.cpp"}  # for who looks at it; enters no state


def room_of(path):
    """shared/core/vec2.h: core; shared/physics/lanes/kernel.h: physics/lanes; server/net/session.h: server/net;
    server/main.cpp: server; bench/lab/x.cpp: bench."""
    folders = path.parts[:-1]
    if folders[0] == "shared":
        return "/".join(folders[1:])
    if folders[0] in ("bots", "bench"):
        return folders[0]
    return "/".join(folders)


def main(root):
    faults = []
    count = 0
    for folder in ("shared", "server", "client", "bots", "bench", "web/core"):
        for file in sorted((root / folder).rglob("*")):
            if file.suffix not in (".h", ".cpp"):
                continue
            count += 1
            path = file.relative_to(root)
            room = room_of(path)
            if room not in ARROWS:
                faults.append(f"{path}: no room of ARCHITECTURE.md")
                continue
            for number, line in enumerate(file.read_text().splitlines(), 1):
                place = f"{path}:{number}"
                own = re.match(r'\s*#\s*include\s+"([^"]+)"', line)
                outside = re.match(r"\s*#\s*include\s+<([^>]+)>", line)
                if own:
                    target = room_of(pathlib.PurePath(own.group(1)))
                    if own.group(1) == "shared/core/clock.h" and room in SHARED:
                        faults.append(f"{place}: shared/ is told the time")
                    if target != room and target not in ARROWS[room]:
                        faults.append(f"{place}: {room} may not include {own.group(1)}")
                if outside:
                    for prefix, rooms in OUTSIDE.items():
                        if outside.group(1).startswith(prefix) and not rooms & {room, str(path)}:
                            faults.append(f"{place}: {room} may not include <{outside.group(1)}>")
                    needs_one = outside.group(1) in OPERATING_SYSTEM
                    may = file.stem.endswith("_file") or str(path) in ONLY_WITH_ONE
                    if room in SHARED and needs_one and not may:
                        faults.append(f"{place}: <{outside.group(1)}> outside of *_file")
                if room in STEP_ROOMS and str(path) not in LIBM_ALLOWED and LIBM.search(line.split("//")[0]):
                    faults.append(f"{place}: libm in step code")
    print("\n".join(faults) or f"{count} files follow the arrows")
    return 1 if faults or count == 0 else 0


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1])))
