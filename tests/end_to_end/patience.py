# SPDX-License-Identifier: Apache-2.0
"""One patience for every wait of the tests, ended by a standstill instead of by a number of seconds.

A wait for something that must come ends with it, with the end of the process that should bring it, or when nothing
moves any more: for QUIET_S seconds no process of the test has counted a frame or a message, has said anything, or has
used MOVES_S of processor time. A test on a busy machine is slow and passes. THEATRON_WAIT_S bounds each wait: a page
that draws on moves for ever. The ceiling is CTest's: shortly before CTest would kill the test, the wait fails with
what it knows.
"""
import contextlib
import dataclasses
import inspect
import os
import pathlib
import subprocess
import sys
import time

QUIET_S = 60      # of standstill
MOVES_S = 1       # of processor time of all processes together; timers of idle ones use less than that in QUIET_S
CEILING_S = float(os.environ.get("THEATRON_CEILING_S", "inf"))  # of the whole program; CTest ends it a little later
WAIT_S = float(os.environ.get("THEATRON_WAIT_S", "inf"))
LOOKS_EVERY_S = 1
TELLS_EVERY_S = 30

_BEGAN = time.monotonic()
_TICKS = os.sysconf("SC_CLK_TCK")
_watched = []  # in the order in which they were started


class WaitedInVain(AssertionError):
    """The awaited condition did not come."""


@dataclasses.dataclass(frozen=True)
class Counters:
    told: tuple        # of each watched process: what it has counted and said
    processor_s: float


def watch(process):
    """`process` belongs to the test from now on. It has counted(), a number that grows with its frames, messages and
    lines, crashed(), and last_words(), a text for people."""
    _watched.append(process)


def forget(process):
    with contextlib.suppress(ValueError):
        _watched.remove(process)


def _stat(pid):
    """The parent, and the seconds of processor time with those of children that have ended."""
    fields = pathlib.Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()
    return int(fields[1]), sum(map(int, fields[11:15])) / _TICKS


def processor_seconds(root=None):
    """The processor time of everything that this program has started, without the program itself."""
    root = root or os.getpid()
    parents, used = {}, {}
    for entry in os.listdir("/proc"):
        if entry.isdigit():
            with contextlib.suppress(OSError, IndexError, ValueError):
                parents[int(entry)], used[int(entry)] = _stat(entry)
    total, family = 0.0, {root}
    while family:
        family = {child for child, parent in parents.items() if parent in family and child != root}
        total += sum(used[child] for child in family)
    ended = os.times()
    return total + ended.children_user + ended.children_system


def counters():
    return Counters(tuple(process.counted() for process in _watched), processor_seconds())


def last_words():
    return "".join(f"\n  {process.last_words()}" for process in _watched) or " none runs"


class Patience:
    """Says when to give up. Tests of it give it the clock and the counters."""

    def __init__(self, clock=time.monotonic, read=counters, ceiling=None):
        self.clock, self.read = clock, read
        self.began = self.moved = self.looks = clock()
        self.ceiling = min(_BEGAN + CEILING_S, self.began + WAIT_S) if ceiling is None else ceiling
        self.seen = None

    def spent(self):
        """Why it is in vain to wait any longer; nothing while something moves."""
        now = self.clock()
        if now >= self.looks:
            self.looks = now + LOOKS_EVERY_S
            seen = self.read()
            if self.seen is None or seen.told != self.seen.told or \
                    abs(seen.processor_s - self.seen.processor_s) >= MOVES_S:
                self.seen, self.moved = seen, now
        if now - self.moved >= QUIET_S:
            return f"for {QUIET_S} s no process of the test counted a frame or a message, said anything or worked"
        if now >= self.ceiling:
            return f"waited for {WAIT_S:g} s" if now - self.began >= WAIT_S else "the time of the whole test is over"
        return None


def source_of(condition):
    """The text of a condition, for people."""
    with contextlib.suppress(OSError, TypeError, SyntaxError):
        return " ".join(inspect.getsource(condition).split())[:400]
    return str(condition)


class Wait:
    """One wait: check() raises as soon as it is in vain. `ended`: tells that the process that should bring it has ended."""

    def __init__(self, what, ended=lambda: False, patience=None):
        self.what, self.ended, self.patience = what, ended, patience or Patience()
        self.tells = self.patience.began + TELLS_EVERY_S

    def check(self):
        why = "a process crashed" if any(process.crashed() for process in _watched) else self.patience.spent()
        if why:
            raise WaitedInVain(f"{why}, and this did not come: {self._text()}\nLast reports:{last_words()}")
        now = self.patience.clock()
        if now >= self.tells:
            self.tells = now + TELLS_EVERY_S
            print(f"\nstill waiting after {now - self.patience.began:.0f} s for: {self._text()}", file=sys.stderr, flush=True)

    def fail_if_ended(self):
        if self.ended():
            raise WaitedInVain(f"the process ended, and this did not come: {self._text()}\nLast reports:{last_words()}")

    def _text(self):
        return self.what if isinstance(self.what, str) else source_of(self.what)


def wait_until(condition, what=None, *, of=None, every=0.05):
    """The condition's first true value. `what`: the condition in words; `of`: the process that makes it true (also a
    subprocess.Popen), in whose end the wait ends; `every`: seconds between two questions."""
    if isinstance(of, subprocess.Popen):
        ended = lambda: of.poll() is not None
    else:
        ended = of.has_ended if of else lambda: False
    wait = Wait(what or condition, ended)
    while True:
        ended = wait.ended()  # a last look at what it left
        if value := condition():
            return value
        if ended:
            wait.fail_if_ended()
        wait.check()
        time.sleep(every)


def end_of(process, what="its end"):
    """Waits for the end of a subprocess.Popen; returns its exit code."""
    wait = Wait(f"{what}: {process.args}")
    while True:
        try:
            return process.wait(0.2)
        except subprocess.TimeoutExpired:
            wait.check()


def finish(process):
    """Output and errors of a subprocess.Popen, once it has ended by itself; kills one for which there is no patience."""
    wait = Wait(f"the end of: {process.args}")
    while True:
        try:
            return process.communicate(timeout=0.5)
        except subprocess.TimeoutExpired:
            try:
                wait.check()
            except WaitedInVain:
                process.kill()
                print(*process.communicate(), file=sys.stderr)
                raise


def run(command, *, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, **options):
    """A command that ends by itself, as subprocess.run() gives it."""
    command = [str(word) for word in command]
    with subprocess.Popen(command, stdin=stdin, stdout=stdout, stderr=stderr, text=text, **options) as process:
        out, errors = finish(process)
        return subprocess.CompletedProcess(command, process.returncode, out, errors)
