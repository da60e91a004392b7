# SPDX-License-Identifier: Apache-2.0
"""A camera that is knocked or moved away while it streams raises an alarm that host, monitoring and participants see."""
import json
import pathlib
import shutil
import struct
import tempfile
import unittest
import urllib.request
import ssl

from theatron_process import Process, host, run, wait_until, write_png

WIDTH, HEIGHT, FOCAL = 320, 288, 252.0
FPS, BEFORE, AFTER = 10, 120, 600


def depth_at(x, y, forward):
    """A floor, a wall and a box, seen from 1.5 m above the floor by a camera that is `forward` of its place."""
    rx, ry = (x - 159.5) / FOCAL, (y - 143.5) / FOCAL
    z = 3.0 - forward
    if ry > 0:
        z = min(z, 1.5 / ry)
    if abs((2.0 - forward) * rx) < 0.4 and (2.0 - forward) * ry > 0.2:
        z = min(z, 2.0 - forward)
    return round(1000 * z)


def write_frame(path, forward):
    rows = [struct.pack(f">{WIDTH}H", *(depth_at(x, y, forward) for x in range(WIDTH))) for y in range(HEIGHT)]
    write_png(path, WIDTH, HEIGHT, 16, 1, rows)


class PlaceWatch(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="theatron_watch_"))

    def tearDown(self):
        shutil.rmtree(self.folder)

    def camera(self, forward=0.008):
        """It is moved forward, by 8 mm, after twelve seconds."""
        depth = self.folder / "camera" / "depth"
        depth.mkdir(parents=True)
        (self.folder / "camera" / "calibration.json").write_text(json.dumps({"depth": {
            "width": WIDTH, "height": HEIGHT, "fx": FOCAL, "fy": FOCAL, "cx": 159.5, "cy": 143.5}}))
        for name, forward in (("before.png", 0), ("after.png", forward)):
            write_frame(self.folder / name, forward)
        for n in range(BEFORE + AFTER):
            (depth / f"{n:05}.png").hardlink_to(self.folder / ("before.png" if n < BEFORE else "after.png"))
        return f"folder:{self.folder / 'camera'},fps={FPS},place=0:1.5:2"

    def test_a_knocked_camera_is_reported_to_everybody(self):
        with host(self.folder / "state", self.camera()) as h:
            link = h.greeting["link"]

            def status():
                code, out, errors = run("status", link, "--json")
                self.assertEqual(code, 0, errors)
                return json.loads(out)["cameras"][0]

            with Process("join", link, "--no-window", "--every", "1") as viewer:
                seen = wait_until(lambda: status() if status().get("place") else None)
                self.assertFalse(seen["place"]["alarm"])
                self.assertLess(seen["place"]["moved_mm"], 1)
                self.assertEqual(seen["problem"], "")
                seen = wait_until(lambda: status() if status()["place"]["alarm"] else None)
                self.assertAlmostEqual(seen["place"]["moved_mm"], 8, delta=1)
                self.assertRegex(seen["problem"], r"The camera was moved by [78]\.\d mm")
                self.assertIn("--refine", seen["problem"])
                told = viewer.wait_for(lambda f: f["cameras"] and f["cameras"][0]["problem"])
                self.assertIn("was moved by", told["cameras"][0]["problem"])
                wait_until(lambda: any("was moved by" in line for line in list(viewer.errors)))
            self.assertTrue(any("was moved by" in line for line in h.errors))
            token = link.split("join=")[1].split("&")[0]
            request = urllib.request.Request(f"https://127.0.0.1:{h.greeting['port']}/metrics",
                                             headers={"Authorization": f"Bearer {token}"})
            unchecked = ssl._create_unverified_context()
            metrics = urllib.request.urlopen(request, context=unchecked).read().decode()
            self.assertIn('theatron_camera_moved_alarm{camera="0",name="camera"} 1', metrics)

    def test_a_camera_that_was_moved_far_keeps_its_alarm_until_an_operator_accepts_its_place(self):
        with host(self.folder / "state", self.camera(forward=0.4)) as h:
            def status():
                code, out, errors = run("status", h.greeting["link"], "--json")
                self.assertEqual(code, 0, errors)
                return json.loads(out)["cameras"][0]

            seen = wait_until(lambda: status() if status().get("place", {}).get("alarm") else None)
            self.assertTrue(seen["place"]["far"])
            self.assertFalse(seen["covered"])
            self.assertIn("The camera was moved by more than 30 mm", seen["problem"])
            self.assertIn("nudge camera none", seen["problem"])
            h.say("crop camera 0:0:100x100")
            wait_until(lambda: "region:" in status()["filter"])
            self.assertTrue(status()["place"]["alarm"], "a region says nothing of the camera's place")
            token = h.greeting["link"].split("join=")[1].split("&")[0]
            request = urllib.request.Request(f"https://127.0.0.1:{h.greeting['port']}/metrics",
                                             headers={"Authorization": f"Bearer {token}"})
            metrics = urllib.request.urlopen(request, context=ssl._create_unverified_context()).read().decode()
            self.assertIn('theatron_camera_moved_far{camera="0",name="camera"} 1', metrics)
            with Process("join", h.greeting["links"]["observer"], "--no-window", "--every", "1") as observer:
                told = observer.wait_for(lambda f: f["cameras"] and f["cameras"][0]["problem"])
                self.assertIn("moved by more than 30 mm", told["cameras"][0]["problem"])
                self.assertNotIn("nudge", told["cameras"][0]["problem"], "an observer cannot")
                h.say("nudge camera none")
                wait_until(lambda: status()["problem"] == "")
                wait_until(lambda: any("has no problem any more" in line for line in list(observer.errors)))
            over = [line for line in h.errors if "has no problem any more" in line]
            self.assertEqual(len(over), 1, over)

    def test_a_camera_of_unknown_place_has_none_to_lose(self):
        with host(self.folder / "state", self.camera().replace(",place=0:1.5:2", "")) as h:
            code, out, _ = run("status", h.greeting["link"], "--json")
            self.assertEqual(code, 0)
            self.assertNotIn("place", json.loads(out)["cameras"][0])


if __name__ == "__main__":
    unittest.main()
