# SPDX-License-Identifier: Apache-2.0
"""How far apart the cameras of a moment are, and how many pictures came alone, is told without a window, by hosts and by publishers.

late_ms= and skip_every= take the cameras of the generated room out of step.
"""
import json
import pathlib
import shutil
import tempfile
import unittest

from theatron_process import Process, host, run, wait_until

CAMERA = "synthetic:room,camera={},seconds=2,loop=1,quality=quick,color=depth,preload=1,crop=128:112:64x56"


def middle_skew(figures):
    """By the times when pictures were due, which do not depend on the machine's speed."""
    return figures["skew_ms"] and figures["skew_ms"]["p50"]


def apart(cameras):
    """The truth: late_ms= and what lies between the beginnings of the two cameras."""
    first, second = (c["sync_offset_ms"] for c in cameras)
    return abs(first - second)


class Moments(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="theatron_moments_"))
        cls.addClassCleanup(shutil.rmtree, cls.folder)

    def viewer(self, link, *options):
        return Process("join", link, "--no-window", *options, env={"XDG_STATE_HOME": str(self.folder)})

    def status(self, link):
        code, out, errors = run("status", link, "--json")
        self.assertEqual(code, 0, errors)
        return json.loads(out)

    def test_a_viewer_without_a_window_and_its_host_tell_the_skew(self):
        with host(self.folder / "late", CAMERA.format(0), CAMERA.format(1) + ",late_ms=8") as h, \
                self.viewer(h.greeting["link"], "--every", "0.2") as viewer:
            told = viewer.wait_for(lambda f: middle_skew(f) is not None)
            status = self.status(h.greeting["link"])
            truth = apart(status["cameras"])
            self.assertAlmostEqual(middle_skew(told), truth, delta=1)
            self.assertAlmostEqual(middle_skew(status), truth, delta=1)
            code, table, errors = run("status", h.greeting["link"])
            self.assertEqual(code, 0, errors)
            self.assertRegex(table, r"cameras \d+ ms apart \(at most \d+\), \d+ pictures alone")

    def test_pictures_that_come_alone_are_counted_however_they_are_drawn(self):
        with host(self.folder / "gaps", CAMERA.format(0), CAMERA.format(1) + ",skip_every=7") as h:
            with self.viewer(h.greeting["link"], "--every", "0.2") as viewer:
                viewer.wait_for(lambda f: f["unpaired"] >= 5)
            self.assertGreater(self.status(h.greeting["link"])["unpaired"], 0)

    def test_cameras_of_a_publisher_have_their_moments_in_common(self):
        with host(self.folder / "published", CAMERA.format(0)) as h, \
                Process("publish", h.greeting["publish_link"], "--every", "0.2",
                        "--camera", CAMERA.format(0), "--camera", CAMERA.format(1) + ",late_ms=8") as cart, \
                self.viewer(h.greeting["link"], "--every", "0.2") as viewer:
            told = viewer.wait_for(lambda f: middle_skew(f) is not None)
            sent = cart.wait_for(lambda f: middle_skew(f) is not None)
            truth = apart(sent["cameras"])
            self.assertAlmostEqual(middle_skew(told), truth, delta=1)
            self.assertAlmostEqual(middle_skew(sent), truth, delta=1)

            def published():
                cameras = self.status(h.greeting["link"])["published"]
                return all(c["sync_offset_ms"] is not None and c["filter_device"] for c in cameras) and cameras

            cameras = wait_until(published)
            self.assertAlmostEqual(apart(cameras), truth, delta=1)
            self.assertEqual({c["filter_device"] for c in cameras}, {"cpu"})


if __name__ == "__main__":
    unittest.main()
