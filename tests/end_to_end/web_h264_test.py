# SPDX-License-Identifier: Apache-2.0
"""Colour as H.264 in the page, by the browser's own decoders, and JPEG where they fail."""
import unittest

from page_case import PageCase

SIZE = (480, 270)
CAMERA = "theatron.state.cameras[0]"

# The browser's decoder refuses the pictures whose numbers, from 1, `fails` is true for.
FAILING = """(() => {
    const decode = VideoDecoder.prototype.decode;
    let count = 0;
    VideoDecoder.prototype.decode = function (chunk) {
        if ((%s)(++count))
            throw new DOMException("no", "EncodingError");
        decode.call(this, chunk);
    };
})()"""


class WebH264(PageCase):
    cameras = ("synthetic:seconds=2,fps=10,quality=quick,loop=1",)

    def enter(self, options, script=""):
        page = self.browser.open("about:blank", SIZE)
        if script:
            page.call("Page.addScriptToEvaluateOnNewDocument", source=script)
        page.call("Page.navigate", url=self.link + options)
        page.wait_for("location.protocol === 'https:'")
        # The 2D view costs the least.
        page.enter(way="flat")
        page.wait_for("theatron.state.phase === 'joined'")
        return page

    def assert_jpeg(self, page):
        """The page asks for JPEG of the usual quality; the host may send a lower one while the machine is busy."""
        self.assertEqual(page.evaluate("theatron.state.color.asked"), "jpeg:quality=85")
        self.assertTrue(page.evaluate(f"{CAMERA}.color").startswith("jpeg"))

    def test_chosen_by_the_link_it_comes_in_time_in_workers_and_in_the_page(self):
        for options in ("", "&decoding=page"):
            with self.subTest(options):
                page = self.enter("&color=h264" + options)
                page.wait_for(f"{CAMERA}?.color.startsWith('h264') && {CAMERA}.color_frames > 8")
                self.assertEqual(page.evaluate(f"{CAMERA}.decoder_failures"), 0)
                self.assertTrue(page.evaluate("theatron.state.color.is_chosen"))
                # Pictures are handed on with depth of the same moment.
                pictures = page.wait_for("theatron.state.has_picture && theatron.state.pictures")
                page.wait_for(f"theatron.state.pictures > {pictures + 1}")
                self.assertEqual(page.problems, [])
                self.leave(page)

    def test_by_itself_the_page_begins_with_jpeg_and_knows_that_it_could(self):
        page = self.enter("")
        page.wait_for(f"{CAMERA}?.color_frames > 3")
        self.assert_jpeg(page)
        self.assertTrue(page.evaluate("theatron.has_h264()"))
        self.assertIn("JPEG", page.evaluate("theatron.state.color.reason"))
        self.leave(page)

    def test_a_picture_that_the_decoder_loses_is_followed_by_a_key_frame(self):
        page = self.enter("&color=h264&decoding=page", FAILING % "n => n === 5")
        page.wait_for(f"{CAMERA}?.decoder_failures >= 1")
        frames = page.evaluate(f"{CAMERA}.color_frames")
        page.wait_for(f"{CAMERA}.color_frames > {frames + 4}")
        self.assertTrue(page.evaluate(f"{CAMERA}.color").startswith("h264"))
        self.leave(page)

    def test_a_decoder_that_fails_again_and_again_leads_to_jpeg(self):
        page = self.enter("&color=h264&decoding=page", FAILING % "n => n > 3")
        page.wait_for(f"{CAMERA}?.color.startsWith('jpeg')")
        self.assert_jpeg(page)
        self.assertEqual(page.evaluate("theatron.state.color.reason"), "JPEG: the browser's decoder failed with H.264")
        page.wait_for("document.getElementById('facts').textContent.includes('failed with H.264')")
        frames = page.evaluate(f"{CAMERA}.color_frames")
        page.wait_for(f"{CAMERA}.color_frames > {frames + 3}")
        self.leave(page)

    def test_a_browser_without_such_decoders_says_so(self):
        page = self.enter("&color=h264&decoding=page", "delete globalThis.VideoDecoder")
        page.wait_for(f"{CAMERA}?.color_frames > 3")
        self.assert_jpeg(page)
        self.assertIn("does not decode H.264", page.evaluate("theatron.state.color.reason"))
        self.leave(page)


if __name__ == "__main__":
    unittest.main()
