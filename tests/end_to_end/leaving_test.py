# SPDX-License-Identifier: Apache-2.0
"""A program ends when it is told to, and a sound system that does not answer costs the sound alone."""
import os
import pathlib
import random
import shutil
import signal
import sys
import tempfile
import time
import unittest

from theatron_process import Process, host, make_recording, run, wait_until
from virtual_screen import VirtualScreen

HANG = os.environ.get("THEATRON_HANG_STANDIN", "build/release/tests/hang_standin/libhang_standin.so")
LATE = "did not end in time"


def preloaded(what, environment=None):
    return {**(environment or os.environ), "LD_PRELOAD": str(pathlib.Path(HANG).resolve()), "HANG_STANDIN": what}


class Leaving(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="theatron_leaving_"))
        cls.camera = f"folder:{make_recording(cls.folder / 'box')},loop=1,preload=1"
        cls.screen = VirtualScreen(480, 360)

    @classmethod
    def tearDownClass(cls):
        cls.screen.__exit__()
        shutil.rmtree(cls.folder)

    def ended(self, process):
        """The exit code of a program that was told to end."""
        process.send(signal.SIGTERM)
        return process.end()

    def window(self, link, *options, environment=None):
        home = tempfile.mkdtemp(dir=self.folder)
        return Process("join", link, "--size", "480x360", "--name", "Wim", *options,
                       env={**(environment or self.screen.environment), "XDG_STATE_HOME": home})

    def shows_scene(self):
        return self.screen.title().startswith("operating room")

    def test_programs_whose_threads_do_not_end_are_ended(self):
        environment = preloaded("join")
        state = self.folder / "state"
        with host(state, self.camera) as h:
            link = h.greeting["link"]
            with Process("join", link, "--no-window", "--every", "0.1", env=environment) as viewer:
                viewer.wait_for(lambda f: f["cameras"] and f["cameras"][0]["frames"] > 0)
                self.assertEqual(self.ended(viewer), 0)
                self.assertIn(LATE, "".join(viewer.errors))
            with Process("publish", h.greeting["links"]["publisher"], "--camera", self.camera, "--every", "0.1",
                         env=environment) as publisher:
                publisher.wait_for(lambda f: f["phase"] == "joined")
                self.assertEqual(self.ended(publisher), 0)
                self.assertIn(LATE, "".join(publisher.errors))
            for options in [(), ("--or-screen",)]:
                with self.window(link, *options, environment=preloaded("join", self.screen.environment)) as window:
                    wait_until(lambda: self.screen.title() if options else self.shows_scene())
                    self.assertEqual(self.ended(window), 0)
                    self.assertIn(LATE, "".join(window.errors))
        with Process("host", "--listen", "127.0.0.1:0", "--json", "--state", state, "--camera", self.camera,
                     env=environment) as other:
            other.read_json()
            other.send(signal.SIGTERM)
            # It has 5 s for the room.
            other.end()

    @unittest.skipUnless("LEAVING_WINDOWS" in os.environ, "it takes half a minute: set LEAVING_WINDOWS")
    def test_a_recording_whose_source_does_not_end_keeps_what_it_has(self):
        file = self.folder / "kept.mkv"
        with host(self.folder / "recorded", self.camera) as h:
            with Process("record", h.greeting["link"], file, "--json", env=preloaded("join")) as recorder:
                recorder.wait_until(lambda: file.exists() and file.stat().st_size > 100_000)
                recorder.send(signal.SIGTERM)
                self.assertEqual(recorder.end(), 1)
                self.assertIn("could not be saved in time", "".join(recorder.errors))
        code, output, errors = run("inspect", file, "--verify")
        self.assertEqual(code, 3, errors)
        self.assertIn("every picture that is there was decoded", output)

    def test_a_sound_system_that_does_not_answer_costs_the_sound_alone(self):
        environment = {**preloaded("sound", self.screen.environment), "SDL_AUDIODRIVER": "dummy"}
        with host(self.folder / "silent", self.camera) as h:
            link = h.greeting["link"]
            with Process("join", link, "--no-window", "--every", "0.1", "--speaker", "default", "--microphone", "default",
                         env=environment) as viewer:
                viewer.wait_for(lambda f: f["cameras"] and f["cameras"][0]["frames"] > 5)
                self.assertEqual(viewer.newest_json()["voice"]["speaker"], False)
                self.assertEqual(self.ended(viewer), 0)
                self.assertNotIn(LATE, "".join(viewer.errors))
            with self.window(link, "--speaker", "default", "--microphone", "default", environment=environment) as window:
                wait_until(self.shows_scene)
                self.assertEqual(self.ended(window), 0)
                self.assertNotIn(LATE, "".join(window.errors))

    def test_windows_end_at_any_moment(self):
        """With and without a sound device. LEAVING_WINDOWS=200 in a soak."""
        chance = random.Random(7)
        with host(self.folder / "many", self.camera) as h:
            for number in range(int(os.environ.get("LEAVING_WINDOWS", "6"))):
                environment = dict(self.screen.environment)
                if number % 3 == 2:
                    environment["SDL_AUDIODRIVER"] = "dummy"
                with self.window(h.greeting["link"], "--speaker", "default", "--microphone", "default",
                                 environment=environment) as window:
                    lasts = chance.uniform(0.3, float(os.environ.get("LEAVING_SECONDS", "5")))
                    time.sleep(lasts)
                    window.send(signal.SIGTERM)
                    code = window.end()
                    late = LATE in "".join(window.errors)
                    print(f"window {number}: {lasts:.1f} s{', ended late' if late else ''}", file=sys.stderr)
                    # Before the program catches signals they end it.
                    self.assertIn(code, (0, -signal.SIGTERM), "".join(window.errors))


if __name__ == "__main__":
    unittest.main()
