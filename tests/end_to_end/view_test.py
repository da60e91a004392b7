# SPDX-License-Identifier: Apache-2.0
"""theatron view: cameras, recordings and cases without a host and a link."""
import json
import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest

from theatron_process import PROGRAM, make_recording, read_png, stand


class View(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="theatron_e2e_"))
        self.addCleanup(shutil.rmtree, self.folder)
        self.own = self.folder / "own"  # for files that are to be gone afterwards
        self.own.mkdir()
        self.box = make_recording(self.folder / "box")
        stand(self.box)

    def view(self, *words):
        return subprocess.run([PROGRAM, "view", *map(str, words)], capture_output=True, text=True, stdin=subprocess.DEVNULL,
                              env=dict(os.environ, TMPDIR=str(self.own)))

    def picture(self, what):
        picture = self.folder / "picture.png"
        picture.unlink(missing_ok=True)
        shown = self.view(what, "--offscreen", picture, "--room", "off", "--size", "320x240", "--seconds", "1", "--json")
        self.assertEqual(shown.returncode, 0, shown.stderr)
        self.assertEqual(list(self.own.iterdir()), [], "it leaves nothing behind")
        _, _, _, rows = read_png(picture)
        self.assertGreater(len(set(bytes(row) for row in rows)), 100, "the picture shows the box")
        return json.loads(shown.stdout)

    def test_pictures_a_recording_and_a_camera_are_drawn(self):
        self.picture(self.box)
        recording = self.folder / "a.mkv"
        subprocess.run([PROGRAM, "record", recording, "--camera", f"folder:{self.box}", "--camera", f"folder:{self.box}"],
                       check=True, capture_output=True)
        self.assertEqual(len(self.picture(recording)["cameras"]), 2)
        self.picture(f"folder:{self.box},loop=1")

    def test_a_case_is_offered(self):
        subprocess.run([PROGRAM, "case", "synth", self.folder / "liver"], check=True, capture_output=True)
        offered, seconds = [], 1
        while not offered:  # a slow machine reads it for longer
            shown = self.view(self.folder / "liver", "--json", "--seconds", seconds)
            self.assertEqual(shown.returncode, 0, shown.stderr)
            offered, seconds = json.loads(shown.stdout)["cases"]["offered"], 2 * seconds
        self.assertEqual(len(offered), 1)

    def test_what_cannot_be_shown_is_refused_with_a_sentence(self):
        for what, sentence in ((self.folder / "none", "There is no file or folder"), (self.own, "is neither a case nor pictures"),
                               ("nonsense:1", "There is no camera 'nonsense'")):
            shown = self.view(what, "--json")
            self.assertEqual((shown.returncode, shown.stderr.count("\n")), (1, 1), shown.stderr)
            self.assertIn(sentence, shown.stderr)


if __name__ == "__main__":
    unittest.main()
