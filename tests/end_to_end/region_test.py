# SPDX-License-Identifier: Apache-2.0
"""The region of interest: exact inside, bounded outside, drawn and changed at the host."""
import pathlib
import random
import shutil
import struct
import tempfile
import unittest

from theatron_process import Process, host, read_png, run, write_png

WIDTH, HEIGHT, FRAMES = 160, 120, 4
LEFT, TOP, RIGHT, BOTTOM = 40, 30, 100, 70
MAX_ERROR = 4


class Region(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="theatron_e2e_"))
        cls.source = cls.folder / "source"
        (cls.source / "depth").mkdir(parents=True)
        noise = random.Random(1)
        for n in range(FRAMES):
            rows = [struct.pack(f">{WIDTH}H", *(0 if noise.random() < 0.05 else 1000 + 5 * y + noise.randrange(40)
                                                for _ in range(WIDTH))) for y in range(HEIGHT)]
            write_png(cls.source / "depth" / f"{n:05}.png", WIDTH, HEIGHT, 16, 1, rows)
        cls.pictures = [read_png(p)[3] for p in sorted((cls.source / "depth").iterdir())]

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder)

    def host(self, *options):
        return host(self.folder / "state", f"folder:{self.source},loop=1", options=("--filter", "off", *options))

    def test_inside_is_exact_and_outside_is_bounded(self):
        box = f"0={LEFT}:{TOP}:{RIGHT - LEFT}:{BOTTOM - TOP}"
        with self.host("--region", box) as h:
            code, _, errors = run("record", h.greeting["link"], self.folder / "session.mkv", "--seconds", 1,
                                  "--depth-codec", f"strata:max_error_mm={MAX_ERROR}")
            self.assertEqual(code, 0, errors)
        code, _, errors = run("export", self.folder / "session.mkv", "--png", self.folder / "png")
        self.assertEqual(code, 0, errors)

        def inside(rows):
            return [row[LEFT:RIGHT] for row in rows[TOP:BOTTOM]]

        recorded = sorted((self.folder / "png" / "depth").iterdir())
        self.assertGreater(len(recorded), 5)
        for path in recorded:
            rows = read_png(path)[3]
            originals = [p for p in self.pictures if inside(p) == inside(rows)]
            self.assertEqual(len(originals), 1, "inside the region no pixel may differ")
            pairs = [(a, b) for was, got in zip(originals[0], rows) for a, b in zip(was, got)]
            self.assertTrue(all((a == 0) == (b == 0) and abs(a - b) <= MAX_ERROR for a, b in pairs))
            self.assertGreater(sum(a != b for a, b in pairs), WIDTH * HEIGHT / 4)

    def test_it_changes_while_people_watch(self):
        with self.host() as h, \
                Process("join", h.greeting["link"], "--depth-codec", f"strata:max_error_mm={MAX_ERROR}", "--every",
                        "0.1") as viewer:
            def wait_for(exact):
                viewer.wait_for(lambda f: f["fps"] > 0 and f["cameras"][0]["depth_exact"] == exact)

            wait_for("everywhere")
            h.say("region 0 20:20:50:50 100:100:150:100:120:119")
            wait_for("region")
            h.say("region 9 0:0:10:10")
            h.say("region 0 nonsense")
            h.say("region 0 none")
            wait_for("everywhere")
            self.assertEqual(viewer.newest_json()["joins"], 1)
            self.assertIn("no camera '9'", "".join(h.errors))
            self.assertIn("'nonsense' is no region", "".join(h.errors))

    def test_a_region_that_cannot_be_is_refused_at_the_start(self):
        for text, says in (("0=1:2:3", "is no region"), ("0", "which camera"), ("0=500:0:10:10", "outside")):
            with self.subTest(text=text):
                code, _, errors = run("host", "--camera", f"folder:{self.source}", "--listen", "127.0.0.1:0", "--state",
                                      self.folder / "state", "--region", text, "--seconds", 1)
                self.assertEqual(code, 1)
                self.assertIn(says, errors)


if __name__ == "__main__":
    unittest.main()
