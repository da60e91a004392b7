# SPDX-License-Identifier: Apache-2.0
"""theatron cameras, and a live camera on the way to a viewer, with a library that stands in for libk4a."""
import json
import os
import pathlib
import shutil
import tempfile
import unittest

from theatron_process import Process, host, run

STANDIN = os.environ["THEATRON_K4A_STANDIN"]


class Cameras(unittest.TestCase):
    def setUp(self):
        self.state = pathlib.Path(tempfile.mkdtemp(prefix="theatron_e2e_"))
        os.environ["THEATRON_K4A_LIBRARY"] = STANDIN
        os.environ["K4A_STANDIN"] = "devices=2"

    def tearDown(self):
        del os.environ["THEATRON_K4A_LIBRARY"], os.environ["K4A_STANDIN"]
        shutil.rmtree(self.state)

    def test_more_cameras_than_a_session_has_are_refused_at_once(self):
        code, _, errors = run("host", "--state", self.state, *["--camera", "k4a:0"] * 64)
        self.assertEqual(code, 1, errors)
        self.assertIn("A session has at most 63 cameras; 64 were given.", errors)

    def test_cameras_lists_kinds_and_devices(self):
        code, out, errors = run("cameras", "--json")
        self.assertEqual(code, 0, errors)
        listed = json.loads(out)
        self.assertEqual([d["camera"] for d in listed["devices"]], ["k4a:0", "k4a:1"])
        self.assertEqual(listed["devices"][1]["serial"], "000123451")
        self.assertTrue(any(kind.startswith("k4a:INDEX") for kind in listed["kinds"]))
        code, out, errors = run("cameras")
        self.assertEqual(code, 0, errors)
        self.assertIn("serial 000123450", out)
        self.assertIn("folder:DIR", out)

    def test_a_missing_library_is_said_plainly(self):
        os.environ["THEATRON_K4A_LIBRARY"] = "/nowhere/libk4a.so"
        code, out, _ = run("cameras")
        self.assertEqual(code, 0)
        self.assertIn("cannot be loaded", out)
        code, _, errors = run("host", "--camera", "k4a:0", "--state", self.state)
        self.assertEqual(code, 1)
        self.assertIn("cannot be loaded", errors)

    def test_two_live_cameras_reach_a_viewer(self):
        with host(self.state, "k4a:0", "k4a:1,color=off,depth=nfov2x2") as h, \
                Process("join", h.greeting["link"], "--every", "0.2") as viewer:
            figures = viewer.wait_for(
                lambda f: len(f["cameras"]) == 2 and all(c["frames"] > 10 for c in f["cameras"]))
            self.assertEqual(sorted(c["name"] for c in figures["cameras"]),
                             ["k4a-000123450", "k4a-000123451"])

    def test_an_unplugged_camera_is_reported_and_the_other_goes_on(self):
        os.environ["K4A_STANDIN"] = "unplug_after=20"
        with host(self.state, "k4a:0") as h:
            with Process("join", h.greeting["link"], "--every", "0.2") as viewer:
                viewer.wait_for(lambda f: True)
                for _ in range(100):
                    if any("unplugged" in line for line in h.errors):
                        break
                    viewer.read_json()
            self.assertIn("unplugged", "".join(h.errors))


if __name__ == "__main__":
    unittest.main()
