# SPDX-License-Identifier: Apache-2.0
"""Messages that are written in a window: the keyboard belongs to them until Esc."""
import os
import pathlib
import shutil
import tempfile
import unittest

from theatron_process import Process, host, make_recording, wait_until
from virtual_screen import VirtualScreen, brightness

WIDTH, HEIGHT = 1280, 720
PICTURES = os.environ.get("THEATRON_PICTURES")  # a folder where pictures of the window stay


class WindowChat(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="theatron_window_chat_"))
        self.addCleanup(shutil.rmtree, self.folder)
        self.screen = VirtualScreen(WIDTH, HEIGHT)
        self.addCleanup(self.screen.__exit__)

    def test_letters_are_a_message_and_no_commands_until_esc(self):
        camera = f"folder:{make_recording(self.folder / 'box', frames=1)},loop=1,preload=1,place=0:1.5:0"
        environment = {**self.screen.environment, "XDG_STATE_HOME": str(self.folder / "home"), "SDL_AUDIODRIVER": "dummy"}
        bricks = lambda f: [o for o in f["room"]["objects"] if o["kind"] == "brick"]
        hands = lambda f: [p["name"] for p in f["room"]["people"] if p["hand_raised"]]
        with host(self.folder / "state", camera) as h, \
                Process("join", h.greeting["link"], "--name", "Ada", "--every", "0.2") as ada, \
                Process("join", h.greeting["link"], "--name", "Wim", "--size", f"{WIDTH}x{HEIGHT}", "--renderer", "splat",
                        env=environment):
            ada.wait_for(lambda f: any(p["name"] == "Wim" for p in f["room"]["people"]))
            wait_until(lambda: brightness(self.screen.pixels(500, 200, 200, 100)) > 20)
            # N makes a brick where the keyboard is not a message's, also when it comes at once.
            self.screen.do("key", "F3", "type", "--delay", "5", "Nun nach links")
            self.screen.do("key", "BackSpace", "key", "s", "key", "Return")
            read = ada.wait_for(lambda f: f["chat"]["messages"])
            self.assertEqual([(m["name"], m["text"]) for m in read["chat"]["messages"]], [("Wim", "Nun nach links")])
            self.assertEqual(bricks(read), [])
            ada.say("chat Danke")
            ada.wait_for(lambda f: len(f["chat"]["messages"]) == 2)
            if PICTURES:
                self.screen.save(pathlib.Path(PICTURES) / "window_chat.png", WIDTH, HEIGHT)
            self.screen.do("key", "Escape", "key", "n")
            ada.wait_for(bricks)
            with self.subTest("a hand"):
                self.screen.do("key", "F12")
                ada.wait_for(lambda f: hands(f) == ["Wim"])
                self.screen.do("key", "F12")
                ada.wait_for(lambda f: hands(f) == [])


if __name__ == "__main__":
    unittest.main()
