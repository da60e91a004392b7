# SPDX-License-Identifier: Apache-2.0
"""Pictures, poses and voice over links that lose packets, and whose delay varies: one row for each kind of link.

    python3 tests/end_to_end/lossy_run.py --camera folder:DIR,loop=1,preload=1 --rate 60 --json lossy.json
    python3 tests/end_to_end/lossy_run.py --camera ... --program OTHER/theatron --control cubic    # another build beside it

Poses and voice are later than the link's delay by these times; "alone": poses at somebody who takes no pictures.
The system sends by CUBIC unless --control says otherwise; the program takes BBR for its own sockets where the kernel has it.
"""
import argparse
import contextlib
import json
import os
import pathlib
import subprocess

from shaped_link import ShapedLink, missing

LINKS = {
    "none": [],
    "0.1 % by chance": ["loss=0.1%"],
    "0.5 % by chance": ["loss=0.5%"],
    "1 % by chance": ["loss=1%"],
    "3 % by chance": ["loss=3%"],
    "1 % in bursts of 4": ["loss=1%", "burst=4"],
    "3 % in bursts of 4": ["loss=3%", "burst=4"],
    "up to 10 ms more delay": ["jitter_ms=10"],
    "1 % by chance, up to 10 ms more delay": ["loss=1%", "jitter_ms=10"],
}
COLUMNS = ("fps", "mbit_per_s", "age_p50_ms", "age_p99_ms", "poses_p50_ms", "poses_p99_ms", "alone_p50_ms",
           "alone_p99_ms", "voice_p50_ms", "voice_p95_ms", "concealed_percent")


def bench(program, *words):
    done = subprocess.run([program, "bench", *map(str, words), "--json", "-"], check=True, stdout=subprocess.PIPE, text=True)
    return json.loads(done.stdout)


@contextlib.contextmanager
def system_congestion_control(name):
    """The machine's choice for namespaces that are made meanwhile; a program may choose another for its sockets."""
    setting = pathlib.Path("/proc/sys/net/ipv4/tcp_congestion_control")
    before = setting.read_text()
    setting.write_text(name)
    try:
        yield
    finally:
        setting.write_text(before)


def measure(flags, settings):
    cameras = [word for camera in flags.camera for word in ("--camera", camera)]
    shape = [f"delay_ms={flags.delay_ms}", f"rate_mbit={flags.rate}", f"buffer_ms={flags.buffer_ms}", *settings]
    with system_congestion_control(flags.control), ShapedLink(*shape, priority=flags.priority.split()) as link:
        seen = bench(flags.program, "interaction", *cameras, "--people", 1, "--seconds", flags.seconds, "--warmup", 4,
                     "--host-namespace", link.names[0], "--viewer-namespace", link.names[1], "--link-delay", flags.delay_ms)
        heard = bench(flags.program, "voice", *cameras, "--seconds", flags.seconds, "--host-namespace", link.names[0],
                      "--listener-namespace", link.names[1])["mouth_to_ear_ms"]
    pictures, alone = seen["pictures"], seen.get("poses_without_pictures_ms", {"p50": None, "p99": None})
    return {
        "fps": pictures["fps_min"], "mbit_per_s": pictures["mbit_per_s"], "age_p50_ms": pictures["age_ms"]["p50"],
        "age_p99_ms": pictures["age_ms"]["p99"], "poses_p50_ms": seen["p50_ms"], "poses_p99_ms": seen["p99_ms"],
        "alone_p50_ms": alone["p50"], "alone_p99_ms": alone["p99"], "voice_p50_ms": heard["p50"] - flags.delay_ms,
        "voice_p95_ms": heard["p95"] - flags.delay_ms,
        "concealed_percent": heard.get("concealed", {}).get("percent"),
    }


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", default=os.environ.get("THEATRON", "build/release/apps/theatron/theatron"))
    parser.add_argument("--camera", action="append", required=True)
    parser.add_argument("--link", action="append", choices=LINKS, help="only this kind; may be repeated")
    parser.add_argument("--control", default="cubic", help="the system's congestion control at both ends")
    parser.add_argument("--rate", type=float, default=60, help="of the link, Mbit/s")
    parser.add_argument("--delay-ms", type=float, default=20, help="of the link, one way")
    parser.add_argument("--buffer-ms", type=float, default=200, help="of the network in front of its rate")
    parser.add_argument("--seconds", type=float, default=20, help="of each figure")
    parser.add_argument("--priority", help="a command to run the link with, such as 'chrt -r 5'", default="")
    parser.add_argument("--json", help="write the figures to this file")
    flags = parser.parse_args()
    if why := missing():
        raise SystemExit(why)
    print("| loss |", " | ".join(COLUMNS), "|")
    print("|---|" + "---|" * len(COLUMNS))
    rows = {}
    for name in flags.link or LINKS:
        rows[name] = measure(flags, LINKS[name])
        figures = ["" if rows[name][c] is None else f"{rows[name][c]:.1f}" for c in COLUMNS]
        print(f"| {name} |", " | ".join(figures), "|", flush=True)
    if flags.json:
        pathlib.Path(flags.json).write_text(json.dumps({"control": flags.control, "rows": rows}, indent=1) + "\n")


if __name__ == "__main__":
    main()
