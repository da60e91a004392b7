# SPDX-License-Identifier: Apache-2.0
"""The frames that each kind of fault may cost, and why: the promises that a soak checks."""
import dataclasses
import pathlib
import re
import typing

from accounting import Window

OUTBOX = pathlib.Path(__file__).resolve().parents[2] / "src/net/outbox.h"


class Cost(typing.NamedTuple):
    """Pictures may be missing from `before` s before the fault's beginning to `after` s behind its end."""
    why: str
    before: float = 0.0
    after: float = 0.0
    nothing: bool = False  # no picture may be missing


NOTHING = Cost("costs nothing", nothing=True)
EXPLANATIONS = {
    "host killed": Cost("nobody sends; then the recorder joins again (waits at most 2 s) and begins with a key frame",
                        0.3, 5.0),
    "host stopped": Cost("nobody takes pictures; those that are too old then are passed over", 0.1, 3.0),
    "recorder killed": Cost("nobody records; what was not yet in the file is gone; it joins, begins with a key frame",
                            1.0, 3.0),
    "recorder stopped": Cost("nobody takes what is sent; begins again with a key frame", 0.0, 3.0),
    "recorder with another clock": Cost("it is ended and started again; joins, begins with a key frame", 0.1, 3.0),
    "disk stalled": Cost("waits in the recorder's memory", nothing=True),
    "disk slow": Cost("waits in the recorder's memory", nothing=True),
    "disk full": Cost("the recording ends, and is started again when there is room", 1.0, 3.0),
    "disk gone": Cost("the recording ends, and is started again when the disk is back", 1.0, 3.0),
    "link cut": Cost("nothing arrives; TCP tries again after up to as long as the cut lasted", 0.1, 4.0),
    "link slow": Cost("the link carries less than the pictures need", 0.1, 3.0),
    "host ended by itself": Cost("a finding of its own", 1.0, 5.0),
    "recorder ended by itself": Cost("a finding of its own", 1.0, 3.0),
    "viewer killed": NOTHING,
    "viewer stopped": NOTHING,
    "viewer with another clock": NOTHING,
}
ENOUGH_OF_LINK = 50  # percent: more than all who are behind it need
KEPT = "the host keeps it for the recorder"
CATCHING_UP = 3.0  # s, until all that was kept for a recorder has been taken
KEEPABLE = ("recorder stopped", "link cut", "link slow")


@dataclasses.dataclass
class Happened:
    """A fault with the times of the steady clock at which it really began and ended."""
    fault: typing.Any
    begin: float
    end: float


def kept_bytes():
    """Bytes that the host keeps for a recorder that takes nothing: Outbox::max_kept_bytes."""
    shift = re.search(r"max_kept_bytes = std::size_t\((\d+)\) << (\d+)", OUTBOX.read_text())
    return int(shift[1]) << int(shift[2])


def cost_of(fault, bytes_per_second):
    """`bytes_per_second`: of the whole recording."""
    if fault.kind == "link slow" and fault.amount >= ENOUGH_OF_LINK:
        return NOTHING
    # While it catches up it is late, too.
    if fault.kind in KEEPABLE and 2 * fault.length * bytes_per_second < kept_bytes():
        return Cost(KEPT, nothing=True)
    return EXPLANATIONS.get(fault.kind, NOTHING)


def first_moment_lost(h, happened, patience):
    """A host that is killed takes with it what it kept for a recorder that did not take it, or is catching up."""
    moments = [h.begin]
    if h.fault.kind == "host killed":
        moments += [other.begin for other in happened if other.fault.kind in KEEPABLE
                    and other.begin < h.begin < other.end + CATCHING_UP * patience]
    return min(moments)


def windows_of(happened, patience, bytes_per_second):
    """`patience`: how many times slower than usual this machine is."""
    windows = []
    for h in happened:
        cost = cost_of(h.fault, bytes_per_second)
        if cost.nothing:
            continue
        # TCP doubles the time between its attempts.
        more = h.end - h.begin if h.fault.kind == "link cut" else 0.0
        windows.append(Window(first_moment_lost(h, happened, patience) - cost.before, h.end + more + cost.after * patience, h.fault.kind))
    return windows
