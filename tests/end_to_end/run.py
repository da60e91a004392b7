# SPDX-License-Identifier: Apache-2.0
"""Runs one file of tests for ctest: each with its name, and with exit code 77 if all of them were skipped.

    python3 tests/end_to_end/run.py tests/end_to_end/session_test.py
"""
import importlib.util
import pathlib
import sys
import unittest

ALL_SKIPPED = 77


def main():
    path = pathlib.Path(sys.argv[1])
    spec = importlib.util.spec_from_file_location(path.stem, path)
    module = importlib.util.module_from_spec(spec)
    sys.modules[path.stem] = module
    spec.loader.exec_module(module)
    suite = unittest.defaultTestLoader.loadTestsFromModule(module)
    result = unittest.TextTestRunner(verbosity=2).run(suite)
    for test, reason in result.skipped:
        print(f"skipped: {test.id()}: {' '.join(reason.split())}")  # for tools/skipped_tests.py
    if not result.wasSuccessful() or suite.countTestCases() == 0:
        return 1
    # A class that is skipped as a whole is one entry; its tests do not run. A test that skips a part of itself has run.
    whole = [test for test, _ in result.skipped if not hasattr(test, "test_case")]
    return ALL_SKIPPED if whole and result.testsRun <= len(whole) else 0


if __name__ == "__main__":
    raise SystemExit(main())
