"""Every subcommand's --help ends with an example that runs as it stands."""
import os
import subprocess
import tempfile
import unittest

import lab

SUBCOMMANDS = "sample trajectory precision stability speed skip figures".split()


def examples_of(subcommand):
    lines = lab.run(subcommand, "--help").stdout.splitlines()
    start = lines.index("Example:")
    return [line.strip() for line in lines[start + 1:] if "woodlouse-lab" in line]


class Examples(unittest.TestCase):
    def test_each_subcommand_has_an_example_and_it_runs(self):
        path = os.path.dirname(lab.LAB) + os.pathsep + os.environ["PATH"]
        for subcommand in SUBCOMMANDS:
            examples = examples_of(subcommand)
            self.assertTrue(examples, subcommand)
            for example in examples:
                with self.subTest(example), tempfile.TemporaryDirectory() as folder:
                    done = subprocess.run(example, shell=True, cwd=folder, env={**os.environ, "PATH": path},
                                          capture_output=True, text=True, timeout=200)
                    self.assertEqual(done.returncode, 0, done.stderr)
                    self.assertGreater(len(done.stdout.splitlines()), 1)

    def test_quick_is_offered_everywhere(self):
        for subcommand in SUBCOMMANDS:
            self.assertIn("--quick", lab.run(subcommand, "--help").stdout)

    def test_tables_say_what_made_them_and_without_gnuplot_are_written_all_the_same(self):
        with tempfile.TemporaryDirectory() as folder:
            done = lab.run("stability", "--quick", "--only", "crates", "--integrator", "nystrom4", "--out", folder, "--commit", "abc1234",
                           env={**os.environ, "PATH": folder})
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertIn("gnuplot is missing", done.stdout)
            with open(os.path.join(folder, "lab-stability.csv")) as file:
                text = file.read()
        for word in ("# machine:", "# commit: abc1234", "# command: woodlouse-lab stability --quick"):
            self.assertIn(word, text)


if __name__ == "__main__":
    unittest.main()
