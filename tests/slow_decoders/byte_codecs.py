# SPDX-License-Identifier: Apache-2.0
"""docs/formats/depth_raw.md, depth_lz4.md and depth_zstd.md. LZ4's block format is decoded
here; zstd (RFC 8878) by the system's libzstd, the one thing that is not Python's own."""

import ctypes
import ctypes.util
import struct

from payload import LZ4, RAW, ZSTD, Header, need, unzigzag


def decode_raw(encoded):
    header = Header(encoded, RAW, flags=0)
    need(header.parameter == 0 and len(encoded) == 8 + 2 * header.pixels, "another length")
    return list(struct.unpack_from(f"<{header.pixels}H", encoded, 8))


def lz4_block(block, size):
    out = bytearray()
    at = 0

    def longer(length):
        nonlocal at
        if length == 15:
            while True:
                more = block[at]
                at += 1
                length += more
                if more != 255:
                    break
        return length

    while True:
        token = block[at]
        at += 1
        literals = longer(token >> 4)
        out += block[at:at + literals]
        at += literals
        if at == len(block):
            break
        offset = block[at] | block[at + 1] << 8
        at += 2
        need(0 < offset <= len(out), "an offset leaves the block")
        for _ in range(4 + longer(token & 15)):
            out.append(out[-offset])
    need(len(out) == size, "the block has another size")
    return bytes(out)


def zstd_frame(frame, size):
    library = ctypes.CDLL(ctypes.util.find_library("zstd") or "libzstd.so.1")
    library.ZSTD_decompress.restype = ctypes.c_size_t
    library.ZSTD_decompress.argtypes = [ctypes.c_char_p, ctypes.c_size_t, ctypes.c_char_p, ctypes.c_size_t]
    out = ctypes.create_string_buffer(size)
    need(library.ZSTD_decompress(out, size, frame, len(frame)) == size, "no zstd frame of this size")
    return out.raw


def decode_bytes(header, content, reference):
    """Decodes the part that zstd and lz4 share: planes, prediction, quantisation."""
    planes, step = header.parameter & 1, (header.parameter >> 1) + 1
    count = header.pixels
    need(planes or not header.delta, "a delta frame without planes")
    if planes:
        levels = []
        if header.delta:
            before = [(v - 1) // step + 1 if v > 0 else 0 for v in reference]
        for i in range(count):
            difference = unzigzag(content[i] | content[count + i] << 8)
            if header.delta:
                prediction = before[i]
            elif i % header.width > 0:
                prediction = levels[i - 1]
            else:
                prediction = levels[i - header.width] if i > 0 else 0
            levels.append(prediction + difference & 0xFFFF)
    else:
        levels = struct.unpack(f"<{count}H", content)
    return [min(0xFFFF, (q - 1) * step + (step + 1) // 2) if q > 0 else 0 for q in levels]


def decode_lz4(encoded, reference):
    header = Header(encoded, LZ4)
    return decode_bytes(header, lz4_block(encoded[8:], 2 * header.pixels), reference)


def decode_zstd(encoded, reference):
    header = Header(encoded, ZSTD)
    return decode_bytes(header, zstd_frame(encoded[8:], 2 * header.pixels), reference)
