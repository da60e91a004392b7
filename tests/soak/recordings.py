# SPDX-License-Identifier: Apache-2.0
"""The media headers in a recording, read as docs/formats/recording.md says, without the program's own reader."""
import mmap
import struct
import typing

SEGMENT, CLUSTER, GROUP, BLOCK = 0x18538067, 0x1F43B675, 0xA0, 0xA1
ADDITIONS, MORE, ADD_ID, ADDITIONAL = 0x75A1, 0xA6, 0xEE, 0xA5
MEDIA_HEADER_ID, MEDIA_HEADER_SIZE = 2, 64
UNKNOWN_SIZE = -1
# Streams from here on are voices and the room.
FIRST_VOICE = 127

# Version, codec, flags, layer; stream, setting; frame, reference; slice, slices; payload; moment, captured.
HEADER = struct.Struct("<BBBBHHIIHHIqq")


class Picture(typing.NamedTuple):
    stream: int
    setting: int
    frame: int
    reference: int
    captured_us: int
    begins_chain: bool  # the first picture of its stream in a segment

    @property
    def is_key(self):
        return self.frame == self.reference


def read_id(data, at):
    first = data[at]
    length = 9 - first.bit_length() if first else 9
    if length > 4 or at + length > len(data):
        raise ValueError("no element")
    return int.from_bytes(data[at:at + length], "big"), at + length


def read_size(data, at):
    first = data[at]
    length = 9 - first.bit_length() if first else 9
    if length > 8 or at + length > len(data):
        raise ValueError("no size")
    value = int.from_bytes(data[at:at + length], "big") & ((1 << 7 * length) - 1)
    return (UNKNOWN_SIZE if value == (1 << 7 * length) - 1 else value), at + length


def elements(data, at, end):
    """(id, begin of content, end of content) of the elements in [at, end), as far as they are whole."""
    while at < end:
        try:
            identity, body = read_id(data, at)
            size, body = read_size(data, body)
        except (ValueError, IndexError):
            return
        # Only a segment may have an unknown size: it ends at the file's end or at the next segment.
        stop = end if size == UNKNOWN_SIZE else body + size
        if stop > end:
            if identity != SEGMENT:
                return
            stop = end
        yield identity, body, stop
        at = stop


def header_of(data, at, end):
    """The media header of the block group in [at, end), or None."""
    for identity, begin, stop in elements(data, at, end):
        if identity != ADDITIONS:
            continue
        for _, more, more_end in elements(data, begin, stop):
            number, content = None, None
            for inner, a, b in elements(data, more, more_end):
                if inner == ADD_ID:
                    number = int.from_bytes(data[a:b], "big")
                elif inner == ADDITIONAL:
                    content = (a, b)
            if number == MEDIA_HEADER_ID and content and content[1] - content[0] == MEDIA_HEADER_SIZE:
                return HEADER.unpack_from(data, content[0])
    return None


def read_pictures(path):
    """Every picture of the file in the order in which it was written."""
    pictures, seen = [], set()
    with open(path, "rb") as file:
        if file.seek(0, 2) == 0:
            return pictures
        with mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ) as data:
            _collect(data, 0, len(data), pictures, seen)
    return pictures


def _collect(data, at, end, pictures, seen):
    for identity, begin, stop in elements(data, at, end):
        if identity == SEGMENT:
            seen.clear()
            _collect(data, begin, stop, pictures, seen)
        elif identity == CLUSTER:
            for group, a, b in elements(data, begin, stop):
                header = header_of(data, a, b) if group == GROUP else None
                if header and header[4] < FIRST_VOICE:
                    stream, setting, frame, reference = header[4:8]
                    pictures.append(Picture(stream, setting, frame, reference, header[12], stream not in seen))
                    seen.add(stream)


def decodable(pictures):
    """For each picture, whether it can be decoded from what came before it in the file."""
    held, answers = {}, []
    for p in pictures:
        chain = held.setdefault(p.stream, set())
        if p.begins_chain:
            chain.clear()
        if p.is_key:
            chain.clear()
            chain.add((p.setting, p.frame))
            answers.append(True)
            continue
        good = (p.setting, p.reference) in chain
        if good:
            chain.add((p.setting, p.frame))
        answers.append(good)
    return answers
