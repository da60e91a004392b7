# SPDX-License-Identifier: Apache-2.0
"""docs/formats/depth_strata.md: the side information, and the frequencies that follow from it."""

import functools
import pathlib
import re

from payload import need

CONTEXTS, TOKENS, SUM, MOST_LEVEL = 57, 51, 2048, 23
PAGE = pathlib.Path(__file__).parents[2] / "docs/formats/depth_strata.md"


@functools.cache
def standard_levels():
    """The table of the page, a list of levels for each context."""
    table = PAGE.read_text().split("## Standard levels")[1].split("```")[1]
    lines = re.findall(r"^[.a-w]+$", table, re.M)
    assert len(lines) == CONTEXTS and all(len(line) == TOKENS for line in lines)
    return [[0 if letter == "." else ord(letter) - ord("a") + 1 for letter in line] for line in lines]


class Models:
    """Probabilities by name; each is 2048 at first."""

    def __init__(self):
        self.of = {}

    def get(self, name):
        return self.of.get(name, 2048)


class SideReader:
    def __init__(self, side):
        need(len(side) >= 4, "side information ends early")
        self.side = side
        self.code = int.from_bytes(side[:4], "big")
        self.at = 4
        self.range = 2**32 - 1

    def bit(self, models, name):
        p = models.get(name)
        split = (self.range >> 12) * p
        if self.code < split:
            bit, self.range = 0, split
            models.of[name] = p + ((4096 - p) >> 4)
        else:
            bit = 1
            self.code -= split
            self.range -= split
            models.of[name] = p - (p >> 4)
        while self.range < 1 << 24:
            need(self.at < len(self.side), "side information ends early")
            self.range <<= 8
            self.code = self.code << 8 | self.side[self.at]
            self.at += 1
        return bit

    def number(self, models):
        digits = 0
        while digits < 16 and self.bit(models, ("length", digits)):
            digits += 1
        value = 1
        for place in range(digits):
            value = value << 1 | self.bit(models, ("digit", digits, place))
        return value - 1

    def end(self):
        need(self.at == len(self.side), "side information is left over")


def read_values(reader, before):
    """The values that the frame adds, and the whole list."""
    counts, differences = Models(), Models()
    added = []
    last = 0
    for _ in range(reader.number(counts)):
        last += 1 + reader.number(differences)
        need(last <= 65534 and last not in before, "a value out of range or already there")
        added.append(last)
    values = sorted(before + added)
    need(0 < len(values) <= 4096, "the number of values is out of range")
    return added, values


def read_levels(reader, before):
    models = Models()
    levels = [list(context) for context in before]
    for context in levels:
        if not reader.bit(models, "context"):
            continue
        last_changed = 0
        for token, guess in enumerate(context):
            kind = min(guess, 2)
            last_changed = reader.bit(models, ("changes", kind, last_changed))
            if not last_changed:
                continue
            if guess in (0, MOST_LEVEL):
                rises = guess == 0
            else:
                rises = reader.bit(models, ("rises", kind))
            limit = MOST_LEVEL - guess if rises else guess
            size = 1
            while size < limit and reader.bit(models, ("more", kind, size)):
                size += 1
            context[token] = guess + size if rises else guess - size
    return levels


def frequencies_of(levels):
    weights = [0 if n == 0 else (64 if n % 2 else 91) * 2 ** ((n - 1) // 2) for n in levels]
    total = sum(weights)
    if total == 0:
        return [SUM] + [0] * (TOKENS - 1)
    result = [max(1, (w * SUM + total // 2) // total) if w else 0 for w in weights]
    while sum(result) != SUM:
        largest = max(result)
        surplus = sum(result) - SUM
        result[result.index(largest)] -= surplus if surplus < 0 else min(surplus, (largest + 1) // 2)
    return result


@functools.cache
def slots_of(levels):
    """Token, start and frequency for each of 2048 slots; `levels` is a tuple."""
    slots = []
    for token, frequency in enumerate(frequencies_of(levels)):
        slots += [(token, len(slots), frequency)] * frequency
    return slots
