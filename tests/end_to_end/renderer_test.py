# SPDX-License-Identifier: Apache-2.0
"""How participants draw, set by the host while they watch."""
import pathlib
import shutil
import signal
import tempfile
import unittest

from theatron_process import Process, host, make_recording, read_png, run
from virtual_screen import VirtualScreen, wait_until

WIDTH, HEIGHT = 480, 360


class Renderer(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="theatron_renderer_"))
        recording = make_recording(cls.folder / "box", frames=1)
        cls.camera = f"folder:{recording},loop=1,preload=1"

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder)

    def host(self):
        return host(self.folder / "state", self.camera)

    def test_the_hosts_last_word_holds_until_the_viewers_key(self):
        with VirtualScreen(WIDTH, HEIGHT) as screen, self.host() as h, \
                Process("join", h.greeting["link"], "--name", "Dr. A", "--size", f"{WIDTH}x{HEIGHT}", "--renderer",
                        "splat", env=screen.environment) as viewer:
            def drawn(name):
                wait_until(lambda: f" {name} " in screen.title())

            drawn("splat")
            h.say("renderer mesh")
            drawn("mesh")
            screen.do("key", "Tab")
            drawn("blend")
            with self.subTest("a participant is meant by name, and cannot choose while it is locked"):
                h.say("renderer Dr. A disc lock")
                drawn("disc")
                screen.do("key", "Tab")
                with self.assertRaises(AssertionError):
                    wait_until(lambda: " disc " not in screen.title(), timeout=2)
            with self.subTest("what cannot be is told in one sentence and changes nothing"):
                for line, says in (("renderer", "Say 'renderer"), ("renderer all fog", "Say 'renderer"),
                                   ("renderer free lock", "Say 'renderer"), ("renderer 77 mesh", "no participant '77'"),
                                   ("paint", "no command 'paint'")):
                    before = len(h.errors)
                    h.say(line)
                    wait_until(lambda: any(says in e for e in h.errors[before:]))
                drawn("disc")
            with self.subTest("the choice is given back"):
                h.say("renderer all free")
                wait_until(lambda: screen.do("key", "Tab") == "" and " disc " not in screen.title(), every=0.5)
            with self.subTest("auto is mesh for one camera"):
                h.say("renderer all auto lock")
                drawn("mesh")
            viewer.send(signal.SIGTERM)
            self.assertEqual(viewer.end(), 0)
            self.assertNotIn("reported", "".join(viewer.errors))  # errors of the driver
            self.assertIn("participant draws", "".join(h.errors))  # in the host's log
            self.assertIn("renderer=disc", "".join(h.errors).replace('"', ""))

    def test_who_joins_later_and_writes_pictures_is_told_too(self):
        def picture(link, name, *options):
            path = self.folder / f"{name}.png"
            code, _, errors = run("join", link, "--offscreen", path, "--size", "160x120", "--view",
                                  "camera:0,yaw=30", "--seconds", 0.5, *options)
            self.assertEqual(code, 0, errors)
            return read_png(path)[3]

        with self.host() as h:
            link = h.greeting["link"]
            own = {name: picture(link, name, "--renderer", name) for name in ("splat", "disc")}
            self.assertTrue(own["splat"] != own["disc"])
            h.say("renderer disc")
            self.assertTrue(picture(link, "told", "--renderer", "splat") == own["disc"])


if __name__ == "__main__":
    unittest.main()
