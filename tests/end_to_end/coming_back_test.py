# SPDX-License-Identifier: Apache-2.0
"""Somebody who comes back after a break is not new: recorders, publishers and viewers whose connections break, and who are refused then."""
import json
import os
import pathlib
import shutil
import signal
import tempfile
import unittest

from pulled_cable import PulledCable
from raw_peer import FakeHost, camera, media_message
from theatron_process import Process, host, make_recording, run, wait_until

COMPLETE, FAILED, INCOMPLETE = 0, 1, 3
BREAKS = 5
ALL_PLACES_TAKEN, REMOVED = 120, 113
PUBLISH = 1  # a feature
FULL = "All 128 places of this session are taken"
OUT = "An operator has removed you"


class ComingBack(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="theatron_e2e_"))
        self.addCleanup(shutil.rmtree, self.folder)
        self.camera = f"folder:{make_recording(self.folder / 'source', 160, 120, 6, color=False)},loop=1,preload=1"
        self.state = self.folder / "state"

    def said(self, process, text):
        return sum(text in line for line in list(process.errors))

    def begun(self, recorder, file):
        recorder.wait_until(lambda: file.exists() and file.stat().st_size > 3000)

    def size(self, file):
        """The bytes of all segments."""
        return sum(segment.stat().st_size for segment in self.folder.glob(f"{file.stem}*.mkv"))

    def verify(self, file):
        code, _, errors = run("inspect", file, "--json")
        self.assertEqual(code, 0, errors)
        code, out, errors = run("inspect", file, "--verify")
        return code, out + errors

    def test_a_recorder_whose_cable_breaks_again_and_again_loses_only_the_breaks(self):
        files = [self.folder / f"{n}.mkv" for n in range(4)]
        with host(self.state, self.camera) as h, PulledCable(h.greeting["link"]) as cable:
            code, out, errors = run("link", "--role", "expert", "--hours", "0.003", "--state", self.state)
            self.assertEqual(code, 0, errors)
            link = next(word for word in (out + errors).split() if word.startswith("https://"))
            recorders = [Process("record", cable.through(link), files[0], "--json")]
            recorders += [Process("record", h.greeting["link"], file, "--json") for file in files[1:]]
            for recorder, file in zip(recorders, files):
                self.begun(recorder, file)
            # Nobody else comes in by the link any more.
            wait_until(lambda: run("status", link)[0] != 0)
            broken = recorders[0]
            for count in range(1, BREAKS + 1):
                cable.pull()
                broken.wait_until(lambda: self.said(broken, "Connected again.") == count)
                before = self.size(files[0])
                broken.wait_until(lambda: self.size(files[0]) > before + 10_000)
            figures = []
            for recorder in recorders:
                recorder.send(signal.SIGINT)
                figures.append(recorder.read_json())
            codes = [recorder.end() for recorder in recorders]
            for recorder in recorders:
                recorder.__exit__()
        self.assertEqual(codes, [INCOMPLETE] + 3 * [COMPLETE], "".join(broken.errors))
        depth = figures[0]["cameras"][0]["depth"]
        self.assertGreaterEqual(depth["interruptions"], 1)
        self.assertEqual(figures[0]["missing_end_seconds"], 0)
        self.assertEqual(depth["dropped"], 0)
        # All that came is there; what did not come is counted, also between segments.
        listed = json.loads(run("inspect", files[0], "--json")[1])["cameras"][0]["depth"]
        self.assertEqual(listed["frames"], depth["pictures"])
        self.assertGreaterEqual(depth["lost"], listed["missing"])
        self.assertGreater(depth["lost"], 0)
        code, text = self.verify(files[0])
        self.assertEqual(code, INCOMPLETE, text)
        self.assertIn("it is not complete: pictures are missing", text)
        self.assertEqual(self.verify(files[1])[0], 0)

    # A host that lets everybody in once, then is full, then does not want them any more.
    @staticmethod
    def script(guests, publishes):
        def serve(guest):
            guests.append(guest)
            guest.stream.settimeout(30)
            guest.receive_control("Join")
            if len(guests) == 2:
                guest.send_control("Refused", in_english=FULL, reason={"code": ALL_PLACES_TAKEN, "arguments": ["128"]})
            elif len(guests) == 3:
                guest.send_control("Refused", in_english=OUT, reason={"code": REMOVED})
            else:
                guest.welcome(cameras=[camera(0, has_color=False)], features=[PUBLISH])
                guest.send_control("Settings", settings=[{"stream": 0, "setting": 1, "codec": "strata"}])
                _, ping = guest.receive_control("Ping")
                guest.send_control("Pong", ping_sent_us=ping["sent_us"], received_us=1, sent_us=1)
                guest.send_media(media_message(bytes(10_000), frame=1, captured_us=1))
                # A publisher waits for the answer to its offer.
                if publishes:
                    guest.receive_control("Publish")
                    guest.send_control("Published", cameras=[3])
        return serve

    def check_refusals(self, expected, *words):
        guests = []
        with FakeHost(self.script(guests, words[0] == "publish")) as fake, Process(*(fake.link if word is None else word for word in words)) as p:
            code = p.end()
            errors = "".join(p.errors)
            self.assertEqual(code, expected, errors)
            self.assertEqual(len(guests), 3)
            for text in (FULL, "Reconnecting.", OUT):
                self.assertIn(text, errors)

    def test_a_recorder_tries_on_while_the_session_is_full_and_ends_when_it_is_removed(self):
        file = self.folder / "a.mkv"
        self.check_refusals(INCOMPLETE, "record", None, file)
        code, text = self.verify(file)
        self.assertEqual(code, INCOMPLETE, text)
        self.assertIn("the host refused its recorder", text)

    def test_a_viewer_tries_on_while_the_session_is_full_and_ends_when_it_is_removed(self):
        self.check_refusals(FAILED, "join", None, "--no-window")

    def test_a_publisher_tries_on_while_the_session_is_full_and_ends_when_it_is_removed(self):
        self.check_refusals(FAILED, "publish", None, "--camera", self.camera)

    def test_windows_of_one_person_go_on_side_by_side_and_the_fifth_ends_the_oldest(self):
        environment = {**os.environ, "XDG_STATE_HOME": str(self.folder / "home")}
        with host(self.state, self.camera) as h:
            windows = []
            for _ in range(5):
                windows.append(Process("join", h.greeting["link"], "--no-window", "--json", "--every", "0.2", env=environment))
                self.addCleanup(windows[-1].__exit__)
                windows[-1].wait_for(lambda figures: figures["phase"] == "joined")
                if len(windows) < 5:
                    self.assertTrue(all(window.process.poll() is None for window in windows))
            self.assertEqual(windows[0].end(), FAILED)
            self.assertIn("the oldest view ends", "".join(windows[0].errors))
            for window in windows[1:]:
                self.assertIsNone(window.process.poll())


if __name__ == "__main__":
    unittest.main()
