#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Names every test that ctest had to run a second time, and fails when too many needed it.

A test that passes only at its second try found a fault in the program or has one itself. Its output when it failed
is appended to a file, so that it can be found out which.
    tools/repeated_tests.py build/release/Testing/Temporary/LastTest.log --keep build/repeated_tests.txt --most 2
"""
import argparse
import datetime
import pathlib
import re
import subprocess


def attempts(log):
    """{test: [(passed, output)]} of the text that ctest keeps of its last run."""
    found = {}
    for part in re.split(r"^(?=\d+/\d+ Testing: )", log, flags=re.MULTILINE)[1:]:
        name = re.match(r"\d+/\d+ Testing: (.*)", part)[1]
        output = re.search(r"^Output:\n-+\n(.*)^<end of output>$", part, re.MULTILINE | re.DOTALL)
        found.setdefault(name, []).append(("\nTest Passed.\n" in part, output[1] if output else part))
    return found


def repeated(log):
    """[(test, whether it passed at last, what it said when it failed)]"""
    return [(name, tries[-1][0], "\n".join(text for passed, text in tries if not passed))
            for name, tries in attempts(log).items() if len(tries) > 1]


def last_line(text):
    """The line that says most: that of the last exception of a Python test, else the last one."""
    lines = [line for line in text.splitlines() if line.strip()]
    said = [line for line in lines if re.match(r"[\w.]*(Error|Exception|WaitedInVain)\b", line)]
    return (said or lines or ["nothing"])[-1].strip()[:200]


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("log", type=pathlib.Path)
    parser.add_argument("--keep", type=pathlib.Path, help="file to which the failed tries are appended")
    parser.add_argument("--most", type=int, default=2, help="repeats that are no failure")
    options = parser.parse_args()
    found = repeated(options.log.read_text(errors="replace"))
    for name, passed, text in found:
        print(f"repeated: {name}, which {'passed then' if passed else 'failed again'}: {last_line(text)}")
    if found and options.keep:
        commit = subprocess.run(["git", "describe", "--always", "--dirty"], capture_output=True, text=True).stdout.strip()
        when = datetime.datetime.now(datetime.timezone.utc).isoformat(timespec="seconds")
        with options.keep.open("a") as file:
            for name, passed, text in found:
                file.write(f"== {when} {commit} {name} {'passed then' if passed else 'failed again'}\n{text}\n")
        print(f"{len(found)} of the tests that run processes needed a second try: {options.keep} has what they said.")
    if len(found) > options.most:
        print(f"More than {options.most} did: that is no chance.")
        return 1
    if not found:
        print("No test needed a second try.")
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
