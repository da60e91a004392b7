#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""tools/check_tests.py finds what depends on the speed of a machine, and nothing else."""
import unittest

from check_tests import compare, in_cpp, in_python, listed


class Cpp(unittest.TestCase):
    def found(self, line):
        return [what.split()[0] for _, what in in_cpp(line)]

    def test_clocks_sleeps_and_deadlines(self):
        self.assertEqual(self.found("const TimePoint begin = steady_now();"), ["steady_now"])
        self.assertEqual(self.found("std::this_thread::sleep_for(10ms);"), ["this_thread::sleep_for"])
        self.assertEqual(self.found("EXPECT_TRUE(changed.wait_for(lock, 30s, [&] { return done; }));"), ["wait_for"])
        self.assertEqual(self.found("if (future.wait_until(end) == ready)"), ["wait_until"])

    def test_folders_of_all_runs(self):
        self.assertEqual(self.found('const fs::path cache = fs::temp_directory_path() / "cache";'), ["temp_directory_path()"])
        self.assertEqual(self.found("const testing::TemporaryFolder folder;"), [])

    def test_conditions_and_given_clocks_are_none(self):
        for line in ("held.wait_until([&] { return held.frames.size() == 51; });", "time.sleep_until(due);",
                     "changed.wait(lock, [&] { return done; });", "// steady_now() is not called", "clock.pass(33ms);"):
            self.assertEqual(self.found(line), [], line)


class Python(unittest.TestCase):
    def found(self, line):
        return [what for _, what in in_python(line)]

    def test_clocks_and_sleeps(self):
        self.assertEqual(len(self.found("import time\ntime.sleep(1)\nbegin = time.monotonic()")), 2)

    def test_rates_and_ages_that_are_compared_with_an_amount(self):
        for line in ('viewer.wait_for(lambda f: f["fps"] > 20)', 'self.assertGreater(figures["fps"], 10)',
                     'self.assertLess(camera(f)["newest_age_ms"], 300)', 'viewer.wait_for(lambda f: f["age_ms"]["p50"] < 1500)'):
            self.assertEqual(len(self.found(line)), 1, line)

    def test_a_rate_that_tells_only_that_something_comes_is_none(self):
        for line in ('viewer.wait_for(lambda f: f["fps"] > 0)', 'viewer.wait_for(lambda f: f["frames"] > 20)',
                     'self.assertEqual(camera(f)["age_ms"], None)'):
            self.assertEqual(self.found(line), [], line)

    def test_deadlines(self):
        for line in ("viewer.wait_for(condition, 10)", "wait_until(condition, timeout=3)", "viewer.end(20)"):
            self.assertEqual(len(self.found(line)), 1, line)
        self.assertEqual(self.found("viewer.wait_for(condition)\nwait_until(condition, 'a picture')"), [])


class List(unittest.TestCase):
    FOUND = {"a_test.py": [(3, "time.sleep needs the real clock"), (9, "time.sleep needs the real clock")]}

    def test_it_is_exact(self):
        self.assertEqual(compare(self.FOUND, listed("# why\na_test.py 2  # paces a stand-in\n")), [])

    def test_more_is_refused_with_each_place(self):
        self.assertEqual(compare(self.FOUND, {})[0], "a_test.py:3: time.sleep needs the real clock (docs/testing.md)")
        self.assertEqual(len(compare(self.FOUND, {"a_test.py": 1})), 3)

    def test_less_shrinks_the_list(self):
        self.assertIn("needs 2, not 3: lower it", compare(self.FOUND, {"a_test.py": 3})[0])
        self.assertIn("leaving its line out", compare({}, {"b_test.cpp": 1})[0])


if __name__ == "__main__":
    unittest.main()
