# SPDX-License-Identifier: Apache-2.0
"""docs/formats/depth_ans.md."""

import struct

from payload import ANS, Header, need, unzigzag

SUM = 2048
LEAST = 1 << 15


class Kind:
    """One of the two sequences: how its numbers become symbols."""

    def __init__(self, direct, offset, symbols, contexts):
        self.direct, self.offset, self.symbols, self.contexts = direct, offset, symbols, contexts


RUNS = Kind(16, 16, 108, 2)
DIFFERENCES = Kind(192, 30, 226, 6)


class Bytes:
    def __init__(self, encoded, at):
        self.encoded, self.at = encoded, at

    def take(self, layout):
        need(self.at + struct.calcsize(layout) <= len(self.encoded), "ends early")
        values = struct.unpack_from(layout, self.encoded, self.at)
        self.at += struct.calcsize(layout)
        return values


def read_slots(source, symbols):
    """Symbol, start and frequency for each of 2048 slots."""
    slots = []
    symbol = 0
    while len(slots) < SUM:
        (first,) = source.take("B")
        if first == 0:
            symbol += 1 + source.take("B")[0]
            continue
        frequency = first if first < 128 else (first & 127) << 8 | source.take("B")[0]
        need(symbol < symbols and len(slots) + frequency <= SUM, "frequencies go too far")
        slots += [(symbol, len(slots), frequency)] * frequency
        symbol += 1
    return slots


def read_sequence(source, kind, count):
    tables = [read_slots(source, kind.symbols) for _ in range(kind.contexts)]
    word_count, extra_count = source.take("<II")
    states = list(source.take("<4I"))
    words = iter(source.take(f"<{word_count}H"))
    extra_bytes = source.take(f"{extra_count}B")
    extra, extra_bits = int.from_bytes(bytes(extra_bytes), "little"), 0

    starts = [0]
    for part in range(4):
        starts.append(starts[-1] + count // 4 + (part < count % 4))
    numbers = [0] * count
    means = [0] * 4
    for step in range(starts[1]):
        for part in range(4):
            at = starts[part] + step
            if at >= starts[part + 1]:
                continue
            if kind is RUNS:
                context = at % 2
            else:
                context = sum(means[part] > limit for limit in (3, 7, 14, 28, 80))
            state = states[part]
            symbol, start, frequency = tables[context][state % SUM]
            state = frequency * (state // SUM) + state % SUM - start
            if state < LEAST:
                word = next(words, None)
                need(word is not None, "the words end early")
                state = state << 16 | word
            states[part] = state
            means[part] = (means[part] + 2 * symbol + 1) // 2
            if symbol < kind.direct:
                numbers[at] = symbol
                continue
            octave, quarter = divmod(symbol - kind.direct + kind.offset, 4)
            bits = octave - 2
            numbers[at] = (4 + quarter) << bits | extra >> extra_bits & (1 << bits) - 1
            extra_bits += bits
    need(next(words, None) is None and states == [LEAST] * 4, "another end than the encoder's")
    need((extra_bits + 7) // 8 == extra_count and extra >> extra_bits == 0, "extra bits are left over")
    return numbers


def decode_ans(encoded, reference):
    header = Header(encoded, ANS)
    need(header.parameter == 0, "a parameter")
    source = Bytes(encoded, 8)
    (run_count,) = source.take("<I")
    runs = read_sequence(source, RUNS, run_count)
    need(sum(runs) == header.pixels and 0 not in runs[1:], "the runs do not fill the image")
    differences = iter(read_sequence(source, DIFFERENCES, sum(runs[1::2])))
    need(source.at == len(encoded), "bytes are left over")
    pixels = []
    last = 0
    for place, run in enumerate(runs):
        if place % 2 == 0:
            pixels += [0] * run
            continue
        for _ in range(run):
            last = last + unzigzag(next(differences)) & 0xFFFF
            need(last != 0, "a zero among the other pixels")
            pixels.append(last)
    if header.delta:
        pixels = [change + before & 0xFFFF for change, before in zip(pixels, reference)]
    return pixels
