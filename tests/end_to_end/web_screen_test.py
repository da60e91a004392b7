# SPDX-License-Identifier: Apache-2.0
"""A screen that the browser's page shows, here one that Chromium generates, is a screen in everybody's room, also while the page is hidden."""
import contextlib
import os
import pathlib
import tempfile
import unittest

from browser import CHROMIUM, Browser
from theatron_process import PROGRAM, Process, host

PAGE = pathlib.Path(PROGRAM).parent / "web/files.txt"
CHOOSES = ("--use-fake-device-for-media-stream", "--use-fake-ui-for-media-stream", "--auto-select-desktop-capture-source=Entire screen")


def screens(figures):
    return [c for c in figures["cameras"] if "Screen of" in c["name"]]


@unittest.skipUnless(CHROMIUM, "chromium is not installed: apt-get install chromium")
@unittest.skipUnless(PAGE.exists(), "there is no browser client: make build")
class WebScreen(unittest.TestCase):
    def setUp(self):
        self.stack = contextlib.ExitStack()
        self.addCleanup(self.stack.close)
        self.folder = pathlib.Path(self.stack.enter_context(tempfile.TemporaryDirectory()))
        self.host = self.stack.enter_context(host(self.folder / "host"))

    def enter(self, browser, way):
        page = browser.open(self.host.greeting["link"], (1280, 720))
        page.enter(way=way)
        page.wait_for("theatron.state.phase === 'joined'")
        return page

    def native(self, link, name):
        return self.stack.enter_context(
            Process("join", link, "--name", name, "--no-window", "--every", "0.2",
                    env={**os.environ, "XDG_STATE_HOME": str(self.folder / name)}))

    def share(self, page):
        page.open_sheet("more")
        page.wait_for("!document.getElementById('share_screen').hidden")
        page.click("#share_screen")
        page.wait_for("theatron.screen.state === 'on' && !document.getElementById('own_screen').hidden")

    def test_an_experts_screen_is_seen_by_all_and_ended_by_either(self):
        browser = self.stack.enter_context(Browser(*CHOOSES))
        ben = self.native(self.host.greeting["link"], "Ben")
        for way in ("room", "flat"):
            with self.subTest(way):
                page = self.enter(browser, way)
                self.share(page)
                ben.wait_for(lambda f: screens(f) and screens(f)[0]["frames"] > 5)
                page.wait_for("theatron.state.screen.is_taken")
                # A page that is behind the window that it shows goes on.
                window = browser.call("Browser.getWindowForTarget", targetId=page.target)["windowId"]
                browser.call("Browser.setWindowBounds", windowId=window, bounds={"windowState": "minimized"})
                page.wait_for("document.visibilityState === 'hidden'")
                before = ben.wait_for(screens)
                ben.wait_for(lambda f: screens(f)[0]["frames"] > screens(before)[0]["frames"] + 10)
                browser.call("Browser.setWindowBounds", windowId=window, bounds={"windowState": "normal"})
                page.wait_for("document.visibilityState === 'visible'")
                if folder := os.environ.get("THEATRON_PICTURES"):
                    page.screenshot(pathlib.Path(folder) / f"web_screen_{way}.png")
                page.click("#end_own_screen")
                ben.wait_for(lambda f: not screens(f))
                self.assertEqual(page.evaluate("[theatron.screen.state, theatron.screen.stream]"), ["off", None])
                self.assertEqual(page.problems, [])
                page.close()

    def test_an_operator_ends_it_for_all(self):
        browser = self.stack.enter_context(Browser(*CHOOSES))
        page = self.enter(browser, "room")
        chief = self.native(self.host.greeting["links"]["operator"], "Chief")
        self.share(page)
        seen = chief.wait_for(lambda f: [o for o in f["room"]["objects"] if "screen" in o and o["screen"]["camera"] is not None])
        number = next(o["id"] for o in seen["room"]["objects"] if "screen" in o)
        chief.say(f"end {number}")
        chief.wait_for(lambda f: not screens(f))
        page.wait_for("theatron.screen.state === 'off' && document.getElementById('own_screen').hidden")
        self.assertEqual(page.evaluate("theatron.state.phase"), "joined")
        with self.subTest("whoever becomes an observer shows none"):
            self.share(page)
            chief.wait_for(screens)
            chief.say("role Ada observer")
            chief.wait_for(lambda f: not screens(f))
            page.wait_for("theatron.screen.state === 'off' && document.getElementById('share_screen').hidden")

    def test_others_are_offered_the_way_to_it(self):
        browser = self.stack.enter_context(Browser(*CHOOSES))
        ada, eva = self.enter(browser, "room"), self.enter(browser, "flat")
        self.share(ada)
        offer = "document.getElementById('shared_screen').textContent"
        with self.subTest("in the 2D view its picture comes"):
            eva.wait_for(f"{offer}.includes('Ada shares a screen: ')")
            self.assertEqual(ada.evaluate(offer), "", "one's own is not offered")
            eva.click("#shared_screen button")
            eva.wait_for(f"theatron.state.flat_camera.includes('Screen of Ada') && {offer} === ''")
        with self.subTest("in the room one stands before it, and what lay over it is closed"):
            mia = self.enter(browser, "room")
            mia.wait_for(f"{offer}.includes('Ada shares a screen: ')")
            mia.open_sheet("people")
            before = mia.evaluate("theatron.state.ear.position")
            mia.wait_for("!!document.querySelector('#room_panels [data-leads-away]')")
            if folder := os.environ.get("THEATRON_PICTURES"):
                mia.screenshot(pathlib.Path(folder) / "web_screen_offer.png")
            mia.wait_for("[...document.querySelectorAll('#room_panels button')].some(b => b.textContent === 'Show' && (b.click(), true))")
            mia.wait_for(f"theatron.sheet.name === '' && JSON.stringify(theatron.state.ear.position) !== '{before}'.replaceAll(' ', '') && {offer} === ''")
            # The screen hangs upright at a free place, and so does the one who looks at it.
            self.assertGreater(mia.evaluate("theatron.state.ear.up[1]"), 0.99)
            self.assertGreater(mia.evaluate("theatron.state.ear.position[1]"), 1)
        with self.subTest("whoever does not want it is not asked again"):
            kim = self.enter(browser, "room")
            kim.wait_for(f"{offer}.includes('Ada shares a screen: ')")
            kim.click("#shared_screen button:last-child")
            kim.wait_for(f"{offer} === ''")
        for page in (ada, eva, mia, kim):
            self.assertEqual(page.problems, [])

    def test_without_a_choice_nothing_is_shown_and_the_page_says_so(self):
        browser = self.stack.enter_context(Browser())
        page = self.enter(browser, "room")
        # A browser answers so where the person closes its question; Chromium without a window asks none.
        page.evaluate("navigator.mediaDevices.getDisplayMedia = () => Promise.reject(new DOMException('', 'NotAllowedError'))")
        page.open_sheet("more")
        page.wait_for("!document.getElementById('share_screen').hidden")
        page.click("#share_screen")
        page.wait_for("document.getElementById('share_hint').textContent.includes('No screen is shown')")
        self.assertEqual(page.evaluate("theatron.screen.stream"), None)


if __name__ == "__main__":
    unittest.main()
