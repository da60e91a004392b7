# SPDX-License-Identifier: Apache-2.0
"""An operator nudges a camera and draws its region with keys and mouse; another participant sees it."""
import pathlib
import shutil
import tempfile
import time
import unittest

from theatron_process import Process, host, make_recording, wait_until
from virtual_screen import VirtualScreen, brightness

WIDTH, HEIGHT = 960, 600
KNOB = bytes((255, 205, 140))


class AdjustWindow(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="theatron_adjust_window_"))
        self.addCleanup(shutil.rmtree, self.folder)
        self.screen = VirtualScreen(WIDTH, HEIGHT)
        self.addCleanup(self.screen.__exit__)

    def window(self, link, *options):
        return Process("join", link, "--name", "Olga", "--size", f"{WIDTH}x{HEIGHT}", "--renderer", "splat",
                       "--render-scale", "0.5", *options, env=self.screen.environment)

    def wait_for_scene(self):
        wait_until(lambda: self.screen.title().startswith("operating room"))
        wait_until(lambda: brightness(self.screen.pixels(500, 200, 200, 100)) > 30)

    def knob(self):
        """Middle of the first slider's knob."""
        rows = self.screen.pixels(0, 0, WIDTH // 2, HEIGHT - 100)
        for y, row in enumerate(rows):
            run = 0
            for x in range(WIDTH // 2):
                run = run + 1 if row[4 * x:4 * x + 3] == KNOB else 0
                if run == 8:
                    return x - 4, y + 3
        return None

    def test_keys_sliders_and_a_rectangle_act_for_all(self):
        do = self.screen.do
        camera = f"folder:{make_recording(self.folder / 'box', frames=1)},loop=1,preload=1,place=0:1.6:0"
        with host(self.folder / "state", camera, options=("--filter", "off")) as h, \
                self.window(h.greeting["links"]["operator"]), \
                Process("join", h.greeting["link"], "--every", "0.1") as other:
            def wait(condition):
                return other.wait_for(lambda f: f["cameras"] and condition(f["cameras"][0]))["cameras"][0]

            def at(x):
                return wait(lambda c: abs(c["position"][0] - x) < 1e-5)

            at(0)
            self.wait_for_scene()
            with self.subTest("arrow keys, undo and reset"):
                do("key", "F6")
                wait_until(self.knob)
                # A camera without a turn looks along -z, so right is x.
                do("key", "Right", "key", "Right")
                at(0.01)
                undo, registered, draw = wait_until(
                    lambda: len(b := self.screen.buttons(WIDTH // 2, HEIGHT - 100)) >= 3 and b[-3:])
                do("mousemove", *undo, "click", 1)
                at(0.005)
                do("mousemove", *registered, "click", 1)
                at(0)
            with self.subTest("a slider is dragged"):
                x, y = wait_until(self.knob)
                do("mousemove", x, y, "mousedown", 1, "mousemove", x + 20, y, "mousemove", x + 40, y, "mouseup", 1)
                moved = wait(lambda c: c["position"][0] > 0.05)
                self.assertLess(moved["position"][0], 0.2)
                do("mousemove", *undo, "click", 1)
                at(0)
            with self.subTest("a region is drawn, and taken back"):
                do("mousemove", *draw, "click", 1)
                time.sleep(0.6)
                do("mousemove", 560, 250, "mousedown", 1)
                for place in ((600, 300), (760, 400)):
                    time.sleep(0.3)
                    do("mousemove", *place)
                time.sleep(0.3)
                do("mouseup", 1)
                drawn = wait(lambda c: c["filter"].startswith("region:"))
                self.assertIn("depth only in", drawn["adjusted"])
                do("mousemove", *undo, "click", 1)
                wait(lambda c: not c["filter"])

    def test_the_bar_plays_the_recording_for_all(self):
        do = self.screen.do
        recording = self.folder / "a.mkv"
        frames = make_recording(self.folder / "box", frames=60)
        Process("record", "--camera", f"folder:{frames},fps=20,preload=1", recording).end()
        with host(self.folder / "state", f"recording:{recording},loop=1") as h, self.window(h.greeting["link"]), \
                Process("join", h.greeting["link"], "--every", "0.1") as other:
            def wait(condition):
                return other.wait_for(lambda f: f["playback"] and condition(f["playback"]))["playback"]

            wait(lambda p: p["length_s"] > 2.5)
            self.wait_for_scene()
            do("key", "F5")
            before = wait(lambda p: p["paused"])["position_s"]
            do("key", "comma")
            wait(lambda p: p["position_s"] == max(before - 5, 0))
            do("key", "period")
            wait(lambda p: p["position_s"] > 2.5)
            do("key", "F5")
            wait(lambda p: not p["paused"])


if __name__ == "__main__":
    unittest.main()
