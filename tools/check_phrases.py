#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Checks that everything which the page, the headset or the window's scene says is in a table, in German, too.

The tables: src/phrases/*.inc (by key), src/wire/text.cpp (by code of the wire), apps/web/page/texts.js
(the page itself). A missing German text, other arguments in one language, a key that nothing uses, and a
sentence in the sources that is in no table are problems.
"""
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
STRING = r'"((?:[^"\\]|\\.)*)"'

# Folders and files whose sentences a person reads on the page, in the headset or over the window's picture.
SPEAKING = ["src/client", "src/room", "src/viewer", "src/or_screen", "src/net/client.cpp", "src/net/client_web.cpp",
            "src/net/connection.cpp", "src/receive/receiver.cpp", "apps/web"]
# Texts for the command line, for files and for other programs.
ENGLISH = {
    "src/client/direct_reception_native.cpp", "src/client/direct_sender_native.cpp", "src/client/recent_links.cpp",
    "src/client/session_recording.cpp", "src/client/settings.cpp", "src/viewer/head_text.cpp", "src/viewer/nothing_seen.cpp",
    "src/viewer/offscreen_view_native.cpp", "src/viewer/renderer_text.cpp", "src/viewer/view_choice.cpp",
}
# Names of keys and of things.
NO_TEXTS = {"table lamps", "Digit", "Numpad"}
# Lines that say nothing to a person there.
SILENT = re.compile(r"#\s*include|log::|fprintf|static_assert|EM_JS|EM_ASM|emscripten_")


def joined(text):
    return "".join(re.findall(STRING, text))


def arguments(text):
    return sorted(set(re.findall(r"\{\w+\}", text)))


def without_comments(text):
    return re.sub(r"^\s*//.*$|\s//\s.*$", "", text, flags=re.M)


def sources(*tops, endings=(".cpp", ".h")):
    for top in tops:
        place = ROOT / top
        for file in [place] if place.is_file() else sorted(place.rglob("*")):
            if file.suffix in endings and not file.stem.endswith(("_test", "_fuzz", "_bench")):
                yield file


def compare(what, english, german, problems):
    if not english.strip() or not german.strip():
        problems.append(f"{what}: a language has no text")
    elif arguments(english) != arguments(german):
        problems.append(f"{what}: English and German have other arguments")


def check_phrases(problems):
    keys = {}
    row = re.compile(rf"PHRASE\((\w+),\s*((?:{STRING}\s*)+),\s*((?:{STRING}\s*)+)\)")
    for file in sorted((ROOT / "src/phrases").glob("*.inc")):
        text = file.read_text()
        if file.name == "touch.inc":
            text = text.replace("BY_TOUCH(", "PHRASE(")
        rows = row.findall(text)
        if len(rows) != len(re.findall(r"^PHRASE\(", text, re.M)):
            problems.append(f"{file.name}: a row is not understood")
        for key, english, _, german, _ in rows:
            if file.name != "touch.inc":  # the phrases of the other tables in other words
                keys[key] = file.name
            compare(f"{file.name}: {key}", joined(english), joined(german), problems)
    used = set()
    for file in sources("src", "apps"):
        if file.parent.name != "phrases":
            used |= set(re.findall(r"Phrase::(\w+)", file.read_text()))
    for key in keys.keys() - used:
        problems.append(f"{keys[key]}: nothing says {key}")
    return len(keys)


def check_codes(problems):
    header = (ROOT / "src/wire/text.h").read_text()
    codes = re.findall(r"^    (\w+) = \d+,", header, re.M)
    text = (ROOT / "src/wire/text.cpp").read_text()
    strings = rf"((?:{STRING}\s*)+)"
    pair = rf"\{{{strings},\s*{strings}\}}"
    rows = {}
    table = re.search(r"constexpr Row rows\[\] = \{(.*?)\n\};", text, re.S)[1]
    for row in table.split("{TextCode::")[1:]:
        rows[re.match(r"\w+", row)[0]] = re.findall(pair, row)
    used = set()
    for file in sources("src", "apps"):
        if file.parent.name != "wire" or file.stem != "text":
            used |= set(re.findall(r"TextCode::(\w+)", file.read_text()))
    for code in codes:
        if code == "none":
            continue
        if not rows.get(code):
            problems.append(f"text.cpp: {code} has no English and German")
        for english, _, german, _ in rows.get(code, []):
            compare(f"text.cpp: {code}", joined(english), joined(german), problems)
        if code not in used | {"as_written"}:
            problems.append(f"text.h: nothing says {code}")
    return len(codes)


def check_page(problems):
    page = ROOT / "apps/web/page"
    tables = (page / "texts.js").read_text().split("\n    de: {")
    if len(tables) != 2:
        problems.append("texts.js: there are not two tables")
        return 0
    english, german = (dict(re.findall(rf"\b(\w+): {STRING}", table)) for table in tables)
    for key in english.keys() ^ german.keys():
        problems.append(f"texts.js: {key} is in one language only")
    for key in english.keys() & german.keys():
        compare(f"texts.js: {key}", english[key], german[key], problems)
    counts = [len(re.findall(r"^            \[", table, re.M)) for table in tables]
    if counts[0] != counts[1]:
        problems.append("texts.js: the keys of one language have other rows")
    others = "".join(file.read_text() for file in sources("apps/web/page", endings=(".js", ".html"))
                     if file.name != "texts.js")
    states = set(re.findall(r"\b(\w+): \"", "".join(re.findall(r"(?:states|roles): \{([^}]*)\}", tables[0]))))
    for key in sorted(english.keys() - states):
        # text() takes that one in place of the other where a person has no keyboard.
        if key.endswith("_touch") and key.removesuffix("_touch") in english:
            continue
        if not re.search(rf"[\"']{key}[\"']|texts\.{key}\b", others):
            problems.append(f"texts.js: nothing shows {key}")
    for file in sources("apps/web/page", endings=(".js",)):
        for line in re.findall(r"^.*textContent = .*[\"`][^\"`$\n]*[a-z] [a-z].*$", file.read_text(), re.M):
            problems.append(f"{file.name}: a sentence is in no table: {line.strip()}")
    return len(english)


def check_literals(problems):
    """Two words, or one that begins like a label."""
    sentence = re.compile(r"[A-Za-z]{2,},? [a-z]{2,}|^[A-Z][a-z]{2,}$")
    for file in sources(*SPEAKING):
        name = str(file.relative_to(ROOT))
        if name in ENGLISH:
            continue
        text = without_comments(file.read_text())
        # Calls that log or print may go over several lines.
        text = re.sub(r"(?:log::\w+|std::fprintf|EM_JS|EM_ASM)\(.*?\);\n", "\n", text, flags=re.S)
        for line in text.splitlines():
            if SILENT.search(line):
                continue
            for literal in re.findall(STRING, line):
                if sentence.search(literal) and literal not in NO_TEXTS:
                    problems.append(f"{name}: a sentence is in no table: \"{literal}\"")


def main():
    problems = []
    phrases, codes, page = check_phrases(problems), check_codes(problems), check_page(problems)
    check_literals(problems)
    for problem in problems:
        print(problem)
    print(f"{phrases} phrases, {codes} codes, {page} texts of the page, {len(problems)} problems")
    return 1 if problems else 0


sys.exit(main())
