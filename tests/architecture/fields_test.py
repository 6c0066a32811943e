"""A louse's fields are listed once (shared/state/louse_fields.h); Python's table and the documents say the same.

Usage: fields_test.py SOURCE_DIR
"""
import pathlib
import re
import sys

TYPES = {4: "u32", 8: "f64"}
CODES = {"I": 4, "d": 8}


def fields_of_cpp(root):
    text = (root / "shared" / "state" / "louse_fields.h").read_text()
    return [(name, int(size)) for name, size in re.findall(r'LouseField\{"(\w+)",[^{}]*?offsetof\([^()]*\),\s*(\d)', text)]


def fields_of_python(root):
    sys.path.insert(0, str(root / "bots" / "python"))
    sys.dont_write_bytecode = True
    import woodlouse_proof
    layout = "".join(code * int(count or 1) for count, code in re.findall(r"(\d*)([a-zA-Z])", woodlouse_proof._LOUSE.format))
    return list(zip(woodlouse_proof.ALL_FIELDS, [CODES[code] for code in layout], strict=True))


def offsets_of(fields):
    end, offsets = 0, {}
    for name, size in fields:
        offsets[name] = (end, TYPES[size])
        end += size
    return offsets


def offsets_of_document(root):
    text = (root / "docs" / "determinism.md").read_text()
    table = text[text.index("A louse (`shared/state/louse.h`)"):text.index("An input as applied")]
    offsets = {}
    for places, kind, columns in re.findall(r"^\| ([\d, ]+) \| (\w+) \| ([^|]+) \|", table, re.M):
        names = re.findall(r"`(\w+)`", columns)
        for name, offset in zip(names, places.split(","), strict=True):
            offsets[name] = (int(offset), kind)
    return offsets


def main(root):
    cpp = fields_of_cpp(root)
    faults = []
    if len(cpp) != 15 or sum(size for _, size in cpp) != 104:
        faults.append(f"louse_fields.h: {len(cpp)} fields of {sum(size for _, size in cpp)} bytes could be read")
    if fields_of_python(root) != cpp:
        faults.append(f"bots/python/woodlouse_proof.py has {fields_of_python(root)}\nlouse_fields.h has {cpp}")
    if offsets_of_document(root) != offsets_of(cpp):
        faults.append(f"docs/determinism.md has {offsets_of_document(root)}\nlouse_fields.h has {offsets_of(cpp)}")
    protocol = (root / "docs" / "protocol.md").read_text()
    faults += [f"docs/protocol.md does not tell of the column {name}" for name, _ in cpp if f"`{name}`" not in protocol]
    print("\n".join(faults) or f"{len(cpp)} fields, the same in C++, Python and the documents")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1])))
