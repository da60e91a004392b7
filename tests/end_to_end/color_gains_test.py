# SPDX-License-Identifier: Apache-2.0
"""Cameras of different exposure get gains from their host, which travel with their calibrations."""
import json
import pathlib
import shutil
import struct
import tempfile
import unittest

from theatron_process import Process, host, run, wait_until, write_png

WIDTH, HEIGHT, FOCAL = 160, 144, 126.0
DARK, BRIGHT = 100, 144


class ColorGains(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="theatron_gains_"))

    def tearDown(self):
        shutil.rmtree(self.folder)

    def camera(self, name, x, level):
        """Sees a wall at a distance of 2 m, in a colour of this level."""
        folder = self.folder / name
        lens = {"width": WIDTH, "height": HEIGHT, "fx": FOCAL, "fy": FOCAL, "cx": 79.5, "cy": 71.5}
        for kind, bits, channels, pixel in (("depth", 16, 1, struct.pack(">H", 2000)), ("color", 8, 3, bytes([level] * 3))):
            (folder / kind).mkdir(parents=True)
            first = folder / kind / "00000.png"
            write_png(first, WIDTH, HEIGHT, bits, channels, [pixel * WIDTH] * HEIGHT)
            for n in range(1, 20):
                (folder / kind / f"{n:05}.png").hardlink_to(first)
        (folder / "calibration.json").write_text(json.dumps({"depth": lens, "color": lens}))
        return f"folder:{folder},fps=10,loop=1,preload=1,place={x}:1.5:0"

    def status(self, link):
        code, out, errors = run("status", link, "--json")
        self.assertEqual(code, 0, errors)
        return json.loads(out)["cameras"]

    def test_the_host_estimates_them_once_for_viewers_and_recordings(self):
        file = self.folder / "session.mkv"
        with host(self.folder / "state", self.camera("dark", 0, DARK), self.camera("bright", 0.2, BRIGHT)) as h:
            link = h.greeting["link"]
            with Process("record", link, file, "--json") as recorder:
                cameras = wait_until(lambda: all("color_gain" in c for c in self.status(link)) and self.status(link))
                dark, bright = (c["color_gain"] for c in cameras)
                self.assertTrue(dark["estimated"] and bright["estimated"])
                self.assertAlmostEqual(dark["red"] / bright["red"], BRIGHT / DARK, delta=0.03)
                self.assertAlmostEqual(dark["red"] * bright["red"], 1, delta=0.03)
                second = self.folder / "session.002.mkv"
                wait_until(lambda: second.exists() and second.stat().st_size > 20_000)
                recorder.process.terminate()
                figures = recorder.read_json()
                self.assertEqual(recorder.end(), 0, figures)
        self.assertEqual((figures["segments"], figures["lost"]), (2, 0))
        code, out, errors = run("inspect", file, "--json")
        self.assertEqual(code, 0, errors)
        for camera, gain in zip(json.loads(out)["cameras"], (dark, bright)):
            calibrations = camera["calibrations"]
            self.assertNotIn("color_gain", calibrations[0])
            self.assertEqual(calibrations[-1]["color_gain"], [gain["red"], gain["green"], gain["blue"]])
        # Gains do not concern what is exported: no second folder.
        code, _, errors = run("export", file, "--png", self.folder / "png")
        self.assertEqual(code, 0, errors)
        self.assertEqual([p.name for p in self.folder.glob("png*")], ["png"])

    def test_gains_of_a_file_stay(self):
        cameras = self.camera("dark", 0, DARK), self.camera("bright", 0.2, BRIGHT)
        places = self.folder / "places.json"
        entries = [{"camera": name, "room_from_camera": {"quaternion": [0, 1, 0, 0], "translation": [x, 1.5, 0]},
                    **({"color_gain": [1.5, 1, 1]} if name == "dark" else {})} for name, x in (("dark", 0), ("bright", 0.2))]
        places.write_text(json.dumps({"theatron_places": 1, "made": "", "method": "by hand", "cameras": entries}))
        with host(self.folder / "state", *(c.split(",place=")[0] for c in cameras), options=("--places", places)) as h:
            link = h.greeting["link"]
            seen = wait_until(lambda: "color_gain" in self.status(link)[1] and self.status(link))
            self.assertEqual(seen[0]["color_gain"], {"red": 1.5, "green": 1, "blue": 1, "estimated": False})
            self.assertAlmostEqual(seen[1]["color_gain"]["red"], 1.5 * DARK / BRIGHT, delta=0.03)
            self.assertAlmostEqual(seen[1]["color_gain"]["blue"], DARK / BRIGHT, delta=0.03)


if __name__ == "__main__":
    unittest.main()
