# SPDX-License-Identifier: Apache-2.0
"""A shared video is a screen in the room of everybody, and harms no camera."""
import os
import pathlib
import shutil
import signal
import tempfile
import unittest

from room_test import member
from theatron_process import Process, host, make_recording, read_png, run, wait_until
from virtual_screen import VirtualScreen

WIDTH, HEIGHT = 320, 180


def write_video(path, frames):
    """Uncompressed: pure green in limited range."""
    pixels = WIDTH * HEIGHT
    picture = b"FRAME\n" + bytes([173]) * pixels + bytes([42]) * pixels + bytes([26]) * pixels
    path.write_bytes(f"YUV4MPEG2 W{WIDTH} H{HEIGHT} F30:1 Ip A1:1 C444\n".encode() + picture * frames)


def camera(figures, name):
    return next((c for c in figures["cameras"] if c["name"] == name), None)


def screen(figures, name):
    """The object of a shared screen whose source is here."""
    return next((o for o in figures["room"]["objects"]
                 if "screen" in o and o["screen"]["name"] == name and o["screen"]["camera"] is not None), None)


def is_green(pixel):
    return pixel[0] < 40 and pixel[1] > 235 and pixel[2] < 40


def row_of(buttons, count):
    """The first row with `count` buttons."""
    rows = {}
    for x, y in buttons:
        rows.setdefault(y, []).append((x, y))
    return next((row for row in rows.values() if len(row) == count), [])


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
                both = seen.wait_for(lambda f: camera(f, "scope") and camera(f, "scope")["frames"] > 20)
                self.assertEqual(camera(both, "scope")["filter"], "")
                cart.wait_for(lambda f: f["cameras"][0]["state"] == "live")
                picture = self.folder / "seen.png"
                code, _, errors = run("join", h.greeting["link"], "--offscreen", picture, "--size",
                                      "320x240", "--seconds", "1", "--color-codec", "raw")
                self.assertEqual(code, 0, errors)
                _, _, _, rows = read_png(picture)
                middle = rows[120][3 * 160:3 * 160 + 3]
                self.assertTrue(is_green(middle), tuple(middle))
            with Process("publish", h.greeting["publish_link"], "--share", shared, "--every", "0.2"), \
                    Process("join", h.greeting["link"], "--every", "0.2") as seen:
                seen.wait_for(lambda f: camera(f, "scope") and camera(f, "scope")["state"] == "ended" and
                              camera(f, "lamp")["state"] == "live")

    def person(self, link, name):
        """Somebody with a program of their own."""
        environment = os.environ | {"XDG_STATE_HOME": str(self.folder / name)}
        return member(link, name, env=environment)

    def is_green_in_the_middle(self, link):
        """Whether the screen's picture comes, within some tries."""
        return any(is_green(self.middle_of_picture(link)) for _ in range(10))

    def middle_of_picture(self, link):
        picture = self.folder / "middle.png"
        code, _, errors = run("join", link, "--offscreen", picture, "--size", "160x120", "--seconds", "1",
                              "--color-codec", "raw")
        self.assertEqual(code, 0, errors)
        return tuple(read_png(picture)[3][60][3 * 80:3 * 80 + 3])

    def test_screens_are_moved_scaled_pinned_kept_recorded_and_ended(self):
        tower = self.folder / "tower.y4m"
        write_video(tower, 60)
        recording = self.folder / "session.mkv"
        share = ("--share", f"{self.video},loop=1,width=0.6", "--may-record", "--every", "0.2", "--name", "cart")
        environment = os.environ | {"XDG_STATE_HOME": str(self.folder / "cart")}
        with host(self.folder / "state3", self.lamp) as h, \
                self.person(h.greeting["links"]["operator"], "Dora") as dora, \
                self.person(h.greeting["link"], "Ben") as ben, \
                Process("publish", h.greeting["publish_link"], *share, "--share", f"{tower},loop=1,width=0.6",
                        env=environment) as cart:
            both = ben.wait_for(lambda f: screen(f, "scope") and screen(f, "tower"))
            places = [screen(both, name)["position"] for name in ("scope", "tower")]
            self.assertGreater(max(abs(a - b) for a, b in zip(*places)), 0.6, places)
            number = screen(both, "scope")["id"]
            recorder = Process("record", h.greeting["link"], recording, "--json")
            self.addCleanup(recorder.__exit__)
            ben.wait_for(lambda f: any(p["records"] for p in f["room"]["people"]))
            # Before the wall that the camera sees.
            ben.say(f"grab {number}")
            ben.say("move 0 1.5 -0.5")
            ben.say("width 0.4")
            dora.wait_for(lambda f: screen(f, "scope") and screen(f, "scope")["held_by"]
                          and screen(f, "scope")["position"] == [0, 1.5, -0.5] and screen(f, "scope")["scale"] == 0.4)
            ben.say("release")
            dora.wait_for(lambda f: not screen(f, "scope")["held_by"])
            dora.say(f"pin {number}")
            ben.wait_for(lambda f: screen(f, "scope")["screen"]["pinned"])
            ben.say(f"grab {number}")
            ben.wait_for_error("This screen is pinned")
            ben.say(f"unpin {number}")
            ben.wait_for_error("Only the person who shares this and operators may do that")
            self.assertTrue(self.is_green_in_the_middle(h.greeting["link"]))
            code, _, errors = run("join", h.greeting["link"], "--or-screen", "--offscreen", self.folder / "or.png",
                                  "--size", "640x480", "--seconds", "1")
            self.assertEqual(code, 0, errors)
            recorder.send(signal.SIGTERM)
            self.assertIn(recorder.end(), (0, 3), "".join(recorder.errors))

            # One share is ended for all; its publisher goes on with the other.
            dora.say(f"end {screen(both, 'tower')['id']}")
            ben.wait_for(lambda f: not screen(f, "tower") and not camera(f, "tower"))
            cart.wait_for_error('Dora has ended the share of "tower"')
            cart.wait_for(lambda f: [c["share_ended"] for c in f["cameras"]] == [False, True])
            h.send(signal.SIGTERM)
            self.assertEqual(h.end(), 0, "".join(h.errors))
        with host(self.folder / "state3", self.lamp) as h, \
                self.person(h.greeting["links"]["operator"], "Dora") as dora, \
                Process("publish", h.greeting["publish_link"], *share, env=environment) as cart:
            kept = screen(dora.wait_for(lambda f: screen(f, "scope")), "scope")
            self.assertEqual((kept["position"], kept["scale"], kept["screen"]["pinned"]), ([0, 1.5, -0.5], 0.4, True))
            dora.say(f"end {kept['id']}")
            self.assertEqual(cart.end(), 0, "nothing is left to send")
            dora.wait_for(lambda f: not screen(f, "scope") and not camera(f, "scope"))
        with host(self.folder / "state4", f"recording:{recording}", f"recording:{recording},camera=1") as h, \
                self.person(h.greeting["link"], "Ben") as ben:
            ben.wait_for(lambda f: screen(f, "scope") and screen(f, "scope")["recorded"]
                         and screen(f, "scope")["screen"]["pinned"]
                         and screen(f, "scope")["position"] == [0, 1.5, -0.5])

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

    def test_the_mouse_moves_a_screen_and_its_panel_pins_and_ends_it(self):
        # High enough for the panel of screens.
        width, height, middle = 720, 760, (360, 380)
        shared = f"{self.video},loop=1,width=0.2,place=0:1.5:-0.5"
        environment = os.environ | {"XDG_STATE_HOME": str(self.folder / "cart")}
        with VirtualScreen(width, height) as x11, host(self.folder / "state5", self.lamp) as h, \
                self.person(h.greeting["link"], "Ben") as ben, \
                Process("publish", h.greeting["publish_link"], "--share", shared, env=environment) as cart, \
                Process("join", h.greeting["links"]["operator"], "--name", "Dora", "--size", f"{width}x{height}",
                        "--render-scale", "1", "--renderer", "mesh", "--quality", "low", env=x11.environment) as window:
            scope = lambda f: screen(f, "scope")
            ben.wait_for(lambda f: scope(f) and len(f["room"]["people"]) == 2)
            blue_green_red = lambda x, y: x11.pixels(x, y, 1, 1)[0][:3]
            is_shown = lambda x, y: is_green(blue_green_red(x, y)[::-1])
            wait_until(lambda: is_shown(*middle))
            # The window offers the way to a new screen; "Not now" is the second button.
            buttons = lambda: x11.buttons(width, height)
            wait_until(lambda: len(buttons()) == 2)
            x11.do("mousemove", *buttons()[1], "click", 1)
            wait_until(lambda: not buttons())
            drag = ("mousemove", *middle, "sleep", 0.2, "mousedown", 1, "sleep", 0.2, "mousemove", 400, 380, "sleep", 0.2)
            end_drag = ("mousemove", 440, 380, "sleep", 0.2, "mouseup", 1)
            x11.do(*drag, "key", "plus", "sleep", 0.2, *end_drag)
            moved = scope(ben.wait_for(lambda f: scope(f) and scope(f)["position"][0] > 0.05 and not scope(f)["held_by"]))
            self.assertAlmostEqual(moved["position"][1], 1.5, places=2)
            self.assertAlmostEqual(moved["scale"], 0.2 * 1.15)
            wait_until(lambda: is_shown(440, 380))

            # The last button of the bar, and "Screens" in its panel, by the keyboard.
            x11.do("mousemove", 700, 600, "key", "shift+Tab", "key", "Return")
            window.wait_until(lambda: len(buttons()) >= 6)
            x11.do(*["key", "Tab"] * 7, "key", "Return", "key", "Escape")
            # Show, Smaller, Larger, Pin in place, End share: the first row of five.
            five = lambda: wait_until(lambda: len(row := row_of(buttons(), 5)) == 5 and row)
            x11.click_until(lambda: five()[3], ben, lambda f: scope(f)["screen"]["pinned"])
            x11.do("mousemove", 440, 380, "mousedown", 1, "sleep", 0.2, "mousemove", 400, 380, "sleep", 0.2, "mouseup", 1)
            self.assertEqual(scope(ben.newest_json())["position"], moved["position"])
            # Show goes to it: its picture is wide then.
            three = lambda: wait_until(lambda: len(row := row_of(buttons(), 3)) == 3 and row)
            x11.do("mousemove", *three()[0], "click", 1)
            wait_until(lambda: is_shown(width // 2, height // 2) and is_shown(width // 4, height // 2))
            x11.click_until(lambda: three()[2], ben, lambda f: not scope(f))
            self.assertEqual(cart.end(), 0)
            x11.do("key", "Escape", "key", "Escape")
            self.assertEqual(window.end(), 0, "".join(window.errors))


if __name__ == "__main__":
    unittest.main()
