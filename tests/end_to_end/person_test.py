# SPDX-License-Identifier: Apache-2.0
"""People whom a camera sees: the room behind them is cut off, and of oneself what blocks the view."""
import json
import pathlib
import shutil
import tempfile
import time
import unittest

from theatron_process import Process, host, read_png, run, wait_until, write_png
from virtual_screen import VirtualScreen, difference

WIDTH, HEIGHT, FOCAL = 160, 120, 130
CAMERA_Y = 1.2
PERSON_MM, WALL_MM, GLASSES_MM = 1500, 3000, 400


def make_person(folder):
    """A body before a wall, and something right before the camera; the camera looks level along -z."""
    depth, color = [], []
    for y in range(HEIGHT):
        row, line = [], []
        for x in range(WIDTH):
            body = 50 <= x < 110 and y >= 20
            near = 70 <= x < 90 and 50 <= y < 60
            row.append(GLASSES_MM if near else PERSON_MM if body else WALL_MM)
            line += [40, 40, 220] if near else [220, 60, 40] if body else [60, 200, 90]
        depth.append(b"".join(v.to_bytes(2, "big") for v in row))
        color.append(bytes(line))
    for kind in ("depth", "color"):
        (folder / kind).mkdir(parents=True)
    write_png(folder / "depth" / "00000.png", WIDTH, HEIGHT, 16, 1, depth)
    write_png(folder / "color" / "00000.png", WIDTH, HEIGHT, 8, 3, color)
    lens = {"width": WIDTH, "height": HEIGHT, "fx": FOCAL, "fy": FOCAL, "cx": WIDTH / 2, "cy": HEIGHT / 2}
    # Half a turn about x: the camera's y is down, its z away from it.
    pose = {"quaternion": [0, 1, 0, 0], "translation": [0, CAMERA_Y, 0]}
    (folder / "calibration.json").write_text(json.dumps({"depth": lens, "color": lens, "room_from_camera": pose}))
    return folder


def place(x, y, mm):
    """The room coordinates of a pixel."""
    z = mm / 1000
    return (x - WIDTH / 2) / FOCAL * z, CAMERA_Y - (y - HEIGHT / 2) / FOCAL * z, -z


def away(x, y, mm, point):
    return sum((a - b) ** 2 for a, b in zip(place(x, y, mm), point)) ** 0.5


class Person(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="theatron_person_"))
        cls.camera = f"folder:{make_person(cls.folder / 'person')},loop=1,preload=1"

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder)

    def host(self):
        # Without filters, depth reaches the viewer unchanged.
        return host(self.folder / "state", self.camera, options=("--filter", "off"))

    def join(self, link, *options):
        depth = self.folder / "depth.png"
        code, _, errors = run("join", link, "--depth", depth, "--size", f"{WIDTH}x{HEIGHT}", "--seconds", 0.5,
                              *options)
        self.assertEqual(code, 0, errors)
        return read_png(depth)[3]

    def shares(self, rows, middle, reach):
        """The share of drawn pixels among the body's and the wall's: within the reach, at its border, beyond it."""
        counts = {}
        for y in range(2, HEIGHT - 2):
            for x in range(2, WIDTH - 2):
                mm = PERSON_MM if 53 <= x < 107 and y >= 23 else WALL_MM if x < 47 or x >= 113 or y < 17 else 0
                if mm == 0 or (66 <= x < 94 and 46 <= y < 64):
                    continue
                beyond = away(x, y, mm, middle) - reach
                where = "inside" if beyond < -0.1 else "outside" if beyond > 0.02 else "border"
                drawn, total = counts.get(where, (0, 0))
                counts[where] = (drawn + (abs(rows[y][x] - mm) < 30), total + 1)
        return {where: drawn / total for where, (drawn, total) in counts.items()}

    def test_behind_the_person_nothing_is_drawn_and_the_border_is_soft(self):
        # Level eyes that look along +z, towards the camera: the neck is 0.1 m behind them.
        eyes, reach = (0.0, 1.6, -1.4), 0.5
        middle = (eyes[0], eyes[1] - 0.55, eyes[2] - 0.1)
        text = "0={}:{}:{},yaw=180,reach={}".format(*eyes, reach)
        with self.host() as h:
            for renderer in ("splat", "disc", "mesh", "blend"):
                with self.subTest(renderer=renderer):
                    whole = self.shares(self.join(h.greeting["link"], "--renderer", renderer), middle, reach)
                    self.assertGreater(min(whole.values()), 0.95)
                    cut = self.shares(self.join(h.greeting["link"], "--renderer", renderer, "--person", text),
                                      middle, reach)
                    self.assertGreater(cut["inside"], 0.95)
                    self.assertEqual(cut["outside"], 0)
                    self.assertGreater(cut["border"], 0.1)
                    self.assertLess(cut["border"], 0.9)
            with self.subTest("of oneself also what is right before the eyes"):
                # The viewer stands where the camera is and looks as it does.
                rows = self.join(h.greeting["link"], "--renderer", "mesh", "--myself",
                                 f"0=0:{CAMERA_Y}:-0.2,reach=2")
                self.assertEqual(rows[55][80], 0)
                self.assertAlmostEqual(rows[100][80], PERSON_MM, delta=10)
            with self.subTest("by the camera's name, too"):
                self.assertEqual(self.join(h.greeting["link"], "--renderer", "mesh", "--person",
                                           text.replace("0=", "person=", 1))[5][5], 0)

    def test_the_window_cuts_as_well(self):
        with VirtualScreen(480, 360) as screen, self.host() as h:
            def body_is_seen():
                # The body's colour in the middle tells that the picture is there.
                return screen.pixels(180, 200, 1, 1)[0][2] > 180

            def next_pixels():
                time.sleep(0.5)
                return screen.pixels(10, 20, 60, 60)

            def shown(*options):
                with Process("join", h.greeting["link"], "--name", "Wim", "--size", "480x360", "--renderer", "mesh", "--room", "off",
                             *options, env=screen.environment):
                    wait_until(body_is_seen)
                    # The screen is read while the window is drawn: twice the same is a whole picture.
                    pixels = screen.pixels(10, 20, 60, 60)
                    while (again := next_pixels()) != pixels:
                        pixels = again
                wait_until(lambda: not body_is_seen())  # the window is gone
                return pixels

            self.assertGreater(difference(shown(), shown("--person", "0=0:1.6:-1.4,yaw=180,reach=0.5")), 0.9)

    def test_what_cannot_be_understood_is_told_in_one_sentence(self):
        link = f"https://127.0.0.1:1/#join=x&cert={'0' * 64}"
        for option, value, says in (("--person", "0", "CAMERA=X:Y:Z"), ("--person", "0=1:2", "CAMERA=X:Y:Z"),
                                    ("--myself", "0=1:2:3:4", "CAMERA=X:Y:Z"), ("--person", "0=a:2:3", "CAMERA=X:Y:Z"),
                                    ("--person", "0=nan:2:3", "CAMERA=X:Y:Z"), ("--person", "=1:2:3", "CAMERA=X:Y:Z"),
                                    ("--myself", "0=1:2:3,yaw=up", "yaw"), ("--person", "0=1:2:3,reach=0", "reach"),
                                    ("--person", "0=1:2:3,size=2", "size")):
            with self.subTest(option=option, value=value):
                code, _, errors = run("join", link, "--offscreen", self.folder / "no.png", option, value)
                self.assertEqual(code, 1)
                self.assertEqual(len(errors.splitlines()), 1, errors)
                self.assertIn(says, errors)
        code, _, errors = run("join", link, "--offscreen", self.folder / "no.png", "--person", "0=1:2:3", "--myself",
                              "0=1:2:3")
        self.assertEqual(code, 1)
        self.assertIn("two people", errors)
        with self.host() as h:
            code, _, errors = run("join", h.greeting["link"], "--offscreen", self.folder / "no.png", "--person",
                                  "7=1:2:3")
            self.assertEqual(code, 1)
            self.assertIn("no camera '7'", errors)
            code, _, errors = run("join", h.greeting["link"], "--offscreen", self.folder / "far.png", "--person",
                                  "0=9:1.65:9", "--seconds", "0.5")
            self.assertEqual(code, 0, errors)
            self.assertIn("Camera 0 sees nothing within 1.1 m of the person", errors)


if __name__ == "__main__":
    unittest.main()
