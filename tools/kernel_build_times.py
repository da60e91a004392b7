#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Processor seconds and bytes of object code that each instruction set adds to the kernels' compilation.

Compiles each source that Highway compiles once per instruction set (hwy/foreach_target.h) as build/release does, without
ccache: as it is, and once without each of its instruction sets. Processor time, so that other programs disturb it little.
Usage: kernel_build_times.py [PART OF A SOURCE'S NAME...]
"""
import json
import os
import pathlib
import re
import resource
import shlex
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
SETS = ("AVX3_ZEN4", "AVX3_DL", "AVX3", "AVX2", "SSE4", "SSSE3", "SSE2")


def kernels(parts):
    commands = json.loads((ROOT / "build/release/compile_commands.json").read_text())
    for command in commands:
        source = pathlib.Path(command["file"])
        if source.suffix == ".cpp" and "foreach_target.h" in source.read_text() and (not parts or any(p in source.name for p in parts)):
            yield source, command


def compiled(command, without, out):
    """(processor seconds, bytes of code), or None where the compiler refuses."""
    words = [w for w in shlex.split(command["command"])]
    start = next(i for i, w in enumerate(words) if re.search(r"(?:c\+\+|g\+\+|clang\+\+)(?:-\d+)?$", w))
    words = words[start:]
    words[words.index("-o") + 1] = out
    for i, word in enumerate(words):
        if word.startswith("-DHWY_DISABLED_TARGETS="):
            words[i] = ""
    words = [w for w in words if w]
    if without:
        words.insert(1, "-DHWY_DISABLED_TARGETS=(" + "|".join(f"HWY_{w}" for w in without) + ")")
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    if subprocess.run(words, cwd=command["directory"], capture_output=True).returncode:
        return None
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    seconds = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    size = subprocess.run(["size", out], capture_output=True, text=True, check=True).stdout.splitlines()[1].split()
    return seconds, int(size[0])


def main(parts):
    print(f"{'source':34} {'all: s':>8} {'kB':>6}   without each: s saved (kB saved)")
    with tempfile.TemporaryDirectory() as folder:
        out = os.path.join(folder, "kernel.o")
        for source, command in kernels(parts):
            whole = compiled(command, (), out)
            if whole is None:
                print(f"{source.name:34} cannot be compiled")
                continue
            saved = []
            for name in SETS:
                one = compiled(command, (name,), out)
                if one and one[1] != whole[1]:
                    saved.append(f"{name} {whole[0] - one[0]:.1f} ({(whole[1] - one[1]) / 1000:.0f})")
            print(f"{source.name:34} {whole[0]:8.1f} {whole[1] / 1000:6.0f}   {', '.join(saved)}", flush=True)


if __name__ == "__main__":
    main(sys.argv[1:])
