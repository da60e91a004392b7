# SPDX-License-Identifier: Apache-2.0
"""DICOM files as devices write them, byte by byte (PS3.5, 7; PS3.10)."""

import struct
import zlib

IMPLICIT = "1.2.840.10008.1.2"
EXPLICIT = "1.2.840.10008.1.2.1"
BIG_ENDIAN = "1.2.840.10008.1.2.2"
DEFLATED = "1.2.840.10008.1.2.1.99"
RLE = "1.2.840.10008.1.2.5"
LONG = {"OB", "OD", "OF", "OL", "OV", "OW", "SQ", "SV", "UC", "UN", "UR", "UT", "UV"}
COLUMNS, ROWS = 16, 12
SPACING = (0.75, 0.5)  # of rows, of columns


class Encoding:
    def __init__(self, explicit=True, order="<"):
        self.explicit, self.order = explicit, order

    def head(self, tag, kind, length):
        start = struct.pack(self.order + "HH", tag >> 16, tag & 0xffff)
        if not self.explicit:
            return start + struct.pack(self.order + "I", length)
        if kind in LONG:
            return start + kind.encode() + b"\0\0" + struct.pack(self.order + "I", length)
        return start + kind.encode() + struct.pack(self.order + "H", length)

    def element(self, tag, kind, value):
        if isinstance(value, list) and value and isinstance(value[0], dict):
            body = b"".join(self.item(one) for one in value)
            return self.head(tag, "SQ", len(body)) + body
        if isinstance(value, str):
            value = value.encode("latin-1")
        elif isinstance(value, int):
            value = struct.pack(self.order + ("h" if kind == "SS" else "H"), value)
        elif isinstance(value, list):
            value = struct.pack(self.order + "%dH" % len(value), *[one & 0xffff for one in value])
        if len(value) % 2:
            value += b"\0" if kind in ("UI", "OB") else b" "
        return self.head(tag, kind, len(value)) + value

    def item(self, elements, open_ended=False):
        body = self.data_set(elements)
        tag = struct.pack(self.order + "HH", 0xfffe, 0xe000)
        if open_ended:
            end = struct.pack(self.order + "HHI", 0xfffe, 0xe00d, 0)
            return tag + struct.pack(self.order + "I", 0xffffffff) + body + end
        return tag + struct.pack(self.order + "I", len(body)) + body

    def open_sequence(self, tag, kind, items):
        end = struct.pack(self.order + "HHI", 0xfffe, 0xe0dd, 0)
        body = b"".join(self.item(one, True) for one in items)
        return self.head(tag, kind, 0xffffffff) + body + end

    def data_set(self, elements):
        """`elements`: tag -> (kind, value), or raw bytes that stand for the whole element."""
        out = b""
        for tag in sorted(elements):
            one = elements[tag]
            out += one if isinstance(one, bytes) else self.element(tag, *one)
        return out


def stored(k):
    """The value of each pixel of slice k: 0 to 3999."""
    return [(x * 37 + y * 111 + k * 401) % 4000 for y in range(ROWS) for x in range(COLUMNS)]


def slice_elements(k, step=2.0, **changed):
    """A CT slice; `changed` replaces elements, None takes one out."""
    elements = {
        0x00080008: ("CS", "ORIGINAL\\PRIMARY\\AXIAL"),
        0x00080016: ("UI", "1.2.840.10008.5.1.4.1.1.2"),
        0x00080018: ("UI", "1.2.3.4.5.%d" % k),
        0x00080060: ("CS", "CT"),
        0x00100020: ("LO", "GEN-1"),
        0x0020000d: ("UI", "1.2.3"),
        0x0020000e: ("UI", "1.2.3.4"),
        0x00200013: ("IS", str(k + 1)),
        0x00200032: ("DS", "-10\\-20\\%g" % (5 + step * k)),
        0x00200037: ("DS", "1\\0\\0\\0\\1\\0"),
        0x00200052: ("UI", "1.2.3.5"),
        0x00280002: ("US", 1),
        0x00280004: ("CS", "MONOCHROME2"),
        0x00280010: ("US", ROWS),
        0x00280011: ("US", COLUMNS),
        0x00280030: ("DS", "%g\\%g" % SPACING),
        0x00280100: ("US", 16),
        0x00280101: ("US", 16),
        0x00280102: ("US", 15),
        0x00280103: ("US", 0),
        0x00281050: ("DS", "40"),
        0x00281051: ("DS", "400"),
        0x00281052: ("DS", "-1024"),
        0x00281053: ("DS", "1"),
        0x7fe00010: ("OW", stored(k)),
    }
    for name, value in changed.items():
        tag = int(name[1:], 16)
        elements.pop(tag, None)
        if value is not None:
            elements[tag] = value
    return elements


def meta(syntax):
    encoding = Encoding()
    body = encoding.data_set({
        0x00020001: ("OB", b"\0\1"),
        0x00020002: ("UI", "1.2.840.10008.5.1.4.1.1.2"),
        0x00020003: ("UI", "1.2.3.4.5.0"),
        0x00020010: ("UI", syntax),
        0x00020012: ("UI", "1.2.3.6"),
    })
    return encoding.element(0x00020000, "UL", struct.pack("<I", len(body))) + body


def file_of(elements, syntax=EXPLICIT, preamble=True, encoding=None, head=True, tail=b""):
    """The bytes of a file. `encoding`: how the elements are written, if not as `syntax` says."""
    if encoding is None:
        encoding = Encoding(syntax != IMPLICIT, ">" if syntax == BIG_ENDIAN else "<")
    body = encoding.data_set(elements)
    if syntax == DEFLATED:
        packer = zlib.compressobj(6, zlib.DEFLATED, -15)
        body = packer.compress(body) + packer.flush()
        body += b"\0" * (len(body) % 2)
    start = (b"\0" * 128 + b"DICM") if preamble else b""
    return start + (meta(syntax) if head else b"") + body + tail


def fragments(parts, end=True):
    """Packed pixels as a whole element, with an empty table of offsets."""
    out = struct.pack("<HH", 0x7fe0, 0x0010) + b"OB\0\0" + struct.pack("<I", 0xffffffff)
    for part in [b""] + parts:
        part += b"\0" * (len(part) % 2)
        out += struct.pack("<HHI", 0xfffe, 0xe000, len(part)) + part
    return out + (struct.pack("<HHI", 0xfffe, 0xe0dd, 0) if end else b"")


def rle(values):
    """16-bit values as two segments of literal runs, the high bytes first (PS3.5, annex G)."""
    segments = []
    for shift in (8, 0):
        bytes_ = bytes(value >> shift & 255 for value in values)
        out = b""
        for at in range(0, len(bytes_), 128):
            piece = bytes_[at:at + 128]
            out += bytes([len(piece) - 1]) + piece
        segments.append(out + b"\0" * (len(out) % 2))
    offsets = [64, 64 + len(segments[0])] + [0] * 13
    return struct.pack("<16I", 2, *offsets) + b"".join(segments)
