# SPDX-License-Identifier: Apache-2.0
"""The page under fingers: orbit, pinch, walk, point, go to a place, and an object that one finger holds and another gives."""
import contextlib
import os
import pathlib
import re
import tempfile
import unittest

from browser import CHROMIUM, Browser
from theatron_process import PROGRAM, Process, host

PAGE = pathlib.Path(PROGRAM).parent / "web/files.txt"
PICTURES = os.environ.get("THEATRON_PICTURES")  # a folder where pictures of the page stay
CAMERA = "synthetic:seconds=2,fps=5,quality=quick,loop=1"
SIZE = (1024, 600)
MIDDLE = (SIZE[0] * 0.5, SIZE[1] * 0.55)
# "press L", "F8 allows", "Esc: leave", "Space: live again", "People (P)"
KEYS = re.compile(r"\b(press [A-Z]\b|F\d+|Esc\b|Space:|Home\b|Shift\b|Enter\b)|\([A-Z]\)")


def distance(a, b):
    return sum((p - q) ** 2 for p, q in zip(a, b)) ** 0.5


@unittest.skipUnless(CHROMIUM, "chromium is not installed: apt-get install chromium")
@unittest.skipUnless(PAGE.exists(), "there is no browser client: make build")
class WebTouch(unittest.TestCase):
    def setUp(self):
        self.stack = contextlib.ExitStack()
        self.addCleanup(self.stack.close)
        folder = pathlib.Path(self.stack.enter_context(tempfile.TemporaryDirectory()))
        self.host = self.stack.enter_context(host(folder / "host", CAMERA))
        self.link = self.host.greeting["link"]
        self.browser = self.stack.enter_context(Browser())

    def open(self, size=SIZE, is_coarse=True):
        page = self.browser.open("about:blank", size)
        if is_coarse:
            page.call("Emulation.setTouchEmulationEnabled", enabled=True, maxTouchPoints=5)
        page.call("Page.navigate", url=self.link)
        page.enter("Ada", way="room")
        page.wait_for("theatron.complete_ms !== null && theatron.state.pictures > 2")
        return page

    def ear(self, page):
        return page.evaluate("theatron.state.ear")

    def drawn(self, page, more=6):
        """Once the picture follows what was done before: each press and each release is a picture of its own."""
        done = page.evaluate("theatron.state.pictures")
        page.wait_for(f"theatron.state.pictures > {done + more}")

    def drag(self, page, *ways, steps=5):
        """Fingers from their first to their last place."""
        page.touch("touchStart", *(begin for begin, _ in ways))
        for i in range(1, steps + 1):
            page.touch("touchMove", *(tuple(a + (b - a) * i / steps for a, b in zip(*way)) for way in ways))
        page.touch("touchEnd")
        self.drawn(page)

    def tap(self, page, selector):
        page.touch("touchStart", page.middle(selector))
        page.touch("touchEnd")

    def tap_more(self, page, key):
        """A button behind "More"."""
        self.tap(page, "#show_more")
        page.wait_for("document.getElementById('more').checkVisibility()")
        self.tap(page, f"#more [data-key={key}]")
        self.tap(page, "#close_sheet")
        page.wait_for("document.getElementById('sheet').hidden")

    def moved(self, page, before, least_m=0.05):
        return page.wait_for("(() => { const p = theatron.state.ear.position;"
                             f"return Math.hypot(p[0] - {before[0]}, p[1] - {before[1]}, p[2] - {before[2]}) > {least_m} && p; }})()")

    def test_fingers_do_what_mouse_and_keys_do(self):
        ben = self.stack.enter_context(Process("join", self.link, "--name", "Ben", "--every", "0.2"))
        page = self.open()
        page.wait_for("document.getElementById('touch').checkVisibility()")
        if PICTURES:
            page.screenshot(pathlib.Path(PICTURES) / "touch.png")
        x, y = MIDDLE
        with self.subTest("one finger orbits"):
            before = self.ear(page)
            self.drag(page, (MIDDLE, (x + 150, y)))
            self.moved(page, before["position"])
            page.wait_for(f"theatron.state.ear.ahead.some((v, i) => Math.abs(v - {before['ahead']}[i]) > 0.1)")
        with self.subTest("two fingers spread come closer"):
            before = self.ear(page)
            self.drag(page, ((x - 50, y), (x - 150, y)), ((x + 50, y), (x + 150, y)))
            at = self.moved(page, before["position"])
            ahead = sum((q - p) * a for p, q, a in zip(before["position"], at, before["ahead"]))
            self.assertGreater(ahead, 0.03)
        with self.subTest("a button walks while it is held, and no longer"):
            before = self.ear(page)
            page.touch("touchStart", page.middle("[data-walk=\"0 0 -1\"]"))
            at = self.moved(page, before["position"], 0.2)
            self.assertLess(sum((q - p) * a for p, q, a in zip(before["position"], at, before["ahead"])), -0.1)
            page.touch("touchEnd")
            self.drawn(page)
            stands = self.ear(page)["position"]
            page.evaluate("new Promise(done => setTimeout(done, 700))")
            self.assertLess(distance(stands, self.ear(page)["position"]), 0.02)
        with self.subTest("point: a finger shows a place to the others"):
            points = lambda f: [p["name"] for p in f["room"]["people"] if p["points"]]
            self.tap(page, "[data-tool=points]")
            self.assertEqual(page.evaluate("document.querySelector('[data-tool=points]').getAttribute('aria-pressed')"), "true")
            before = self.ear(page)
            page.touch("touchStart", MIDDLE)
            page.touch("touchMove", (x + 20, y))
            ben.wait_for(lambda f: points(f) == ["Ada"])
            page.touch("touchEnd")
            ben.wait_for(lambda f: not points(f))
            self.assertLess(distance(before["position"], self.ear(page)["position"]), 0.01, "it turned the picture, too")
        with self.subTest("one either points or draws"):
            pressed = lambda *buttons: [page.evaluate(f"document.querySelector('{b}').ariaPressed") for b in buttons]
            self.tap(page, "#draw")
            page.wait_for("document.querySelector('#draw').ariaPressed === 'true' && document.querySelector('[data-tool=points]').ariaPressed === 'false'")
            self.tap(page, "[data-tool=points]")
            page.wait_for("document.querySelector('#draw').ariaPressed === 'false'")
            self.assertEqual(pressed("[data-tool=points]"), ["true"])
            self.tap(page, "[data-tool=points]")
            self.assertEqual(pressed("[data-tool=points]"), ["false"])
        with self.subTest("a finger holds an object, another one removes it"):
            self.tap_more(page, "r")
            self.drawn(page)
            self.tap_more(page, "n")
            bricks = lambda f: [o for o in f["room"]["objects"] if o["kind"] == "brick"]
            ben.wait_for(bricks)
            page.wait_for("theatron.state.bricks === 1")
            self.drawn(page)
            at = (SIZE[0] / 2, SIZE[1] * 0.57)  # as in web_test.py
            page.touch("touchStart", at)
            ben.wait_for(lambda f: bricks(f)[0]["held_by"] != 0)
            page.touch("touchStart", at, page.middle("[data-key=delete]"))
            ben.wait_for(lambda f: not bricks(f))
            page.touch("touchEnd")
        with self.subTest("go to a place"):
            self.tap_more(page, "r")
            self.drawn(page)
            before = self.ear(page)["position"]
            for share in ((0.5, 0.3), (0.5, 0.75), (0.4, 0.5), (0.62, 0.85), (0.8, 0.3), (0.35, 0.15)):  # some of it is free floor
                self.tap(page, "[data-tool=teleports]")
                page.touch("touchStart", (SIZE[0] * share[0], SIZE[1] * share[1]))
                self.drawn(page, 2)
                page.touch("touchEnd")
                self.assertEqual(page.evaluate("document.querySelector('[data-tool=teleports]').ariaPressed"), "false")
                self.drawn(page, 2)
                if distance(self.ear(page)["position"], before) > 0.3:
                    break
            else:
                self.fail("no finger went anywhere")
        with self.subTest("no text names a key"):
            self.tap(page, "#show_more")
            page.wait_for("document.getElementById('show_help').checkVisibility()")
            page.evaluate("document.getElementById('show_help').click()")
            page.wait_for("document.getElementById('help').open")
            self.assertIn("Two fingers", page.evaluate("document.getElementById('help').innerText"))
            lines = page.evaluate("document.body.innerText").splitlines()
            text = "\n".join(line for line in lines if line != "Home")  # a button's name
            self.assertIsNone(KEYS.search(text), text)
            page.evaluate("document.getElementById('help').close(); theatron.sheet.close()")
            self.assertNotIn("Help", page.evaluate("document.getElementById('facts').textContent"))
        with self.subTest("a panel comes and goes by touch"):
            for shown in (True, False):
                self.tap(page, "#show_people")
                page.wait_for(f"document.getElementById('sheet').checkVisibility() === {str(shown).lower()}")
        self.assertEqual(page.problems, [])

    def test_buttons_come_with_the_first_touch_and_fit_on_a_telephone(self):
        page = self.open((320, 560), is_coarse=False)
        self.assertFalse(page.evaluate("document.getElementById('touch').checkVisibility()"))
        page.touch("touchStart", (160, 250))
        page.touch("touchEnd")
        page.wait_for("document.getElementById('touch').checkVisibility()")
        beside = page.evaluate("[...document.querySelectorAll('#touch button')].map(b => b.getBoundingClientRect())"
                               ".filter(({ left, right, top }) => left < 0 || right > innerWidth || top < 200).length")
        self.assertEqual(beside, 0)
        if PICTURES:
            page.screenshot(pathlib.Path(PICTURES) / "touch_small.png")


if __name__ == "__main__":
    unittest.main()
