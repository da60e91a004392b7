# SPDX-License-Identifier: Apache-2.0
"""The window's tour for somebody who is here for the first time."""
import os
import pathlib
import shutil
import tempfile
import unittest

from theatron_process import Process, host, make_recording, wait_until
from virtual_screen import VirtualScreen, brightness
from window_bar_test import BUTTON

WIDTH, HEIGHT = 1280, 720
PICTURES = os.environ.get("THEATRON_PICTURES")  # a folder where pictures of the window stay


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
            self.screen.save(pathlib.Path(PICTURES) / f"{name}.png", WIDTH, HEIGHT)

    def edge(self):
        """Where the orange frame of a notice with buttons begins, above the picture; nothing without one."""
        row = self.screen.pixels(0, 35, WIDTH, 1)[0]
        return next((x for x in range(WIDTH) if row[4 * x + 1] - row[4 * x] > 60 and row[4 * x + 2] > 150), None)

    def test_it_comes_once_goes_on_step_by_step_and_is_found_again_behind_more(self):
        camera = f"folder:{make_recording(self.folder / 'box', frames=1)},loop=1,preload=1,place=0:1.5:0"
        drawn = lambda: brightness(self.screen.pixels(500, 200, 200, 100)) > 20
        with host(self.folder / "state", camera) as h:
            with self.window(h.greeting["link"], is_new=True):
                wait_until(drawn)
                self.screen.do("mousemove", 900, 600)
                wait_until(lambda: "tour_seen no" in self.kept())
                # "Next" stands before the last button. The keyboard stays there, where each step has its button that goes on.
                wait_until(self.edge)
                self.screen.do("key", "shift+Tab", "key", "shift+Tab")
                seen = [None]
                for step in (1, 2, 3):
                    wait_until(lambda: self.edge() not in seen)
                    seen.append(self.edge())
                    self.picture(f"window_tour_{step}")
                    self.assertIn("tour_seen no", self.kept())
                    self.screen.do("key", "Return")
                wait_until(lambda: self.edge() is None)
                wait_until(lambda: "tour_seen yes" in self.kept())
            with self.window(h.greeting["link"]):
                wait_until(drawn)
                self.screen.do("mousemove", 900, 600)
                self.assertIsNone(self.edge())
                with self.subTest("it is the last button of the last panel"):
                    self.screen.do("key", "shift+Tab", "key", "Return")
                    wait_until(lambda: self.screen.has(BUTTON, 400, 10, 10, 340, 600))
                    self.screen.do("key", "Escape", "key", "shift+Tab", "key", "Return")  # Esc takes the keyboard from "More"
                    self.assertEqual(wait_until(self.edge), seen[1])
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
