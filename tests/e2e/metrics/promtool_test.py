"""What Prometheus's own tool says of /metrics, and of the rules and the configuration in docs/."""

import os
import pathlib
import subprocess
import sys
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "server"))
from scrape import Watched

PROMTOOL = os.environ["WOODLOUSE_PROMTOOL"]
SOURCE = pathlib.Path(__file__).parents[3]


class Promtool(unittest.TestCase):
    def judge(self, *arguments, **options):
        done = subprocess.run([PROMTOOL, *map(str, arguments)], capture_output=True, text=True, timeout=60, **options)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        return done.stdout + done.stderr

    def test_the_metrics_of_a_played_server_are_in_order(self):
        with Watched("--shadow", "--bots", "2") as server, server.player() as mara:
            mara.send({"type": "input", "seq": 1, "thrust": [0.5, 0]}, {"type": "nonsense"})
            mara.expect("error")
            server.wait_for(lambda s: s["woodlouse_room_ticks_total", "volcano"] >= 60)
            self.assertEqual(self.judge("check", "metrics", input=server.ask("/metrics")[2]), "")

    def test_the_alarms_are_rules_and_ring_when_they_should(self):
        self.assertIn("SUCCESS", self.judge("check", "rules", SOURCE / "docs" / "alarms.yml"))
        self.assertIn("SUCCESS", self.judge("test", "rules", SOURCE / "tests" / "e2e" / "metrics" / "alarms.yml"))

    def test_every_alarm_has_a_test_of_its_own(self):
        rules = (SOURCE / "docs" / "alarms.yml").read_text()
        tests = (SOURCE / "tests" / "e2e" / "metrics" / "alarms.yml").read_text()
        alarms = [line.split("alert:")[1].strip() for line in rules.splitlines() if "alert:" in line]
        self.assertGreater(len(alarms), 8)
        for alarm in alarms:
            self.assertIn(f"alertname: {alarm}\n", tests)

    def test_the_sample_configuration_is_one(self):
        # It names the token's file, which is not here.
        self.judge("check", "config", "--syntax-only", SOURCE / "docs" / "prometheus.yml")


if __name__ == "__main__":
    unittest.main()
