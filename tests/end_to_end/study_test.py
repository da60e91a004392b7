# SPDX-License-Identifier: Apache-2.0
"""Studies with people: scripted participants go from consent to report, and programs are killed meanwhile."""
import csv
import getpass
import json
import os
import pathlib
import random
import re
import shutil
import signal
import socket
import subprocess
import tempfile
import unittest

from theatron_process import Process, run, wait_until

CONSENT = "phase = agree\nkind = consent\ntext = Do you agree to take part?\n"
# One phase, as in a study of presence with twelve participants.
PRESENCE = """study = Presence at the table
seed = 12
questionnaires = texts.conf
""" + CONSENT + """
phase = person
kind = questionnaire
questionnaire = about-you

phase = build
kind = bricks
text = Watch what is built.
watch-s = 0
questions = 6

phase = after
kind = questionnaire
questionnaire = ipq
questionnaire = networked-minds
questionnaire = own-presence
questionnaire = own-benefit
"""
# Two conditions in both orders, as in a comparison of renderers with seven participants.
COMPARISON = """study = Splats or mesh
seed = 7
order = latin-square
questionnaires = texts.conf
condition = splats
renderer = splat
condition = mesh
renderer = mesh
""" + CONSENT + """
phase = build
kind = bricks
each-condition = yes
watch-s = 0
questions = 3

phase = realism
kind = questionnaire
each-condition = yes
questionnaire = ipq
questionnaire = own-presence

phase = compare
kind = questionnaire
questionnaire = own-preference
questionnaire = own-benefit
"""
PYTHON = "/usr/bin/python3"
REPORT_NEEDS = subprocess.run([PYTHON, "-c", "import scipy, pandas, matplotlib"], capture_output=True, text=True) \
    if os.path.exists(PYTHON) else None


def texts(*questionnaires):
    """A file with invented texts for questionnaires whose own ones are published elsewhere."""
    lines = []
    for name in questionnaires:
        code, form, errors = run("study", "texts", name)
        assert code == 0, errors
        lines += [re.sub(r"^# text = ", lambda _: f"text = Invented sentence {len(lines)}.", line) for line in form.splitlines()]
    return "\n".join(lines) + "\n"


def make_study(folder, protocol):
    code, _, errors = run("study", "new", folder)
    assert code == 0, errors
    (folder / "study.conf").write_text(protocol)
    (folder / "texts.conf").write_text(texts("ipq", "networked-minds"))
    return folder


class Participant:
    """Answers each step as a person would who knows nothing and has an opinion."""

    def __init__(self, number):
        self.random = random.Random(number)

    def reply(self, step):
        kind = step["kind"]
        if kind in ("consent", "yes_no"):
            return "yes" if kind == "consent" or self.random.random() < 0.6 else "no"
        if kind == "number":
            return str(self.random.randint(0, 9))
        if kind == "choice":
            return str(self.random.randint(1, len(step["choices"])))
        if kind == "rating":
            better = 1 if step.get("condition") == "mesh" else 0
            span = step["highest"] - step["lowest"]
            wish = self.random.gauss(0.6 + 0.12 * better, 0.2)
            return str(step["lowest"] + step["step_size"] * round(min(1, max(0, wish)) * span / step["step_size"]))
        return ""


def next_event(process, kinds):
    return process.wait_for(lambda event: event.get("event") in kinds)


def wait_for_reason(process, part):
    """It waits and says why: other reasons may come before, such as a connection that is not there yet."""
    process.wait_for(lambda line: line["event"] == "waits" and part in line["why"])


def run_participant(folder, number, stop_after=None, **options):
    """Runs one from consent to the end; returns its steps. `stop_after`: kills the program after this number of replies."""
    participant, steps = Participant(number), []
    with Process("study", "run", folder, "--participant", f"P{number:02}", "--json", **options) as process:
        while True:
            event = next_event(process, ("step", "end"))
            if event["event"] == "end":
                return steps, event["state"]
            if stop_after is not None and len(steps) == stop_after:
                process.process.send_signal(signal.SIGKILL)
                process.process.wait()
                return steps, "killed"
            steps.append(event)
            process.say(participant.reply(event))


class Studies(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="theatron_study_"))
        self.addCleanup(shutil.rmtree, self.folder)
        self.study = self.folder / "study"

    def table(self, name):
        with open(self.study / "report" / f"{name}.csv", newline="") as file:
            return list(csv.DictReader(file))

    def report(self):
        """Makes the report; where Python's packages are missing, the tables alone, and says so."""
        code, out, errors = run("study", "report", self.study, "--json")
        if REPORT_NEEDS is None or REPORT_NEEDS.returncode != 0:
            self.assertEqual(code, 1)
            self.assertIn("sudo apt install python3-scipy python3-pandas python3-matplotlib", errors)
            with self.subTest("the page of the report"):
                self.skipTest("needs python3-scipy, python3-pandas and python3-matplotlib")
            return None
        self.assertEqual(code, 0, errors)
        return (self.study / "report/report.html").read_text()

    def look_for_people(self):
        """No file has a name, an address, a place of this machine, or a time of day."""
        searched = 0
        mine = {getpass.getuser(), socket.gethostname(), str(pathlib.Path.home()), str(self.folder), "Jane Doe"} - {"root", "/root", "localhost"}
        for path in self.study.rglob("*"):
            if not path.is_file():
                continue
            searched += 1
            text = path.read_text()
            for word in mine:
                self.assertNotIn(word, text, path)
            if path.parent.name != "study":
                text = re.sub(r'http://www\.w3\.org/\S+|http://purl\.org/\S+|https://matplotlib\.org\S*|http://creativecommons\.org\S*', "", text)
                self.assertNotRegex(text, r"\b\d{1,3}\.\d{1,3}\.\d{1,3}\.\d{1,3}\b", path)
                self.assertNotRegex(text, r"[\w.]+@[\w.]+\.\w", path)
                self.assertNotRegex(text, r"\b20\d\d-\d\d-\d\d|\b\d\d:\d\d:\d\d\b", path)
        self.assertGreater(searched, 3)

    def test_twelve_participants_from_consent_to_report(self):
        make_study(self.study, PRESENCE)
        environment = {**os.environ, "USER": "Jane Doe", "LOGNAME": "Jane Doe"}
        for number in range(1, 13):
            steps, state = run_participant(self.study, number, env=environment)
            self.assertEqual(state, "complete")
            self.assertEqual(steps[0]["kind"], "consent")
        page = self.report()
        people = self.table("participants")
        self.assertEqual([one["state"] for one in people], 12 * ["complete"])
        self.assertEqual(len(self.table("replies")), 12 * (4 + 14 + 36 + 11 + 4))
        self.assertEqual(len(self.table("scores")), 12 * (4 + 6 + 4 + 1))
        self.assertEqual(len(self.table("tasks")), 12 * 6)
        # The task is scored by answers that the participants did not see.
        for row in self.table("tasks"):
            self.assertEqual(row["correct"], str(int(row["reply"] == row["expected"])))
        self.look_for_people()
        if page:
            self.assertNotIn("Order of conditions", page)
            for part in ("Spatial presence", "12 participants and no two conditions", "21 to 79 %", "Task with bricks", "Networked Minds", "<svg"):
                self.assertIn(part, page)

    def test_seven_participants_compare_two_conditions(self):
        make_study(self.study, COMPARISON)
        orders = set()
        for number in range(1, 8):
            steps, state = run_participant(self.study, number)
            self.assertEqual(state, "complete")
            shown = [step for step in steps if step["kind"] == "condition"]
            orders.add(tuple(step["condition"] for step in shown))
            self.assertEqual({step["host_line"] for step in shown}, {"renderer splat lock", "renderer mesh lock"})
        self.assertEqual(orders, {("splats", "mesh"), ("mesh", "splats")})
        page = self.report()
        self.look_for_people()
        if page:
            statistics = self.table("statistics")
            self.assertEqual({row["test"] for row in statistics}, {"signed-rank"})
            self.assertTrue(all(row["n"] == "7" and row["pair"] == "mesh - splats" for row in statistics))
            self.assertTrue(all(float(row["p_holm"]) >= float(row["p"]) for row in statistics))
            self.assertIn("too small to conclude", page)
            self.assertIn("Wilcoxon signed-rank", page)

    def test_a_killed_run_loses_at_most_the_answer_being_typed(self):
        make_study(self.study, COMPARISON)
        whole, _ = run_participant(self.study, 2)
        done = []
        for after in (0, 1, 2, 9, 17):
            steps, state = run_participant(self.study, 1, stop_after=after)
            self.assertEqual(state, "killed")
            done += steps
            # The program was killed while it waited for a reply: all earlier ones are there.
            journal = (self.study / "journals/P01.journal").read_text()
            entries = [line.split("\t")[2] for line in journal.splitlines()[1:]]
            self.assertEqual([one for one in entries if one != "resumed"], [step["id"] for step in done])
            self.assertEqual(journal[-1], "\n")
        # Half a line, as a machine leaves it whose power fails, is taken away.
        with open(self.study / "journals/P01.journal", "a") as file:
            file.write("99999\t12\trealism.me")
        steps, state = run_participant(self.study, 1)
        self.assertEqual(state, "complete")
        self.assertEqual(len(done + steps), len(whole))
        self.assertEqual(len({step["id"] for step in done + steps}), len(whole))
        code, _, errors = run("study", "run", self.study, "--participant", "P01")
        self.assertEqual(code, 1)
        self.assertIn("complete already", errors)

    def test_two_programs_do_not_run_one_participant(self):
        make_study(self.study, COMPARISON)
        with Process("study", "run", self.study, "--participant", "P01", "--json") as process:
            next_event(process, ("step",))
            code, _, errors = run("study", "run", self.study, "--participant", "P01")
            self.assertEqual(code, 1)
            self.assertIn("Another program writes", errors)

    def test_a_changed_protocol_does_not_go_on_with_old_replies(self):
        make_study(self.study, COMPARISON)
        run_participant(self.study, 1, stop_after=3)
        (self.study / "study.conf").write_text(COMPARISON + "\n# changed\n")
        code, _, errors = run("study", "run", self.study, "--participant", "P01")
        self.assertEqual(code, 1)
        self.assertIn("were changed since P01 began", errors)
        # Their text is kept under the number that their journal has.
        number = (self.study / "journals/P01.journal").read_text().split()[2]
        kept = {one.name: one.read_text() for one in (self.study / "texts" / number).iterdir()}
        self.assertEqual(kept, {"study.conf": COMPARISON, "texts.conf": (self.study / "texts.conf").read_text()})
        # The next one is told that the study begins anew.
        note = "P01 began with another text of the protocol"
        code, output, _ = run("study", "check", self.study)
        self.assertIn(note, output)
        self.assertEqual(json.loads(run("study", "check", self.study, "--json")[1])["begun_with_another_text"], ["P01"])
        with Process("study", "run", self.study, "--participant", "P02", "--json") as process:
            next_event(process, ("step",))
            wait_until(lambda: note in "".join(process.errors))
        (self.study / "study.conf").write_text(COMPARISON)
        self.assertIn("P02 began with another text", run("study", "check", self.study)[1])

    def test_a_number_belongs_to_one_participant(self):
        make_study(self.study, COMPARISON)
        run_participant(self.study, 1, stop_after=3)
        for other in ("P1", "P001", "A1"):
            code, _, errors = run("study", "run", self.study, "--participant", other)
            self.assertEqual(code, 1)
            self.assertIn(f"'{other}' has the same number as P01", errors)
        journals = self.study / "journals"
        self.assertEqual([one.name for one in journals.glob("*.journal")], ["P01.journal"])
        # A copy under another name is nobody's run.
        shutil.copy(journals / "P01.journal", journals / "P06.journal")
        code, _, errors = run("study", "run", self.study, "--participant", "P06")
        self.assertEqual(code, 1)
        self.assertIn("is the journal of P01; move it away", errors)

    def test_mistakes_are_told_with_line_and_reason(self):
        make_study(self.study, COMPARISON.replace("renderer = mesh", "renderer = marble").replace("kind = bricks", "kind = stones"))
        code, _, errors = run("study", "check", self.study)
        self.assertEqual(code, 1)
        for part in ("study.conf:14: kind: 'stones' is neither", "study.conf:7: condition: 'mesh': renderer:"):
            self.assertIn(part, errors)
        (self.study / "study.conf").write_text(COMPARISON.replace("questionnaires = texts.conf\n", ""))
        code, _, errors = run("study", "check", self.study)
        self.assertIn("the texts of 14 items of 'ipq'", errors)
        self.assertIn("igroup.org", errors)

    def test_names_are_no_pseudonyms(self):
        make_study(self.study, COMPARISON)
        for name in ("Jane", "P", "../P01", "P0", ""):
            code, _, errors = run("study", "run", self.study, "--participant", name)
            self.assertEqual(code, 1, name)
        self.assertEqual(list((self.study / "journals").iterdir()), [])

    def test_without_consent_nothing_is_asked(self):
        make_study(self.study, COMPARISON)
        done = subprocess.run([os.environ.get("THEATRON", "build/release/apps/theatron/theatron"), "study", "run", self.study,
                               "--participant", "P03"], input="no\n", capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("The run is declined.", done.stdout)
        self.report()
        self.assertEqual([one["state"] for one in self.table("participants")], ["declined"])

    def test_the_example_is_a_study_that_can_be_run(self):
        code, _, errors = run("study", "new", self.study)
        self.assertEqual(code, 0, errors)
        code, out, errors = run("study", "check", self.study, "--json")
        self.assertEqual(code, 0, errors)
        self.assertEqual(sorted(json.loads(out)["orders"][:2]), ["mesh, splats", "splats, mesh"])
        code, _, errors = run("study", "new", self.study)
        self.assertEqual(code, 1)
        self.assertIn("exists already", errors)

    def test_the_plan_of_the_task_becomes_a_case(self):
        make_study(self.study, COMPARISON)
        plans = self.folder / "plans"
        code, _, errors = run("study", "plan", self.study, "--out", plans)
        self.assertEqual(code, 0, errors)
        for name in ("build-1", "build-2"):
            told = json.loads((plans / f"{name}.json").read_text())
            self.assertEqual(len(told["bricks"]), 8)
            self.assertEqual(len(told["questions"]), 3)
            self.assertTrue((plans / f"{name}.svg").read_text().startswith("<svg"))
        self.assertNotEqual((plans / "build-1.json").read_text(), (plans / "build-2.json").read_text())
        case = self.folder / "case"
        code, out, errors = run("case", "import", plans / "build-1", case)
        self.assertEqual(code, 0, errors)
        colors = {brick["color"] for brick in json.loads((plans / "build-1.json").read_text())["bricks"]}
        parts = json.loads((case / "case.json").read_text())["parts"]
        self.assertEqual({part["name"].split()[0] for part in parts}, colors)
        # A question asks for the blue bricks.
        shown = {part["name"].split()[0]: part["color"] for part in parts}
        self.assertEqual(len(set(shown.values())), len(colors))
        self.assertEqual(shown.get("red", "#c4281b"), "#c4281b")

    def test_scales_without_a_meaning_of_their_points_are_told(self):
        make_study(self.study, COMPARISON)
        self.assertEqual(json.loads(run("study", "check", self.study, "--json")[1])["without_anchors"], ["ipq"])
        self.assertIn("Items of 'ipq' do not say what", run("study", "check", self.study)[1])
        form = (self.study / "texts.conf").read_text()
        (self.study / "texts.conf").write_text(form.replace("# anchors = \n", "anchors = no | yes\n"))
        self.assertEqual(json.loads(run("study", "check", self.study, "--json")[1])["without_anchors"], [])


if __name__ == "__main__":
    unittest.main()
