# SPDX-License-Identifier: Apache-2.0
"""The pictures of the stand-ins for cameras' modules: a ramp of depth and a ramp of colour, 64 x 48."""
import numpy as np

WIDTH, HEIGHT = 64, 48


def depth():
    """uint16: 1000 and 10 more for each column; the first row has no measurement."""
    picture = np.tile(1000 + 10 * np.arange(WIDTH, dtype=np.uint16), (HEIGHT, 1))
    picture[0] = 0
    return picture


def color():
    """uint8, red, green, blue."""
    picture = np.zeros((HEIGHT, WIDTH, 3), np.uint8)
    picture[:, :, 0] = 200
    picture[:, :, 2] = 50
    return picture
