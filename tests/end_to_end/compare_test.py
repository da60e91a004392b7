# SPDX-License-Identifier: Apache-2.0
"""Theatron beside a video call and point cloud codecs: table, JSON and page of one short measurement."""
import html
import json
import pathlib
import re
import shutil
import tempfile
import unittest

from theatron_process import PROGRAM, run

METHODS = ["video_call", "video_call_full_hd", "video_call_zoomed", "video_call_two_cameras", "paper", "pcl", "theatron", "theatron_near",
           "theatron_and_zoomed_call"]
# From the first place alone, because cameras do not move with the expert.
WHOLE_PICTURES_OF_VIDEO = ["video_call", "video_call_two_cameras"]


class Compare(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="theatron_e2e_"))
        self.addCleanup(shutil.rmtree, self.folder)

    def test_every_method_has_figures_and_pictures_or_its_reason(self):
        page, figures = self.folder / "compare.html", self.folder / "compare.json"
        code, out, errors = run("bench", "compare", "--quick", "--frames", "3", "--mbit", "10", "1000", "--page", page, "--json", figures)
        self.assertEqual(code, 0, errors)
        found, raw = json.loads(figures.read_text()), page.read_text()
        # The pictures would hide any message.
        shown = html.unescape(re.sub("base64,[^\"]*", "", raw))
        self.assertEqual([m["id"] for m in found["methods"]], METHODS)
        pictures = len(found["places"]) + 2  # of what is there; the close-up has its marks beside it
        for method in found["methods"]:
            with self.subTest(method["id"]):
                self.assertIn(method["name"], out)
                self.assertIn(method["name"], shown)
                if method["reason"]:
                    self.assertIn(method["reason"], out)
                    self.assertIsNone(method["mbit_per_camera"])
                    continue
                self.assertGreater(method["mbit_per_camera"], 0)
                self.assertGreater(method["sender_ms"], 0)
                self.assertGreater(method["receiver_ms"], 0)
                slow, fast = method["links"]
                self.assertEqual((slow["mbit"], fast["mbit"]), (10, 1000))
                self.assertLessEqual(slow["pictures_per_s"], fast["pictures_per_s"])
                self.assertGreater(slow["delay_ms"]["mean"], fast["delay_ms"]["mean"])
                self.assertEqual(method["expert"] is None, method["expert_reason"] is not None)
                self.assertEqual(method["mbit_of_all"], method["cameras"] * method["mbit_per_camera"])
                self.assertEqual(method["expert"] is None, method["close_up"] is None)
                if method["expert"]:
                    self.assertLessEqual(method["expert"]["undrawn_unseen_percent"], method["expert"]["undrawn_percent"])
                if method["close_up"]:
                    causes = method["close_up"]["see_through_causes"]
                    self.assertAlmostEqual(sum(causes.values()), method["close_up"]["see_through_percent"])
                pictures += len(found["places"]) if method["expert"] else method["id"] in WHOLE_PICTURES_OF_VIDEO
                pictures += 2 if method["expert"] or method["id"].startswith("video_call") else 0
                if method["wound"]:
                    for region in ("near", "whole"):
                        shares = method["wound"][region]
                        self.assertAlmostEqual(shares["rightly_percent"] + shares["wrongly_percent"] + shares["hidden_percent"], 100)
                        self.assertLessEqual(shares["finely_percent"], shares["rightly_percent"])
                    if causes := method["wound"]["lost"]:
                        self.assertAlmostEqual(sum(causes.values()), 100 - method["wound"]["near"]["rightly_percent"])
                if found["here"]["gl_renderer"]:
                    self.assertGreater(method["drawing_ms"], 0)
        self.assertEqual(shown.count("<figure"), pictures)
        self.assertEqual(shown.count('src="data:image/jpeg;'), pictures)
        self.assertNotIn("http", shown)
        methods = {m["id"]: m for m in found["methods"]}
        # These need no library that may be missing.
        for name in ("paper", "theatron"):
            self.assertIsNone(methods[name]["reason"])
            self.assertEqual(methods[name]["expert"] is None, found["here"]["gl_renderer"] is None)
            self.assertEqual(methods[name]["cameras"], 2)
        self.assertIsNone(methods["video_call"]["expert"])
        self.assertEqual(methods["theatron_near"]["cameras"], 3)
        if not methods["video_call"]["reason"]:
            self.assertEqual(methods["video_call_two_cameras"]["cameras"], 2)
            self.assertIsNotNone(methods["video_call_full_hd"]["own_view"])
            for name in ("video_call", "video_call_zoomed"):
                self.assertEqual(methods[name]["wound"]["near"]["wrongly_percent"], 0)
            self.assertLess(methods["video_call_zoomed"]["wound"]["near"]["detail_mm"], methods["video_call"]["wound"]["near"]["detail_mm"])
            both, alone, zoomed = (methods[name] for name in ("theatron_and_zoomed_call", "theatron", "video_call_zoomed"))
            self.assertEqual(both["cameras"], alone["cameras"] + zoomed["cameras"])
            # The same pictures through the same codecs.
            self.assertAlmostEqual(both["mbit_of_all"], alone["mbit_of_all"] + zoomed["mbit_of_all"])
            if alone["wound"]:
                for one in (alone, zoomed):
                    self.assertGreaterEqual(both["wound"]["near"]["rightly_percent"], one["wound"]["near"]["rightly_percent"])
        if methods["theatron"]["expert"]:
            self.assertLess(methods["theatron"]["expert"]["holes_percent"], methods["paper"]["expert"]["holes_percent"])
            near, usual = methods["theatron_near"]["close_up"], methods["theatron"]["close_up"]
            self.assertLess(near["see_through_percent"], usual["see_through_percent"])
            self.assertGreater(methods["theatron_near"]["wound"]["near"]["rightly_percent"], methods["theatron"]["wound"]["near"]["rightly_percent"])
            self.assertIn("What may be judged from it", shown)
            self.assertGreater(methods["theatron"]["expert"]["psnr_db"], methods["paper"]["expert"]["psnr_db"])
        self.assertEqual(methods["pcl"]["reason"] is None, (pathlib.Path(PROGRAM).parent / "theatron_bench_pcl").exists())

    def test_what_cannot_be_written_is_said_before_anything_is_measured(self):
        for words in (["--page", self.folder / "none" / "a.html"], ["--json", self.folder / "none" / "a.json"], ["--page", self.folder]):
            code, out, errors = run("bench", "compare", "--quick", *words)
            self.assertEqual((code, out), (1, ""))
            self.assertIn(str(words[1]), errors)
            self.assertNotIn("%", errors)


if __name__ == "__main__":
    unittest.main()
