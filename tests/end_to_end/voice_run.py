# SPDX-License-Identifier: Apache-2.0
"""`theatron bench voice` beside cameras, and over a link that has a tenth of what the cameras need.

    python3 tests/end_to_end/voice_run.py --camera folder:DIR,loop=1 --mbit 6 --json voice.json
"""
import argparse
import json
import os
import pathlib
import subprocess

from shaped_link import ShapedLink, missing


def bench(program, *words):
    done = subprocess.run([program, "bench", "voice", "--json", "-", *map(str, words)], check=True,
                          stdout=subprocess.PIPE, text=True)
    return json.loads(done.stdout)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", default=os.environ.get("THEATRON", "build/release/apps/theatron/theatron"))
    parser.add_argument("--camera", action="append", default=[], help="of the host; once for each")
    parser.add_argument("--mbit", type=float, default=3, help="rate of the throttled link")
    parser.add_argument("--delay-ms", type=float, default=10, help="of that link, one way")
    parser.add_argument("--seconds", type=float, default=20)
    parser.add_argument("--json", help="write the figures to this file")
    flags = parser.parse_args()
    cameras = [word for camera in flags.camera for word in ("--camera", camera)]
    result = {}
    for frame in (10, 20):
        result[f"packets_of_{frame}_ms"] = bench(flags.program, "--voice-frame", frame, "--seconds", flags.seconds, *cameras)
    if why := missing():
        result["throttled_ms"] = why
    else:
        with ShapedLink(f"rate_mbit={flags.mbit}", f"delay_ms={flags.delay_ms}", "buffer_ms=1000") as link:
            throttled = bench(flags.program, "--seconds", flags.seconds, *cameras, "--host-namespace", link.names[0],
                              "--listener-namespace", link.names[1])
        result["throttled_ms"] = {"mbit": flags.mbit, "link_delay_ms": flags.delay_ms, **throttled["mouth_to_ear_ms"]}
    text = json.dumps(result, indent=1)
    print(text)
    if flags.json:
        pathlib.Path(flags.json).write_text(text + "\n")


if __name__ == "__main__":
    main()
