# SPDX-License-Identifier: Apache-2.0
"""The strip of theatron photon: in a film, in a camera, in the picture of a session, in a window."""
import json
import pathlib
import shutil
import subprocess
import tempfile
import unittest

import photon_strip
from theatron_process import PROGRAM, Process, host, run, write_png
from virtual_screen import VirtualScreen

NEED_FFMPEG = unittest.skipUnless(shutil.which("ffmpeg"), "without ffmpeg no films can be made")


def photon(*words):
    code, output, errors = run("photon", *words)
    if code != 0:
        raise AssertionError(errors)
    return json.loads(output)


def youngest(figures):
    """Bounded from below alone: a busy machine makes nothing younger."""
    return figures["age_ms"]["least"]


class Photon(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="theatron_photon_"))
        cls.addClassCleanup(shutil.rmtree, cls.folder)

    @NEED_FFMPEG
    def test_a_film_tells_the_latency(self):
        """A screen with 60 Hz on the right; a display on the left, which shows each refresh 100 ms later."""
        film, plot = self.folder / "film.mp4", self.folder / "latency.svg"
        refresh = lambda ms: int(ms * 60 / 1000) * 1000 / 60
        frames = [1000 + i * 1000 / 240 for i in range(360)]
        photon_strip.write_film(film, [(int(refresh(t - 100)), int(refresh(t))) for t in frames], 240)
        figures = photon("film", film, "--json", "--plot", plot)
        self.assertAlmostEqual(figures["motion_to_photon_ms"]["mean"], 100, delta=3)
        low, high = figures["mean_interval_95_ms"]
        self.assertLess(low, 100)
        self.assertGreater(high, 100)
        self.assertGreater(figures["scene"]["x"], figures["display"]["x"])
        self.assertGreater(figures["changes"], 80)
        self.assertIn("<circle", plot.read_text())
        code, _, errors = run("photon", "film", film, "--plot", plot)
        self.assertEqual(code, 1)
        self.assertIn("--overwrite", errors)

    @NEED_FFMPEG
    def test_films_without_two_strips_are_refused(self):
        for strips, reason in ((1, "only one strip"), (3, "3 strips")):
            film = self.folder / f"{strips}.mp4"
            photon_strip.write_film(film, [[4 * i] * strips for i in range(60)], 240)
            code, _, errors = run("photon", "film", film)
            self.assertEqual(code, 1)
            self.assertIn(reason, errors)
        (self.folder / "text.mp4").write_text("no film")
        code, _, errors = run("photon", "film", self.folder / "text.mp4")
        self.assertEqual(code, 1)
        self.assertIn("no video that FFmpeg reads", errors)

    def test_pictures_tell_their_times(self):
        width, height, grey = photon_strip.picture([54321, 77])
        rows = [grey[y * width:(y + 1) * width] for y in range(height)]
        write_png(self.folder / "two.png", width, height, 8, 1, rows)
        (read,) = photon("read", self.folder / "two.png", "--json")
        self.assertEqual([strip["time_ms"] for strip in read["strips"]], [54321, 77])

    def test_the_delay_of_a_camera_is_read(self):
        """Nothing is younger than the camera makes it."""
        figures = photon("read", "strip:delay=80", "--seconds", "1", "--json")
        self.assertGreaterEqual(youngest(figures), 79.4)
        self.assertEqual(figures["without_strip"], 0)

    def test_the_strip_is_read_in_the_picture_of_a_session(self):
        with host(self.folder / "state", "strip:delay=200") as h:
            figures = photon("read", h.greeting["link"], "--seconds", "3", "--size", "640x360", "--json", "--plot", self.folder / "stages.svg")
        self.assertGreaterEqual(youngest(figures), 199.4)
        stages = {stage["until"]: stage["mean_ms"] for stage in figures["stages"]}
        self.assertEqual(list(stages)[-3:], ["decoded", "uploaded", "presented"])
        self.assertGreaterEqual(stages["delivered"], 199)
        # The strip and the frames' own times tell the same age; a picture is in memory a little before it is read.
        self.assertLessEqual(abs(sum(stages.values()) - figures["age_ms"]["mean"]), 0.2 * figures["age_ms"]["mean"])
        self.assertIn("class='stage'", (self.folder / "stages.svg").read_text())
        self.assertGreater(figures["read"], 4)

    def test_a_window_shows_the_time(self):
        with VirtualScreen(800, 400) as screen, \
                Process("photon", "show", "--size", "640x280", env=screen.environment) as show:
            done = None

            def is_read():
                nonlocal done
                done = subprocess.run([PROGRAM, "photon", "read", "x11:Theatron photon", "--seconds", "1", "--json"],
                                      env=screen.environment, capture_output=True, text=True)
                return done.returncode == 0
            show.wait_until(is_read)
            self.assertGreater(youngest(json.loads(done.stdout)), -1)

    def test_a_session_without_a_strip_is_refused(self):
        code, _, errors = run("photon", "read", "synthetic:quality=quick,seconds=2", "--seconds", "1")
        self.assertEqual(code, 1)
        self.assertIn("No strip is seen", errors)


if __name__ == "__main__":
    unittest.main()
