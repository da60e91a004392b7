# SPDX-License-Identifier: Apache-2.0
"""Twelve cameras that fail in every way, for minutes: nothing grows, nothing stays stuck.

    python3 tests/end_to_end/care_run.py --minutes 10 --json care.json
"""
import argparse
import pathlib
import shutil
import tempfile
import time

from care_test import metrics
from theatron_process import Process, host, make_recording, tell_result

# The longest fault lasts 3 s, and a camera that returns is found at most 2 s later; the rest is for busy machines.
LONGEST_STALE = 6.5


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--minutes", type=float, default=10)
    parser.add_argument("--cameras", type=int, default=12)
    parser.add_argument("--every", type=int, default=10, help="seconds from one fault of a camera to its next")
    parser.add_argument("--json")
    options = parser.parse_args()

    folder = pathlib.Path(tempfile.mkdtemp(prefix="theatron_care_run_"))
    recording = make_recording(folder / "box", width=96, height=72)
    cameras = [f"folder:{recording},loop=1,preload=1,faults={i + 1},faults_every={options.every}"
               for i in range(options.cameras)]
    memory, viewer_memory, longest, stale_since, seen = [], [], 0.0, {}, [0.0] * options.cameras
    problems = []
    try:
        with host(folder / "state", *cameras) as h, \
                Process("join", h.greeting["link"], "--every", "0.1") as viewer:
            token = (folder / "state" / "metrics.token").read_text().strip()
            begin = time.monotonic()
            next_memory = begin + 20
            while time.monotonic() < begin + 60 * options.minutes:
                figures = viewer.newest_json()
                now = time.monotonic()
                for i, camera in enumerate(figures["cameras"]):
                    if camera["state"] == "live":
                        stale_since.pop(i, None)
                        continue
                    first = stale_since.setdefault(i, now)
                    seen[i] = now
                    if now - first > longest:
                        longest = now - first
                if now > next_memory:
                    memory.append(h.memory_mb())
                    viewer_memory.append(viewer.memory_mb())
                    next_memory += 10
                time.sleep(0.05)
            end = metrics(h.greeting, token)
    finally:
        shutil.rmtree(folder)

    def of(name, camera, extra=""):
        return sum(value for labels, value in end["theatron_" + name].items()
                   if labels.startswith(f'camera="{camera}",') and extra in labels)

    seconds = 60 * options.minutes
    kinds = ("silent", "repeating", "time_jump", "gone")
    result = {
        "cameras": options.cameras, "seconds": seconds,
        "troubles": {kind: sum(of("camera_troubles_total", i, f'kind="{kind}"') for i in range(options.cameras))
                     for kind in kinds},
        "reopens": sum(of("reopens_total", i) for i in range(options.cameras)),
        "fps_of_slowest": min(of("frames_total", i) for i in range(options.cameras)) / seconds,
        "longest_stale_seen_s": longest,
        "host_memory_mb": [memory[0], memory[-1]] if memory else [],
        "viewer_memory_mb": [viewer_memory[0], viewer_memory[-1]] if viewer_memory else [],
    }
    if longest > LONGEST_STALE:
        problems.append(f"a camera was stale for {longest:.1f} s")
    if min(result["troubles"].values()) == 0 and options.minutes >= 2:
        problems.append("not every kind of trouble was seen")
    if memory and memory[-1] - memory[0] > 16:
        problems.append("the host grows")
    if viewer_memory and viewer_memory[-1] - viewer_memory[0] > 16:
        problems.append("the viewer grows")
    if result["fps_of_slowest"] < 20:
        problems.append("a camera lost more than its faults explain")
    return tell_result(result, problems, options.json)


if __name__ == "__main__":
    raise SystemExit(main())
