"""Reads every #include and fails on one that follows no arrow of ARCHITECTURE.md.

Usage: arrows_test.py SOURCE_DIR
"""
import pathlib
import re
import sys

# room: the rooms it may include besides itself. shared/ rooms are named by their folder under shared/.
ARROWS = {
    "core": set(),
    "terrain": {"core"},
    "physics": {"core", "terrain"},
    "json": {"core"},
    "map": {"core", "terrain", "physics", "json"},
    "protocol": {"core", "json"},
    "match": {"core", "terrain", "physics", "map"},
    "replay": {"core", "terrain", "physics", "map", "match", "protocol", "json"},
}
SHARED = set(ARROWS)
for program in ("server", "client", "bots", "bench"):
    ARROWS[program] = SHARED
ARROWS["bench"] = SHARED | {"server", "client"}

# outside header: the rooms or files that may include it. tests may include everything.
OUTSIDE = {
    "boost/": {"server", "client", "bots", "bench"},
    "nlohmann/": {"shared/json/parser.cpp", "server/config_file.cpp", "client/config.cpp"},
    "Eigen/": {"bench"},
    "xxhash.h": {"core"},
    "zstd.h": {"replay"},
    "spdlog/": {"server"},
    "CLI/": {"server", "client", "bots", "bench"},
    "benchmark/": {"bench"},
}
# Step code must give the same bits everywhere: nothing here but sqrt and fabs.
STEP_ROOMS = {"terrain", "physics", "match"}
LIBM = re.compile(r"\bstd::(sin|cos|tan|asin|acos|atan2?|exp2?|log(2|10)?|pow|cbrt|hypot|fma)\b")
LIBM_ALLOWED = {"shared/physics/attitude.cpp"}  # for who looks at it; enters no state


def room_of(path):
    parts = path.parts
    return parts[1] if parts[0] == "shared" else parts[0]


def main(root):
    faults = []
    count = 0
    for folder in ("shared", "server", "client", "bots", "bench"):
        for file in sorted((root / folder).rglob("*")):
            if file.suffix not in (".h", ".cpp"):
                continue
            count += 1
            path = file.relative_to(root)
            room = room_of(path)
            for number, line in enumerate(file.read_text().splitlines(), 1):
                place = f"{path}:{number}"
                own = re.match(r'\s*#\s*include\s+"([^"]+)"', line)
                outside = re.match(r"\s*#\s*include\s+<([^>]+)>", line)
                if own:
                    target = room_of(pathlib.PurePath(own.group(1)))
                    if target != room and target not in ARROWS.get(room, set()):
                        faults.append(f"{place}: {room} may not include {own.group(1)}")
                if outside:
                    for prefix, rooms in OUTSIDE.items():
                        if outside.group(1).startswith(prefix) and not rooms & {room, str(path)}:
                            faults.append(f"{place}: {room} may not include <{outside.group(1)}>")
                if room in STEP_ROOMS and str(path) not in LIBM_ALLOWED and LIBM.search(line.split("//")[0]):
                    faults.append(f"{place}: libm in step code")
    print("\n".join(faults) or f"{count} files follow the arrows")
    return 1 if faults or count == 0 else 0


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1])))
