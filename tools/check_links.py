#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Checks that links of the pages lead to files and headings that exist."""
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
LINK = re.compile(r"\]\(([^)\s]+)\)")


def anchors(text):
    """The anchors of a page's headings, as code hosts make them."""
    found = set()
    for heading in re.findall(r"^#+ +(.*)$", text, re.MULTILINE):
        plain = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading).replace("`", "")
        found.add(re.sub(r"[^\w\- ]", "", plain.lower()).strip().replace(" ", "-"))
    return found


def problems(name, text, read):
    """Sentences on the links of page `name`; `read` gives the text of a file, "" of a folder or picture, None of none."""
    found = []
    # Lines of docs/changes are read in CHANGELOG.md.
    folder = pathlib.PurePosixPath(name).parent
    if folder == pathlib.PurePosixPath("docs/changes") and not name.endswith("README.md"):
        folder = pathlib.PurePosixPath(".")
    for target in LINK.findall(re.sub(r"```.*?```", "", text, flags=re.DOTALL)):
        if re.match(r"[a-z]+:", target):
            continue
        path, _, anchor = target.partition("#")
        other = read(folder / path) if path else text
        if other is None:
            found.append(f"{name}: {target}: there is no such file")
        elif anchor and anchor not in anchors(other):
            found.append(f"{name}: {target}: there is no such heading")
    return found


def main():
    listed = subprocess.run(["git", "ls-files", "--cached", "--others", "--exclude-standard", "*.md"], cwd=ROOT,
                            check=True, capture_output=True, text=True).stdout.split()

    def read(path):
        file = ROOT / path
        if file.suffix == ".md" and file.is_file():
            return file.read_text()
        return "" if file.exists() else None

    found = [one for name in listed if (ROOT / name).is_file()
             for one in problems(name, (ROOT / name).read_text(), read)]
    for one in found:
        print(one)
    print(f"{len(listed)} pages, {len(found)} links that lead nowhere")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
