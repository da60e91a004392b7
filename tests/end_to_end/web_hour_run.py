# SPDX-License-Identifier: Apache-2.0
"""An hour of use in some minutes: a page in a session whose people and cameras come and go, and whose person enters and
leaves the headset, ten times as often as in use. Memory of the page and objects of GL must not grow: lines through the
figures of the rounds are nearly level.

    python3 tests/end_to_end/web_hour_run.py --minutes 6 --json hour.json
"""
import argparse
import contextlib
import os
import pathlib
import random
import statistics
import sys
import tempfile
import time

from browser import Browser
from theatron_process import Process, host, tell_result

HERE = pathlib.Path(__file__).parent
IWER = HERE / "node_modules/iwer/build/iwer.min.js"
CAMERA = "synthetic:seconds=2,fps=10,quality=quick,loop=1"
OTHER = "synthetic:seconds=2,fps=10,quality=quick,loop=1,camera=1"

# Growth that is allowed behind the first third of the rounds: once, as figures differ from round to round and the browser
# compiles functions late, and with each round.
MOST_GROWTH = {"program_bytes": (0, 0), "script_bytes": (150_000, 2000), "nodes": (200, 1), "listeners": (10, 0.1)}

# Objects of WebGL that were made and not deleted. Runs before the page's own scripts.
COUNT_OBJECTS = """(() => {
    const alive = globalThis.gl_objects = {};
    for (const kind of ["Buffer", "Texture", "Framebuffer", "Renderbuffer", "VertexArray", "Program", "Shader", "Sampler", "Query"]) {
        const { [`create${kind}`]: create, [`delete${kind}`]: remove } = WebGL2RenderingContext.prototype;
        const known = new Set();
        Object.defineProperty(alive, kind, { enumerable: true, get: () => known.size });
        WebGL2RenderingContext.prototype[`create${kind}`] = function (...input) {
            const made = create.apply(this, input);
            known.add(made);
            return made;
        };
        WebGL2RenderingContext.prototype[`delete${kind}`] = function (object) {
            known.delete(object);
            return remove.call(this, object);
        };
    }
})()"""


class Use:
    """The page's person and the others. Each act leaves the session as it was."""

    def __init__(self, page, links):
        self.page, self.links = page, links
        self.acts = [self.somebody_comes, self.camera_comes, self.headset, self.other_codec, self.other_way, self.enters_again]
        self.counts = {act.__name__: 0 for act in self.acts}

    def run(self, act):
        act()
        self.counts[act.__name__] += 1

    def wait_for(self, condition):
        return self.page.wait_for(condition)

    def people(self, number):
        self.wait_for(f"theatron.state.people?.length === {number}")

    def key(self, key, code):
        self.page.evaluate("document.getElementById('view').focus()")
        self.page.press(key, code)

    def somebody_comes(self):
        with Process("join", self.links["expert"], "--name", "Ben", "--every", "1"):
            self.people(2)
        self.people(1)

    def camera_comes(self):
        with Process("publish", self.links["publisher"], "--camera", OTHER, "--name", "Eve"):
            self.wait_for("theatron.state.cameras.length === 2 && theatron.state.cameras[1].depth_frames > 0")
        self.wait_for("theatron.state.cameras.length === 1")

    def headset(self):
        self.wait_for("!document.getElementById('enter_vr').hidden")
        self.page.evaluate("document.getElementById('enter_vr').click()")
        self.wait_for("theatron.headset.is_on")
        seen = self.page.evaluate("simulated_headset.frames")
        self.wait_for(f"simulated_headset.frames > {seen + 3}")
        self.page.evaluate("theatron.headset.leave()")
        self.wait_for("!theatron.headset.is_on")

    def other_codec(self):
        self.key("c", "KeyC")
        frames = self.page.evaluate("theatron.state.cameras[0].depth_frames")
        self.wait_for(f"theatron.state.cameras[0].depth_frames > {frames + 3}")

    def other_way(self):
        for renderer in ("flat", ""):
            self.page.evaluate("document.getElementById('other_way').click()")
            self.wait_for(f"theatron.state.has_picture && (theatron.state.renderer === 'flat') === {'true' if renderer else 'false'}"
                          " && theatron.state.pictures > 2")

    def enters_again(self):
        self.page.evaluate("document.getElementById('leave').click()")
        self.wait_for("theatron.state.phase === 'left'")
        self.page.evaluate("document.getElementById('enter').click()")
        self.wait_for("theatron.state.has_picture && theatron.state.cameras[0].depth_frames > 3")


def measure(page):
    """The figures that must not grow, with garbage collected."""
    page.call("HeapProfiler.collectGarbage")
    return {"program_bytes": page.evaluate("theatron.memory()"), "script_bytes": page.call("Runtime.getHeapUsage")["usedSize"],
            "nodes": page.call("Memory.getDOMCounters")["nodes"], "listeners": page.call("Memory.getDOMCounters")["jsEventListeners"],
            "gl": page.evaluate("({ ...gl_objects })")}


def growth_a_round(rounds, figure):
    """By a straight line through the rounds behind the first third, when all has been made once."""
    settled = [figure(r) for r in rounds[len(rounds) // 3:]]
    return statistics.linear_regression(range(len(settled)), settled).slope


def growth(rounds):
    """The gain of each figure a round, and sentences on those that have gained too much."""
    gained = {key: growth_a_round(rounds, lambda r: r[key]) for key in MOST_GROWTH}
    gained["gl"] = {kind: growth_a_round(rounds, lambda r: r["gl"][kind]) for kind in rounds[0]["gl"]}
    problems = []
    span = len(rounds) - len(rounds) // 3
    for key, (once, each_round) in MOST_GROWTH.items():
        if gained[key] * span > once + each_round * span:
            problems.append(f"{key} grew by {gained[key]:.1f} a round in {span} rounds")
    # They go up and down with what the last act has drawn.
    early, late = rounds[len(rounds) // 3:len(rounds) // 3 + 2], rounds[-2:]
    for kind in rounds[0]["gl"]:
        before, after = max(r["gl"][kind] for r in early), min(r["gl"][kind] for r in late)
        if after > before:
            problems.append(f"{kind} objects of WebGL grew from {before} to {after}")
    return gained, problems


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--minutes", type=float, default=6)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--json", help="write the figures to this file, too")
    chosen = parser.parse_args()
    if not IWER.exists():
        sys.exit("iwer is not installed: npm ci --prefix tests/end_to_end")
    rng = random.Random(chosen.seed)
    with contextlib.ExitStack() as stack:
        folder = pathlib.Path(stack.enter_context(tempfile.TemporaryDirectory()))
        running = stack.enter_context(host(folder / "host", CAMERA))
        page = stack.enter_context(Browser()).open("about:blank", (320, 180))
        for source in (COUNT_OBJECTS, IWER.read_text(), (HERE / "headset.js").read_text()):
            page.call("Page.addScriptToEvaluateOnNewDocument", source=source)
        page.call("Page.navigate", url=running.greeting["link"])
        page.enter(way="room")
        page.wait_for("theatron.complete_ms !== null")
        use, rounds, end = Use(page, running.greeting["links"]), [], time.monotonic() + 60 * chosen.minutes
        while time.monotonic() < end or len(rounds) < 4:
            for act in rng.sample(use.acts, len(use.acts)):
                use.run(act)
            rounds.append(measure(page))
            print(f"round {len(rounds)}: {rounds[-1]}", file=sys.stderr)
        gained, problems = growth(rounds)
        problems += [f"console: {problem}" for problem in page.problems]
    sys.exit(tell_result({"minutes": chosen.minutes, "acts": use.counts, "rounds": len(rounds), "first": rounds[0], "last": rounds[-1], "growth_a_round": gained,
                          "load": os.getloadavg()[0]}, problems, chosen.json))


if __name__ == "__main__":
    main()
