# SPDX-License-Identifier: Apache-2.0
"""docs/formats/recording.md: the frames of a recording, with the element numbers of RFC 9559."""

import struct

SEGMENT, CLUSTER, BLOCK_GROUP, BLOCK = 0x18538067, 0x1F43B675, 0xA0, 0xA1
ADDITIONS, MORE, ADD_ID, ADDITIONAL = 0x75A1, 0xA6, 0xEE, 0xA5
MEDIA_HEADER = 2


def number(data, at, keep_marker):
    """An EBML number: its value and where it ends. All ones without marker: None."""
    length = 9 - data[at].bit_length()
    value = int.from_bytes(data[at:at + length], "big")
    if not keep_marker:
        value -= 1 << 7 * length
        if value == (1 << 7 * length) - 1:
            value = None
    return value, at + length


def elements(data, at, end):
    """Number, begin and end of the content of each element, one after the other."""
    while at < end:
        kind, at = number(data, at, True)
        size, at = number(data, at, False)
        stop = end if size is None else min(end, at + size)
        yield kind, at, stop
        at = stop


def inside(data, begin, end, wanted):
    return [(b, e) for kind, b, e in elements(data, begin, end) if kind == wanted]


class Frame:
    """Fields of docs/formats/media_header.md, and the encoded image."""

    def __init__(self, header, payload):
        (version, self.codec, flags, self.layer, self.stream, self.setting, self.frame, self.reference, part,
         parts, size) = struct.unpack_from("<BBBBHHIIHHI", header)
        assert version == 1 and len(header) == 64 and size == len(payload) and (part, parts) == (0, 1)
        self.key = flags & 1 != 0
        self.payload = payload


def frames_of(data):
    for segment in inside(data, 0, len(data), SEGMENT):
        for cluster in inside(data, *segment, CLUSTER):
            for group in inside(data, *cluster, BLOCK_GROUP):
                (block,) = inside(data, *group, BLOCK)
                _, after_track = number(data, block[0], False)
                payload = data[after_track + 3:block[1]]  # behind two bytes of time and one of flags
                for additions in inside(data, *group, ADDITIONS):
                    for more in inside(data, *additions, MORE):
                        (name,) = inside(data, *more, ADD_ID)
                        (content,) = inside(data, *more, ADDITIONAL)
                        if int.from_bytes(data[name[0]:name[1]], "big") == MEDIA_HEADER:
                            yield Frame(data[content[0]:content[1]], payload)
