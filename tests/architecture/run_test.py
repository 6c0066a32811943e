"""tests/run: what failed while the machine stood still is run once more, one or two tests of programs alone, and nothing else."""

import os
import subprocess
import tempfile
import unittest

RUN = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "run")
# Instead of ctest: a first call fails, PAUSE holds the one who called it meanwhile; a second, of what failed, ends with AGAIN.
CTEST = """#!/bin/sh
echo "$@" >> "$CALLS"
case "$*" in *--rerun-failed*) exit "$AGAIN";; esac
mkdir -p build/none/Testing/Temporary
printf "$FAILED" > build/none/Testing/Temporary/LastTestsFailed.log
printf '1/2 Testing: good\\nwell\\nTest Passed.\\n2/2 Testing: bad\\nit hurts\\nTest Failed.\\n' > build/none/Testing/Temporary/LastTest.log
sleep 0.3
kill -STOP $PPID; sleep "$PAUSE"; kill -CONT $PPID
sleep 0.3
exit 8
"""


class Run(unittest.TestCase):
    def run_with(self, pause, again=0, failed="2:bad\\n"):
        """Exit code, what was printed, how ctest was called."""
        with tempfile.TemporaryDirectory() as folder:
            os.makedirs(os.path.join(folder, "tests"))
            os.makedirs(os.path.join(folder, "bin"))
            with open(RUN) as source, open(os.path.join(folder, "tests", "run"), "w") as copy:
                copy.write(source.read())
            for path, text in (("tests/run", None), ("bin/ctest", CTEST)):
                if text:
                    with open(os.path.join(folder, path), "w") as file:
                        file.write(text)
                os.chmod(os.path.join(folder, path), 0o755)
            calls = os.path.join(folder, "calls")
            environment = dict(os.environ, PATH=os.path.join(folder, "bin") + ":" + os.environ["PATH"], CALLS=calls, PAUSE=str(pause), AGAIN=str(again),
                               FAILED=failed)
            done = subprocess.run([os.path.join(folder, "tests", "run"), "none", "-j", "2"], env=environment, capture_output=True, text=True, timeout=60)
            with open(calls) as file:
                return done.returncode, done.stdout, file.read().splitlines()

    def test_a_failure_of_a_machine_that_ran_is_a_failure_and_is_shown_last(self):
        code, printed, calls = self.run_with(0)
        self.assertEqual((code, calls), (8, ["--preset none -j 2"]))
        self.assertTrue(printed.endswith("---- bad\nit hurts\nTest Failed.\n"), printed)

    def test_what_failed_while_the_machine_stood_still_is_run_once_more(self):
        for again in (0, 8):
            code, printed, calls = self.run_with(1.5, again)
            self.assertEqual((code, calls), (again, ["--preset none -j 2", "--preset none --rerun-failed"]))
            self.assertRegex(printed, r"it stood still for \d+\.\d s")

    def test_one_or_two_tests_of_programs_are_tried_alone_and_told_as_unsteady(self):
        for failed in ("7:e2e: web visits\\n", "7:e2e: web visits\\n9:bots: README\\n"):
            for again in (0, 8):
                code, printed, calls = self.run_with(0, again, failed)
                self.assertEqual((code, calls), (again, ["--preset none -j 2", "--preset none --rerun-failed -j 1 --repeat until-fail:2"]))
                self.assertEqual("UNSTEADY, to be mended: e2e: web visits\n" in printed, again == 0)

    def test_three_of_them_and_whatever_hangs_on_no_time_are_failures(self):
        for failed in ("7:e2e: a\\n8:e2e: b\\n9:e2e: c\\n", "7:e2e: a\\n8:physics:b\\n", ""):
            code, printed, calls = self.run_with(0, 0, failed)
            self.assertEqual((code, calls), (8, ["--preset none -j 2"]))
            self.assertNotIn("UNSTEADY", printed)


if __name__ == "__main__":
    unittest.main()
