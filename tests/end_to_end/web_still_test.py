# SPDX-License-Identifier: Apache-2.0
"""A picture that is not live never looks live on the page: one that does not come, one that the page does not draw, and one of
a session that has ended."""
import base64
import contextlib
import pathlib
import signal
import tempfile
import threading
import unittest

import patience
from browser import CHROMIUM, Browser
from theatron_process import PROGRAM, host, read_png

PAGE = pathlib.Path(PROGRAM).parent / "web/files.txt"
GROUND = (24, 26, 30)  # of the cover


class Screencast:
    """What the browser shows, also while the page's own thread does nothing."""

    def __init__(self, page, folder):
        self.page, self.file = page, folder / "frame.png"
        self.frames = []
        on_event = page.on_event

        def listen(method, event):
            on_event(method, event)
            if method == "Page.screencastFrame":
                self.frames.append(event)
        page.on_event = listen
        page.call("Page.startScreencast", format="png")

    def covered(self):
        """True if a frame since the last call is the cover: nearly all of its ground, with letters."""
        frames, self.frames = self.frames, []
        for frame in frames:
            self.page.call("Page.screencastFrameAck", sessionId=frame["sessionId"])
            self.file.write_bytes(base64.b64decode(frame["data"]))
            width, height, channels, rows = read_png(self.file)
            pixels = [tuple(row[x:x + 3]) for row in rows for x in range(0, channels * width, channels)]
            if pixels.count(GROUND) > 0.85 * width * height and any(r > 200 and b < 120 for r, _, b in pixels):
                return True
        return False


@unittest.skipUnless(CHROMIUM, "chromium is not installed: apt-get install chromium")
@unittest.skipUnless(PAGE.exists(), "there is no browser client: make build")
class WebStill(unittest.TestCase):
    def setUp(self):
        stack = contextlib.ExitStack()
        self.addCleanup(stack.close)
        self.folder = pathlib.Path(stack.enter_context(tempfile.TemporaryDirectory()))
        self.host = stack.enter_context(host(self.folder / "host", "synthetic:seconds=2,fps=10,quality=quick,loop=1"))
        self.page = stack.enter_context(Browser()).open(self.host.greeting["link"])

    def enter(self, way, page=None):
        page = page or self.page
        page.enter(way=way)
        page.wait_for("theatron.state.has_picture && theatron.first_picture_ms !== null")

    def is_covered(self):
        return "getComputedStyle(document.getElementById('still')).display !== 'none'"

    def test_a_picture_that_does_not_come_is_covered_with_its_age(self):
        for way in ("room", "flat"):
            with self.subTest(way):
                self.enter(way)
                self.page.wait_for(f"!({self.is_covered()})")
                self.host.send(signal.SIGSTOP)
                try:
                    self.page.wait_for("theatron.state.overlay.cover.startsWith('No picture for ') && " + self.is_covered())
                    self.page.wait_for("document.getElementById('still').textContent === theatron.state.overlay.cover")
                finally:
                    self.host.send(signal.SIGCONT)
                self.page.wait_for(f"theatron.state.phase === 'joined' && !({self.is_covered()})")
                self.page.evaluate("document.getElementById('leave').click()")
                self.page.wait_for("theatron.state.phase === 'left'")

    def test_a_page_that_hangs_is_covered_by_the_browser(self):
        self.enter("flat")
        screen = Screencast(self.page, self.folder)
        # A busy machine may need longer, so each try hangs longer than the one before.
        seconds = 5

        def hang():
            self.page.evaluate(f"(end => {{ while (performance.now() < end); }})(performance.now() + {1000 * seconds})")

        wait = patience.Wait("the cover of a page that hangs")
        is_covered = False
        while not is_covered:
            wait.check()
            hanging = threading.Thread(target=hang)
            hanging.start()
            while hanging.is_alive():
                is_covered = screen.covered() or is_covered
                hanging.join(0.1)
            seconds *= 2
        self.page.wait_for("theatron.state.phase === 'joined'")
        patience.wait_until(lambda: self.page.evaluate("getComputedStyle(document.getElementById('hung')).opacity") == "0",
                            "a page that is seen again")

    def test_nothing_of_a_session_stays_after_its_end(self):
        pages = {"room": self.page, "flat": self.page.browser.open(self.host.greeting["link"])}
        for way, page in pages.items():
            self.enter(way, page)
        self.host.send(signal.SIGINT)
        for way, page in pages.items():
            with self.subTest(way):
                page.wait_for("document.getElementById('problem').textContent.includes('Nothing of it is shown any more')")
                self.assertEqual(page.evaluate("theatron.state.phase"), "left")
                self.assertEqual(page.evaluate("""['view', 'flat', 'session_picture'].map(id => document.getElementById(id))
                    .filter(({ width, height }) => width * height > 1).map(({ id }) => id)"""), [])
                self.assertEqual(page.evaluate("""[...document.querySelectorAll('canvas, #panels, #still, #hung')]
                    .filter(element => element.checkVisibility()).map(({ id }) => id)"""), [])


if __name__ == "__main__":
    unittest.main()
