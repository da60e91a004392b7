# SPDX-License-Identifier: Apache-2.0
"""Roles, admission, removal, links and the audit log, with real processes: docs/room.md, docs/keys.md."""
import contextlib
import json
import os
import pathlib
import shutil
import struct
import tempfile
import time
import unittest

from raw_peer import CONTROL, RawPeer
from theatron_process import Process, host, make_recording, read_png, run, wait_until

ADMIT, REMOVE, END_SESSION = 1, 6, 8  # wire::ManageAction
ROOM = 3                              # wire::Feature


def names(figures):
    return sorted(person["name"] for person in figures["room"]["people"])


def waiting(figures):
    return sorted(visitor["name"] for visitor in figures["visitors"])


class People(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="theatron_people_"))
        self.addCleanup(shutil.rmtree, self.folder)
        self.camera = f"folder:{make_recording(self.folder / 'box')},loop=1,preload=1"
        self.state = self.folder / "state"

    def start(self, *options):
        return host(self.state, self.camera, options=options)

    def member(self, link, name, person=None):
        """A participant with a person id of its own, or that of `person`."""
        home = self.folder / f"home of {person or name}"
        return Process("join", link, "--name", name, "--every", "0.1",
                       env={**os.environ, "XDG_STATE_HOME": str(home)})

    def link(self, *arguments):
        code, out, errors = run("link", "--state", self.state, "--json", *arguments)
        self.assertEqual(code, 0, errors)
        return json.loads(out)

    def audited(self):
        with open(self.state / "audit.jsonl") as file:
            return [json.loads(line) for line in file]

    def assert_ends_with(self, process, text, code=1):
        self.assertEqual(process.end(), code, process.errors)
        self.assertIn(text, "".join(process.errors))

    def test_names_tell_people_apart_and_a_removed_ones_link_shows_nobody(self):
        with contextlib.ExitStack() as stack:
            h = stack.enter_context(self.start())
            links, own = h.greeting["links"], self.link("--role", "expert", "--for", "Ada")["link"]
            boss = stack.enter_context(self.member(links["operator"], "Boss"))
            ada = stack.enter_context(self.member(own, "Ada"))
            boss.wait_for(lambda f: names(f) == ["Ada", "Boss"])
            # A Cyrillic letter, and one that nobody sees.
            other = stack.enter_context(self.member(links["expert"], "\u0410d\u200ba"))
            boss.wait_for(lambda f: names(f) == ["Ada", "Boss", "\u0410da (2)"])

            shown = lambda link: json.loads(run("lobby", link, "--json")[1])["sessions"][0]
            self.assertEqual(len(shown(own)["people"]), 3)
            boss.say("remove Ada")
            self.assert_ends_with(ada, "An operator has removed you from this session.")
            wait_until(lambda: "people" not in shown(own))
            session, picture = shown(own), self.folder / "picture.png"
            self.assertEqual((session["held_back"], "cameras" in session, session["people_count"]), (True, False, 2))
            self.assertIn("was removed", run("lobby", own)[1])
            self.assertIn("gives no picture", run("lobby", own, "--picture", picture)[2])
            self.assertIn("was removed", run("status", own)[2])
            self.assertEqual(len(shown(links["expert"])["people"]), 2)
            self.assertEqual(run("lobby", links["expert"], "--picture", picture)[0], 0)
            self.assertEqual(other.newest_json()["phase"], "joined")

    def test_an_operator_admits_mutes_changes_roles_and_removes(self):
        with contextlib.ExitStack() as stack:
            h = stack.enter_context(self.start("--admit", "ask"))
            links = h.greeting["links"]
            boss = stack.enter_context(self.member(links["operator"], "Boss"))
            boss.wait_for(lambda f: names(f) == ["Boss"])
            anna = stack.enter_context(self.member(links["expert"], "Dr. Anna"))
            olga = stack.enter_context(self.member(links["observer"], "Olga"))
            seen = boss.wait_for(lambda f: waiting(f) == ["Dr. Anna", "Olga"])
            self.assertRegex(seen["visitors"][0]["person"], "^[0-9a-f]{8}$")
            self.assertEqual(anna.wait_for(lambda f: f["phase"] == "waiting")["cameras"], [])
            boss.say("admit Dr. Anna")
            boss.say("admit Olga")
            for person in (boss, anna, olga):
                person.wait_for(lambda f: names(f) == ["Boss", "Dr. Anna", "Olga"])
            self.assertEqual(olga.wait_for(lambda f: f["cameras"])["role"], "observer")

            # An observer changes nothing; an expert does, until it is one.
            for person in (olga, anna):
                person.say("stand 0 1.6 1 0 1 0")
                person.say("call")
            called = boss.wait_for(lambda f: any(p["calls"] for p in f["room"]["people"]))
            self.assertEqual([p["name"] for p in called["room"]["people"] if p["calls"]], ["Dr. Anna"])
            olga.say("brick 0 1 0")
            olga.wait_for_error("role does not allow")
            anna.say("brick 0 1 0")
            olga.wait_for(lambda f: len(f["room"]["objects"]) == 1)
            boss.say("role Dr. Anna observer")
            self.assertEqual(anna.wait_for(lambda f: f["role"] == "observer")["phase"], "joined")
            anna.wait_for_error("You are an observer now.")
            anna.say("brick 0 2 0")
            anna.wait_for_error("role does not allow")
            anna.say("admit Olga")
            anna.wait_for_error("Only operators")
            boss.say("mute Olga")
            olga.wait_for(lambda f: f["muted"])
            anna.wait_for(lambda f: any(p["muted"] for p in f["room"]["people"]))

            # A removed person is gone at once and stays out; the others notice nothing else.
            boss.say("remove Dr. Anna")
            self.assert_ends_with(anna, "An operator has removed you from this session.")
            boss.wait_for(lambda f: names(f) == ["Boss", "Olga"])
            again = stack.enter_context(self.member(links["expert"], "Dr. Anna"))
            self.assert_ends_with(again, "An operator has removed you from this session.")

            # One is turned away; one decision comes from the host's own machine.
            ken = stack.enter_context(self.member(links["expert"], "Ken"))
            boss.wait_for(lambda f: waiting(f) == ["Ken"])
            boss.say("refuse Ken")
            self.assert_ends_with(ken, "An operator has not let you in.")
            lea = stack.enter_context(self.member(links["expert"], "Lea"))
            boss.wait_for(lambda f: waiting(f) == ["Lea"])
            wait_until(lambda: json.loads(run("status", links["operator"], "--json")[1])["visitors"])
            h.say("admit Lea")
            lea.wait_for(lambda f: f["phase"] == "joined")

            boss.say("end session")
            for person in (olga, lea, boss):
                self.assert_ends_with(person, "An operator has ended the session.", code=0)
            wait_until(lambda: self.audited()[-1]["event"] == "left")
        log = self.audited()
        self.assertEqual([e["event"] for e in log if e.get("name") == "Dr. Anna"],
                         ["waits", "admitted", "joined", "role_changed", "removed", "left", "refused"])
        self.assertEqual([(e["event"], e["by"]) for e in log if "by" in e],
                         [("admitted", "Boss"), ("admitted", "Boss"), ("role_changed", "Boss"), ("muted", "Boss"),
                          ("removed", "Boss"), ("turned_away", "Boss"), ("admitted", "host"), ("ended", "Boss")])
        anna_joined = next(e for e in log if e["event"] == "joined" and e["name"] == "Dr. Anna")
        self.assertRegex(anna_joined["time"], r"^\d{4}-\d\d-\d\dT\d\d:\d\d:\d\d\.\d{3}Z$")
        self.assertRegex(anna_joined["person"], "^[0-9a-f]{32}$")
        self.assertEqual((anna_joined["address"], anna_joined["link"], anna_joined["role"]),
                         ("127.0.0.1", "expert", "expert"))
        self.assertEqual([e["detail"] for e in log if e["event"] == "shared"], ["box"])

    def test_a_link_has_a_role_and_an_end_and_can_be_revoked_at_once(self):
        with contextlib.ExitStack() as stack:
            h = stack.enter_context(self.start())
            made = self.link("--role", "observer", "--hours", "1", "--for", "Olga")
            self.assertIn("&role=observer&until=" + made["until"], made["link"])
            olga = stack.enter_context(self.member(made["link"], "Olga"))
            self.assertEqual(olga.wait_for(lambda f: f["phase"] == "joined")["role"], "observer")
            other = stack.enter_context(self.member(h.greeting["link"], "Other"))
            other.wait_for(lambda f: f["phase"] == "joined")
            self.assertIn({"name": made["name"], "role": "observer", "until": made["until"], "expired": False,
                           "for": "Olga"}, self.link("--list"))
            self.assertEqual(run("link", "--state", self.state, "--revoke", made["name"], "--json"),
                             (0, json.dumps({"revoked": made["name"]}, separators=(",", ":")) + "\n", ""))
            self.assert_ends_with(olga, "The link by which you came is no longer valid")
            late = stack.enter_context(self.member(made["link"], "Late"))
            self.assert_ends_with(late, "The access code of this link is wrong")
            log = self.audited()
            self.assertEqual([(e["event"], e.get("participant") is None, e["role"]) for e in log if e.get("link") == made["name"]],
                             [("link_made", True, "observer"), ("joined", False, "observer"), ("link_revoked", True, "observer"),
                              ("link_revoked", False, "observer"), ("left", False, "observer")])
            self.assertIn("access code", next(e for e in log if e.get("name") == "Late")["detail"])

            # The link of a role gets another token.
            self.assertEqual(run("link", "--state", self.state, "--revoke", "expert")[0], 0)
            self.assert_ends_with(other, "The link by which you came is no longer valid")
            fresh = self.link("--show", "expert")["link"]
            self.assertNotEqual(fresh, h.greeting["link"])
            again = stack.enter_context(self.member(fresh, "Again"))
            again.wait_for(lambda f: f["phase"] == "joined")

            # An operator revokes it from within.
            boss = stack.enter_context(self.member(h.greeting["links"]["operator"], "Boss"))
            boss.wait_for(lambda f: names(f) == ["Again", "Boss"])
            boss.say("revoke Again")
            self.assert_ends_with(again, "The link by which you came is no longer valid")

            short = self.link("--hours", "0.0003")
            time.sleep(1.1)  # it is as short as a link can be
            wait_until(lambda: "links changed" in "".join(h.errors))
            late = stack.enter_context(self.member(short["link"], "Late"))
            self.assert_ends_with(late, "This link has expired")
            for command in ("lobby", "status"):
                code, _, errors = run(command, short["link"])
                self.assertEqual((code, "This link has expired" in errors), (1, True), errors)

    def test_a_link_is_shown_as_a_qr_code(self):
        with self.start():
            pass
        code, out, errors = run("link", "--state", self.state, "--show", "observer", "--qr")
        self.assertEqual(code, 0, errors)
        lines = out.splitlines()
        self.assertTrue(lines[0].startswith("https://"))
        picture = lines[2:]
        self.assertEqual({len(line) for line in picture}, {len(picture) * 2 - 1})
        for arguments, problem in ((("--revoke", "nobody"), "no link 'nobody'"), (("--show", "x"), "no link 'x'"),
                                   (("--hours", "nan"), "not a number of hours"), (("--role", "viewer"), "viewer"),
                                   (("--list", "--hours", "1"), "excludes")):
            code, _, errors = run("link", "--state", self.state, *arguments)
            self.assertNotEqual(code, 0, arguments)
            self.assertIn(problem, errors)
        code, _, errors = run("link", "--state", self.folder / "other")
        self.assertIn("No host has run", errors)

    def test_a_link_shows_the_lobby_before_joining_but_little_where_one_must_ask(self):
        with self.start() as h, self.member(h.greeting["link"], "Anna") as anna:
            anna.wait_for(lambda f: f["phase"] == "joined")
            links = h.greeting["links"]

            def lobby(link):
                code, out, errors = run("lobby", link, "--json")
                self.assertEqual(code, 0, errors)
                return json.loads(out)

            wait_until(lambda: lobby(links["observer"])["sessions"][0].get("people"))
            shown = lobby(links["observer"])
            self.assertEqual(shown["role"], "observer")
            session = shown["sessions"][0]
            self.assertEqual((session["people"], [c["name"] for c in session["cameras"]]),
                             ([{"name": "Anna", "role": "expert", "muted": False}], ["box"]))
            picture = self.folder / "session.png"
            code, out, errors = run("lobby", links["observer"], "--picture", picture)
            self.assertEqual(code, 0, errors)
            self.assertIn("people: Anna (expert)", out)
            width, height, _, rows = read_png(picture)
            self.assertEqual((width, height), (160, 120))
            self.assertIn((220, 60, 40), {tuple(row[3 * x:3 * x + 3]) for row in rows for x in range(width)})
            code, _, errors = run("lobby", links["observer"].replace("join=", "join=0"))
            self.assertEqual(code, 1)
            self.assertIn("does not know the link's token", errors)
        with self.start("--admit", "ask") as h:
            session = lobby(h.greeting["link"])["sessions"][0]
            self.assertEqual(session, {"name": "operating room", "asks": True, "ended": False, "people_count": 0})
            code, _, errors = run("lobby", h.greeting["link"], "--picture", picture)
            self.assertIn("gives no picture", errors)
            self.assertIn("people", lobby(h.greeting["links"]["operator"])["sessions"][0])
            code, _, errors = run("status", h.greeting["link"])
            self.assertEqual(code, 1)
            self.assertIn("let in one by one", errors)

    def test_a_hostile_member_is_refused_and_counted_and_harms_nobody(self):
        with contextlib.ExitStack() as stack:
            h = stack.enter_context(self.start())
            anna = stack.enter_context(self.member(h.greeting["links"]["expert"], "Anna"))
            anna.wait_for(lambda f: f["phase"] == "joined")
            anna.say("brick 0 1 0")
            number = anna.wait_for(lambda f: f["room"]["objects"])["room"]["objects"][0]["id"]
            peer = stack.enter_context(RawPeer(h.greeting["links"]["observer"]))
            peer.join(name="Mallory", features=[1, ROOM])
            peer.receive_control("Welcome")
            victim = anna.newest_json()["room"]["self"]
            for action in range(ADMIT, END_SESSION + 1):
                peer.send_control("Manage", number=action, action=action, participant=victim, role=2)
                _, answer = peer.receive_control("Managed")
                self.assertEqual(answer, {"number": action, "refusal": 1})
            requests = [bytes([3]) + struct.pack("<I", number), bytes([2]) + struct.pack("<I", number),
                        bytes([6]) + struct.pack("<IH", number, 0), b"\xff" * 40, bytes([3]) + struct.pack("<I", 77)]
            for i, request in enumerate(requests, 1):
                peer.send_control("RoomRequest", number=i, request=list(request))
                _, answer = peer.receive_control("RoomDecision")
                self.assertEqual(answer, {"number": i, "refusal": 4})
            peer.send_control("Publish", cameras=[{"name": "x"}])
            self.assertEqual(peer.receive_control("Published")[1]["problem"]["code"], 400)
            figures = anna.newest_json()
            self.assertEqual([o["id"] for o in figures["room"]["objects"]], [number])
            self.assertEqual(figures["room"]["objects"][0]["held_by"], 0)

            def mallory():
                status = json.loads(run("status", h.greeting["link"], "--json")[1])
                return next((p for p in status["participants"] if p["name"] == "Mallory"), None)

            wait_until(lambda: mallory()["denied_messages"] == END_SESSION + len(requests) + 1)
            # A flood, then bytes that are no message: its connection ends, the other one does not notice.
            flood = [bytes([CONTROL]) + bytes(range(i % 200, i % 200 + 40)) for i in range(50)]
            with contextlib.suppress(OSError, EOFError):
                for envelope in flood:
                    peer.send(envelope)
                peer.wait_for_end()
            wait_until(lambda: mallory() is None)
            frames = anna.newest_json()["cameras"][0]["frames"]
            self.assertEqual(anna.wait_for(lambda f: f["cameras"][0]["frames"] > frames + 10)["joins"], 1)


if __name__ == "__main__":
    unittest.main()
