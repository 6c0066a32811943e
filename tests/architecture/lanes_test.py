"""Files compiled for one instruction set share no code with others: the linker keeps one copy of what several files
define, and a machine without that set would run it.

Usage: lanes_test.py BUILD_DIR (a Release build by g++: unoptimised, small functions stay)
"""
import pathlib
import re
import subprocess
import sys

FOLDERS = ("shared/core/CMakeFiles/woodlouse_core.dir", "shared/physics/CMakeFiles/woodlouse_physics.dir/lanes",
           "bench/lab/CMakeFiles/woodlouse_lab.dir/methods")
SHARED = re.compile(r" [WVu] (?!.*\bLanes[148]\b)(.*)")  # weak, and not of a lane type


def main(build):
    objects = [file for folder in FOLDERS for file in sorted((build / folder).glob("*avx*.o"))]
    faults = []
    for file in objects:
        names = subprocess.run(["nm", "-C", file], check=True, capture_output=True, text=True).stdout
        faults += [f"{file.relative_to(build)}: {found[1]}" for found in map(SHARED.search, names.splitlines()) if found]
    print("\n".join(faults) or f"{len(objects)} files for one instruction set share nothing")
    return 1 if faults or not objects else 0


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1])))
