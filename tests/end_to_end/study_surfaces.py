# SPDX-License-Identifier: Apache-2.0
"""A study's participant who presses the buttons of a window, a page or a headset's plate, as the steps of the study ask."""
import os
import pathlib

from study_test import Participant
from theatron_process import Process, wait_until, write_png

HERE = pathlib.Path(__file__).parent
IWER = HERE / "node_modules/iwer/build/iwer.min.js"
PICTURES = os.environ.get("THEATRON_PICTURES")  # a folder where pictures stay
CAMERA = "synthetic:seconds=2,fps=5,quality=quick,loop=1"
WINDOW = (1280, 720)


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
    answers = {"consent": ["Yes", "No"], "yes_no": ["Yes", "No"], "number": [*"1234567890", "Erase"],
               "rating": [str(point) for point in range(step.get("lowest", 0), step.get("highest", 0) + 1, step.get("step_size", 1))],
               "choice": [str(i + 1) for i in range(len(step.get("choices", [])))]}.get(step["kind"], [])
    return [*answers, *["Go on"] * (chosen or not answers), *["Leave this out"] * (step["kind"] not in ("consent", "read", "watch")),
            "Put aside", "End the study"]


def replies(study, number=1):
    lines = (study / f"journals/P{number:02}.journal").read_text().splitlines()[1:]
    return {line.split("\t")[2]: line.split("\t")[3] for line in lines}


def go_through(leader, press, number=1, person=None):
    """Gives the replies by press(label, step, chosen); returns them by step. `press` waits until there is such a button."""
    person, given = person or Participant(number), {}
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


class WindowSurface:
    """The window `process` on a virtual screen of the size WINDOW; its panel of a study is all that has buttons at the left."""

    def __init__(self, screen, process, name="window"):
        self.screen, self.process, self.name, self.shown = screen, process, name, 0

    def buttons(self):
        return self.screen.buttons(500, 650, least=9)

    def picture(self):
        if PICTURES:
            rows = self.screen.pixels(0, 0, *WINDOW)
            write_png(pathlib.Path(PICTURES) / f"study_{self.name}_{self.shown:02}.png", *WINDOW, 8, 3,
                      [b"".join(bytes((row[4 * x + 2], row[4 * x + 1], row[4 * x])) for x in range(WINDOW[0])) for row in rows])
        self.shown += 1

    def wait_for_buttons(self, step, chosen):
        """When all of this step are there: their labels and places."""
        labels = labels_of(step, chosen)
        places = wait_until(lambda: (found := self.buttons()) and len(found) == len(labels) and found, of=self.process)
        self.picture()
        return labels, places

    def press(self, label, step, chosen):
        """The mouse does not stay on a button, which would change its colour."""
        labels, places = self.wait_for_buttons(step, chosen)
        self.screen.do("mousemove", *places[labels.index(label)], "click", 1, "mousemove", 900, 300)


class WindowKeys(WindowSurface):
    """The same by the keyboard alone: digits choose, Tab goes to other buttons, Return presses and goes on."""

    def press(self, label, step, chosen):
        labels, _ = self.wait_for_buttons(step, chosen)
        if label == "Go on":
            # Tab begins at the first button of the step, and stays at one that was pressed before.
            steps = 0 if step["kind"] in ("rating", "choice", "number") else labels.index(label) - (self.at if chosen else -1)
            self.screen.do("key", *["Tab"] * steps, "Return")
        elif label.isdigit():
            self.screen.do("key", label)
        else:
            self.at = labels.index(label)
            self.screen.do("key", *["Tab"] * (self.at + 1), "Return")


class PageSurface:
    """The panel of a page of the browser client."""

    def __init__(self, page, name="page", keys=False):
        self.page, self.name, self.keys, self.shown = page, name, keys, 0

    def picture(self):
        if PICTURES:
            self.page.screenshot(pathlib.Path(PICTURES) / f"study_{self.name}_{self.shown:02}.png")
        self.shown += 1

    def press(self, label, step, *_):
        """In the panel of this step, not of the one before."""
        button = f"[...document.querySelectorAll('#study button')].find(b => b.textContent === {label!r})"
        self.page.wait_for(f"document.getElementById('study').textContent.includes('Step {step['step']} of ') && !!{button}")
        self.picture()
        if label == "Go on":
            assert not self.page.evaluate(f"{button}.hasAttribute('aria-label')"), "the button belongs to the step, not to the text above it"
        if self.keys:
            self.page.evaluate(f"{button}.focus()")
            # A key that is pressed twice presses no other button, such as one that puts the next step aside.
            for _ in range(2 if label == "Go on" else 1):
                self.page.press("Enter", "Enter", 13, "\r")
        else:
            self.page.evaluate(f"{button}.click()")
        if label != "Go on" and step["kind"] != "number":
            self.page.wait_for(f"!![...document.querySelectorAll('#study [aria-pressed=true]')].find(b => b.textContent === {label!r})")


class HeadsetSurface:
    """A page with a simulated headset: buttons of a plate, pressed by a ray."""

    def __init__(self, page, name="headset"):
        self.page, self.name, self.shown = page, name, 0

    def load(self, url):
        """Of a page that was opened with "about:blank"."""
        for file in (IWER, HERE / "headset.js"):
            self.page.call("Page.addScriptToEvaluateOnNewDocument", source=file.read_text())
        self.page.call("Page.navigate", url=url)

    def put_on(self):
        self.page.evaluate("simulated_headset.rest()")
        self.page.wait_for("!document.getElementById('enter_vr').hidden")
        self.page.evaluate("document.getElementById('enter_vr').click()")
        self.page.wait_for("theatron.headset.is_on")

    def do(self, script):
        self.page.evaluate(f"simulated_headset.{script}")
        seen = self.page.evaluate("simulated_headset.frames")
        self.page.wait_for(f"simulated_headset.frames >= {seen + 1}")

    def press(self, label, step, *_):
        panel = "theatron.state.overlay.panels.find(p => p.kind === 'study')"
        self.page.wait_for(f"{panel}?.rows.some(r => r.text.startsWith('Step {step['step']} of ')) && "
                           f"{panel}.rows.some(r => r.buttons.some(b => b.label === {label!r}))")
        row, at = plate_button(self.page.evaluate(panel)["rows"], label)
        self.do(f"aim_at_plate({row}, {at})")
        if PICTURES:
            self.page.screenshot(pathlib.Path(PICTURES) / f"study_{self.name}_{self.shown:02}.png")
        self.shown += 1
        self.do("grip('right', true)")
        self.do("grip('right', false)")


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
