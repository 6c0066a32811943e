"""bench/measure and bench/results know the same tables.

Usage: measure_test.py SOURCE_DIR
"""
import pathlib
import re
import subprocess
import sys


def main(root):
    listed = set()
    for line in subprocess.run([sys.executable, "-B", root / "bench" / "measure", "--list"], check=True,
                               capture_output=True, text=True).stdout.splitlines():
        listed |= set(line.split(": ")[1].split())
    there = {file.name for file in (root / "bench" / "results").iterdir()} - {"README.md"}
    told = (root / "bench" / "results" / "README.md").read_text()
    patterns = [re.escape(name).replace(r"\*", ".*") for name in re.findall(r"`([\w.*-]+\.(?:txt|csv))`", told)]
    faults = [f"bench/results/{name}: bench/measure does not write it" for name in sorted(there - listed)]
    faults += [f"{name}: listed by bench/measure, not in bench/results" for name in sorted(listed - there)]
    faults += [f"{name}: bench/results/README.md does not tell of it" for name in sorted(there)
               if not any(re.fullmatch(pattern, name) for pattern in patterns)]
    print("\n".join(faults) or f"{len(there)} tables, all of them known")
    return 1 if faults or not there else 0


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1])))
