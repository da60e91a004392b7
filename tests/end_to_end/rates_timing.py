# SPDX-License-Identifier: Apache-2.0
"""Rates and ages that are promised, on a machine that does nothing else: medians of three (make test-timing)."""
import json
import pathlib
import shutil
import signal
import statistics
import tempfile
import time
import unittest

import strangers_test
from guests_run import seconds_to_join
from record_faults_test import ENDED_BY_THE_DISK
from slow_disk import SlowDisk
from theatron_process import Process, host, make_recording, run, wait_until


def median_of_three(measure):
    values = sorted(measure() for _ in range(3))
    print(f"measured: {', '.join(f'{value:.2f}' for value in values)}")
    return statistics.median(values)


class Rates(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="theatron_rates_"))
        self.addCleanup(shutil.rmtree, self.folder)
        self.camera = f"folder:{make_recording(self.folder / 'box')},loop=1,preload=1"  # 30 frames a second

    def session(self):
        return host(self.folder / "state", self.camera)

    def test_a_viewer_gets_all_pictures_of_a_camera_and_gets_them_soon(self):
        with self.session() as h:
            def measured(what):
                code, out, errors = run("join", h.greeting["link"], "--no-window", "--warmup", 1, "--seconds", 3, "--json")
                self.assertEqual(code, 0, errors)
                return what(json.loads(out)["cameras"][0])

            self.assertGreater(median_of_three(lambda: measured(lambda c: c["fps"])), 28)
            self.assertLess(median_of_three(lambda: measured(lambda c: c["age_ms"]["p50"])), 150)

    def test_a_published_camera_is_seen_soon(self):
        with self.session() as h, Process("publish", h.greeting["publish_link"], "--camera", self.camera), \
                Process("join", h.greeting["link"], "--every", "0.2") as viewer:
            viewer.wait_for(lambda f: len(f["cameras"]) == 2 and f["cameras"][1]["frames"] > 30)

            def dropped_meanwhile():
                before = viewer.read_json()["cameras"][1]
                after = viewer.wait_for(lambda f: f["cameras"][1]["frames"] > before["frames"] + 30)
                return after["cameras"][1]["dropped"] - before["dropped"]

            self.assertEqual(median_of_three(dropped_meanwhile), 0)
            self.assertLess(median_of_three(lambda: viewer.read_json()["cameras"][1]["newest_age_ms"]), 300)

    def test_a_viewer_that_slept_is_up_to_date_within_a_second(self):
        with self.session() as h, Process("join", h.greeting["link"], "--every", "0.05") as viewer:
            viewer.wait_for(lambda f: f["cameras"] and f["cameras"][0]["frames"] > 20)

            def seconds_to_catch_up():
                viewer.send(signal.SIGSTOP)
                time.sleep(3)
                while not viewer.lines.empty():
                    viewer.lines.get()
                viewer.send(signal.SIGCONT)
                begin = time.monotonic()
                viewer.wait_for(lambda f: f["cameras"][0]["age_now_ms"] < 300)
                return time.monotonic() - begin

            self.assertLess(median_of_three(seconds_to_catch_up), 1)

    def test_one_who_looked_back_is_up_to_date_soon(self):
        with self.session() as h, Process("join", h.greeting["link"], "--every", "0.05") as viewer:
            viewer.wait_for(lambda f: f["cameras"] and f["cameras"][0]["frames"] > 100)

            def seconds_to_the_present():
                viewer.say("back 2")
                viewer.wait_for(lambda f: f["cameras"][0]["past"])
                viewer.say("live")
                begin = time.monotonic()
                viewer.wait_for(lambda f: not f["cameras"][0]["past"] and f["cameras"][0]["age_now_ms"] < 300)
                return time.monotonic() - begin

            self.assertLess(median_of_three(seconds_to_the_present), 1.5)

    def test_a_full_disk_is_told_within_two_seconds(self):
        disk = SlowDisk(self.folder)

        def seconds_to_the_end():
            disk.be("well")
            file = disk.folder / "full.mkv"
            with Process("record", "--camera", self.camera, file, "--overwrite", "--json", env=disk.environment) as recorder:
                wait_until(lambda: file.exists() and file.stat().st_size > 10_000)
                disk.be("full")
                begin = time.monotonic()
                self.assertEqual(recorder.end(), ENDED_BY_THE_DISK)
                return time.monotonic() - begin

        self.assertLess(median_of_three(seconds_to_the_end), 2)


class BesideStrangers(strangers_test.StrangersCase):
    """A person with a link is in within two seconds, beside strangers who open connections or begin handshakes."""

    def enter(self, link):
        self.assertLess(median_of_three(lambda: seconds_to_join(link)), 2)

    def test_idle_sockets_and_new_ones_all_the_time(self):
        self.idle_sockets_and_new_ones_all_the_time()

    def test_handshakes_that_go_nowhere(self):
        self.handshakes_that_go_nowhere()


if __name__ == "__main__":
    unittest.main()
