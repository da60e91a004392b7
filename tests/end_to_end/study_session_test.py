# SPDX-License-Identifier: Apache-2.0
"""A study whose steps are shown to a participant of a session: from consent to report, while programs are killed and
links break."""
import csv
import json
import os
import pathlib
import shutil
import signal
import stat
import tempfile
import unittest

from study_test import COMPARISON, CONSENT, PRESENCE, Participant, make_study, wait_for_reason
from theatron_process import Process, host, run, wait_until

NOBODY = "Anna Participant"  # a name that is to be in no file


def value(step, reply):
    return {"yes": 1, "no": 0}.get(reply) if reply in ("yes", "no") else reply


class Surface:
    """A participant without a window, whose replies are lines."""

    def __init__(self, link, number, name=NOBODY, home=None):
        """`home`: a folder by which the host knows the person again; without it each surface is another computer."""
        self.person = Participant(number)
        known = {"env": {**os.environ, "XDG_STATE_HOME": str(home)}} if home else {}
        self.process = Process("join", link, "--no-window", "--name", name, "--every", "1000", **known)
        self.seen = []

    def __enter__(self):
        self.process.__enter__()
        return self

    def __exit__(self, *what):
        self.process.__exit__(*what)

    def next_step(self):
        """Another step than the last one that it has seen."""
        def is_new(line):
            step = line.get("study")
            return step and "fps" not in line and step["kind"] != "interrupted" and \
                (not self.seen or step["step"] != self.seen[-1]["step"] or step["kind"] != self.seen[-1]["kind"])
        self.seen.append(self.process.wait_for(is_new)["study"])
        return self.seen[-1]

    def reply(self, step):
        reply = self.person.reply(step)
        self.process.say("study done" if reply == "" else f"study reply {value(step, reply)}")

    def go_to_the_end(self):
        while (step := self.next_step())["kind"] != "over":
            self.reply(step)


class StudiesInASession(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="theatron_study_session_"))
        self.addCleanup(shutil.rmtree, self.folder)
        self.study = self.folder / "study"

    def lead(self, link, number, *more):
        file = self.folder / "operator.link"
        file.write_text(link + "\n")
        return Process("study", "run", self.study, "--participant", f"P{number:02}", "--link", f"@{file}", "--json", *more)

    def session(self):
        return host(self.folder / "state", "synthetic:seconds=2,fps=5,quality=quick,loop=1")

    def journal(self, number=1):
        lines = (self.study / f"journals/P{number:02}.journal").read_text().splitlines()[1:]
        return [line.split("\t") for line in lines]

    def paths(self, number=1):
        with open(self.study / f"journals/P{number:02}.paths.csv", newline="") as file:
            return list(csv.DictReader(file))

    def look_for_people(self):
        for path in self.study.rglob("*"):
            if path.is_file():
                text = path.read_text()
                for word in (NOBODY, "127.0.0.1", "join=", "cert="):
                    self.assertNotIn(word, text, path)

    def test_from_consent_to_the_end_with_conditions_that_the_host_sets_and_locks(self):
        make_study(self.study, COMPARISON.replace("renderer = mesh", "renderer = mesh\ndepth-codec = rvl\nlatency-ms = 120"))
        with self.session() as h, Surface(h.greeting["links"]["expert"], 1) as anna, \
                self.lead(h.greeting["links"]["operator"], 1) as lead:
            tried = 0
            while (step := anna.next_step())["kind"] != "over":
                if step["kind"] == "watch":
                    # The participant cannot change what the condition sets.
                    anna.process.say("depth zstd")
                    tried += 1
                    if self.condition_of(lead) == "mesh":
                        anna.process.wait_for_error("codecs are set by the study")
                anna.reply(step)
            self.assertEqual(tried, 2)
            end = lead.wait_for(lambda event: event["event"] == "end")
            self.assertEqual(end["state"], "complete")
            self.assertEqual(lead.end(), 0)
        steps = [entry[2] for entry in self.journal()]
        self.assertEqual(len(steps), len(set(steps)))
        self.assertEqual(steps[0], "agree.consent")
        self.assertIn("build.mesh.condition", steps)
        self.assertEqual(stat.S_IMODE(os.stat(self.study / "journals/P01.paths.csv").st_mode), 0o600)
        rows = self.paths()
        kinds = [row["what"] for row in rows]
        self.assertLess(kinds.index("reply"), kinds.index("came"))
        self.assertEqual(kinds[-1], "left", "nothing is written after the end")
        times = [int(row["session_us"]) for row in rows if row["what"] in ("step", "reply")]
        self.assertEqual(times, sorted(times))
        self.assertEqual([row["detail"] for row in rows if row["what"] == "reply"], steps)
        self.look_for_people()

    condition = None

    def condition_of(self, lead):
        """That of the step which the leading program has shown last."""
        newest = None
        while not lead.lines.empty():
            line = json.loads(lead.lines.get())
            if line["event"] == "step":
                newest = line
        if newest is not None:
            self.condition = newest.get("condition")
        return self.condition

    def test_head_and_what_the_hands_do_is_written_on_the_clock_of_the_session(self):
        make_study(self.study, COMPARISON)
        with self.session() as h, Surface(h.greeting["links"]["expert"], 1) as anna, \
                self.lead(h.greeting["links"]["operator"], 1) as lead:
            path = self.study / "journals/P01.paths.csv"
            first = anna.next_step()
            anna.process.say("stand 0.5 1.6 1.5 0 1 0")
            anna.process.say("brick 0.1 1 0.2")
            # The host passes on what comes from one participant in its order: the reply is behind the pose.
            anna.reply(first)
            anna.next_step()
            anna.process.say("brick 0.3 1 0.2")
            wait_until(lambda: {"head", "made"} <= {row["what"] for row in self.paths()}, of=lead)
            head = next(row for row in self.paths() if row["what"] == "head")
            self.assertEqual([float(head[axis]) for axis in "xyz"], [0.5, 1.6, 1.5])
            made = [row for row in self.paths() if row["what"] == "made"]
            self.assertEqual([float(row["x"]) for row in made], [0.3], "the brick from before the consent is nowhere")
            self.assertRegex(made[0]["detail"], r"^brick \d+$")
            kinds = [row["what"] for row in self.paths()]
            self.assertEqual(set(kinds[:kinds.index("reply")]), {"step"})
            lead.send(signal.SIGKILL)
            lead.process.wait()
            self.assertTrue(path.read_text().endswith("\n"))

    def test_a_run_that_was_declined_keeps_no_path(self):
        make_study(self.study, COMPARISON)
        with self.session() as h, Surface(h.greeting["links"]["expert"], 1) as anna, \
                self.lead(h.greeting["links"]["operator"], 1) as lead:
            anna.next_step()
            anna.process.say("stand 0.5 1.6 1.5 0 1 0")
            anna.process.say("brick 0.1 1 0.2")
            anna.process.say("study reply 0")
            self.assertEqual(anna.next_step()["kind"], "over")
            self.assertEqual(lead.wait_for(lambda event: event["event"] == "end")["state"], "declined")
            self.assertEqual(lead.end(), 0)
        self.assertLessEqual({row["what"] for row in self.paths()}, {"step", "reply"})

    def test_a_killed_program_loses_at_most_the_answer_being_typed(self):
        make_study(self.study, PRESENCE)
        done = 0
        with self.session() as h, Surface(h.greeting["links"]["expert"], 1) as anna:
            for after in (0, 1, 5, 11):
                with self.lead(h.greeting["links"]["operator"], 1) as lead:
                    for _ in range(after):
                        step = anna.next_step()
                        anna.reply(step)
                        done += 1
                    anna.next_step()
                    lead.send(signal.SIGKILL)
                    lead.process.wait()
                    anna.seen.pop()  # it comes again
                    kept = [entry[2] for entry in self.journal() if entry[2] != "resumed"] if done else []
                    self.assertEqual(len(kept), done)
                    anna.process.wait_for(lambda line: line.get("study") and line["study"]["kind"] == "interrupted")
            with self.lead(h.greeting["links"]["operator"], 1) as lead:
                anna.go_to_the_end()
                self.assertEqual(lead.wait_for(lambda event: event["event"] == "end")["state"], "complete")
        steps = [entry[2] for entry in self.journal() if entry[2] != "resumed"]
        self.assertEqual(len(steps), len(set(steps)))
        self.assertEqual(len(steps), done + len([s for s in anna.seen[done:] if s["kind"] != "over"]))

    def test_a_participant_who_comes_back_goes_on_and_stop_ends_the_study(self):
        make_study(self.study, CONSENT.join(["study = Short\nbreak-off = Take the headset off.\n", "\nphase = opinion\nkind = questionnaire\nquestionnaire = own-presence\n"]))
        with self.session() as h, self.lead(h.greeting["links"]["operator"], 3, "--person", NOBODY) as lead:
            wait_for_reason(lead, "not in the session")
            home = self.folder / "home"
            with Surface(h.greeting["links"]["expert"], 3, home=home) as anna, \
                    Surface(h.greeting["links"]["expert"], 4, "Ben") as ben:
                for _ in range(3):
                    anna.reply(anna.next_step())
                last = anna.next_step()
                self.assertEqual(ben.seen, [])
            wait_for_reason(lead, "not in the session")
            # The same name from another computer gets no question.
            with Surface(h.greeting["links"]["expert"], 5) as other:
                wait_for_reason(lead, "Somebody else")
                self.assertEqual(other.seen, [])
            with Surface(h.greeting["links"]["observer"], 3, home=home) as anna:
                self.assertEqual(anna.next_step(), last)
                anna.process.say("study reply 99")
                self.assertIn("whole number", anna.process.wait_for(lambda line: line.get("study") and line["study"]["problem"])["study"]["problem"])
                # A reply without a number is none.
                given = len(self.journal(3))
                anna.process.say("study done")
                wait_until(lambda: "This step asks for a reply" in "".join(anna.process.errors))
                anna.process.say("study skip")
                anna.next_step()
                anna.process.say("study stop")
                self.assertEqual(anna.next_step()["texts"], ["Take the headset off."])
            self.assertEqual(lead.wait_for(lambda event: event["event"] == "end")["state"], "broken off")
        self.assertEqual([entry[3] for entry in self.journal(3)][given:], ["-", "-"])

    def test_sentences_name_what_is_wrong(self):
        make_study(self.study, COMPARISON)
        with self.session() as h:
            for arguments, part in (
                    (("--person", "Ben"), "--link"),
                    (("--link", "nonsense"), "link"),
                    (("--link", h.greeting["links"]["operator"], "--host-input", "pipe"), "--host-input")):
                code, _, errors = run("study", "run", self.study, "--participant", "P01", *arguments)
                self.assertNotEqual(code, 0)
                self.assertIn(part, errors)
            with Surface(h.greeting["links"]["expert"], 1), self.lead(h.greeting["links"]["expert"], 1) as lead:
                self.assertEqual(lead.end(), 1)
                self.assertIn("link for operators", "".join(lead.errors))


if __name__ == "__main__":
    unittest.main()
