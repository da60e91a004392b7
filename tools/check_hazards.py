#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Checks that each test named in docs/hazards.md exists, and that each hazard names one."""
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
GTEST = re.compile(r"^TEST(?:_F|_P)?\(\s*(\w+),\s*(\w+)\)", re.MULTILINE)
NAMED = re.compile(r"`(?:(?P<file>[\w/]+_test\.py)::(?P<test>\w+)|(?P<gtest>[A-Z]\w+\.[A-Z]\w+))`")


def problems(page, gtests, python_text):
    """Sentences on what `page` names and `gtests` ("Suite.Name") and `python_text` (file -> its text or None) lack."""
    found = []
    for line in page.splitlines():
        cells = line.split(" | ")
        if not line.startswith("| **"):
            continue
        names = list(NAMED.finditer(cells[-1]))
        if not names:
            found.append(f"{cells[0].strip('| ')[:40]}: names no test")
        for name in names:
            if name["gtest"]:
                exists = name["gtest"] in gtests
            else:
                exists = f"def {name['test']}(" in (python_text(name["file"]) or "")
            if not exists:
                found.append(f"{name[0].strip('`')}: there is no such test")
    return found


def main():
    gtests = {f"{suite}.{name}" for file in (ROOT / "src").rglob("*_test.cpp")
              for suite, name in GTEST.findall(file.read_text())}

    def python_text(name):
        file = ROOT / "tests" / name
        return file.read_text() if file.is_file() else None

    page = (ROOT / "docs/hazards.md").read_text()
    found = problems(page, gtests, python_text)
    for one in found:
        print("docs/hazards.md:", one)
    print(f"{len(NAMED.findall(page))} tests of hazards, {len(found)} problems")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
