# SPDX-License-Identifier: Apache-2.0
"""A shared video is a screen in the room of everybody, and harms no camera."""
import pathlib
import shutil
import tempfile
import unittest

from theatron_process import Process, host, make_recording, read_png, run

WIDTH, HEIGHT = 320, 180


def write_video(path, frames):
    """Uncompressed: pure green in limited range."""
    pixels = WIDTH * HEIGHT
    picture = b"FRAME\n" + bytes([173]) * pixels + bytes([42]) * pixels + bytes([26]) * pixels
    path.write_bytes(f"YUV4MPEG2 W{WIDTH} H{HEIGHT} F30:1 Ip A1:1 C444\n".encode() + picture * frames)


def camera(figures, name):
    return next((c for c in figures["cameras"] if c["name"] == name), None)


class Screens(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="theatron_screens_"))
        cls.addClassCleanup(shutil.rmtree, cls.folder)
        cls.lamp = f"folder:{make_recording(cls.folder / 'lamp')},loop=1,preload=1,place=0:1.5:0"
        cls.video = cls.folder / "scope.y4m"
        write_video(cls.video, 60)

    def test_a_shared_video_is_seen_until_it_ends_and_the_camera_goes_on(self):
        with host(self.folder / "state", self.lamp) as h:
            # Before the wall that the camera sees.
            shared = f"{self.video},width=0.4,place=0:1.5:-0.5"
            with Process("join", h.greeting["link"], "--every", "0.2") as seen, \
                    Process("publish", h.greeting["publish_link"], "--share", shared + ",loop=1",
                            "--every", "0.2") as cart:
                both = seen.wait_for(lambda f: camera(f, "scope") and camera(f, "scope")["frames"] > 20, 20)
                self.assertEqual(camera(both, "scope")["filter"], "")
                self.assertEqual(camera(both, "lamp")["dropped"], 0)
                self.assertEqual(cart.newest_json()["cameras"][0]["state"], "live")
                picture = self.folder / "seen.png"
                code, _, errors = run("join", h.greeting["link"], "--offscreen", picture, "--size",
                                      "320x240", "--seconds", "1", "--color-codec", "raw")
                if "GL" in errors or "EGL" in errors:
                    self.skipTest(errors)
                self.assertEqual(code, 0, errors)
                _, _, _, rows = read_png(picture)
                middle = rows[120][3 * 160:3 * 160 + 3]
                self.assertTrue(middle[0] < 40 and middle[1] > 235 and middle[2] < 40, tuple(middle))
            with Process("publish", h.greeting["publish_link"], "--share", shared, "--every", "0.2"), \
                    Process("join", h.greeting["link"], "--every", "0.2") as seen:
                ended = seen.wait_for(
                    lambda f: camera(f, "scope") and camera(f, "scope")["state"] == "ended", 20)
                self.assertEqual(camera(ended, "lamp")["state"], "live")

    def test_what_is_no_video_is_refused_with_a_sentence(self):
        bad = self.folder / "bad.mp4"
        bad.write_bytes(b"no video at all")
        with host(self.folder / "state2", self.lamp) as h:
            for shared, words in ((bad, "is no video that FFmpeg reads"),
                                  (self.folder / "none.mp4", "There is no file")):
                code, _, errors = run("publish", h.greeting["publish_link"], "--share", shared)
                self.assertEqual(code, 1)
                self.assertIn(words, errors)
                self.assertEqual(errors.count("\n"), 1, errors)
            code, _, errors = run("publish", h.greeting["publish_link"])
            self.assertEqual(code, 1)
            self.assertIn("--share", errors)


if __name__ == "__main__":
    unittest.main()
