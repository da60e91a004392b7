# SPDX-License-Identifier: Apache-2.0
"""A person's own face in a session: who sees it, when it is forgotten, and where it never is: docs/face.md."""
import json
import pathlib
import shutil
import signal
import tempfile
import unittest

import patience
import pictures
from expression_test import face_of
from theatron_process import Process, host, make_recording, read_png, run, stand

WIDTH, HEIGHT = 240, 180
PASSPHRASE = "a passphrase of the test"


class OwnFaceInASession(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="theatron_own_face_session_"))
        cls.passphrase = cls.folder / "passphrase"
        cls.passphrase.touch(0o600)
        cls.passphrase.write_text(PASSPHRASE + "\n")
        photos = cls.folder / "photos"
        cls.own, cls.network = cls.folder / "me.face", cls.folder / "face.net"
        enrol = ["face", "enrol", "--photo", photos / "neutral.jpg", "--landmarks", photos / "neutral.pts",
                 "--happiness", photos / "happiness.jpg", "--happiness-landmarks", photos / "happiness.pts",
                 "--out", cls.own, "--passphrase-file", cls.passphrase]
        cls.made = [run("face", "photos", photos, "--seed", "3"), run(*enrol),
                    run("face", "train", "--source", "arkit", "--out", cls.network)]
        box = make_recording(cls.folder / "box")
        stand(box)
        cls.camera = f"folder:{box},loop=1,preload=1"

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder)

    def setUp(self):
        for code, _, errors in self.made:
            self.assertEqual(code, 0, errors)
        self.state = pathlib.Path(tempfile.mkdtemp(dir=self.folder))
        self.host = self.enterContext(host(self.state, self.camera))

    def member(self, name, *options, role="expert"):
        return self.enterContext(Process("join", self.host.greeting["links"][role], "--name", name, "--every", "0.1", *options))

    def ada(self, *options):
        ada = self.member("Ada", "--face", "actor", "--face-model", self.network, *options)
        ada.say("stand 0 1.6 -0.8 0 1.6 0")
        return ada

    def with_own_face(self):
        return self.ada("--own-face", self.own, "--passphrase-file", self.passphrase)

    def seen(self, name, has_own):
        """The picture of somebody who stands where the camera is, before Ada, once her face has come."""
        file = self.folder / f"{name}.png"
        wait = patience.Wait(f"a picture of {name}")
        while True:
            with Process("join", self.host.greeting["link"], "--name", name, "--offscreen", file, "--size", f"{WIDTH}x{HEIGHT}",
                         "--quality", "low", "--view", "camera:0", "--seconds", "2", "--json") as seeing:
                self.assertEqual(seeing.end(), 0, seeing.last_words())
                seeing.output_thread.join(5)
            if (face_of(json.loads(seeing.last_line), "Ada") or {}).get("own") is has_own:
                return pictures.pixels_of(read_png(file))
            wait.check()

    def test_the_others_have_it_until_its_owner_says_or_leaves(self):
        bob = self.member("Bob")
        ada = self.with_own_face()
        bob.wait_for(lambda f: (face_of(f, "Ada") or {}).get("own"))
        self.assertEqual(ada.wait_for(lambda f: f["face"]["own"] == "there")["phase"], "joined")
        ada.wait_for_error("The host has your own face")
        late = self.member("Late")
        late.wait_for(lambda f: (face_of(f, "Ada") or {}).get("own"))
        ada.say("face off")
        bob.wait_for(lambda f: face_of(f, "Ada") is None)
        ada.wait_for(lambda f: (f["face"]["state"], f["face"]["own"]) == ("off", "off"))
        ada.say("face on")
        bob.wait_for(lambda f: (face_of(f, "Ada") or {}).get("own"))
        ada.send(signal.SIGTERM)
        self.assertEqual(ada.end(), 0)
        bob.wait_for(lambda f: face_of(f, "Ada") is None)
        # Somebody who shows no face of their own has the usual head again.
        plain = self.ada()
        bob.wait_for(lambda f: (face_of(f, "Ada") or {}).get("own") is False)
        self.assertNotIn("own", plain.wait_for(lambda f: f["face"]["state"] == "tracked")["face"])

    def test_no_crash_dump_has_it(self):
        ada = self.with_own_face()
        ada.wait_for(lambda f: f["face"]["own"] == "there")
        limit = [line for line in pathlib.Path(f"/proc/{ada.process.pid}/limits").read_text().splitlines() if "core file" in line]
        # One byte: no dump is written, and none is given to a program that keeps dumps (core(5)); 0 where the hard limit is 0.
        self.assertIn(limit[0].split()[4], ("0", "1"), limit)

    def test_it_is_drawn_in_place_of_the_usual_head(self):
        ada = self.ada()
        ada.wait_for(lambda f: f["face"]["state"] == "tracked")
        usual = self.seen("usual", False)
        ada.send(signal.SIGTERM)
        self.assertEqual(ada.end(), 0)
        ada = self.with_own_face()
        ada.wait_for(lambda f: f["face"]["own"] == "there")
        own = self.seen("own", True)
        # Eyes to mouth, and a corner of the picture that shows none of it.
        face = [row[108:132] for row in usual[84:110]], [row[108:132] for row in own[84:110]]
        corner = [row[:50] for row in usual[:50]], [row[:50] for row in own[:50]]
        self.assertLess(pictures.psnr(*face), 25)
        self.assertGreater(pictures.psnr(*corner), 40)
        # The skin of photos, which is lighter than the usual one.
        red, green, blue = pictures.means(face[1])
        self.assertGreater(red, blue + 10)
        self.assertGreater(green, blue)

    def test_it_is_in_no_recording_and_in_no_file_of_the_host(self):
        file = self.folder / "session.mkv"
        with Process("record", self.host.greeting["link"], file, "--json") as recording:
            ada = self.with_own_face()
            bob = self.member("Bob")
            bob.wait_for(lambda f: (face_of(f, "Ada") or {}).get("own"))
            ada.wait_for(lambda f: f["face"]["own"] == "there")
            bob.wait_for(lambda f: any(one["seconds"] > 1 for one in f["recordings"]))
            recording.send(signal.SIGTERM)
            self.assertEqual(recording.end(), 0, recording.last_words())
        files = [file] if file.is_file() else list(file.rglob("*"))
        files += [path for path in self.state.rglob("*") if path.is_file()]
        self.assertTrue(files)
        for path in files:
            self.assertNotIn(b"TFOWN", path.read_bytes(), path)
        for process in (self.host, ada, bob):
            said = process.last_line + "".join(process.errors)
            for secret in (PASSPHRASE, "TFOWN"):
                self.assertNotIn(secret, said)

    def test_mistakes_are_one_sentence(self):
        garbage = self.folder / "garbage"
        garbage.write_bytes(b"\x00\x01garbage" * 50)
        other = self.folder / "other"
        other.touch(0o600)
        other.write_text("another passphrase\n")
        face = ("--face", "actor", "--face-model", self.network)
        link = self.host.greeting["link"]
        for arguments, said in ((("--own-face", self.own), "needs --face"),
                                ((*face, "--passphrase-file", self.passphrase), "needs that"),
                                ((*face, "--own-face", garbage, "--passphrase-file", self.passphrase), "is no face of"),
                                ((*face, "--own-face", self.own, "--passphrase-file", other), "does not open"),
                                ((*face, "--own-face", self.folder / "none", "--passphrase-file", other), "none")):
            code, _, errors = run("join", link, "--no-window", *arguments)
            self.assertEqual(code, 1, arguments)
            self.assertRegex(errors, r"^theatron: [^\n]+\n$")
            self.assertIn(said, errors)


if __name__ == "__main__":
    unittest.main()
