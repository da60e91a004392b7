# SPDX-License-Identifier: Apache-2.0
"""Recorders over a link that breaks at random, beside recorders with a good one and a host that is killed twice.

    python3 tests/end_to_end/breaks_run.py --minutes 20 --json breaks.json

Four recorders record one camera. The first one's connection breaks every `--every` seconds on average, only at its own
side, so that the host still has the dead one; its link expires after eleven seconds. The others' link is good and lasts.
The host is killed and started again after one and two thirds of the time. Exit code 1 if a recording has less than its
recorder received, if something that is missing is not named, or if exit code and `inspect --verify` disagree.
"""
import argparse
import json
import pathlib
import random
import shutil
import signal
import tempfile
import time

from pulled_cable import PulledCable
from theatron_process import Process, host, make_recording, run, tell_result

COMPLETE, INCOMPLETE = 0, 3
LINK_HOURS = "0.003"
NAMES = ("breaks", "good 1", "good 2", "good 3")


def expiring_link(state):
    code, out, errors = run("link", "--role", "expert", "--hours", LINK_HOURS, "--state", state)
    if code != 0:
        raise SystemExit(errors)
    return next(word for word in (out + errors).split() if word.startswith("https://"))


def judge(name, file, figures, code):
    """What is wrong with a recording, and its counts."""
    depth = figures["cameras"][0]["depth"]
    listed = json.loads(run("inspect", file, "--json")[1])["cameras"][0]["depth"]
    verified, out, errors = run("inspect", file, "--verify")
    counts = {"received": depth["pictures"], "in_file": listed["frames"], "lost": depth["lost"],
              "dropped": depth["dropped"], "interruptions": depth["interruptions"], "exit": code, "verify": verified}
    problems = []
    if depth["pictures"] != listed["frames"]:
        problems.append(f"{name}: {depth['pictures']} pictures came, {listed['frames']} are in the recording")
    if depth["dropped"]:
        problems.append(f"{name}: {depth['dropped']} pictures came and were not written")
    if code != verified:
        problems.append(f"{name}: record ended with {code}, inspect --verify with {verified}: {out}{errors}")
    # Nobody knows how many pictures a host made that was started again meanwhile: that is an interruption.
    is_named = depth["lost"] > 0 or depth["interruptions"] > 0
    if code != (INCOMPLETE if is_named else COMPLETE):
        problems.append(f"{name}: {depth['lost']} pictures and {depth['interruptions']} interruptions, and record ended with {code}")
    if listed["missing"] > depth["lost"]:
        problems.append(f"{name}: {listed['missing']} numbers are missing, and {depth['lost']} are named")
    return counts, problems


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--minutes", type=float, default=2)
    parser.add_argument("--every", type=float, default=5, help="seconds between two breaks, on average")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--json")
    options = parser.parse_args()
    random_ = random.Random(options.seed)
    folder = pathlib.Path(tempfile.mkdtemp(prefix="theatron_breaks_run_"))
    state, files = folder / "state", [folder / f"{n}.mkv" for n in range(len(NAMES))]
    camera = f"folder:{make_recording(folder / 'source', 160, 120, 6, color=False)},loop=1,preload=1"
    breaks, restarts, recorders = 0, 0, []
    h = host(state, camera)
    port = h.greeting["port"]
    try:
        with PulledCable(h.greeting["link"]) as cable:
            links = [cable.through(expiring_link(state))] + 3 * [h.greeting["link"]]
            for link, file in zip(links, files):
                recorders.append(Process("record", link, file, "--json"))
                recorders[-1].wait_until(lambda: file.exists() and file.stat().st_size > 3000)
            begin = time.monotonic()
            length = options.minutes * 60
            restart_at = [length / 3, 2 * length / 3]
            while (now := time.monotonic() - begin) < length:
                time.sleep(min(random_.expovariate(1 / options.every), length - now))
                if restart_at and time.monotonic() - begin >= restart_at[0]:
                    restart_at.pop(0)
                    h.send(signal.SIGKILL)
                    h.end()
                    h.__exit__()
                    h = host(state, camera, listen=f"127.0.0.1:{port}")
                    restarts += 1
                cable.pull()
                breaks += 1
            time.sleep(3)  # a break just before the end is not what is measured
            figures, codes = [], []
            for recorder in recorders:
                recorder.send(signal.SIGINT)
                figures.append(recorder.read_json())
                codes.append(recorder.end())
        result, problems = {"minutes": options.minutes, "pulled": breaks, "restarted": restarts}, []
        for name, file, one, code in zip(NAMES, files, figures, codes):
            result[name], found = judge(name, file, one, code)
            problems += found
        h.send(signal.SIGINT)
        h.end()
    finally:
        h.__exit__()
        for recorder in recorders:
            recorder.__exit__()
        shutil.rmtree(folder)
    raise SystemExit(tell_result(result, problems, options.json))


if __name__ == "__main__":
    main()
