#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Checks that modules and programs include only what their CMakeLists.txt declares.

Reads theatron_module(NAME ... DEPENDS a b c ...) of every folder in src/, and
theatron_program_library of every folder in apps/ and bench/, and compares it with
the #include lines. Dependencies must not form a circle, and no module depends on a program.
"""
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
KEYWORDS = {"FOLDERS", "WEB", "PURE", "NATIVE", "DEPENDS", "NATIVE_DEPENDS", "LINK"}


PROGRAMS = ("apps", "bench")


def declared():
    """(name -> (dependencies, those of the web build, web), folder -> name) of modules, then of programs."""
    modules, folders = {}, {}
    places = [*sorted((ROOT / "src").glob("*/CMakeLists.txt")),
              *(file for top in PROGRAMS for file in sorted((ROOT / top).glob("*/CMakeLists.txt")))]
    for file in places:
        match = re.search(r"theatron_(?:module|program_library)\(([^)]*)\)", file.read_text())
        if not match:
            continue
        words = match.group(1).split()
        name, depends, web = words[0], set(), set()
        folders[file.parent.relative_to(ROOT)] = name
        for keyword in ("DEPENDS", "NATIVE_DEPENDS"):
            for word in words[words.index(keyword) + 1:] if keyword in words else []:
                if word in KEYWORDS:
                    break
                depends.add(word)
                if keyword == "DEPENDS" and "WEB" in words:
                    web.add(word)
        modules[name] = (depends, web, "WEB" in words)
    return modules, folders


def closure(name, modules, path=()):
    """All modules that `name` may include; raises on a circle."""
    if name in path:
        raise ValueError(" -> ".join((*path, name)))
    result = {name}
    for other in modules[name][0]:
        result |= closure(other, modules, (*path, name))
    return result


def main():
    modules, folders = declared()
    programs = {name for folder, name in folders.items() if folder.parts[0] in PROGRAMS}
    problems = []
    for name, (depends, web, _) in modules.items():
        if name not in programs and depends & programs:
            problems.append(f"src/{name}/CMakeLists.txt: a module depends on a program")
        for other in sorted(depends - modules.keys()):
            problems.append(f"src/{name}/CMakeLists.txt: there is no module {other}")
        for other in sorted(web & modules.keys()):
            if not modules[other][2]:
                problems.append(f"src/{name}/CMakeLists.txt: a web module depends on {other}, which is none")
    if not problems:
        for name in modules:
            try:
                closure(name, modules)
            except ValueError as circle:
                problems.append(f"dependencies form a circle: {circle}")
    sources = [file for top in ("src", *PROGRAMS) for file in sorted((ROOT / top).glob("*/**/*"))]
    for file in sources:
        if file.suffix not in {".h", ".cpp", ".cu"} or problems and "circle" in problems[-1]:
            continue
        module = folders.get(pathlib.Path(*file.relative_to(ROOT).parts[:2]))
        if not module:
            problems.append(f"{file.relative_to(ROOT)}: its folder is no module and no program")
            continue
        # Tests may use code beside the product: other modules' readers of files.
        allowed = closure(module, modules)
        if file.stem.endswith(("_test", "_bench")):
            continue
        for number, line in enumerate(file.read_text().splitlines(), 1):
            match = re.match(r'\s*#\s*include\s+"([a-z0-9_]+)/', line)
            if match and match.group(1) in modules and match.group(1) not in allowed:
                problems.append(
                    f"{file.relative_to(ROOT)}:{number}: {module} may not include {match.group(1)}")
    for problem in problems:
        print(problem)
    print(f"{len(modules) - len(programs)} modules, {len(programs)} programs, {len(problems)} wrong dependencies")
    return 1 if problems else 0


sys.exit(main())
