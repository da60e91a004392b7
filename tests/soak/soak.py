# SPDX-License-Identifier: Apache-2.0
"""A session under random faults; afterwards every picture that is missing must be explained by one of them.

    make soak MINUTES=120            or
    python3 tests/soak/soak.py --minutes 10 --seed 7 --out build/soak

Ends with 0 if nothing was found, with 1 if something was. Ctrl-C ends the faults early and judges what there is;
a second one ends at once.
"""
import argparse
import os
import pathlib
import random
import shutil
import signal
import sys
import time

END_TO_END = str(pathlib.Path(__file__).resolve().parents[1] / "end_to_end")
sys.path.insert(0, END_TO_END)
os.environ["PYTHONPATH"] = END_TO_END  # for guests and the examination, which are processes of their own

import report  # noqa: E402
from examiner import Examiner  # noqa: E402
from explanations import Happened  # noqa: E402
from judge import judge  # noqa: E402
from schedule import KINDS, Fault, edges, make_schedule  # noqa: E402
from stage import Stage, possible_kinds  # noqa: E402

SAMPLE_EVERY_S = 1.0
WELL_AGAIN_S = 15  # until a viewer must have pictures of all cameras again
USUAL_START_S = 1.0   # from the first process until all take part, on a machine with nothing else to do
START_PATIENCE_S = 60
SETTLE_S = 6.0        # at the end, with no more faults


class Run:
    def __init__(self, stage, faults, examiner, say):
        self.stage, self.faults, self.examiner, self.say = stage, faults, examiner, say
        self.happened, self.findings = [], []
        self.begin = self.end = 0.0
        self.patience = 1.0
        self.stopped = False
        self.active = []  # faults that are on
        self.next_sample = 0.0
        self.log = []

    def note(self, text):
        self.log.append(f"{time.monotonic() - self.begin:8.2f} s  {text}" if self.begin else f"           {text}")

    def find(self, text):
        self.findings.append(text)
        self.note("FINDING: " + text)

    def start(self):
        before = time.monotonic()
        self.stage.begin()
        while not self._all_take_part():
            if time.monotonic() - before > START_PATIENCE_S:
                raise RuntimeError("not all take part after a minute: " +
                                   "; ".join(role.now.last_words() for role in self.stage.roles))
            self.stage.poll()
            time.sleep(0.1)
        took = time.monotonic() - before
        self.patience = min(max(took / USUAL_START_S, 1.0), 4.0)
        # The recorder is in; from here on everything counts.
        time.sleep(1.0 * self.patience)
        self.begin = time.monotonic()
        self.note(f"all take part after {took:.1f} s: windows are {self.patience:.1f} times as long as usual")

    def _all_take_part(self):
        # Viewers tell themselves; the recorder is one more participant at the host.
        joined = [v for v in self.stage.viewers if v.now.newest and v.now.newest["phase"] == "joined"
                  and v.now.newest["fps"] > 0]
        participants = self.stage.polls[-1][2]["participants"] if self.stage.polls else []
        return len(joined) == len(self.stage.viewers) and len(participants) > len(joined)

    def run(self, seconds):
        for at, is_begin, fault in edges(self.faults):
            self._wait_until(self.begin + at)
            if self.stopped and is_begin:
                continue
            if not is_begin and fault not in self.active:
                continue
            now = time.monotonic()
            if is_begin:
                self.note(f"{fault.kind}{f' ({fault.amount:+d})' if fault.amount else ''} for {fault.length:.2f} s")
                self.active.append(fault)
                self.happened.append(Happened(fault, now, now + fault.length))
                self.stage.start_fault(fault)
            else:
                self.stage.end_fault(fault)
                self.active.remove(fault)
                for h in self.happened:
                    if h.fault is fault:
                        h.end = time.monotonic()
        if not self.stopped:
            self._wait_until(self.begin + seconds)
        # A last look without faults.
        self._wait_until(time.monotonic() + (SETTLE_S * self.patience if self.stopped else 0.0), even_if_stopped=True)
        self.end = time.monotonic() - 1.0

    def _wait_until(self, at, even_if_stopped=False):
        while (now := time.monotonic()) < at and (even_if_stopped or not self.stopped):
            if now >= self.next_sample:
                self.next_sample = now + SAMPLE_EVERY_S
                self.stage.sample()
                self.stage.poll()
                self._look_after()
                self.say(self)
            time.sleep(min(0.05, max(0.0, at - time.monotonic())))

    def _look_after(self):
        """Notices who has ended without having been told to, and starts them again."""
        for role in self.stage.roles:
            fault = next((f for f in self.active if self.stage.role_of(f) is role), None)
            if role.running():
                continue
            kind = fault.kind if fault else ""
            if kind.endswith("killed") or kind.endswith("clock"):
                continue  # is started again when the fault ends
            child = role.now
            if kind.startswith("disk f") or kind.startswith("disk g"):
                if child.code() == 0:
                    self.find(f"{role.name} ended with 0 although its disk was {kind[5:]}")
                continue
            ended_by_disk = self._ended_by_disk(role, child)
            if ended_by_disk:
                if child.code() == 0:
                    self.find(f"{role.name} ended with 0 although its disk was {ended_by_disk.fault.kind[5:]}")
                ended_by_disk.end = time.monotonic()
            else:
                self.find(f"{role.name} ended by itself with {child.code()}: {child.last_words()}")
                self._excuse_what_follows(role, child)
            role.start()

    def _excuse_what_follows(self, role, child):
        """Frames that are missing until it runs again belong to the same finding."""
        if role in (self.stage.host, self.stage.recorder):
            kind = f"{role.name} ended by itself"
            self.happened.append(Happened(Fault(0, kind, role.name, 0), (child.ended or 0) - SAMPLE_EVERY_S,
                                          time.monotonic()))

    def _ended_by_disk(self, role, child):
        if role is not self.stage.recorder:
            return None
        for h in reversed(self.happened):
            if h.fault.kind in ("disk full", "disk gone") and h.begin <= (child.ended or 0) <= h.end + 2:
                return h
        return None

    def finish(self):
        """Everybody is well, and ends when told to."""
        for role in self.stage.viewers:
            # The last faults may have ended a moment ago, and its figures come once a second.
            patience = time.monotonic() + WELL_AGAIN_S
            while not sees_pictures(role) and time.monotonic() < patience:
                time.sleep(SAMPLE_EVERY_S)
            newest = role.now.newest or {}
            if not sees_pictures(role):
                self.find(f"{role.name} sees nothing at the end: {newest.get('phase')}, {newest.get('fps')} fps, "
                          f"{role.now.last_words()}")
        ends = [(self.stage.recorder, 60), *((v, 20) for v in self.stage.viewers), (self.stage.host, 20)]
        for role, timeout in ends:
            code = role.now.end(signal.SIGINT, timeout)
            if code < 0:
                self.find(f"{role.name} ended with signal {-code} when it was told to end")


def sees_pictures(role):
    newest = role.now.newest or {}
    return newest.get("phase") == "joined" and newest.get("fps", 0) > 0


def parse(arguments):
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--minutes", type=float, default=10)
    parser.add_argument("--seed", type=int, default=None, help="by default another one each time")
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("build/soak"))
    parser.add_argument("--longest", type=float, default=10.0, help="seconds that a fault lasts at most")
    parser.add_argument("--pace", type=float, default=1.0, help="times between faults, as multiples of the usual ones")
    parser.add_argument("--content", type=int, default=20000, help="pictures to compare bit by bit with the cameras'")
    parser.add_argument("--only", action="append", help="only kinds of faults whose name holds this; repeat for more")
    parser.add_argument("--keep", action="store_true", help="keep the recordings also if nothing is wrong")
    return parser.parse_args(arguments)


def main(arguments=None):
    options = parse(arguments)
    seed = random.SystemRandom().randrange(1_000_000) if options.seed is None else options.seed
    seconds = options.minutes * 60
    kinds, left_out = possible_kinds(KINDS)
    if options.only:
        kinds = [kind for kind in kinds if any(word in kind.name for word in options.only)]
    for what, why in left_out.items():
        print(f"soak: without faults of the {what}: {why}", flush=True)
    faults = make_schedule(seed, seconds, kinds, options.longest, options.pace)
    shutil.rmtree(options.out, ignore_errors=True)
    options.out.mkdir(parents=True)
    print(f"soak: seed {seed}, {options.minutes:g} min, {len(faults)} faults; everything goes to {options.out}", flush=True)

    stage = Stage(options.out, seed, with_link="link" not in left_out)
    examiner = Examiner(options.out, stage, options.content, options.keep)
    run = Run(stage, faults, examiner, report.Progress(seconds))

    def stop(*_):
        if run.stopped:
            raise KeyboardInterrupt
        run.stopped = True
    signal.signal(signal.SIGINT, stop)
    signal.signal(signal.SIGTERM, stop)
    try:
        run.start()
        run.run(seconds)
        run.finish()
        examiner.finish()
        result = judge(run, stage, examiner, seed)
        report.write(result, options.out)
        return 1 if result["findings"] else 0
    except KeyboardInterrupt:
        print("\nsoak: stopped at once", flush=True)
        return 130
    finally:
        stage.close()
        examiner.close()


if __name__ == "__main__":
    sys.exit(main())
