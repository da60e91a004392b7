# SPDX-License-Identifier: Apache-2.0
"""From opening the link in a browser to the first complete picture, on a shaped link; needs root.

    python3 tests/end_to_end/web_link_run.py --mbit 20 --delay-ms 40 --runs 5 --json link.json
"""
import argparse
import os
import pathlib
import statistics
import sys
import tempfile

from browser import Browser
from shaped_link import HOST_ADDRESS, ShapedLink, missing
from theatron_process import host, tell_result

CAMERAS = [f"synthetic:seconds=2,fps=30,loop=1,preload=1,quality=quick,camera={i}" for i in (0, 1)]


def measure(link, size, prefix):
    """Seconds to the first complete picture with an empty cache, and bytes of the page."""
    with Browser(prefix=prefix) as browser:
        page = browser.open(link, size)
        page.enter()
        page.wait_for("theatron.complete_ms !== null", 120)
        return page.evaluate("theatron.complete_ms") / 1000, page.bytes


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--mbit", type=float, default=20)
    parser.add_argument("--delay-ms", type=float, default=40, help="of a round trip")
    parser.add_argument("--runs", type=int, default=5)
    parser.add_argument("--size", type=int, nargs=2, default=(1280, 720), metavar=("WIDTH", "HEIGHT"))
    parser.add_argument("--json", help="write the figures to this file, too")
    chosen = parser.parse_args()
    if reason := missing():
        sys.exit(reason)
    with tempfile.TemporaryDirectory() as folder, \
            ShapedLink(f"rate_mbit={chosen.mbit}", f"delay_ms={chosen.delay_ms / 2}") as shaped, \
            host(pathlib.Path(folder) / "host", *CAMERAS, listen=f"{HOST_ADDRESS}:0", prefix=shaped.at_host()) as h:
        runs = [measure(h.greeting["link"], chosen.size, shaped.at_viewer()) for _ in range(chosen.runs)]
    seconds = [run[0] for run in runs]
    sys.exit(tell_result({"mbit": chosen.mbit, "round_trip_ms": chosen.delay_ms, "runs_s": seconds,
                          "first_picture_s": statistics.median(seconds), "transferred_bytes": runs[0][1],
                          "load": os.getloadavg()[0]}, [], chosen.json))


if __name__ == "__main__":
    main()
