# SPDX-License-Identifier: Apache-2.0
"""The bar of buttons at the bottom of the window, with the mouse and with the keyboard alone."""
import pathlib
import shutil
import subprocess
import tempfile
import unittest

from theatron_process import Process, host, make_recording, wait_until
from virtual_screen import VirtualScreen, brightness

WIDTH, HEIGHT = 1280, 720
ALARM, GOOD, PRESSED, BUTTON = (255, 112, 96), (84, 204, 128), (30, 84, 138), (52, 66, 84)


class WindowBar(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="theatron_bar_"))
        self.addCleanup(shutil.rmtree, self.folder)
        self.screen = VirtualScreen(WIDTH, HEIGHT)
        self.addCleanup(self.screen.__exit__)

    def tool(self, number, of=8):
        """The middle of a button of the bar, as src/xr/tool_bar.cpp places it for texts of 18 pixels."""
        width = min(int(5.4 * 18), WIDTH // (of + 1))
        return (WIDTH - of * width) // 2 + number * width + width // 2, HEIGHT - 29

    def tool_has(self, number, color):
        x, y = self.tool(number)
        return self.screen.has(color, 12, x - 45, y - 27, 90, 54)

    def click(self, number):
        self.screen.do("mousemove", *self.tool(number), "click", 1, "mousemove", 900, 300)

    def test_microphone_people_and_leave_are_found_with_the_mouse_and_more_with_the_keyboard(self):
        camera = f"folder:{make_recording(self.folder / 'box', frames=1)},loop=1,preload=1,place=0:1.5:0"
        environment = {**self.screen.environment, "XDG_STATE_HOME": str(self.folder / "home"), "SDL_AUDIODRIVER": "dummy"}
        panel = lambda: self.screen.has(BUTTON, 400, 10, 10, 340, 600)
        with host(self.folder / "state", camera) as h, \
                Process("join", h.greeting["link"], "--name", "Ada", "--every", "0.2") as ada, \
                Process("join", h.greeting["link"], "--name", "Wim", "--size", f"{WIDTH}x{HEIGHT}", "--renderer", "splat",
                        env=environment) as window:
            ada.wait_for(lambda f: any(p["name"] == "Wim" for p in f["room"]["people"]))
            wait_until(lambda: brightness(self.screen.pixels(500, 200, 200, 100)) > 20)
            with self.subTest("nobody hears a person without a microphone, and the bar says so until a click opens it"):
                wait_until(lambda: self.tool_has(0, ALARM))
                self.click(0)
                wait_until(lambda: self.tool_has(0, PRESSED) and not self.tool_has(0, ALARM))
                self.click(0)
                wait_until(lambda: self.tool_has(0, ALARM) and not self.tool_has(0, PRESSED))
            with self.subTest("people: one panel, which the same button closes"):
                self.assertFalse(panel())
                self.click(5)
                wait_until(lambda: panel() and self.tool_has(5, PRESSED))
                self.click(7)
                wait_until(lambda: self.tool_has(7, PRESSED) and not self.tool_has(5, PRESSED))
                self.click(7)
                wait_until(lambda: not panel())
            with self.subTest("the last button, and the first one of its panel, by the keyboard alone"):
                self.screen.do("key", "shift+Tab", "key", "Return")
                wait_until(panel)
                self.screen.do("key", "Tab", "key", "space")
                wait_until(lambda: not panel())
                self.screen.do("key", "F1", "key", "Escape")
            with self.subTest("leaving asks once more"):
                self.click(6)
                wait_until(lambda: self.tool_has(6, ALARM))
                self.assertIsNone(window.process.poll())
                # Ends with the notice; a second press in time leaves.
                wait_until(lambda: not self.tool_has(6, ALARM))
                x, y = self.tool(6)
                self.screen.do("mousemove", x, y, "click", 1, "click", 1)
                self.assertEqual(window.end(), 0, "".join(window.errors))

    def test_on_an_azerty_keyboard_w_opens_the_tools_for_drawing_and_z_which_flies_does_not(self):
        subprocess.run(["setxkbmap", "fr"], env=self.screen.environment, check=True)
        camera = f"folder:{make_recording(self.folder / 'box', frames=1)},loop=1,preload=1,place=0:1.5:0"
        environment = {**self.screen.environment, "XDG_STATE_HOME": str(self.folder / "home"), "SDL_AUDIODRIVER": "dummy"}
        with host(self.folder / "state", camera) as h, \
                Process("join", h.greeting["link"], "--name", "Wim", "--size", f"{WIDTH}x{HEIGHT}", "--renderer", "splat",
                        "--language", "fr", env=environment):
            wait_until(lambda: self.tool_has(0, ALARM))
            self.screen.do("key", "w")
            wait_until(lambda: self.tool_has(3, PRESSED))
            self.screen.do("key", "w")
            wait_until(lambda: not self.tool_has(3, PRESSED))
            self.screen.do("key", "z", "key", "w")
            wait_until(lambda: self.tool_has(3, PRESSED))


if __name__ == "__main__":
    unittest.main()
