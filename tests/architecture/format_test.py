"""Fails where clang-format would lay a source file out otherwise; says which lines.

Usage: format_test.py SOURCE_DIR CLANG_FORMAT
"""
import pathlib
import re
import subprocess
import sys

MAJOR = 14  # Debian 12's: another version lays some lines out otherwise
FOLDERS = ("shared", "server", "client", "bots", "bench", "tests", "web/core")


def main(root, program):
    version = subprocess.run([program, "--version"], capture_output=True, text=True).stdout
    found = re.search(r"version (\d+)\.", version)
    if not found or int(found.group(1)) != MAJOR:
        print(f"clang-format {MAJOR} is wanted, {program} says: {version.strip() or 'nothing'}")
        return 1
    files = [file for folder in FOLDERS for file in sorted((root / folder).rglob("*")) if file.suffix in (".h", ".cpp")]
    if not files:
        print(f"no source file in {root}")
        return 1
    done = subprocess.run([program, "--dry-run", "-Werror", *files], capture_output=True, text=True)
    print(done.stderr or f"{len(files)} files are laid out as .clang-format says", end="" if done.stderr else "\n")
    if done.returncode != 0:
        print("mend:  clang-format -i FILE...")
    return done.returncode


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1]), sys.argv[2]))
