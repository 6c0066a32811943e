"""Reads the page's modules and fails on an import that follows no arrow, on a room or a module that has become a cupboard, and
on what a page of ours may not do.

Usage: page_test.py SOURCE_DIR

The page is ES modules served as they are written (web/page). Its rooms are folders, as everywhere; `page.js` stands above them.
"""
import collections
import pathlib
import re
import sys

# room: the rooms it may import from besides itself
ARROWS = {
    "core": set(),
    "picture": set(),
    "live": {"core"},
    "panels": {"core", "live"},
    "lab": {"core"},
}
PAGE = set(ARROWS)
MOST_LINES = 250
MOST_NOUNS = 25
IMPORT = re.compile(r"""(?:\bimport\b[^'"();]*?\bfrom\s*|\bimport\s*|\bimport\s*\(\s*|\bexport\b[^'"();]*?\bfrom\s*)(['"])([^'"]+)\1""")
WORKER = re.compile(r"""new\s+URL\(\s*(['"])([^'"]+\.js)\1\s*,\s*import\.meta\.url""")
# what is forbidden: in which rooms (None: everywhere), and why
FORBIDDEN = (
    (re.compile(r"\.(?:inner|outer)HTML\b|insertAdjacentHTML|document\.write\b"), None,
     "what comes from a server never becomes HTML: textContent"),
    (re.compile(r"\beval\s*\(|\bnew\s+Function\b|setTimeout\(\s*['\"]"), None, "the page's policy forbids text as code"),
    (re.compile(r"https?://(?!www\.w3\.org/)"), None, "the page asks its own server alone"),
    (re.compile(r"setAttribute\(\s*['\"](?:style|on\w+)['\"]"), None, "the page's policy forbids it"),
    (re.compile(r"\bMath\.random\b"), {"core", "picture"}, "what is shown or proven is no matter of chance"),
    (re.compile(r"\bdocument\.(?!createElement\(\s*['\"]canvas)"), {"core", "live"}, "knows no page"),
    (re.compile(r"\bWebSocket\b|\bfetch\s*\("), {"picture", "panels"}, "asks no server"),
    (re.compile(r"\bgetContext\(\s*['\"]webgl"), {"core", "live", "panels"}, "picture/ alone draws in WebGL"),
)
INLINE = re.compile(r"""<[^>]*\s(?:style|on\w+)\s*=|<style\b|<script(?![^>]*\bsrc=)""", re.I)


def room_of(path):
    return path.parts[0] if len(path.parts) > 1 else ""


def without_comments(text):
    """The same lines, their comments blanked; good for this tree, whose strings hold no comment's beginning."""
    text = re.sub(r"/\*.*?\*/", lambda found: re.sub(r"[^\n]", " ", found.group()), text, flags=re.S)
    return re.sub(r"(?m)(^|[\s;{}(,])//[^\n]*", r"\1", text)


def imports(path, code, page):
    """Each module that is asked for: the line, its path under the page's folder (None: outside of it)."""
    for pattern in (IMPORT, WORKER):
        for found in pattern.finditer(code):
            line = code.count("\n", 0, found.start()) + 1
            name = found.group(2)
            target = (page / path.parent / name).resolve() if name.startswith(".") else None
            inside = target is not None and target.is_relative_to(page) and target.is_file()
            yield line, name, target.relative_to(page) if inside else None


def faults_of_module(path, page):
    text = (page / path).read_text()
    room = room_of(path)
    lines = text.splitlines()
    if len(lines) > MOST_LINES:
        yield f"{path}: {len(lines)} lines, at most {MOST_LINES}: split it by what it does"
    if not any(line.strip() == "// @ts-check" for line in lines[:3]):
        yield f"{path}: does not begin with // @ts-check"
    if room and room not in PAGE:
        yield f"{path}: no room of ARCHITECTURE.md"
        return
    code = without_comments(text)
    for number, name, target in imports(path, code, page):
        if target is None:
            yield f"{path}:{number}: {name} is no module of the page"
        elif room and room_of(target) != room and room_of(target) not in ARROWS[room]:
            yield f"{path}:{number}: {room} may not import {name}"
    for number, line in enumerate(code.splitlines(), 1):
        for pattern, rooms, why in FORBIDDEN:
            if (rooms is None or room in rooms) and pattern.search(line):
                yield f"{path}:{number}: {pattern.search(line).group().strip()}: {why}"


def main(root):
    page = (root / "web" / "page").resolve()
    modules = [file.relative_to(page) for file in sorted(page.rglob("*.js"))]
    nouns = collections.defaultdict(set)
    faults = []
    for path in modules:
        nouns[path.parent].add(path.stem)
        faults += faults_of_module(path, page)
    for folder, names in sorted(nouns.items()):
        if len(names) > MOST_NOUNS:
            faults.append(f"web/page/{folder}: {len(names)} nouns, at most {MOST_NOUNS}: find the rooms in it")
    for file in sorted(page.rglob("*.html")):
        for number, line in enumerate(file.read_text().splitlines(), 1):
            if INLINE.search(line):
                faults.append(f"{file.relative_to(page)}:{number}: the page's policy forbids code and style inside of HTML")
    print("\n".join(faults) or f"{len(modules)} modules of the page follow the arrows")
    return 1 if faults or not modules else 0


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1])))
