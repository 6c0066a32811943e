"""Whatever the server logs is an event of server/logging/events.h, and each event there is one that is logged.

Usage: log_events_test.py SOURCE_DIR
"""
import pathlib
import re
import sys

# The logger's own calls: a line without an event.
PAST_EVENTS = re.compile(r"(?:\blog_?|logger\(?\)?)\s*(?:->|\.)\s*(?:trace|debug|info|warn|error|critical|log)\s*\(|\bspdlog::(?:trace|debug|info|warn|error|critical|log)\s*\(")


def main(root):
    header = (root / "server/logging/events.h").read_text()
    names = re.findall(r"^  (k\w+),$", header[header.index("enum class LogEvent"):header.index("kLogEventCount")], re.M)
    faults, used = [], set()
    for file in sorted((root / "server").rglob("*")):
        if file.suffix not in (".h", ".cpp") or file.parent.name == "logging":
            continue
        text = re.sub(r"//.*", "", file.read_text())
        used |= set(re.findall(r"LogEvent::(k\w+)", text))
        for number, line in enumerate(text.splitlines(), 1):
            if PAST_EVENTS.search(line):
                faults.append(f"{file.relative_to(root)}:{number}: logs no event: use log_event (server/logging/events.h)")
    faults += [f"server/logging/events.h: nobody logs {name}" for name in names if name not in used]
    print("\n".join(faults) or f"{len(names)} events are logged, and nothing else is")
    return 1 if faults or len(names) < 20 else 0


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1])))
