# SPDX-License-Identifier: Apache-2.0
"""Filters of a host: chosen, changed while it runs, and told to those who watch."""
import itertools
import json
import pathlib
import shutil
import tempfile
import unittest

from theatron_process import Process, host, make_recording, run, wait_until


class Filters(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="theatron_filter_"))
        cls.camera = f"folder:{make_recording(cls.folder / 'box', width=64, height=48)},loop=1,preload=1"
        cls.state = cls.folder / "state"

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder)

    def test_each_viewer_is_told_which_filters_ran_on_which_camera(self):
        options = ("--filter", "off", "--filter", "1=holes+kalman")
        with host(self.state, self.camera, self.camera, options=options) as h, \
                Process("join", h.greeting["link"], "--every", "0.1") as viewer:
            told = viewer.wait_for(lambda f: f["cameras"] and f["cameras"][1]["filter"] and f["fps"] > 0)
            self.assertEqual([camera["filter"] for camera in told["cameras"]], ["", "holes+kalman"])
            code, out, errors = run("status", h.greeting["link"], "--json")
            self.assertEqual(code, 0, errors)
            self.assertEqual([camera["filter"] for camera in json.loads(out)["cameras"]], ["", "holes+kalman"])

    def test_without_a_gpu_the_processor_filters_and_the_host_says_so_once(self):
        says = "The filters run on the processor, with the same result."
        for device in ("cuda", "auto"):
            with host(self.state, self.camera, self.camera, options=("--filter", f"default@{device}")) as h, \
                    Process("join", h.greeting["link"], "--every", "0.1") as viewer:
                viewer.wait_for(lambda f: len(f["cameras"]) == 2 and all(c["filter"] and c["frames"] > 20 for c in f["cameras"]))
                cameras = json.loads(run("status", h.greeting["link"], "--json")[1])["cameras"]
                if any(c["filter_device"] != "cpu" for c in cameras):
                    continue  # a GPU filters
                h.wait_for_error("participant joined")
                before = [line for line in itertools.takewhile(lambda line: "participant joined" not in line, h.errors) if says in line]
                self.assertEqual(len(before), 1, h.errors)
                self.assertEqual(len([line for line in h.errors if says in line]), 1, h.errors)

    def test_a_file_may_change_while_the_host_runs(self):
        file = self.folder / "left.json"
        file.write_text('{"filters": [{"filter": "range", "max_mm": 900}]}')
        with host(self.state, self.camera, options=("--filter", file)) as h, \
                Process("join", h.greeting["link"], "--every", "0.1") as viewer:
            def told(filters):
                viewer.wait_for(lambda f: f["cameras"] and f["cameras"][0]["filter"] == filters and f["fps"] > 0)
            told("range:max_mm=900")
            file.write_text('{"filters": []}')
            told("")
            file.write_text('{"filters": [{"filter": "nonsense"}]}')
            file_is_wrong = lambda: any("filter stays as it was" in line for line in h.errors)
            while not file_is_wrong():
                viewer.newest_json()
            told("")
            file.write_text('{"preset": "default"}')
            viewer.wait_for(lambda f: f["cameras"][0]["filter"] not in ("", "range:max_mm=900"))

    def test_a_recording_tells_which_filters_ran_also_when_they_changed(self):
        file = self.folder / "recorded.json"
        file.write_text('{"filters": [{"filter": "kalman"}]}')
        with host(self.state, self.camera, options=("--filter", file)) as h, \
                Process("join", h.greeting["link"], "--every", "0.1") as viewer, \
                Process("record", h.greeting["link"], self.folder / "changes.mkv") as recorder:
            viewer.wait_for(lambda f: f["cameras"] and f["cameras"][0]["filter"] == "kalman" and f["fps"] > 0)
            recording = self.folder / "changes.mkv"
            wait_until(lambda: recording.exists() and recording.stat().st_size > 4096)
            file.write_text('{"filters": [{"filter": "range", "max_mm": 900}]}')
            changed = viewer.wait_for(lambda f: f["cameras"][0]["filter"] == "range:max_mm=900")["cameras"][0]["frames"]
            viewer.wait_for(lambda f: f["cameras"][0]["frames"] > changed + 15)
            recorder.process.terminate()
            recorder.end()
        code, out, errors = run("inspect", self.folder / "changes.mkv", "--json")
        self.assertEqual(code, 0, errors)
        filters = [change["filters"] for change in json.loads(out)["cameras"][0]["depth"]["filters"]]
        self.assertEqual(filters[-2:], ["kalman", "range:max_mm=900"])
        code, out, errors = run("inspect", self.folder / "changes.mkv")
        self.assertIn("s on: range:max_mm=900", out)

    def test_wrong_filters_are_refused_in_one_sentence(self):
        for options, expected in ((("--filter", "best"), "no filter 'best'"),
                                  (("--filter", "default@gpu"), "no device 'gpu'"),
                                  (("--filter", "3=default"), "no camera 3"),
                                  (("--filter", "nowhere.json"), "nowhere.json"),
                                  (("--filter", "background:file=nowhere.background"), "nowhere.background")):
            with self.subTest(options=options):
                code, _, errors = run("host", "--listen", "127.0.0.1:0", "--state", self.state, "--camera",
                                      self.camera, *options)
                self.assertEqual(code, 1)
                message = [line for line in errors.splitlines() if line.startswith("theatron:")]
                self.assertEqual(len(message), 1, errors)
                self.assertIn(expected, message[0])


if __name__ == "__main__":
    unittest.main()
