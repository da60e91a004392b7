# SPDX-License-Identifier: Apache-2.0
"""The paper's Table 1 beside small measurements: every row has a figure or its reason, in all files."""
import csv
import json
import pathlib
import shutil
import tempfile
import unittest

from theatron_process import make_recording, run


class Table1(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="theatron_e2e_"))
        self.addCleanup(shutil.rmtree, self.folder)

    def measured(self, **recording):
        camera = f"folder:{make_recording(self.folder / 'box', **recording)}"
        files = {name: self.folder / f"table1.{name}" for name in ("json", "csv", "html")}
        code, out, errors = run("bench", "table1", "--quick", "--camera", camera, "--json", files["json"], "--csv", files["csv"],
                                "--page", files["html"])
        self.assertEqual(code, 0, errors)
        return out, json.loads(files["json"].read_text()), files

    def test_every_row_has_a_figure_or_its_reason(self):
        out, found, files = self.measured()
        rows = {row["id"]: row for row in found["rows"]}
        for row in rows.values():
            with self.subTest(row["id"]):
                cell = row["same"] or row["best"]
                self.assertTrue(cell.get("reason") or cell["runs"] == 1)
                self.assertTrue(row["not_comparable"])
                self.assertIn(row["name"], out)
                self.assertIn(row["name"], files["html"].read_text())
                self.assertIn("box" if row["group"] in ("Depth", "Colour", "Filters") else "", row["input"])
        # These need neither GL nor a library that may be missing.
        for name in ("filter.chain", "filter.holes", "depth.trvl.full.encode", "depth.trvl.cropped.size", "depth.rvl.full.size",
                     "color.jpeg.full.decode", "rate.full", "rate.cropped", "delay.interval", "delay.interaction"):
            for way in ("same", "best"):
                self.assertGreater(rows[name][way]["median"], 0, name)
        self.assertIn("photon film", rows["delay.photon"]["same"]["reason"])
        # Without GL no picture is drawn; on a busy machine too few are.
        inside = rows["delay.inside"]
        self.assertIsNone(inside["paper"])
        if inside["best"].get("median"):
            self.assertIn("presented", [stage["until"] for stage in found["stages"]])
            self.assertIn("class='stage'", files["html"].read_text())
        else:
            self.assertTrue(inside["best"]["reason"])
        kilobytes = sum(rows[name]["same"]["median"] for name in ("color.jpeg.full.size", "depth.trvl.full.size"))
        self.assertAlmostEqual(rows["rate.full"]["same"]["median"], 30 * kilobytes, delta=0.001 * kilobytes)
        for name in ("vr.1.splat.low", "vr.2.mesh.high"):
            self.assertEqual(rows[name]["same"].get("reason") is None, found["here"]["gl_renderer"] is not None, name)
        lines = list(csv.DictReader(files["csv"].read_text().splitlines()))
        self.assertEqual([line["id"] for line in lines], list(rows))
        self.assertEqual(float(lines[2]["same_median"] or 0) > 0, "median" in found["rows"][2]["same"])

    def test_a_camera_without_colour_fills_the_other_rows(self):
        _, found, _ = self.measured(color=False)
        rows = {row["id"]: row for row in found["rows"]}
        for name in ("color.jpeg.full.size", "color.h264.cropped.encode", "rate.full"):
            self.assertIn("no colour", rows[name]["same"]["reason"], name)
        self.assertGreater(rows["depth.trvl.full.size"]["same"]["median"], 0)

    def test_what_cannot_be_is_said_before_anything_is_measured(self):
        camera = f"folder:{make_recording(self.folder / 'box')}"
        for words, message in ((["--camera", camera] * 3, "at most twice"),
                               (["--camera", "folder:" + str(self.folder / "none")], "none"),
                               (["--camera", camera, "--csv", self.folder / "none" / "a.csv"], "Cannot write"),
                               (["--camera", camera, "--json", self.folder / "none" / "a.json"], "Cannot write")):
            code, out, errors = run("bench", "table1", "--quick", *words)
            self.assertEqual((code, out), (1, ""))
            self.assertIn(message, errors)


if __name__ == "__main__":
    unittest.main()
