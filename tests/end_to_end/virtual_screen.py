# SPDX-License-Identifier: Apache-2.0
"""A screen that exists only in memory (Xvfb), with real key and mouse events (xdotool)."""
import mmap
import os
import pathlib
import struct
import subprocess
import tempfile

import patience
from theatron_process import write_png


class VirtualScreen:
    def __init__(self, width, height):
        self.folder = tempfile.TemporaryDirectory(prefix="theatron_screen_")
        # The server picks a free display and says which.
        reader, writer = os.pipe()
        self.server = subprocess.Popen(
            ["Xvfb", "-displayfd", str(writer), "-screen", "0", f"{width}x{height}x24", "-nolisten", "tcp",
             # Otherwise it begins anew when its last client leaves, and closes the connections of those who come then.
             "-noreset", "-fbdir", self.folder.name], pass_fds=[writer], stderr=subprocess.DEVNULL)
        os.close(writer)
        with os.fdopen(reader) as pipe:
            self.display = ":" + pipe.readline().strip()
        # Windows neither read nor change the settings of the person who runs the test.
        self.environment = {**os.environ, "DISPLAY": self.display, "SDL_VIDEODRIVER": "x11",
                            "XDG_STATE_HOME": self.folder.name}
        self.environment.pop("WAYLAND_DISPLAY", None)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.server.terminate()
        self.server.wait()
        self.folder.cleanup()

    def do(self, *arguments):
        """One xdotool command line, for example key Tab."""
        done = subprocess.run(["xdotool", *map(str, arguments)], env=self.environment, capture_output=True, text=True)
        return done.stdout.strip()

    def click_until(self, button, process, condition):
        """Clicks where button() is, again if rows that came meanwhile have moved it, until a report of the process meets
        the condition; returns that."""
        wait = patience.Wait(condition)
        while True:
            self.do("mousemove", *button(), "click", 1)
            for _ in range(30):
                figures = process.read_json(wait)
                if condition(figures):
                    return figures
            wait.check()

    def title(self):
        return self.do("search", "--name", "Theatron", "getwindowname")

    def pixels(self, left, top, width, height):
        """Rows of blue, green, red, unused bytes: what is on the screen now (an XWD file)."""
        with open(pathlib.Path(self.folder.name) / "Xvfb_screen0", "rb") as file, \
                mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ) as image:
            header_size, = struct.unpack_from(">I", image, 0)
            stride, = struct.unpack_from(">I", image, 48)
            colors, = struct.unpack_from(">I", image, 76)
            start = header_size + 12 * colors
            return [image[start + y * stride + 4 * left:start + y * stride + 4 * (left + width)]
                    for y in range(top, top + height)]

    def save(self, path, width, height):
        """A PNG file of this part of the screen, from its corner."""
        rgb = [b"".join(row[x + 2:x - 1 if x else None:-1] for x in range(0, 4 * width, 4)) for row in self.pixels(0, 0, width, height)]
        write_png(pathlib.Path(path), width, height, 8, 3, rgb)

    def has_bar(self, width, height):
        """The whole bar of a session is drawn in a window of less than 870 pixels: "More", its last button, has the last ninth
        of the width. A window that connects, or has lost its host, has one button in the middle, which leaves."""
        left = width * 8 // 9
        return self.has((245, 247, 250), 1, left, height - 50, width - left, 50)

    def has(self, color, least, left, top, width, height):
        """At least `least` pixels there have this colour: red, green, blue."""
        blue_green_red = bytes(reversed(color))
        return sum(row[x:x + 3] == blue_green_red for row in self.pixels(left, top, width, height) for x in range(0, len(row), 4)) >= least

    def buttons(self, width, height, least=21):
        """Middles of the panels' buttons, a little below their upper edges, from top to bottom and left to right."""
        color = bytes((84, 66, 52))
        boxes = []  # [left, right, top, last row]
        for y, row in enumerate(self.pixels(0, 0, width, height)):
            x = 0
            while 0 <= (at := row.find(color, 4 * x)) < 4 * width:
                if at % 4:
                    x = at // 4 + 1
                    continue
                x = at // 4
                end = x
                while end < width and row[4 * end:4 * end + 3] == color:
                    end += 1
                # Letters break the rows of a button into pieces, but not those at its edges.
                box = next((b for b in boxes if b[0] - 3 <= x and end <= b[1] + 3 and y - b[3] <= 2), None)
                if box:
                    box[:] = min(box[0], x), max(box[1], end), box[2], y
                elif end - x >= least:
                    boxes.append([x, end, y, y])
                x = end
        found = [((left + right) // 2, top + 3) for left, right, top, last in boxes if last - top > 10]
        if least > 20:
            return sorted(found, key=lambda place: (round(place[1] / 30), place[0]))
        rows = []  # buttons of one row have the same upper edge, nearly
        for place in sorted(found, key=lambda place: place[1]):
            if rows and place[1] - rows[-1][0][1] <= 8:
                rows[-1].append(place)
            else:
                rows.append([place])
        return [place for row in rows for place in sorted(row)]


def difference(one, other):
    """Share of the pixels that differ visibly."""
    total = sum(len(row) // 4 for row in one)
    changed = sum(abs(a[4 * x + 1] - b[4 * x + 1]) > 12
                  for a, b in zip(one, other) for x in range(len(a) // 4))
    return changed / total


def brightness(rows):
    """Mean of the green values."""
    return sum(sum(row[1::4]) for row in rows) / sum(len(row) // 4 for row in rows)
