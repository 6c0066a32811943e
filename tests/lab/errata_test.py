"""The figures that docs/physics.md gives for the document's errors, measured again."""
import os
import subprocess
import sys
import unittest

import lab

ERRATA = os.path.join(os.path.dirname(__file__), "..", "..", "bench", "lab", "errata.py")


class Errata(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        done = subprocess.run([sys.executable, "-B", ERRATA, lab.LAB], capture_output=True, text=True, timeout=200)
        if done.returncode != 0:
            raise AssertionError(done.stderr)
        cls.lines = [line for line in done.stdout.splitlines() if not line.startswith("#")]

    def figure(self, *words):
        """The number of the one line that has all these words."""
        found = [line for line in self.lines if all(word in line for word in words)]
        self.assertEqual(len(found), 1, words)
        return next(float(field) for field in reversed(found[0].split()) if field not in ("m", "%"))

    def test_the_local_plane_is_1_4_m_and_up_to_30_percent_of_the_energy_off(self):
        self.assertAlmostEqual(self.figure("2:", "parabolic_pot", "thrown", "position"), 1.39, delta=0.005)
        self.assertAlmostEqual(self.figure("2:", "parabolic_pot", "let go", "energy"), 22.7, delta=0.05)
        self.assertAlmostEqual(self.figure("2:", "wavy_pot", "let go", "energy"), 29.8, delta=0.05)

    def test_the_document_s_friction_creeps_8_m_and_the_stick_test_not_at_all(self):
        self.assertAlmostEqual(self.figure("5:", "as_printed"), 7.96, delta=0.005)
        self.assertAlmostEqual(self.figure("5:", "local_plane"), 7.99, delta=0.005)
        self.assertEqual(self.figure("5:", "nystrom4"), 0.0)

    def test_the_blended_gradient_as_printed_is_not_the_derivative_of_its_height(self):
        self.assertAlmostEqual(self.figure("11:", "wavy_pot"), 0.00884, delta=5e-6)
        self.assertAlmostEqual(self.figure("11:", "volcano"), 0.0276, delta=5e-5)


if __name__ == "__main__":
    unittest.main()
