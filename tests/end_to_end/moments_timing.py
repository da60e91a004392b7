# SPDX-License-Identifier: Apache-2.0
"""Two cameras of a session in the window: in step, 15 ms out of phase, and one without each seventh picture.

The truth is what late_ms= and skip_every= make of the generated room's cameras, which are in step.
"""
import pathlib
import re
import shutil
import tempfile
import unittest

from theatron_process import Process, host
from virtual_screen import VirtualScreen

SECONDS = 10
FPS = 30
# So little of the generated room is drawn more often than pictures come, also without a graphics card.
SIZE = "160x120"
CAMERA = "synthetic:room,camera={},seconds=2,loop=1,quality=quick,color=depth,preload=1,crop=128:112:64x56"


class Moments(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        if not shutil.which("Xvfb"):
            raise unittest.SkipTest("Xvfb is missing")
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="theatron_moments_"))
        cls.screen = VirtualScreen(320, 240)

    @classmethod
    def tearDownClass(cls):
        cls.screen.__exit__()
        shutil.rmtree(cls.folder)

    def measured(self, name, second_camera):
        """What a window says at its end, of a session with the room's camera 0 and this one."""
        with host(self.folder / name, CAMERA.format(0), CAMERA.format(1) + second_camera) as h:
            with Process("join", h.greeting["link"], "--name", "Wim", "--size", SIZE, "--renderer", "splat", "--seconds", SECONDS,
                         env={**self.screen.environment, "XDG_STATE_HOME": str(self.folder)}) as window:
                self.assertEqual(window.end(), 0, window.last_words())
                said = "".join(iter(window.lines.get, None))
        drawn = re.search(r"drew (\d+) pictures, age on screen (\d+) ms", said)
        together = re.search(r"cameras (\d+) ms apart \(at most \d+\), (\d+) pictures alone", said)
        self.assertTrue(drawn and together, said)
        return {"drawn": int(drawn[1]), "age_ms": int(drawn[2]), "skew_ms": int(together[1]), "unpaired": int(together[2])}

    def test_what_is_shown_together_is_what_was_taken_together(self):
        in_step = self.measured("in_step", "")
        late = self.measured("late", ",late_ms=15")
        gaps = self.measured("gaps", ",skip_every=7")
        print({"in_step": in_step, "late": late, "gaps": gaps})
        self.assertLess(in_step["skew_ms"], 5)
        self.assertLess(abs(late["skew_ms"] - 15), 4)
        missing = SECONDS * FPS / 7
        self.assertLess(abs(gaps["unpaired"] - missing), 0.4 * missing)
        self.assertLess(late["unpaired"] + in_step["unpaired"], 0.2 * missing)
        # Nothing waits for the late camera, but a picture that is drawn with its frame shows the other one's 15 ms later.
        self.assertLess(late["age_ms"] - in_step["age_ms"], 15)
        self.assertLess(gaps["age_ms"] - in_step["age_ms"], 6)


if __name__ == "__main__":
    unittest.main()
