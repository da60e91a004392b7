# SPDX-License-Identifier: Apache-2.0
"""Compares a picture with the one that it should be: rows of (red, green, blue), 0 to 255."""
import math

# Drivers round differently, and browsers have letters of their own.
LEAST_PSNR_DB = 35
MOST_SHIFT = 1.5  # of a colour's mean over the picture
BLOCK, MOST_BLOCK_SHIFT = 20, 12  # pixels a side; of the mean of the three colours there


def pixels_of(picture, left=0, width=None):
    """Rows of colours of what read_png returned, from this column on."""
    whole, _, channels, rows = picture
    right = whole if width is None else left + width
    return [[tuple(row[channels * x:channels * x + 3]) for x in range(left, right)] for row in rows]


def psnr(one, other):
    squares = [(a - b) ** 2 for p, q in zip(one, other) for c, d in zip(p, q) for a, b in zip(c, d)]
    mean = sum(squares) / len(squares)
    return math.inf if mean == 0 else 10 * math.log10(255 ** 2 / mean)


def means(pixels):
    """The mean of each colour."""
    flat = [color for row in pixels for color in row]
    return [sum(color[c] for color in flat) / len(flat) for c in range(3)]


def differences(picture, wanted):
    """Sentences on what is not as it should be; none if the pictures are equal but for rounding."""
    size, wanted_size = (len(picture[0]), len(picture)), (len(wanted[0]), len(wanted))
    if size != wanted_size:
        return [f"the size is {size}, not {wanted_size}"]
    found = []
    if (noise := psnr(picture, wanted)) < LEAST_PSNR_DB:
        found.append(f"PSNR {noise:.1f} dB")
    for name, mean, goal in zip(("red", "green", "blue"), means(picture), means(wanted)):
        if abs(mean - goal) > MOST_SHIFT:
            found.append(f"{name} is {mean:.1f} on average, not {goal:.1f}")
    for top in range(0, size[1], BLOCK):
        for left in range(0, size[0], BLOCK):
            own, goal = (sum(means([row[left:left + BLOCK] for row in p[top:top + BLOCK]])) / 3 for p in (picture, wanted))
            if abs(own - goal) > MOST_BLOCK_SHIFT:
                found.append(f"around ({left}, {top}) it is {own:.0f}, not {goal:.0f}")
    return found
