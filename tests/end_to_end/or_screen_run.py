# SPDX-License-Identifier: Apache-2.0
"""A long meeting before the OR screen, with speakers and pointers that are known.

    python3 tests/end_to_end/or_screen_run.py --minutes 60 --json or_screen.json

Every few seconds the speaker and the pointer change. The program compares the screen's own words with the truth, and
looks at a second OR screen in a window: its memory, and letters or lines that stay where they are for the whole time.
People leave and come again every five minutes. Exit code 1 if the screen showed another speaker or pointer than the true one,
if its memory grew by 16 MB after the first fifth, or if a pixel in a hundred was bright in every picture.
"""
import argparse
import array
import contextlib
import os
import pathlib
import random
import shutil
import tempfile
import time

from theatron_process import Process, host, make_recording, tell_result
from virtual_screen import VirtualScreen
from voice_test import RATE, write_wav

SIZE = (1280, 720)
STAY_SECONDS = 300
STEP_SECONDS = 6
# The display waits for the end of a pause between words, and for the clock's next quarter of a second.
SETTLE_SECONDS = 3
# Rays that meet the wall beside the moving box, in metres; the last one meets nothing that the camera sees.
TARGETS = {"left": "-0.35 1.25 -1.5", "right": "0.4 1.3 -1.5", "middle": "0.1 1.15 -1.6", "outside": "1.2 1.5 0.4"}
SPEAKERS = ["Ben", "Cem"]
MAX_PIXELS_APART = 5
MAX_GROWTH_MB = 16
MAX_FIXED_SHARE = 0.01
BRIGHT = 140


class Truth:
    """The people of the meeting, who do what they are told."""

    def __init__(self, link, folder, stack):
        def join(name, *options):
            person = Process("join", link, "--no-window", "--name", name, *options,
                             env={**os.environ, "XDG_STATE_HOME": str(folder / name)})
            return stack.enter_context(person)

        self.ada = join("Ada")
        self.voices = {name: join(name, "--microphone", folder / f"{name}.wav") for name in SPEAKERS}
        self.speaker, self.target = None, None
        for voice in self.voices.values():
            voice.say("microphone off")

    def change(self, chance):
        self.speaker = chance.choice([None, *SPEAKERS])
        for name, voice in self.voices.items():
            voice.say(f"microphone {'on' if name == self.speaker else 'off'}")
        self.target = chance.choice([None, *TARGETS])
        self.ada.say(f"point 1 1.5 0 {TARGETS[self.target]}" if self.target else "point")


class Comparison:
    def __init__(self):
        self.compared, self.wrong, self.pixels = 0, [], {}

    def compare(self, view, truth, seconds):
        self.compared += 1
        speaking = [p["name"] for p in view["people"] if p["speaks"]]
        wanted = [truth.speaker] if truth.speaker else []
        if speaking != wanted:
            self.wrong.append(f"after {seconds:.0f} s: {speaking} spoke instead of {wanted}")
        is_seen = truth.target not in (None, "outside")
        if len(view["pointers"]) != is_seen:
            self.wrong.append(f"after {seconds:.0f} s: pointers {view['pointers']} for {truth.target}")
        elif is_seen:
            pixel = (view["pointers"][0]["x"], view["pointers"][0]["y"])
            first = self.pixels.setdefault(truth.target, pixel)
            if max(abs(a - b) for a, b in zip(pixel, first)) > MAX_PIXELS_APART:
                self.wrong.append(f"after {seconds:.0f} s: the pointer to {truth.target} was at {pixel} instead of {first}")


def share_of(rows):
    return sum(map(sum, rows)) / sum(map(len, rows))


class Fixed:
    """The pixels that were bright in all pictures so far."""

    def __init__(self):
        self.bright, self.pictures, self.least = None, 0, 1.0

    def add(self, rows):
        bright = [bytearray(value > BRIGHT for value in row[1::4]) for row in rows]
        self.least = min(self.least, share_of(bright))
        self.bright = bright if self.bright is None else [
            bytearray(a & b for a, b in zip(old, new)) for old, new in zip(self.bright, bright)]
        self.pictures += 1

    def share(self):
        return share_of(self.bright) if self.bright else 0


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--minutes", type=float, default=60)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--json")
    options = parser.parse_args()
    chance = random.Random(options.seed)
    folder = pathlib.Path(tempfile.mkdtemp(prefix="theatron_or_screen_run_"))
    for n, name in enumerate(SPEAKERS):
        tone = array.array("h", [6000] * (100 + 20 * n) + [-6000] * (100 + 20 * n))
        write_wav(folder / f"{name}.wav", tone * ((STAY_SECONDS + 60) * RATE // len(tone)))
    camera = f"folder:{make_recording(folder / 'box', width=320, height=240, frames=1)},loop=1,preload=1"
    comparison, fixed, memory = Comparison(), Fixed(), []
    try:
        with host(folder / "state", camera) as h, VirtualScreen(*SIZE) as x11:
            link = h.greeting["link"]
            with Process("join", link, "--or-screen", "--offscreen", folder / "or.png", "--size", "1280x720", "--every",
                         "0.5", "--seconds", str(60 * options.minutes + 120)) as words, \
                    Process("join", link, "--or-screen", env=x11.environment) as window:
                begin = time.monotonic()
                elapsed = lambda: time.monotonic() - begin
                while elapsed() < 60 * options.minutes:
                    with contextlib.ExitStack() as people:
                        truth = Truth(link, folder, people)
                        time.sleep(STEP_SECONDS)
                        came = elapsed()
                        while elapsed() < min(came + STAY_SECONDS, 60 * options.minutes):
                            truth.change(chance)
                            time.sleep(SETTLE_SECONDS)
                            while not words.lines.empty():
                                words.lines.get()
                            comparison.compare(words.read_json()["or_screen"], truth, elapsed())
                            fixed.add(x11.pixels(0, 0, *SIZE))
                            memory.append((elapsed(), window.memory_mb(), words.memory_mb()))
                            print(f"\r{elapsed():.0f} s, {comparison.compared} compared, {len(comparison.wrong)} wrong",
                                  end="", flush=True)
                            time.sleep(STEP_SECONDS - SETTLE_SECONDS)
                if window.process.poll() is not None:
                    comparison.wrong.append("The screen in the window ended by itself.")
    finally:
        shutil.rmtree(folder)
    print()
    settled = [entry for entry in memory if entry[0] >= memory[-1][0] / 5]
    growth = {name: round(settled[-1][column] - settled[0][column], 1) for column, name in ((1, "window"), (2, "file"))}
    result = {"minutes": options.minutes, "seed": options.seed, "compared": comparison.compared,
              "wrong": len(comparison.wrong), "pixels": comparison.pixels, "memory_mb": round(memory[-1][1], 1),
              "growth_mb": growth, "always_bright_share": round(fixed.share(), 5),
              "least_bright_share": round(fixed.least, 5), "pictures": fixed.pictures}
    problems = comparison.wrong[:20]
    problems += [f"The memory of the OR screen ({name}) grew by {mb} MB." for name, mb in growth.items() if mb > MAX_GROWTH_MB]
    if fixed.least == 0:
        problems.append("A picture of the OR screen had no letters.")
    if fixed.share() > MAX_FIXED_SHARE:
        problems.append(f"{fixed.share():.1%} of the pixels were bright in all {fixed.pictures} pictures.")
    raise SystemExit(tell_result(result, problems, options.json))


if __name__ == "__main__":
    main()
