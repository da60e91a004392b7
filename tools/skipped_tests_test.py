#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""tools/skipped_tests.py on what tests print: all that skip, in each form, and those that a filter leaves out."""
import pathlib
import subprocess
import sys
import tempfile
import unittest

from skipped_tests import left_out, skipped

RUN = pathlib.Path(__file__).resolve().parents[1] / "tests/end_to_end/run.py"
TESTS = """import unittest
class Some(unittest.TestCase):
    def test_with_a_docstring(self):
        \'\'\'This one says what it is for.\'\'\'
        self.skipTest("no scanner")
    def test_in_part(self):
        for part in (1, 2):
            with self.subTest(part=part):
                if part == 2:
                    self.skipTest("no second\\nscreen")
    @unittest.skip("never")
    def test_marked(self): pass
    MORE
@unittest.skip("no such machine")
class Whole(unittest.TestCase):
    def test_one(self): pass
"""
GTEST = """4/90 Testing: record
Command: "PROGRAM"
Output:
Note: Google Test filter = -A.Long
[ RUN      ] Disk.IsFull
/src/disk_test.cpp:5: Skipped
this folder
has room

[  SKIPPED ] Disk.IsFull (0 ms)
"""
PROGRAM = """#!/bin/sh
echo "Running main() from gmock_main.cc"
echo "A."
echo "  Short"
[ "$GTEST_FILTER" = '*' ] && echo "  Long"
echo "B/0.  # TypeParam = int"
echo "  Other/1  # GetParam() = 5"
"""


class Skips(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def gtest_log(self):
        """What a program that keeps one of its tests back prints; the program is there."""
        program = self.folder / "record_test"
        program.write_text(PROGRAM)
        program.chmod(0o755)
        return GTEST.replace("PROGRAM", str(program))

    def run_tests(self, more):
        file = self.folder / "some_test.py"
        file.write_text(TESTS.replace("MORE", more))
        done = subprocess.run([sys.executable, RUN, file], capture_output=True, text=True)
        return done.returncode, done.stdout + done.stderr

    def test_each_form_of_a_python_test_is_named(self):
        code, log = self.run_tests("")
        self.assertEqual(code, 0, log)
        self.assertEqual(sorted(skipped(log)), [
            ("some_test.Some.test_in_part (part=2)", "no second screen"), ("some_test.Some.test_marked", "never"),
            ("some_test.Some.test_with_a_docstring", "no scanner"), ("some_test.Whole.test_one", "no such machine")])

    def test_a_file_whose_tests_all_skip_is_skipped_and_no_other(self):
        self.assertEqual(self.run_tests("def setUp(self): self.skipTest('nothing works')")[0], 77)
        self.assertEqual(self.run_tests("def test_more(self): self.fail()")[0], 1)

    def test_those_of_a_program_are_named_also_when_a_filter_leaves_them_out(self):
        log = self.gtest_log()
        self.assertEqual(skipped(log), [("Disk.IsFull", "this folder has room")])
        self.assertEqual(left_out(log), [("A.Long", "left out by the filter of record_test")])

    def test_a_filter_ends_with_its_line_however_much_the_program_prints(self):
        one = self.gtest_log() + "what a test prints\n" * 20000  # more than one argument may have
        named = [("A.Long", "left out by the filter of record_test")]
        self.assertEqual(left_out(one + one), named + named)


if __name__ == "__main__":
    unittest.main()
