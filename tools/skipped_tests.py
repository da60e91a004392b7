#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Names every test that the last ctest run in these build folders skipped, with its reason.

ctest counts programs; one of hundreds of tests that skips some of them passes there.
    tools/skipped_tests.py build/release...
"""
import collections
import pathlib
import re
import sys

GTEST = re.compile(r"^[^\n]*: Skipped\n(?P<why>.*?)\n+\[  SKIPPED \] (?P<name>[^\s,]+)", re.MULTILINE | re.DOTALL)


def skipped(log):
    """[(test, reason)] in the text that ctest kept of its last run."""
    found = [(m["name"], " ".join(m["why"].split())) for m in GTEST.finditer(log)]
    for line in log.splitlines():
        if m := re.match(r"^(\w+) \(([\w.]+)\) \.\.\. skipped (['\"])(.*)\3$", line):
            found.append((m[2] if m[2].endswith(m[1]) else f"{m[2]}.{m[1]}", m[4]))
    return found


def main():
    total = 0
    for folder in sys.argv[1:]:
        log = pathlib.Path(folder, "Testing/Temporary/LastTest.log")
        if not log.exists():
            continue
        by_reason = collections.defaultdict(list)
        for name, why in skipped(log.read_text(errors="replace")):
            by_reason[why].append(name)
        for why, names in by_reason.items():
            print(f"skipped in {folder}: {len(names)} ({names[0]}{', ...' if len(names) > 1 else ''}): {why}")
            total += len(names)
    print(f"{total} tests skipped." if total else "No test was skipped.")


if __name__ == "__main__":
    main()
