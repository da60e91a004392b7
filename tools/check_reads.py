#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Checks that the program really says what docs/reads.md quotes.

A quotation of at least four words is a sentence of the program, or a part of one. Numbers, names in quotation marks and
"..." stand for what differs from file to file; what is between them must be in the strings of the sources, in one piece or
in a few.
"""
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
STRING = r'"((?:[^"\\\n]|\\.)*)"'
LEAST_WORDS = 4
PIECES = 3
# Quotations of other programs.
OTHERS = {"Implicit VR Big Endian"}


def plain(text):
    return " ".join(text.replace("\\", "").split())


def said(root=ROOT):
    """All strings of the sources, those that stand behind one another as one."""
    strings = []
    for file in sorted((root / "src").rglob("*")):
        if file.suffix in (".cpp", ".h", ".inc") and not file.stem.endswith(("_test", "_fuzz", "_bench")):
            code = re.sub(r"^\s*//.*$", "", file.read_text(), flags=re.M)
            strings += re.findall(STRING, re.sub(r'"\s*\n\s*"', "", code))
    return plain("\n".join(strings))


def quotations(page):
    return [one.replace('\\"', "'") for one in re.findall(STRING, page)]


def is_said(words, strings, pieces=PIECES):
    """Whether the words are in the strings, in at most PIECES of at least two words each."""
    def are_there(part):
        return " ".join(part).strip(" ,;:.()") in strings
    return are_there(words) or (pieces > 1 and any(
        are_there(words[:n]) and is_said(words[n:], strings, pieces - 1) for n in range(2, len(words) - 1)))


def unsaid(sentence, strings):
    """The parts of a sentence that the program does not say."""
    parts = re.split(r"'[^']*'|\S*\d\S*|\(\.\w+\)|\.\.\.", plain(sentence))
    return [part.strip() for part in parts if len(part.split()) >= LEAST_WORDS and not is_said(part.split(), strings)]


def main():
    strings = said()
    sentences = [one for one in quotations((ROOT / "docs/reads.md").read_text())
                 if len(one.split()) >= LEAST_WORDS and one not in OTHERS]
    problems = [f'docs/reads.md: the program does not say "{part}", of "{one}"'
                for one in sentences for part in unsaid(one, strings)]
    for problem in problems:
        print(problem)
    print(f"{len(sentences)} sentences, {len(problems)} that the program does not say")
    return 1 if problems or not sentences else 0


if __name__ == "__main__":
    sys.exit(main())
