# SPDX-License-Identifier: Apache-2.0
"""Two studies of the sizes of published ones, 12 and 7 participants, from consent to report: scripted participants reply in
the window, the page and with the simulated headset, one after the other in one session.

    python3 tests/end_to_end/study_sizes_run.py --out sizes                 # all 19
    python3 tests/end_to_end/study_sizes_run.py --out sizes --sizes 3,3     # one on each surface

Their opinions have a known mean, so that it is known what the reports must say; they are compared with that, and every figure
of the pages is searched for texts that are cut or lie on others. OUT gets both studies and a picture of each report.
"""
import argparse
import base64
import contextlib
import csv
import json
import pathlib
import random
import statistics
import tempfile
import time

from browser import Browser
from study_surfaces import CAMERA, WINDOW, HeadsetSurface, PageSurface, WindowSurface, go_through, lead, replies
from study_test import CONSENT, make_study
from theatron_process import Process, host, run
from virtual_screen import VirtualScreen

SOCIAL = """questionnaire = together
title = Together with the other person
source = our own
anchors = not at all | very much
scale = together | In one room
from = mean
scale = sickness | Sickness
from = mean
item = t1 together
text = I was in the same room with the other person.
item = t2 together
text = The other person was far away.
reversed = yes
item = t3 together
text = We could have shaken hands.
item = t4 sickness
text = I felt sick.
"""
REALISM = """questionnaire = realism
title = How real it looked
source = our own
anchors = not at all | completely
scale = realism | Realism
from = mean
item = r1 realism
text = The person and the bricks looked real.
item = r2 realism
text = I saw every detail that I needed.
item = r3 realism
text = What I saw looked like a drawing.
reversed = yes
"""
PRESENCE = f"""study = Presence at the table
seed = 12
questionnaires = texts.conf
questionnaires = own.conf
{CONSENT}
phase = person
kind = questionnaire
questionnaire = about-you

phase = build
kind = bricks
text = Watch what is built.
watch-s = 1
questions = 3

phase = after
kind = questionnaire
questionnaire = ipq
questionnaire = together
questionnaire = own-benefit
"""
COMPARISON = f"""study = Splats or mesh
seed = 7
order = latin-square
questionnaires = own.conf
condition = splats
renderer = splat
condition = mesh
renderer = mesh
{CONSENT}
phase = build
kind = bricks
each-condition = yes
text = Watch what is built.
watch-s = 1
questions = 2

phase = realism
kind = questionnaire
each-condition = yes
questionnaire = realism

phase = compare
kind = questionnaire
questionnaire = own-preference
questionnaire = own-benefit
"""
STUDIES = {"presence": (PRESENCE, SOCIAL), "comparison": (COMPARISON, REALISM)}
REVERSED = ("ipq.SP2", "ipq.INV3", "ipq.REAL1", "together.t2", "realism.r3")
# Mean opinions, 0 to 6, by the beginnings of items. The mesh looks much better than the splats; nobody prefers either.
OPINIONS = {"ipq.REAL": 2.5, "ipq.": 5, "together.t4": 0.4, "together.": 5.2, "realism.splats": 1.5, "realism.mesh": 4.5, "own-preference": 3}
SURFACES = ("window", "page", "headset")


class Scripted:
    """A participant with an opinion. The same number gives the same replies."""

    def __init__(self, number):
        self.random = random.Random(1000 + number)

    def opinion(self, step):
        item = step["id"].split(".", 1)[1]  # without the phase
        name = f"realism.{step['condition']}" if step.get("condition") else item
        mean = next((mean for begin, mean in OPINIONS.items() if name.startswith(begin)), 3)
        point = round(min(6, max(0, self.random.gauss(mean, 0.8))))
        return 6 - point if item.split(".", 1)[-1] in REVERSED or item in REVERSED else point

    def reply(self, step):
        kind = step["kind"]
        if kind == "consent":
            return "yes"
        if kind == "yes_no":
            return self.random.choice(("yes", "no"))
        if kind == "number":
            return str(self.random.randint(0, 9))
        if kind == "choice":
            return str(self.random.randint(1, len(step["choices"])))
        return str(self.opinion(step)) if kind == "rating" else ""


@contextlib.contextmanager
def surface(kind, link, screen, browser):
    """Somebody who has joined there, alone in the session; gives press()."""
    if kind == "window":
        with Process("join", link, "--name", "Wim", "--size", f"{WINDOW[0]}x{WINDOW[1]}", "--renderer", "splat", env=screen.environment) as window:
            yield WindowSurface(screen, window).press
        return
    page = browser.open("about:blank" if kind == "headset" else link, (320, 180) if kind == "headset" else WINDOW)
    hand = HeadsetSurface(page) if kind == "headset" else PageSurface(page)
    if kind == "headset":
        hand.load(link)
    page.enter("Ada", way="room")
    page.wait_for("theatron.state.phase === 'joined' && theatron.state.pictures > 0")
    if kind == "headset":
        hand.put_on()
    yield hand.press
    if page.problems:
        raise AssertionError(f"{kind}: {page.problems}")
    page.close()


def run_studies(out, sizes, surfaces=SURFACES, tell=print):
    """All participants of both studies; returns the folders."""
    folders = []
    with host(out / "state", CAMERA) as h, VirtualScreen(*WINDOW) as screen, Browser() as browser:
        for (name, (protocol, own)), size in zip(STUDIES.items(), sizes):
            folder = out / name
            make_study(folder, protocol)
            (folder / "own.conf").write_text(own)
            folders.append(folder)
            for number in range(1, size + 1):
                kind, began = surfaces[(number - 1) % len(surfaces)], time.monotonic()
                with surface(kind, h.greeting["links"]["expert"], screen, browser) as press, \
                        lead(out, folder, h.greeting["links"]["operator"], number) as leader:
                    state, given = go_through(leader, press, number, Scripted(number))
                    assert state == "complete" and leader.end() == 0, (state, leader.errors)
                kept = {step: reply for step, reply in replies(folder, number).items() if not step.endswith(".condition")}
                assert kept == given, (kept, given)
                tell(f"{name} P{number:02} {kind}: {len(given)} replies, {time.monotonic() - began:.0f} s")
    return folders


def table(folder, name):
    with open(folder / "report" / f"{name}.csv", newline="") as file:
        return list(csv.DictReader(file))


def realism(folder, number, condition):
    """The mean of a participant's replies, from the journal alone."""
    given = replies(folder, number)
    points = [int(given[f"realism.{condition}.realism.r{i}"]) for i in (1, 2, 3)]
    return statistics.mean([points[0], points[1], 6 - points[2]])


def check_report(folder, size):
    """What the report must say; returns its words. Makes it first."""
    code, _, errors = run("study", "report", folder)
    assert code == 0, errors
    words = (folder / "report/report.html").read_text()
    assert f"{size} participants agreed, {size} of them completed the study" in words
    described = {(row["questionnaire"], row["scale"], row["condition"]): row for row in table(folder, "descriptions")}
    if folder.name == "presence":
        assert f"{size} participants and no two conditions" in words
        assert float(described["together", "together", ""]["median"]) > float(described["ipq", "realism", ""]["median"])
        assert float(described["together", "sickness", ""]["lowest_third"]) > 0.7
        assert not table(folder, "statistics"), "there is nothing to compare"
        return words
    assert ("differences of at least" if size >= 6 else "The study is too small to conclude") in words
    pairs = {(row["questionnaire"], row["scale"]): row for row in table(folder, "statistics")}
    means = {condition: [realism(folder, number, condition) for number in range(1, size + 1)] for condition in ("splats", "mesh")}
    for condition, values in means.items():
        assert abs(float(described["realism", "realism", condition]["median"]) - statistics.median(values)) < 1e-9
    found = pairs["realism", "realism"]
    assert found["pair"] == "mesh - splats" and float(found["effect"]) == 1, found
    # All participants see the difference: no p is smaller with this number of them.
    assert abs(float(found["p"]) - 2 * 0.5 ** size) < 1e-12, found
    row = next(line for line in words.splitlines() if "<tr><td class=t>Realism" in line and "mesh - splats" in line)
    expected = "too small to conclude" if size < 6 else "a difference" if float(found["p_holm"]) < 0.05 else "a hint, which does not hold"
    assert expected in row, row
    assert "too small to conclude" in next(line for line in words.splitlines() if "<td class=t>Preference" in line and "mesh - splats" in line)
    return words


# Texts of figures that lie on each other or outside their figure, cells that are wider than the page, figures without texts.
FAULTS = """(() => {
    const faults = [], box = (e) => e.getBoundingClientRect();
    if (document.documentElement.scrollWidth > document.documentElement.clientWidth) faults.push("the page is wider than the window");
    if (!document.querySelector("svg")) faults.push("there is no figure");
    document.querySelectorAll("svg").forEach((svg, n) => {
        const texts = [...svg.querySelectorAll("text")].filter((t) => t.textContent.trim()), all = box(svg);
        if (!texts.length) faults.push(`figure ${n} has no text`);
        for (const t of texts) {
            const b = box(t);
            if (b.left < all.left - 1 || b.right > all.right + 1 || b.top < all.top - 1 || b.bottom > all.bottom + 1)
                faults.push(`figure ${n}: "${t.textContent}" is cut`);
        }
        texts.forEach((one, i) => texts.slice(i + 1).forEach((other) => {
            const a = box(one), b = box(other);
            const wide = Math.min(a.right, b.right) - Math.max(a.left, b.left), high = Math.min(a.bottom, b.bottom) - Math.max(a.top, b.top);
            if (wide > 2 && high > 0.35 * Math.min(a.height, b.height)) faults.push(`figure ${n}: "${one.textContent}" lies on "${other.textContent}"`);
        }));
    });
    return faults;
})()"""


def look_at_report(browser, folder, picture):
    """A picture of the whole page; returns what is cut, lies on something else or has no label."""
    page = browser.open((folder / "report/report.html").resolve().as_uri(), (1100, 900))
    page.wait_for("document.readyState === 'complete'")
    height = page.evaluate("document.documentElement.scrollHeight")
    page.call("Emulation.setDeviceMetricsOverride", width=1100, height=height, deviceScaleFactor=1, mobile=False)
    picture.write_bytes(base64.b64decode(page.call("Page.captureScreenshot", format="png", captureBeyondViewport=True)["data"]))
    faults = page.evaluate(FAULTS)
    page.close()
    return faults


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=pathlib.Path, help="a new folder for studies, reports and pictures")
    parser.add_argument("--sizes", default="12,7", help="participants of both studies")
    parser.add_argument("--surfaces", default=",".join(SURFACES))
    flags = parser.parse_args()
    out = flags.out or pathlib.Path(tempfile.mkdtemp(prefix="theatron_sizes_"))
    out.mkdir(exist_ok=True)
    sizes = [int(size) for size in flags.sizes.split(",")]
    began, result = time.monotonic(), {}
    folders = run_studies(out, sizes, flags.surfaces.split(","), lambda text: print(text, flush=True))
    with Browser() as browser:
        for folder, size in zip(folders, sizes):
            check_report(folder, size)
            result[folder.name] = look_at_report(browser, folder, out / f"{folder.name}.png")
    print(json.dumps({"minutes": round((time.monotonic() - began) / 60, 1), "faults": result}, indent=1))
    raise SystemExit(any(result.values()))


if __name__ == "__main__":
    main()
