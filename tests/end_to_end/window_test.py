# SPDX-License-Identifier: Apache-2.0
"""The window of `theatron join`, with the keys and the mouse that a person would use."""
import json
import os
import pathlib
import shutil
import signal
import socket
import tempfile
import time
import unittest

from case_test import write_case
import patience
from theatron_process import PROGRAM, Process, host, make_recording, read_png, wait_until
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

    def window(self, link, *options, home=None):
        # A person whose name is known goes straight to the room.
        if home is None:
            home = tempfile.mkdtemp(dir=self.folder)
            options = options if "--name" in options else (*options, "--name", "Wim")
        # All pixels always: the machine's load must not change the picture.
        return Process("join", link, "--size", f"{WIDTH}x{HEIGHT}", "--render-scale", "1", *options,
                       env={**self.screen.environment, "XDG_STATE_HOME": str(home)})

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
        with host(self.state, self.camera) as h, self.window(h.greeting["link"], "--renderer", "splat", "--save-to", self.folder) as viewer:
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
            with self.subTest("the cameras' plain pictures come, one becomes large, and they go"):
                corner = lambda: self.screen.pixels(250, 10, 220, 60)
                before = corner()
                do("mousemove", 200, 340, "key", "F2")
                wait_until(lambda: difference(before, corner()) > 0.3)
                self.assertLess(difference(own, self.picture()), 0.1)
                do("mousemove", 345, 40, "click", 1)
                self.wait_for_change(own, 0.5)
                do("key", "F2")
                self.wait_for_return(own)
            with self.subTest("from above, and with other points"):
                do("key", "0")
                self.wait_for_change(own, 0.2)
                do("key", "r")
                self.wait_for_return(own)
                do("key", "minus", "key", "minus", "key", "minus", "key", "minus", "key", "minus")
                self.wait_for_change(own, 0.05)
                do("key", "plus", "key", "plus", "key", "plus", "key", "plus", "key", "plus")
                self.wait_for_return(own)
            with self.subTest("what is seen is saved, each time into a new file"):
                do("key", "F9")
                wait_until(lambda: len(list(self.folder.glob("theatron-*.png"))) == 1)
                do("key", "F9", "key", "F10")
                wait_until(lambda: len(list(self.folder.glob("theatron-*.png"))) == 2)
                points, = wait_until(lambda: list(self.folder.glob("theatron-*.ply")))
                wait_until(lambda: points.stat().st_size > 10_000)
                header = points.read_bytes().split(b"end_header\n")[0]
                self.assertIn(b"element vertex", header)
                self.assertIn(b"comment x, y, z in metres in the room", header)
            with self.subTest("renderers and codecs are changed"):
                do("key", "m")
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

    def buttons(self):
        return self.screen.buttons(WIDTH, HEIGHT)

    @staticmethod
    def repainted(one, other):
        """Share of the pixels that differ in any colour."""
        pixels = [(a[i:i + 3], b[i:i + 3]) for a, b in zip(one, other) for i in range(0, len(a), 4)]
        return sum(any(abs(x - y) > 16 for x, y in zip(a, b)) for a, b in pixels) / len(pixels)

    def settled(self, pixels):
        """The pixels once the view has arrived: they stay the same for half a second."""
        newest, since = pixels(), time.monotonic()
        while time.monotonic() - since < 0.5:
            time.sleep(0.05)
            again = pixels()
            if self.repainted(newest, again) > 0.01:
                newest, since = again, time.monotonic()
        return newest

    def click(self, place):
        self.screen.do("mousemove", *place, "click", 1, "mousemove", WIDTH - 5, HEIGHT // 2)

    def test_people_and_places_and_a_teleport(self):
        recording = make_recording(self.folder / "placed", frames=1)
        lens = {"width": 160, "height": 120, "fx": 130, "fy": 130, "cx": 80, "cy": 60}
        pose = {"quaternion": [0, 1, 0, 0], "translation": [0, 1.6, 0]}
        (recording / "calibration.json").write_text(json.dumps({"depth": lens, "color": lens, "room_from_camera": pose}))
        do = self.screen.do
        with host(self.folder / "placed_state", f"folder:{recording},loop=1,preload=1") as h, \
                Process("join", h.greeting["link"], "--name", "Anna", "--every", "0.2") as anna, \
                self.window(h.greeting["link"], "--name", "Ben", "--renderer", "splat"):
            own = self.wait_for_scene()
            beside_panel = lambda: self.screen.pixels(340, 60, 130, 200)
            before = beside_panel()
            anna.say("stand 1 1.6 -0.2 0 1.3 -1.2")
            with self.subTest("a button goes beside a person"):
                do("key", "p")
                # Two in the row of Anna once she stands somewhere, then one to call, then places.
                wait_until(lambda: len(b := self.buttons()) >= 3 and b[0][1] == b[1][1])
                self.click(self.buttons()[0])
                wait_until(lambda: self.repainted(before, beside_panel()) > 0.2)
            with self.subTest("a call is an offer, and moves nobody"):
                do("key", "p", "key", "r")
                wait_until(lambda: not self.buttons())
                self.wait_for_return(own)
                before = self.settled(beside_panel)
                anna.say("call")
                wait_until(lambda: len(self.buttons()) == 2)
                time.sleep(0.5)
                self.assertLess(self.repainted(before, beside_panel()), 0.05)
                do("key", "j")
                wait_until(lambda: self.repainted(before, beside_panel()) > 0.2)
                wait_until(lambda: not self.buttons())
            with self.subTest("and K calls the others"):
                do("key", "k")
                anna.wait_for(lambda f: [p["name"] for p in f["room"]["people"] if p["calls"]] == ["Ben"])
                do("key", "k")
                anna.wait_for(lambda f: not any(p["calls"] for p in f["room"]["people"]))
                do("key", "p")
                wait_until(lambda: len(self.buttons()) >= 3)
            with self.subTest("through a person's eyes the view moves with them"):
                self.click(self.buttons()[1])
                time.sleep(0.5)
                through = beside_panel()
                anna.say("stand -1 1.6 -0.2 0 1.3 -1.2")
                wait_until(lambda: self.repainted(through, beside_panel()) > 0.2)
            with self.subTest("and moving ends that"):
                do("key", "p", "key", "r")
                self.wait_for_return(own)
                anna.say("stand 1 1.6 -0.2 0 1.3 -1.2")
                time.sleep(0.5)
                self.assertLess(difference(own, self.picture()), 0.02)
            with self.subTest("T aims, and releasing it goes there"):
                do("mousemove", WIDTH // 2 + 60, HEIGHT // 2 + 40, "keydown", "t")
                time.sleep(1)
                do("keyup", "t")
                self.wait_for_change(own, 0.2)
                do("key", "r")
                self.wait_for_return(own)

    def test_the_wheel_moves_a_list_that_is_longer_than_the_window(self):
        cases = self.folder / "cases"
        write_case(cases / "many", "Many", more_parts=20)
        with host(self.state, self.camera, options=("--cases", cases)) as h, \
                Process("join", h.greeting["link"], "--name", "Ann", "--every", "0.1") as ann, \
                self.window(h.greeting["link"]):
            ann.wait_for(lambda f: f["cases"]["offered"])
            ann.say("case open --yes Many")
            self.wait_for_scene()
            self.screen.do("key", "o")
            wait_until(lambda: len(self.buttons()) > 12)

            def panel():
                return self.screen.pixels(16, 16, 140, 240)  # the panel alone: what is behind it changes by itself

            top = self.settled(panel)
            x, y = self.buttons()[0]
            self.screen.do("mousemove", x, y + 60, *["click", 5] * 12, "sleep", 0.5)
            bottom = self.settled(panel)
            self.assertGreater(self.repainted(top, bottom), 0.02)
            self.screen.do(*["click", 5] * 3, "sleep", 0.5)
            self.assertLess(self.repainted(bottom, self.settled(panel)), 0.01, "there is no more")
            self.screen.do(*["click", 4] * 15, "sleep", 0.5)
            wait_until(lambda: self.repainted(top, panel()) < 0.01)

    # The usual room takes minutes where it was never rendered before.
    small_room = [word for camera in (0, 1)
                  for word in ("--camera", f"synthetic:camera={camera},cameras=2,seconds=2,fps=5,quality=quick")]

    def test_the_demo_is_a_window_where_there_is_a_display(self):
        with Process("demo", "--out", str(self.folder / "demo"), *self.small_room, env=self.screen.environment) as demo:
            demo.wait_until(lambda: self.screen.title().startswith("demo operating room"))
            demo.wait_until(lambda: brightness(self.picture()) > 70)
            demo.send(signal.SIGTERM)
            self.assertEqual(demo.end(), 0, demo.errors)
        self.assertEqual(list((self.folder / "demo").glob("*.png")), [])

    def test_a_demo_without_a_usable_display_writes_pictures(self):
        folder = self.folder / "demo_pictures"
        with Process("demo", "--out", str(folder), "--seconds", "8", *self.small_room,
                     env={**self.screen.environment, "DISPLAY": ":31999"}) as demo:
            self.assertEqual(demo.end(), 0, demo.errors)
            self.assertIn("No window can be opened on this display.", "".join(demo.errors))
        self.assertTrue((folder / "from_between.png").exists())
        # The screen's picture is no old one, whatever the others took: no warning is above it.
        width, height, channels, rows = read_png(folder / "or_screen.png")
        red, green, blue = rows[40][40 * channels:40 * channels + 3]
        self.assertFalse(red > 200 and green > 150 and blue < 120, (red, green, blue))

    def test_a_demo_waits_for_the_camera_that_it_looks_through(self):
        # Its first picture is later than the demo's end; the other camera's are there.
        with Process("demo", "--no-window", "--out", str(self.folder / "demo_of_a_late_camera"), "--seconds", "6",
                     "--camera", "strip:delay=10000", *self.small_room[2:]) as demo:
            self.assertEqual(demo.end(), 1)
            self.assertIn("The demo ended before the first picture", "".join(demo.errors))

    def test_the_next_window_begins_as_the_last_one_ended(self):
        home = self.folder / "home of Ben"
        settings = home / "theatron" / "settings"
        lines = lambda: settings.read_text().splitlines() if settings.exists() else []
        with host(self.state, self.camera) as h, \
                Process("join", h.greeting["link"], "--name", "Anna", "--every", "0.2") as anna:
            anna.say("stand 1 1.6 -0.2 0 1.3 -1.2")
            with self.window(h.greeting["link"], "--name", "Ben", "--renderer", "splat", home=home) as viewer:
                self.wait_for_scene()
                self.screen.do("key", "p")
                wait_until(lambda: {"name Ben", "renderer splat", "people yes"} <= set(lines()))
                viewer.send(signal.SIGTERM)
                viewer.end()
            self.assertNotIn("https", settings.read_text())
            anna.wait_for(lambda f: len(f["room"]["people"]) == 1)
            with self.window(h.greeting["link"], home=home) as viewer:
                wait_until(lambda: " splat " in self.screen.title())
                wait_until(lambda: self.buttons())
                anna.wait_for(lambda f: "Ben" in [p["name"] for p in f["room"]["people"]])
                viewer.send(signal.SIGTERM)
                viewer.end()
            settings.write_text("people perhaps\n")
            with self.window(h.greeting["link"], "--name", "Ben", home=home) as viewer:
                self.wait_for_scene()
                self.assertIn("'people perhaps'", "".join(viewer.errors))
                # No panel is open; the tour of a first visit is there again, with two buttons in one row.
                wait_until(lambda: len(self.buttons()) == 2)
                self.assertEqual(len({y for _, y in self.buttons()}), 1)

    def test_a_form_asks_for_link_and_name_and_comes_back_after_the_session(self):
        home = self.folder / "home of Eva"
        type_in, title = self.screen.do, self.screen.title
        with host(self.state, self.camera) as h, \
                Process("join", "--size", f"{WIDTH}x{HEIGHT}", "--renderer", "splat",
                        env={**self.screen.environment, "XDG_STATE_HOME": str(home)}) as viewer:
            wait_until(lambda: title().startswith("Enter a session"))
            type_in("type", "--delay", "2", h.greeting["link"].replace("join=", "join=x"))
            type_in("key", "Tab", "type", "--delay", "2", "eva")
            # The form says that this token is wrong, and Enter does nothing.
            wait_until(self.has_warning)
            type_in("key", "Return")
            type_in("key", "shift+Tab", "key", "ctrl+a")
            type_in("type", "--delay", "2", h.greeting["link"])
            wait_until(lambda: not self.has_warning() and self.has_main_button())
            self.assertTrue(title().startswith("Enter a session"))
            type_in("key", "Return")
            self.wait_for_scene()
            settings = (home / "theatron" / "settings").read_text()
            self.assertIn("name eva", settings.splitlines())
            self.assertNotIn("https", settings)
            type_in("key", "Escape", "key", "Escape")
            wait_until(lambda: title().startswith("Enter a session") and self.has_main_button())
            type_in("key", "Escape")
            self.assertEqual(viewer.end(), 0, viewer.errors)
            # The next form offers this session, without its link in letters, until it is forgotten.
            links = home / "theatron" / "recent_links"
            self.assertIn(h.greeting["link"], links.read_text())
            self.assertEqual(links.stat().st_mode & 0o777, 0o600)
            with Process("join", "--size", f"{WIDTH}x{HEIGHT}", "--renderer", "splat",
                         env={**self.screen.environment, "XDG_STATE_HOME": str(home)}) as again:
                # Once the form is drawn, the field of the link has the keyboard.
                wait_until(lambda: title().startswith("Enter a session") and self.has_color((52, 66, 84), 1000))
                time.sleep(0.3)
                type_in("key", "Down", "key", "space")
                wait_until(self.has_main_button)
                # Forget, then Sure?
                type_in("key", "Right", "key", "space", "sleep", "0.3", "key", "space")
                wait_until(lambda: not links.read_text())
                type_in("key", "Escape")
                self.assertEqual(again.end(), 0, again.errors)

    def has_color(self, color, least):
        return self.screen.has(color, least, 0, 0, WIDTH, HEIGHT)

    def has_warning(self):
        return self.has_color((255, 190, 70), 20)

    def has_main_button(self):
        """The button that enters the room can be pressed."""
        return self.has_color((36, 104, 176), 1000)

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
            self.assertIn("access code of this link is wrong", "".join(viewer.errors))

    def test_without_a_display_one_sentence_says_what_to_do(self):
        environment = {k: v for k, v in os.environ.items() if k not in ("DISPLAY", "WAYLAND_DISPLAY")}
        link = f"https://127.0.0.1:1/#join=x&cert={'0' * 64}"
        done = patience.run([PROGRAM, "join", link], env={**environment, "SDL_VIDEODRIVER": "x11"})
        self.assertEqual(done.returncode, 1)
        self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
        for word in ("no display", "--offscreen", "--no-window"):
            self.assertIn(word, done.stderr)


if __name__ == "__main__":
    unittest.main()
