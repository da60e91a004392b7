# SPDX-License-Identifier: Apache-2.0
"""The schedule of faults. The same seed, length and kinds give the same schedule."""
import dataclasses
import heapq
import random

QUIET_BEGIN_S = 5.0  # everybody joins
QUIET_END_S = 8.0    # everybody recovers
BETWEEN_S = (1.5, 4.0)  # from the beginning of one fault to the beginning of the next
LONG_RUN_S = 600
DEADLY_SHARE = 0.5   # of a long run; after that every process lives on, so that its memory over time can be seen


@dataclasses.dataclass(frozen=True)
class Kind:
    """A fault that can be chosen. While it is on, and `settle` seconds after, no other fault of its `part` begins."""
    name: str
    part: str
    least_s: float
    most_s: float
    settle_s: float = 8.0
    amounts: tuple = ()  # one of them is chosen

    @property
    def deadly(self):
        """A process ends."""
        return self.name.endswith(("killed", "clock", "full", "gone"))


DAY_S = 86400
GUESTS = ("garbage", "wishes", "dear", "idle", "deaf", "names", "media")

KINDS = (
    Kind("host killed", "host", 0.5, 3, settle_s=15),
    Kind("host stopped", "host", 0.2, 10, settle_s=15),
    Kind("recorder killed", "recording", 0.3, 2),
    Kind("recorder stopped", "recording", 0.2, 10),
    Kind("recorder with another clock", "recording", 0.3, 1, amounts=(DAY_S, 60, 3, -3, -60, -DAY_S)),
    Kind("disk stalled", "recording", 0.5, 8),
    Kind("disk slow", "recording", 1, 8, amounts=(20, 50, 100)),  # ms for each call
    Kind("disk full", "recording", 0.5, 3),
    Kind("disk gone", "recording", 0.5, 3),
    Kind("link cut", "recording", 0.5, 6),
    Kind("link slow", "recording", 2, 8, amounts=(4, 50)),  # percent of its rate
    Kind("viewer killed", "viewer 1", 0.3, 3, settle_s=4),
    Kind("viewer stopped", "viewer 2", 0.2, 10, settle_s=4),
    Kind("viewer with another clock", "viewer 1", 0.3, 1, settle_s=4, amounts=(DAY_S, 60, -60, -DAY_S)),
    *(Kind(f"guest: {name}", f"guest {name}", 2, 6, settle_s=4) for name in GUESTS),
)


@dataclasses.dataclass(frozen=True)
class Fault:
    at: float  # seconds from the beginning of the run
    kind: str
    part: str
    length: float
    amount: int = 0

    @property
    def end(self):
        return self.at + self.length

    def text(self):
        amount = f" ({self.amount:+d})" if self.amount else ""
        return f"{self.at:8.2f} s  {self.kind}{amount} for {self.length:.2f} s"


def make_schedule(seed, seconds, kinds=KINDS, longest_s=10.0, pace=1.0):
    """Faults in order of time: all kinds come once before any comes again.

    `pace`: all times between faults are that many times as long as usual.
    """
    random_ = random.Random(seed)
    faults, deck, free = [], [], {}
    now = QUIET_BEGIN_S
    deadly_until = DEADLY_SHARE * seconds if seconds >= LONG_RUN_S else seconds
    while kinds:
        deck = [kind for kind in deck if not kind.deadly or now < deadly_until]
        if not deck:
            deck = [kind for kind in random_.sample(kinds, len(kinds)) if not kind.deadly or now < deadly_until]
        if not deck:
            break
        ready = [kind for kind in deck if free.get(kind.part, 0) <= now]
        if not ready:
            now = min(free[kind.part] for kind in deck)
            continue
        kind = ready[0]
        deck.remove(kind)
        length = min(random_.uniform(kind.least_s, kind.most_s), max(longest_s, kind.least_s))
        amount = random_.choice(kind.amounts) if kind.amounts else 0
        fault = Fault(round(now, 2), kind.name, kind.part, round(length, 2), amount)
        if fault.end > seconds - QUIET_END_S:
            break
        faults.append(fault)
        free[kind.part] = fault.end + pace * kind.settle_s
        now += pace * random_.uniform(*BETWEEN_S)
    return faults


def edges(faults):
    """Beginnings and ends of the faults in order of time: (seconds, is_begin, fault)."""
    heap = []
    for order, fault in enumerate(faults):
        heapq.heappush(heap, (fault.at, order, True, fault))
        heapq.heappush(heap, (fault.end, order, False, fault))
    while heap:
        at, _, is_begin, fault = heapq.heappop(heap)
        yield at, is_begin, fault
