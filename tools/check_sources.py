#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Checks every tracked source: clang-format, the licence line at its top, comments whose subject is named, words that stand
for others, and that no test depends on the speed of the machine (check_tests.py)."""
import pathlib
import re
import subprocess
import sys

import check_tests

ROOT = pathlib.Path(__file__).resolve().parent.parent
LICENCE = "SPDX-License-Identifier: Apache-2.0"
LICENSED = {".h", ".cpp", ".cu", ".py", ".sh", ".cmake", ".fbs", ".glsl", ".vert", ".frag", ".js", ".mjs"}
FORMATTED = {".h", ".cpp", ".cu"}
COMMENT_MARKS = {".h": "//", ".cpp": "//", ".cu": "//", ".js": "//", ".mjs": "//", ".vert": "//", ".frag": "//",
                 ".glsl": "//", ".py": "#", ".sh": "#", ".cmake": "#"}
# Programs that receive or decide for long write through base/log.h and base/output.h, whose threads wait for a reader.
DIRECT_OUTPUT = re.compile(r"std::(cout|cerr|clog|printf|puts|putchar)\b|\bstd::f(printf|puts|putc|write)\([^;]*std(err|out)")
# Commands whose output is their result, and programs that are no part of the product.
MAY_WRITE_DIRECTLY = re.compile(
    r"_(test|bench|fuzz)\.cpp$|^src/(testing|synthetic/pictures)/|^src/base/log_output_web\.cpp$|^apps/theatron/("
    r"background|bench|cameras|case|export|inspect|link|lobby|recover|register|session|status|study|target)_command\.cpp$|"
    r"^apps/theatron/(register_result|study_report|study_session|study_terminal|main)\.cpp$|^apps/cli/program_frame\.cpp$|^apps/(landmarks|web)/")
# A sentence that begins so does not name its subject.
UNNAMED_SUBJECT = re.compile(r"(?:^|[.:;!?] )(What|Whatever|Who|Whoever|Whose|Of|Which|Whether) [^?]*$")
# Words that stand for a count or a noun which the reader would have to look for; also across a line's end.
# "So much that ..." has its measure in the sentence.
UNCLEAR_WORDS = re.compile(r"\b(likewise|so[\s/#*]+many|so[\s/#*]+much(?![^.;:]*\bthat\b)|of[\s/#*]+before)\b", re.IGNORECASE)
WRITTEN = LICENSED | {".md", ".inc", ".html"}
NAMES_THE_WORDS = {"tools/check_sources.py", "tools/check_sources_test.py"}


def unclear_words(text):
    """(line number, words) of each word that stands for another."""
    return [(text.count("\n", 0, found.start()) + 1, " ".join(re.findall(r"\w+", found[1]))) for found in UNCLEAR_WORDS.finditer(text)]


def comment_blocks(file, text):
    """(line number, text) of each run of lines that are comments as a whole."""
    mark = COMMENT_MARKS.get(file.suffix)
    block, begin = [], 0
    for number, line in enumerate(text.splitlines() + [""] if mark else [], 1):
        words = line.strip()
        if words.startswith(mark) and LICENCE not in words:
            begin = begin if block else number
            block.append(words[len(mark):].strip())
        elif block:
            yield begin, " ".join(block)
            block = []


def main():
    listed = subprocess.run(["git", "ls-files", "--cached", "--others", "--exclude-standard"], cwd=ROOT,
                            check=True, capture_output=True, text=True).stdout
    files = [ROOT / line for line in listed.splitlines() if (ROOT / line).is_file()]
    problems = check_tests.problems()
    for file in files:
        if file.suffix in WRITTEN and str(file.relative_to(ROOT)) not in NAMES_THE_WORDS:
            problems += [f"{file.relative_to(ROOT)}:{number}: '{words}' leaves open what is meant; name it"
                         for number, words in unclear_words(file.read_text(errors="replace"))]
        if file.suffix in LICENSED or file.name in {"CMakeLists.txt", "Makefile"}:
            text = file.read_text(errors="replace")
            for number, comment in comment_blocks(file, text):
                if any(UNNAMED_SUBJECT.search(sentence) for sentence in re.split(r"(?<=[.!?]) ", comment)):
                    problems.append(f"{file.relative_to(ROOT)}:{number}: a sentence of this comment begins without its "
                                    "subject")
            name = str(file.relative_to(ROOT))
            if name.startswith(("src/", "apps/")) and file.suffix in FORMATTED and not MAY_WRITE_DIRECTLY.search(name):
                problems += [f"{name}:{number}: writes to standard output or error itself; base/output.h and base/log.h "
                             "do, without waiting" for number, line in enumerate(text.splitlines(), 1)
                             if DIRECT_OUTPUT.search(line)]
            if LICENCE not in text[:300]:
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


if __name__ == "__main__":
    sys.exit(main())
