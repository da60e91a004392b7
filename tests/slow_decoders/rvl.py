# SPDX-License-Identifier: Apache-2.0
"""docs/formats/depth_rvl.md and depth_trvl.md."""

from payload import RVL, TRVL, Header, need, unzigzag


class Numbers:
    """Groups of three bits in nibbles, low half of a byte first."""

    def __init__(self, encoded):
        self.nibbles = [half for byte in encoded for half in (byte & 15, byte >> 4)]
        self.at = 0

    def next(self):
        number = shift = 0
        while True:
            need(self.at < len(self.nibbles), "the numbers end early")
            nibble = self.nibbles[self.at]
            self.at += 1
            number |= (nibble & 7) << shift
            shift += 3
            if nibble & 8 == 0:
                need(shift == 3 or nibble != 0, "a number's last of several groups is 0")
                return number

    def end(self):
        left = self.nibbles[self.at:]
        need(len(left) <= 1 and not any(left), "bytes are left over")


def decode_runs(encoded, count):
    numbers = Numbers(encoded)
    pixels = []
    last = 0
    while len(pixels) < count:
        zeros = numbers.next()
        need(zeros > 0 or not pixels, "an empty run of zeros")
        pixels += [0] * zeros
        others = numbers.next()
        need(len(pixels) + others <= count, "a run leaves the image")
        need(others > 0 or len(pixels) == count, "an empty run of other pixels")
        for _ in range(others):
            code = numbers.next()
            need(code <= 0xFFFF, "a difference is too large")
            last = last + unzigzag(code) & 0xFFFF
            need(last != 0, "a zero among the other pixels")
            pixels.append(last)
    numbers.end()
    return pixels


def decode_rvl(encoded):
    header = Header(encoded, RVL, flags=0)
    need(header.parameter == 0, "a parameter")
    return decode_runs(encoded[8:], header.pixels)


def decode_trvl(encoded, reference):
    header = Header(encoded, TRVL)
    need(header.parameter == 0, "a parameter")
    pixels = decode_runs(encoded[8:], header.pixels)
    if header.delta:
        pixels = [change + before & 0xFFFF for change, before in zip(pixels, reference)]
    return pixels
