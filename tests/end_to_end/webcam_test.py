# SPDX-License-Identifier: Apache-2.0
"""A webcam's picture is seen on the head of its person, until it is switched off or stands still."""
import pathlib
import shutil
import signal
import tempfile
import unittest

from theatron_process import Process, host, make_recording, read_png, run, wait_until
from virtual_screen import VirtualScreen

SIZE = (320, 240)
# Colours of the generated picture (capture/face_camera.cpp).
RED, BLUE = (220, 60, 40), (40, 90, 220)


def places(rows, color):
    """Pixels of nearly this colour: (x, y)."""
    return [(x, y) for y, row in enumerate(rows) for x in range(SIZE[0])
            if all(abs(row[3 * x + c] - color[c]) < 40 for c in range(3))]


def faces(figures):
    return [c for c in figures["cameras"] if c["name"] == "face"]


class Webcam(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="theatron_webcam_"))
        cls.addClassCleanup(shutil.rmtree, cls.folder)
        cls.lamp = f"folder:{make_recording(cls.folder / 'lamp', color=False)},loop=1,preload=1,place=0:1.5:0"

    def seen(self, link, name, seconds=1):
        """The view of another person who stands where the camera is."""
        picture = self.folder / f"{name}.png"
        code, _, errors = run("join", link, "--offscreen", picture, "--size", "{}x{}".format(*SIZE), "--seconds", str(seconds))
        self.assertEqual(code, 0, errors)
        return read_png(picture)[3]

    def test_a_face_is_seen_while_its_person_wants_it(self):
        with host(self.folder / "state", self.lamp) as h:
            link = h.greeting["link"]  # of experts, who may send no cameras
            with Process("join", link, "--name", "Ada", "--every", "0.2") as ada, \
                    Process("join", link, "--name", "Ben", "--webcam", "test", "--every", "0.2") as ben:
                ben.say("stand 0 1.5 -0.7 0 1.5 0")
                ben.wait_for(lambda f: f["webcam"]["state"] == "seen")
                shown = ada.wait_for(lambda f: faces(f) and faces(f)[0]["frames"] > 15)
                self.assertEqual(faces(shown)[0]["color_codec"], "jpeg:quality=75")
                # 15 pictures in each second of the session at most; those of a second may wait.
                later = ada.wait_for(lambda f: faces(f)[0]["frames"] > 60)
                passed_s = (later["session_us"] - shown["session_us"]) / 1e6
                self.assertLess(faces(later)[0]["frames"] - faces(shown)[0]["frames"], 15 * (passed_s + 1))

                rows = self.seen(link, "with")
                red, blue = places(rows, RED), places(rows, BLUE)
                self.assertGreater(len(red), 1500)
                self.assertGreater(len(blue), 1500)
                # Not mirrored, and upright before the head in the middle of the picture.
                self.assertLess(max(x for x, _ in red), min(x for x, _ in blue))
                self.assertAlmostEqual(max(x for x, _ in red), SIZE[0] / 2, delta=30)
                self.assertAlmostEqual(sum(y for _, y in red + blue) / len(red + blue), SIZE[1] / 2, delta=20)

                ben.say("webcam off")
                ben.wait_for(lambda f: f["webcam"]["state"] == "off")
                ada.wait_for(lambda f: not faces(f))
                rows = self.seen(link, "without")
                # The figure in its place has the person's colour, which may be one of both.
                self.assertLess(min(len(places(rows, RED)), len(places(rows, BLUE))), 50)
                self.assertGreater(len(places(rows, (235, 235, 235))), 20, "the eyes of the drawn face")

                ben.say("webcam on")
                ada.wait_for(lambda f: faces(f) and faces(f)[0]["frames"] > 5)
                # One who joins later is sent the last picture. It is too old to be shown.
                ben.send(signal.SIGSTOP)
                lamp = lambda f: next(c["frames"] for c in f["cameras"] if c["name"] == "lamp")
                before = lamp(ada.newest_json())
                ada.wait_for(lambda f: lamp(f) > before + 100)  # 30 a second at most
                rows = self.seen(link, "stopped")
                self.assertLess(min(len(places(rows, RED)), len(places(rows, BLUE))), 50)

    def test_in_the_window_f4_switches_it(self):
        with VirtualScreen(480, 360) as screen, host(self.folder / "state3", self.lamp) as h:
            environment = {**screen.environment, "XDG_STATE_HOME": str(self.folder / "home")}
            with Process("join", h.greeting["link"], "--name", "Ada", "--every", "0.2") as ada, \
                    Process("join", h.greeting["link"], "--name", "Wim", "--webcam", "test", "--size", "480x360", env=environment):
                ada.wait_for(lambda f: faces(f) and faces(f)[0]["frames"] > 3)
                for is_on in (False, True):
                    screen.do("key", "F4")
                    ada.wait_for(lambda f: bool(faces(f)) == is_on)

    def test_a_missing_webcam_and_an_observer_s_one_keep_nobody_out(self):
        with host(self.folder / "state2", self.lamp) as h:
            with Process("join", h.greeting["link"], "--webcam", "/dev/theatron-none", "--every", "0.2") as ben:
                ben.wait_for(lambda f: f["phase"] == "joined" and f["webcam"]["state"] == "off")
                wait_until(lambda: "You are not seen" in "".join(ben.errors))
            with Process("join", h.greeting["links"]["observer"], "--webcam", "test", "--every", "0.2") as eve:
                refused = eve.wait_for(lambda f: f["webcam"]["problem"])
                self.assertEqual(refused["phase"], "joined")
                self.assertIn("Observers show no face", refused["webcam"]["problem"])


if __name__ == "__main__":
    unittest.main()
