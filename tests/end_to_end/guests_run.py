# SPDX-License-Identifier: Apache-2.0
"""Frame rate of one viewer while strangers and expensive guests are on its host.

    python3 tests/end_to_end/guests_run.py --seconds 30 --json guests.json

Three phases of the same session, each with one viewer that has default settings: alone; beside 500 idle sockets and 100
new connections a second without a token; beside four guests with the most expensive codec settings. Exit code 1 if the
viewer gets less than 29.5 pictures a second, if a new viewer needs 2 s or more, or if the host grows by 32 MB.
"""
import argparse
import contextlib
import json
import pathlib
import shutil
import tempfile
import time

from raw_peer import RawPeer
from strangers_test import Connections
from theatron_process import Process, host, run, tell_result

EXPENSIVE = ["zstd:delta=1,level=19", "zstd:level=19", "zstd:delta=1,level=18", "lz4:level=12"]
LOWEST_FPS = 29.5


def seconds_to_join(link, **fields):
    begin = time.monotonic()
    with RawPeer(link) as peer:
        peer.join(**fields)
        kind, answer = peer.receive_control("Welcome", "Refused")
        if kind != "Welcome":
            raise ValueError(answer["in_english"])
        return time.monotonic() - begin


def rate_of_viewer(link, seconds):
    """Pictures a second of each camera, as its own figures say."""
    code, out, errors = run("join", link, "--no-window", "--json", "--warmup", "2", "--seconds", str(seconds))
    if code != 0:
        raise SystemExit(errors)
    return json.loads(out)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seconds", type=int, default=30)
    parser.add_argument("--camera", default="synthetic:seconds=5,preload=1", help="a camera of 30 frames a second")
    parser.add_argument("--json")
    options = parser.parse_args()

    folder = pathlib.Path(tempfile.mkdtemp(prefix="theatron_guests_run_"))
    result, problems = {"camera": options.camera, "seconds": options.seconds}, []

    def measure(phase, link):
        figures = rate_of_viewer(link, options.seconds)
        result[phase] = {"fps": figures["fps"], "codec": figures["codec"]}
        if figures["fps"] < LOWEST_FPS:
            problems.append(f"{phase}: {figures['fps']:.2f} pictures a second")

    try:
        with host(folder / "state", options.camera) as h:
            link = h.greeting["link"]
            measure("alone", link)
            memory = h.memory_mb()
            with Connections(link) as strangers:
                strangers.open(500)
                strangers.keep_opening(per_second=100)
                measure("strangers", link)
                took = [seconds_to_join(link) for _ in range(10)]
                result["strangers"] |= {"join_s": max(took), "host_grew_mb": h.memory_mb() - memory}
                if max(took) >= 2:
                    problems.append(f"a new viewer needed {max(took):.1f} s")
                if h.memory_mb() - memory >= 32:
                    problems.append("the host grew")
            with contextlib.ExitStack() as guests:
                for codec in EXPENSIVE:
                    guests.enter_context(Process("join", link, "--no-window", "--depth-codec", codec, "--every", "1"))
                measure("expensive_guests", link)
    finally:
        shutil.rmtree(folder)
    return tell_result(result, problems, options.json)


if __name__ == "__main__":
    raise SystemExit(main())
