# SPDX-License-Identifier: Apache-2.0
"""Finds the gaps of recordings and the faults that explain them. Pure: no processes, no clock.

All times are seconds of the host's steady clock, which the pictures' `captured` counts in, too.
"""
import bisect
import collections
import dataclasses
import typing

NOT_SENT_S = 3.0  # a camera that passes over pictures for longer without a fault is a finding


@dataclasses.dataclass(frozen=True)
class Window:
    """While this lasts, pictures may be missing."""
    begin: float
    end: float
    kind: str
    streams: frozenset = frozenset()  # empty: all
    camera_side: bool = False         # the camera did not deliver; all sent pictures must still be there

    def covers(self, stream, at):
        return self.begin <= at <= self.end and (not self.streams or stream in self.streams)


class Entry(typing.NamedTuple):
    """A picture in one of the recordings."""
    captured: float
    frame: int
    decodable: bool


@dataclasses.dataclass
class Finding:
    stream: int
    begin: float
    end: float
    pictures: int
    what: str


@dataclasses.dataclass
class Account:
    """The sum over all streams."""
    recorded: int = 0
    decodable: int = 0
    late: int = 0  # passed over by their camera because the machine was busy
    lost: collections.Counter = dataclasses.field(default_factory=collections.Counter)  # by kind of fault
    findings: list = dataclasses.field(default_factory=list)

    @property
    def expected(self):
        return self.decodable + self.late + sum(self.lost.values()) + sum(f.pictures for f in self.findings)


def missing_instants(before, after, period):
    """When pictures should have been taken between two that are there."""
    count = max(round((after - before) / period) - 1, 0)
    step = (after - before) / (count + 1)
    return [before + step * (k + 1) for k in range(count)]


class Accountant:
    """Judges one stream at a time. `host_starts`: when each process of the host was started, in order."""

    def __init__(self, windows, host_starts, period, begin, end):
        self.windows = sorted(windows, key=lambda w: w.begin)
        self.longest = max((w.end - w.begin for w in windows), default=0)
        self.begins = [w.begin for w in self.windows]
        self.host_starts, self.period, self.begin, self.end = host_starts, period, begin, end
        self.account = Account()

    def covering(self, stream, at):
        first = bisect.bisect_left(self.begins, at - self.longest)
        last = bisect.bisect_right(self.begins, at)
        return [w for w in self.windows[first:last] if w.covers(stream, at)]

    def generation(self, at):
        return bisect.bisect_right(self.host_starts, at)

    def judge(self, stream, entries):
        """entries: the stream's pictures of all files, in any order."""
        unique = {(self.generation(e.captured), e.frame): e for e in entries}
        there = sorted((e for e in unique.values() if self.begin <= e.captured <= self.end),
                       key=lambda e: (e.captured, e.frame))
        self.account.recorded += len(there)
        whole = [e for e in there if e.decodable]
        self.account.decodable += len(whole)
        if not whole:
            instants = missing_instants(self.begin, self.end, self.period)
            self._find(stream, instants, "nothing of this stream was recorded")
            return
        # The edges of the run count like pictures, or nothing at all would be missed at its end.
        self._judge_gap(stream, Entry(self.begin, 0, True), whole[0], None)
        for before, after in zip(whole, whole[1:]):
            if after.captured - before.captured > 1.5 * self.period:
                same_host = self.generation(before.captured) == self.generation(after.captured)
                self._judge_gap(stream, before, after, after.frame - before.frame - 1 if same_host else None)
        self._judge_gap(stream, whole[-1], Entry(self.end, 0, True), None)

    def _judge_gap(self, stream, before, after, numbers_between):
        """numbers_between: pictures that the host sent between the two; None where that cannot be known."""
        instants = missing_instants(before.captured, after.captured, self.period)
        if not instants:
            return
        sent = len(instants) if numbers_between is None else min(max(numbers_between, 0), len(instants))
        on_the_way, of_camera, without = [], [], []
        for at in instants:
            covering = self.covering(stream, at)
            recording_side = [w.kind for w in covering if not w.camera_side]
            if recording_side:
                on_the_way.append(recording_side[0])
            elif covering:
                of_camera.append(covering[0].kind)
            else:
                without.append(at)
        # Numbers do not tell when: as many as possible count to where a loss on the way was allowed.
        not_allowed = sent - len(on_the_way) if numbers_between is not None else 0
        if not_allowed > 1:
            self._find(stream, without or instants, "sent by the host, but not recorded or not decodable", not_allowed)
            of_camera = of_camera[max(not_allowed - len(without), 0):]
            without = without[not_allowed:]
        self.account.lost.update(on_the_way)
        self.account.lost.update(of_camera)
        if not without:
            return
        if numbers_between is None or without[-1] - without[0] > NOT_SENT_S:
            self._find(stream, without, "missing without any fault")
        else:
            self.account.late += len(without)

    def _find(self, stream, instants, what, count=None):
        count = len(instants) if count is None else count
        self.account.findings.append(Finding(stream, instants[0], instants[-1], count, what))


def longest_recovery(entries, ends):
    """The longest time from any of `ends` until a stream can be decoded again. entries: by stream."""
    longest = 0.0
    for pictures in entries.values():
        times = sorted(e.captured for e in pictures if e.decodable)
        for end in ends:
            at = bisect.bisect_left(times, end)
            if at < len(times):
                longest = max(longest, times[at] - end)
    return longest


def share_outside(windows, begin, end, step=0.05):
    """The part of the time in which nothing may be missing; with little of it the account says little."""
    whole = [w for w in windows if not w.streams]
    count = max(int((end - begin) / step), 1)
    free = sum(not any(w.begin <= begin + k * step <= w.end for w in whole) for k in range(count))
    return free / count


def growing(rows, allowed_mib):
    """The rows of one role's processes that grow. The process that lived longest shows the growth over time, and the
    level that a role needs. One that was killed early may have grown in steps up to this level: a codec was chosen, a backlog
    came."""
    if not rows:
        return []
    longest = max(rows, key=lambda row: row["seconds"])
    return [row for row in rows if row["growth_mib"] > allowed_mib
            and (row is longest or row["max_mib"] > longest["max_mib"] + allowed_mib)]


def linear_fit(points):
    """(slope, value at the last point) of a straight line through (x, y) points."""
    n = len(points)
    if n < 2:
        return 0.0, points[0][1] if points else 0.0
    mean_x, mean_y = sum(x for x, _ in points) / n, sum(y for _, y in points) / n
    spread = sum((x - mean_x) ** 2 for x, _ in points)
    slope = sum((x - mean_x) * (y - mean_y) for x, y in points) / spread if spread else 0.0
    return slope, mean_y + slope * (points[-1][0] - mean_x)
