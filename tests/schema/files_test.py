"""Every map and ghost that is shipped, every map of a scenario, and those in the documents' examples are as the schemas say."""

import json
import unittest

from schemas import SOURCE, faults, validator


class Files(unittest.TestCase):
    def test_shipped_maps(self):
        schema = validator("map")
        files = sorted((SOURCE / "maps").glob("*.json"))
        self.assertGreater(len(files), 15)
        for file in files:
            self.assertEqual(faults(schema, json.loads(file.read_text())), [], file.name)

    def test_ghosts(self):
        schema = validator("server")
        files = sorted((SOURCE / "maps" / "ghosts").glob("*.json"))
        self.assertGreater(len(files), 4)
        for file in files:
            ghost = json.loads(file.read_text())
            self.assertEqual((faults(schema, ghost), ghost["type"]), ([], "ghost"), file.name)

    def test_maps_of_scenarios(self):
        schema = validator("map")
        seen = 0
        for file in sorted((SOURCE / "tests" / "scenarios").glob("*.json")):
            scenario = json.loads(file.read_text())
            if isinstance(scenario["map"], dict):
                seen += 1
                self.assertEqual(faults(schema, scenario["map"]), [], file.name)
        self.assertGreater(seen, 5)


if __name__ == "__main__":
    unittest.main()
