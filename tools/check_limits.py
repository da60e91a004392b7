#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Compares docs/limits.md with the constants in the sources.

Each row of its tables whose second column names a constant, `path:name` or `path:name[n]` for the n-th number of a list,
must give in its first column the value that the source has. With --all, each constant of the folders below whose name says that it is a bound must have a row.
"""
import ast
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
PAGE = "docs/limits.md"

# Folders whose bounds protect against other programs' input.
FOLDERS = ("src/wire", "src/net", "src/session", "src/receive", "src/record", "src/sandbox", "src/files", "src/host", "src/client", "src/export", "apps/cli", "apps/theatron")
# Folders that measure and draw, too: most, longest and least are bounds of their own work there.
DATA_FOLDERS = ("src/capture", "src/cases", "src/codec", "src/face", "src/filter", "src/geometry", "src/image", "src/medical",
                "src/publish", "src/sound", "src/study", "src/video", "src/viewer", "src/voice")
DATA_BOUND = re.compile(r"^max_")
BOUND = re.compile(r"^(max|most|longest|least)_|_(limit|deadline|patience|timeout)$|^give_up")
NO_BOUNDS = {("src/record/segment_files.cpp", "least_digits"), ("src/record/segment_files.cpp", "most_digits"),
             # These follow from a format or from another bound.
             ("src/codec/library_codec.cpp", "max_parameter"), ("src/codec/strata_coder-inl.h", "max_chunks"),
             ("src/codec/strata_side.h", "max_bits"), ("src/codec/strata_tables.h", "max_level"),
             ("src/codec/strata_values.h", "max_values"), ("src/video/jpeg_encoder_kernel_native.cpp", "max_block"),
             ("src/video/jpeg_scan.h", "max_unit_blocks"), ("src/video/jpeg_scan.h", "max_group_quads"),
             ("src/video/raw_codec.h", "max_kept"), ("src/voice/stretch.h", "max_period")}
TESTS = re.compile(r"_(test|fuzz|bench)\.|/bench_|/test_")

UNITS = {"": 1, "B": 1, "KiB": 1 << 10, "MiB": 1 << 20, "GiB": 1 << 30,
         "us": 1e-6, "ms": 1e-3, "s": 1, "min": 60, "h": 3600}
DEFINITION = re.compile(
    r"\bconstexpr\s+[\w:<> ]+?\s(?=\w+\s*=)((?:\w+\s*=\s*[^;{}]+?)(?:,\s*\w+\s*=\s*[^;{},]+?)*);", re.DOTALL)


LIST = re.compile(r"\bconstexpr\s+[\w:<>, ]+?\s(\w+)\s*(?:=\s*)?(\{[^;]*\});", re.DOTALL)


class Problem(Exception):
    pass


def constants_of(text):
    """name -> expression of every constant in a source."""
    text = re.sub(r"//[^\n]*", "", text)
    found = {}
    for definition in DEFINITION.finditer(text):
        depth, part, parts = 0, "", []
        for c in definition.group(1):
            depth += (c in "(<") - (c in ")>") if c in "()" else 0
            if c == "," and depth == 0:
                parts.append(part)
                part = ""
            else:
                part += c
        for part in [*parts, part]:
            name, _, expression = part.partition("=")
            if re.fullmatch(r"\s*\w+\s*", name) and expression:
                found[name.strip()] = expression.strip()
    for name, content in LIST.findall(text):
        numbers = [number.strip() for number in re.sub(r"[{}]", "", content).split(",")]
        found.update({f"{name}[{n}]": number for n, number in enumerate(numbers)})
    return found


def to_python(expression):
    text = re.sub(r"(?<=\d)'(?=\d)", "", expression)
    text = re.sub(r"std::chrono::(hours|minutes|seconds|milliseconds|microseconds)\s*\(",
                  lambda m: str({"hours": 3600, "minutes": 60, "seconds": 1, "milliseconds": 1e-3,
                                 "microseconds": 1e-6}[m[1]]) + " * (", text)
    text = re.sub(r"\bDuration\s*\(", "1e-6 * (", text)
    text = re.sub(r"\b(std::)?(size_t|u?int\d+_t|u?intmax_t|streamsize|int|unsigned|double|float)\s*([({])",
                  lambda m: "(" if m[3] == "(" else "(", text).replace("}", ")")
    text = re.sub(r"\b(\d+)(ms|us|min|s|h)\b", lambda m: f"({m[1]} * {UNITS[m[2]]})", text)
    text = re.sub(r"\b(0x[0-9a-fA-F]+|\d+)[uUlLzZ]+\b", r"\1", text)
    return re.sub(r"\b(?:\w+::)+(\w+)", r"\1", text)


def value_of(expression, known, depth=0):
    """The number that a constant expression has; times are in seconds. `known`: expressions by name."""
    if depth > 8:
        raise Problem("refers to itself")

    def number(node):
        if isinstance(node, ast.Expression):
            return number(node.body)
        if isinstance(node, ast.Constant) and isinstance(node.value, (int, float)):
            return node.value
        if isinstance(node, ast.Name) and node.id in known:
            return value_of(known[node.id], known, depth + 1)
        if isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.USub):
            return -number(node.operand)
        if isinstance(node, ast.BinOp):
            a, b = number(node.left), number(node.right)
            operations = {ast.Add: lambda: a + b, ast.Sub: lambda: a - b, ast.Mult: lambda: a * b,
                          ast.Div: lambda: a / b, ast.LShift: lambda: int(a) << int(b)}
            if type(node.op) in operations:
                return operations[type(node.op)]()
        raise Problem(f"the expression '{expression}' is not understood")

    try:
        return number(ast.parse(" ".join(to_python(expression).split()), mode="eval"))
    except SyntaxError as e:
        raise Problem(f"the expression '{expression}' is not understood") from e


def value_in_page(text):
    """'16 KiB', '1 048 576', '2048 x 2048', '0.2 s'."""
    match = re.fullmatch(r"([\d., ]+?(?: x [\d ]+)?)\s*([a-zA-Z]*)", text.strip())
    if not match or match[2] not in UNITS:
        return None
    value = 1
    for factor in match[1].replace(",", "").split(" x "):
        value *= float(factor.replace(" ", ""))
    return value * UNITS[match[2]]


def rows_of(page):
    """(line, value, path, name) of each row that names a constant."""
    for line, text in enumerate(page.splitlines(), 1):
        cells = [cell.strip() for cell in text.strip().strip("|").split("|")]
        named = re.fullmatch(r"`([\w/.\-]+):(\w+(?:\[\d+\])?)`", cells[1]) if text.startswith("|") and len(cells) > 2 else None
        if named:
            yield line, cells[0], named[1], named[2]


def all_constants():
    """Expressions by name, for those that refer to others."""
    known = {}
    for path in [*ROOT.glob("src/**/*.h"), *ROOT.glob("apps/**/*.h")]:
        known.update(constants_of(path.read_text()))
    return known


def check_row(value, path, name, known):
    file = ROOT / path
    if not file.exists():
        raise Problem(f"there is no file {path}")
    here = constants_of(file.read_text())
    if name not in here:
        raise Problem(f"{path} has no constant {name}")
    told, real = value_in_page(value), value_of(here[name], known | here)
    if told is None:
        raise Problem(f"'{value}' is no number with a unit")
    if abs(told - real) > 1e-9 * max(abs(real), 1):
        raise Problem(f"says {value}, but {path} has {name} = {here[name]}")


def missing_rows(rows):
    named = {(path, name) for _, _, path, name in rows}
    for folder in FOLDERS + DATA_FOLDERS:
        bound = DATA_BOUND if folder in DATA_FOLDERS else BOUND
        for path in sorted([*(ROOT / folder).rglob("*.h"), *(ROOT / folder).rglob("*.cpp")]):
            relative = str(path.relative_to(ROOT))
            if TESTS.search(relative):
                continue
            for name in constants_of(path.read_text()):
                if bound.search(name) and (relative, name) not in named | NO_BOUNDS:
                    yield f"{relative} has the bound {name}, which {PAGE} does not name"


def main():
    page = (ROOT / PAGE).read_text()
    rows, problems, known = list(rows_of(page)), [], all_constants()
    for line, value, path, name in rows:
        try:
            check_row(value, path, name, known)
        except Problem as problem:
            problems.append(f"{PAGE}:{line}: {problem}")
    if "--all" in sys.argv:
        problems += missing_rows(rows)
    for problem in problems:
        print(problem)
    print(f"{len(rows)} limits, {len(problems)} problems")
    return 1 if problems or not rows else 0


if __name__ == "__main__":
    sys.exit(main())
