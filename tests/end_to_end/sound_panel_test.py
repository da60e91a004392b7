# SPDX-License-Identifier: Apache-2.0
"""The panel of sound, which "More" opens, has the devices of the machine; the one that is chosen is used, and kept."""
import pathlib
import shutil
import tempfile
import unittest

from theatron_process import Process, host, make_recording, wait_until
from virtual_screen import VirtualScreen, brightness

WIDTH, HEIGHT = 640, 900


class SoundPanel(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="theatron_sound_"))
        self.addCleanup(shutil.rmtree, self.folder)

    def test_a_person_chooses_devices_with_the_mouse(self):
        camera = f"folder:{make_recording(self.folder / 'lamp', color=False)},loop=1,preload=1,place=0:1.5:0"
        settings = self.folder / "home" / "theatron" / "settings"
        kept = lambda: settings.read_text() if settings.exists() else ""
        with VirtualScreen(WIDTH, HEIGHT) as screen, host(self.folder / "state", camera) as h:
            # SDL's devices without hardware: one that hears silence, one that nobody hears.
            environment = {**screen.environment, "XDG_STATE_HOME": str(self.folder / "home"), "SDL_AUDIODRIVER": "dummy"}
            with Process("join", h.greeting["link"], "--name", "Ada", "--every", "0.2") as ada, \
                    Process("join", h.greeting["link"], "--name", "Wim", "--size", f"{WIDTH}x{HEIGHT}",
                            env=environment) as window:
                ada.wait_for(lambda f: any(p["name"] == "Wim" for p in f["room"]["people"]))
                wait_until(lambda: screen.has_bar(WIDTH, HEIGHT) and brightness(screen.pixels(100, 350, 200, 100)) > 20)
                before = screen.buttons(WIDTH, HEIGHT)
                self.assertEqual(before, [])
                # The last button of the bar, and "Sound", the fourth one of its panel, by the keyboard.
                screen.do("mousemove", 600, 700, "key", "shift+Tab", "key", "Return")
                window.wait_until(lambda: len(screen.buttons(WIDTH, HEIGHT)) >= 6)
                screen.do(*["key", "Tab"] * 4, "key", "Return", "key", "Escape")
                window.wait_until(lambda: len(screen.buttons(WIDTH, HEIGHT)) < 6)
                # Both kinds have two devices: the usual one and the dummy; none is in use yet.
                screen.click_until(lambda: self.button(screen, -4), ada, lambda _: "speaks yes" in kept())
                self.assertIn("\nmicrophone default\n", kept())
                # The device in use has no button any more.
                screen.click_until(lambda: self.button(screen, -1), ada, lambda _: "hears yes" in kept())
                self.assertNotIn("\nloudspeaker default\n", kept())
                screen.do("key", "Escape", "key", "Escape")
                self.assertEqual(window.end(), 0, "".join(window.errors))

    def button(self, screen, number):
        """The middle of this one of the buttons that stand alone, once it is there."""
        return wait_until(lambda: len(alone := self.alone(screen)) >= abs(number) and alone)[number]

    def alone(self, screen):
        """Buttons that stand alone in their row."""
        buttons = screen.buttons(WIDTH, HEIGHT)
        return [b for b in buttons if sum(abs(b[1] - other[1]) < 8 for other in buttons) == 1]


if __name__ == "__main__":
    unittest.main()
