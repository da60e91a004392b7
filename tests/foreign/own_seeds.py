# SPDX-License-Identifier: Apache-2.0
"""Texts, messages and files of our own formats, with which their readers' fuzz targets begin: from the pages of
docs/formats, from the files of released versions in tests/vectors, and from what people and other programs write."""

import base64
import hashlib
import json
import pathlib
import re
import struct

import case_seeds
import face_seeds

ROOT = pathlib.Path(__file__).resolve().parents[2]
VECTORS = ROOT / "tests/vectors/0.1.0"
HASH = hashlib.sha256(b"case").digest()


# ---- pages

def blocks(page, language):
    """The code blocks of a page in this language."""
    return re.findall(rf"^```{language}\n(.*?)^```", (ROOT / page).read_text(), re.MULTILINE | re.DOTALL)


def vector(page):
    """The bytes of the last block of a page."""
    return bytes.fromhex(blocks(page, "")[-1])


# ---- the room

def place(x=0.0, y=0.0, z=0.0, scale=1.0):
    return struct.pack("<8d", 1, 0, 0, 0, x, y, z, scale)


def properties(content):
    return struct.pack("<H", len(content)) + content


def room_object(number, kind, content, holder=0, grip=0, moved_at=0):
    return struct.pack("<IBIIIq", number, kind, 7, holder, grip, moved_at) + place(0.5, 1, -2) + properties(content)


PERSON = b"\3\2Ann"
BRICK = bytes([2, 4, 3])
PIN = vector("docs/formats/mark.md")
POSE = vector("docs/formats/person_pose.md")


def text(words):
    data = words.encode()
    return struct.pack("<H", len(data)) + data


def shared_screen():
    return struct.pack("<BHBHH", 5, 3, 1, 1280, 720) + text("Dr. Ann") + text("laptop")


def case_objects():
    yield "case", b"\1" + HASH + bytes([40, 1])
    yield "part", b"\2" + HASH + struct.pack("<HBB", 5, 1, 128)
    yield "name", b"\6" + HASH + text("Liver 7")
    screen = struct.pack("<BB3d", 0, 2, -12.5, 40, 400)
    yield "slice", b"\3" + HASH + screen
    yield "picture", b"\4" + HASH + screen + struct.pack("<HI", 1, 7)


def marks():
    def point(x, y, z):
        return struct.pack("<3f3h", x, y, z, 0, 0, 32767)

    def mark(kind, surface, number_of_object, points, number=0, deviation=0.0):
        return (struct.pack("<BBIBHf", kind, surface, number_of_object, 3, number, deviation) + b"\2AB" + bytes([len(points)])
                + b"".join(points))
    yield "pin", PIN
    yield "stroke", mark(1, 1, 0, [point(0.01 * i, 1, -2) for i in range(5)])
    yield "arrow", mark(2, 2, 9, [point(0, 0, 0), point(0.1, 0, 0)])
    yield "distance", mark(4, 1, 0, [point(0, 1, -2), point(0.25, 1, -2)], deviation=0.004)


def requests():
    yield "create", b"\1\2" + place() + properties(BRICK)
    yield "mark", b"\1\5" + place() + properties(PIN)
    yield "remove", struct.pack("<BI", 2, 1)
    yield "grab", struct.pack("<BI", 3, 1)
    yield "release", struct.pack("<BII", 4, 1, 8) + place(1)
    yield "hand_over", struct.pack("<BIII", 5, 1, 8, 9)
    yield "properties", struct.pack("<BI", 6, 1) + properties(BRICK)
    yield "clear", b"\7\1"


def room_bytes():
    objects = room_object(1, 1, PERSON) + room_object(2, 2, BRICK, 7, 8, 1_000_000) + room_object(3, 5, PIN)
    yield "objects", objects
    yield "person", PERSON
    yield from requests()
    # Messages to a member: kind and number, size in units of four bytes, body.
    person = room_object(1, 1, PERSON)
    pose = struct.pack("<IIq", 7, 8, 2_000_000) + place(1)
    yield "messages", b"".join(bytes([what, len(body) // 4]) + body
                               for what, body in ((4, person), (1, person), (2, b""), (3, pose)))


def varint(value):
    out = b""
    while value >= 0x80:
        out += bytes([value & 0x7f | 0x80])
        value >>= 7
    return out + bytes([value])


def difference(value):
    return varint(2 * value if value >= 0 else -2 * value - 1)


def room_track():
    objects = room_object(1, 1, PERSON) + room_object(2, 2, BRICK, 7, 8, 1_000_000)
    key = (b"\1" + varint(0) + varint(len(objects)) + objects + varint(1) + varint(7) + varint(len(POSE)) + POSE
           + b"\4" + varint(1000) + varint(2) + difference(100_000) + 8 * difference(0)
           + b"\6" + varint(2000) + varint(7))
    brick = room_object(4, 2, BRICK)
    later = b"\2" + varint(0) + varint(len(brick)) + brick + b"\3" + varint(500) + varint(2)
    return b"".join(struct.pack("<H", len(part) << 1 | is_key) + part for part, is_key in ((key, 1), (later, 0)))


# ---- cameras

def azure_calibration():
    def camera(location, width, height, x):
        lens = [0.5, 0.25, 0.75, 1.0, 1, 2, 3, 4, 5, 6, 0, 0, 0.02, 0.01]
        return {"Location": f"CALIBRATION_CameraLocation{location}", "SensorWidth": width, "SensorHeight": height, "MetricRadius": 0,
                "Intrinsics": {"ModelType": "CALIBRATION_LensDistortionModelBrownConrady", "ModelParameters": lens},
                "Rt": {"Rotation": [1, 0, 0, 0, 1, 0, 0, 0, 1], "Translation": [x, 0, 0]}}
    cameras = [camera("D0", 1024, 1024, 0), camera("PV0", 4096, 3072, -0.032)]
    return json.dumps({"CalibrationInformation": {"Cameras": cameras}}).encode()


def calibration_bytes():
    def camera(width, height):
        return struct.pack("<2H13d", width, height, 500, 501, width / 2, height / 2, 0.5, -0.02, 0, 0.9, 0.1, 0, 0, 0, 1.7)
    pose = struct.pack("<7d", 1, 0, 0, 0, 0.4, 1.6, 2)
    fields = [camera(640, 576), camera(1280, 720), pose, struct.pack("<d", 1), b"\1" + pose, struct.pack("<Q", 77),
              struct.pack("<21d", *(1e-6 if i in (0, 6, 11, 15, 18, 20) else 0 for i in range(21))), struct.pack("<d", 1.25),
              struct.pack("<3d", 1.1, 1, 0.9), struct.pack("<I", 3)]
    yield "all_fields", b"\2" + b"".join(struct.pack("<BH", i, len(f)) + f for i, f in enumerate(fields, 1))
    yield "depth_alone", b"\2" + struct.pack("<BH", 1, len(fields[0])) + fields[0]
    yield "version_1", b"\1\1" + fields[0] + fields[1] + pose + fields[3] + pose


RTSP = {
    "url": "rtsp://cart:p%40ss:word@tower.local:8554/live?a=b",
    "answer": "RTSP/1.0 200 OK\r\nCSeq: 2\r\nContent-Length: 12\r\nSession: abc;timeout=30\r\n"
              "Transport: RTP/AVP/TCP;unicast;interleaved=4-5\r\nContent-Base: rtsp://h/x/\r\n\r\n",
    "digest": "RTSP/1.0 401 Unauthorized\r\nCSeq: 3\r\nWWW-Authenticate: Digest realm=\"r\", nonce=\"n\", algorithm=MD5\r\n\r\n",
    "basic": "RTSP/1.0 401 Unauthorized\r\nCSeq: 3\r\nWWW-Authenticate: Basic realm=\"r\"\r\n\r\n",
    "request": "OPTIONS rtsp://h/x RTSP/1.0\r\nCSeq: 9\r\n\r\n",
    "description": "v=0\r\nc=IN IP4 10.0.0.1\r\na=control:*\r\nm=audio 0 RTP/AVP 0\r\na=control:a\r\nm=video 5000 RTP/AVP 97\r\n"
                   "a=rtpmap:97 H264/90000\r\na=fmtp:97 packetization-mode=1\r\na=control:track2\r\n",
}


def lattice(bar=6, cell=12):
    """64x48 pixels: 251 starts a surface at 1 m, 252 one at 2 m."""
    return bytes(251 if x % (bar + cell) < bar or y % (bar + cell) < bar else 252 for y in range(48) for x in range(64))


def sealed_media():
    """A sealed media message of the key 1, whose tag is none."""
    payload = bytes(range(40)) + struct.pack("<IQ", 1, 1) + bytes(16)
    return struct.pack("<4B2H2I2HI2q4IQ", 1, 66, 1, 0, 1, 2, 7, 7, 0, 1, len(payload), 33_333, 33_000, 100, 200, 2000, 2000, 0) + payload


def received_h264():
    """A first byte that chooses settings with colour as h264, and a key frame of the colour stream behind its length."""
    payload = (ROOT / "tests/corpus/color_h264_fuzz/key").read_bytes()
    header = struct.pack("<4B2H2I2HI2q4IQ", 1, 67, 1, 0, 1, 2, 0, 0, 0, 1, len(payload), 33_333, 33_000, 100, 200, 2000, 2500, 0)
    length = len(header) + len(payload)
    return struct.pack("<BBH", 65, length & 0xff, length >> 8) + header + payload


# ---- cases

def shared_case():
    content = HASH + struct.pack("<Q", 160)
    parts = struct.pack("<H", 1) + text("liver") + bytes([0, 178, 92, 74, 89]) + content
    series = struct.pack("<H", 1) + text("CT") + text("CT") + struct.pack("<H", 1) + content
    head = text("Liver") + text("CC0") + text("") + struct.pack("<3d", 10, -20, 30)
    yield "pictures", b"THCS\2\1" + head + parts + series + struct.pack("<H", 1) + text("Consent") + content
    yield "version_1", b"THCS\1\1" + head + parts + series


def foreign_answers():
    """A first byte, which chooses the kind, and the answer."""
    def short(words):
        return bytes([len(words)]) + words.encode()
    identifiers = short("ISO_IR 100") + b"\2" + short("PatientName") + short("Doe^Jane") + short("PatientID") + short("AB-4711")
    yield "identifiers", b"\2" + identifiers
    # Two columns, one row; it has a place and a window. One with a problem has no samples.
    for name, problem, samples in (("slice", "", struct.pack("<2h", 1000, 1100)), ("slice_with_a_problem", "is encrypted", b"")):
        yield name, (b"\1" + short("1.2.3") + short("1.2.4") + short("CT") + struct.pack("<HHB", 2, 1, 3) + short(problem) + 8 * short("")
                     + struct.pack("<3I9d6d", 1, 0, 0, 1, 0, 0, 0, 1, 0, -10, -20, 5, 0.5, 0.5, 1, -1024, 40, 400)
                     + identifiers + samples)
    yield "mesh", b"\0" + short("liver") + struct.pack("<2I9f3I", 3, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 1, 2)


# ---- texts

NAMES = ["Ann", "Dr. Ann-Marie O'Neill", "Ann (operator)", "Ann, #2", "\u0410nn", "  Zo\u00e8  ", "\u202egnitide", "A\u0301", "x" * 80]
CHAINS = ["off", "paper", "default", "stereo", "default+background", "range:max_mm=3500+holes+kalman",
          "holes:iterations=2,max_size=6+flying_pixels:min_support=4+speckles:max_pixels=12", "kalman:gain_1000=120,hold_frames=4",
          "steady:step_mm=2,squared_mm=6,frames=5,together_100=90", "background:margin_mm=30,margin_sigmas=2"]
CODECS = ["raw", "rvl", "trvl:layers=3", "zstd:delta=1,level=3", "lz4:level=9", "ans:delta=1,layers=3", "strata", "strata:layers=3",
          "strata:everywhere=1", "jpeg:quality=85", "jpeg:subsampling=444", "h264:crf=20", "h264:crf=24,preset=veryfast",
          "h264:crf=8", "h264:encoder=x264,crf=20", "h264:bitrate_mbit=4", "none", "auto"]


# The certificate of a host "or3" with two other names; valid for a hundred years.
CERTIFICATE = """-----BEGIN CERTIFICATE-----
MIIBWjCCAQygAwIBAgIUba8Ps+j+jR2kJ8P1NLcg9Ojpv+wwBQYDK2VwMA4xDDAK
BgNVBAMMA29yMzAgFw0yNjExMjcxODIyMTBaGA8yMTI2MTEwMzE4MjIxMFowDjEM
MAoGA1UEAwwDb3IzMCowBQYDK2VwAyEAXZQ0HaTrQEhqbqlg+yYmnSpewHP8cEFZ
O6VvuGyMigCjejB4MB0GA1UdDgQWBBQLyhvfoPg3zItwhYfK8Gmyobb73DAfBgNV
HSMEGDAWgBQLyhvfoPg3zItwhYfK8Gmyobb73DAPBgNVHRMBAf8EBTADAQH/MCUG
A1UdEQQeMByCFG9yMy5ob3NwaXRhbC5leGFtcGxlhwQKAAADMAUGAytlcANBACQr
/8LIN1OG45FLYL4RVo/u2T1AhvlSy+l95eMskzkaAmmGFHzxwgbQG6rB87YyTYcF
ZzZInkzndJ/BiuEE8ws=
-----END CERTIFICATE-----
"""


def certificates():
    lines = CERTIFICATE.splitlines()
    yield "text", CERTIFICATE.encode()
    yield "twice", b"chain\n" + 2 * CERTIFICATE.encode()
    yield "der", base64.b64decode("".join(lines[1:-1]))


def spoken():
    """Packets behind time in microseconds, blocks that are played and size. The Opus packets are silence."""
    packet = vector("docs/formats/voice.md")
    head, script = packet[:4], struct.pack("<HBB", 100, 1, len(packet)) + packet
    for number in range(4):
        frame = head + struct.pack("<Iq", number, 10_000 * number) + b"\xf8\xff\xfe"
        script += struct.pack("<HBB", 10_000, 1, len(frame)) + frame
    return script


def numbered(texts):
    return ((str(number), one.encode()) for number, one in enumerate(texts))


def windows_media():
    """The beginning of a file of 1000 bytes."""
    properties = bytes.fromhex("a1dcab8c47a9cf118ee400c00c205365") + struct.pack("<Q16xQ40xI", 104, 1000, 0) + bytes(12)
    return bytes.fromhex("3026b2758e66cf11a6d900aa0062ce6c") + struct.pack("<QIBB", 134, 1, 1, 2) + properties


def seeds():
    """(fuzz target, name, bytes)"""
    page_calibration = blocks("docs/formats/camera_folder.md", "json")[0].encode()
    background = (VECTORS / "empty.background").read_bytes()
    fetch = b"\1\0\0" b"\0\1\x08" b"\3\1\x08\1" b"\4\1\x08\0\1" b"\2\0\0"
    answer = struct.pack("<Bqiid", 1, 0, 1280, 720, 25.0) + struct.pack("<I", 0)
    journal = ("theatron-study-1\tP07\t0123456789abcdef\n"
               "0\t900\tagree\t1\tok\n5000\t1200\tbuild.mesh.q2\t3\tok\n5000\t0\tresumed\t-\tok\n9000\t70000\timpression.mesh.own.calm\t-\tlate\n")
    by_target = {
        **face_seeds.seeds(),
        "certificate_fuzz": certificates(),
        "journal_fuzz": [("replies", journal.encode()), ("cut", journal.encode()[:-7])],
        "shown_name_fuzz": numbered(NAMES),
        "chain_settings_fuzz": [*numbered(CHAINS), ("json", blocks("docs/filters.md", "json")[0].encode())],
        "codec_text_fuzz": numbered(CODECS),
        "config_text_fuzz": [(file.name, file.read_bytes()) for file in sorted((ROOT / "packaging").glob("*.conf"))],
        "protocol_fuzz": [(f"page_{i}", one.encode()) for i, one in enumerate(blocks("docs/formats/study.md", ""))],
        "rtsp_text_fuzz": [(name, one.encode()) for name, one in RTSP.items()],
        "calibration_fuzz": [("page", page_calibration), ("azure", azure_calibration()), ("matrix", b"525 0 319.5 0 525 239.5 0 0 1")],
        "calibration_bytes_fuzz": calibration_bytes(),
        "places_fuzz": [("file", (VECTORS / "places.json").read_bytes()), ("place", b"0.4:1.6:2:-30:15:0")],
        "cut_off_fuzz": [("matroska", bytes.fromhex("1a45dfa3801853806741 2c")), ("avi", b"RIFF\x64\0\0\0AVI "),
                         ("windows_media", windows_media())],
        "video_answer_fuzz": [("opened", answer), ("picture", b"\2" + answer[1:])],
        "receiver_fuzz": [("h264", received_h264())],
        "background_fuzz": [("empty", background), ("small", background[:8] + struct.pack("<2H", 1, 2) + background[12:28])],
        "lattice_fuzz": [("bars", lattice()), ("slope", b"\xfb\xf8\0\1\0\1"), ("flat", b"\xfb\0")],
        "png_fuzz": [("grey", case_seeds.png(0, 16, 1)), ("rgb", case_seeds.png()), ("rgba", case_seeds.png(6, 8, 4)),
                     ("wide", case_seeds.png(size=(8193, 1))), ("huge", case_seeds.png(0, 16, 1, size=(20_000, 20_000)))],
        "picture_fuzz": [("picture_1", (VECTORS / "case/picture_1.thpicture").read_bytes()),
                         ("page", vector("docs/formats/case_picture.md"))],
        "shared_case_fuzz": shared_case(),
        "foreign_answer_fuzz": foreign_answers(),
        "mark_fuzz": marks(),
        "mark_shape_fuzz": marks(),
        "camera_adjustment_fuzz": [("page", vector("docs/formats/camera_adjustment.md"))],
        "case_objects_fuzz": case_objects(),
        "shared_screen_fuzz": [("pinned", shared_screen())],
        "content_fetch_fuzz": [("fetched", fetch)],
        "room_bytes_fuzz": room_bytes(),
        "room_track_fuzz": [("key_and_later", room_track())],
        "voice_fuzz": [("spoken", spoken())],
        "relay_greeting_fuzz": [("greeting", b"TREL\1" + bytes(range(32)))],
        "sealed_media_fuzz": [("sealed", sealed_media())],
    }
    for target, ones in by_target.items():
        for name, data in ones:
            yield target, name, data
