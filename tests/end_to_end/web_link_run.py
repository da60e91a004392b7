# SPDX-License-Identifier: Apache-2.0
"""From opening the link in a browser to the first complete picture, on a shaped link, and what comes then; needs root.

    python3 tests/end_to_end/web_link_run.py --mbit 20 --delay-ms 40 --runs 5 --seconds 10 --json link.json
"""
import argparse
import os
import pathlib
import statistics
import sys
import tempfile
import time

from browser import Browser
from shaped_link import HOST_ADDRESS, ShapedLink, missing
from theatron_process import host, tell_result

CAMERAS = [f"synthetic:seconds=2,fps=30,loop=1,preload=1,quality=quick,camera={i}" for i in (0, 1)]


# Runs before anything is measured.
WATCH = """(() => {
    globalThis.longest_task_ms = 0;
    new PerformanceObserver(list => list.getEntries().forEach(({ duration }) => {
        globalThis.longest_task_ms = Math.max(globalThis.longest_task_ms, duration);
    })).observe({ type: "longtask" });
    theatron.reset_figures();
})()"""


def oldest(cameras, age):
    """None where no frame came."""
    return max((camera[age] for camera in cameras if camera[age] is not None), default=None)


def watch(page, settle_s, seconds):
    """Figures of the slower camera over this time, once the page has had time for its choices."""
    time.sleep(settle_s)
    page.evaluate(WATCH)
    time.sleep(1)  # figures are made ten times a second
    begin, first = time.monotonic(), page.evaluate("theatron.state.cameras")
    time.sleep(seconds)
    last, state = page.evaluate("theatron.state.cameras"), page.evaluate("theatron.state.color")
    passed = time.monotonic() - begin
    grown = {key: min((b[key] - a[key]) / passed for a, b in zip(first, last)) for key in ("depth_frames", "color_frames")}
    return {"depth_per_s": grown["depth_frames"], "color_per_s": grown["color_frames"],
            "mbit_per_s": sum(c["mbit_per_second"] for c in last), "age_p50_ms": oldest(last, "age_p50_ms"),
            "age_p99_ms": oldest(last, "age_p99_ms"), "color_age_p50_ms": oldest(last, "color_age_p50_ms"),
            "color_decode_ms": max(c["color_decode_ms"] for c in last), "color": last[0]["color"],
            "failures": sum(c["decoder_failures"] for c in last), "reason": state["reason"],
            "longest_task_ms": page.evaluate("longest_task_ms")}


def measure(link, chosen, prefix):
    """Seconds to the first complete picture with an empty cache, bytes of the page, and figures of some seconds behind it."""
    with Browser(prefix=prefix) as browser:
        page = browser.open(link + (f"&color={chosen.color}" if chosen.color else ""), chosen.size)
        page.enter(way="room")
        page.wait_for("theatron.complete_ms !== null")
        loaded = {"first_picture_s": page.evaluate("theatron.complete_ms") / 1000, "transferred_bytes": page.bytes}
        return loaded | (watch(page, chosen.settle, chosen.seconds) if chosen.seconds else {})


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--mbit", type=float, default=20)
    parser.add_argument("--delay-ms", type=float, default=40, help="of a round trip")
    parser.add_argument("--runs", type=int, default=5)
    parser.add_argument("--size", type=int, nargs=2, default=(1280, 720), metavar=("WIDTH", "HEIGHT"))
    parser.add_argument("--color", help="the codec that the page asks for; as it chooses if left out")
    parser.add_argument("--settle", type=float, default=12, help="seconds from the first picture to the measurement")
    parser.add_argument("--seconds", type=float, default=0, help="measured time of each run behind the first picture")
    parser.add_argument("--json", help="write the figures to this file, too")
    chosen = parser.parse_args()
    if reason := missing():
        sys.exit(reason)
    with tempfile.TemporaryDirectory() as folder, \
            ShapedLink(f"rate_mbit={chosen.mbit}", f"delay_ms={chosen.delay_ms / 2}") as shaped, \
            host(pathlib.Path(folder) / "host", *CAMERAS, listen=f"{HOST_ADDRESS}:0", prefix=shaped.at_host()) as h:
        runs = [measure(h.greeting["link"], chosen, shaped.at_viewer()) for _ in range(chosen.runs)]
    seconds = [run["first_picture_s"] for run in runs]
    sys.exit(tell_result({"mbit": chosen.mbit, "round_trip_ms": chosen.delay_ms, "first_picture_s": statistics.median(seconds), "runs": runs,
                          "load": os.getloadavg()[0]}, [], chosen.json))


if __name__ == "__main__":
    main()
