#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Gathers the lines of docs/changes for a release: `changelog.py` prints them, `changelog.py 0.2.0 2027-01-31` moves
them to the top of CHANGELOG.md."""
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
GROUPS = ("added", "changed", "fixed", "removed")
NAME = re.compile(r"^[\w-]+\.(" + "|".join(GROUPS) + r")\.md$")


def gathered(files):
    """The lines of `files` (name -> text) by group; raises ValueError with a sentence for a file of another form."""
    lines = {group: [] for group in GROUPS}
    for name, text in sorted(files.items()):
        if not (form := NAME.match(name)):
            raise ValueError(f"docs/changes/{name}: a name is TOPIC.GROUP.md, GROUP one of {', '.join(GROUPS)}")
        for line in filter(None, (line.strip() for line in text.splitlines())):
            if line.startswith("<!--"):
                continue
            lines[form[1]].append(line.removeprefix("- ").strip())
    return lines


def section(lines, title):
    text = f"## {title}\n"
    for group in GROUPS:
        if lines[group]:
            text += f"\n### {group.capitalize()}\n\n" + "".join(f"- {line}\n" for line in lines[group])
    return text


def main():
    folder, log = ROOT / "docs/changes", ROOT / "CHANGELOG.md"
    files = {file.name: file for file in folder.glob("*.md") if file.name != "README.md"}
    try:
        lines = gathered({name: file.read_text() for name, file in files.items()})
    except ValueError as problem:
        sys.exit(f"changelog: {problem}")
    if len(sys.argv) == 1:
        print(section(lines, "Next"), end="")
    elif len(sys.argv) == 3:
        text = log.read_text()
        before, mark, after = text.partition("\n## ")
        log.write_text(before + "\n" + section(lines, f"{sys.argv[1]} ({sys.argv[2]})") + mark + after)
        for file in files.values():
            file.unlink()
    else:
        sys.exit(__doc__)


if __name__ == "__main__":
    main()
