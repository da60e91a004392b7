# SPDX-License-Identifier: Apache-2.0
"""Two sessions at one port while one observer's and one expert's link of the first are used by 200 hostile connections.

    python3 tests/end_to_end/hostile_links_run.py --minutes 10 --json hostile.json

The connections join again and again, ask for other codecs and key frames, draw, never read, or say nothing. Meanwhile
an operator of each session and a person who was here before by each of the two links join every five seconds, each
session is recorded, and a viewer who behaves counts its bytes. Exit code 1 if an operator or such a person waits for
more than 2 s, a recording lacks a picture, the viewer's bytes are 10 % above those before, or, afterwards, one of the
links lets nobody in who was never here for longer than its debt (newcomers and flood_cost in src/session/link_budgets.h).
"""
import argparse
import contextlib
import json
import multiprocessing
import os
import pathlib
import random
import shutil
import signal
import tempfile
import threading
import time

from guests_run import seconds_to_join
from raw_peer import CONTROL, PROTOCOL, Link, RawPeer, control_message
from theatron_process import Process, host, run, tell_result

CONNECTIONS = 200
WORKERS = 4
LONGEST_JOIN_S = 2.0
# A link owes 64 newcomers at most, one a second.
LONGEST_DEBT_S = 66.0
MOST_GROWTH = 1.10


def messages_of(link):
    """Those that the hostile connections send, made once."""
    token = Link.parse(link).token

    def message(kind, **fields):
        return bytes([CONTROL]) + control_message("ToHost", kind, **fields)

    def join(**fields):
        usual = {"protocol_min": PROTOCOL, "protocol_max": PROTOCOL, "token": token, "name": "guest", "color_codec": "jpeg:quality=85",
                 "depth_codec": "strata"}
        return message("Join", **(usual | fields))
    return {"join": [join(depth_codec=depth, color_codec=f"jpeg:quality={quality}")
                     for depth, quality in (("strata", 40), ("zstd:level=19", 95), ("lz4:level=12", 60), ("rvl", 85))],
            "wish": [message("ChooseCodecs", depth_codec=depth, color_codec="")
                     for depth in ("rvl", "zstd:level=19", "nonsense")] +
                    [message("RequestKey", stream=stream, setting=setting)
                     for stream in (0, 1, 70) for setting in (1, 2)] +
                    [message("Ping", sent_us=1)]}


def again_and_again(peer, messages, random_, end):
    peer.receive()
    time.sleep(random_.uniform(0, 1))


def wishes(peer, messages, random_, end):
    while time.monotonic() < end:
        peer.send(random_.choice(messages["wish"]))
        time.sleep(0.01)


def deaf(peer, messages, random_, end):
    while time.monotonic() < end:
        peer.send(messages["wish"][-1])
        time.sleep(0.2)


def silent(peer, messages, random_, end):
    time.sleep(max(0.0, min(end - time.monotonic(), 20)))


KINDS = (again_and_again, wishes, deaf, silent)


def one(link, messages, number, end, joins):
    random_ = random.Random(number)
    kind = KINDS[number % len(KINDS)]
    # Each has its own address, as in a network.
    address = f"127.{1 + number // 250}.{number % 250}.1"
    while time.monotonic() < end:
        with contextlib.suppress(OSError, EOFError, ValueError):
            with RawPeer(link, address=address, timeout=5, receive_buffer=4096 if kind is deaf else None) as peer:
                peer.send(random_.choice(messages["join"]))
                joins[kind.__name__] = joins.get(kind.__name__, 0) + 1
                kind(peer, messages, random_, end)
        time.sleep(0.05)


def attack(links, numbers, end, counts):
    os.nice(10)
    joins = {}
    messages = [messages_of(link) for link in links]
    threads = [threading.Thread(target=one, args=(links[n % 2], messages[n % 2], n // 2, end, joins), daemon=True) for n in numbers]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    counts.put(joins)


def seconds_until_in(link):
    """Seconds until somebody who was never here and tries again is in, and what the first refused attempts met."""
    begin, refused = time.monotonic(), []
    while True:
        try:
            seconds_to_join(link)
            return time.monotonic() - begin, refused[:3]
        except (OSError, EOFError, ValueError) as error:
            refused.append(repr(error))
            if time.monotonic() - begin > 2 * LONGEST_DEBT_S:
                return float("inf"), refused[:3]
            time.sleep(0.1)


class Viewer(Process):
    def __init__(self, link):
        super().__init__("join", link, "--no-window", "--every", "1", "--name", "behaves")

    def mbit_per_s(self, seconds):
        end, values = time.monotonic() + seconds, []
        while time.monotonic() < end:
            values.append(self.read_json()["mbit_per_s"])
        return sum(values) / len(values)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--minutes", type=float, default=1)
    parser.add_argument("--json")
    options = parser.parse_args()
    folder = pathlib.Path(tempfile.mkdtemp(prefix="theatron_hostile_run_"))
    # The share of key frames and of news about people is that of a session: a still picture would cost nothing without them.
    camera = "synthetic:room,seconds=2,loop=1,quality=quick,color=depth,preload=1"
    result, problems = {"minutes": options.minutes, "connections": CONNECTIONS}, []
    with contextlib.ExitStack() as stack:
        stack.callback(shutil.rmtree, folder)
        h = stack.enter_context(host(folder / "state", options=("--session", "OR 3", "--camera", camera, "--session", "OR 4",
                                                                "--camera", camera)))
        third, fourth = h.greeting["links"], h.greeting["sessions"][0]["links"]
        files = [folder / "3.mkv", folder / "4.mkv"]
        recorders = [stack.enter_context(Process("record", links["operator"], file, "--json")) for links, file in zip((third, fourth), files)]
        viewer = stack.enter_context(Viewer(third["operator"]))
        viewer.wait_for(lambda figures: figures["fps"] > 0)
        before = viewer.mbit_per_s(15)
        known = {role: list(random.Random(role).randbytes(16)) for role in ("observer", "expert")}
        for role, person in known.items():
            seconds_to_join(third[role], person=person)

        end = time.monotonic() + options.minutes * 60
        counts = multiprocessing.Queue()
        guests = [multiprocessing.Process(target=attack, daemon=True,
                                          args=((third["observer"], third["expert"]), range(first, CONNECTIONS, WORKERS), end, counts))
                  for first in range(WORKERS)]
        for guest in guests:
            guest.start()
        joins, returns, rates, refused = [], [], [], []
        while time.monotonic() < end - 5:
            for name, links in (("OR 3", third), ("OR 4", fourth)):
                try:
                    joins.append(seconds_to_join(links["operator"]))
                except (OSError, EOFError, ValueError) as error:
                    refused.append(f"{name}: {error!r}")
            for role, person in known.items():
                try:
                    returns.append(seconds_to_join(third[role], person=person))
                except (OSError, EOFError, ValueError) as error:
                    refused.append(f"known {role}: {error!r}")
            rates.append(viewer.mbit_per_s(4))
        total = {}
        for _ in guests:
            for kind, count in counts.get().items():
                total[kind] = total.get(kind, 0) + count
        for guest in guests:
            guest.join()
        during = sum(rates) / len(rates)
        afterwards = {role: seconds_until_in(third[role]) for role in ("observer", "expert", "operator")}
        result |= {"hostile_joins": total, "operator_joins": len(joins), "operator_join_s_max": max(joins, default=None),
                   "returns": len(returns), "return_s_max": max(returns, default=None), "refused": len(refused), "viewer_mbit_before": before, "viewer_mbit_during": during,
                   "viewer_mbit_by_round": [round(rate, 2) for rate in rates],
                   "join_s_afterwards": afterwards}
        if refused:
            problems.append(f"{len(refused)} did not come in, the first one: {refused[0]}")
        if max(returns, default=99) > LONGEST_JOIN_S:
            problems.append(f"a person who was here before waited for {max(returns):.2f} s")
        if max(joins, default=99) > LONGEST_JOIN_S:
            problems.append(f"an operator waited for {max(joins):.2f} s")
        for role, (seconds, why) in afterwards.items():
            if seconds > (LONGEST_JOIN_S if role == "operator" else LONGEST_DEBT_S):
                problems.append(f"afterwards the {role}'s link let nobody in for {seconds:.2f} s: {why}")
        if during > before * MOST_GROWTH:
            problems.append(f"the viewer got {before:.2f} Mbit/s before and {during:.2f} beside the hostile connections")
        for recorder, file in zip(recorders, files):
            recorder.send(signal.SIGINT)
            recorder.read_json()
            code = recorder.end()
            verified, out, errors = run("inspect", file, "--verify")
            result[file.stem] = {"exit": code, "verify": verified}
            if code or verified:
                problems.append(f"record ended with {code}, inspect --verify with {verified}: {''.join(recorder.errors[-5:])}{out}{errors}")
        h.send(signal.SIGINT)
        result["host_exit"] = h.end()
        if result["host_exit"]:
            problems.append(f"the host ended with {result['host_exit']}: {''.join(h.errors[-5:])}")
    raise SystemExit(tell_result(result, problems, options.json))


if __name__ == "__main__":
    main()
