# SPDX-License-Identifier: Apache-2.0
"""Messages and raised hands between programs without a window, on the screen of an operating room, and in no file."""
import pathlib
import shutil
import signal
import tempfile
import unittest

from theatron_process import Process, host, make_recording

SECRET = "Bitte die Leuchte zur Schwester-xyzzy"


class Chat(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="theatron_chat_"))
        self.addCleanup(shutil.rmtree, self.folder)
        self.camera = f"folder:{make_recording(self.folder / 'box', frames=1)},loop=1,preload=1"

    def test_what_is_written_is_read_by_all_and_kept_in_no_file(self):
        with host(self.folder / "state", self.camera) as h, \
                Process("record", h.greeting["link"], self.folder / "kept.mkv", "--seconds", "600") as recorder, \
                Process("join", h.greeting["links"]["operator"], "--name", "Ada", "--every", "0.1") as ada, \
                Process("join", h.greeting["links"]["observer"], "--name", "Ben", "--every", "0.1") as ben, \
                Process("join", h.greeting["link"], "--or-screen", "--offscreen", self.folder / "or.png", "--size", "640x360",
                        "--seconds", "600", "--every", "0.1") as screen:
            ada.wait_for(lambda f: f["chat"]["may_write"] and f["recordings"])
            ben.wait_for(lambda f: f["chat"]["may_write"])
            screen.wait_for(lambda f: f["or_screen"] and len(f["or_screen"]["people"]) >= 2)
            ada.say(f"chat {SECRET}")
            read = ben.wait_for(lambda f: f["chat"]["messages"])["chat"]["messages"]
            self.assertEqual([(m["name"], m["text"]) for m in read], [("Ada", SECRET)])
            shown = screen.wait_for(lambda f: f["or_screen"]["written"])["or_screen"]
            self.assertEqual(shown["written"], [f"Ada: {SECRET}"])
            with self.subTest("an observer raises a hand, and the operator takes it down"):
                ben.say("hand up")
                hands = lambda f: [p["name"] for p in f["room"]["people"] if p["hand_raised"]]
                ada.wait_for(lambda f: hands(f) == ["Ben"])
                screen.wait_for(lambda f: [p["state"] for p in f["or_screen"]["people"] if p["name"] == "Ben"] == ["hand raised"])
                ada.say("lower Ben")
                ben.wait_for(lambda f: hands(f) == [])
            with self.subTest("who is muted is told that nothing is sent"):
                ada.say("mute Ben")
                ben.wait_for(lambda f: f["muted"])
                ben.say("chat hello")
                ben.wait_for_error("You are muted; the message is not sent.")
            # A service keeps what its programs print.
            for program in (h, ben, screen, recorder):
                self.assertEqual([line for line in program.errors if "xyzzy" in line], [])
            recorder.send(signal.SIGTERM)
            self.assertEqual(recorder.end(), 0)
        for file in self.folder.rglob("*"):
            if file.is_file():
                self.assertNotIn(SECRET.encode(), file.read_bytes(), file)


if __name__ == "__main__":
    unittest.main()
