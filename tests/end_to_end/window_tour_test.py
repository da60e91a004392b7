# SPDX-License-Identifier: Apache-2.0
"""The window's tour for somebody who is here for the first time."""
import os
import pathlib
import shutil
import tempfile
import unittest

from theatron_process import Process, host, make_recording, wait_until, write_png
from virtual_screen import VirtualScreen, brightness

WIDTH, HEIGHT = 1280, 720
PICTURES = os.environ.get("THEATRON_PICTURES")  # a folder where pictures of the window stay
FRAME = (0x41, 0xb8, 0xff)  # blue, green, red of a notice with buttons


class WindowTour(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="theatron_tour_"))
        self.addCleanup(shutil.rmtree, self.folder)
        self.screen = VirtualScreen(WIDTH, HEIGHT)
        self.addCleanup(self.screen.__exit__)
        self.home = self.folder / "home"

    def window(self, link, *options, **more):
        environment = {**self.screen.environment, "XDG_STATE_HOME": str(self.home), "SDL_AUDIODRIVER": "dummy"}
        return Process("join", link, "--name", "Wim", "--size", f"{WIDTH}x{HEIGHT}", "--renderer", "splat", *options,
                       env=environment, **more)

    def kept(self):
        settings = self.home / "theatron/settings"
        return settings.read_text().splitlines() if settings.exists() else []

    def picture(self, name):
        if PICTURES:
            rows = self.screen.pixels(0, 0, WIDTH, HEIGHT)
            rgb = [b"".join(row[x + 2:x - 1 if x else None:-1] for x in range(0, 4 * WIDTH, 4)) for row in rows]
            write_png(pathlib.Path(PICTURES) / f"{name}.png", WIDTH, HEIGHT, 8, 3, rgb)

    def strip(self):
        """What stands above the picture."""
        return self.screen.pixels(200, 0, WIDTH - 400, 60)

    def test_it_comes_once_goes_on_step_by_step_and_is_found_again_behind_more(self):
        camera = f"folder:{make_recording(self.folder / 'box', frames=1)},loop=1,preload=1,place=0:1.5:0"
        drawn = lambda: brightness(self.screen.pixels(500, 200, 200, 100)) > 20
        with host(self.folder / "state", camera) as h:
            with self.window(h.greeting["link"], is_new=True):
                wait_until(drawn)
                self.screen.do("mousemove", 900, 600)
                wait_until(lambda: "tour_seen no" in self.kept())
                seen = []
                for step in (1, 2, 3):
                    wait_until(lambda: self.strip() not in seen and self.strip() != [])
                    seen.append(self.strip())
                    self.picture(f"window_tour_{step}")
                    self.assertIn("tour_seen no", self.kept())
                    # The last button is "Skip the tour"; the last step has "Done" alone.
                    for _ in range(2 if step < 3 else 1):
                        self.screen.do("key", "shift+Tab")
                    self.screen.do("key", "Return")
                wait_until(lambda: "tour_seen yes" in self.kept())
            with self.window(h.greeting["link"]):
                wait_until(drawn)
                self.screen.do("mousemove", 900, 600)
                with self.subTest("it is the last button of the last panel"):
                    self.screen.do("key", "shift+Tab", "key", "Return")
                    before = self.strip()
                    self.screen.do("key", "shift+Tab", "key", "Return")
                    wait_until(lambda: self.strip() != before)
                    self.picture("window_tour_again")

    def test_it_is_skipped_for_good(self):
        camera = f"folder:{make_recording(self.folder / 'box', frames=1)},loop=1,preload=1,place=0:1.5:0"
        with host(self.folder / "state", camera) as h, self.window(h.greeting["link"], is_new=True):
            wait_until(lambda: brightness(self.screen.pixels(500, 200, 200, 100)) > 20)
            wait_until(lambda: "tour_seen no" in self.kept())
            self.screen.do("key", "shift+Tab", "key", "Return")
            wait_until(lambda: "tour_seen yes" in self.kept())


if __name__ == "__main__":
    unittest.main()
