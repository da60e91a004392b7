# SPDX-License-Identifier: Apache-2.0
"""The page draws, and both eyes of a headset in it see, the native client's pictures from the same places."""
import contextlib
import json
import os
import pathlib
import struct
import tempfile
import unittest

from browser import CHROMIUM, Browser
from pictures import differences, pixels_of, psnr
from theatron_process import PROGRAM, host, make_recording, read_png, run, wait_until, write_png

PAGE = pathlib.Path(PROGRAM).parent / "web/files.txt"
PICTURES = os.environ.get("THEATRON_PICTURES")  # a folder where all pictures stay
HERE = pathlib.Path(__file__).parent
IWER = HERE / "node_modules/iwer/build/iwer.min.js"
WIDTH, HEIGHT = 320, 180  # of the page; each eye has half the width
EYE_DISTANCE_M = 0.064    # as in headset.js
EYE = (0, 1.6, 6)         # looks along -z, level; the table is further away than what cameras measure
AHEAD = [0, 1, 0, 0]      # a camera's rotation (y down, z forward) that does so
COLOR = "jpeg:quality=85"


def lens(width, height, focal_length):
    return {"width": width, "height": height, "fx": focal_length, "fy": focal_length, "cx": (width - 1) / 2, "cy": (height - 1) / 2}


def viewpoint(folder, model, place):
    """A camera that measures nothing: its place and lens are those of a view."""
    (folder / "depth").mkdir(parents=True)
    rows = [struct.pack(f">{model['width']}H", *[0] * model["width"])] * model["height"]
    write_png(folder / "depth/00000.png", model["width"], model["height"], 16, 1, rows)
    (folder / "calibration.json").write_text(json.dumps(
        {"depth": model, "room_from_camera": {"quaternion": AHEAD, "translation": place}}))


def still_cloud(folder):
    """A wall with a box before it, right of the view's middle, turned 40 degrees to the right."""
    make_recording(folder, frames=1)
    model = lens(160, 120, 130)
    (folder / "calibration.json").write_text(json.dumps({"depth": model, "color": model, "room_from_camera": {
        "quaternion": [0, 0.9396926, 0, 0.3420201], "translation": [0.9, 1.6, 3.4]}}))


def changed(pixels, change):
    return [[change(color) for color in row] for row in pixels]


@unittest.skipUnless(CHROMIUM, "chromium is not installed: apt-get install chromium")
@unittest.skipUnless(PAGE.exists(), "there is no browser client: make build")
@unittest.skipUnless(IWER.exists(), "iwer is not installed: npm ci --prefix tests/end_to_end")
class WebPicture(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.stack = contextlib.ExitStack()
        cls.folder = pathlib.Path(cls.stack.enter_context(tempfile.TemporaryDirectory()))
        eye = lens(WIDTH // 2, HEIGHT, HEIGHT / 2)  # 90 degrees high
        x, y, z = EYE
        viewpoint(cls.folder / "view", lens(WIDTH, HEIGHT, 230), EYE)
        viewpoint(cls.folder / "left", eye, (x - EYE_DISTANCE_M / 2, y, z))
        viewpoint(cls.folder / "right", eye, (x + EYE_DISTANCE_M / 2, y, z))
        still_cloud(cls.folder / "s")
        cameras = [f"folder:{cls.folder / name},loop=1,preload=1,fps=5" for name in ("view", "left", "right", "s")]
        cls.host = cls.stack.enter_context(host(cls.folder / "host", *cameras))
        # Fewer points are drawn with no renderer that somebody chose.
        cls.host.say("renderer all mesh lock")
        cls.link = cls.host.greeting["link"]
        cls.native = {name: cls.native_picture(name, camera, width) for name, camera, width in
                      (("view", 0, WIDTH), ("left", 1, WIDTH // 2), ("right", 2, WIDTH // 2))}

    @classmethod
    def tearDownClass(cls):
        cls.stack.close()

    @classmethod
    def native_picture(cls, name, camera, width, *options):
        file = pathlib.Path(PICTURES or cls.folder) / f"native_{name}.png"
        code, _, errors = run("join", cls.link, "--offscreen", file, "--view", f"camera:{camera}", "--size", f"{width}x{HEIGHT}",
                              "--color-codec", COLOR, "--seconds", "0.5", *options)
        assert code == 0, errors
        return pixels_of(read_png(file))

    def expect(self, page, name, views):
        """Waits until the page's picture is the native one in these places: [(view, left, width)]. The room is made bit by bit."""
        file = pathlib.Path(PICTURES or self.folder) / f"page_{name}.png"
        found = {}

        def likeness():
            page.screenshot(file)
            picture = read_png(file)
            shown = {view: pixels_of(picture, left, width) for view, left, width in views}
            found.update({view: differences(pixels, self.native[view]) for view, pixels in shown.items()})
            return None if any(found.values()) else {view: psnr(pixels, self.native[view]) for view, pixels in shown.items()}

        try:
            return wait_until(likeness, f"the page's picture '{name}' like the native one", every=0.2)
        except AssertionError as vain:
            self.fail(f"{vain}; {found}; {page.problems}; {page.evaluate('JSON.stringify(theatron.state)')}")

    def test_page_and_headset_show_the_native_pictures(self):
        with Browser() as browser:
            page = browser.open("about:blank", (WIDTH, HEIGHT))
            for file in (IWER, HERE / "headset.js"):
                page.call("Page.addScriptToEvaluateOnNewDocument", source=file.read_text())
            page.call("Page.navigate", url=self.link + f"&color={COLOR}&scale=1")
            page.enter(way="room")
            page.wait_for("theatron.state.has_picture && theatron.state.renderer === 'mesh'")
            page.press("b", "KeyB")  # no ages in the room
            page.evaluate("document.getElementById('panels').style.visibility = 'hidden'")
            with self.subTest("page"):
                self.expect(page, "view", [("view", 0, WIDTH)])
            page.evaluate("for (const side of ['left', 'right']) simulated_headset.device.controllers[side].connected = false")
            page.evaluate("document.getElementById('enter_vr').click()")
            page.wait_for("theatron.headset.is_on")
            with self.subTest("headset"):
                half = WIDTH // 2
                self.expect(page, "headset", [("left", 0, half), ("right", half, half)])
            self.assertEqual(page.problems, [])

    def test_the_comparison_tells_what_may_go_wrong(self):
        for name, wanted in self.native.items():
            faults = {
                "mirrored": [row[::-1] for row in wanted],
                "upside down": wanted[::-1],
                "red for blue": changed(wanted, lambda color: color[::-1]),
                "another gamma": changed(wanted, lambda color: tuple(round(255 * (c / 255) ** (1 / 1.1)) for c in color)),
                "a pixel aside": [row[1:] + row[:1] for row in wanted],
            }
            for fault, picture in faults.items():
                with self.subTest(view=name, fault=fault):
                    self.assertNotEqual(differences(picture, wanted), [])
            self.assertEqual(differences(wanted, wanted), [])
        self.assertNotEqual(differences(self.native["left"], self.native["right"]), [])
        bare = self.native_picture("bare", 0, WIDTH, "--room", "off")
        self.assertNotEqual(differences(bare, self.native["view"]), [])


if __name__ == "__main__":
    unittest.main()
