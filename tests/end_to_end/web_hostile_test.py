# SPDX-License-Identifier: Apache-2.0
"""A page whose host turns hostile: whatever it says, the page goes on, keeps its memory, and is there for the next host."""
import contextlib
import itertools
import pathlib
import struct
import tempfile
import threading
import time
import unittest

import theatron_process
from browser import CHROMIUM, Browser
from guests_test import raw_color, raw_depth, read_on
from raw_peer import BINARY, CONTROL, TEXT, VOICE, FakeHost, Link, calibration, camera, control_message, media_message
from theatron_process import host

PAGE = pathlib.Path(theatron_process.PROGRAM).parent / "web/files.txt"
SIZE = (320, 180)
MOST_SPEAKERS = 32

# Counts the speakers on the audio thread, whose memory the browser gives back late.
COUNT_SPEAKERS = """globalThis.made_speakers = 0;
globalThis.AudioWorkletNode = class extends AudioWorkletNode {
    constructor(context, name, options) {
        super(context, name, options);
        made_speakers += name === "speaker";
    }
};"""


def honest(guest):
    """A camera of 64x48, a picture of it now and then."""
    guest.welcome([camera(0, calibration_bytes=calibration(64, 48, 64, 48))])
    guest.settings("raw", "raw", number=7)


def send_picture(guest, frame):
    for stream, codec, payload in ((0, 1, raw_depth(64, 48)), (1, 65, raw_color(64, 48))):
        guest.send_media(media_message(payload, codec=codec, stream=stream, setting=7, frame=frame))


@unittest.skipUnless(CHROMIUM, "chromium is not installed: apt-get install chromium")
@unittest.skipUnless(PAGE.exists(), "there is no browser client: make build")
class HostileHost(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.stack = contextlib.ExitStack()
        folder = pathlib.Path(cls.stack.enter_context(tempfile.TemporaryDirectory()))
        try:
            cls.page = cls.stack.enter_context(Browser()).open("about:blank", SIZE)
            cls.page.call("Network.disable")  # the protocol would bring each frame here
            cls.page.call("Page.addScriptToEvaluateOnNewDocument", source=COUNT_SPEAKERS)
            # The page and its program come from a real host, whose place the hostile one then takes.
            with host(folder / "host") as real:
                link = real.greeting["link"]
                cls.page.call("Page.navigate", url=link)
                cls.page.enter(way="room")
                cls.page.wait_for("theatron.state.phase === 'joined' && theatron.voice?.program && true")
                # The hostile one answers no request for the lobby, and the browser writes each of them to the console.
                cls.page.evaluate("theatron.lobby.watch = () => {}")
                cls.page.evaluate("document.getElementById('leave').click()")
                cls.page.wait_for("theatron.state.phase === 'left'")
            cls.fake = FakeHost(lambda guest: None, state=folder / "host", port=Link.parse(link).port)
        except BaseException:
            cls.stack.close()
            raise

    @classmethod
    def tearDownClass(cls):
        cls.stack.close()

    def enter(self, script):
        """The page joins a host of this script, and once more an honest one if the script's connection ends."""
        self.scripts = [script]

        def next_script(guest):
            guest.receive_control("Join")
            if self.scripts:
                self.scripts.pop()(guest)
            honest(guest)
            threading.Thread(target=read_on, args=(guest,), daemon=True).start()
            for frame in itertools.count(100):  # ends with the connection
                send_picture(guest, frame)
                time.sleep(0.1)

        self.fake.script = next_script
        self.page.problems.clear()
        self.page.evaluate("document.getElementById('enter').click()")

    def tearDown(self):
        self.page.evaluate("document.getElementById('leave').click()")
        self.page.wait_for("theatron.state.phase === 'left'")

    def picture(self):
        """The page shows the honest host's camera."""
        self.page.wait_for("theatron.state.phase === 'joined' && theatron.state.cameras.length === 1"
                           " && theatron.state.cameras[0].color_frames > 1 && theatron.state.has_picture")

    def test_a_message_of_any_size_takes_no_memory_and_ends_the_connection_with_a_sentence(self):
        before, size = self.page.evaluate("theatron.memory()"), 100 << 20
        for frame, content in ((BINARY, bytes([CONTROL]) * size), (TEXT, b"x" * size)):
            with self.subTest(frame=frame):
                def script(guest):
                    guest.welcome()
                    guest.send(content, frame)
                    guest.wait_for_end()
                    raise EOFError("the page went")

                self.enter(script)
                self.page.wait_for("/too large|sent text/.test(theatron.state.problem)")
                self.picture()
                self.assertLess(self.page.evaluate("theatron.memory()") - before, 64 << 20)
                self.assertEqual(self.page.problems, [])

    def test_a_page_of_another_version_than_its_host_says_that_it_is_to_be_reloaded(self):
        newer, older = ({"in_english": "English", "reason": {"code": code, "arguments": numbers}}
                        for code, numbers in ((101, ["3", "4"]), (100, ["2", "3"])))

        def refuse(fields):
            return lambda guest: (guest.send_control("Refused", **fields), guest.wait_for_end())

        def welcome_then_refuse(guest):
            """As where the host is updated while somebody is in."""
            guest.welcome()
            self.scripts.append(refuse(newer))
            raise EOFError("the host is updated")

        for script, protocol in ((refuse(newer), 4), (refuse(older), 2), (lambda guest: guest.welcome(protocol=4), 4),
                                 (welcome_then_refuse, 4)):
            with self.subTest(protocol=protocol):
                self.page.evaluate("document.getElementById('problem').textContent = ''")
                self.enter(script)
                self.page.wait_for(f"theatron.state.phase === 'left' && document.getElementById('problem').textContent === 'This page is "
                                   f"from before its host was changed (it speaks protocol 3, the host {protocol}); reload the page.'")

    def test_entering_again_while_a_picture_is_drawn_shows_the_next_visits_pictures(self):
        for _ in range(12):
            self.enter(lambda guest: None)
            self.picture()

    def test_voices_of_any_number_make_few_speakers_and_no_fault(self):
        def script(guest):
            honest(guest)
            packet = bytes([1, 0, 20, 30]) + struct.pack("<Iq", 0, 0)
            for number in range(20_000):
                opus = (b"\xff" + bytes([number & 255]) * (number % 90), b"\xf8\xff\xfe")[number % 2]
                guest.send(bytes([VOICE]) + struct.pack("<I", number % 1000) + packet[:4] + struct.pack("<Iq", number, 0) + opus)

        self.enter(script)
        self.picture()
        self.assertLessEqual(self.page.evaluate("theatron.voice.speakers.size"), MOST_SPEAKERS)
        self.assertLessEqual(self.page.evaluate("made_speakers"), MOST_SPEAKERS)
        self.assertEqual(self.page.problems, [])

    def test_masses_of_cameras_and_pictures_of_absurd_sizes_are_passed_over(self):
        before = self.page.evaluate("theatron.memory()")
        small = calibration(64, 48, 64, 48)
        # A baseline JPEG that claims 65535 x 65535 pixels.
        absurd = bytes.fromhex("ffd8ffc0001108ffffffff03012200021101031101ffda000c03010002110311003f00") + bytes(2000) + b"\xff\xd9"

        def script(guest):
            honest(guest)
            masses = [control_message("ToParticipant", "CamerasAdded", cameras=[camera(i, "x" * 200, small) for i in range(1, 60)]),
                      control_message("ToParticipant", "CamerasRemoved", cameras=list(range(1, 60))),
                      control_message("ToParticipant", "CamerasAdded", cameras=[camera(1, "x" * 60_000, small)]),
                      control_message("ToParticipant", "CamerasRemoved", cameras=[1])]
            guest.send_bytes(b"".join(guest.frame(bytes([CONTROL]) + message) for message in masses) * 100)
            guest.settings("raw", "jpeg:quality=85", number=6)
            for frame in range(1, 100):
                guest.send_media(media_message(absurd, codec=66, stream=1, setting=6, frame=frame))
                guest.send_media(media_message(raw_depth(8, 8).replace(bytes([8, 0]), b"\xff\xff"), codec=1, stream=0, setting=6, frame=frame))

        self.enter(script)
        self.picture()
        self.assertLess(self.page.evaluate("theatron.memory()") - before, 64 << 20)
        self.assertEqual(self.page.problems, [])


if __name__ == "__main__":
    unittest.main()
