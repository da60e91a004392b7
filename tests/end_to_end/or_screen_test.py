# SPDX-License-Identifier: Apache-2.0
"""`theatron join --or-screen`: who is here, who speaks and where they point, in a file and on a screen that
nobody handles."""
import array
import os
import pathlib
import shutil
import signal
import tempfile
import unittest

from theatron_process import Process, host, make_recording, read_png, wait_until
from virtual_screen import VirtualScreen, brightness
from voice_test import RATE, write_wav

WIDTH, HEIGHT = 640, 360


class OrScreen(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="theatron_or_screen_"))
        self.addCleanup(shutil.rmtree, self.folder)
        self.camera = f"folder:{make_recording(self.folder / 'box', frames=1)},loop=1,preload=1"
        self.state = self.folder / "state"

    def join(self, link, *options, env=None):
        return Process("join", link, *options, env={**(env or os.environ), "XDG_STATE_HOME": str(self.folder / "home")})

    def test_it_shows_who_speaks_and_where_people_point(self):
        # A tone of 240 Hz.
        write_wav(self.folder / "said.wav", array.array("h", ([6000] * 100 + [-6000] * 100) * (20 * RATE // 200)))
        with host(self.state, self.camera) as h:
            link = h.greeting["link"]
            file = self.folder / "or.png"
            with self.join(link, "--no-window", "--json", "--name", "Ada Meyer") as ada, \
                    self.join(link, "--no-window", "--json", "--name", "Ben",
                              "--microphone", self.folder / "said.wav") as ben, \
                    self.join(link, "--or-screen", "--offscreen", file, "--size", f"{WIDTH}x{HEIGHT}",
                              "--seconds", "60", "--every", "0.2") as screen:

                def shown(condition):
                    return screen.wait_for(lambda f: f.get("or_screen") and condition(f["or_screen"]))["or_screen"]

                def state_of(view, name):
                    return next((p["state"] for p in view["people"] if p["name"] == name), None)

                view = shown(lambda v: state_of(v, "Ben") == "speaks")
                self.assertEqual([p["name"] for p in view["people"] if p["speaks"]], ["Ben"])
                # The camera is at (0, 1.5, 0) and looks along -z. A ray from its right to the wall.
                ada.say("point 1 1.5 0 0.3 1.5 -1.6")
                pointer = shown(lambda v: v["pointers"])["pointers"][0]
                self.assertEqual(pointer["sight"], "visible")
                # In the middle of its height, right of its middle, and beside the box.
                self.assertAlmostEqual(pointer["y"], 60, delta=2)
                self.assertTrue(90 < pointer["x"] < 125, pointer)
                ada.say("point 1 1.5 0 1.2 1.5 0.4")
                view = shown(lambda v: state_of(v, "Ada Meyer") == "points elsewhere")
                self.assertEqual(view["pointers"], [])
                ada.say("point")
                shown(lambda v: not state_of(v, "Ada Meyer").startswith("points"))
                ada.say("point 1 1.5 0 0.3 1.5 -1.6")
                view = shown(lambda v: v["pointers"])
                self.assertEqual(view["warning"], "")
                os.kill(h.process.pid, signal.SIGSTOP)
                shown(lambda v: v["warning"].startswith("NOT LIVE"))
                os.kill(h.process.pid, signal.SIGCONT)
                shown(lambda v: v["warning"] == "" and v["pointers"])
                screen.say("quit")
                self.assertEqual(screen.end(), 0, screen.errors)
            width, height, channels, rows = read_png(file)
            self.assertEqual((width, height, channels), (WIDTH, HEIGHT, 3))
            color = {1: (86, 180, 233), 2: (0, 158, 115), 3: (240, 228, 66)}[view["pointers"][0]["id"]]
            picture = [tuple(row[x:x + 3]) for row in rows[:250] for x in range(0, 3 * 440, 3)]
            # The pointer's ring and badge.
            self.assertGreater(picture.count(color), 100)

    def test_it_begins_with_the_file_of_its_link_and_comes_back_after_the_host(self):
        link_file = self.folder / "link.txt"
        with VirtualScreen(WIDTH, HEIGHT) as x11:

            def picture():
                return brightness(x11.pixels(150, 60, 150, 150))

            with self.join(f"@{link_file}", "--or-screen", env=x11.environment) as screen:
                # The ground is dark, the text is not.
                wait_until(lambda: 8 < brightness(x11.pixels(0, 0, WIDTH, HEIGHT)) < 40)
                with host(self.state, self.camera) as h:
                    link_file.write_text(h.greeting["link"] + "\n")
                    wait_until(lambda: picture() > 60)
                    port = h.greeting["link"].split("//")[1].split("/")[0]
                    h.send(signal.SIGKILL)
                    h.end()
                wait_until(lambda: picture() < 50)
                with host(self.state, self.camera, listen=port):
                    wait_until(lambda: picture() > 60)
                    # Keys do nothing: nobody sits before it.
                    x11.do("key", "Escape")
                    x11.do("key", "Escape")
                    wait_until(lambda: picture() > 60)
                    self.assertIsNone(screen.process.poll())
                    screen.send(signal.SIGTERM)
                    self.assertEqual(screen.end(), 0, screen.errors)


if __name__ == "__main__":
    unittest.main()
