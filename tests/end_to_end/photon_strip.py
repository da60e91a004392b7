# SPDX-License-Identifier: Apache-2.0
"""The strip of docs/measuring.md, written a second time from that page, and films of it."""
import subprocess

COLUMNS, ROWS = 12, 3
WIDTH, HEIGHT = COLUMNS + 4, ROWS + 4
FIXED = {(0, 0): 1, (0, 1): 0, (0, 2): 1, (11, 0): 0, (11, 1): 1, (11, 2): 0, (5, 1): 1, (6, 1): 0}


def check_bits(gray):
    crc = 0x3F
    for bit in reversed(range(16)):
        top = (crc >> 5 ^ gray >> bit) & 1
        crc = (crc << 1 ^ (3 if top else 0)) & 0x3F
    mixed = gray * 0x85EBCA6B & 0xFFFFFFFF
    mixed ^= mixed >> 13
    return crc | (mixed * 0xC2B2AE35 & 0xFFFFFFFF) >> 26 << 6


def cells(ms):
    """Rows of 0 (black) and 1, with border and frame."""
    ms &= 0xFFFF
    gray = ms ^ ms >> 1
    bits = gray | check_bits(gray) << 16
    picture = [[1] * WIDTH] + [[1] + [0] * (WIDTH - 2) + [1] for _ in range(HEIGHT - 2)] + [[1] * WIDTH]
    for row in range(ROWS):
        for column in range(COLUMNS):
            if (column, row) in FIXED:
                value = FIXED[column, row]
            else:
                value, bits = bits & 1, bits >> 1
            picture[row + 2][column + 2] = value
    return picture


def rows_of(ms, cell):
    """The strip as grey rows of bytes."""
    return [bytes(255 * value for value in line for _ in range(cell)) for line in cells(ms) for _ in range(cell)]


def picture(strips, cell=8):
    """The strips of these times beside each other on grey; width, height and grey bytes."""
    gap, width = 16, 16 + len(strips) * (WIDTH * cell + 16)
    height = HEIGHT * cell + 2 * gap
    lines = [bytes([128]) * width for _ in range(height)]
    for number, ms in enumerate(strips):
        left = gap + number * (WIDTH * cell + gap)
        for y, row in enumerate(rows_of(ms, cell)):
            line = lines[gap + y]
            lines[gap + y] = line[:left] + row + line[left + len(row):]
    return width, height, b"".join(lines)


def write_film(path, times, fps, cell=8):
    """`times`: of each frame, those of its strips."""
    width, height, _ = picture(times[0], cell)
    encoder = subprocess.Popen(
        ["ffmpeg", "-v", "error", "-y", "-f", "rawvideo", "-pix_fmt", "gray", "-s", f"{width}x{height}", "-r", str(fps),
         "-i", "-", "-pix_fmt", "yuv420p", "-c:v", "mpeg4", "-q:v", "4", path], stdin=subprocess.PIPE)
    for strips in times:
        encoder.stdin.write(picture(strips, cell)[2])
    encoder.stdin.close()
    if encoder.wait() != 0:
        raise AssertionError("ffmpeg wrote no film")
