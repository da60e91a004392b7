# SPDX-License-Identifier: Apache-2.0
"""Measures the browser client in Chromium, on a host on this machine; docs/browser.md has the results.

    python3 tests/end_to_end/web_run.py [--runs 5] [--seconds 10] [--size 1280x720] [--json FILE]

From opening the link, with an empty cache, to the first complete picture: every camera's depth and colour drawn.
The name is entered by the program. Afterwards, for some seconds: pictures, frames and their ages.
"""
import argparse
import pathlib
import statistics
import tempfile
import time

from browser import Browser
from theatron_process import host, tell_result

ENTER = """new Promise(done => {
    const enter = () => {
        if (!document.getElementById("invitation")?.textContent) return setTimeout(enter, 5);
        document.getElementById("name").value = "Ada";
        document.getElementById("enter").click();
        done();
    };
    enter();
})"""


def measure(link, size, seconds):
    with Browser() as browser:
        page = browser.open(link, size)
        page.wait_for("location.protocol === 'https:'")
        page.evaluate(ENTER)
        page.wait_for("theatron.complete_ms !== null")
        complete_ms = page.evaluate("theatron.complete_ms")
        state = "JSON.parse(JSON.stringify(theatron.state))"
        time.sleep(2)
        first, began = page.evaluate(state), time.monotonic()
        time.sleep(seconds)
        last, lasted = page.evaluate(state), time.monotonic() - began
        frames = [(b["depth_frames"] - a["depth_frames"]) / lasted for a, b in zip(first["cameras"], last["cameras"])]
        return {"first_picture_s": complete_ms / 1000, "transferred_bytes": page.bytes, "cameras": len(frames),
                "fps_min": min(frames), "pictures_per_s": (last["pictures"] - first["pictures"]) / lasted,
                "dropped": sum(b["dropped"] - a["dropped"] for a, b in zip(first["cameras"], last["cameras"])),
                "age_ms_p50": max(camera["age_p50_ms"] for camera in last["cameras"]),
                "renderer": last["renderer"], "problems": page.problems}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--runs", type=int, default=5)
    parser.add_argument("--seconds", type=float, default=10)
    parser.add_argument("--size", default="1280x720")
    parser.add_argument("--fps", type=int, default=30)
    parser.add_argument("--json", help="file for the figures")
    options = parser.parse_args()
    size = tuple(map(int, options.size.split("x")))
    cameras = [f"synthetic:seconds=2,fps={options.fps},camera={i},loop=1,preload=1,quality=quick" for i in (0, 1)]
    with tempfile.TemporaryDirectory() as folder, host(pathlib.Path(folder) / "host", *cameras) as running:
        link = running.greeting["link"]
        runs = [measure(link, size, options.seconds) for _ in range(options.runs)]
    problems = [problem for run in runs for problem in run.pop("problems")]
    result = {key: statistics.median(run[key] for run in runs) if isinstance(runs[0][key], (int, float)) else runs[0][key]
              for key in runs[0]}
    return tell_result(result | {"size": options.size, "runs": len(runs)}, problems, options.json)


if __name__ == "__main__":
    raise SystemExit(main())
