# SPDX-License-Identifier: Apache-2.0
"""What a person's face shows goes from the tracker to the others, and only with consent and right: docs/face.md."""
import math
import os
import pathlib
import shutil
import signal
import struct
import tempfile
import time
import unittest
import wave

from face_test import free_port
from raw_peer import STATES, RawPeer
from theatron_process import Process, host, make_recording, run

POSE, EXPRESSION = 1, 3  # wire::StateTopic


def face_of(figures, name):
    for person in figures["room"]["people"]:
        if person["name"] == name:
            return person.get("face")
    return None


class Person(RawPeer):
    def __init__(self, link):
        super().__init__(link)
        self.join(depth_codec="raw", color_codec="raw", person=list(os.urandom(16)))
        self.number = self.receive_control("Welcome")[1]["participant"]

    def send_states(self, *states):
        self.send(bytes([STATES]) + b"".join(
            struct.pack("<BIH", topic, self.number, len(body)) + body for topic, body in states))

    def send_face_and_pose(self):
        """A smile, and after it a pose."""
        now = time.monotonic_ns() // 1000  # the host's clock is this machine's
        smile = struct.pack("<qBB6B3B", now, 1, 3, 0, 0, 255, 0, 0, 0, 9, 0, 0)
        self.send_states((EXPRESSION, smile), (POSE, struct.pack("<qB3f4h", now, 1, 4, 1.5, 0, 32767, 0, 0, 0)))
        return smile

    def receive_expression(self):
        """State and open jaw (0 to 255) of the next expression of anybody."""
        while True:
            envelope = self.receive()
            at = 1
            while envelope[0] == STATES and at < len(envelope):
                topic, _, size = struct.unpack_from("<BIH", envelope, at)
                if topic == EXPRESSION and size > 16:
                    return envelope[at + 7 + 8], envelope[at + 7 + 16]
                at += 7 + size

    def receive_until_pose(self, number):
        """The expressions that came until the pose of this participant did."""
        expressions = []
        while True:
            envelope = self.receive()
            at = 1
            has_pose = False
            while envelope[0] == STATES and at < len(envelope):
                topic, owner, size = struct.unpack_from("<BIH", envelope, at)
                if topic == EXPRESSION and owner == number:
                    expressions.append(envelope[at + 7:at + 7 + size])
                has_pose = has_pose or (topic == POSE and owner == number)
                at += 7 + size
            if has_pose:
                return expressions


class Expressions(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="theatron_expression_"))
        cls.network = cls.folder / "face.net"
        cls.trained = run("face", "train", "--source", "arkit", "--out", cls.network)
        cls.camera = f"folder:{make_recording(cls.folder / 'box')},loop=1,preload=1"

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder)

    def setUp(self):
        self.assertEqual(self.trained[0], 0, self.trained[2])
        self.host = self.enterContext(host(pathlib.Path(tempfile.mkdtemp(dir=self.folder)), self.camera))

    def member(self, name, *options, role="expert"):
        return self.enterContext(Process("join", self.host.greeting["links"][role], "--name", name, "--every", "0.1", *options))

    def test_the_others_see_the_six_emotions_of_the_actor_in_turn(self):
        ada = self.member("Ada", "--face", "actor", "--face-model", self.network)
        bob = self.member("Bob")
        for emotion in ("happiness", "surprise", "sadness", "disgust", "anger", "neutral"):
            bob.wait_for(lambda f, wanted=emotion: (face_of(f, "Ada") or {}).get("emotion") == wanted)
        seen = bob.wait_for(lambda f: face_of(f, "Ada"))
        self.assertEqual((face_of(seen, "Ada")["state"], face_of(seen, "Ada")["channels"]), ("tracked", False))
        self.assertIsNone(face_of(seen, "Bob"), "nobody sends a face who did not ask for it")
        ada.say("face off")
        bob.wait_for(lambda f: face_of(f, "Ada") is None)
        self.assertEqual(ada.wait_for(lambda f: f["face"]["state"] == "off")["face"]["emotion"], "")
        ada.say("face on")
        bob.wait_for(lambda f: face_of(f, "Ada"))

    def test_a_tracker_that_falls_silent_leaves_a_face_at_rest(self):
        port = free_port()
        ada = self.member("Ada", "--face", str(port), "--face-model", self.network, "--face-channels")
        bob = self.member("Bob")
        waiting = ada.wait_for(lambda f: f["face"]["state"] == "waiting" and f["phase"] == "joined")
        self.assertIsNone(face_of(waiting, "Ada"))
        with Process("face", "act", "--port", port, "--source", "arkit") as tracker:
            bob.wait_for(lambda f: (face_of(f, "Ada") or {}).get("emotion") == "happiness")
            tracker.send(signal.SIGTERM)
            self.assertEqual(tracker.end(), 0)
        ada.wait_for_error("silent")
        lost = bob.wait_for(lambda f: (face_of(f, "Ada") or {}).get("state") == "lost")
        self.assertEqual(face_of(lost, "Ada"), {"state": "lost", "mouth_guessed": False, "emotion": "neutral", "channels": True, "own": False})

    def test_without_a_tracker_the_voice_moves_the_mouth_and_the_others_are_told(self):
        with wave.open(str(self.folder / "said.wav"), "wb") as file:
            file.setparams((1, 2, 48000, 0, "NONE", ""))
            # A second of a tone and a second of silence, in turn.
            tone = b"".join(struct.pack("<h", int(12000 * math.sin(i * 0.05))) for i in range(48000))
            file.writeframes((tone + bytes(96000)) * 60)
        links = self.host.greeting["links"]
        watching = self.enterContext(Person(links["expert"]))
        ada = self.member("Ada", "--face", "voice", "--microphone", self.folder / "said.wav")
        bob = self.member("Bob")
        seen = bob.wait_for(lambda f: (face_of(f, "Ada") or {}).get("mouth_guessed"))
        self.assertEqual((face_of(seen, "Ada")["state"], face_of(seen, "Ada")["emotion"]), ("tracked", "neutral"))
        ada.wait_for(lambda f: f["face"]["mouth"] == "guessed")
        jaws = []
        while not (jaws and max(jaws) > 60 and jaws[-1] < 10):  # it has opened, and closed again
            state, jaw = watching.receive_expression()
            self.assertEqual(state, 3)
            jaws.append(jaw)
        ada.say("microphone off")
        ada.wait_for(lambda f: f["face"]["mouth"] == "unseen")
        bob.wait_for(lambda f: face_of(f, "Ada") and not face_of(f, "Ada")["mouth_guessed"])

    def test_an_observer_shows_no_face(self):
        links = self.host.greeting["links"]
        watching, shown, hidden = (self.enterContext(Person(links[role])) for role in ("expert", "expert", "observer"))
        smile = shown.send_face_and_pose()
        self.assertEqual(watching.receive_until_pose(shown.number), [smile])
        hidden.send_face_and_pose()
        self.assertEqual(watching.receive_until_pose(hidden.number), [])

    def test_mistakes_are_one_sentence(self):
        link = self.host.greeting["link"]
        for arguments, said in ((("--face", "mirror"), "neither actor nor voice"), (("--face-model", self.network), "needs --face"),
                                (("--face", "actor", "--face-model", self.folder / "none"), "none"),
                                (("--face", "actor", "--or-screen", "--offscreen", self.folder / "screen.png"), "without --or-screen")):
            code, _, errors = run("join", link, "--no-window", *arguments)
            self.assertEqual(code, 1)
            self.assertRegex(errors, r"^theatron: [^\n]+\n$")
            self.assertIn(said, errors)


if __name__ == "__main__":
    unittest.main()
