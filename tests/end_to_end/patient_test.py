# SPDX-License-Identifier: Apache-2.0
"""The patient of the open case is seen by roles that may know it, and kept nowhere."""
import contextlib
import json
import pathlib
import shutil
import tempfile
import threading
import unittest

from browser import CHROMIUM, Browser
from case_test import case_host, has_all, member, write_case
from raw_peer import RawPeer
from theatron_process import PROGRAM, Process, host, run, wait_until

PAGE = pathlib.Path(PROGRAM).parent / "web/files.txt"
ROOM, CASES, PATIENT = 3, 4, 11  # features
SHOWN = (b"Doe, Jane", b"1961-02-03", b"AB-471142")
SECRETS = SHOWN + (b"Doe^Jane", b"19610203")


def write_patient_case(folder, *further):
    write_case(folder)
    file = folder / "identifiers.json"
    series = {"file": "ct.thvolume", "PatientName": "Doe^Jane", "PatientBirthDate": "19610203", "PatientID": "AB-471142",
              "StudyDate": "20260301"}
    file.write_text(json.dumps({"series": [series, *further]}))
    file.chmod(0o600)


class Listener(RawPeer):
    """A participant that keeps every byte that the host sends it."""

    def __init__(self, link, name):
        super().__init__(link)
        self.heard = bytearray()
        self.join(name=name, features=[ROOM, CASES, PATIENT])
        self.thread = threading.Thread(target=self._listen, daemon=True)
        self.thread.start()

    def _listen(self):
        with contextlib.suppress(EOFError, OSError):
            while True:
                self.heard += self.receive()

    def knows(self):
        return all(text in bytes(self.heard) for text in SHOWN)

    def knows_any(self):
        return any(text in bytes(self.heard) for text in SECRETS)


class Patient(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="theatron_patient_"))
        self.addCleanup(shutil.rmtree, self.folder)
        self.cases = self.folder / "cases"
        self.cases.mkdir()

    def test_operators_learn_it_others_and_files_do_not(self):
        write_patient_case(self.cases / "liver")
        recording, summary = self.folder / "session.mkv", self.folder / "summary.json"
        with contextlib.ExitStack() as stack:
            h = stack.enter_context(case_host(self.folder, self.cases)("--summary", summary))
            links = h.greeting["links"]
            olga = stack.enter_context(Listener(links["operator"], "Olga"))
            eva = stack.enter_context(Listener(links["expert"], "Eva"))
            oskar = stack.enter_context(Listener(links["observer"], "Oskar"))
            # Figures are no display: also those of an operator have no name.
            anna = stack.enter_context(member(links["operator"], "Anna"))
            anna.wait_for(lambda f: f["cases"]["offered"] and len(f["room"]["people"]) == 4)
            self.assertFalse(olga.knows_any(), "no case is open")
            with Process("record", links["expert"], recording, "--seconds", "2") as recorder:
                anna.wait_for(lambda f: len(f["room"]["people"]) == 5)
                anna.say("case open --yes Made liver")
                anna.wait_for(has_all)
                wait_until(olga.knows)
                self.assertEqual(recorder.end(), 0, "".join(recorder.errors))
            self.assertFalse(eva.knows_any())
            anna.say("role Eva operator")
            wait_until(eva.knows)
            with Process("join", links["operator"], "--offscreen", self.folder / "view.png", "--size", "160x120", "--quality", "low",
                         "--seconds", "0.2", "--renderer", "mesh", "--json") as viewer:
                self.assertEqual(viewer.end(), 0, "".join(viewer.errors))
                self.assertNotIn("Doe", viewer.lines.get())
            figures = json.dumps(anna.newest_json())
            h.say("end session")
            wait_until(lambda: not oskar.thread.is_alive(), "the end of the observer's connection")
            self.assertFalse(oskar.knows_any())
            h.process.terminate()
            self.assertEqual(h.end(), 0)
            said = "".join(h.errors + anna.errors + viewer.errors + recorder.errors) + figures
        for secret in SECRETS:
            self.assertNotIn(secret.decode(), said)
            for file in self.folder.rglob("*"):
                if file.is_file() and file.name != "identifiers.json":
                    self.assertNotIn(secret, file.read_bytes(), file)
        self.assertTrue((self.folder / "state/audit.jsonl").exists() and summary.exists() and recording.exists())

    def test_a_case_is_opened_with_an_explicit_word_and_one_of_two_patients_is_not_offered(self):
        write_patient_case(self.cases / "liver")
        write_patient_case(self.cases / "mixed", {"file": "mr.thvolume", "PatientName": "Roe^Jane", "PatientID": "XY-1"})
        with case_host(self.folder, self.cases)() as h, member(h.greeting["links"]["expert"], "Anna") as anna:
            h.wait_for_error("names more than one patient; import the images of each by themselves. This case is not offered.")
            anna.wait_for(lambda f: f["cases"]["offered"] == ["Made liver"])
            anna.say("case open Made liver")
            anna.wait_for_error("Open the case 'Made liver' for all in the room? Say 'case open --yes Made liver'.")
            self.assertIsNone(anna.newest_json()["cases"]["open"])
            anna.say("case open --yes Made liver")
            anna.wait_for(has_all)
            self.assertEqual(anna.newest_json()["cases"]["open"]["name"], "Made liver")

    def test_the_roles_are_chosen_and_observers_are_none(self):
        for roles, problem in (("operator,observer", "observers never learn"), ("doctor", "none of operator, expert and publisher")):
            code, _, errors = run("host", "--listen", "127.0.0.1:0", "--state", self.folder / "state", "--identifiers-for", roles)
            self.assertEqual(code, 1)
            self.assertIn(problem, errors)

    @unittest.skipUnless(CHROMIUM, "chromium is not installed: apt-get install chromium")
    @unittest.skipUnless(PAGE.exists(), "there is no browser client: make build")
    def test_the_page_of_a_person_who_may_know_it_shows_it_in_the_panel(self):
        write_patient_case(self.cases / "liver")
        with host(self.folder / "state", options=("--cases", self.cases, "--identifiers-for", "expert")) as h, Browser() as browser, \
                member(h.greeting["links"]["operator"], "Anna") as anna:
            page = browser.open(h.greeting["link"], (640, 360))
            page.wait_for("document.readyState === 'complete' && !!document.getElementById('invitation')?.textContent")
            # A page that chooses by itself leaves the room, with its panels, where a busy machine draws too slowly.
            page.enter(way="room")
            page.wait_for("theatron.state.phase === 'joined' && !!theatron.state.overlay.panels.length")
            anna.wait_for(lambda f: f["cases"]["offered"] and len(f["room"]["people"]) == 2)
            page.evaluate("document.getElementById('show_case').click()")
            panels = "document.getElementById('room_panels').textContent"
            press = "[...document.querySelectorAll('#room_panels button')].find(b => b.textContent === '{}').click()"
            page.wait_for(f"{panels}.includes('Made liver')")
            page.evaluate(press.format("Open"))
            page.wait_for(f"{panels}.includes('Open the case of Doe, Jane, born 1961-02-03, images of 2026-03-01?')")
            page.evaluate(press.format("Cancel"))
            page.wait_for(f"!{panels}.includes('Doe')")
            self.assertIsNone(anna.newest_json()["cases"]["open"])
            anna.say("case open --yes Made liver")
            page.wait_for(f"{panels}.includes('Patient: Doe, Jane') && {panels}.includes('born 1961-02-03, number AB-471142')")
            self.assertNotIn("Doe", page.evaluate("JSON.stringify({ ...localStorage, ...sessionStorage })"))
            anna.say("role Ada observer")
            page.wait_for(f"{panels}.includes('Made liver') && !{panels}.includes('Doe')")


if __name__ == "__main__":
    unittest.main()
