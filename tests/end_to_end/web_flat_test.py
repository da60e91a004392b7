# SPDX-License-Identifier: Apache-2.0
"""The 2D view as an equal: point, draw and measure on a camera's plain picture, and see what others point at and draw."""
import contextlib
import json
import os
import pathlib
import tempfile
import unittest

from browser import CHROMIUM, Browser
from marks_test import marks
from room_test import member
from theatron_process import PROGRAM, host, make_recording

PAGE = pathlib.Path(PROGRAM).parent / "web/files.txt"
PICTURES = os.environ.get("THEATRON_PICTURES")  # a folder where pictures of the page stay
SIZE = (900, 620)
# make_recording(): a box at 0.9 m in these columns and rows, before a wall; the camera is at (0, 1.3, 1) and looks along -z.
BOX_COLUMNS, BOX_ROWS, BOX_M, FOCAL = (20, 60), (40, 90), 0.9, 130
# Where something lies over the picture, in shares of it; null: nowhere.
DRAWN = """(() => {
    const canvas = document.getElementById('flat_marks'), { width, height } = canvas;
    if (width < 2)
        return null;
    const copy = new OffscreenCanvas(width, height).getContext('2d', { willReadFrequently: true });
    copy.drawImage(canvas, 0, 0);
    const { data } = copy.getImageData(0, 0, width, height);
    let count = 0, left = width, right = 0, top = height, below = 0;
    for (let i = 3; i < data.length; i += 4)
        if (data[i] > 127) {
            const at = (i - 3) / 4, x = at % width, y = Math.floor(at / width);
            ++count;
            [left, right, top, below] = [Math.min(left, x), Math.max(right, x), Math.min(top, y), Math.max(below, y)];
        }
    return count ? { count, left: left / width, right: right / width, top: top / height, below: below / height } : null;
})()"""


def in_room(column, row, depth_m=BOX_M):
    """The place of a pixel of make_recording()."""
    return [(column - 80) / FOCAL * depth_m, 1.3 - (row - 60) / FOCAL * depth_m, 1 - depth_m]


def apart(a, b):
    return sum((p - q) ** 2 for p, q in zip(a, b)) ** 0.5


@unittest.skipUnless(CHROMIUM, "chromium is not installed: apt-get install chromium")
@unittest.skipUnless(PAGE.exists(), "there is no browser client: make build")
class WebFlat(unittest.TestCase):
    def setUp(self):
        self.stack = contextlib.ExitStack()
        self.addCleanup(self.stack.close)
        folder = pathlib.Path(self.stack.enter_context(tempfile.TemporaryDirectory()))
        recording = make_recording(folder / "box", frames=1)
        lens = {"width": 160, "height": 120, "fx": FOCAL, "fy": FOCAL, "cx": 80, "cy": 60}
        pose = {"quaternion": [0, 1, 0, 0], "translation": [0, 1.3, 1]}
        (recording / "calibration.json").write_text(json.dumps({"depth": lens, "color": lens, "room_from_camera": pose}))
        self.host = self.stack.enter_context(host(folder / "host", f"folder:{recording},loop=1,preload=1"))
        self.link = self.host.greeting["link"]
        self.browser = self.stack.enter_context(Browser())

    def open(self, name, size=SIZE):
        page = self.browser.open(self.link, size)
        page.enter(name, way="flat")
        page.wait_for("theatron.state.has_picture && theatron.state.overlay && document.getElementById('flat').width > 1")
        return page

    def at(self, page, column, row):
        """The middle of a pixel of the camera, in pixels of the page."""
        box = page.evaluate("import(performance.getEntriesByType('resource').find(({ name }) => name.includes('/flat_marks.')).name)"
                            ".then(m => m.picture_box(document.getElementById('flat')))")
        return (box["left"] + (column + 0.5) / 160 * box["width"], box["top"] + (row + 0.5) / 120 * box["height"])

    def click(self, page, selector):
        page.evaluate(f"document.querySelector('{selector}').click()")

    def choose(self, page, tool):
        """A tool of the panel."""
        page.wait_for(f"[...document.querySelectorAll('#room_panels button')].find(b => b.textContent === '{tool}')?.click() ?? "
                      f"[...document.querySelectorAll('#room_panels button')].some(b => b.textContent === '{tool}' && b.ariaPressed === 'true')")

    def drag(self, page, begin, end, steps=8):
        page.mouse("mousePressed", *begin)
        for i in range(1, steps + 1):
            self.moved(page, *(a + (b - a) * i / steps for a, b in zip(begin, end)))
        page.mouse("mouseReleased", *end)

    def moved(self, page, x, y, button="left"):
        """Once a step of the page has seen it."""
        page.mouse("mouseMoved", x, y, button=button)
        page.evaluate("new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)))")

    def tap(self, page, place):
        self.moved(page, *place, button="none")
        page.mouse("mousePressed", *place)
        page.mouse("mouseReleased", *place)
        self.moved(page, *place, button="none")

    def with_depth(self, page):
        """Once another picture of depth has come."""
        before = page.evaluate("theatron.state.cameras[0].depth_frames")
        page.wait_for(f"theatron.state.cameras[0].depth_frames > {before}")

    def test_point_draw_and_measure(self):
        ben = self.stack.enter_context(member(self.link, "Ben"))
        ada, eva = self.open("Ada"), self.open("Eva", (500, 620))
        self.assertEqual(ada.evaluate("theatron.state.cameras[0].depth_frames"), 0, "nobody needs the depth yet")
        points = lambda f: [p["name"] for p in f["room"]["people"] if p["points"]]
        with self.subTest("the mouse points, and another 2D view shows where and who"):
            self.click(ada, "#point")
            self.moved(ada, *self.at(ada, 40, 65), button="none")
            self.with_depth(ada)
            self.moved(ada, *self.at(ada, 40, 64), button="none")
            ben.wait_for(lambda f: points(f) == ["Ada"])
            seen = eva.wait_for(DRAWN)
            # A dot at the place, and beside it the name.
            self.assertTrue(seen["left"] < 40.5 / 160 < seen["right"] and seen["top"] < 64.5 / 120 < seen["below"], seen)
            self.assertLess(seen["right"] - seen["left"], 0.3)
            if PICTURES:
                ada.screenshot(pathlib.Path(PICTURES) / "flat_point.png")
                eva.screenshot(pathlib.Path(PICTURES) / "flat_pointed_at.png")
        with self.subTest("drawing ends pointing, and a stroke lies on the box"):
            self.click(ada, "#draw")
            ben.wait_for(lambda f: not points(f))
            ada.wait_for("document.getElementById('point').ariaPressed === 'false' && theatron.sheet.name === 'draw'")
            self.with_depth(ada)
            self.drag(ada, self.at(ada, 26, 60), self.at(ada, 54, 60))
            stroke = marks(ben.wait_for(lambda f: len(marks(f)) == 1))[0]
            self.assertEqual((stroke["kind"], stroke["surface"], stroke["initials"]), ("stroke", "cloud", "A"))
            self.assertLess(apart(stroke["points"][0], in_room(26, 60)), 0.008, stroke)
            self.assertLess(apart(stroke["points"][-1], in_room(54, 60)), 0.008, stroke)
        with self.subTest("the others see it where it is"):
            eva.wait_for(f"(seen => seen && Math.abs(seen.left - 26.5 / 160) < 0.02 && seen.right > 54 / 160)({DRAWN})")
            if PICTURES:
                ada.screenshot(pathlib.Path(PICTURES) / "flat_stroke.png")
        with self.subTest("a click draws nothing and is told how to draw"):
            self.tap(ada, self.at(ada, 40, 70))
            ada.wait_for("document.getElementById('notice').textContent.includes('Draw with the button held down')")
        with self.subTest("two clicks measure"):
            self.choose(ada, "Distance")
            self.tap(ada, self.at(ada, 26, 80))
            ada.wait_for("document.getElementById('notice').textContent.includes('other end')")
            self.tap(ada, self.at(ada, 54, 80))
            distance = marks(ben.wait_for(lambda f: len(marks(f)) == 2))[1]
            self.assertEqual(distance["kind"], "distance")
            ada.wait_for("!document.getElementById('notice').textContent.includes('other end')")
            self.assertAlmostEqual(distance["length_m"], 28 / FOCAL * BOX_M, delta=0.008)
            self.assertGreater(distance["deviation_m"], 0)
            if PICTURES:
                ada.screenshot(pathlib.Path(PICTURES) / "flat_distance.png")
        with self.subTest("Escape gives up what is drawn, and nothing else"):
            self.tap(ada, self.at(ada, 26, 75))
            ada.wait_for("theatron.state.draws && document.getElementById('notice').textContent.includes('other end')")
            ada.evaluate("document.getElementById('flat').focus()")
            ada.press("Escape", "Escape")
            ada.wait_for("!theatron.state.draws && !document.getElementById('notice').textContent.includes('other end')")
            self.assertEqual(ada.evaluate("theatron.sheet.name"), "draw")
        with self.subTest("two clicks within one picture are two clicks"):
            begin, end = self.at(ada, 26, 70), self.at(ada, 54, 70)
            for place in (begin, end):
                ada.mouse("mouseMoved", *place, button="none")
                ada.mouse("mousePressed", *place)
                ada.mouse("mouseReleased", *place)
            quick = marks(ben.wait_for(lambda f: len(marks(f)) == 3))[2]
            self.assertAlmostEqual(quick["length_m"], 28 / FOCAL * BOX_M, delta=0.008)
            ada.press("Backspace", "Backspace")
            ben.wait_for(lambda f: len(marks(f)) == 2)
        with self.subTest("a saved picture has what lies over it"):
            copied = ada.evaluate("(async () => { let copied; const own = HTMLCanvasElement.prototype.toBlob;"
                                  "HTMLCanvasElement.prototype.toBlob = function(done) { copied = this; done(null); };"
                                  "document.getElementById('save_picture').click(); HTMLCanvasElement.prototype.toBlob = own;"
                                  "const { width } = copied, row = copied.getContext('2d').getImageData(0, 60, width, 1).data;"
                                  "return { width, own: document.getElementById('flat').getContext('2d').getImageData(40, 60, 1, 1).data,"
                                  "    copy: row.slice(160, 164) }; })()")
            self.assertEqual(copied["width"], 160)
            self.assertNotEqual(copied["own"], copied["copy"], "the stroke is there")
        with self.subTest("a key takes the newest back, and another one puts the tools away"):
            ada.evaluate("document.getElementById('flat').focus()")
            ada.press("Backspace", "Backspace")
            ben.wait_for(lambda f: len(marks(f)) == 1)
            ada.press("z", "KeyZ")
            ada.wait_for("theatron.sheet.name === '' && document.getElementById('draw').ariaPressed === 'false'")
        with self.subTest("the depth comes no more"):
            ada.wait_for("(async () => { const frames = () => theatron.state.cameras[0].depth_frames, before = frames();"
                         "await new Promise(done => setTimeout(done, 1000)); return frames() === before; })()")
        self.assertEqual((ada.problems, eva.problems), ([], []))

    def test_the_room_is_there_where_the_view_changes_under_a_held_button(self):
        page = self.open("Ada")
        x, y = self.at(page, 40, 60)
        page.mouse("mousePressed", x, y)
        self.moved(page, x + 20, y)
        page.evaluate("document.getElementById('other_way').click()")
        for i in range(6):
            self.moved(page, x + 30 + i, y)
        page.wait_for("theatron.way === 'room' && theatron.state.pictures > 2")
        self.moved(page, x + 50, y)
        page.mouse("mouseReleased", x + 50, y)
        ear = page.evaluate("theatron.state.ear")
        self.assertNotIn(None, ear["position"] + ear["ahead"] + ear["up"], ear)

    def test_marks_do_not_lie_over_a_screen(self):
        with Browser("--use-fake-device-for-media-stream", "--use-fake-ui-for-media-stream",
                     "--auto-select-desktop-capture-source=Entire screen") as sharing:
            self.browser = sharing
            ada = self.open("Ada")
            self.click(ada, "#draw")
            self.with_depth(ada)
            self.drag(ada, self.at(ada, 26, 60), self.at(ada, 54, 60))
            ada.wait_for(DRAWN)
            eva = self.open("Eva")
            eva.wait_for(DRAWN)
            ada.open_sheet("more")
            ada.wait_for("!document.getElementById('share_screen').hidden")
            ada.click("#share_screen")
            eva.wait_for("document.getElementById('shared_screen').textContent.includes('Ada shares a screen')")
            eva.click("#shared_screen button")
            eva.wait_for(f"theatron.state.flat_camera.includes('Screen of Ada') && {DRAWN} === null")
            self.click(eva, "#next_camera")
            eva.wait_for(f"!theatron.state.flat_camera.includes('Screen of Ada') && {DRAWN} !== null")

    def test_a_finger_points_and_draws(self):
        ben = self.stack.enter_context(member(self.link, "Ben"))
        page = self.browser.open("about:blank", (390, 844))
        page.call("Emulation.setTouchEmulationEnabled", enabled=True, maxTouchPoints=5)
        page.call("Page.navigate", url=self.link)
        page.enter("Ada", way="flat")
        page.wait_for("theatron.state.has_picture && document.getElementById('flat').width > 1")
        points = lambda f: [p["name"] for p in f["room"]["people"] if p["points"]]
        for button in ("point", "draw"):
            self.assertTrue(page.evaluate(f"document.getElementById('{button}').checkVisibility()"))
        self.click(page, "#point")
        page.wait_for("document.getElementById('notice').textContent.includes('Hold a finger')")
        self.with_depth(page)
        page.touch("touchStart", self.at(page, 40, 65))
        page.touch("touchMove", self.at(page, 42, 66))
        ben.wait_for(lambda f: points(f) == ["Ada"])
        page.touch("touchEnd")
        ben.wait_for(lambda f: not points(f))
        self.click(page, "#draw")
        page.wait_for("document.getElementById('point').ariaPressed === 'false'")
        self.with_depth(page)
        begin, end = self.at(page, 26, 60), self.at(page, 54, 60)
        page.touch("touchStart", begin)
        for i in range(1, 9):
            page.touch("touchMove", tuple(a + (b - a) * i / 8 for a, b in zip(begin, end)))
            page.evaluate("new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)))")
        page.touch("touchEnd")
        stroke = marks(ben.wait_for(lambda f: len(marks(f)) == 1))[0]
        self.assertLess(apart(stroke["points"][-1], in_room(54, 60)), 0.01, stroke)
        with self.subTest("lengths are short on a small picture"):
            self.choose(page, "Distance")
            for place in (self.at(page, 26, 80), self.at(page, 54, 80)):
                page.touch("touchStart", place)
                page.touch("touchEnd")
            ben.wait_for(lambda f: len(marks(f)) == 2)
            page.wait_for("/(^|; )\\d+ ± \\d+ mm(;|$)/.test(document.getElementById('flat_marks').dataset.labels)")
        if PICTURES:
            page.screenshot(pathlib.Path(PICTURES) / "flat_phone.png")
        self.assertEqual(page.problems, [])


if __name__ == "__main__":
    unittest.main()
