# SPDX-License-Identifier: Apache-2.0
"""One participant looks back at the session, alone, and returns to the present."""
import json
import pathlib
import shutil
import tempfile
import unittest

from theatron_process import Process, host, make_recording, read_png, stand, wait_until

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
            anna.wait_for(lambda f: f["cameras"] and camera(f)["newest_frame"] > 6 * FPS)
            with Process("join", h.greeting["links"]["observer"], "--every", "0.1", "--name", "Ben") as ben:
                f = ben.wait_for(lambda f: f["cameras"] and camera(f)["frames"] > 0 and f["clock_error_ms"] > 0)
                first = camera(f)["newest_frame"]
                self.assertFalse(camera(f)["past"])
                ben.say("back 4")
                # Before he came, at the age that the picture has, and at its pace.
                f = ben.wait_for(lambda f: camera(f)["past"] and camera(f)["age_now_ms"] > 3900)
                shown = camera(f)["newest_frame"]
                self.assertLess(shown, first)
                self.assertTrue(f["past"])
                self.assertEqual(f["age_ms"]["p50"], camera(f)["age_now_ms"])
                f = ben.wait_for(lambda f: camera(f)["newest_frame"] >= shown + FPS)
                self.assertTrue(camera(f)["past"])
                ben.wait_for(lambda f: camera(f)["past"] and camera(f)["state"] == "live")
                # It is not the present of the others, whose pictures go on.
                other = camera(anna.newest_json())
                self.assertFalse(other["past"])
                self.assertGreater(other["newest_frame"], camera(f)["newest_frame"] + 3 * FPS)
                anna.say("back 2")
                anna.wait_for(lambda f: f["past"])
                anna.say("brick 0 1 0")
                wait_until(lambda: any("say 'live' to come back" in line for line in list(anna.errors)))
                self.assertEqual(anna.newest_json()["room"]["objects"], [])
                anna.say("live")
                anna.wait_for(lambda f: not f["past"])
                anna.say("brick 0 1 0")
                anna.wait_for(lambda f: len(f["room"]["objects"]) == 1)
                ben.say("live")
                newest = camera(anna.newest_json())["newest_frame"]
                ben.wait_for(lambda f: not camera(f)["past"] and camera(f)["newest_frame"] >= newest)
                ben.say("back soon")
                wait_until(lambda: any("back SECONDS" in line for line in list(ben.errors)))

    def test_a_camera_that_is_live_is_not_drawn_beside_the_past(self):
        left, right = (make_recording(self.folder / name, frames=4) for name in ("left", "right"))
        for recording, x in ((left, 0), (right, 0.6)):
            stand(recording)
            calibration = json.loads((recording / "calibration.json").read_text())
            calibration["room_from_camera"]["translation"][0] = x
            (recording / "calibration.json").write_text(json.dumps(calibration))
        looped = ",fps=20,loop=1,preload=1"
        # The publisher does not agree to recording, so the host keeps no past of its camera.
        with host(self.folder / "state", f"folder:{left}{looped}") as h, \
                Process("publish", h.greeting["publish_link"], "--camera", f"folder:{right}{looped}"), \
                Process("join", h.greeting["link"], "--every", "0.1") as anna:
            anna.wait_for(lambda f: len(f["cameras"]) == 2 and all(c["frames"] > 4 * FPS for c in f["cameras"]))

            def red_of_right(*lines):
                """Pixels of the right camera's box, as somebody sees it who says these lines."""
                with Process("join", h.greeting["link"], "--offscreen", self.folder / "seen.png", "--size", "160x120", "--room", "off",
                             "--color-codec", "raw", "--seconds", "2", "--every", "0.1") as ben:
                    ben.wait_for(lambda f: sum(c["frames"] > 0 for c in f["cameras"]) == 2)
                    for line in lines:
                        ben.say(line)
                    if lines:
                        ben.wait_for(lambda f: sorted(c["past"] for c in f["cameras"]) == [False, True])
                    self.assertEqual(ben.end(), 0, "".join(ben.errors))
                width, _, channels, rows = read_png(self.folder / "seen.png")
                return sum(r > 150 and b < 90 for row in rows for r, _, b in (row[channels * x:channels * x + 3] for x in range(105, width)))

            self.assertGreater(red_of_right(), 200)
            self.assertEqual(red_of_right("back 2"), 0)

    def test_objects_are_those_of_the_moment_that_is_shown(self):
        still = make_recording(self.folder / "still", frames=1)
        stand(still)

        def picture(name, link, seconds=1):
            return Process("join", link, "--offscreen", self.folder / f"{name}.png", "--size", "160x120", "--quality", "low",
                           "--view", "camera:0", "--color-codec", "raw", "--seconds", str(seconds), "--every", "0.1")

        def bricks(figures):
            return [o for o in figures["room"]["objects"] if o["kind"] == "brick"]

        def changed(name, before):
            """Pixels of the left and of the right half that are not as in the picture before."""
            width, height, channels, rows = read_png(self.folder / f"{name}.png")
            old = read_png(self.folder / f"{before}.png")[3]
            counts = [0, 0]
            for y in range(height):
                for x in range(width):
                    at = channels * x
                    counts[x >= width // 2] += max(abs(a - b) for a, b in zip(rows[y][at:at + 3], old[y][at:at + 3])) > 40
            return counts

        with host(self.folder / "state", f"folder:{still},fps={FPS},loop=1,preload=1") as h, \
                Process("join", h.greeting["link"], "--every", "0.1", "--name", "Anna") as anna:
            link = h.greeting["link"]
            anna.wait_for(lambda f: f["cameras"] and camera(f)["frames"] > FPS)
            with picture("empty", link) as ben:
                self.assertEqual(ben.end(), 0, "".join(ben.errors))
            anna.say("brick -0.25 1.6 -0.7")
            anna.wait_for(lambda f: len(bricks(f)) == 1)
            # Ben is there for 4 s: 3 s back he sees the old brick, not the one that was made since.
            with picture("past", link, seconds=6) as ben:
                ben.wait_for(lambda f: f["cameras"] and camera(f)["frames"] > 4 * FPS)
                anna.say("brick 0.25 1.6 -0.7")
                ben.wait_for(lambda f: len(bricks(f)) == 2)
                ben.say("back 3")
                ben.wait_for(lambda f: camera(f)["past"])
                self.assertEqual(ben.end(), 0, "".join(ben.errors))
            # A latecomer does not know when they were made.
            with picture("late", link, seconds=2) as ben:
                ben.wait_for(lambda f: f["cameras"] and camera(f)["frames"] > 0)
                ben.say("back 5")
                ben.wait_for(lambda f: camera(f)["past"])
                self.assertEqual(ben.end(), 0, "".join(ben.errors))
            with picture("now", link) as ben:
                self.assertEqual(ben.end(), 0, "".join(ben.errors))
        left, right = changed("now", "empty")
        self.assertTrue(left > 50 and right > 50, (left, right))
        left, right = changed("past", "empty")
        self.assertTrue(left > 50 and right < 20, (left, right))
        self.assertLess(max(changed("late", "empty")), 20)

    def test_a_host_that_keeps_nothing_says_so(self):
        with host(self.folder / "state", self.camera, options=("--look-back", "0")) as h, \
                Process("join", h.greeting["link"], "--every", "0.1") as guest:
            guest.wait_for(lambda f: f["cameras"] and camera(f)["frames"] > 0)
            guest.say("back 1")
            wait_until(lambda: any("keeps nothing of the last minute" in line for line in list(guest.errors)))


if __name__ == "__main__":
    unittest.main()
