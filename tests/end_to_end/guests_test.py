# SPDX-License-Identifier: Apache-2.0
"""Guests who do harm to each other, and hosts that do harm to viewers: docs/formats/connection.md with bad intentions."""
import contextlib
import json
import pathlib
import shutil
import struct
import tempfile
import threading
import time
import unittest

from raw_peer import (CONTROL, FakeHost, RawPeer, calibration, camera, control_message, media_message)
from theatron_process import Process, host, make_recording, run, wait_until

# An ordinary name in a hospital. The hundredth byte lies inside a character.
LONG_NAME = "OOOOOOUniversitätsklinikum Klinik für Herzchirurgie Operationssaal 3 Überwachungsplatz der Anästhesie" + "ü" * 20
MAX_NAME = 64
# Most memory that a host can make a viewer without pictures use, "Memory" in docs/formats/connection.md.
MAX_VIEWER_MB = 2048


def peak_memory_mb(process):
    with open(f"/proc/{process.process.pid}/status") as status:
        return next(int(line.split()[1]) / 1024 for line in status if line.startswith("VmHWM"))


def raw_depth(width, height):
    return struct.pack("<BBBBHH", 1, 1, 0, 0, width, height) + bytes(2 * width * height)


def raw_color(width, height):
    return struct.pack("<BBHH", 1, 0, width, height) + bytes(3 * width * height)


def read_on(peer):
    with contextlib.suppress(OSError):
        peer.wait_for_end()


class AnsweringHost(FakeHost):
    """A host that answers every request over HTTP with this text."""

    def __init__(self, body):
        self.body = body.encode()
        super().__init__(None)

    def _serve(self, stream):
        with contextlib.suppress(OSError), self.context.wrap_socket(stream, server_side=True) as encrypted:
            encrypted.recv(4096)
            encrypted.sendall(b"HTTP/1.1 200 OK\r\nContent-Type: application/json\r\nConnection: close\r\n"
                              b"Content-Length: %d\r\n\r\n" % len(self.body) + self.body)


class Guests(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="theatron_e2e_"))
        cls.camera = f"folder:{make_recording(cls.folder / 'box')},loop=1,preload=1"

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder)

    def names_in_status(self, h, count):
        """The participants' names, once there are `count`; the host must be alive afterwards."""
        def names():
            code, out, errors = run("status", h.greeting["link"], "--json")
            self.assertEqual(code, 0, errors)
            found = [p["name"] for p in json.loads(out)["participants"]]
            return found if len(found) == count else None

        found = wait_until(names, f"{count} participants")
        self.assertIsNone(h.process.poll(), "the host has ended")
        return found

    def test_whoever_asks_far_too_often_is_told_why_its_connection_ends(self):
        with host(self.folder / "state", self.camera) as h:
            with RawPeer(h.greeting["link"]) as peer:
                peer.join()
                request = bytes([CONTROL]) + control_message(peer.says, "ChooseCodecs", depth_codec="raw")
                # All at once: most are unread when the host ends the connection.
                peer.send_bytes(peer.frame(request) * 4000)
                self.assertIn("far more requests", peer.receive_control("Refused")[1]["in_english"])
                peer.wait_for_end()

    def test_a_name_of_any_bytes_does_no_harm(self):
        with host(self.folder / "state", self.camera) as h:
            with Process("join", h.greeting["link"], "--name", LONG_NAME, "--no-window", "--seconds", "60"):
                self.assertEqual(self.names_in_status(h, 1), [LONG_NAME[:MAX_NAME]])
            with RawPeer(h.greeting["link"]) as peer:
                peer.join(name=b"\xff\xfe\x1b]0;owned\x07\xc2\x9b2J\xe2\x80\xae")
                peer.receive_control("Welcome")
                self.assertEqual(self.names_in_status(h, 1), ["\ufffd\ufffd ]0 owned  2J"])

    def test_codec_changes_by_the_ten_thousand_hurt_nobody_else(self):
        with host(self.folder / "state", self.camera) as h, RawPeer(h.greeting["link"]) as peer:
            peer.join(depth_codec="rvl")
            peer.receive_control("Welcome")
            changes = b"".join(peer.frame(bytes([CONTROL]) + control_message("ToHost", "ChooseCodecs", depth_codec=codec))
                               for codec in ("lz4", "rvl"))
            with contextlib.suppress(OSError, EOFError):
                # 65,534 in all, each of which may take a number of 16 bits; then the usual codec.
                for pairs in [600] * 54 + [367]:
                    peer.send_bytes(changes * pairs)
                    answers = 0
                    while answers < 2 * pairs:
                        answers += peer.receive()[0] == CONTROL
                peer.send_control("ChooseCodecs", depth_codec="strata")
                peer.receive_control("Settings")
            for _ in range(2):
                code, out, errors = run("join", h.greeting["link"], "--seconds", "1.5", "--json")
                self.assertEqual(code, 0, errors)
                self.assertEqual(json.loads(out)["codec"].split()[0], "strata")
                self.assertGreater(json.loads(out)["fps"], 0)
            self.assertIsNone(h.process.poll())


class HostileHosts(unittest.TestCase):
    def join(self, script):
        """Runs a viewer against the script, after which the host is an honest one. Returns what the viewer said, and the
        most memory that it had."""
        done = threading.Event()

        def whole(guest):
            guest.receive_control("Join")
            script(guest)
            threading.Thread(target=read_on, args=(guest,), daemon=True).start()
            guest.welcome()
            guest.settings("raw", "raw", number=7)
            done.set()
            frame = 100
            while True:  # ends with the connection
                for stream, codec, payload in ((0, 1, raw_depth(640, 360)), (1, 65, raw_color(640, 360))):
                    guest.send_media(media_message(payload, codec=codec, stream=stream, setting=7, frame=frame))
                frame += 1
                time.sleep(0.1)

        with FakeHost(whole) as fake, Process("join", fake.link, "--no-window", "--every", "0.2") as viewer:
            viewer.wait_until(done.is_set)
            viewer.wait_for(lambda f: f["fps"] > 0 and len(f["cameras"]) == 1)
            peak = peak_memory_mb(viewer)
            viewer.say("quit")
            self.assertEqual(viewer.end(), 0, viewer.errors)
            self.assertEqual([f for f in fake.faults if not isinstance(f, (OSError, EOFError))], [])
            return "".join(viewer.errors), peak

    def test_media_without_a_setting_is_passed_over(self):
        def script(guest):
            guest.welcome()
            for stream in (0, 1):
                guest.send_media(media_message(raw_depth(640, 360), codec=1, stream=stream, setting=0))
            guest.settings(number=0)
            for stream in (0, 1):
                guest.send_media(media_message(raw_depth(640, 360), codec=1, stream=stream, setting=0))

        self.join(script)

    def test_states_of_cameras_that_nobody_announced_are_not_kept(self):
        def script(guest):
            guest.welcome()
            message = control_message("ToParticipant", "CameraState", camera=0x1234, state=1, problem={"code": 1, "arguments": ["x" * 50_000]})
            for number in range(1, 2000):
                guest.send(bytes([CONTROL]) + message.replace(b"\x34\x12", struct.pack("<H", number)))

        _, usual = self.join(lambda guest: None)
        _, peak = self.join(script)
        self.assertLess(peak, usual + 48)

    def test_cameras_of_impossible_sizes_are_left_out_with_a_sentence(self):
        huge = calibration(8192, 8192, 8192, 8192)

        def script(guest):
            guest.welcome([camera(0), camera(0, name="twin"), camera(1, name="huge", calibration_bytes=huge)])

        errors, _ = self.join(script)
        self.assertIn("camera huge has a calibration that is too large; it cannot be shown", errors)
        self.assertIn("camera twin has a number that another one has; it cannot be shown", errors)

    def test_a_status_of_any_depth_and_with_any_text_is_only_shown(self):
        with AnsweringHost('{"a":' * 400_000 + "1" + "}" * 400_000) as fake:
            code, _, errors = run("status", fake.link, "--json")
            self.assertEqual(code, 1, errors)
            self.assertIn("does not tell its status", errors)
        with AnsweringHost('{"name": "a\\u001b]0;owned\\u0007", "\\u009b2J": [1, {"x": "\\u202e"}]}') as fake:
            code, out, errors = run("status", fake.link, "--json")
            self.assertEqual(code, 0, errors)
            self.assertEqual(json.loads(out), {"name": "a ]0;owned ", " 2J": [1, {"x": ""}]})

    def test_a_viewer_takes_no_more_memory_than_is_stated(self):
        cameras, depth, color = 16, (1024, 1024), (2048, 2048)  # all that is accepted

        def script(guest):
            lens = calibration(*depth, *color)
            guest.welcome([camera(i, calibration_bytes=lens) for i in range(cameras)])
            for i in range(cameras):
                guest.settings("raw", "raw", camera=i)
            for frame in (1, 2):
                for i in range(cameras):
                    guest.send_media(media_message(raw_depth(*depth), codec=1, stream=2 * i, frame=frame))
                    guest.send_media(media_message(raw_color(*color), codec=65, stream=2 * i + 1, frame=frame))
            # More than any picture needs.
            guest.send_media(media_message(bytes(60 << 20), codec=65, stream=1, frame=3))

        _, peak = self.join(script)
        self.assertGreater(peak, 200, "the pictures did not come")
        self.assertLess(peak, MAX_VIEWER_MB)
        print(f"{peak:.0f} MB", end=" ", flush=True)


if __name__ == "__main__":
    unittest.main()
