# SPDX-License-Identifier: Apache-2.0
"""A picture that is not live never looks live: in the window and on the OR screen, whatever stands still."""
import pathlib
import shutil
import signal
import tempfile
import unittest

from leaving_test import preloaded
from theatron_process import Process, host, make_recording, read_png, wait_until
from virtual_screen import VirtualScreen, brightness

WIDTH, HEIGHT = 480, 360
COVER = bytes((30, 26, 24))  # blue, green, red


class Still(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="theatron_still_"))
        self.addCleanup(shutil.rmtree, self.folder)
        self.camera = f"folder:{make_recording(self.folder / 'box')},loop=1,preload=1"
        self.screen = VirtualScreen(WIDTH, HEIGHT)
        self.addCleanup(self.screen.__exit__)

    def window(self, link, *options, environment=None):
        home = tempfile.mkdtemp(dir=self.folder)
        return Process("join", link, "--size", f"{WIDTH}x{HEIGHT}", *options,
                       env={**(environment or self.screen.environment), "XDG_STATE_HOME": home})

    def picture(self):
        return brightness(self.screen.pixels(150, 60, 150, 80))

    def covered(self):
        """The share of the screen that has the colour of the cover."""
        rows = self.screen.pixels(0, 0, WIDTH, HEIGHT)
        same = sum(row[i:i + 3] == COVER for row in rows for i in range(0, len(row), 4))
        return same / (WIDTH * HEIGHT)

    def letters(self):
        """The rows in which the cover has letters."""
        rows = self.screen.pixels(0, 0, WIDTH, HEIGHT)
        return [y for y, row in enumerate(rows) if any(row[i + 2] > 200 and row[i] < 120 for i in range(0, len(row), 4))]

    def test_a_picture_that_the_host_does_not_renew_is_darkened_and_comes_back(self):
        with host(self.folder / "state", self.camera) as h, self.window(h.greeting["link"], "--name", "Wim"):
            wait_until(lambda: self.picture() > 70)
            bright = self.picture()
            h.send(signal.SIGSTOP)
            try:
                wait_until(lambda: self.picture() < 0.6 * bright)
            finally:
                h.send(signal.SIGCONT)
            wait_until(lambda: self.picture() > 0.9 * bright)

    def test_a_picture_in_a_file_whose_host_hangs_says_its_age(self):
        file = self.folder / "still.png"
        with host(self.folder / "state", self.camera) as h, \
                Process("join", h.greeting["link"], "--offscreen", file, "--size", f"{WIDTH}x{HEIGHT}", "--quality", "low",
                        "--seconds", "600", "--every", "0.2") as join:
            self.assertIsNone(join.wait_for(lambda f: f["cameras"] and f["cameras"][0]["frames"] > 5)["still_seconds"])
            h.send(signal.SIGSTOP)
            self.assertGreaterEqual(join.wait_for(lambda f: f["still_seconds"])["still_seconds"], 2)
            join.send(signal.SIGTERM)
            self.assertEqual(join.end(), 0, join.errors)
            h.send(signal.SIGCONT)
        self.assertIn("it stands on the picture that is written", "".join(join.errors))
        # Amber letters on the plate in the middle.
        _, height, channels, rows = read_png(file)
        middle = rows[2 * height // 5:3 * height // 5]
        self.assertTrue(any(row[i] > 200 and 130 < row[i + 1] < 220 and row[i + 2] < 130
                            for row in middle for i in range(0, len(row), channels)))

    def covers_while_drawing_hangs(self, *options):
        hangs = self.folder / "hangs"
        environment = {**preloaded("swap", self.screen.environment), "HANG_STANDIN_FILE": str(hangs)}
        with host(self.folder / "state", self.camera) as h, \
                self.window(h.greeting["link"], *options, environment=environment) as window:
            wait_until(lambda: self.picture() > 60, of=window)
            self.assertLess(self.covered(), 0.8)
            hangs.touch()
            wait_until(lambda: self.covered() > 0.9, of=window)
            rows = wait_until(self.letters, of=window)
            self.assertTrue(HEIGHT / 3 < rows[0] and rows[-1] < 2 * HEIGHT / 3, rows)
            hangs.unlink()
            wait_until(lambda: self.picture() > 60, of=window)
            hangs.touch()
            wait_until(lambda: self.covered() > 0.9, of=window)
            window.send(signal.SIGTERM)
            window.end()

    def test_a_window_whose_drawing_hangs_is_covered(self):
        self.covers_while_drawing_hangs("--name", "Wim")

    def test_an_or_screen_whose_drawing_hangs_is_covered(self):
        self.covers_while_drawing_hangs("--or-screen")

    def test_after_the_end_of_a_session_the_window_shows_its_form(self):
        with host(self.folder / "state", self.camera) as h, self.window(h.greeting["link"], "--name", "Wim") as window:
            wait_until(lambda: self.picture() > 70, of=window)
            h.send(signal.SIGINT)
            wait_until(lambda: self.screen.title().startswith("Enter a session"), of=window)
            self.assertIsNone(window.process.poll())
            window.send(signal.SIGTERM)
            self.assertEqual(window.end(), 0, window.errors)


if __name__ == "__main__":
    unittest.main()
