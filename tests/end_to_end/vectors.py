# SPDX-License-Identifier: Apache-2.0
"""What programs of earlier versions left behind (tests/vectors/README.md), as today's program reads it.

tests/vectors/make.py writes down what these functions say; vectors_test.py compares it.
"""
import hashlib
import json
import pathlib
import shutil
import ssl
import struct
import subprocess
import tempfile

from raw_peer import ACKNOWLEDGEMENT
from theatron_process import read_png, run, write_png

VECTORS = pathlib.Path(__file__).resolve().parents[1] / "vectors"
SENT, GOT = 0, 1  # by the participant: directions in exchange.bin


def versions():
    return sorted(folder for folder in VECTORS.iterdir() if (folder / "expected.json").exists())


def _stream(stream):
    return {key: stream[key] for key in ("codec", "width", "height", "frames", "key_frames")}


def _pictures(recording):
    """A hash of all depth pictures, and for each picture the means of its colours, as they are exported."""
    depth, means = hashlib.sha256(), []
    with tempfile.TemporaryDirectory(prefix="theatron_vectors_") as folder:
        code, _, errors = run("export", recording, "--png", f"{folder}/png", "--registered")
        if code not in (0, 3):
            raise AssertionError(f"{recording}: {errors}")
        for file in sorted(pathlib.Path(folder).rglob("depth/*.png")):
            for row in read_png(file)[3]:
                depth.update(struct.pack(f"<{len(row)}H", *row))
        for file in sorted(pathlib.Path(folder).rglob("color/*.png")):
            width, height, _, rows = read_png(file)
            means.append(" ".join(f"{sum(sum(row[c::3]) for row in rows) / (width * height):.1f}" for c in range(3)))
    return {"depth_sha256": depth.hexdigest(), "color_means": means}


def recording_facts(recording):
    """What a recording holds."""
    code, out, errors = run("inspect", recording, "--verify", "--json")
    if code not in (0, 3):
        raise AssertionError(f"{recording}: {errors}")
    content = json.loads(out)
    facts = {"exit_code": code, "segments": len(content["segments"]), "damaged": content["damaged"],
             "cameras": [{"name": c["name"]} | {kind: _stream(c[kind]) for kind in ("depth", "color") if kind in c}
                         for c in content["cameras"]]}
    if "room" in content:
        facts["room"] = {key: content["room"][key] for key in ("people", "objects", "changes", "damaged")}
    if content.get("voices", {}).get("people"):
        facts["voices"] = [{"name": p["name"], "packets": p["packets"]} for p in content["voices"]["people"]]
    if content["cameras"]:
        facts |= _pictures(recording)
    return facts


def copy_state(source, target):
    """A state folder that a host takes: for its user alone, and with a key, which is not kept among the vectors.

    The key and its certificate are such as version 0.1.0 made them: P-256, PEM, for itself."""
    shutil.copytree(source, target)
    subprocess.run(["openssl", "req", "-x509", "-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:P-256", "-nodes", "-subj",
                    "/CN=Theatron host", "-days", "3650", "-keyout", target / "host.key", "-out", target / "host.crt"],
                   check=True, capture_output=True)
    for path in (target, *target.rglob("*")):
        path.chmod(0o700 if path.is_dir() else 0o600)
    return target


def make_camera(folder, frames=3):
    """A noisy slope with holes and a box that moves; colour of two fields. It stands 1.6 m above the floor."""
    width, height = 48, 40
    for kind in ("depth", "color"):
        (folder / kind).mkdir(parents=True)
    for n in range(frames):
        depth, color = [], []
        for y in range(height):
            row = [0 if (x // 6 + y // 5) % 7 == 0 else 1500 + 3 * y + (x * 7 + y * 13 + n * 5) % 3 for x in range(width)]
            line = [(60 + 2 * y, 90, 120)] * width
            if 12 <= y < 30:
                for x in range(8 + 3 * n, 20 + 3 * n):
                    row[x], line[x] = 900 + (x + n) % 2, (220, 60, 40)
            depth.append(struct.pack(f">{width}H", *row))
            color.append(b"".join(map(bytes, line)))
        write_png(folder / "depth" / f"{n:05}.png", width, height, 16, 1, depth)
        write_png(folder / "color" / f"{n:05}.png", width, height, 8, 3, color)
    lens = {"width": width, "height": height, "fx": 40, "fy": 40, "cx": 24, "cy": 20}
    (folder / "calibration.json").write_text(json.dumps({"depth": lens, "color": lens, "room_from_camera": {
        "quaternion": [0, 1, 0, 0], "translation": [0, 1.6, 0]}}))
    return folder


def fingerprint(state):
    """The SHA-256 of the certificate there, as links have it."""
    return hashlib.sha256(ssl.PEM_cert_to_DER_cert((state / "host.crt").read_text())).hexdigest()


def write_exchange(file, envelopes):
    """Envelopes of one connection, [(direction, bytes)] in their order: u8 direction, u32 size, the bytes."""
    file.write_bytes(b"".join(struct.pack("<BI", direction, len(data)) + data for direction, data in envelopes))


def read_exchange(file):
    data, at, envelopes = file.read_bytes(), 0, []
    while at < len(data):
        direction, size = struct.unpack_from("<BI", data, at)
        envelopes.append((direction, data[at + 5:at + 5 + size]))
        at += 5 + size
    return envelopes


def is_acknowledgement(envelope):
    """It counts the bytes of its own connection and is of no use in another."""
    return envelope[0] == ACKNOWLEDGEMENT
