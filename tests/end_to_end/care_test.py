# SPDX-License-Identifier: Apache-2.0
"""Status and metrics of a running host, and cameras that fail."""
import json
import pathlib
import re
import shutil
import ssl
import tempfile
import unittest
import urllib.error
import urllib.request

from theatron_process import Process, host, make_recording, run, wait_until


def get(greeting, path, token=None, query=""):
    """Status code, type and text of what the host answers, without looking at its certificate."""
    context = ssl.create_default_context()
    context.check_hostname, context.verify_mode = False, ssl.CERT_NONE
    request = urllib.request.Request(f"https://127.0.0.1:{greeting['port']}{path}{query}")
    if token:
        request.add_header("Authorization", "Bearer " + token)
    try:
        with urllib.request.urlopen(request, context=context) as answer:
            return answer.status, answer.headers["Content-Type"], answer.read().decode()
    except urllib.error.HTTPError as refused:
        return refused.code, refused.headers["Content-Type"], refused.read().decode()


def metrics(greeting, token):
    """{name: {labels: value}} of a page that must be well formed."""
    status, kind, text = get(greeting, "/metrics", token)
    assert status == 200 and kind.startswith("text/plain; version=0.0.4"), (status, kind)
    values, described = {}, set()
    for line in text.splitlines():
        if line.startswith("#"):
            described.add(line.split()[2])
            continue
        match = re.fullmatch(r'(theatron_[a-z_]+)\{(.*)\} ([-+.e0-9]+)', line)
        assert match, line
        name = match[1]
        assert name in described or re.sub("_(bucket|sum|count)$", "", name) in described, line
        values.setdefault(name, {})[match[2]] = float(match[3])
    return values


class Care(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="theatron_care_"))
        cls.recording = make_recording(cls.folder / "box", width=64, height=48)
        cls.camera = f"folder:{cls.recording},loop=1,preload=1"
        cls.state = cls.folder / "state"

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder)

    def token(self, greeting):
        return re.search("join=([^&]*)", greeting["link"])[1]

    def test_status_and_metrics_are_for_those_who_show_a_token(self):
        with host(self.state, self.camera) as h:
            greeting, token = h.greeting, self.token(h.greeting)
            for path in ("/status", "/metrics"):
                self.assertEqual(get(greeting, path)[0], 401)
                self.assertEqual(get(greeting, path, "wrong")[0], 401)
                self.assertEqual(get(greeting, path, query="?token=wrong")[0], 401)
                self.assertNotIn("box", get(greeting, path, "wrong")[2])
                self.assertEqual(get(greeting, path, token)[0], 200)
                self.assertEqual(get(greeting, path, query="?token=" + token)[0], 200)
            # The token for monitoring opens the figures, but not the session.
            other = (self.state / "metrics.token").read_text().strip()
            self.assertEqual(get(greeting, "/metrics", other)[0], 200)
            code, _, errors = run("join", greeting["link"].replace(token, other), "--no-window", "--seconds", "1")
            self.assertNotEqual(code, 0)
            self.assertIn("access code of this link is wrong", errors)
            self.assertIn("Theatron", get(greeting, "/")[2])

    def if_all_went_on(self, before, now):
        """`now` if both cameras are live and have had 30 frames since `before`."""
        cameras = [f'camera="{i}",name="box"' for i in (0, 1)]
        if all(now["theatron_frames_total"][c] >= before["theatron_frames_total"][c] + 30
               and now["theatron_frames_per_second"][c] > 5 and now["theatron_age_seconds"][c] < 1
               and now["theatron_camera_stale"][c] == 0 for c in cameras):
            return now
        return None

    def sums_by_buckets(self, buckets, labels, count):
        """The least and the largest sum that a histogram's buckets allow."""
        bounds = sorted((float(key.removeprefix(labels + ',le="').rstrip('"')), value)
                        for key, value in buckets.items() if key.startswith(labels + ',le='))
        self.assertEqual(bounds[-1], (float("inf"), count))
        least = most = below = lower = 0
        for upper, cumulative in bounds:
            self.assertGreaterEqual(cumulative, below)
            inside, below = cumulative - below, cumulative
            least += inside * lower
            most += inside * upper if inside else 0
            lower = upper
        return least * (1 - 1e-6), most * (1 + 1e-6)

    def test_a_host_begins_without_a_camera_that_is_missing_and_takes_it_when_it_is_there(self):
        late, beside = self.folder / "late", f"folder:{self.folder / 'late'},loop=1,preload=1"
        with host(self.state, beside, self.camera) as h, \
                Process("join", h.greeting["link"], "--every", "0.2") as viewer:
            self.assertEqual(h.greeting["cameras"], ["late", "box"])
            h.wait_for_error(f"There is no folder '{late}'.")
            viewer.wait_for(lambda f: [c["id"] for c in f["cameras"]] == [1] and f["cameras"][0]["frames"] > 0)
            status = json.loads(get(h.greeting, "/status", self.token(h.greeting))[2])
            missing, there = status["cameras"]
            self.assertEqual((missing["state"], missing["trouble"], missing["name"]), ("stale", "gone", "late"))
            self.assertIn("There is no folder", missing["problem"])
            self.assertNotEqual(there["trouble"], "gone")
            viewer.wait_for(lambda f: f["cameras"][0]["state"] == "live")
            of = 'camera="0",name="late"'
            self.assertEqual(metrics(h.greeting, self.token(h.greeting))["theatron_camera_stale"][of], 1)
            make_recording(self.folder / "copied", width=64, height=48)
            (self.folder / "copied").rename(late)
            viewer.wait_for(lambda f: len(f["cameras"]) == 2 and all(c["frames"] > 0 for c in f["cameras"]))
            h.wait_until(lambda: metrics(h.greeting, self.token(h.greeting))["theatron_camera_stale"][of] == 0)
        shutil.rmtree(late)

    def test_a_wrong_word_or_only_wrong_names_of_files_are_refused_at_once(self):
        for cameras, said in (((self.camera, "folder:missing,fbs=15"), "fbs"), ((self.camera, "floder:missing"), "floder"),
                              ((self.camera, "v4l2:/dev/none,size=big"), "size=big"),
                              (("folder:missing", "mkv:missing.mkv"), "There is no folder 'missing'."),
                              ((self.camera, "recording:missing.mkv"), "missing.mkv")):
            with self.subTest(cameras):
                words = [word for camera in cameras for word in ("--camera", camera)]
                code, _, errors = run("host", "--listen", "127.0.0.1:0", "--state", self.state, "--seconds", "1", *words)
                self.assertEqual(code, 1, errors)
                self.assertIn(said, errors)

    def test_metrics_tell_what_every_camera_does(self):
        with host(self.state, self.camera, self.camera) as h, \
                Process("join", h.greeting["link"], "--every", "0.2") as viewer:
            # The figures are tested here, not the machine: `theatron bench pipeline` measures the frame rate of a quiet one
            # (docs/decisions/lanes.md).
            viewer.wait_for(lambda f: all(c["frames"] > 10 for c in f["cameras"]) and len(f["cameras"]) == 2)
            token = self.token(h.greeting)
            first = metrics(h.greeting, token)
            # A busy machine may stall a camera for a moment, but not for good.
            second = wait_until(lambda: self.if_all_went_on(first, metrics(h.greeting, token)))
            for i in (0, 1):
                camera = f'camera="{i}",name="box"'
                self.assertGreater(second["theatron_frames_per_second"][camera], 0)
                self.assertGreater(second["theatron_age_seconds"][camera], 0)
                self.assertLess(abs(second["theatron_sync_offset_seconds"][camera]), 0.02)
                self.assertEqual(second["theatron_reopens_total"][camera], 0)
                for kind in ("depth", "color"):
                    bits = f'{camera},kind="{kind}"'
                    self.assertGreater(second["theatron_bits_total"][bits], first["theatron_bits_total"][bits])
                for stage in ("capture", "queue", "depth_encode", "color_encode", "lane"):
                    labels = f'{camera},stage="{stage}"'
                    count = second["theatron_stage_seconds_count"][labels]
                    self.assertGreater(count, 10)
                    least, most = self.sums_by_buckets(second["theatron_stage_seconds_bucket"], labels, count)
                    self.assertGreaterEqual(second["theatron_stage_seconds_sum"][labels], least)
                    self.assertLessEqual(second["theatron_stage_seconds_sum"][labels], most)
                for reason in ("newer", "moment", "repeated", "time_jump", "slow_receiver"):
                    self.assertIn(f'{camera},reason="{reason}"', second["theatron_frames_dropped_total"])
            self.assertEqual(second["theatron_participants"][""], 1)

    def test_status_shows_the_same_to_people_and_scripts(self):
        with host(self.state, self.camera) as h:
            def camera():
                code, out, errors = run("status", h.greeting["link"], "--json")
                self.assertEqual(code, 0, errors)
                return json.loads(out)["cameras"][0]

            def page():
                code, out, _ = run("status", h.greeting["link"])
                self.assertEqual(code, 0)
                return out
            # On a busy machine a camera is stale for moments.
            wait_until(lambda: (found := camera())["state"] == "live" and found["fps"] > 0)
            wait_until(lambda: re.search(r"box +live +\d", page()))
            for link, expected in ((h.greeting["link"].replace("join=", "join=x"), "token"),
                                   (h.greeting["link"].split("&role=")[0].replace("cert=", "cert=0")[:-1], "certificate")):
                code, _, errors = run("status", link)
                self.assertEqual(code, 1)
                self.assertIn(expected, errors)
        code, _, errors = run("status", h.greeting["link"])
        self.assertEqual(code, 1)
        self.assertIn("does not answer", errors)

    def test_a_camera_that_fails_is_shown_as_stale_and_comes_back(self):
        faulty = self.camera + ",faults=1,faults_every=3"
        with host(self.state, faulty, self.camera) as h, \
                Process("join", h.greeting["link"], "--every", "0.05") as viewer:
            def state(wanted):
                return viewer.wait_for(lambda f: f["cameras"] and f["cameras"][0]["state"] == wanted)
            for _ in range(2):
                self.assertNotEqual(state("stale")["cameras"][0]["problem"], "")
                state("live")
            figures = metrics(h.greeting, self.token(h.greeting))
            troubles = figures["theatron_camera_troubles_total"]
            self.assertGreaterEqual(sum(v for k, v in troubles.items() if 'camera="0"' in k), 2)
            # The other camera went on all the while; only a busy machine can have kept it silent.
            self.assertEqual(sum(v for k, v in troubles.items() if 'camera="1"' in k and "silent" not in k), 0)
            frames = figures["theatron_frames_total"]
            self.assertGreater(frames['camera="1",name="box"'], frames['camera="0",name="box"'])


if __name__ == "__main__":
    unittest.main()
