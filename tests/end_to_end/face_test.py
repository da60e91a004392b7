# SPDX-License-Identifier: Apache-2.0
"""The face under the headset: training, a tracker's packets, own takes."""
import json
import pathlib
import shutil
import signal
import socket
import struct
import tempfile
import unittest

from theatron_process import Process, run


def free_port():
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as one:
        one.bind(("127.0.0.1", 0))
        return one.getsockname()[1]


def osc(address, value):
    def padded(text):
        return text.encode() + b"\0" * (4 - len(text) % 4)
    return padded(address) + padded(",f") + struct.pack(">f", value)


class Face(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="theatron_face_"))
        cls.network = cls.folder / "face.net"
        cls.trained = run("face", "train", "--source", "arkit", "--out", cls.network, "--json")

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder)

    def refused(self, *arguments):
        code, output, errors = run("face", *arguments)
        self.assertEqual(code, 1, output)
        self.assertRegex(errors, r"^theatron: [^\n]+\n$")
        return errors

    def test_training_says_what_its_figures_are_and_keeps_the_file_private(self):
        code, output, errors = self.trained
        self.assertEqual(code, 0, errors)
        figures = json.loads(output)
        self.assertTrue(figures["synthetic_only"])
        self.assertEqual(len(figures["emotions"]), 6)
        # With this seed, so it says whether training works, and nothing of real faces.
        self.assertGreater(figures["synthetic"]["accuracy"], 0.9)
        self.assertGreater(figures["synthetic_missing_20"]["accuracy"], 0.8)
        self.assertEqual(self.network.stat().st_mode & 0o777, 0o600)
        before = self.network.read_bytes()
        self.assertIn("exists already", self.refused("train", "--out", self.network))
        self.assertEqual(self.network.read_bytes(), before)

    def test_an_emotion_of_a_tracker_is_told_until_the_tracker_is_lost(self):
        port = free_port()
        with Process("face", "listen", "--port", port, "--model", self.network, "--json") as listening:
            listening.wait_for(lambda f: f["tracking"] == "waiting")
            with Process("face", "act", "--port", port, "--source", "arkit") as acting:
                told = listening.wait_for(lambda f: f["emotion"] == "happiness")
                self.assertEqual((told["tracking"], told["calibrated"], told["synthetic_only"]), ("tracked", True, True))
                self.assertEqual(told["channels"], 52)
                acting.send(signal.SIGTERM)
                self.assertEqual(acting.end(), 0)
            lost = listening.wait_for(lambda f: f["tracking"] == "lost")
            self.assertEqual(lost["emotion"], "neutral")
            listening.send(signal.SIGTERM)
            self.assertEqual(listening.end(), 0)

    def test_foreign_and_damaged_packets_are_counted_and_never_printed(self):
        port = free_port()
        with Process("face", "listen", "--port", port, "--json") as listening, \
                socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as sender:
            listening.wait_for(lambda f: f["tracking"] == "waiting")
            damaged = [b"\xff" * 40, b"#bundle\0" + b"\xff" * 30, osc("/avatar/secretPlace", 0.5)[:-3]]

            def send():
                for packet in (*damaged, osc("/avatar/parameters/secretPlace", 0.25), osc("/x/y/v2/JawOpen", 0.4321)):
                    sender.sendto(packet, ("127.0.0.1", port))
            send()
            counted = listening.wait_for(lambda f: f["packets"] >= 5)
            self.assertEqual((counted["refused"], counted["unknown"], counted["used"]), (3, 1, 1))
            listening.send(signal.SIGTERM)
            self.assertEqual(listening.end(), 0)
            said = json.dumps(counted) + listening.last_line + "".join(listening.errors)
            for text in ("secretPlace", "JawOpen", "4321"):
                self.assertNotIn(text, said)

    def test_own_takes_are_recorded_and_learned(self):
        port, takes = free_port(), self.folder / "me.csv"
        with Process("face", "act", "--port", port, "--source", "arkit") as acting:
            with Process("face", "record", "--port", port, "--source", "arkit", "--out", takes, "--rounds", "2",
                         "--take", "1.2") as recording:
                self.assertEqual(recording.end(), 0, "".join(recording.errors))
            acting.send(signal.SIGTERM)
            self.assertEqual(acting.end(), 0)
        self.assertEqual(takes.stat().st_mode & 0o777, 0o600)
        code, output, errors = run("face", "train", "--source", "arkit", "--own", takes, "--out", self.folder / "me.net", "--json")
        self.assertEqual(code, 0, errors)
        self.assertFalse(json.loads(output)["synthetic_only"])
        code, output, errors = run("face", "test", self.folder / "me.net", takes, "--json")
        self.assertEqual(code, 0, errors)
        self.assertIn("accuracy", output)
        self.assertIn("give --source arkit", self.refused("train", "--source", "xr_fb", "--own", takes, "--out", self.folder / "n"))

    def test_a_take_whose_tracker_falls_silent_is_made_again(self):
        port, takes = free_port(), self.folder / "again.csv"
        act = ("face", "act", "--port", port, "--source", "arkit")
        with Process("face", "record", "--port", port, "--source", "arkit", "--out", takes, "--rounds", "1", "--take", "1.2") as recording:
            with Process(*act):
                recording.wait_until(lambda: "show" in recording.last_line)
            recording.wait_until(lambda: "made again" in recording.last_line)
            with Process(*act):
                self.assertEqual(recording.end(), 0, recording.last_words())
        self.assertIn("6 takes", recording.last_line)

    def test_mistakes_are_one_sentence(self):
        garbage = self.folder / "garbage"
        garbage.write_bytes(b"\x00\x01garbage" * 50)
        self.assertIn("no network", self.refused("listen", "--model", garbage))
        self.assertIn("no recording of a face", self.refused("test", self.network, garbage))
        self.assertIn("There is no tracker 'kinect'", self.refused("act", "--source", "kinect"))
        port = free_port()
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as taken:
            taken.bind(("127.0.0.1", port))
            self.assertIn(str(port), self.refused("listen", "--port", str(port)))


if __name__ == "__main__":
    unittest.main()
