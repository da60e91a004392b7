# SPDX-License-Identifier: Apache-2.0
"""One participant looks back at the session, alone, and returns to the present."""
import pathlib
import shutil
import tempfile
import unittest

from theatron_process import Process, host, make_recording, wait_until

FPS = 20


def camera(figures):
    return figures["cameras"][0]


class LookBack(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="theatron_look_back_"))
        self.addCleanup(shutil.rmtree, self.folder)
        self.camera = f"folder:{make_recording(self.folder / 'box', frames=20)},fps={FPS},loop=1"

    def test_a_latecomer_sees_what_was_before_and_the_others_do_not(self):
        with host(self.folder / "state", self.camera) as h, \
                Process("join", h.greeting["link"], "--every", "0.1", "--name", "Anna") as anna:
            anna.wait_for(lambda f: f["cameras"] and camera(f)["newest_frame"] > 6 * FPS, 30)
            with Process("join", h.greeting["links"]["observer"], "--every", "0.1", "--name", "Ben") as ben:
                f = ben.wait_for(lambda f: f["cameras"] and camera(f)["frames"] > 0 and f["clock_error_ms"] > 0, 20)
                first = camera(f)["newest_frame"]
                self.assertFalse(camera(f)["past"])
                lost = camera(anna.newest_json())["dropped"]
                ben.say("back 4")
                # Before he came, at the age that the picture has, and at its pace.
                f = ben.wait_for(lambda f: camera(f)["past"] and camera(f)["age_now_ms"] > 3900, 10)
                shown = camera(f)["newest_frame"]
                self.assertLess(shown, first)
                self.assertTrue(f["past"])
                self.assertGreater(f["age_ms"]["p50"], 3900)
                f = ben.wait_for(lambda f: camera(f)["newest_frame"] >= shown + FPS, 10)
                self.assertTrue(camera(f)["past"])
                self.assertEqual(camera(f)["state"], "live")
                self.assertLess(camera(f)["newest_age_ms"], 3900)
                # It is not the present of the others, who lost nothing because of it.
                other = camera(anna.newest_json())
                self.assertFalse(other["past"])
                self.assertGreater(other["newest_frame"], camera(f)["newest_frame"] + 3 * FPS)
                self.assertEqual(other["dropped"], lost)
                ben.say("live")
                f = ben.wait_for(lambda f: not camera(f)["past"] and camera(f)["newest_frame"] > other["newest_frame"], 10)
                f = ben.wait_for(lambda f: camera(f)["age_now_ms"] < 1500, 10)
                ben.say("back soon")
                wait_until(lambda: any("back SECONDS" in line for line in list(ben.errors)))

    def test_a_host_that_keeps_nothing_says_so(self):
        with host(self.folder / "state", self.camera, options=("--look-back", "0")) as h, \
                Process("join", h.greeting["link"], "--every", "0.1") as guest:
            guest.wait_for(lambda f: f["cameras"] and camera(f)["frames"] > 0, 20)
            guest.say("back 1")
            wait_until(lambda: any("keeps nothing of the last minute" in line for line in list(guest.errors)))


if __name__ == "__main__":
    unittest.main()
