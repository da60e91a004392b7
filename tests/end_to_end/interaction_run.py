# SPDX-License-Identifier: Apache-2.0
"""`theatron bench interaction` over a link with a rate: how long poses wait behind pictures.

    python3 tests/end_to_end/interaction_run.py --rate 10 --rate 50 --camera folder:DIR,loop=1 --json interaction.json
"""
import argparse
import json
import os
import pathlib
import subprocess

from shaped_link import ShapedLink, missing


def run(program, rate_mbit, delay_ms, words):
    with ShapedLink(f"rate_mbit={rate_mbit}", f"delay_ms={delay_ms}", "buffer_ms=1000") as link:
        done = subprocess.run(
            [program, "bench", "interaction", "--json", "-", "--host-namespace", link.names[0],
             "--viewer-namespace", link.names[1], "--link-delay", str(delay_ms), *words],
            check=True, stdout=subprocess.PIPE, text=True)
    return {"link_mbit": rate_mbit, **json.loads(done.stdout)}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", default=os.environ.get("THEATRON", "build/release/apps/theatron/theatron"))
    parser.add_argument("--rate", type=float, action="append", required=True, help="Mbit/s; once for each run")
    parser.add_argument("--delay-ms", type=float, default=10)
    parser.add_argument("--json", help="write the figures to this file")
    flags, words = parser.parse_known_args()
    if why := missing():
        raise SystemExit(why)
    results = [run(flags.program, rate, flags.delay_ms, words) for rate in flags.rate]
    text = json.dumps(results, indent=1)
    print(text)
    if flags.json:
        pathlib.Path(flags.json).write_text(text + "\n")


if __name__ == "__main__":
    main()
