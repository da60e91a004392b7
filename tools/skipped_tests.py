#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Names every test that ctest skipped, with its reason, and every one that a filter left out.

ctest counts programs; one of hundreds of tests that skips some of them passes there.
    tools/skipped_tests.py LOG|BUILD_FOLDER...
A log is what ctest keeps of a run (Testing/Temporary/LastTest.log); of a build folder it is that of the last one.
Python tests say `skipped: NAME: REASON` themselves (tests/end_to_end/run.py).
"""
import collections
import os
import pathlib
import re
import subprocess
import sys

GTEST = re.compile(r"^[^\n]*: Skipped\n(?P<why>.*?)\n+\[  SKIPPED \] (?P<name>[^\s,]+)", re.MULTILINE | re.DOTALL)
FILTERED = re.compile(r'^Command: "(?P<program>[^"]+)"(?:(?!^Command: ).)*?^Note: Google Test filter = (?P<filter>[^\n]*)$', re.MULTILINE | re.DOTALL)


def skipped(log):
    """[(test, reason)] in the text that ctest kept of a run."""
    found = [(m["name"], " ".join(m["why"].split())) for m in GTEST.finditer(log)]
    return found + re.findall(r"^skipped: (.+?): (.*)$", log, re.MULTILINE)


def tests_of(program, chosen):
    """Names of the tests of a GoogleTest program that this filter chooses."""
    environment = {**os.environ, "GTEST_FILTER": chosen, "ASAN_OPTIONS": "intercept_tls_get_addr=0:detect_leaks=0"}
    done = subprocess.run([program, "--gtest_list_tests"], env=environment, capture_output=True, text=True, check=True)
    names, suite = [], ""
    for line in done.stdout.splitlines():
        if line.startswith("  "):
            names.append(suite + line.split("#")[0].strip())
        elif line.endswith(".") or ".  #" in line:
            suite = line.split("#")[0].strip()
    return names


def left_out(log):
    """[(test, reason)] of the tests that did not run because of a filter."""
    found = []
    for m in FILTERED.finditer(log):
        kept = set(tests_of(m["program"], m["filter"]))
        found += [(name, f"left out by the filter of {pathlib.Path(m['program']).name}")
                  for name in tests_of(m["program"], "*") if name not in kept]
    return found


def main():
    total = 0
    for place in map(pathlib.Path, sys.argv[1:]):
        log = place / "Testing/Temporary/LastTest.log" if place.is_dir() else place
        if not log.exists():
            continue
        text = log.read_text(errors="replace")
        by_reason = collections.defaultdict(list)
        for name, why in skipped(text) + left_out(text):
            by_reason[why].append(name)
        for why, names in by_reason.items():
            print(f"skipped in {place}: {len(names)} ({names[0]}{', ...' if len(names) > 1 else ''}): {why}")
            total += len(names)
    print(f"{total} tests skipped." if total else "No test was skipped.")


if __name__ == "__main__":
    main()
