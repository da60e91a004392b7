# SPDX-License-Identifier: Apache-2.0
"""A study's participant in the window, in the page and with the simulated headset: each goes from consent to the end."""
import os
import pathlib
import shutil
import tempfile
import unittest

from page_case import PageCase
from study_test import Participant, make_study
from theatron_process import Process, host, wait_until, write_png
from virtual_screen import VirtualScreen

HERE = pathlib.Path(__file__).parent
IWER = HERE / "node_modules/iwer/build/iwer.min.js"
PICTURES = os.environ.get("THEATRON_PICTURES")  # a folder where pictures stay
CAMERA = "synthetic:seconds=2,fps=5,quality=quick,loop=1"
PROTOCOL = """study = Short
questionnaires = own.conf

phase = agree
kind = consent
text = Do you agree to take part?

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


def make_short_study(folder):
    make_study(folder, PROTOCOL)
    (folder / "own.conf").write_text(OWN)


def lead(folder, study, link, number=1):
    file = folder / "operator.link"
    file.write_text(link + "\n")
    return Process("study", "run", study, "--participant", f"P{number:02}", "--link", f"@{file}", "--json")


def pressed(step, reply):
    """The labels of the buttons that give this reply, in their order."""
    if step["kind"] == "number":
        return [*reply, "Go on"]
    if step["kind"] in ("read", "watch"):
        return ["Go on"]
    return [{"yes": "Yes", "no": "No"}.get(reply, reply), "Go on"]


def labels_of(step, chosen):
    """All buttons of a step; `chosen`: a reply is, so that one can go on."""
    answers = {"consent": ["Yes", "No"], "yes_no": ["Yes", "No"], "rating": [str(point) for point in range(7)],
               "number": [*"1234567890", "Erase"], "choice": [str(i + 1) for i in range(len(step.get("choices", [])))]}.get(step["kind"], [])
    return [*answers, *["Go on"] * (chosen or not answers), *["Leave this out"] * (step["kind"] not in ("consent", "read", "watch")),
            "Put aside", "End the study"]


def replies(study, number=1):
    lines = (study / f"journals/P{number:02}.journal").read_text().splitlines()[1:]
    return {line.split("\t")[2]: line.split("\t")[3] for line in lines}


def go_through(leader, press, number=1):
    """Gives the replies by press(label, step, chosen); returns them by step. `press` waits until there is such a button."""
    person, given = Participant(number), {}
    while True:
        event = leader.wait_for(lambda line: line["event"] in ("step", "end"))
        if event["event"] == "end":
            return event["state"], given
        if event["kind"] == "condition":
            continue
        reply = person.reply(event)
        given[event["id"]] = {"yes": "1", "no": "0", "": "-"}.get(reply, reply)
        for i, label in enumerate(pressed(event, reply)):
            press(label, event, i > 0)
        leader.wait_for(lambda line: line["event"] == "saved" and line["id"] == event["id"])


class InTheWindow(unittest.TestCase):
    def test_from_consent_to_the_end(self):
        folder = pathlib.Path(tempfile.mkdtemp(prefix="theatron_study_window_"))
        self.addCleanup(shutil.rmtree, folder)
        study = folder / "study"
        make_short_study(study)
        with VirtualScreen(1280, 720) as screen, host(folder / "state", CAMERA) as h, \
                Process("join", h.greeting["links"]["expert"], "--name", "Wim", "--size", "1280x720", "--renderer", "splat",
                        env=screen.environment) as window, \
                lead(folder, study, h.greeting["links"]["operator"]) as leader:
            self.screen, self.window = screen, window
            wait_until(lambda: screen.buttons(500, 650, least=9), of=window)
            self.shown = 0
            state, given = go_through(leader, self.press)
            self.assertEqual(state, "complete")
            self.picture("study_window_end")
        self.assertEqual(replies(study), given)

    def picture(self, name):
        if PICTURES:
            rows = self.screen.pixels(0, 0, 1280, 720)
            write_png(pathlib.Path(PICTURES) / f"{name}.png", 1280, 720, 8, 3,
                      [b"".join(bytes((row[4 * x + 2], row[4 * x + 1], row[4 * x])) for x in range(1280)) for row in rows])

    def press(self, label, step, chosen):
        """The button of this place, when all of this step are there. The mouse does not stay on one, which would change its colour."""
        labels = labels_of(step, chosen)
        places = wait_until(lambda: (found := self.screen.buttons(500, 650, least=9)) and len(found) == len(labels) and found, of=self.window)
        self.picture(f"study_window_{self.shown:02}")
        self.shown += 1
        self.screen.do("mousemove", *places[labels.index(label)], "click", 1, "mousemove", 900, 300)


@unittest.skipUnless(IWER.exists(), "iwer is not installed: npm ci --prefix tests/end_to_end")
class InThePage(PageCase):
    cameras = (CAMERA,)

    def setUp(self):
        super().setUp()
        self.place = pathlib.Path(tempfile.mkdtemp(prefix="theatron_study_page_"))
        self.addCleanup(shutil.rmtree, self.place)
        self.study = self.place / "study"
        make_short_study(self.study)

    def picture(self, page, name):
        if PICTURES:
            page.screenshot(pathlib.Path(PICTURES) / f"{name}.png")

    def test_with_the_mouse_and_with_the_keyboard_in_the_2d_view_too(self):
        for number, (way, size) in enumerate((("room", (1280, 720)), ("flat", (400, 700))), 1):
            with self.subTest(way):
                page = self.browser.open(self.links["expert"], size)
                page.enter("Ada", way=way)
                page.wait_for("theatron.state.phase === 'joined'")
                self.assertTrue(page.evaluate("document.getElementById('study').hidden"))
                shown = []

                def press(label, *_):
                    button = f"[...document.querySelectorAll('#study button')].find(b => b.textContent === {label!r})"
                    page.wait_for(f"!!{button}")
                    shown.append(label)
                    self.picture(page, f"study_page_{way}_{len(shown):02}")
                    self.assertTrue(page.evaluate("document.getElementById('study_news').textContent"))
                    if way == "room":
                        page.evaluate(f"{button}.click()")
                    else:
                        page.evaluate(f"{button}.focus()")
                        page.press("Enter", "Enter", 13, "\r")
                    if label not in ("Go on", "1", "2", "3", "4", "5", "6", "7", "8", "9", "0"):
                        page.wait_for(f"!![...document.querySelectorAll('#study [aria-pressed=true]')].find(b => b.textContent === {label!r})")

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

    def test_with_a_headset_on_a_plate(self):
        page = self.browser.open("about:blank", (320, 180))
        for file in (IWER, HERE / "headset.js"):
            page.call("Page.addScriptToEvaluateOnNewDocument", source=file.read_text())
        page.call("Page.navigate", url=self.links["expert"])
        page.enter("Ada", way="room")
        page.wait_for("theatron.state.pictures > 0")

        def headset(script):
            page.evaluate(f"simulated_headset.{script}")
            seen = page.evaluate("simulated_headset.frames")
            page.wait_for(f"simulated_headset.frames >= {seen + 1}")

        page.evaluate("simulated_headset.rest()")
        page.wait_for("!document.getElementById('enter_vr').hidden")
        page.evaluate("document.getElementById('enter_vr').click()")
        page.wait_for("theatron.headset.is_on")
        shown = []

        def press(label, *_):
            panel = "theatron.state.overlay.panels.find(p => p.kind === 'study')"
            found = f"{panel}?.rows.some(r => r.buttons.some(b => b.label === {label!r}))"
            page.wait_for(found)
            row, at = plate_button(page.evaluate(panel)["rows"], label)
            headset(f"aim_at_plate({row}, {at})")
            shown.append(label)
            self.picture(page, f"study_headset_{len(shown):02}")
            headset("grip('right', true)")
            headset("grip('right', false)")

        with lead(self.place, self.study, self.links["operator"], 3) as leader:
            state, given = go_through(leader, press, 3)
            self.assertEqual(state, "complete")
        self.assertEqual(replies(self.study, 3), given)
        self.assertEqual(page.problems, [])


def lines_of(text, most=56):
    lines = [""]
    for word in text.split(" "):
        if lines[-1] and len(lines[-1] + " " + word) > most:
            lines.append("")
        lines[-1] += (" " if lines[-1] else "") + word
    return lines


def plate_button(rows, label):
    """Row and place of a button on a plate, as src/viewer/panels/plate.cpp has them; row 0 is the title."""
    width, margin, gap = 0.5, 0.012, 0.006
    wide = lambda text: 0.0084 * len(text)
    at_row = 1
    for row in rows:
        lines = lines_of(row["text"]) if row["text"] else []
        at_row += len(lines)
        widths = [wide(button["label"]) + 2 * margin for button in row["buttons"]]
        total = sum(each + gap for each in widths)
        is_beside = lines and widths and wide(lines[-1]) + margin + total <= width - 2 * margin
        at = width - margin - total if is_beside else width
        for button, each in zip(row["buttons"], widths):
            if at + each > width - margin + 1e-9:
                at_row, at = at_row + 1, margin
            if button["label"] == label:
                return at_row - 1, at + each / 2
            at += each + gap
        at_row += len(lines_of(row["detail"])) if row["detail"] else 0
    raise AssertionError(f"no button {label}: {rows}")


if __name__ == "__main__":
    unittest.main()
