# SPDX-License-Identifier: Apache-2.0
"""Files of finished cases and pictures, with which their readers' fuzz targets begin
(docs/formats/case_volume.md, case_mesh.md, case.md)."""

import json
import struct
import zlib


def volume(slope=1.0, window=(40.0, 400.0), inverted=0):
    size, numbers = (3, 2, 2), [-10, -20, 5, 0.5, 0, 0, 0, 0.75, 0, 0, 0, 2, slope, -1024, *window]
    samples = [100 * i for i in range(12)]
    return b"THVO\1" + bytes([inverted, 0, 0]) + struct.pack("<3I16d12h", *size, *numbers, *samples)


def mesh():
    points, normals, triangle = [0, 0, 0, 1, 0, 0, 0, 1, 0], [0, 0, 1] * 3, [0, 1, 2]
    return b"THME\1\0\0\0" + struct.pack("<2I9f9f3I", 3, 1, *points, *normals, *triangle)


def manifest(**more):
    part = {"name": "liver", "role": "shell", "file": "part_1.thmesh", "color": "#b25c4a", "opacity": 0.35}
    series = {"name": "CT", "modality": "CT", "file": "series_1.thvolume", "missing_slices": [12]}
    picture = {"name": "Consent, page 1", "file": "picture_1.thpicture"}
    root = {"theatron_case": 2, "name": "Liver", "units": "mm", "space": "LPS", "deidentified": True, "license": "",
            "credit": "", "parts": [part], "series": [series], "pictures": [picture]}
    root.update(more)
    return json.dumps(root).encode()


def patient():
    return json.dumps({"series": [{"file": "series_1.thvolume", "PatientName": "Doe^Jane",
                                   "PatientBirthDate": "19610203", "PatientID": "AB-4711"}]}).encode()


def png(color=2, depth=8, channels=3, interlaced=0, chunks=(), size=(4, 3)):
    """`size` is what it announces; its pixels are those of 4 x 3."""
    def chunk(kind, body):
        return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))
    width, height = 4, 3
    row = b"\0" + bytes(range(width * channels * depth // 8))
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">2I5B", *size, depth, color, 0, 0, interlaced))
            + b"".join(chunk(kind, body) for kind, body in chunks) + chunk(b"IDAT", zlib.compress(row * height))
            + chunk(b"IEND", b""))


def seeds():
    """(fuzz target, name, bytes)"""
    for name, one in (("plain", volume()), ("small", volume(1e-6, (0.0015, 0.003))), ("inverted", volume(inverted=1))):
        yield "volume_fuzz", name, one
    yield "mesh_fuzz", "triangle", mesh()
    for name, one in (("plain", manifest()), ("ras", manifest(space="RAS", units="m")), ("empty", manifest(parts=[]))):
        yield "manifest_fuzz", name, one
    yield "patient_texts_fuzz", "plain", patient()
    for name, one in (("rgb", png()), ("rgba", png(6, 8, 4)), ("grey", png(0, 8, 1)), ("deep", png(2, 16, 3)),
                      ("table", png(3, 8, 1, chunks=[(b"PLTE", bytes(range(48)))])),
                      ("wide", png(size=(65_536, 4))), ("huge", png(size=(40_000, 40_000)))):
        yield "picture_reader_fuzz", name, one
