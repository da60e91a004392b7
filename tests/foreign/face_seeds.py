# SPDX-License-Identifier: Apache-2.0
"""Sound inputs of the readers of faces: packets of trackers, recordings, networks and heads."""
import struct

FEATURES, HIDDEN, EMOTIONS, LANDMARKS = 156, 48, 6, 68
RECORDING = """# theatron face 1
# source xr_fb
# synthetic no
time_s,take,label,BROW_LOWERER_L,BROW_LOWERER_R,JAW_DROP
0.000,0,neutral,0.02,0.01,
0.016,0,neutral,0.02,,0.1
0.000,1,anger,0.9,0.8,0.2
0.000,2,fear,0.1,0.1,0.1
"""


def text(value):
    return value.encode() + b"\0" * (4 - len(value) % 4)


def message(address, tags, *values):
    body = b"".join(text(value) if isinstance(value, str) else struct.pack(">f", value) for value in values)
    return text(address) + text("," + tags) + body


def bundle(*messages):
    return b"#bundle\0" + struct.pack(">Q", 1) + b"".join(struct.pack(">I", len(one)) + one for one in messages)


def packets():
    jaw = message("/avatar/parameters/v2/JawOpen", "f", 0.4)
    yield "float", jaw
    yield "binary", bundle(message("/x/v2/JawOpen1", "T"), message("/x/v2/JawOpen2", "F"), message("/x/v2/SmileSadLeftNegative", "T"))
    yield "vmc", message("/VMC/Ext/Blend/Val", "sf", "jawOpen", 0.3)
    yield "nested", bundle(jaw, bundle(message("/v2/BrowUpLeft", "f", 1.0), jaw))
    yield "other", message("/avatar/change", "s", "avtr_1")


def network():
    body = b"TFNET" + struct.pack("<BBBIQ3H", 1, 2, 1, 0, (1 << 52) - 1, FEATURES, HIDDEN, EMOTIONS)
    count = 2 * FEATURES + FEATURES * HIDDEN + HIDDEN + EMOTIONS * HIDDEN + EMOTIONS
    body += struct.pack(f"<{count}f", *(0.01 * (i % 7) for i in range(count)))
    total = 2166136261
    for byte in body:
        total = (total ^ byte) * 16777619 & 0xffffffff
    return body + struct.pack("<I", total)


def head(version=2):
    corners = [(0, 0, 0), (100, 0, 0), (0, 100, 0), (0, 0, 50)]
    triangles = [(0, 1, 2), (0, 1, 3)]

    def points(move):
        return struct.pack("<12f", *(value + move for corner in corners for value in corner))
    parts = struct.pack("<6I", 1, 1, 0, 0, 0, 0) if version > 1 else b""
    places = struct.pack("<8f", 0, 0, 1, 0, 0, 1, 0.5, 0.5) if version > 1 else b""
    return (b"TFHEAD" + struct.pack("<B4I", version, len(corners), len(triangles), 1, 2) + parts
            + struct.pack(f"<{LANDMARKS}I", *(i % len(corners) for i in range(LANDMARKS))) + points(0) + places
            + b"".join(struct.pack("<3I", *one) for one in triangles) + points(-1)
            + struct.pack("<B", 24) + points(1) + struct.pack("<B", 51) + points(2))


ICT_MESH = """mtllib x.mtl
v 0 0 1
v 1 0 1
v 1 1 1
v 0 1 1
v 0 2 0
vt 0.1 0.2
vt 0.5 0.2
vt 0.5 0.6
vt 1.1 0.6
usemtl M_Face
f 1/1 2/2 3/3 4/4
usemtl M_BackHead
f 4/4 3/3 5/1
usemtl M_EyeBlend
f 1/1 2/2 3/3
"""


def ict_files():
    """A mesh, a zero, and shapes of it."""
    shape = struct.pack("<H", 7) + b"jawOpen" + struct.pack("<f15h", 0.001, *range(15))
    return ICT_MESH.encode() + b"\0ICTFKL01" + struct.pack("<III", 1, 5, 0) + shape


def enrolled():
    """Four corners, one triangle of skin and one of the head; the jaw moves one of them."""
    body = b"TFOWN" + struct.pack("<BH6I", 1, 4, 1, 1, 0, 0, 0, 0) + bytes(range(18))
    body += struct.pack("<12h", *range(0, 1200, 100)) + struct.pack("<8H", 0, 0, 65535, 0, 0, 65535, 9, 9)
    body += struct.pack("<6H", 0, 1, 2, 0, 1, 3)
    for move in range(10):
        body += struct.pack("<HH3h", 1, 2, 0, -500, 3) if move == 5 else struct.pack("<H", 0)
    for emotion in range(6):
        body += struct.pack("<I", 4) + b"\xff\xd8\xff\xd9" if emotion == 5 else struct.pack("<I", 0)
    return body


def sealed():
    return b"TFSEAL" + bytes([1, 17]) + bytes(range(16 + 12 + 16)) + b"sealed"


def landmarks():
    return ("version: 1\nn_points: 68\n{\n" + "".join(f"{i}.5 {2 * i}\n" for i in range(LANDMARKS)) + "}\n").encode()


def states():
    """A face of four bytes that is offered and sent in two pieces, and what is said of it."""
    def put(what, body, place=None):
        return bytes([what]) + (b"" if place is None else struct.pack("<H", place)) + bytes([len(body)]) + body
    offered = b"\1" + struct.pack("<I", 4) + bytes(32)
    return put(132, offered) + put(0, b"ab", 0) + put(0, b"cd", 2) + put(132, b"\2" + struct.pack("<I", 4) + bytes(32)) + put(132, b"\0")


def seeds():
    """Fuzz target: (name, bytes)."""
    return {"face_osc_fuzz": list(packets()), "face_recording_fuzz": [("takes", RECORDING.encode())],
            "face_network_fuzz": [("small", network())], "face_model_fuzz": [("head", head()), ("older_head", head(1)), ("landmarks", landmarks())],
            "ict_head_fuzz": [("small", ict_files())], "enrolled_face_fuzz": [("small", enrolled())], "own_head_fuzz": [("small", enrolled())],
            "own_faces_fuzz": [("whole", states())],
            "sealed_bytes_fuzz": [("small", sealed())]}
