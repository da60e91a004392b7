# SPDX-License-Identifier: Apache-2.0
"""docs/formats/depth_payload.md: the header of every encoded depth image. The slow decoders
in this folder were written from the pages in docs/formats, with nothing but Python's own
library, to show that the pages suffice. They are plain, not quick."""

import struct

RAW, RVL, TRVL, ZSTD, LZ4, ANS, H264, STRATA = range(1, 9)


class Malformed(Exception):
    """The bytes are not what the page describes."""


def need(condition, what):
    if not condition:
        raise Malformed(what)


class Header:
    def __init__(self, encoded, codec, flags=1):
        need(len(encoded) >= 8, "shorter than a header")
        self.codec, version, self.flags, self.parameter, self.width, self.height = struct.unpack_from(
            "<BBBBHH", encoded)
        need(self.codec == codec, "another codec")
        need(version == 1, "another version")
        need(self.flags & ~flags == 0, "an unknown flag")
        need(1 <= self.width <= 8192 and 1 <= self.height <= 8192, "a size out of range")
        self.delta = self.flags & 1 != 0
        self.pixels = self.width * self.height


def unzigzag(code):
    return -(code + 1 >> 1) if code & 1 else code >> 1
