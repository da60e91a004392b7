# SPDX-License-Identifier: Apache-2.0
"""A study's participant in the window, in the page and with the simulated headset: each goes from consent to the end."""
import pathlib
import shutil
import tempfile
import unittest

from page_case import PageCase
from study_surfaces import CAMERA, IWER, WINDOW, HeadsetSurface, PageSurface, WindowKeys, WindowSurface, go_through, lead, replies
from study_test import make_study, wait_for_reason
from theatron_process import Process, host, wait_until
from virtual_screen import VirtualScreen

AGREE = """phase = agree
kind = consent
text = Do you agree to take part?
"""
PROTOCOL = f"""study = Short
questionnaires = own.conf

{AGREE}
phase = build
kind = bricks
text = Watch.
bricks = 4
watch-s = 1
questions = 1

phase = opinion
kind = questionnaire
questionnaire = comfort

phase = thanks
kind = instruction
text = Thank you.
"""
OWN = """questionnaire = comfort
title = Comfort
lowest = 0
highest = 6
anchors = not at all | very much
item = c1
text = I felt well.
item = c2
text = How often?
choices = never | often
"""
# A condition whose renderer has no meaning where nothing is drawn.
DRAWN = f"""study = Drawn
condition = splats
renderer = splat

{AGREE}
phase = look
kind = instruction
each-condition = yes
text = Look around.
"""


def make_short_study(folder):
    make_study(folder, PROTOCOL)
    (folder / "own.conf").write_text(OWN)


class InTheWindow(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="theatron_study_window_"))
        self.addCleanup(shutil.rmtree, self.folder)

    def go(self, surface, name):
        study = self.folder / "study"
        make_short_study(study)
        with VirtualScreen(*WINDOW) as screen, host(self.folder / "state", CAMERA) as h, \
                Process("join", h.greeting["links"]["expert"], "--name", "Wim", "--size", "1280x720", "--renderer", "splat",
                        env=screen.environment) as window, \
                lead(self.folder, study, h.greeting["links"]["operator"]) as leader:
            hand = surface(screen, window, name)
            wait_until(hand.buttons, of=window)
            state, given = go_through(leader, hand.press)
            self.assertEqual(state, "complete")
            hand.picture()
        self.assertEqual(replies(study), given)

    def test_from_consent_to_the_end(self):
        self.go(WindowSurface, "window")

    def test_by_the_keyboard_alone(self):
        self.go(WindowKeys, "keys")


@unittest.skipUnless(IWER.exists(), "iwer is not installed: npm ci --prefix tests/end_to_end")
class InThePage(PageCase):
    cameras = (CAMERA,)

    def setUp(self):
        super().setUp()
        self.place = pathlib.Path(tempfile.mkdtemp(prefix="theatron_study_page_"))
        self.addCleanup(shutil.rmtree, self.place)
        self.study = self.place / "study"
        make_short_study(self.study)

    def test_with_the_mouse_and_with_the_keyboard_in_the_2d_view_too(self):
        for number, (way, size) in enumerate((("room", (1280, 720)), ("flat", (400, 700))), 1):
            with self.subTest(way):
                page = self.browser.open(self.links["expert"], size)
                page.enter("Ada", way=way)
                page.wait_for("theatron.state.phase === 'joined'")
                self.assertTrue(page.evaluate("document.getElementById('study').hidden"))
                hand = PageSurface(page, f"page_{way}", keys=way == "flat")

                def press(label, step, chosen):
                    hand.press(label, step, chosen)
                    self.assertTrue(page.evaluate("document.getElementById('study_news').textContent"))

                with lead(self.place, self.study, self.links["operator"], number) as leader:
                    state, given = go_through(leader, press, number)
                    self.assertEqual(state, "complete")
                    page.wait_for("document.getElementById('study').textContent.includes('The study is over.')")
                    self.assertEqual(leader.end(), 0)
                self.assertEqual(replies(self.study, number), given)
                page.evaluate("[...document.querySelectorAll('#study button')].find(b => b.textContent === 'Close').click()")
                page.wait_for("document.getElementById('study').hidden")
                self.assertEqual(page.problems, [])
                self.leave(page)
                page.close()

    def test_a_condition_with_a_renderer_waits_while_the_participant_has_the_2d_view(self):
        (self.study / "study.conf").write_text(DRAWN)
        page = self.browser.open(self.links["expert"], (400, 700))
        page.enter("Ada", way="flat")
        page.wait_for("theatron.state.phase === 'joined'")
        with lead(self.place, self.study, self.links["operator"], 4) as leader:
            hand = PageSurface(page, "page_drawn")
            agree, look = ({"step": number, "kind": kind} for number, kind in ((1, "consent"), (3, "read")))
            for label in ("Yes", "Go on"):
                hand.press(label, agree)
            wait_for_reason(leader, "2D view")
            self.assertEqual(list(replies(self.study, 4)), ["agree.consent"])
            self.leave(page)
            page.reload()  # the tab knows its person
            page.enter("Ada", way="room")
            PageSurface(page, "page_drawn").press("Go on", look)
            self.assertEqual(leader.wait_for(lambda line: line["event"] == "end")["state"], "complete")
        self.assertEqual(list(replies(self.study, 4)), ["agree.consent", "look.splats.condition", "look.splats.read"])
        self.leave(page)

    def test_with_a_headset_on_a_plate(self):
        page = self.browser.open("about:blank", (320, 180))
        hand = HeadsetSurface(page)
        hand.load(self.links["expert"])
        page.enter("Ada", way="room")
        page.wait_for("theatron.state.pictures > 0")
        hand.put_on()
        with lead(self.place, self.study, self.links["operator"], 3) as leader:
            state, given = go_through(leader, hand.press, 3)
            self.assertEqual(state, "complete")
        self.assertEqual(replies(self.study, 3), given)
        self.assertEqual(page.problems, [])


if __name__ == "__main__":
    unittest.main()
