"""The schemas name what the codec, the map reader and the replay reader name: types, fields, kinds, codes, columns, ranges.
A field that is added there without its schema fails here."""

import json
import os
import re
import unittest
import warnings

import jsonschema
from schemas import DOCUMENTS, SOURCE, examples, faults, judge, row_schema, tables, validator

TABLES = tables()


def properties_of(document, skip=()):
    """The names of all members that a schema tells of."""
    found = set()

    def walk(schema, at):
        if isinstance(schema, dict):
            for name, value in schema.get("properties", {}).items() if isinstance(schema.get("properties"), dict) else ():
                if value is not False:
                    found.add(name)
            for key, value in schema.items():
                if key not in ("examples", "default", "const", "enum") and (*at, key) not in skip:
                    walk(value, (*at, key))
        elif isinstance(schema, list):
            for value in schema:
                walk(value, at)

    walk(document, ())
    return found


def read_by(*patterns):
    """The names of the members that the sources read, by how they say it: the first text of a call of a FieldReader, the list
    of a json::Fields."""
    found = set()
    for pattern in patterns:
        files = sorted(SOURCE.glob(pattern))
        assert files, pattern
        for file in files:
            text = file.read_text()
            calls = r"\.(?:field|integer|number|boolean|pair|hash|cleaned_text|key_text|choice|object|array|objects)\(\s*\"(\w+)\""
            found.update(re.findall(calls, text))
            found.update(re.findall(r'read_strings\(reader, "(\w+)"', text))
            for listed in re.findall(r"Fields \w+\(\s*[*\w]+,\s*\{([^}]*)\}", text):
                found.update(re.findall(r'"(\w+)"', listed))
    return found


class Codec(unittest.TestCase):
    def test_each_document_is_a_schema_whose_examples_are_valid(self):
        for name, document in DOCUMENTS.items():
            jsonschema.Draft202012Validator.check_schema(document)
            whole = validator(name[:-5])
            for definition in [document, *document["$defs"].values()]:
                for example in definition.get("examples", ()):
                    self.assertEqual(faults(whole, example), [], example)

    def test_every_definition_says_what_it_is(self):
        def untold(schema, path):
            if not isinstance(schema, dict):
                return
            for name, value in schema.get("properties", {}).items():
                if isinstance(value, dict) and not {"description", "$ref", "const"} & set(value) and name not in ("type", "kind"):
                    yield f"{path}.{name}"
            for name, value in schema.get("properties", {}).items():
                yield from untold(value, f"{path}.{name}")
            yield from untold(schema.get("items"), path + "[]")

        for name, document in DOCUMENTS.items():
            for title, definition in document["$defs"].items():
                self.assertTrue({"description", "anyOf"} & set(definition), f"{name}: {title}")
                self.assertEqual(list(untold(definition, title)), [], name)

    def test_types_of_messages(self):
        for side in ("client", "server"):
            document = DOCUMENTS[side + ".json"]
            types = TABLES[side + "_types"].split(", ")
            self.assertEqual(sorted(document["properties"]["type"]["enum"]), sorted(types))
            self.assertEqual(sorted(a["if"]["properties"]["type"]["const"] for a in document["allOf"]), sorted(types))
            sent = {json.loads(line)["type"] for line in TABLES[side + "_samples"]}
            self.assertEqual(sent | {"key", "delta"} if side == "server" else sent, set(types), "a type without a sample")

    def test_what_the_codec_writes_with_every_field_is_valid(self):
        for side in ("client", "server"):
            whole = validator(side)
            for line in [*map(json.loads, TABLES[side + "_samples"]), *examples(side)]:
                self.assertEqual(faults(whole, line), [], line)

    def test_members_are_those_that_are_read(self):
        common = {"type"}
        limits = {limit["name"] for limit in TABLES["limits"]}
        values = {name for names in TABLES["events"].values() for name in names}
        pairs = {"a", "b"}  # of a gate, read in a loop over both
        self.assertEqual(properties_of(DOCUMENTS["client.json"]), read_by("shared/protocol/decode_client.cpp") | common)
        sources = [f"shared/protocol/decode_{part}.cpp" for part in ("server", "frame", "game", "map", "records")]
        self.assertEqual(properties_of(DOCUMENTS["server.json"]), read_by(*sources) | common | limits | values)
        readers = ["shared/map/*reader.cpp", "shared/map/spawns.cpp"]
        self.assertEqual(properties_of(DOCUMENTS["map.json"]), read_by(*readers) | pairs)
        changes = {"join", "leave", "respawn", "role"}  # of a roster, by a table of its own
        self.assertEqual(properties_of(DOCUMENTS["recording.json"]), read_by("shared/replay/*.cpp") | changes)

    def test_columns(self):
        columns = DOCUMENTS["columns.json"]["$defs"]
        for format in ("quantized", "exact"):
            self.assertEqual(list(columns[format]["$defs"]), list(TABLES["columns"]))
        for name, column in TABLES["columns"].items():
            wants_integer = {format: columns[format]["$defs"][name]["type"] == "integer" for format in ("quantized", "exact")}
            self.assertEqual(wants_integer, {"quantized": True, "exact": column["whole"]}, name)
            if not column["whole"]:
                self.assertIn(f"in 1/{round(1 / column['quantum'])}", columns["quantized"]["$defs"][name]["description"])
        places = lambda row: [place["$ref"].split("/")[-1] for place in columns[row]["prefixItems"]]
        self.assertEqual(places("default_row"), TABLES["default_columns"])
        self.assertEqual(places("all_exact_row"), TABLES["all_columns"])
        self.assertEqual(DOCUMENTS["recording.json"]["$defs"]["keyframe"]["properties"]["columns"]["const"], TABLES["all_columns"])
        names = DOCUMENTS["client.json"]["$defs"]["join"]["properties"]["fields"]["anyOf"][1]["items"]["enum"]
        self.assertEqual(names, list(TABLES["columns"]))
        self.assertEqual(DOCUMENTS["server.json"]["$defs"]["welcome"]["properties"]["fields"]["items"]["enum"], names[1:])
        self.assertEqual(sorted(set(DOCUMENTS["server.json"]["$defs"]["welcome"]["properties"]["quantum"]["items"]["enum"])),
                         sorted({column["quantum"] for column in TABLES["columns"].values()}))

    def test_events(self):
        server = DOCUMENTS["server.json"]["$defs"]
        self.assertEqual(server["event"]["properties"]["kind"]["enum"], list(TABLES["events"]))
        for kind, values in TABLES["events"].items():
            nullable = {name for name, value in server["event_" + kind]["properties"].items() if value.get("type") == ["integer", "null"]}
            self.assertEqual(nullable, set(values), kind)

    def test_codes_and_limits(self):
        server = DOCUMENTS["server.json"]["$defs"]
        for message in ("error", "notice", "bye"):
            codes = [code for code, where in TABLES["codes"].items() if message in where.split(", ")]
            self.assertEqual(server[message]["properties"]["code"]["enum"], codes)
        limits = server["hello"]["properties"]["limits"]["properties"]
        self.assertEqual(list(limits), [limit["name"] for limit in TABLES["limits"]])
        for limit in TABLES["limits"]:
            schema = limits[limit["name"]]
            self.assertTrue(schema["description"].startswith(limit["meaning"]), limit)
            if limit["is_option"]:
                self.assertEqual((schema["minimum"], schema["maximum"]), (limit["least"], limit["most"]), limit)

    def test_numbers(self):
        numbers = TABLES["numbers"]
        join, sent = (DOCUMENTS["client.json"]["$defs"][kind]["properties"] for kind in ("join", "input"))
        server, recording, modes = (DOCUMENTS[name + ".json"]["$defs"] for name in ("server", "recording", "map"))
        said = {
            "max_integer": sent["tick"]["maximum"],
            "max_state_hz": join["state_hz"]["maximum"],
            "max_thrust_ticks": sent["ticks"]["maximum"],
            "most_rank": DOCUMENTS["client.json"]["$defs"]["get_ghost"]["properties"]["rank"]["maximum"],
            "max_table_rows": server["table"]["maxItems"],
            "most_splits": server["ghost"]["properties"]["splits"]["maxItems"],
            "most_records_shown": server["records"]["properties"]["rows"]["maxItems"],
            "most_ghost_inputs": server["ghost"]["properties"]["inputs"]["maxItems"],
            "max_room_bytes": join["room"]["maxLength"],
            "max_gates": modes["race"]["properties"]["gates"]["maxItems"],
            "max_crumbs": modes["forage"]["properties"]["crumbs"]["maximum"],
            "max_places": modes["hill"]["properties"]["places"]["maxItems"],
            "max_lice": recording["keyframe"]["properties"]["lice"]["maxItems"],
            "max_steps": recording["step"]["properties"]["steps"]["maximum"],
            "protocol": join["protocol"]["const"],
            "format": recording["header"]["properties"]["version"]["const"],
        }
        self.assertEqual(said, {name: value for name, value in numbers.items() if name != "behavior"})

    def test_a_row_is_by_the_welcome_s_columns(self):
        plain = validator("row", row_schema(TABLES["default_columns"], "quantized"))
        exact = validator("row", row_schema(TABLES["all_columns"], "exact"))
        rows = [[7, 512, -1024, 37, 256], [7, 512, -1024, 37], [7, 512, -1024, 37, 256, 0], [0, 512, -1024, 37, 256],
                [7, 0.5, -1024, 37, 256], [7, "512", -1024, 37, 256]]
        self.assertEqual([not faults(plain, row) for row in rows], [True, False, False, False, False, False])
        told = judge("server", [{"type": "delta", "tick": 3, "base": 2, "louse": [row]} for row in rows])
        self.assertEqual([verdict == "ok" for verdict in told], [True, False, False, False, False, False])
        row = [7, 0, 0.5, -1.25, 0, 0, 1, 0, 0.5, 0, 0, 0, 3.75, 1, 30]
        self.assertEqual(faults(exact, row), [])
        self.assertNotEqual(faults(exact, [7, 0.5, *row[2:]]), [])

    def test_the_readme_s_python_is_as_it_says(self):
        text = (SOURCE / "docs" / "schema" / "README.md").read_text()
        blocks, lines = [], []
        for line in text.splitlines():
            if line.startswith("    "):
                lines.append(line[4:])
            elif lines:
                blocks.append("\n".join(lines))
                lines = []
        self.assertEqual(len(blocks), 2)
        before = os.getcwd()
        os.chdir(SOURCE)
        try:
            with warnings.catch_warnings():
                warnings.simplefilter("ignore", DeprecationWarning)
                names = {}
                exec(blocks[0], names)  # validates a join; raises where it is none
                with self.assertRaises(jsonschema.ValidationError):
                    exec(blocks[0].replace('"name": "me"', '"nam": "me"'), {})
        finally:
            os.chdir(before)
        self.assertIn("welcome['format']", blocks[1])
        row = {"welcome": {"fields": TABLES["all_columns"], "format": "exact"}}
        exec(blocks[1], row)
        self.assertEqual(row["row"], row_schema(TABLES["all_columns"], "exact"))


if __name__ == "__main__":
    unittest.main()
