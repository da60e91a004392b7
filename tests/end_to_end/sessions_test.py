# SPDX-License-Identifier: Apache-2.0
"""Several sessions in one host: apart from each other, made and ended while it runs, kept over a restart."""
import contextlib
import json
import os
import pathlib
import shutil
import socket
import struct
import tempfile
import unittest

from raw_peer import VOICE, RawPeer
from theatron_process import Process, host, make_recording, read_png, run, wait_until


class Voice(RawPeer):
    def __init__(self, link):
        super().__init__(link)
        self.join(depth_codec="raw", color_codec="raw")
        self.number = self.receive_control("Welcome")[1]["participant"]

    def speak(self, packet):
        self.send(bytes([VOICE]) + struct.pack("<I", self.number) + packet)

    def hear(self):
        """The speaker and the packet of the next envelope of voice."""
        while True:
            envelope = self.receive()
            if envelope[0] == VOICE:
                return struct.unpack_from("<I", envelope, 1)[0], envelope[5:]


def people(figures):
    return sorted(person["name"] for person in figures["room"]["people"])


def bricks(figures):
    return [o["position"] for o in figures["room"]["objects"]]


def cameras(figures):
    return [camera["name"] for camera in figures["cameras"]]


class Sessions(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="theatron_sessions_"))
        self.addCleanup(shutil.rmtree, self.folder)
        self.state = self.folder / "state"
        self.table, self.lamp = (f"folder:{make_recording(self.folder / name, frames=5)},loop=1,preload=1"
                                 for name in ("table", "lamp"))

    def start(self, *options):
        return host(self.state, options=options)

    def member(self, link, name):
        home = self.folder / f"home of {name}"
        return Process("join", link, "--name", name, "--every", "0.1", env={**os.environ, "XDG_STATE_HOME": str(home)})

    def command(self, *words):
        """The JSON line of a command on the host's machine."""
        code, out, errors = run(*words, "--state", self.state, "--json")
        self.assertEqual(code, 0, errors)
        return json.loads(out)

    def refusal(self, *words):
        code, _, errors = run(*words)
        self.assertEqual(code, 1)
        return errors

    def audited(self):
        with open(self.state / "audit.jsonl") as file:
            return [json.loads(line) for line in file]

    def test_a_session_with_a_silent_camera_holds_up_no_other(self):
        with socket.create_server(("127.0.0.1", 0)) as silent, self.start("--session", "OR 3", "--camera", self.table):
            with Process("session", "create", "slow", "--state", self.state, "--camera",
                         f"rtsp://127.0.0.1:{silent.getsockname()[1]}/live") as slow:
                with silent.accept()[0]:
                    self.command("session", "create", "quick", "--camera", self.lamp)
                    told = {one["name"]: one["state"] for one in self.command("session", "list")}
                    self.assertEqual((told["quick"], told["slow"]), ("open", "opening"))
                    self.assertIsNone(slow.process.poll(), "its camera has not answered")

    def test_two_sessions_know_nothing_of_each_other(self):
        with contextlib.ExitStack() as stack:
            h = stack.enter_context(self.start("--session", "OR 3", "--camera", self.table,
                                               "--session", "OR 4", "--camera", self.lamp))
            third, (fourth,) = h.greeting["links"], h.greeting["sessions"]
            self.assertEqual((h.greeting["cameras"], fourth["name"], fourth["cameras"]), (["table"], "OR 4", ["lamp"]))
            fourth = fourth["links"]
            self.assertFalse(set(third.values()) & set(fourth.values()))
            anna, ben, carla, david = (stack.enter_context(self.member(link, name)) for link, name in (
                (third["operator"], "Anna"), (third["expert"], "Ben"),
                (fourth["operator"], "Carla"), (fourth["expert"], "David")))
            for person, others, camera in ((anna, ["Anna", "Ben"], "table"), (ben, ["Anna", "Ben"], "table"),
                                           (carla, ["Carla", "David"], "lamp"), (david, ["Carla", "David"], "lamp")):
                person.wait_for(lambda f: people(f) == others and cameras(f) == [camera]
                                and f["cameras"][0]["frames"] > 5)
            log = "".join(h.errors)
            self.assertRegex(log, r'participant joined.*name=David.* session="OR 4"\n')
            self.assertNotRegex(log, r'participant joined.*name=Ben.* session=')

            # Objects and voices stay where they are.
            anna.say("brick 1 1 1")
            ben.wait_for(lambda f: bricks(f) == [[1, 1, 1]])
            carla.say("brick 2 1 2")
            david.wait_for(lambda f: bricks(f) == [[2, 1, 2]])
            self.assertEqual(bricks(ben.newest_json()), [[1, 1, 1]])
            with Voice(third["expert"]) as here, Voice(third["expert"]) as there, \
                    Voice(fourth["expert"]) as speaker, Voice(fourth["expert"]) as listener:
                here.speak(b"in OR 3")
                self.assertEqual(there.hear(), (here.number, b"in OR 3"))
                speaker.speak(b"in OR 4")
                self.assertEqual(listener.hear(), (speaker.number, b"in OR 4"))

            # The host's operator sees both in the lobby, every other link its own session.
            names = lambda link: [s["name"] for s in json.loads(run("lobby", link, "--json")[1])["sessions"]]
            self.assertEqual([names(third["operator"]), names(third["expert"]), names(fourth["operator"])],
                             [["OR 3", "OR 4"], ["OR 3"], ["OR 4"]])
            printed = run("lobby", third["operator"])[1]
            for text in ("OR 3: 2 participant(s)", "OR 4: 2 participant(s)", "Carla (operator)", "lamp (live)"):
                self.assertIn(text, printed)
            picture = self.folder / "picture.png"
            self.assertEqual(run("lobby", third["operator"], "--session", "OR 4", "--picture", picture)[0], 0)
            self.assertEqual(read_png(picture)[:2], (160, 120))
            status = json.loads(run("status", third["operator"], "--json")[1])
            self.assertEqual((status["name"], [s["name"] for s in status["sessions"]]), ("OR 3", ["OR 4"]))

            # A decision in one session, and a line at the host for the other.
            carla.say("mute David")
            david.wait_for(lambda f: f["muted"])
            h.say("in OR 4: unmute David")
            david.wait_for(lambda f: not f["muted"])
            h.say("in OR 5: unmute David")
            wait_until(lambda: any("There is no session 'OR 5'" in line for line in h.errors))

            # One ends for good: its people leave, its links admit nobody, and the other goes on as before.
            anna.wait_for(lambda f: f["cameras"][0]["frames"] > 10)
            self.assertEqual(self.command("session", "end", "OR 4"), {"ended": "OR 4"})
            for person in (carla, david):
                self.assertEqual(person.end(), 0, person.errors)
            late = stack.enter_context(self.member(fourth["expert"], "Late"))
            self.assertEqual(late.end(), 1)
            self.assertIn("The access code of this link is wrong", "".join(late.errors))
            frames = anna.newest_json()["cameras"][0]["frames"]
            for person in (anna, ben):
                person.wait_for(lambda f: f["cameras"][0]["frames"] > frames + 30)
            self.assertEqual(bricks(ben.newest_json()), [[1, 1, 1]])
            self.assertEqual(self.command("session", "list"), [{"name": "OR 3", "state": "open", "problem": ""}])
            h.process.terminate()
            self.assertEqual(h.end(), 0)
        log = self.audited()
        joined = {e["name"] for e in log if e["event"] == "joined" and e.get("session") == "OR 4"}
        self.assertLessEqual({"Carla", "David"}, joined)
        self.assertFalse({"Anna", "Ben"} & joined)
        self.assertEqual([e["event"] for e in log if e.get("name") == "Anna" and "session" not in e],
                         ["joined", "left"])
        self.assertEqual([(e["event"], e.get("by")) for e in log if e.get("detail") == "OR 4"],
                         [("began", None), ("ended", "host"), ("deleted", "host")])
        self.assertEqual([(e["event"], e.get("by")) for e in log if e.get("detail") == "OR 3"],
                         [("began", None), ("ended", None)], "the host was stopped")

    def test_a_session_is_created_while_the_host_runs_and_kept_over_a_restart(self):
        with contextlib.ExitStack() as stack:
            h = stack.enter_context(self.start("--name", "OR 3", "--camera", self.table))
            anna = stack.enter_context(self.member(h.greeting["link"], "Anna"))
            anna.wait_for(lambda f: people(f) == ["Anna"])
            self.assertNotIn("sessions", h.greeting)

            # A session that cannot be opened is not created.
            errors = self.refusal("session", "create", "OR 5", "--camera", "folder:nowhere", "--state", self.state)
            self.assertIn("nowhere", errors)
            self.assertEqual([s["name"] for s in self.command("session", "list")], ["OR 3"])
            # Its name is free at once, and the audit log knows of no session that was deleted.
            self.assertIn("nowhere", self.refusal("session", "create", "OR 5", "--camera", "folder:nowhere", "--state", self.state))
            self.assertNotIn("OR 5", [e.get("detail") for e in self.audited()])
            self.assertIn("There is a session 'OR 3'",
                          self.refusal("session", "create", "OR 3", "--state", self.state))
            self.assertIn("'OR 3' has nearly the same name", self.refusal("session", "create", "or3", "--state", self.state))

            made = self.command("session", "create", "OR 4", "--camera", self.lamp)
            self.assertEqual((made["name"], made["state"]), ("OR 4", "open"))
            ben = stack.enter_context(self.member(made["links"]["expert"], "Ben"))
            ben.wait_for(lambda f: people(f) == ["Ben"] and cameras(f) == ["lamp"])
            ben.say("brick 1 2 3")
            ben.wait_for(lambda f: bricks(f) == [[1, 2, 3]])
            anna.say("brick 3 2 1")
            anna.wait_for(lambda f: bricks(f) == [[3, 2, 1]])

            # A link of this session for one person, which opens no other one.
            link = self.command("link", "--session", "OR 4", "--role", "observer", "--for", "Olga")
            olga = stack.enter_context(self.member(link["link"], "Olga"))
            self.assertEqual(olga.wait_for(lambda f: people(f) == ["Ben", "Olga"])["role"], "observer")
            self.assertNotIn(link["name"], [known["name"] for known in self.command("link", "--list")])
            self.command("link", "--session", "OR 4", "--revoke", link["name"])
            self.assertEqual(olga.end(), 1)
            self.assertIn("no longer valid", "".join(olga.errors))

            h.process.terminate()
            self.assertEqual(h.end(), 0)
        with contextlib.ExitStack() as stack:
            h = stack.enter_context(self.start("--name", "OR 3", "--camera", self.table))
            anna = stack.enter_context(self.member(h.greeting["link"], "Anna"))
            anna.wait_for(lambda f: bricks(f) == [[3, 2, 1]])
            wait_until(lambda: {"name": "OR 4", "state": "open", "problem": ""} in self.command("session", "list"))
            again = self.command("link", "--session", "OR 4", "--show", "expert")["link"]
            self.assertEqual(again.split("&cert")[0].split("#")[1], made["links"]["expert"].split("&cert")[0].split("#")[1])
            ben = stack.enter_context(self.member(again, "Ben"))
            seen = ben.wait_for(lambda f: people(f) == ["Ben"] and cameras(f) == ["lamp"])
            self.assertEqual(bricks(seen), [[1, 2, 3]])
            h.process.terminate()
            self.assertEqual(h.end(), 0)
        # Without a host: the session is listed, and ended by deleting its files.
        self.assertEqual(self.command("session", "list"), [{"name": "OR 4", "state": "closed", "problem": ""}])
        self.command("session", "end", "OR 4")
        self.assertEqual(self.command("session", "list"), [])
        self.assertFalse((self.state / "sessions" / "OR%204").exists())
        last = self.audited()[-1]
        self.assertEqual((last["event"], last["session"], last["by"]), ("deleted", "OR 4", "host"))

    def test_people_wait_for_a_session_whose_camera_is_not_there_when_the_host_begins(self):
        with self.start("--session", "OR 3") as h:
            address = h.greeting["link"].split("/")[2]
            made = self.command("session", "create", "OR 4", "--camera", self.lamp)
            link = made["links"]["expert"]
            ada = self.member(link, "Ada")
            self.addCleanup(ada.__exit__, None, None, None)
            ada.wait_for(lambda f: f["phase"] == "joined")
            h.process.kill()
        lamp, away = self.folder / "lamp", self.folder / "away"
        lamp.rename(away)
        # Another session of the folder cannot take its links and its room.
        self.assertIn("cannot be the first", self.refusal("host", "--state", self.state, "--listen", "127.0.0.1:0", "--session", "OR 4"))
        with host(self.state, listen=address, options=("--session", "OR 3")) as h:
            wait_until(lambda: "not open at the moment" in self.refusal("lobby", link))
            # The operator of the host sees it everywhere, with the reason.
            operator = h.greeting["links"]["operator"]
            closed = lambda: json.loads(run("status", operator, "--json")[1]).get("closed_sessions", [{}])[0]
            wait_until(lambda: "lamp" in closed().get("problem", ""))
            self.assertIn("\nOR 4: not open. ", run("status", operator)[1])
            self.assertRegex(run("lobby", operator)[1], r"\nOR 4: not open\. .*lamp")
            self.assertNotIn("OR 4", run("lobby", h.greeting["links"]["expert"])[1])
            ada.wait_for(lambda f: f["phase"] == "lost" and f["cameras"][0]["state"] == "lost")
            away.rename(lamp)
            ada.wait_for(lambda f: f["phase"] == "joined" and cameras(f) == ["lamp"])


if __name__ == "__main__":
    unittest.main()
