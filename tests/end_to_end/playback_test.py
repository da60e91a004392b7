# SPDX-License-Identifier: Apache-2.0
"""A recording that a host plays is paused and moved for all."""
import pathlib
import shutil
import tempfile
import unittest

from theatron_process import Process, host, make_recording, read_png, run, wait_until


class Playback(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="theatron_playback_"))
        self.addCleanup(shutil.rmtree, self.folder)

    def record(self):
        """A box that moves to the right, 20 pictures a second for three seconds."""
        recording = self.folder / "a.mkv"
        frames = make_recording(self.folder / "box", frames=60)
        code, _, errors = run("record", "--camera", f"folder:{frames},fps=20,preload=1", recording)
        self.assertEqual(code, 0, errors)
        return recording

    def box_at(self, link):
        """The box's left edge as somebody who comes now sees it."""
        file = self.folder / "view.png"
        code, _, errors = run("join", link, "--offscreen", file, "--size", "160x120", "--room", "off", "--seconds", "0.5")
        self.assertEqual(code, 0, errors)
        width, _, channels, rows = read_png(file)
        row = rows[65]
        return next(x for x in range(width) if row[channels * x] > 150 and row[channels * x + 2] < 90)

    def test_all_see_the_same_moment(self):
        with host(self.folder / "state", f"recording:{self.record()},loop=1") as h:
            link = h.greeting["link"]
            with Process("join", link, "--every", "0.1", "--name", "Anna") as anna, \
                    Process("join", link, "--every", "0.1", "--name", "Ben") as ben:
                for person in (anna, ben):
                    person.wait_for(lambda f: f["playback"] and f["fps"] > 0)
                anna.say("pause")
                anna.say("seek 0.5")
                for person in (anna, ben):
                    f = person.wait_for(lambda f: f["playback"]["paused"] and f["playback"]["position_s"] == 0.5)
                    self.assertEqual(f["playback"]["by"], "Anna")
                # Those who come meanwhile see the still scene, and nobody sees a stale camera.
                early = self.box_at(link)
                self.assertAlmostEqual(early, 20 + 3 * 10, delta=4)
                # It is not live, however young its frames are.
                self.assertEqual(anna.newest_json()["cameras"][0]["state"], "paused")
                ben.say("seek +0.5")
                anna.wait_for(lambda f: f["playback"]["position_s"] == 1 and f["playback"]["by"] == "Ben")
                self.assertAlmostEqual(self.box_at(link), 20 + 3 * 20, delta=4)
                # The screen in the operating room does not call it the present.
                with Process("join", link, "--or-screen", "--offscreen", self.folder / "or.png", "--seconds", "60",
                             "--every", "0.2") as screen:
                    view = screen.wait_for(lambda f: f.get("or_screen", {}).get("recording"))["or_screen"]
                    self.assertEqual(view["recording"], "RECORDING 0:01 / 0:02, paused by Ben")
                    self.assertEqual((view["age"], view["warning"]), ("", ""))
                h.say("play")
                ben.wait_for(lambda f: not f["playback"]["paused"] and f["playback"]["by"] == "host")
                f = ben.wait_for(lambda f: f["playback"]["position_s"] > 1.5)
                self.assertEqual(f["cameras"][0]["state"], "recording")
                ben.say("seek soon")
                wait_until(lambda: any("seek SECONDS" in line for line in list(ben.errors)))
                with Process("join", h.greeting["links"]["observer"], "--no-window") as guest:
                    wait_until(lambda: run("status", link)[1].count("participant ") >= 3)
                    guest.say("pause")
                    wait_until(lambda: any("does not allow to play" in line for line in list(guest.errors)))

    def test_a_recording_that_has_ended_is_played_again(self):
        with host(self.folder / "state", f"recording:{self.record()}") as h, \
                Process("join", h.greeting["link"], "--every", "0.1") as viewer:
            f = viewer.wait_for(lambda f: f["cameras"] and f["cameras"][0]["state"] == "ended")
            self.assertEqual(f["playback"]["position_s"], f["playback"]["length_s"])
            # A latecomer sees its last picture.
            with Process("join", h.greeting["link"], "--every", "0.1") as late:
                f = late.wait_for(lambda f: f["cameras"] and f["cameras"][0]["frames"] > 0)
                self.assertEqual(f["cameras"][0]["state"], "ended")
            viewer.say("play")
            viewer.wait_for(lambda f: f["cameras"][0]["state"] == "recording" and f["playback"]["position_s"] < 2)
            viewer.wait_for(lambda f: f["cameras"][0]["state"] == "ended")

    def test_without_a_recording_is_told_so(self):
        with host(self.folder / "state", f"folder:{make_recording(self.folder / 'box')},loop=1") as h, \
                Process("join", h.greeting["link"], "--every", "0.1") as guest:
            guest.wait_for(lambda f: f["phase"] == "joined")
            guest.say("pause")
            wait_until(lambda: any("plays no recording" in line for line in list(guest.errors)))


if __name__ == "__main__":
    unittest.main()
