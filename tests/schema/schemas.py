"""The schemas of docs/schema, and what the tests of them share. Debian's python3-jsonschema, or any later one."""

import copy
import json
import os
import pathlib
import subprocess
import warnings

import jsonschema

SOURCE = pathlib.Path(os.environ["WOODLOUSE_SOURCE_DIR"])
FOLDER = SOURCE / "docs" / "schema"
DOCUMENTS = {path.name: json.loads(path.read_text()) for path in sorted(FOLDER.glob("*.json"))}

with warnings.catch_warnings():
    warnings.simplefilter("ignore", DeprecationWarning)  # of later versions; Debian's has nothing else
    from jsonschema import RefResolver


def validator(name, schema=None):
    """Of the document NAME.json; with a schema of that, which stands beside them under a name of its own."""
    # The files name each other by their own names, so any address will do: none is fetched.
    base = "https://woodlouse.invalid/"
    store = {base + other: document for other, document in DOCUMENTS.items()}
    document = schema or DOCUMENTS[name + ".json"]
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", DeprecationWarning)
        resolver = RefResolver(base + name + ".json", document, store)
        return jsonschema.Draft202012Validator(document, resolver=resolver)


def row_schema(fields, format):
    """Of the rows that come after a welcome with these."""
    places = [{"$ref": f"columns.json#/$defs/{format}/$defs/{column}"} for column in fields]
    return {"type": "array", "prefixItems": places, "minItems": len(places), "items": False}


def faults(validator, value):
    """What is wrong with the value, in words; empty: nothing."""
    return [f"{'/'.join(map(str, e.absolute_path)) or 'it'}: {e.message}" for e in validator.iter_errors(value)]


def codec(what, lines=()):
    done = subprocess.run([os.environ["WOODLOUSE_CODEC"], what], input="".join(line + "\n" for line in lines),
                          capture_output=True, text=True, timeout=100, check=True)
    return done.stdout


def tables():
    return json.loads(codec("tables"))


def judge(kind, values):
    """What the program's own readers say of each value: "ok" or why not."""
    texts = [json.dumps(value, ensure_ascii=False, separators=(",", ":")) for value in values]
    told = codec("judge", [f"{kind}\t{text}" for text in texts]).splitlines()
    assert len(told) == len(texts), (len(told), len(texts))
    return told


def examples(side):
    """The lines of docs/protocol.md: of clients or of servers."""
    inside, found = None, []
    for line in (SOURCE / "docs" / "protocol.md").read_text().splitlines():
        if line.startswith("```"):
            inside = line[3:]
        elif line.startswith("{") and inside == side:
            found.append(json.loads(line))
    return found


OTHERS = (None, True, 7, -0.5, "text", [], {}, [1, 2, 3])


def kind_of(value):
    if value is None or isinstance(value, bool):
        return "null" if value is None else "boolean"
    return "number" if isinstance(value, (int, float)) else type(value).__name__


def places(value, path=()):
    """Of each member and element, however deep, the way to it."""
    children = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
    for key, child in children:
        yield (*path, key)
        yield from places(child, (*path, key))


def changed(value, path, change):
    """A copy, with change(parent, key) done to the place."""
    whole = copy.deepcopy(value)
    parent = whole
    for key in path[:-1]:
        parent = parent[key]
    change(parent, path[-1])
    return whole


def at(value, path):
    for key in path:
        value = value[key]
    return value


def mutations(value):
    """Each member removed, each misspelt, one too many in each object, each place retyped: (what was done, the path,
    the result)."""
    for path in places(value):
        own = at(value, path)
        name = "/".join(map(str, path))
        if isinstance(path[-1], str):
            yield "removed", path, changed(value, path, lambda parent, key: parent.pop(key))
            yield "misspelt", path, changed(value, path, lambda parent, key: parent.update({key + "_": parent.pop(key)}))
        for other in OTHERS:
            if kind_of(other) != kind_of(own):
                yield f"retyped as {kind_of(other)}", path, changed(value, path, lambda parent, key: parent.__setitem__(key, other))
        if isinstance(own, dict):
            yield "another member", path, changed(value, path, lambda parent, key: parent[key].update({"surplus": 1}))
