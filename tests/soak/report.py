# SPDX-License-Identifier: Apache-2.0
"""Output of a soak while it runs and at its end."""
import json
import sys
import time

LINE_EVERY_S = 10  # if the output is no terminal


class Progress:
    def __init__(self, seconds):
        self.seconds = seconds
        self.next_line = 0.0
        self.live = sys.stdout.isatty()

    def __call__(self, run):
        now = time.monotonic()
        if not self.live and now < self.next_line:
            return
        self.next_line = now + LINE_EVERY_S
        faults = ", ".join(f.kind for f in run.active) or "none"
        text = (f"soak: {now - run.begin:.0f} of {self.seconds:.0f} s, {len(run.happened)} faults so far, now: {faults}; "
                f"{len(run.findings)} findings")
        print("\r\033[K" + text if self.live else text, end="" if self.live else "\n", flush=True)


def to_text(result):
    lines = [f"Soak with seed {result['seed']}: {result['seconds']:.0f} s at real speed, "
             f"{result['files']} recordings, {result['bytes'] / 1e6:.0f} MB"]
    lines += [f"Left out: faults of the {what}: {why}" for what, why in result["left_out_kinds"].items()]
    lines += [f"Windows {result['patience']:.1f} times as long as usual; {result['share_outside']:.0%} of the time lay "
              "outside of all, where nothing may be missing", "",
              f"pictures expected          {result['expected']}",
              f"recorded and decodable     {result['decodable']}",
              f"lost to faults             {result['lost']}",
              f"passed over by a camera because the machine was busy   {result['late']}",
              f"compared bit by bit        {result['compared']} of depth",
              f"the host's own counters    {result['delivered']} frames delivered (depth with colour), left out: "
              + (", ".join(f"{count} {reason}" for reason, count in result["left_out_by_host"].items() if count) or "none"),
              "", f"{'fault':30} {'count':>5} {'lost':>7} {'back after':>10}  because"]
    for row in result["kinds"]:
        count = "" if row["count"] is None else row["count"]
        back = "" if not row["longest_recovery_s"] else f"{row['longest_recovery_s']:.2f} s"
        lines.append(f"{row['kind']:30} {count:>5} {row['lost']:>7} {back:>10}  {row['why']}")
    lines += ["", f"{'process':16} {'lived s':>8} {'max MiB':>8} {'MiB/min':>8} {'cores':>6} {'ended with':>10}"]
    for row in result["processes"]:
        lines.append(f"{row['process']:16} {row['seconds']:8.0f} {row['max_mib']:8.1f} {row['mib_per_minute']:8.2f} "
                     f"{row['cpu_cores']:6.2f} {row['code'] if row['code'] is not None else '':>10}")
    lines += ["", f"{len(result['findings'])} findings" + (":" if result["findings"] else "")]
    lines += [f"  {finding}" for finding in result["findings"]]
    return "\n".join(lines) + "\n"


def write(result, folder):
    (folder / "report.json").write_text(json.dumps(result, indent=1))
    text = to_text(result)
    (folder / "report.txt").write_text(text)
    (folder / "log.txt").write_text("\n".join(result["log"]) + "\n")
    print("\n" + text, flush=True)
