#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""tools/repeated_tests.py on what a real ctest writes about tests that pass, fail, and fail once."""
import pathlib
import subprocess
import sys
import tempfile
import unittest

TOOL = pathlib.Path(__file__).with_name("repeated_tests.py")
PROJECT = """cmake_minimum_required(VERSION 3.25)
project(tests NONE)
enable_testing()
add_test(NAME passes COMMAND true)
add_test(NAME skips COMMAND sh -c "exit 77")
set_tests_properties(skips PROPERTIES SKIP_RETURN_CODE 77)
foreach(name ONCE)
  add_test(NAME ${name} COMMAND sh -c "test -e ${name} || { touch ${name}; echo AssertionError: ${name} is late; echo FAILED; exit 1; }")
endforeach()
"""


class Repeats(unittest.TestCase):
    def run_with(self, *once):
        """The answer of the tool to a run in which these tests fail once: its exit code, its output and the file that it keeps."""
        with tempfile.TemporaryDirectory() as folder:
            folder = pathlib.Path(folder)
            (folder / "CMakeLists.txt").write_text(PROJECT.replace("ONCE", " ".join(once)))
            subprocess.run(["cmake", "-B", folder / "build", "-S", folder], check=True, capture_output=True)
            done = subprocess.run(["ctest", "--test-dir", folder / "build", "--repeat", "until-pass:2"], capture_output=True, text=True)
            self.assertEqual(done.returncode, 0, done.stdout)
            kept = folder / "kept.txt"
            done = subprocess.run([sys.executable, TOOL, folder / "build/Testing/Temporary/LastTest.log", "--keep", kept, "--most", "2"],
                                  capture_output=True, text=True)
            return done.returncode, done.stdout + done.stderr, kept.read_text() if kept.exists() else ""

    def test_nothing_is_said_of_tests_that_pass_or_skip(self):
        self.assertEqual(self.run_with(), (0, "No test needed a second try.\n", ""))

    def test_one_is_named_and_what_it_said_is_kept(self):
        code, said, kept = self.run_with("mouse")
        self.assertEqual(code, 0)
        self.assertIn("repeated: mouse, which passed then: AssertionError: mouse is late\n", said)
        self.assertIn(" mouse passed then\nAssertionError: mouse is late\nFAILED\n", kept)

    def test_three_are_no_chance(self):
        code, said, _ = self.run_with("mouse", "cat", "dog")
        self.assertEqual(code, 1)
        self.assertIn("More than 2", said)


if __name__ == "__main__":
    unittest.main()
