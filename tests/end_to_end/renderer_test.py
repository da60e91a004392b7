# SPDX-License-Identifier: Apache-2.0
"""How participants draw, set by the host while they watch."""
import json
import pathlib
import shutil
import signal
import tempfile
import unittest

from theatron_process import Process, host, make_recording, read_png, run, wait_until
from virtual_screen import VirtualScreen, difference

WIDTH, HEIGHT = 480, 360
MIDDLE = 120, 90, 240, 180


class Renderer(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="theatron_renderer_"))
        recording = make_recording(cls.folder / "box", frames=1)
        cls.camera = f"folder:{recording},loop=1,preload=1"

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder)

    def host(self):
        return host(self.folder / "state", self.camera)

    def test_the_hosts_last_word_holds_until_the_viewers_key(self):
        with VirtualScreen(WIDTH, HEIGHT) as screen, self.host() as h, \
                Process("join", h.greeting["link"], "--name", "Dr. A", "--size", f"{WIDTH}x{HEIGHT}", "--renderer",
                        "splat", env=screen.environment) as viewer:
            def drawn(name):
                wait_until(lambda: f" {name} " in screen.title())

            drawn("splat")
            h.say("renderer mesh")
            drawn("mesh")
            screen.do("key", "m")
            drawn("blend")
            with self.subTest("a participant is meant by name, and cannot choose while it is locked"):
                h.say("renderer Dr. A disc lock")
                drawn("disc")
                before = screen.pixels(*MIDDLE)
                screen.do("key", "m", "click", "--repeat", 5, 4)
                # The wheel comes behind the key.
                wait_until(lambda: difference(before, screen.pixels(*MIDDLE)) > 0.1, "the picture from closer by")
                self.assertIn(" disc ", screen.title())
            with self.subTest("what cannot be is told in one sentence and changes nothing"):
                for line, says in (("renderer", "Say 'renderer"), ("renderer all fog", "Say 'renderer"),
                                   ("renderer free lock", "Say 'renderer"), ("renderer 77 mesh", "no participant '77'"),
                                   ("paint", "no command 'paint'")):
                    before = len(h.errors)
                    h.say(line)
                    wait_until(lambda: any(says in e for e in h.errors[before:]))
                drawn("disc")
            with self.subTest("the choice is given back"):
                h.say("renderer all free")
                wait_until(lambda: screen.do("key", "m") == "" and " disc " not in screen.title(), every=0.5)
            with self.subTest("auto is mesh for one camera"):
                h.say("renderer all auto lock")
                drawn("mesh")
            viewer.send(signal.SIGTERM)
            self.assertEqual(viewer.end(), 0)
            self.assertNotIn("reported", "".join(viewer.errors))  # errors of the driver
            self.assertIn("participant draws", "".join(h.errors))  # in the host's log
            self.assertIn("renderer=disc", "".join(h.errors).replace('"', ""))

    def test_who_joins_later_and_writes_pictures_is_told_too(self):
        def picture(link, name, *options):
            path = self.folder / f"{name}.png"
            code, _, errors = run("join", link, "--offscreen", path, "--size", "160x120", "--view",
                                  "camera:0,yaw=30", "--seconds", 0.5, "--color-codec", "jpeg:quality=85", *options)
            self.assertEqual(code, 0, errors)
            return read_png(path)[3]

        with self.host() as h:
            link = h.greeting["link"]
            own = {name: picture(link, name, "--renderer", name) for name in ("splat", "disc")}
            self.assertTrue(own["splat"] != own["disc"])
            h.say("renderer disc")
            self.assertTrue(picture(link, "told", "--renderer", "splat") == own["disc"])

    def test_the_room_goes_on_where_nothing_was_measured(self):
        # A camera whose place is known: 1.6 m above the floor, looking level along -z.
        room = self.folder / "registered"
        shutil.copytree(self.folder / "box", room)
        lens = {"width": 160, "height": 120, "fx": 130, "fy": 130, "cx": 80, "cy": 60}
        pose = {"quaternion": [0, 1, 0, 0], "translation": [0, 1.6, 0]}
        (room / "calibration.json").write_text(json.dumps({"depth": lens, "color": lens, "room_from_camera": pose}))

        with host(self.folder / "state", f"folder:{room},loop=1,preload=1") as h:
            def pictures(name, *options):
                color, depth = self.folder / f"{name}.png", self.folder / f"{name}_depth.png"
                # Automatic colour may become H.264, whose pictures of one frame differ.
                code, _, errors = run("join", h.greeting["link"], "--offscreen", color, "--depth", depth, "--size",
                                      "160x120", "--view", "camera:0,yaw=40", "--renderer", "splat", "--seconds", 0.5,
                                      "--color-codec", "jpeg:quality=85", *options)
                self.assertEqual(code, 0, errors)
                return read_png(color), read_png(depth)

            (_, _, _, alone), (_, _, _, distances) = pictures("alone", "--room", "off")
            measured = [[d != 0 for d in row] for row in distances]

            def compare(rows, where):
                """Share of the pixels that are as without the room."""
                same = [alone[y][3 * x:3 * x + 3] == rows[y][3 * x:3 * x + 3]
                        for y in range(120) for x in range(160) if measured[y][x] == where]
                return sum(same) / len(same)

            for quality in ("low", "high"):
                with self.subTest(quality=quality):
                    (_, _, _, rows), (_, _, _, with_room) = pictures(quality, "--quality", quality)
                    self.assertTrue(with_room == distances, "the depth file is of the clouds alone")
                    self.assertEqual(compare(rows, True), 1, "the clouds are untouched")
                    self.assertLess(compare(rows, False), 0.5)
            with self.subTest("the two eyes' pictures lie beside each other"):
                (width, _, _, pair), _ = pictures("pair", "--stereo")
                self.assertEqual(width, 320)
                self.assertTrue([row[:480] for row in pair] != [row[480:] for row in pair])


if __name__ == "__main__":
    unittest.main()
