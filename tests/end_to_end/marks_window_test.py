# SPDX-License-Identifier: Apache-2.0
"""A case in the window: marks with the mouse, pointing, and the keys of the case, as another participant sees them."""
import json
import pathlib
import shutil
import tempfile
import unittest

from case_test import has_all, parts_of, write_case
from marks_test import marks
from room_test import member, people
from theatron_process import Process, host, make_recording, wait_until
from virtual_screen import VirtualScreen, brightness

WIDTH, HEIGHT = 480, 360
# Places of the window, with the case three times life size: on its shell, on the box of the live cloud, and nothing.
ORGAN, ORGAN_LEFT, ORGAN_RIGHT, BOX, BOX_BELOW, AIR = (240, 230), (210, 230), (280, 230), (80, 170), (80, 250), (5, 5)


class MarksWindow(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="theatron_marks_window_"))
        self.addCleanup(shutil.rmtree, self.folder)
        recording = make_recording(self.folder / "box", frames=1)
        lens = {"width": 160, "height": 120, "fx": 130, "fy": 130, "cx": 80, "cy": 60}
        pose = {"quaternion": [0, 1, 0, 0], "translation": [0, 1.3, 1]}
        (recording / "calibration.json").write_text(json.dumps({"depth": lens, "color": lens, "room_from_camera": pose}))
        write_case(self.folder / "cases" / "liver", pictures=[(90, 40, 40), (40, 90, 40), (40, 40, 90)])
        self.camera = f"folder:{recording},loop=1,preload=1"
        self.screen = VirtualScreen(WIDTH, HEIGHT)
        self.addCleanup(self.screen.__exit__)

    def drag(self, begin, end, *before, after=()):
        steps = [part for i in (0.3, 0.7, 1) for part in
                 ("mousemove", *(round(a + i * (b - a)) for a, b in zip(begin, end)), "sleep", 0.15)]
        self.screen.do(*before, "mousemove", *begin, "sleep", 0.15, "mousedown", 1, "sleep", 0.15, *steps, "mouseup", 1, *after)

    def buttons(self):
        return self.screen.buttons(WIDTH, HEIGHT)

    def press(self, place):
        self.screen.do("mousemove", *place, "click", 1)

    def test_marks_pointing_and_the_keys_of_the_case(self):
        do = self.screen.do
        with host(self.folder / "state", self.camera, options=("--cases", self.folder / "cases")) as h, \
                member(h.greeting["link"], "Anna") as anna, \
                Process("join", h.greeting["link"], "--name", "Wim Dow", "--size", f"{WIDTH}x{HEIGHT}", "--render-scale", "1",
                        "--renderer", "mesh", "--quality", "low", env=self.screen.environment) as window:
            anna.wait_for(lambda f: f["cases"]["offered"] and people(f) == ["Anna", "Wim Dow"])
            wait_until(lambda: brightness(self.screen.pixels(60, 90, 300, 150)) > 60)
            with self.subTest("O offers the case, and its button opens it before the person"):
                do("mousemove", *AIR, "key", "o")
                wait_until(lambda: len(self.buttons()) == 1)
                self.press(self.buttons()[0])
                # The panel asks whether it is the right patient; its first button opens the case.
                wait_until(lambda: len(self.buttons()) == 2)
                self.press(self.buttons()[0])
                anna.wait_for(has_all)
                do("key", "o")
                wait_until(lambda: not self.buttons())
            anna.say("case close")
            anna.wait_for(lambda f: not f["cases"]["open"])
            anna.say("case open --yes Made liver")
            anna.wait_for(has_all)
            anna.say("case scale 3")
            organ = anna.newest_json()["cases"]["open"]["object"]
            shell = parts_of(anna.newest_json())["liver"]["object"]
            with self.subTest("I moves the slice to the place under the mouse"):
                before = anna.newest_json()["cases"]["open"]["screen"]["position_mm"]
                do("mousemove", *ORGAN, "sleep", 0.5, "key", "i")
                found = anna.wait_for(lambda f: f["cases"]["open"]["screen"]["position_mm"] != before)
                # 50 pixels below the middle, on a surface about 0.8 m away, three times life size.
                self.assertAlmostEqual(found["cases"]["open"]["screen"]["position_mm"], -33, delta=6)
            with self.subTest("a stroke is drawn onto the organ"):
                do("key", "z")
                wait_until(lambda: len(self.buttons()) == 9)
                self.drag(ORGAN, ORGAN_RIGHT)
                stroke = marks(anna.wait_for(lambda f: len(marks(f)) == 1))[0]
                self.assertEqual((stroke["kind"], stroke["object"], stroke["initials"]), ("stroke", shell, "WD"))
                for x, y, z in stroke["points"]:
                    self.assertAlmostEqual((x * x + y * y + z * z) ** 0.5, 0.08, 2, "on the shell, in its frame")
            with self.subTest("a distance on the live cloud says how certain it is"):
                self.press(self.buttons()[3])
                self.drag(BOX, BOX_BELOW)
                distance = marks(anna.wait_for(lambda f: len(marks(f)) == 2))[1]
                self.assertEqual((distance["kind"], distance["surface"]), ("distance", "cloud"))
                self.assertAlmostEqual(distance["length_m"], 0.185, delta=0.01)
                # The pixels are 7 mm wide there: 2.8 mm for both ends; and a little noise.
                self.assertTrue(0.002 < distance["deviation_m"] < 0.004, distance)
            with self.subTest("a distance on a slice is of life size"):
                screen = anna.newest_json()["cases"]["open"]["screen"]["object"]
                anna.say(f"grab {screen}")
                anna.say("move 0.3 1.35 0.4")
                anna.say("release")
                anna.wait_for(lambda f: any(o["id"] == screen and o["position"][2] == 0.4 for o in f["room"]["objects"]))
                do("sleep", 0.5)
                self.drag((390, 130), (390, 180))
                on_slice = marks(anna.wait_for(lambda f: len(marks(f)) == 3))[2]
                self.assertEqual((on_slice["surface"], on_slice["object"]), ("slice", screen))
                # The picture of 192 mm is 0.5 m large: 50 pixels at 0.6 m are 77 mm, and so 29.5 mm of the patient.
                self.assertAlmostEqual(on_slice["length_m"], 0.0295, delta=0.003)
            with self.subTest("I over a slice shows the next plane through that place, and the wheel shows other pictures"):
                on_screen = lambda f: f["cases"]["open"]["screen"]
                do("mousemove", 390, 150, "sleep", 0.3, "key", "i")
                anna.wait_for(lambda f: on_screen(f)["orientation"] == 1)
                anna.say("case picture 2")
                anna.wait_for(lambda f: on_screen(f)["picture"] == 2)
                seen = []
                for button in (4, 5, 5):
                    before = on_screen(anna.newest_json())["picture"]
                    do("sleep", 0.3, "mousemove", 390, 150, "click", button)
                    seen.append(on_screen(anna.wait_for(lambda f: on_screen(f)["picture"] != before))["picture"])
                self.assertIn(seen, ([1, 2, 3], [3, 2, 1]))
                anna.say("case slice axial")
                anna.wait_for(lambda f: on_screen(f)["picture"] is None)
            with self.subTest("an arrow has a click at each of its ends"):
                self.press(self.buttons()[1])
                do("sleep", 0.3)
                for place in (BOX, BOX_BELOW):
                    do("mousemove", *place, "sleep", 0.3, "mousedown", 1, "sleep", 0.15, "mouseup", 1, "sleep", 0.3)
                arrow = marks(anna.wait_for(lambda f: len(marks(f)) == 4))[3]
                self.assertEqual((arrow["kind"], len(arrow["points"])), ("arrow", 2))
                do("key", "BackSpace")
                anna.wait_for(lambda f: len(marks(f)) == 3)
            with self.subTest("Escape gives up what is drawn, and does not leave"):
                do("mousemove", *BOX, "sleep", 0.3, "click", 1, "sleep", 0.3, "key", "Escape", "sleep", 0.3, "key", "Escape")
                # Each of them would be the other end, or leave; two presses make an arrow again.
                for place in (BOX, BOX_BELOW):
                    do("mousemove", *place, "sleep", 0.3, "mousedown", 1, "sleep", 0.15, "mouseup", 1, "sleep", 0.3)
                anna.wait_for(lambda f: len(marks(f)) == 4)
                do("key", "BackSpace")
                anna.wait_for(lambda f: len(marks(f)) == 3)
            with self.subTest("a drag that begins on nothing neither draws nor turns the view"):
                head = lambda f: next(p["head"] for p in f["room"]["people"] if p["name"] == "Wim Dow")
                home = head(anna.newest_json())
                # Farther back the camera's surfaces do not fill the picture.
                do("keydown", "s", "sleep", 1, "keyup", "s", "sleep", 0.5)
                stands = []
                anna.wait_for(lambda f: stands.append(head(f)) or (len(stands) > 1 and stands[-1] == stands[-2] and stands[-1][2] > home[2] + 0.5))
                before = stands[-1]
                self.drag(AIR, (200, 30), after=("sleep", 0.5))
                newest = anna.newest_json()
                self.assertEqual((head(newest), len(marks(newest))), (before, 3))
                do("mousemove", *AIR, "key", "r")
                anna.wait_for(lambda f: head(f) == home)
            with self.subTest("Backspace takes the newest back, and the mouse turns the view again"):
                do("key", "BackSpace")
                anna.wait_for(lambda f: len(marks(f)) == 2)
                do("mousemove", *AIR, "key", "z")
                wait_until(lambda: not self.buttons())
            with self.subTest("F, held, points"):
                points = lambda f: [p["name"] for p in f["room"]["people"] if p["points"]]
                do("mousemove", *BOX, "keydown", "f")
                anna.wait_for(lambda f: points(f) == ["Wim Dow"])
                do("keyup", "f")
                anna.wait_for(lambda f: not points(f))
            with self.subTest("the left button holds the organ, with Shift its part"):
                place = lambda f, number: next(o for o in f["room"]["objects"] if o["id"] == number)
                held_by = lambda number: lambda f: place(f, number)["held_by"] != 0
                before = place(anna.newest_json(), organ)["position"]
                self.drag(ORGAN, ORGAN_RIGHT, after=("sleep", 0.2))
                anna.wait_for(lambda f: place(f, organ)["position"] != before and not held_by(organ)(f))
                self.assertEqual(place(anna.newest_json(), shell)["position"], [0, 0, 0])
                self.drag(ORGAN, ORGAN_LEFT, "keydown", "shift", after=("sleep", 0.2, "keyup", "shift"))
                anna.wait_for(lambda f: place(f, shell)["position"] != [0, 0, 0] and not held_by(shell)(f))
            do("key", "Escape", "key", "Escape")
            self.assertEqual(window.end(), 0, "".join(window.errors))
            self.assertNotIn("reported", "".join(window.errors))


if __name__ == "__main__":
    unittest.main()
