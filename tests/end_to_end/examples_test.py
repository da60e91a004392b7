# SPDX-License-Identifier: Apache-2.0
"""The programs in examples/: one hosts a camera, one sends another into a session, one joins and saves a picture."""
import os
import pathlib
import re
import signal
import subprocess
import tempfile
import unittest

import patience
from theatron_process import PROGRAM, Process, host, make_recording, read_png

SOURCES = pathlib.Path(__file__).resolve().parent.parent.parent / "examples"
EXAMPLES = pathlib.Path(PROGRAM).parent.parent.parent / "examples"


def save_a_picture(test, programs):
    """publish_camera and save_picture of the folder `programs` meet."""
    with tempfile.TemporaryDirectory() as folder:
        camera = pathlib.Path(folder) / "camera"
        make_recording(camera, frames=5)
        picture = pathlib.Path(folder) / "picture.png"
        publisher = subprocess.Popen([programs / "publish_camera", f"folder:{camera},loop=1"],
                                     stdout=subprocess.PIPE, text=True, env={**os.environ, "XDG_STATE_HOME": folder})
        try:
            link = publisher.stdout.readline().strip()
            test.assertRegex(link, r"^https://")
            saved = patience.run([programs / "save_picture", link, picture])
            test.assertEqual(saved.returncode, 0, saved.stderr)
            width, height, channels, rows = read_png(picture)
            test.assertEqual((width, height, channels), (1280, 720, 3))
            test.assertGreater(len({bytes(row) for row in rows}), 50, "the picture shows nothing")
        finally:
            publisher.send_signal(signal.SIGTERM)
            test.assertEqual(patience.end_of(publisher), 0)
            publisher.stdout.close()


class Examples(unittest.TestCase):
    def test_a_picture_of_a_published_camera_is_saved(self):
        save_a_picture(self, EXAMPLES)

    def test_a_camera_is_sent_into_a_session(self):
        with tempfile.TemporaryDirectory() as folder:
            camera = pathlib.Path(folder) / "sent"
            make_recording(camera, frames=5)
            with host(pathlib.Path(folder) / "state") as session, \
                    Process("join", session.greeting["link"], "--no-window", "--every", "0.2") as viewer:
                sender = subprocess.Popen([EXAMPLES / "send_camera", session.greeting["publish_link"], f"folder:{camera},loop=1"])
                try:
                    viewer.wait_for(lambda f: any(c["name"] == "sent" and c["frames"] > 3 for c in f["cameras"]))
                finally:
                    sender.send_signal(signal.SIGTERM)
                    self.assertEqual(patience.end_of(sender), 0)
                viewer.wait_for(lambda f: not f["cameras"])

    def test_a_wrong_link_ends_in_a_sentence(self):
        with tempfile.TemporaryDirectory() as folder:
            for words in (("save_picture", "nonsense", pathlib.Path(folder) / "a.png"),
                          ("send_camera", "nonsense", "synthetic:surgeon")):
                result = patience.run([EXAMPLES / words[0], *words[1:]])
                self.assertEqual(result.returncode, 1)
                self.assertTrue(re.search(r"link", result.stderr), result.stderr)

    def test_each_is_at_most_60_lines(self):
        sources = list(SOURCES.glob("*.cpp"))
        self.assertGreaterEqual(len(sources), 3)
        for source in sources:
            self.assertLessEqual(len(source.read_text().splitlines()), 60, source)


if __name__ == "__main__":
    unittest.main()
