# SPDX-License-Identifier: Apache-2.0
"""Puts the account of a run together: what was delivered, recorded, lost and why; memory; ends."""
import collections

import cameras
from accounting import Accountant, Entry, growing, linear_fit, longest_recovery, share_outside
from explanations import cost_of, windows_of
from stage import possible_kinds

WARM_UP_S = 20     # until a process has allocated its usual memory
LONG_LIVED_S = 90  # the slope of a shorter time is meaningless
GROWTH_MIB = 32    # allowed beyond the warm-up
NEAR_S = 5         # faults so long before a finding are reported with it
SHOWN_POINTS = 60  # of a process's memory over time
LEAST_OUTSIDE = 0.2
LONG_RUN_S = 300


def entries_of(examiner):
    """By stream, of all files."""
    entries = collections.defaultdict(list)
    for found in examiner.files.values():
        for stream, pictures in found["entries"].items():
            entries[int(stream)] += [Entry(*picture) for picture in pictures]
    return entries


def delivered(polls):
    """Counters of the host, summed over its processes: good frames of each camera, and frames left out by reason."""
    newest = {}
    for _, generation, figures in polls:
        newest[generation] = figures
    frames, left_out = collections.Counter(), collections.Counter()
    for figures in newest.values():
        for number, camera in enumerate(figures["cameras"]):
            frames[number] += camera["frames"]
            for reason, count in camera["dropped"].items():
                left_out[reason] += count
    return frames, left_out


def memory(roles):
    rows = []
    for role in roles:
        for number, child in enumerate(role.children):
            if not child.samples:
                continue
            lived = child.samples[-1][0]
            warm = max(WARM_UP_S, lived / 4)
            late = [(t, mib) for t, mib, _ in child.samples if t >= warm]
            slope, _ = linear_fit(late)
            rows.append({"process": f"{role.name}-{number:03}", "seconds": lived, "max_mib": max(m for _, m, _ in child.samples),
                         "mib_per_minute": slope * 60, "cpu_cores": child.samples[-1][2] / max(lived, 1),
                         "code": child.code(), "growth_mib": slope * (lived - warm) if lived > LONG_LIVED_S else 0.0,
                         "memory": [(round(t), round(m, 1)) for t, m, _ in
                                    child.samples[::max(len(child.samples) // SHOWN_POINTS, 1)]]})
    return rows


def by_kind(run, account, entries, bytes_per_second):
    rows = {}
    for h in run.happened:
        cost = cost_of(h.fault, bytes_per_second)
        row = rows.setdefault(h.fault.kind, {"count": 0, "ends": [], "why": cost.why, "recovery": not cost.nothing})
        row["count"] += 1
        if not cost.nothing:
            row["why"], row["recovery"] = cost.why, True
            row["ends"].append(h.end)
    # Cameras' own faults disturb only their own streams.
    healthy = {s: e for s, e in entries.items() if s // 2 not in cameras.FAULTY}
    table = []
    for kind, row in sorted(rows.items()):
        table.append({"kind": kind, "count": row["count"], "lost": account.lost.get(kind, 0), "why": row["why"],
                      "longest_recovery_s": longest_recovery(healthy, row["ends"]) if row["recovery"] else 0.0})
    for kind in sorted(k for k in account.lost if k not in rows):
        table.append({"kind": kind, "count": None, "lost": account.lost[kind],
                      "why": "the camera gave no good picture", "longest_recovery_s": None})
    return table


def incidents(found):
    """Findings of several streams that overlap in time belong together."""
    groups = []
    for f in sorted(found, key=lambda f: f.begin):
        if groups and f.begin <= max(g.end for g in groups[-1]):
            groups[-1].append(f)
        else:
            groups.append([f])
    return groups


def incident_text(incident, run):
    begin, end = min(f.begin for f in incident), max(f.end for f in incident)
    near = [h.fault for h in run.happened if h.begin <= end and h.end >= begin - NEAR_S]
    streams = ", ".join(str(s) for s in sorted({f.stream for f in incident}))
    return (f"{begin - run.begin:.2f} to {end - run.begin:.2f} s: {sum(f.pictures for f in incident)} pictures of "
            f"streams {streams}: {'; '.join(sorted({f.what for f in incident}))} (at that time: "
            f"{', '.join(f'{f.kind} at {f.at:.2f} s' for f in near) or 'no fault'})")


def judge(run, stage, examiner, seed):
    starts = [child.started for child in stage.host.children]
    size = sum(found["bytes"] for found in examiner.files.values())
    bytes_per_second = size / (run.end - run.begin)
    windows = windows_of(run.happened, run.patience, bytes_per_second)
    windows += cameras.camera_windows(seed, starts, run.begin, run.end, run.patience)
    accountant = Accountant(windows, starts, 1 / cameras.FPS, run.begin, run.end)
    entries = entries_of(examiner)
    for stream in range(2 * cameras.CAMERAS):
        accountant.judge(stream, entries.get(stream, []))
    account = accountant.account

    findings = list(run.findings)
    findings += [incident_text(incident, run) for incident in incidents(account.findings)]
    for name, found in sorted(examiner.files.items()):
        findings += [f"{name}: {problem}" for problem in found["problems"]]
    outside = share_outside(windows, run.begin, run.end)
    # Short runs and slow machines have little such time; viewers, guests and slow disks are judged there, too.
    if outside < LEAST_OUTSIDE and run.patience < 2 and run.end - run.begin > LONG_RUN_S:
        findings.append(f"only {outside:.0%} of the time had no fault that could lose pictures: this run says little")
    frames, left_out = delivered(stage.polls)
    processes = memory(stage.roles)
    for role in stage.roles:
        rows = [row for row in processes if row["process"].rpartition("-")[0] == role.name]
        findings += [f"{row['process']} grows by {row['mib_per_minute']:.2f} MiB a minute"
                     for row in growing(rows, GROWTH_MIB)]

    return {"seed": seed, "seconds": run.end - run.begin, "patience": run.patience, "share_outside": outside,
            "left_out_kinds": possible_kinds([])[1], "expected": account.expected, "recorded": account.recorded,
            "decodable": account.decodable, "late": account.late, "lost": sum(account.lost.values()),
            "delivered": sum(frames.values()), "left_out_by_host": dict(left_out), "compared": examiner.compared,
            "files": len(examiner.files), "bytes": size,
            "kinds": by_kind(run, account, entries, bytes_per_second), "processes": processes,
            "findings": findings, "log": run.log}
