#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes the vectors of a version with the program of that version: tests/vectors/README.md.

    THEATRON=build/release/apps/theatron/theatron python3 tests/vectors/make.py tests/vectors/0.2.0
    THEATRON_WRITE_VECTORS=tests/vectors/0.2.0 build/release/src/wire/wire_test --gtest_filter='KeptMessages.*'
    THEATRON_WRITE_VECTORS=tests/vectors/0.2.0 build/release/src/client/client_test --gtest_filter='KeptSettings.*'
"""
import array
import contextlib
import json
import math
import os
import pathlib
import shutil
import struct
import subprocess
import sys
import tempfile
import threading

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "end_to_end"))
import vectors  # noqa: E402
from raw_peer import FakeHost, Link, RawPeer, read_control_message  # noqa: E402
from theatron_process import Process, host, run, wait_until, write_png  # noqa: E402

# Each codec of depth and colour in one recording at least, with few pictures where they are large.
CODECS = {
    "strata_jpeg": ("strata", "jpeg:quality=85", 5),
    "raw_raw": ("raw", "raw", 2),
    "rvl_jpeg": ("rvl", "jpeg:quality=60", 3),
    "trvl_h264": ("trvl", "h264:crf=20", 5),
    "zstd_jpeg": ("zstd:delta=1", "jpeg:quality=60", 3),
    "lz4_jpeg": ("lz4:quant_mm=2", "jpeg:quality=60", 3),
    "ans_jpeg": ("ans", "jpeg:quality=60", 3),
    "h264_h264": ("h264:crf=10", "h264:crf=20", 5),
}
# Files of a running host alone, and its secret key with what is made of it.
NOT_KEPT = ("host.key", "host.crt", "host.lock", "links.followed", "sessions.json")


def checked(*words):
    code, out, errors = run(*words)
    if code != 0:
        raise SystemExit(f"theatron {' '.join(map(str, words))}: {errors}")
    return out


def make_recordings(folder, work):
    for name, (depth, color, frames) in CODECS.items():
        camera = vectors.make_camera(work / name, frames)
        checked("record", "--camera", f"folder:{camera},fps=5", "--depth-codec", depth, "--color-codec", color, folder / f"{name}.mkv")
    whole = (folder / "strata_jpeg.mkv").read_bytes()
    (folder / "cut_off.mkv").write_bytes(whole[:len(whole) * 6 // 10])


def write_tone(path):
    """Four seconds of 440 Hz that swell twice a second, 48 kHz."""
    samples = array.array("h", (int(6000 * math.sin(2 * math.pi * 440 * i / 48000) * math.sin(2 * math.pi * i / 48000))
                                for i in range(4 * 48000)))
    size = len(samples) * 2
    path.write_bytes(b"RIFF" + struct.pack("<I4s4sIHHIIHH4sI", 36 + size, b"WAVE", b"fmt ", 16, 1, 1, 48000, 96000, 2, 16,
                                           b"data", size) + samples.tobytes())


def member(link, name, work, *options):
    return Process("join", link, "--name", name, "--every", "0.1", *options,
                   env={**os.environ, "XDG_STATE_HOME": str(work / f"home of {name}")})


def make_session(file, work):
    """Two segments: Ada speaks and makes a brick, then Ben comes with a camera of his own."""
    camera = f"folder:{vectors.make_camera(work / 'table')},loop=1,fps=2"
    own = f"folder:{vectors.make_camera(work / 'lamp')},loop=1,fps=2"
    write_tone(work / "tone.wav")
    with host(work / "session", camera) as h, \
            member(h.greeting["links"]["expert"], "Ada", work, "--microphone", work / "tone.wav", "--voice-may-record") as ada:
        recorder = Process("record", h.greeting["links"]["expert"], file)
        ada.wait_for(lambda f: any(p["name"] == "recorder" for p in f["room"]["people"]))
        ada.say("stand 0.5 1.7 1 0 1 0")
        ada.say("brick 0.5 1 0.25")
        ada.wait_for(lambda f: f["room"]["objects"])
        wait_until(lambda: file.exists() and file.stat().st_size > 10000, of=recorder)
        with Process("publish", h.greeting["links"]["publisher"], "--camera", own, "--may-record", "--name", "Ben"):
            second = file.with_name(file.stem + ".002.mkv")
            wait_until(lambda: second.exists() and second.stat().st_size > 12000, of=recorder)
            recorder.process.terminate()
            recorder.end()
        recorder.__exit__()


def make_state(folder, work):
    """Returns what is to be known of it: tokens by what they are for."""
    state = work / "state"
    camera = f"folder:{vectors.make_camera(work / 'of the state/table')},loop=1,fps=2"
    facts = {}
    with host(state, camera, options=("--session", "OR 3")) as h:
        made = {}
        for name, words in (("made", ("--role", "expert", "--for", "Dr. Ada")),
                            ("lasting", ("--role", "observer", "--hours", "10000", "--for", "Ben")),
                            ("expired", ("--role", "expert", "--hours", "0.0001", "--for", "Carl")),
                            ("revoked", ("--role", "expert", "--for", "Dora"))):
            made[name] = json.loads(checked("link", "--state", state, "--json", *words))
        checked("link", "--state", state, "--revoke", made["revoked"]["name"])
        facts["tokens"] = {role: Link.parse(link).token for role, link in h.greeting["links"].items()}
        facts["tokens"] |= {name: Link.parse(link["link"]).token for name, link in made.items()}
        checked("session", "create", "OR 4", "--state", state)
        with member(h.greeting["links"]["operator"], "Olga", work) as olga, \
                member(h.greeting["links"]["expert"], "Ada", work) as ada:
            ada.say("brick 0.5 1 0.25")
            olga.wait_for(lambda f: f["room"]["objects"])
            olga.say("nudge 0 20 -10 5 0 2 0")
            olga.wait_for(lambda f: f["cameras"] and f["cameras"][0].get("adjusted"))
            seen = olga.newest_json()
            facts["bricks"] = [o["position"] for o in seen["room"]["objects"]]
            facts["adjusted"] = seen["cameras"][0]["adjusted"]
        # The line of the adjustment comes once it has stayed so for two seconds.
        wait_until(lambda: '"adjusted"' in (state / "audit.jsonl").read_text(), of=h)
    facts["audited"] = sorted({json.loads(line)["event"] for line in (state / "audit.jsonl").read_text().splitlines()})
    # No option makes a link that lasts until then.
    lasting = state / "links" / made["lasting"]["name"]
    role, _, token, label = lasting.read_text().split(" ", 3)
    lasting.write_text(f"{role} 2126-01-01T00:00:00Z {token} {label}")
    shutil.copytree(state, folder, ignore=lambda _, names: [n for n in names if n in NOT_KEPT])
    return facts


def make_exchange(file, state, work):
    """All envelopes between a host with the kept state and a participant who looks, stands and makes a brick."""
    copy = vectors.copy_state(state, work / "state of the exchange")
    camera = f"folder:{vectors.make_camera(work / 'of the exchange/table')},loop=1,fps=2"
    envelopes, lock = [], threading.Lock()

    def pass_on(source, target, direction):
        with contextlib.suppress(EOFError, OSError):
            while True:
                data = source.receive()
                with lock:
                    envelopes.append((direction, data))
                target.send(data)

    with host(copy, camera, options=("--session", "OR 3")) as h:
        def script(guest):
            with RawPeer(h.greeting["link"]) as peer:
                threading.Thread(target=pass_on, args=(peer, guest, vectors.GOT), daemon=True).start()
                pass_on(guest, peer, vectors.SENT)

        with FakeHost(script, state=copy, token=Link.parse(h.greeting["link"]).token) as between, \
                member(between.link, "Ada", work, "--depth-codec", "strata") as ada:
            ada.wait_for(lambda f: f["phase"] == "joined" and f["cameras"] and f["cameras"][0]["frames"] > 1)
            ada.say("stand 0.5 1.7 1 0 1 0")
            ada.say("brick 1 1 1")
            ada.wait_for(lambda f: len(f["room"]["objects"]) > 1)
            ada.say("quit")
            ada.process.stdin.close()
            with lock:
                kept = list(envelopes)
    # Acknowledgements count the bytes of this connection, Pong answers this Ping's time.
    kept = [(d, e) for d, e in kept if not vectors.is_acknowledgement(e) and
            not (d == vectors.GOT and e[0] == 1 and read_control_message("ToParticipant", e[1:])[0] == "Pong")]
    vectors.write_exchange(file, kept)


def make_case(folder, work):
    """A tetrahedron as a surface, a picture, and images."""
    source = work / "scans"
    source.mkdir()
    corners = [(0, 0, 0), (80, 0, 0), (0, 80, 0), (0, 0, 80)]
    faces = [(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)]
    (source / "liver.obj").write_text("".join("v {} {} {}\n".format(*c) for c in corners) +
                                      "".join("f {} {} {}\n".format(*(i + 1 for i in f)) for f in faces))
    write_png(source / "sheet.png", 24, 16, 8, 3, [bytes((10 * y, 80, 120)) * 24 for y in range(16)])
    checked("case", "import", source, folder, "--name", "Kept liver")
    origin, step = (-10, -10, -10), 5
    volume = b"THVO" + struct.pack("<BB2x3I", 1, 0, 8, 8, 6) + struct.pack("<3d", *origin)
    volume += struct.pack("<9d", step, 0, 0, 0, step, 0, 0, 0, step) + struct.pack("<4d", 1, 0, 60, 400)
    (folder / "ct.thvolume").write_bytes(volume + struct.pack("<384h", *((i * 7) % 200 for i in range(384))))
    manifest = json.loads((folder / "case.json").read_text())
    manifest["series"] = [{"name": "CT", "modality": "CT", "file": "ct.thvolume"}]
    (folder / "case.json").write_text(json.dumps(manifest, indent=2) + "\n")


def make_places(file):
    """As `theatron register` writes it, with each key."""
    covariance = [1e-7 if row == column else 0 for row in range(6) for column in range(6)]
    file.write_text(json.dumps({"theatron_places": 1, "made": "2026-05-04T10:20:30Z", "method": "board 80x60, 10 places", "cameras": [
        {"camera": "table", "room_from_camera": {"quaternion": [0.0, 1.0, 0.0, 0.0], "translation": [0.4, 1.6, 2.0]},
         "covariance": covariance, "depth_offset_mm": 1.25, "color_gain": [1.1, 1.0, 0.9]}]}, indent=1) + "\n")


def main():
    folder = pathlib.Path(sys.argv[1])
    if folder.exists():
        raise SystemExit(f"{folder} is there already; what a version left behind does not change.")
    folder.mkdir(parents=True)
    (folder / "recordings").mkdir()
    with tempfile.TemporaryDirectory(prefix="theatron_vectors_") as work:
        work = pathlib.Path(work)
        make_recordings(folder / "recordings", work)
        make_session(folder / "recordings/session.mkv", work)
        make_case(folder / "case", work)
        state = make_state(folder / "state", work)
        make_exchange(folder / "exchange.bin", folder / "state", work)
        checked("background", "record", "--camera", f"folder:{vectors.make_camera(work / 'empty')},loop=1", "--frames", "3",
                "--out", folder / "empty.background")
        make_places(folder / "places.json")
    expected = {
        "recordings": {file.name: vectors.recording_facts(file) for file in sorted((folder / "recordings").glob("*.mkv"))
                       if not file.stem.endswith(".002")},
        "state": state,
    }
    (folder / "expected.json").write_text(json.dumps(expected, indent=1) + "\n")
    print(subprocess.run(["du", "-ab", folder], capture_output=True, text=True).stdout)


if __name__ == "__main__":
    main()
