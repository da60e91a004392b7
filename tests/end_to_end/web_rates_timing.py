# SPDX-License-Identifier: Apache-2.0
"""Bits a second that the page takes, on a machine that does nothing else: medians of three (make test-timing)."""
import pathlib
import tempfile
import time
import unittest

from browser import CHROMIUM, Browser
from rates_timing import median_of_three
from theatron_process import PROGRAM, host
from web_small_test import CAMERAS

PAGE = pathlib.Path(PROGRAM).parent / "web/files.txt"
SECONDS = 3
FLAT_CEILING_BITS_PER_S = 2e6


@unittest.skipUnless(CHROMIUM, "chromium is not installed: apt-get install chromium")
@unittest.skipUnless(PAGE.exists(), "there is no browser client: make build")
class WebRates(unittest.TestCase):
    def test_the_2d_view_takes_less_than_its_ceiling_and_less_than_the_room(self):
        def bits_per_s():
            before, begin = page.socket_bytes, time.monotonic()
            time.sleep(SECONDS)
            return 8 * (page.socket_bytes - before) / (time.monotonic() - begin)

        with host(self.enterContext(tempfile.TemporaryDirectory()) + "/host", *CAMERAS) as served, Browser() as browser:
            page = browser.open(served.greeting["link"], (640, 360))
            page.enter(way="flat")
            page.wait_for("theatron.complete_ms !== null && theatron.state.flat_camera")
            flat = median_of_three(bits_per_s)
            self.assertGreater(flat, 0)
            self.assertLess(flat, FLAT_CEILING_BITS_PER_S)
            page.evaluate("document.getElementById('other_way').click()")
            page.wait_for("theatron.state.renderer !== 'flat' && theatron.state.cameras.every(c => c.depth_frames > 0 && c.color_frames > 0)")
            self.assertLess(flat, median_of_three(bits_per_s))


if __name__ == "__main__":
    unittest.main()
