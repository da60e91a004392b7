# SPDX-License-Identifier: Apache-2.0
"""The page saves the picture that is seen, and the file says from when it is and whether it is live."""
import contextlib
import json
import os
import pathlib
import signal
import tempfile
import unittest

import patience
from browser import CHROMIUM, Browser
from theatron_process import PROGRAM, host, read_png

PAGE = pathlib.Path(PROGRAM).parent / "web/files.txt"
SIZE = (640, 360)
LINE_PX = 28
IMPORT = "import(performance.getEntriesByType('resource').find(({ name }) => name.includes('/saved.')).name)"


@unittest.skipUnless(CHROMIUM, "chromium is not installed: apt-get install chromium")
@unittest.skipUnless(PAGE.exists(), "there is no browser client: make build")
class WebSaved(unittest.TestCase):
    def save(self, page):
        page.open_sheet("more")
        page.evaluate("document.getElementById('save_picture').click()")
        page.open_sheet("")

    def saved(self, browser, page, known):
        self.save(page)
        new = lambda: [f for f in self.folder.glob("theatron-*.png") if f not in known and not list(self.folder.glob("*.crdownload"))]
        return patience.wait_until(new, "a file", of=browser)[0]

    def wait_until_called(self, page, is_live):
        """Saves until the name says so: on a busy machine a page is late for a while, and says so rightly. No file is made of
        these, since a browser stops a page that saves many by itself."""
        page.evaluate("globalThis.names = []; HTMLAnchorElement.prototype.click = function() { names.push(this.download); }")
        while page.evaluate("names.at(-1)?.includes('not-live') ?? null") != (not is_live):
            count = page.evaluate("names.length")
            self.save(page)
            page.wait_for(f"names.length > {count}")

    def test_what_is_called_live(self):
        with host(self.enterContext(tempfile.TemporaryDirectory()) + "/host", "synthetic:seconds=2,fps=10,quality=quick,loop=1") as served, \
                Browser() as browser:
            page = browser.open(served.greeting["link"], SIZE)
            page.wait_for("document.getElementById('enter')?.disabled === false")
            live = {"host": "OR 3", "age_ms": 1999, "is_not_live": False, "phase": "joined", "overlay": {"cover": ""}}

            def named(**changed):
                return page.evaluate(f"{IMPORT}.then(m => m.describe_picture({json.dumps(live | changed)}, new Date(0)).name)")

            self.assertEqual(named(), "theatron-1970-01-01T000000Z.png")
            for changed in ({"age_ms": 2000}, {"age_ms": None}, {"is_not_live": True}, {"phase": "lost"}, {"overlay": {"cover": "No picture for 5 s"}}):
                with self.subTest(changed):
                    self.assertEqual(named(**changed), "theatron-1970-01-01T000000Z-not-live.png")

    def test_a_live_picture_and_one_that_is_not(self):
        with contextlib.ExitStack() as stack:
            self.folder = pathlib.Path(stack.enter_context(tempfile.TemporaryDirectory()))
            served = stack.enter_context(host(self.folder / "host", "synthetic:seconds=2,fps=10,quality=quick,loop=1"))
            browser = stack.enter_context(Browser())
            browser.call("Browser.setDownloadBehavior", behavior="allow", downloadPath=str(self.folder))
            known, pages = [], {}
            for way in ("flat", "room"):
                with self.subTest(way):
                    page = browser.open(served.greeting["link"], SIZE)
                    page.enter(way=way)
                    page.wait_for("theatron.complete_ms !== null")
                    known.append(self.saved(browser, page, known))
                    width, height, _, rows = read_png(known[-1])
                    canvas = page.evaluate(f"(c => [c.width, c.height])(document.getElementById('{'flat' if way == 'flat' else 'view'}'))")
                    self.assertEqual([width, height], [canvas[0], canvas[1] + LINE_PX])
                    picture, line = (b"".join(bytes(row) for row in part) for part in (rows[:-LINE_PX], rows[-LINE_PX:]))
                    self.assertGreater(len(set(picture)), 50, "the picture is there")
                    self.assertGreater(line.count(255), 100, "so is the line")
                    pages[way] = page
                    # The room takes a computer without a graphics card too long for that.
                    if way == "flat":
                        self.wait_until_called(page, is_live=True)
            with self.subTest("a picture that stands still is called not live"):
                served.send(signal.SIGSTOP)
                try:
                    page.wait_for("theatron.state.overlay.cover !== ''")
                    self.wait_until_called(page, is_live=False)
                finally:
                    served.send(signal.SIGCONT)
            with self.subTest("of a host that was stopped no picture stays, and none is saved"):
                served.send(signal.SIGTERM)
                for page in pages.values():
                    page.wait_for("theatron.state.phase === 'lost' && theatron.state.cameras.length === 0")
                pages["flat"].wait_for("document.getElementById('flat').width === 1 && document.getElementById('save_picture').disabled")
                if folder := os.environ.get("THEATRON_PICTURES"):
                    for way, page in pages.items():
                        page.screenshot(pathlib.Path(folder) / f"web_saved_{way}.png")


if __name__ == "__main__":
    unittest.main()
