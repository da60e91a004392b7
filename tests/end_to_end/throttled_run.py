# SPDX-License-Identifier: Apache-2.0
"""One viewer on a link that becomes slow for a while: its figures, second by second.

    python3 tests/end_to_end/throttled_run.py --camera folder:DIR,loop=1 --need 40 --json throttled.json
"""
import argparse
import json
import pathlib
import shutil
import tempfile
import time

from shaped_link import HOST_ADDRESS, ShapedLink, missing
from theatron_process import Process, host


def percentile(values, q):
    return sorted(values)[round(q * (len(values) - 1))] if values else float("inf")


class Sample:
    """The viewer's figures `at` seconds after the run began."""

    def __init__(self, at, figures):
        self.at = at
        self.level = figures["level"]
        self.sent = figures["sent"]
        self.reason = figures["level_reason"]
        self.exact = [camera["depth_exact"] for camera in figures["cameras"]]
        self.mbit = figures["mbit_per_s"]
        self.fps = figures["fps"]
        self.ages = [camera["newest_age_ms"] for camera in figures["cameras"]]
        self.shown_ages = [camera["age_now_ms"] for camera in figures["cameras"]]
        self.frames = [camera["frames"] for camera in figures["cameras"]]
        self.age_max = figures["age_ms"]["max"]


def measure_need(state, cameras, arguments):
    """Mbit/s of a viewer whose link is no limit."""
    with host(state, *cameras) as h, \
            Process("join", h.greeting["link"], "--target-latency", "0", "--warmup", "1", "--seconds", "3", "--json",
                    *arguments) as viewer:
        return viewer.read_json()["mbit_per_s"]


def run(state, cameras, link, before, slow, after, arguments=(), priority=(), host_options=()):
    """Returns the samples of a run with the given link settings before, while slow, and after."""
    settings = [*link, "--at", before, *slow_settings(slow), "--at", before + slow["seconds"], "rate=100%"]
    samples = []
    with ShapedLink(*settings, priority=priority) as shaped, \
            host(state, *cameras, listen=f"{HOST_ADDRESS}:0", options=host_options,
                 prefix=[*shaped.at_host(), *priority]) as h, \
            Process("join", h.greeting["link"], "--every", "0.05", *arguments,
                    prefix=[*shaped.at_viewer(), *priority]) as viewer:
        viewer.wait_for(lambda f: f["fps"] > 0)
        time.sleep(1)
        shaped.begin()
        begin = time.monotonic()
        end = before + slow["seconds"] + after
        while not viewer.lines.empty():
            viewer.lines.get()
        while time.monotonic() - begin < end:
            figures = viewer.read_json()
            samples.append(Sample(time.monotonic() - begin, figures))
    return samples


def slow_settings(slow):
    return [f"rate={slow['percent']}%"]


def summary(samples, before, slow_seconds):
    """The figures that matter, ages in ms, for the camera that is worst."""
    def within(start, end):
        return [s for s in samples if start <= s.at < end]

    def ages(part):
        return [max(s.ages) for s in part]

    def shown(part):
        return [max(s.shown_ages) for s in part]

    def longest_pause(part):
        longest, last, frames = 0, None, None
        for s in part:
            if last is None or min(b - a for a, b in zip(frames, s.frames)) > 0:
                longest = max(longest, s.at - last if last is not None else 0)
                last, frames = s.at, s.frames
        return max(longest, part[-1].at - last) if part else float("inf")

    back = before + slow_seconds
    quiet, slow = within(0.5, before), within(before, back)
    late, recovered = within(before + 1, back), within(back + 3, 1e9)
    throttled_and_after = within(before, 1e9)
    changes = sum(a.level != b.level for a, b in zip(samples, samples[1:]))
    return {
        "age_before_p50_ms": percentile(ages(quiet), 0.5), "age_before_p95_ms": percentile(ages(quiet), 0.95),
        "age_slow_p50_ms": percentile(ages(late), 0.5), "age_slow_p95_ms": percentile(ages(late), 0.95),
        "shown_slow_p95_ms": percentile(shown(late), 0.95),
        "shown_recovered_p95_ms": percentile(shown(recovered), 0.95),
        "age_max_ms": max(ages(throttled_and_after), default=float("inf")),
        "longest_pause_ms": 1000 * longest_pause(slow),
        "exact_slow": sorted({e for s in slow for e in s.exact}),
        "fps_slow": percentile([s.fps for s in late], 0.5), "mbit_slow": percentile([s.mbit for s in late], 0.5),
        "level_slow": percentile([s.level for s in late], 0.5), "level_slow_max": max(s.level for s in slow),
        "age_recovered_p50_ms": percentile(ages(recovered), 0.5),
        "age_recovered_p95_ms": percentile(ages(recovered), 0.95),
        "level_end": samples[-1].level, "fps_end": samples[-1].fps, "level_changes": changes,
    }


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--camera", action="append", required=True)
    parser.add_argument("--need", type=float, help="Mbit/s that the cameras take (default: measured first)")
    parser.add_argument("--link", type=float, default=2, help="the link's rate, in needs")
    parser.add_argument("--slow", type=float, default=0.25, help="the slow link's rate, in needs")
    parser.add_argument("--slow-seconds", type=float, default=10)
    parser.add_argument("--before", type=float, default=8)
    parser.add_argument("--after", type=float, default=15)
    parser.add_argument("--delay-ms", type=float, default=30)
    parser.add_argument("--buffer-ms", type=float, default=1000, help="of the network in front of its rate")
    parser.add_argument("--loss", type=float, default=0, help="percent of packets")
    parser.add_argument("--priority", help="a command to run host and viewer with, such as 'chrt -r 5'", default="")
    parser.add_argument("--join", help="further words for theatron join", default="")
    parser.add_argument("--host", help="further words for theatron host", default="")
    parser.add_argument("--samples", help="write every sample to this CSV file")
    parser.add_argument("--json", help="write the figures to this file")
    flags = parser.parse_args()
    if why := missing():
        raise SystemExit(why)

    state = pathlib.Path(tempfile.mkdtemp(prefix="theatron_throttled_"))
    try:
        need = flags.need or measure_need(state, flags.camera, flags.join.split())
        rate = flags.link * need
        link = [f"delay_ms={flags.delay_ms}", f"rate_mbit={rate}", f"buffer_ms={flags.buffer_ms}",
                f"loss={flags.loss}%"]
        slow = {"seconds": flags.slow_seconds, "percent": 100 * flags.slow / flags.link}
        samples = run(state, flags.camera, link, flags.before, slow, flags.after, flags.join.split(),
                      flags.priority.split(), flags.host.split())
    finally:
        shutil.rmtree(state)
    figures = {"need_mbit": need, "link_mbit": rate, "slow_mbit": flags.slow * need,
               **summary(samples, flags.before, flags.slow_seconds)}
    if flags.samples:
        with open(flags.samples, "w") as out:
            out.write("at_s,age_ms,level,fps,mbit_per_s,frames,reason\n")
            for s in samples:
                out.write(f"{s.at:.2f},{max(s.ages):.1f},{s.level},{s.fps:.1f},{s.mbit:.1f},{min(s.frames)},"
                          f"\"{s.sent}: {s.reason}\"\n")
    text = json.dumps(figures, indent=1)
    print(text)
    if flags.json:
        pathlib.Path(flags.json).write_text(text + "\n")


if __name__ == "__main__":
    main()
