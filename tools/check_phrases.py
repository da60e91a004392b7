#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Checks that everything which the page, the headset or the window's scene says is in a table, in every language.

The tables: src/phrases/*.inc (by key), src/wire/text.cpp (by code of the wire), apps/web/page/texts.js
(the page itself), operators_texts.js beside it (the operators' page). A text that a language lacks or has in English, other arguments in one language, French without
its spaces, a key that nothing uses, and a sentence in the sources that is in no table are problems. The languages and
their order: src/phrases/language.h.
"""
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
STRING = r'"((?:[^"\\]|\\.)*)"'
TEXT = r'(?:"(?:[^"\\]|\\.)*"\s*)+'  # of one language
LANGUAGES = re.findall(r'^    \{"(\w+)", "\w+", ', (ROOT / "src/phrases/language.h").read_text(), re.M)

# Folders and files whose sentences a person reads on the page, in the headset or over the window's picture.
SPEAKING = ["src/client", "src/room", "src/viewer", "src/or_screen", "src/net/client.cpp", "src/net/client_web.cpp",
            "src/net/connection.cpp", "src/receive/receiver.cpp", "apps/web"]
# Texts for the command line, for files and for other programs.
ENGLISH = {
    "src/client/relay_reception_native.cpp", "src/relay/relay_server_native.cpp", "src/client/recent_links.cpp",
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


def is_in_english(english, other):
    """Not said of words that two languages share, such as "Live", and of texts without words."""
    return english == other and re.search(r"[A-Za-z]{2,} [a-z]{2,}", re.sub(r"\{\w+\}", "", english))


def compare(what, texts, problems):
    """`texts`: one for each language."""
    if len(texts) != len(LANGUAGES) or not all(text.strip() for text in texts):
        problems.append(f"{what}: a language has no text")
        return
    english = texts[0]
    for language, text in zip(LANGUAGES[1:], texts[1:]):
        if arguments(english) != arguments(text):
            problems.append(f"{what}: en and {language} have other arguments")
        if is_in_english(english, text):
            problems.append(f"{what}: {language} is in English")
    french = texts[LANGUAGES.index("fr")]
    # A line never begins with such a sign: the space before it is U+00A0.
    if re.search(r"(?<=[^\u00a0]) [:;?!»]|« |[\w)}][:;?!»](?![\w/])|«(?!\u00a0)", french):
        problems.append(f"{what}: fr has another space than U+00A0 before : ; ? ! » or after «")


def check_phrases(problems):
    keys = {}
    row = re.compile(rf"PHRASE\((\w+),\s*({TEXT}(?:,\s*{TEXT})*)\)")
    for file in sorted((ROOT / "src/phrases").glob("*.inc")):
        text = file.read_text()
        if file.name == "touch.inc":
            text = text.replace("BY_TOUCH(", "PHRASE(")
        rows = row.findall(text)
        if len(rows) != len(re.findall(r"^PHRASE\(", text, re.M)):
            problems.append(f"{file.name}: a row is not understood")
        for key, texts in rows:
            if file.name != "touch.inc":  # the phrases of the other tables in other words
                keys[key] = file.name
            compare(f"{file.name}: {key}", [joined(text) for text in re.findall(TEXT, texts)], problems)
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
    sentence = rf"\{{({TEXT}(?:,\s*{TEXT})*)\}}"
    rows = {}
    table = re.search(r"constexpr Row rows\[\] = \{(.*?)\n\};", text, re.S)[1]
    for row in table.split("{TextCode::")[1:]:
        rows[re.match(r"\w+", row)[0]] = re.findall(sentence, row)
    used = set()
    for file in sources("src", "apps"):
        if file.parent.name != "wire" or file.stem != "text":
            used |= set(re.findall(r"TextCode::(\w+)", file.read_text()))
    for code in codes:
        if code == "none":
            continue
        if not rows.get(code):
            problems.append(f"text.cpp: {code} has no texts")
        for texts in rows.get(code, []):
            compare(f"text.cpp: {code}", [joined(text) for text in re.findall(TEXT, texts)], problems)
        if code not in used | {"as_written"}:
            problems.append(f"text.h: nothing says {code}")
    return len(codes)


def check_page(name, problems):
    page = ROOT / "apps/web/page"
    tables = dict(re.findall(r"^    (\w+): \{\n(.*?)^    \},\n", (page / name).read_text(), re.M | re.S))
    if list(tables) != LANGUAGES:
        problems.append(f"{name}: its languages are not {', '.join(LANGUAGES)}")
        return 0
    texts = [dict(re.findall(rf"\b(\w+): {STRING}", table)) for table in tables.values()]
    english = texts[0]
    for language, of_language in zip(LANGUAGES, texts):
        for key in english.keys() ^ of_language.keys():
            problems.append(f"{name}: {language} and en have not both {key}")
    for key in set.intersection(*(set(of_language) for of_language in texts)):
        compare(f"{name}: {key}", [of_language[key] for of_language in texts], problems)
    # The meanings of the keys and the touches, in the help.
    meanings = [re.findall(rf"^            \[{STRING}, {STRING}\]", table, re.M) for table in tables.values()]
    if len({len(rows) for rows in meanings}) > 1:
        problems.append("texts.js: the keys of one language have other rows")
    for rows in zip(*meanings):
        compare(f"{name}: {rows[0][0]}", [row[1] for row in rows], problems)
    others = "".join(file.read_text() for file in sources("apps/web/page", endings=(".js", ".html"))
                     if file.name != name)
    others += (page / name).read_text().split("\n};\n")[-1]
    states = set(re.findall(r"\b(\w+): \"", "".join(re.findall(r"(?:states|roles): \{([^}]*)\}", tables["en"]))))
    for key in sorted(english.keys() - states):
        # text() takes that one in place of the other where a person has no keyboard.
        if key.endswith("_touch") and key.removesuffix("_touch") in english:
            continue
        if not re.search(rf"[\"']{key}[\"']|texts\.{key}\b", others):
            problems.append(f"{name}: nothing shows {key}")
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
    phrases, codes, page = check_phrases(problems), check_codes(problems), sum(check_page(name, problems) for name in ("texts.js", "operators_texts.js"))
    check_literals(problems)
    for problem in problems:
        print(problem)
    print(f"{phrases} phrases, {codes} codes, {page} texts of the page, {len(problems)} problems")
    return 1 if problems else 0


sys.exit(main())
