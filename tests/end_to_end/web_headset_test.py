# SPDX-License-Identifier: Apache-2.0
"""The browser client with a simulated headset (iwer): controllers, hands and AR among native participants."""
import os
import pathlib
import shutil
import tempfile
import time
import unittest

from case_test import has_all, write_case
from page_case import PageCase
from theatron_process import Process, read_png, run, wait_until

PICTURES = os.environ.get("THEATRON_PICTURES")  # a folder where pictures of the page stay
HERE = pathlib.Path(__file__).parent
IWER = HERE / "node_modules/iwer/build/iwer.min.js"
CAMERAS = ("synthetic:seconds=2,fps=5,quality=quick,loop=1",)
SIZE = (320, 180)  # software drivers draw two eyes


def distance(a, b):
    return sum((x - y) ** 2 for x, y in zip(a, b)) ** 0.5


@unittest.skipUnless(IWER.exists(), "iwer is not installed: npm ci --prefix tests/end_to_end")
class WebHeadset(PageCase):
    cameras = CAMERAS

    @classmethod
    def setUpClass(cls):
        cases = pathlib.Path(tempfile.mkdtemp(prefix="theatron_headset_"))
        cls.addClassCleanup(shutil.rmtree, cases)
        write_case(cases / "liver")
        cls.options = ("--cases", cases)
        super().setUpClass()
        cls.ben = cls.stack.enter_context(Process("join", cls.link, "--name", "Ben", "--every", "0.1"))
        cls.page = cls.browser.open("about:blank", SIZE)
        for file in (IWER, HERE / "headset.js"):
            cls.page.call("Page.addScriptToEvaluateOnNewDocument", source=file.read_text())
        cls.page.call("Page.navigate", url=cls.link)
        # A machine without a graphics card would go over to the 2D view.
        cls.page.enter(way="room")
        cls.page.wait_for("theatron.state.pictures > 0 && theatron.state.people.length === 2")

    def tearDown(self):
        if self.page.evaluate("theatron.headset.is_on"):
            self.page.evaluate("theatron.headset.leave()")
            self.page.wait_for("!theatron.headset.is_on")
        self.remove_bricks()
        self.assertEqual(self.page.problems, [])

    def remove_bricks(self):
        """A brick of one test would lie where the next one takes its own."""
        def holds_none(facts):
            return all(o["held_by"] == 0 for o in self.bricks(facts))
        for brick in self.bricks(self.ben.wait_for(holds_none)):
            self.ben.say(f"grab {brick['id']}")
            self.wait_for_holder(brick["id"], "Ben")
            self.ben.say("remove")
        self.ben.wait_for(lambda f: not self.bricks(f))

    def enter(self, kind="vr"):
        """From the first camera's view, so that nothing stands between the person and what they make."""
        self.page.evaluate("document.getElementById('view').focus()")
        self.page.press("1", "Digit1")
        drawn = self.page.evaluate("theatron.state.pictures")
        self.page.wait_for(f"theatron.state.pictures > {drawn + 1}")
        self.page.evaluate("simulated_headset.rest()")
        self.page.wait_for(f"!document.getElementById('enter_{kind}').hidden")
        self.page.evaluate(f"document.getElementById('enter_{kind}').click()")
        self.page.wait_for("theatron.headset.is_on")
        self.frames(1)
        self.ben.newest_json()  # the ones before it are of another session

    def frames(self, count):
        seen = self.page.evaluate("simulated_headset.frames")
        self.page.wait_for(f"simulated_headset.frames >= {seen + count}")

    def keep_picture(self, name):
        """For those who look at pictures: none is taken otherwise, since each takes the page a while."""
        if PICTURES:
            self.picture(name)

    def picture(self, name):
        file = pathlib.Path(PICTURES or self.folder) / f"{name}.png"
        self.page.screenshot(file)
        return read_png(file)

    def headset(self, script):
        """Runs a line for the simulated headset, and waits until the page has seen its effect."""
        self.page.evaluate(f"simulated_headset.{script}")
        self.frames(1)

    def person(self, facts, name="Ada"):
        return next((person for person in facts["room"]["people"] if person["name"] == name), {})

    def ada_when(self, condition):
        """Ada as Ben knows her, once that is true."""
        def holds(facts):
            ada = self.person(facts)
            return "head" in ada and condition(ada)
        return self.person(self.ben.wait_for(holds))

    def bricks(self, facts):
        return [o for o in facts["room"]["objects"] if o["kind"] == "brick"]

    def choose(self, row, rows):
        """A row of the menu, by the right controller."""
        self.headset("device.controllers.left.updateButtonValue('y-button', 1)")
        self.headset("device.controllers.left.updateButtonValue('y-button', 0)")
        self.headset(f"aim_at_row({row}, {rows})")
        self.keep_picture(f"headset_menu_{row}")
        self.headset("grip('right', true)")
        self.headset("grip('right', false)")
        self.headset("device.controllers.left.updateButtonValue('y-button', 1)")
        self.headset("device.controllers.left.updateButtonValue('y-button', 0)")

    def press(self, row, labels, label):
        """A button of the panels' plate, by the right controller: the buttons of its row, which stand at the right."""
        widths = [0.0084 * len(each) + 0.024 for each in labels]
        left = 0.5 - 0.012 - sum(width + 0.006 for width in widths[labels.index(label):])
        self.headset(f"aim_at_plate({row}, {left + widths[labels.index(label)] / 2})")
        self.keep_picture(f"headset_press_{label}")
        self.click()

    def click(self):
        self.headset("grip('right', true)")
        self.headset("grip('right', false)")

    def choose_tool(self, row, labels, label):
        self.choose(1, 13)
        self.press(row, labels, label)
        self.page.wait_for(f"theatron.state.overlay.notice.includes('{label}')")

    def draw(self, *places):
        """From place to place with the trigger pressed."""
        self.headset(f"aim('right', [0.2, 1.3, -0.2], {list(places[0])})")
        self.headset("grip('right', true)")
        for place in places[1:]:
            self.headset(f"aim('right', [0.2, 1.3, -0.2], {list(place)})")
        self.keep_picture("headset_draws")
        self.headset("grip('right', false)")

    def marks(self, facts):
        return [o["mark"] for o in facts["room"]["objects"] if o["kind"] == "mark"]

    def make_brick(self):
        """A brick 0.8 m ahead of the head."""
        before = len(self.bricks(self.ben.newest_json()))
        self.choose(9, 13)
        made = self.ben.wait_for(lambda f: len(self.bricks(f)) > before)
        return self.bricks(made)[-1]["id"]

    def brick(self, number):
        return next(o for o in self.bricks(self.ben.newest_json()) if o["id"] == number)

    def wait_for_holder(self, number, name):
        def holds(facts):
            holder = self.person(facts, name).get("id") if name else 0
            return any(o["id"] == number and o["held_by"] == holder for o in self.bricks(facts))
        return self.ben.wait_for(holds)

    def colors_of_eyes(self):
        """How many colours the left and the right eye see."""
        width, height, channels, rows = self.picture("headset_vr")
        half = width // 2
        return [len({bytes(rows[y][channels * x:channels * x + 3])
                     for y in range(40, height - 60, 5) for x in range(left + half // 3, left + half - 5, 3)})
                for left in (0, half)]

    def light_of_corners(self, name):
        """The mean of all colours in the lower outer corner of each eye, where no text is."""
        width, height, channels, rows = self.picture(name)
        values = [value for y in range(height - 20, height, 3) for left in (0, width - 20) for x in range(left, left + 20, 3)
                  for value in rows[y][channels * x:channels * x + 3]]
        return sum(values) / len(values)

    def test_both_eyes_see_the_room_and_the_view_goes_on_at_the_window(self):
        self.enter()
        # The sides of the room are painted one after the other.
        wait_until(lambda: min(self.colors_of_eyes()) > 200)
        width, height, channels, rows = self.picture("headset_vr")
        half = width // 2
        # The eyes are apart: the halves are not the same picture.
        left, right = ([rows[height // 2][channels * x] for x in range(at, at + half)] for at in (0, half))
        self.assertNotEqual(left, right)
        # The others see the head where the headset is.
        before = self.ada_when(lambda ada: "right_hand" in ada)
        self.headset("device.position.set(0.5, 1.2, 0)")
        after = self.ada_when(lambda ada: abs(ada["head"][1] - 1.2) < 0.01)
        self.assertAlmostEqual(distance(after["head"], before["head"]), (0.5 ** 2 + 0.4 ** 2) ** 0.5, delta=0.02)
        self.headset("device.position.set(0, 1.6, 0)")
        self.page.evaluate("theatron.headset.leave()")
        self.page.wait_for("!theatron.headset.is_on")
        drawn = self.page.evaluate("theatron.state.pictures")
        self.page.wait_for(f"theatron.state.pictures > {drawn + 2}")
        self.ada_when(lambda ada: "right_hand" not in ada)
        self.keep_picture("headset_left")

    def test_controllers_take_a_brick_and_give_it_to_a_native_participant(self):
        self.ben.say("stand 0 1.6 -1 0 1.6 0")
        self.enter()
        number = self.make_brick()
        place = self.brick(number)["position"]
        self.headset("aim('right', [0.2, 1.3, -0.2], [0, 1.6, -0.8])")
        self.keep_picture("headset_ray")
        self.headset("grip('right', true)")
        self.wait_for_holder(number, "Ada")
        self.headset("aim('right', [0.2, 1.3, -0.2], [0.5, 1.6, -0.8])")
        self.ben.wait_for(lambda f: distance(self.bricks(f)[-1]["position"], place) > 0.2)
        self.keep_picture("headset_held")
        self.headset("device.controllers.right.updateButtonValue('a-button', 1)")
        self.wait_for_holder(number, "Ben")
        self.headset("device.controllers.right.updateButtonValue('a-button', 0)")
        self.headset("grip('right', false)")
        self.ben.say("release")
        self.wait_for_holder(number, None)

    def test_the_stick_teleports_and_turns_and_the_others_see_it(self):
        self.enter()
        start = self.ada_when(lambda ada: "right_hand" in ada)
        self.headset("device.controllers.right.updateAxes('thumbstick', 1, 0)")
        self.headset("device.controllers.right.updateAxes('thumbstick', 0, 0)")
        turned = self.ada_when(lambda ada: distance(ada["right_hand"], start["right_hand"]) > 0.05)
        self.assertLess(distance(turned["head"], start["head"]), 0.02)
        self.headset("aim('right', [0.2, 1.3, -0.2], [0.7, 0.3, -1.2])")
        self.headset("device.controllers.right.updateAxes('thumbstick', 0, -1)")
        self.keep_picture("headset_teleport")
        self.headset("device.controllers.right.updateAxes('thumbstick', 0, 0)")
        there = self.ada_when(lambda ada: distance(ada["head"], start["head"]) > 0.8)
        self.assertAlmostEqual(there["head"][1], start["head"][1], delta=0.02)
        # Walking darkens the sides; seated people are lifted.
        standing = self.light_of_corners("headset_standing")
        self.headset("device.controllers.left.updateAxes('thumbstick', 0, -1)")
        self.frames(4)
        self.assertLess(self.light_of_corners("headset_vignette"), standing / 2)
        self.headset("device.controllers.left.updateAxes('thumbstick', 0, 0)")
        self.frames(4)
        self.assertGreater(self.light_of_corners("headset_stopped"), standing / 2)
        self.headset("device.position.set(0, 1.2, 0)")
        self.choose(6, 13)
        self.ada_when(lambda ada: abs(ada["head"][1] - 1.65) < 0.02)
        self.headset("device.position.set(0, 1.6, 0)")

    def test_after_a_recentre_one_stands_where_one_stood(self):
        self.enter()
        start = self.ada_when(lambda ada: "right_hand" in ada)["head"]
        self.headset("look(0.6, 1.6, -0.5, 0.7)")
        self.ada_when(lambda ada: distance(ada["head"], start) > 0.7)
        self.headset("recentre(false)")
        self.ada_when(lambda ada: distance(ada["head"], start) < 0.02)

    def test_in_ar_the_table_keeps_its_place_after_a_recentre_or_is_placed_again(self):
        self.enter("ar")
        self.headset("look(0.6, 1.6, -0.5, 0.7)")
        self.headset("aim('right', [0.3, 1.0, -1.2], [1.3, 1.0, -1.2])")
        self.headset("grip('right', true)")
        self.headset("grip('right', false)")
        self.frames(2)
        time.sleep(0.5)
        self.ben.newest_json()
        # Over the table, where the other hand was: the place of the room's origin.
        over = self.ada_when(lambda ada: "right_hand" in ada and (ada["right_hand"][0] ** 2 + ada["right_hand"][2] ** 2) ** 0.5 < 0.15)
        self.headset("recentre(true)")
        self.frames(2)
        time.sleep(0.5)
        self.ben.newest_json()
        kept = self.ada_when(lambda ada: "right_hand" in ada)
        for part in ("head", "right_hand"):
            self.assertLess(distance(kept[part], over[part]), 0.02)
        # Nobody knows how the space moved: the place is asked for again, and until then the person is told so.
        self.headset("look(-0.4, 1.6, 0.3, -0.5)")
        self.headset("recentre(false)")
        self.page.wait_for("theatron.state.overlay.notice.includes('lost the table')")
        self.frames(3)
        # The way to do it is written before the eyes.
        wait_until(lambda: min(self.page.evaluate("simulated_headset.opaque()")) > 0)
        self.keep_picture("headset_ar_lost")
        self.headset("aim('right', [0.2, 1.0, -0.7], [1.2, 1.0, -0.7])")
        self.headset("grip('right', true)")
        self.headset("grip('right', false)")
        self.page.wait_for("theatron.state.overlay.notice.includes('table is placed')")
        self.ada_when(lambda ada: (ada["right_hand"][0] ** 2 + ada["right_hand"][2] ** 2) ** 0.5 < 0.15)

    def test_the_display_is_asked_for_its_usual_rate_fewer_pixels_at_the_sides_and_those_that_can_be_drawn(self):
        self.page.evaluate("simulated_headset.asked = { rates: [], scales: [] }")
        self.enter()
        self.assertEqual(self.page.evaluate("simulated_headset.asked.rates"), [72])
        self.assertEqual(self.page.evaluate("theatron.headset.layer.fixedFoveation"), 0.5)
        self.page.evaluate("globalThis.kept_client = theatron.headset.client")
        self.addCleanup(self.page.evaluate, "theatron.headset.client = kept_client; true")
        self.page.evaluate("theatron.headset.client = { ...theatron.headset.client, headset_scale: () => 0.625 };"
                           "simulated_headset.asked.scales = []")
        self.frames(2)
        scales = self.page.evaluate("simulated_headset.asked.scales")
        self.assertEqual({tuple(scale) for scale in scales[-2:]}, {("left", 0.625), ("right", 0.625)})

    def test_three_people_of_three_kinds_hand_a_brick_round_and_see_the_same(self):
        self.enter()
        number = self.make_brick()
        size = (960, 540)
        cleo = self.browser.open(self.link, size)
        cleo.enter("Cleo", way="room")
        cleo.wait_for("theatron.state.pictures > 0 && theatron.state.people.length === 3")
        made = x, y, z = self.brick(number)["position"]
        self.ben.say(f"stand {x + 0.3} {y} {z} {x} {y} {z}")
        self.page.wait_for(f"Math.abs(theatron.state.people.find(p => p.name === 'Ben')?.head?.[0] - {x + 0.3}) < 0.01")

        pages = [self.page, cleo]
        hashes = ()

        def same():
            """All know the same room, within some tries."""
            def agree():
                nonlocal hashes
                hashes = (self.ben.newest_json()["room"]["hash"], *(page.evaluate("theatron.state.room_hash") for page in pages))
                return len(set(hashes)) == 1
            try:
                wait_until(agree)
            except AssertionError:
                self.fail(hashes)

        def seen(step):
            same()
            self.keep_picture(f"three_headset_{step}")
            folder = pathlib.Path(PICTURES or self.folder)
            cleo.screenshot(folder / f"three_page_{step}.png")
            # As a native participant sees it; who leaves is no longer in the room.
            code, _, errors = run("join", self.link, "--name", "Dora", "--offscreen", folder / f"three_native_{step}.png",
                                  "--size", "640x360", "--seconds", "2")
            self.assertEqual(code, 0, errors)
            cleo.wait_for("theatron.state.people.length === 3")

        self.headset("aim('right', [0.2, 1.3, -0.2], [0, 1.6, -0.8])")
        self.headset("grip('right', true)")
        self.wait_for_holder(number, "Ada")
        seen("ada")
        # To the nearest person, who is Ben.
        self.headset("device.controllers.right.updateButtonValue('a-button', 1)")
        self.wait_for_holder(number, "Ben")
        self.headset("device.controllers.right.updateButtonValue('a-button', 0)")
        self.headset("grip('right', false)")
        seen("ben")
        # Before her eye.
        ear = cleo.evaluate("theatron.state.ear")
        x, y, z = (at + 0.8 * way for at, way in zip(ear["position"], ear["ahead"]))
        self.ben.say(f"move {x} {y} {z}")
        self.ben.wait_for(lambda f: any(o["id"] == number and distance(o["position"], (x, y, z)) < 0.01 for o in self.bricks(f)))
        self.ben.say("give Cleo")
        self.wait_for_holder(number, "Cleo")
        self.ben.say("stand 6 1.6 6 0 1.6 0")
        drawn = cleo.evaluate("theatron.state.pictures")
        cleo.wait_for(f"theatron.state.pictures > {drawn + 2}")
        seen("cleo")
        middle = (size[0] / 2, size[1] * 0.57)  # the camera's axis
        cleo.evaluate("document.getElementById('view').focus()")
        cleo.mouse("mouseMoved", *middle, "none")
        cleo.mouse("mousePressed", *middle)
        drawn = cleo.evaluate("theatron.state.pictures")
        cleo.wait_for(f"theatron.state.pictures > {drawn + 2}")
        cleo.press("g", "KeyG")
        self.wait_for_holder(number, "Ada")
        cleo.mouse("mouseReleased", *middle)
        seen("ada_again")
        cleo.evaluate("document.getElementById('leave').click()")
        cleo.wait_for("theatron.state.phase === 'left'")
        self.page.wait_for("theatron.state.people.length === 2")
        pages.remove(cleo)
        same()
        self.assertEqual(cleo.problems, [])
        # A given object hangs where it was; the ray takes it, and lets it go.
        head = self.ada_when(lambda ada: True)["head"]
        ahead = [(made[axis] - head[axis]) / 0.8 for axis in (0, 2)]
        way = [at - from_ for at, from_ in zip(self.brick(number)["position"], head)]
        place = [-way[0] * ahead[1] + way[2] * ahead[0], 1.6 + way[1], -way[0] * ahead[0] - way[2] * ahead[1]]
        self.headset(f"aim('right', [0.2, 1.3, -0.2], {place})")
        self.headset("grip('right', true)")
        self.headset("aim('right', [0.2, 1.3, -0.2], [0.5, 1.6, -0.8])")
        self.headset("grip('right', false)")
        self.wait_for_holder(number, None)

    def test_a_controller_marks_measures_slices_cuts_and_presses_panels(self):
        self.enter()
        wait_until(lambda: min(self.colors_of_eyes()) > 200)
        tools = ["Stroke", "Arrow", "Pin", "Distance"]
        self.choose_tool(2, tools, "Stroke")
        # The side of the drape, below the camera's axis.
        line = [(0.2 + x / 25, 0.7, -1.5) for x in range(7)]
        self.draw(*line)
        stroke = self.marks(self.ben.wait_for(self.marks))[0]
        self.assertEqual((stroke["kind"], stroke["surface"], stroke["initials"]), ("stroke", "cloud", "A"))
        self.choose_tool(2, ["[Stroke]", *tools[1:]], "Distance")
        self.draw(line[0], line[-1])
        distance_mark = self.marks(self.ben.wait_for(lambda f: len(self.marks(f)) == 2))[1]
        self.assertEqual(distance_mark["kind"], "distance")
        self.assertGreater(distance_mark["length_m"], 0.1)
        self.keep_picture("headset_marks")
        # The newest one goes, then all.
        self.choose(1, 13)
        self.press(3, ["Undo", "Clear mine"], "Undo")
        self.ben.wait_for(lambda f: len(self.marks(f)) == 1)
        self.press(3, ["Undo", "Clear mine"], "Clear mine")
        self.ben.wait_for(lambda f: not self.marks(f))
        self.press(0, ["Close"], "Close")

        # An organ 0.8 m before the head.
        number = self.make_brick()
        place = self.brick(number)["position"]
        self.remove_bricks()
        self.ben.say("case open --yes Made liver")
        organ = self.ben.wait_for(has_all)["cases"]["open"]["object"]
        self.ben.say(f"grab {organ}")
        self.ben.say("move {} {} {}".format(*place))
        self.ben.say("release")
        self.addCleanup(self.ben.say, "case close")

        def slice_when(condition):
            return self.ben.wait_for(lambda f: condition(f["cases"]["open"]["screen"]))["cases"]["open"]["screen"]
        before = slice_when(lambda screen: True)
        of_case = ["Slice", "Cut", "Parts"]
        self.choose_tool(4, of_case, "Slice")

        def slices():
            """Once the organ's surface has come to the page."""
            self.draw((0, 1.62, -0.8))
            return self.ben.newest_json()["cases"]["open"]["screen"]["position_mm"] != before["position_mm"]
        wait_until(slices)
        at = slice_when(lambda screen: True)
        self.assertLess(abs(at["position_mm"]), 80)
        # It goes with the ray.
        self.draw((0, 1.6, -0.8), (0, 1.64, -0.8))
        higher = slice_when(lambda screen: screen["position_mm"] > at["position_mm"] + 5)
        self.assertLess(higher["position_mm"], 80)
        self.choose_tool(4, ["[Slice]", *of_case[1:]], "Cut")
        self.draw((0, 1.6, -0.8))
        self.ben.wait_for(lambda f: f["cases"]["open"]["cut"])
        self.frames(3)
        self.keep_picture("headset_cut")
        self.draw((1.5, 1.6, -0.8))
        self.ben.wait_for(lambda f: not f["cases"]["open"]["cut"])
        # One part is taken out of the organ, then the organ as a whole.
        self.choose_tool(4, ["Slice", "[Cut]", "Parts"], "Parts")
        self.headset("aim('right', [0.2, 1.3, -0.2], [0, 1.6, -0.8])")
        self.headset("grip('right', true)")
        shell = self.ben.newest_json()["cases"]["open"]["parts"][0]["object"]
        held = self.ben.wait_for(lambda f: any(o["held_by"] for o in f["room"]["objects"]))
        self.assertEqual([o["id"] for o in held["room"]["objects"] if o["held_by"]], [shell])
        self.headset("grip('right', false)")
        self.choose_tool(1, ["Hold"], "Hold")
        self.headset("aim('right', [0.2, 1.3, -0.2], [0, 1.6, -0.8])")
        self.headset("grip('right', true)")
        held = self.ben.wait_for(lambda f: any(o["held_by"] and o["id"] != shell for o in f["room"]["objects"]))
        self.assertEqual([o["id"] for o in held["room"]["objects"] if o["held_by"]], [organ])
        self.headset("grip('right', false)")

        # The panel of people goes to one of them.
        start = self.ada_when(lambda ada: True)["head"]
        self.ben.say(f"stand {start[0] + 3} 1.6 {start[2]} {start[0]} 1.6 {start[2]}")
        self.page.wait_for("theatron.state.people.some(p => p.name === 'Ben' && p.head)")
        self.choose(3, 13)
        self.press(1, ["Go to"], "Go to")
        self.ada_when(lambda ada: distance(ada["head"], start) > 1)

    def test_a_pinch_takes_a_brick_and_lets_it_go(self):
        self.enter()
        number = self.make_brick()
        place = self.brick(number)["position"]
        self.page.evaluate("simulated_headset.device.primaryInputMode = 'hand'")
        self.headset("aim('right', [0.2, 1.3, -0.2], [0, 1.6, -0.8])")
        self.keep_picture("headset_hands")
        self.headset("grip('right', true)")
        self.wait_for_holder(number, "Ada")
        self.headset("aim('right', [0.2, 1.3, -0.2], [0.5, 1.6, -0.8])")
        self.headset("grip('right', false)")
        self.wait_for_holder(number, None)
        self.assertGreater(distance(self.brick(number)["position"], place), 0.2)
        self.page.evaluate("simulated_headset.device.primaryInputMode = 'controller'")

    def test_in_ar_the_room_is_the_real_one_and_its_table_is_placed(self):
        self.ben.say("stand 0 1.6 -1 0 1.6 0")
        self.enter("ar")
        # A hand over the table's middle, pointing to the patient's head.
        self.headset("aim('right', [0.3, 1.0, -1.2], [1.3, 1.0, -1.2])")
        self.keep_picture("headset_ar_placing")
        self.headset("grip('right', true)")
        self.headset("grip('right', false)")
        self.headset("aim('right', [0.2, 1.3, -0.2], [0, 1.6, -0.8])")
        self.frames(1)
        opaque = self.page.evaluate("simulated_headset.opaque()")
        self.keep_picture("headset_ar")
        for share in opaque:  # an avatar and rays, and no wall
            self.assertTrue(0 < share < 0.5, opaque)
        # The head was 1.2 m beside the table and 0.3 m from its middle, towards its foot.
        head = self.ada_when(lambda ada: abs(abs(ada["head"][2]) - 1.2) < 0.1)["head"]
        self.assertAlmostEqual(head[0], 0.3, delta=0.1)

    def test_ten_sessions_leave_nothing_behind(self):
        counts = []
        for _ in range(10):
            self.enter()
            self.page.evaluate("theatron.headset.leave()")
            self.page.wait_for("!theatron.headset.is_on")
            self.page.call("HeapProfiler.collectGarbage")
            counts.append((self.page.evaluate("theatron.memory()"), self.page.evaluate("simulated_headset.objects()"),
                           self.page.call("Runtime.getHeapUsage")["usedSize"]))
        # Memory of the program and objects of GL stay the same; the script's heap has some noise.
        self.assertEqual(counts[-1][:2], counts[2][:2], counts)
        self.assertLess(counts[-1][2] - counts[2][2], 1_000_000, counts)


if __name__ == "__main__":
    unittest.main()
