#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Checks every tracked source: clang-format, and the licence line at its top."""
import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
LICENCE = "SPDX-License-Identifier: Apache-2.0"
LICENSED = {".h", ".cpp", ".cu", ".py", ".sh", ".cmake", ".fbs", ".glsl", ".vert", ".frag", ".js", ".mjs"}
FORMATTED = {".h", ".cpp", ".cu"}


def main():
    listed = subprocess.run(["git", "ls-files", "--cached", "--others", "--exclude-standard"], cwd=ROOT,
                            check=True, capture_output=True, text=True).stdout
    files = [ROOT / line for line in listed.splitlines() if (ROOT / line).is_file()]
    problems = []
    for file in files:
        if file.suffix in LICENSED or file.name in {"CMakeLists.txt", "Makefile"}:
            head = file.read_text(errors="replace")[:300]
            if LICENCE not in head:
                problems.append(f"{file.relative_to(ROOT)}: the licence line is missing")
    formatted = [str(f) for f in files if f.suffix in FORMATTED]
    for start in range(0, len(formatted), 50):
        result = subprocess.run(["clang-format", "--dry-run", "-Werror", *formatted[start:start + 50]],
                                capture_output=True, text=True)
        problems += [line for line in result.stderr.splitlines() if "error:" in line]
    for problem in problems[:50]:
        print(problem)
    print(f"{len(files)} files, {len(problems)} problems" + ("; run make format" if problems else ""))
    return 1 if problems else 0


sys.exit(main())
