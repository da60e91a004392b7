# SPDX-License-Identifier: Apache-2.0
"""A page whose link freezes, or whose computer sleeps: it says so, and comes back to the newest frame."""
import contextlib
import pathlib
import signal
import tempfile
import time
import unittest

from browser import CHROMIUM, Browser
from theatron_process import PROGRAM, host, wait_until

PAGE = pathlib.Path(PROGRAM).parent / "web/files.txt"
# Both clocks of the page, which a test can set forward instead of waiting.
CLOCKS = """globalThis.steady_ahead = globalThis.wall_ahead = 0;
(() => {
    const steady = performance.now.bind(performance), wall = Date.now;
    performance.now = () => steady() + steady_ahead;
    Date.now = () => wall() + wall_ahead;
})();"""


@unittest.skipUnless(CHROMIUM, "chromium is not installed: apt-get install chromium")
@unittest.skipUnless(PAGE.exists(), "there is no browser client: make build")
class WebLoss(unittest.TestCase):
    def test_a_frozen_link_and_a_sleep_end_in_the_newest_frame(self):
        with contextlib.ExitStack() as stack:
            folder = pathlib.Path(stack.enter_context(tempfile.TemporaryDirectory()))
            running = stack.enter_context(host(folder / "host", "synthetic:seconds=2,fps=10,quality=quick,loop=1"))
            page = stack.enter_context(Browser()).open("about:blank", (480, 270))
            page.call("Page.addScriptToEvaluateOnNewDocument", source=CLOCKS)
            page.call("Page.navigate", url=running.greeting["link"] + "&decoding=page")  # workers have clocks of their own
            # On a busy machine the page would go over to the 2D view by itself.
            page.enter(way="room")
            page.wait_for("theatron.complete_ms !== null")

            # Nothing closes the connection; the host only says nothing any more.
            running.send(signal.SIGSTOP)
            time.sleep(1.5)
            self.assertEqual(page.evaluate("theatron.state.phase"), "joined")
            # On a busy machine the page asks its first unanswered question only after the first step.
            wait_until(lambda: page.evaluate("theatron.state.phase === 'lost' || (steady_ahead = wall_ahead += 31000, false)"),
                       "a page that notices the silence", every=3)
            # A later attempt may have another reason already.
            self.assertRegex(page.evaluate("theatron.state.problem"), "silent|No host answers")
            running.send(signal.SIGCONT)
            self.back(page, joins=2)

            # The steady clock of many machines stands still while they sleep.
            page.evaluate("wall_ahead += 3600000")
            self.back(page, joins=3)

    def back(self, page, joins):
        page.wait_for(f"theatron.state.phase === 'joined' && theatron.state.joins === {joins}")
        frames = page.evaluate("theatron.state.cameras[0]?.depth_frames ?? 0")
        page.wait_for(f"theatron.state.cameras[0]?.depth_frames > {frames} && theatron.state.cameras[0].age_ms !== null && theatron.state.cameras[0].age_ms < 1000")


if __name__ == "__main__":
    unittest.main()
