# SPDX-License-Identifier: Apache-2.0
"""What earlier versions left behind opens with this one: tests/vectors/README.md."""
import json
import pathlib
import shutil
import tempfile
import threading
import unittest

import vectors
from raw_peer import FakeHost, Link, RawPeer, join_message
from theatron_process import Process, host, run, wait_until

ROLES = {"expert": 0, "publisher": 1, "observer": 2, "operator": 3, "made": 0, "lasting": 2}
REFUSALS = {"expired": "This link has expired", "revoked": "The access code of this link is wrong"}


def member(link, name, *options):
    return Process("join", link, "--name", name, "--every", "0.1", *options)


def positions(figures):
    return sorted(o["position"] for o in figures["room"]["objects"])


class Vectors(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="theatron_vectors_"))
        self.addCleanup(shutil.rmtree, self.folder)
        self.camera = f"folder:{vectors.make_camera(self.folder / 'table')},loop=1,fps=5"
        self.assertTrue(vectors.versions())

    def each_version(self):
        for version in vectors.versions():
            with self.subTest(version.name):
                yield version, json.loads((version / "expected.json").read_text())

    def state(self, version):
        return vectors.copy_state(version / "state", self.folder / f"state of {version.name}")

    def answers(self, h, token):
        """The first messages to a participant with this token: the role, or the refusal."""
        link = Link.parse(h.greeting["link"])._replace(token=token)
        join = join_message(link)
        with RawPeer(link) as peer:
            peer.send(join)
            kind, fields = peer.receive_control("Standing", "Refused")
            return fields.get("role", 0) if kind == "Standing" else fields["in_english"]

    def test_recordings_hold_the_same_pictures(self):
        for version, expected in self.each_version():
            for name, facts in expected["recordings"].items():
                with self.subTest(name):
                    found = vectors.recording_facts(version / "recordings" / name)
                    # Depth is exact; colour may one day be decoded a little better.
                    means, found_means = facts.pop("color_means", []), found.pop("color_means", [])
                    self.assertEqual(found, facts)
                    self.assertEqual(len(found_means), len(means))
                    for picture, other in zip(means, found_means):
                        self.assertLess(max(abs(float(a) - float(b)) for a, b in zip(picture.split(), other.split())), 3)

    def test_a_host_takes_the_state_folder_with_its_links_its_room_and_its_sessions(self):
        for version, expected in self.each_version():
            state = self.state(version)
            kept = expected["state"]
            lines = len((state / "audit.jsonl").read_text().splitlines())
            with host(state, self.camera, options=("--session", "OR 3")) as h:
                self.assertEqual(Link.parse(h.greeting["link"]).fingerprint, vectors.fingerprint(state))
                for name, token in kept["tokens"].items():
                    with self.subTest(name):
                        if name in REFUSALS:
                            self.assertIn(REFUSALS[name], self.answers(h, token))
                        else:
                            self.assertEqual(self.answers(h, token), ROLES[name])
                labels = sorted(link["for"] for link in json.loads(run("link", "--list", "--state", state, "--json")[1]) if link["for"])
                self.assertEqual(labels, ["Ben", "Carl", "Dr. Ada"])
                with member(h.greeting["links"]["operator"], "Olga") as olga:
                    found = olga.wait_for(lambda f: f["room"]["objects"] and f["cameras"])
                    self.assertEqual(positions(found), kept["bricks"])
                    self.assertEqual(found["cameras"][0]["adjusted"], kept["adjusted"])
                    self.assertEqual(found["room"]["objects"][0]["creator"], 0, "Ada is not here")
                wait_until(lambda: "OR 4" in run("session", "list", "--state", state)[1])
                wait_until(lambda: len((state / "audit.jsonl").read_text().splitlines()) > lines, of=h)
            events = [json.loads(line)["event"] for line in (state / "audit.jsonl").read_text().splitlines()]
            self.assertEqual(sorted(set(events[:lines])), kept["audited"])

    def test_a_host_takes_the_places_and_the_background(self):
        for version, _ in self.each_version():
            with host(self.state(version), self.camera, options=("--places", version / "places.json", "--filter",
                                                                f"background:file={version}/empty.background")) as h, \
                    member(h.greeting["link"], "Ada") as ada:
                found = ada.wait_for(lambda f: f["cameras"] and "background" in f["cameras"][0]["filter"])
                self.assertEqual(found["cameras"][0]["position"], [0.4, 1.6, 2.0])

    def test_a_case_is_right_and_opens_in_the_room(self):
        for version, _ in self.each_version():
            cases = self.folder / f"cases of {version.name}"
            shutil.copytree(version / "case", cases / "kept")
            code, out, errors = run("case", "check", cases / "kept")
            self.assertEqual(code, 0, out + errors)
            with host(self.folder / "state", options=("--cases", cases)) as h, member(h.greeting["link"], "Ada") as ada:
                ada.wait_for(lambda f: f["cases"]["offered"])
                ada.say("case open --yes Kept liver")
                found = ada.wait_for(lambda f: f["cases"]["open"] and f["cases"]["open"]["complete"])
                self.assertEqual([part["name"] for part in found["cases"]["open"]["parts"]], ["liver"])

    def test_a_host_understands_all_that_a_participant_of_that_version_sent(self):
        for version, expected in self.each_version():
            sent = [data for direction, data in vectors.read_exchange(version / "exchange.bin") if direction == vectors.SENT]
            self.assertGreater(len(sent), 5)
            with host(self.state(version), self.camera, options=("--session", "OR 3")) as h, RawPeer(h.greeting["link"]) as peer:
                for envelope in sent:
                    peer.send(envelope)
                self.assertEqual(peer.receive_control("Welcome", "Refused")[1].get("host_name"), "OR 3")
                peer.receive_control("Pong")
                threading.Thread(target=peer.wait_for_end, daemon=True).start()
                with member(h.greeting["links"]["operator"], "Olga") as olga:
                    found = olga.wait_for(lambda f: len(f["room"]["objects"]) == 2)
                    self.assertEqual(positions(found), sorted(expected["state"]["bricks"] + [[1, 1, 1]]))
                    self.assertIn("Ada", [person["name"] for person in found["room"]["people"]])

    def test_a_participant_understands_all_that_a_host_of_that_version_sent(self):
        for version, expected in self.each_version():
            got = [data for direction, data in vectors.read_exchange(version / "exchange.bin") if direction == vectors.GOT]
            left = threading.Event()

            def script(guest, got=got, left=left):
                guest.receive_control("Join")
                for envelope in got:
                    guest.send(envelope)
                left.wait()

            with FakeHost(script) as fake, member(fake.link, "Ada") as ada:
                found = ada.wait_for(lambda f: f["phase"] != "connecting" and f["cameras"] and f["cameras"][0]["frames"] > 1)
                self.assertEqual((found["phase"], found["host"], found["cameras"][0]["name"]), ("joined", "OR 3", "table"))
                self.assertEqual(found["cameras"][0]["adjusted"], expected["state"]["adjusted"])
                ada.wait_for(lambda f: positions(f) == sorted(expected["state"]["bricks"] + [[1, 1, 1]]))
                left.set()
                self.assertEqual(fake.faults, [])


if __name__ == "__main__":
    unittest.main()
