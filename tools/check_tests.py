#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Refuses what makes a test fail by chance: the real clock, sleeps, deadlines, rates and ages as assertions, and files that
another run of the same test shares.

A test fails when something is wrong, on any machine, however busy. docs/testing.md says what to write instead. In
tests/real_time.txt stand the files that may do so all the same, each with how often; the list may only shrink, so an
entry that is larger than its file needs is refused, too. Files *_timing.py measure; they may do all this.
"""
import ast
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
LIST = "tests/real_time.txt"
# A wait for a condition alone, as `held.wait_until([&] {...})`, is no deadline.
IN_CPP = re.compile(r"\b(?:steady_now|steady_clock::now|this_thread::sleep_for|this_thread::sleep_until|usleep|nanosleep)\(|"
                    r"\.wait_(?:for|until)\((?!\[|$)|::sleep\(")
SHARED_FOLDER = re.compile(r"\btemp_directory_path\(")
CLOCK = {"sleep", "monotonic", "perf_counter"}
MEASURED = re.compile(r"^(fps\w*|frames_per_second|mbit_per_s|\w*age_ms|age_now_ms|p50|p99)$")
PATIENT = {"wait_for", "wait_until", "wait_for_error", "wait_for_end", "read_json", "end"}


def in_cpp(text):
    """[(line, what)] that depends on the machine's speed."""
    found = []
    for number, line in enumerate(text.splitlines(), 1):
        code = line.split("//")[0]
        found += [(number, f"{m[0].strip('.(')} needs the real clock") for m in IN_CPP.finditer(code)]
        found += [(number, "temp_directory_path() is shared by all runs: testing::TemporaryFolder is of one test") for _ in SHARED_FOLDER.finditer(code)]
    return found


def is_number(node):
    if isinstance(node, ast.UnaryOp):
        return is_number(node.operand)
    return isinstance(node, ast.Constant) and isinstance(node.value, (int, float)) and not isinstance(node.value, bool)


def measured(node):
    """The rate or age that an expression reads."""
    for part in ast.walk(node):
        if isinstance(part, ast.Subscript) and isinstance(part.slice, ast.Constant) and isinstance(part.slice.value, str) \
                and MEASURED.match(part.slice.value):
            return part.slice.value
    return None


def in_python(text):
    """The same in a Python test: sleeps, clocks, deadlines, and rates and ages that are compared with an amount."""
    found = []
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.Compare) and (name := measured(node)):
            amounts = [side.value for side in (node.left, *node.comparators) if is_number(side) and isinstance(side, ast.Constant)]
            if any(amount != 0 for amount in amounts):
                found.append((node.lineno, f"'{name}' is compared with an amount"))
        if not isinstance(node, ast.Call):
            continue
        name = node.func.attr if isinstance(node.func, ast.Attribute) else getattr(node.func, "id", "")
        if name in CLOCK and isinstance(node.func, ast.Attribute) and getattr(node.func.value, "id", "") == "time":
            found.append((node.lineno, f"time.{name} needs the real clock"))
        elif name.startswith("assert") and len(node.args) >= 2 and (key := measured(node)) \
                and any(is_number(one) and ast.literal_eval(one) != 0 for one in node.args):
            found.append((node.lineno, f"'{key}' is compared with an amount"))
        elif name in PATIENT and (any(is_number(one) for one in node.args) or any(k.arg in ("timeout", "seconds") for k in node.keywords)):
            found.append((node.lineno, f"{name}() is given seconds; it waits as long as something moves"))
    return sorted(found)


def listed(text):
    """{file: how often} of the list."""
    rows = [line.split("#")[0].split() for line in text.splitlines()]
    return {row[0]: int(row[1]) for row in rows if row}


def compare(found, allowed):
    """Sentences on files that do more, or less, than the list allows. found: {file: [(line, what)]}"""
    problems = []
    for file, places in sorted(found.items()):
        if len(places) > allowed.get(file, 0):
            problems += [f"{file}:{line}: {what} (docs/testing.md)" for line, what in places]
        if len(places) > allowed.get(file, 0) > 0:
            problems.append(f"{file}: {len(places)} such places, {allowed[file]} in {LIST}")
    for file, most in sorted(allowed.items()):
        if len(found.get(file, [])) < most:
            problems.append(f"{LIST}: {file} needs {len(found.get(file, []))}, not {most}: lower it" +
                            ("" if found.get(file) else " by leaving its line out"))
    return problems


def problems(root=ROOT):
    files = subprocess.run(["git", "ls-files", "--cached", "--others", "--exclude-standard", "*_test.cpp", "tests/*_test.py"],
                           cwd=root, check=True, capture_output=True, text=True).stdout.split()
    found = {}
    for file in files:
        if (root / file).is_file():
            text = (root / file).read_text()
            if places := (in_cpp if file.endswith(".cpp") else in_python)(text):
                found[file] = places
    return compare(found, listed((root / LIST).read_text()) if (root / LIST).exists() else {})


if __name__ == "__main__":
    for problem in (faults := problems()):
        print(problem)
    sys.exit(1 if faults else 0)
