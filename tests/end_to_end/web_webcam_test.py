# SPDX-License-Identifier: Apache-2.0
"""A webcam in the browser's page, here Chromium's generated one, is seen by a native participant, and the other way."""
import contextlib
import os
import pathlib
import tempfile
import unittest

from browser import CHROMIUM, Browser
from theatron_process import PROGRAM, Process, host, run

PAGE = pathlib.Path(PROGRAM).parent / "web/files.txt"
SIZE = (640, 360)


def faces(figures):
    return [c for c in figures["cameras"] if c["name"] == "face"]


@unittest.skipUnless(CHROMIUM, "chromium is not installed: apt-get install chromium")
@unittest.skipUnless(PAGE.exists(), "there is no browser client: make build")
class WebWebcam(unittest.TestCase):
    def setUp(self):
        self.stack = contextlib.ExitStack()
        self.addCleanup(self.stack.close)
        self.folder = pathlib.Path(self.stack.enter_context(tempfile.TemporaryDirectory()))
        self.host = self.stack.enter_context(host(self.folder / "host"))
        self.link = self.host.greeting["link"]

    def enter(self, browser, shows_face):
        page = browser.open(self.link, SIZE)
        page.wait_for("document.readyState === 'complete' && !!document.getElementById('invitation')?.textContent")
        self.assertFalse(page.evaluate("document.getElementById('shows_face').checked"), "off by default")
        page.evaluate("document.getElementById('name').value = 'Ada'; document.getElementById('way').value = 'room';"
                      f"document.getElementById('shows_face').checked = {'true' if shows_face else 'false'};"
                      "document.getElementById('enter').click()")
        page.wait_for("theatron.state.phase === 'joined'")
        return page

    def native(self, *options):
        return self.stack.enter_context(
            Process("join", self.link, "--name", "Ben", "--every", "0.2", *options,
                    env={**os.environ, "XDG_STATE_HOME": str(self.folder / "home")}))

    def test_page_and_native_participant_see_each_other(self):
        browser = self.stack.enter_context(Browser("--use-fake-device-for-media-stream", "--use-fake-ui-for-media-stream"))
        ben = self.native("--webcam", "test")
        page = self.enter(browser, True)
        page.wait_for("theatron.face.state === 'on' && !document.getElementById('own_face').hidden")
        seen = ben.wait_for(lambda f: faces(f) and faces(f)[0]["frames"] > 10)
        # 10 pictures in each second of the session at most; those of a second may wait.
        later = ben.wait_for(lambda f: faces(f) and faces(f)[0]["frames"] > 40)
        passed_s = (later["session_us"] - seen["session_us"]) / 1e6
        self.assertLess(faces(later)[0]["frames"] - faces(seen)[0]["frames"], 10 * (passed_s + 1))
        page.wait_for("theatron.state.overlay.facts.some(fact => fact.label === 'Webcam' && fact.value === 'you are seen')")
        self.assertEqual(page.evaluate("theatron.state.cameras.length"), 0)  # faces are people
        # Both stand before each other, and a native picture has the generated video's colours.
        ear = page.wait_for("theatron.state.ear")
        (x, y, z), ahead = ear["position"], ear["ahead"]
        ben.say(" ".join(["stand"] + [f"{v:.3f}" for v in (x + ahead[0], y, z + ahead[2], x, y, z)]))
        page.wait_for("theatron.state.people.some(person => !person.self && person.head)")
        if folder := os.environ.get("THEATRON_PICTURES"):
            page.wait_for("theatron.state.pictures > 20")
            page.screenshot(pathlib.Path(folder) / "web_webcam.png")
            run("join", self.link, "--offscreen", pathlib.Path(folder) / "web_webcam_native.png", "--size", "640x360", "--seconds", "2")
        with self.subTest("hidden by the person, it is gone for all"):
            page.evaluate("document.getElementById('hide_face').click()")
            ben.wait_for(lambda f: not faces(f))
            self.assertIsNone(page.evaluate("theatron.face.stream"))
            page.wait_for("document.getElementById('own_face').hidden")
        with self.subTest("the panel of people shows it again"):
            page.evaluate("document.getElementById('webcam').click()")
            ben.wait_for(lambda f: faces(f) and faces(f)[0]["frames"] > 3)
        self.assertEqual(page.problems, [])

    def test_without_a_webcam_the_page_is_in_the_room_and_says_what_to_do(self):
        browser = self.stack.enter_context(Browser("--use-fake-device-for-media-stream"))
        browser.call("Browser.setPermission", permission={"name": "camera"}, setting="denied")
        page = self.enter(browser, True)
        page.wait_for("document.getElementById('face_hint').textContent.includes('Allow it')")
        self.assertEqual(page.evaluate("theatron.state.phase"), "joined")
        self.assertEqual(page.evaluate("theatron.face.state"), "denied")
        self.assertIn("Allow it", page.evaluate("theatron.state.face_problem"))


if __name__ == "__main__":
    unittest.main()
