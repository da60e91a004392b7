# SPDX-License-Identifier: Apache-2.0
"""The window of `theatron join`, with the keys and the mouse that a person would use."""
import os
import pathlib
import shutil
import signal
import socket
import subprocess
import tempfile
import unittest

from theatron_process import PROGRAM, Process, host, make_recording, wait_until
from virtual_screen import VirtualScreen, brightness, difference

WIDTH, HEIGHT = 480, 360


class Window(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="theatron_window_"))
        # One picture is repeated, so that all changes on the screen are caused by input.
        recording = make_recording(cls.folder / "box", frames=1)
        cls.camera = f"folder:{recording},loop=1,preload=1"
        cls.state = cls.folder / "state"
        cls.screen = VirtualScreen(WIDTH, HEIGHT)

    @classmethod
    def tearDownClass(cls):
        cls.screen.__exit__()
        shutil.rmtree(cls.folder)

    def window(self, link, *options):
        # All pixels always: the machine's load must not change the picture.
        return Process("join", link, "--size", f"{WIDTH}x{HEIGHT}", "--render-scale", "1", *options,
                       env=self.screen.environment)

    def picture(self):
        """The window's middle, without the notices above and the facts below."""
        return self.screen.pixels(60, 90, WIDTH - 120, 150)

    def wait_for_scene(self):
        wait_until(lambda: self.screen.title().startswith("operating room"))
        wait_until(lambda: brightness(self.picture()) > 70)
        return self.picture()

    def wait_for_change(self, before, share):
        return wait_until(lambda: difference(before, self.picture()) > share)

    def wait_for_return(self, before):
        return wait_until(lambda: difference(before, self.picture()) < 0.02)

    def test_keys_and_mouse_do_what_the_help_says(self):
        do = self.screen.do
        with host(self.state, self.camera) as h, self.window(h.greeting["link"], "--renderer", "splat") as viewer:
            own = self.wait_for_scene()
            with self.subTest("dragging turns the scene, and R brings the camera's view back"):
                do("mousemove", 240, 180, "mousedown", 1, "mousemove", 290, 180, "mousemove", 340, 200, "mouseup", 1)
                self.wait_for_change(own, 0.1)
                do("key", "r")
                self.wait_for_return(own)
            with self.subTest("the right button slides"):
                do("mousemove", 240, 180, "mousedown", 3, "mousemove", 300, 180, "mouseup", 3, "mousemove", 240, 180)
                self.wait_for_change(own, 0.1)
                do("key", "1")
                self.wait_for_return(own)
            with self.subTest("the wheel comes closer"):
                do("click", "--repeat", 3, 4)
                self.wait_for_change(own, 0.1)
                do("key", "Home")
                self.wait_for_return(own)
            with self.subTest("keys fly for as long as they are held"):
                do("keydown", "d")
                self.wait_for_change(own, 0.3)
                do("keyup", "d", "key", "r")
                self.wait_for_return(own)
            with self.subTest("the help comes and goes"):
                do("key", "F1")
                self.wait_for_change(own, 0.3)
                do("key", "h")
                self.wait_for_return(own)
            with self.subTest("renderers and codecs are changed"):
                do("key", "Tab")
                wait_until(lambda: " disc " in self.screen.title())
                do("key", "m")
                wait_until(lambda: " mesh " in self.screen.title())
                do("key", "c", "key", "v")
            with self.subTest("nobody leaves by one press of a key"):
                do("key", "Escape")
                self.wait_for_change(own, 0.002)
                self.assertIsNone(viewer.process.poll())
            do("key", "Escape")
            self.assertEqual(viewer.end(), 0)
            output = "".join(iter(viewer.lines.get, None))
            self.assertIn("age on screen", output)
            self.assertNotIn("reported", "".join(viewer.errors))  # errors of the driver

    def test_a_lost_host_is_told_and_found_again(self):
        with socket.socket() as probe:
            probe.bind(("127.0.0.1", 0))
            listen = f"127.0.0.1:{probe.getsockname()[1]}"
        with host(self.state, self.camera, listen=listen) as first, self.window(first.greeting["link"]) as viewer:
            own = self.wait_for_scene()
            first.send(signal.SIGKILL)
            first.end()
            wait_until(lambda: brightness(self.picture()) < 0.6 * brightness(own))
            with host(self.state, self.camera, listen=listen):
                self.wait_for_return(own)
                self.assertIn("Connected again.", "".join(viewer.errors))
                viewer.send(signal.SIGTERM)
                self.assertEqual(viewer.end(), 0)

    def test_a_refused_join_ends_with_a_sentence(self):
        with host(self.state, self.camera) as h, \
                self.window(h.greeting["link"].replace("join=", "join=x")) as viewer:
            self.assertEqual(viewer.end(), 1)
            self.assertIn("token is wrong", "".join(viewer.errors))

    def test_without_a_display_one_sentence_says_what_to_do(self):
        environment = {k: v for k, v in os.environ.items() if k not in ("DISPLAY", "WAYLAND_DISPLAY")}
        link = f"https://127.0.0.1:1/#join=x&cert={'0' * 64}"
        done = subprocess.run([PROGRAM, "join", link], env={**environment, "SDL_VIDEODRIVER": "x11"},
                              capture_output=True, text=True, timeout=30)
        self.assertEqual(done.returncode, 1)
        self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
        for word in ("no display", "--offscreen", "--no-window"):
            self.assertIn(word, done.stderr)


if __name__ == "__main__":
    unittest.main()
