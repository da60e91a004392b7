# SPDX-License-Identifier: Apache-2.0
"""A viewer on a link that becomes slow for a while. Bounds are wide, for busy machines; throttled_run.py measures."""
import pathlib
import shutil
import tempfile
import unittest

from lossy_run import system_congestion_control
from shaped_link import missing
from theatron_process import make_recording
from throttled_run import run, summary

BEFORE, SLOW, AFTER = 2, 4, 6
# 160x120 uncompressed: 38.4 kB of depth and 57.6 kB of colour thirty times a second.
NEED_MBIT = 23.6


class ShapedLink(unittest.TestCase):
    def setUp(self):
        if why := missing():
            self.skipTest(why)
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="theatron_e2e_"))
        self.addCleanup(shutil.rmtree, self.folder)

    def test_a_slow_link_gets_fewer_but_new_pictures_and_then_all_again(self):
        camera = f"folder:{make_recording(self.folder / 'box')},loop=1,preload=1"
        samples = run(self.folder / "state", [camera], ["delay_ms=30", f"rate_mbit={2 * NEED_MBIT}"], BEFORE,
                      {"seconds": SLOW, "percent": 12.5}, AFTER,
                      ["--depth-codec", "raw", "--color-codec", "raw"])
        figures = summary(samples, BEFORE, SLOW)
        self.assertLess(figures["longest_pause_ms"], 2000, figures)
        self.assertLess(figures["age_slow_p95_ms"], 800, figures)
        self.assertGreaterEqual(figures["level_slow_max"], 2, figures)
        self.assertLess(figures["age_recovered_p50_ms"], 300, figures)
        self.assertLess(figures["level_end"], figures["level_slow_max"], figures)
        slowest = max(samples, key=lambda s: s.level)
        self.assertIn("frames", slowest.sent)
        self.assertNotEqual(slowest.reason, "")

    def test_a_link_that_loses_packets_carries_the_pictures_all_the_same(self):
        if "bbr" not in pathlib.Path("/proc/sys/net/ipv4/tcp_available_congestion_control").read_text().split():
            self.skipTest("this kernel offers no BBR: modprobe tcp_bbr")
        camera = f"folder:{make_recording(self.folder / 'box')},loop=1,preload=1"
        with system_congestion_control("cubic"):
            samples = run(self.folder / "state", [camera],
                          ["delay_ms=20", f"rate_mbit={2 * NEED_MBIT}", "loss=1%"], 10, {"seconds": 1, "percent": 100}, 10,
                          ["--depth-codec", "raw", "--color-codec", "raw"])
        later = [s for s in samples if s.at > 8]
        # Half or all of the pictures come, by the policy's step at the time; by CUBIC, and with gaps as queues, seven.
        self.assertGreater(sorted(s.fps for s in later)[len(later) // 2], 12)
        self.assertLess(sorted(max(s.ages) for s in later)[len(later) // 2], 120)


if __name__ == "__main__":
    unittest.main()
