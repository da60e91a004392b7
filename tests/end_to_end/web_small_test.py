# SPDX-License-Identifier: Apache-2.0
"""The page on a computer without a graphics card, without WebGL, and 300 pixels wide."""
import contextlib
import os
import pathlib
import tempfile
import unittest

from browser import CHROMIUM, Browser
from theatron_process import PROGRAM, Process, host, wait_until

PAGE = pathlib.Path(PROGRAM).parent / "web/files.txt"
PICTURES = os.environ.get("THEATRON_PICTURES")  # a folder where pictures of the page stay
CAMERAS = [f"synthetic:seconds=2,fps=10,quality=quick,camera={i},loop=1" for i in (0, 1)]
# The number of colours that the 2D view shows, of some of its pixels.
COLORS = """(() => {
    const { width, height } = document.getElementById("flat");
    const copy = Object.assign(document.createElement("canvas"), { width, height })
        .getContext("2d", { willReadFrequently: true });
    copy.drawImage(document.getElementById("flat"), 0, 0);
    const { data } = copy.getImageData(0, 0, width, height);
    const seen = new Set();
    for (let i = 0; i < data.length; i += 4 * 97)
        seen.add(data[i] << 16 | data[i + 1] << 8 | data[i + 2]);
    return seen.size;
})()"""
# Elements that reach beyond the page's sides.
BESIDE = """[...document.querySelectorAll("button, input, select, p, h1, h2, li, code, label")].filter(e =>
    e.checkVisibility({ checkVisibilityCSS: true }) && e.textContent !== "" &&
    (e.getBoundingClientRect().left < 0 || e.getBoundingClientRect().right > innerWidth + 0.5))
    .map(e => e.id || e.textContent)"""

# Elements that lie over the corners and the middle of the 2D view's picture, which fills the canvas in one direction.
COVERED = """(() => {
    const canvas = document.getElementById("flat"), box = canvas.getBoundingClientRect();
    const scale = Math.min(box.width / canvas.width, box.height / canvas.height);
    const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
    const [w, h] = [canvas.width * scale / 2 - 2, canvas.height * scale / 2 - 2];
    return [[0, 0], [-w, -h], [w, -h], [-w, h], [w, h]].map(([dx, dy]) => document.elementFromPoint(x + dx, y + dy))
        .filter(e => e !== canvas).map(e => e?.id || e?.outerHTML || "nothing");
})()"""


@unittest.skipUnless(CHROMIUM, "chromium is not installed: apt-get install chromium")
@unittest.skipUnless(PAGE.exists(), "there is no browser client: make build")
class WebSmall(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.stack = contextlib.ExitStack()
        folder = pathlib.Path(cls.stack.enter_context(tempfile.TemporaryDirectory()))
        cls.host = cls.stack.enter_context(host(folder / "host", *CAMERAS))
        cls.link = cls.host.greeting["link"]

    @classmethod
    def tearDownClass(cls):
        cls.stack.close()

    def open(self, browser, size=(640, 360)):
        page = browser.open(self.link, size)
        page.wait_for("!!document.getElementById('invitation')?.textContent")
        return page

    def enter(self, page, way="auto"):
        page.enter(way=way)
        page.wait_for("theatron.complete_ms !== null")

    def picture(self, page, name):
        if PICTURES:
            page.screenshot(pathlib.Path(PICTURES) / f"{name}.png")

    def test_without_a_graphics_card_it_says_so_and_shows_a_camera_where_the_room_is_too_slow(self):
        with Browser() as browser:
            page = self.open(browser)
            self.assertEqual(page.evaluate("theatron.graphics"), "processor")
            self.assertIn("no graphics card", page.evaluate("document.getElementById('graphics_hint').innerText"))
            page.evaluate("theatron.Patience.slowest_per_s = 1e6; theatron.Patience.longest_ms = 500")
            self.enter(page)
            page.wait_for("theatron.state.renderer === 'flat' && theatron.state.has_picture")
            page.wait_for("document.getElementById('drawing_text').textContent.includes('too slowly')")
            self.assertGreater(page.wait_for(f"{COLORS} > 20 && {COLORS}"), 20)
            self.picture(page, "flat")
            # Five pictures a second are its choice, and no panel covers them.
            page.wait_for("theatron.state.drawn_per_second > 0 && theatron.state.overlay.warning === ''")
            self.assertEqual(page.evaluate(COVERED), [])
            # The choice is the person's; then nothing changes by itself.
            page.evaluate("document.getElementById('other_way').click()")
            page.wait_for("theatron.state.renderer === 'mesh' && theatron.state.pictures > 3")
            self.assertEqual(page.evaluate("theatron.way"), "room")
            self.picture(page, "room_without_card")
            self.assertEqual(page.problems, [])

    def test_without_webgl_one_sees_each_camera_and_is_seen_to_be_there(self):
        with Browser("--disable-3d-apis") as browser, Process("join", self.link, "--name", "Ben", "--every", "0.2") as ben:
            page = self.open(browser)
            self.assertEqual(page.evaluate("theatron.graphics"), "none")
            self.enter(page)
            first = page.wait_for("theatron.state.flat_camera")
            page.wait_for(f"{COLORS} > 20")
            page.wait_for("theatron.state.overlay.facts.some(f => f.label === 'Age of picture' && /^\\d+ (ms|s)$/.test(f.value))")
            self.assertTrue(page.evaluate("document.getElementById('other_way').hidden"))
            page.evaluate("document.getElementById('next_camera').click()")
            page.wait_for(f"theatron.state.flat_camera && theatron.state.flat_camera !== '{first}'")
            ben.wait_for(lambda f: {p["name"] for p in f["room"]["people"]} == {"Ada", "Ben"})
            pictures = page.evaluate("theatron.state.pictures")
            page.wait_for(f"theatron.state.pictures > {pictures + 2}")
            page.evaluate("document.getElementById('leave').click()")
            page.wait_for("theatron.state.phase === 'left'")

    def test_the_2d_view_gets_the_colour_of_its_camera_alone(self):
        def came(page, at_least=20):
            """Frames of each camera's depth and colour, until `at_least` frames of one of them have come."""
            counts = "theatron.state.cameras.map(({ depth_frames, color_frames }) => [depth_frames, color_frames])"
            before = page.evaluate(counts)
            after = page.wait_for(f"(counts => counts.flat().some((count, i) => count >= {[n + at_least for both in before for n in both]}[i]) && counts)"
                                  f"({counts})")
            return [[b - a for a, b in zip(*both)] for both in zip(before, after)]

        with Browser() as browser:
            page = self.open(browser)
            self.enter(page, "flat")
            shown = page.wait_for("theatron.state.flat_camera")
            wait_until(lambda: [bool(sum(frames)) for frames in came(page)] == [True, False])
            first, second = came(page)
            self.assertEqual((first[0], second), (0, [0, 0]))
            self.assertGreater(first[1], 0)
            # The other camera instead.
            page.evaluate("document.getElementById('next_camera').click()")
            page.wait_for(f"theatron.state.flat_camera && theatron.state.flat_camera !== '{shown}'")
            wait_until(lambda: [bool(sum(frames)) for frames in came(page)] == [False, True])
            self.assertIn("not sent", page.evaluate("document.getElementById('camera_list').textContent"))
            page.evaluate("document.getElementById('other_way').click()")
            page.wait_for("theatron.state.renderer !== 'flat' && theatron.state.cameras.every(c => c.depth_frames > 0 && c.color_frames > 0)")
            self.assertEqual(page.problems, [])

    def test_300_pixels_are_enough(self):
        with Browser() as browser:
            page = self.open(browser, (300, 560))
            self.assertEqual(page.evaluate(BESIDE), [])
            self.picture(page, "small_lobby")
            self.enter(page, "room")
            self.assertEqual(page.evaluate(BESIDE), [])
            self.picture(page, "small_room")
            # No panel is open: the room is seen and reached.
            self.assertEqual(page.evaluate("document.elementFromPoint(150, 250).id"), "view")
            for name in ("people", "case", "more", "details", "picture"):
                page.open_sheet(name)
                self.assertEqual(page.evaluate(BESIDE), [], name)
                self.picture(page, f"small_{name}")
            page.evaluate("document.getElementById('show_help').click()")
            self.assertEqual(page.evaluate(BESIDE), [])
            self.picture(page, "small_help")


if __name__ == "__main__":
    unittest.main()
