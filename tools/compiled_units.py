#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Prints the files that the compiler is given for a list of sources and headers, one a line.

A source is compiled alone, or in a file that includes eight of them; that file is printed once. A header
stands for the source of the same name, or, where there is none, for all sources that include it.

usage: compiled_units.py BUILD_FOLDER LIST     LIST: a file with paths from the repository's root
"""
import json
import os
import re
import sys

INCLUDED_SOURCE = re.compile(r'^#include "(.*\.cpp)"$', re.MULTILINE)
INCLUDED_HEADER = re.compile(r'^#include "([^"]+\.h)"$', re.MULTILINE)


def text_of(path):
    with open(path) as file:
        return file.read()


def sources_of(unit):
    return INCLUDED_SOURCE.findall(text_of(unit)) if "/Unity/" in unit else [unit]


def includes(source, headers):
    """Paths in #include lines begin at a folder of the program, so their ends decide."""
    return any(header.endswith("/" + named) for named in INCLUDED_HEADER.findall(text_of(source)) for header in headers)


def main():
    build, list_path = sys.argv[1:]
    units = sorted({command["file"] for command in json.loads(text_of(os.path.join(build, "compile_commands.json")))})
    changed = {os.path.abspath(path) for path in text_of(list_path).split()}
    sources = {path for path in changed if path.endswith(".cpp")}
    headers = set()
    for path in changed - sources:
        own = path.removesuffix(".h") + ".cpp"
        if os.path.exists(own):
            sources.add(own)
        else:
            headers.add(path)
    for unit in units:
        if any(source in sources or headers and includes(source, headers) for source in sources_of(unit)):
            print(unit)


if __name__ == "__main__":
    main()
