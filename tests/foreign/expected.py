# SPDX-License-Identifier: Apache-2.0
"""An input with what an import of it must give, and the comparison with a case
(docs/formats/case_volume.md, docs/formats/case_mesh.md)."""

import json
import math
import struct


class Input:
    """`files`: name -> bytes. Either `refused` is a part of the sentence, or the case must have the
    `series`, `parts` (None: is not looked at), and a remark with each of `remarks`."""

    def __init__(self, name, files, series=None, parts=None, pictures=None, refused=None,
                 remarks=(), silent=False):
        self.name, self.files = name, files
        self.series, self.parts, self.pictures = series, parts, pictures
        self.refused, self.remarks, self.silent = refused, remarks, silent


class Series:
    """`value(x, y, z)`: the measured value. `origin`, `steps`: three numbers each."""

    def __init__(self, size, value, origin=(-10, -20, 5), steps=None, tolerance=1e-6, missing=(),
                 window=None):
        self.size, self.value, self.origin, self.tolerance = size, value, origin, tolerance
        self.steps = steps or ((0.5, 0, 0), (0, 0.75, 0), (0, 0, 2))
        self.missing, self.window = missing, window


class Part:
    """A box by its corners, or what is known of another shape."""

    def __init__(self, name=None, low=None, high=None, volume=None, triangles=None, tolerance=1e-3,
                 closed=True):
        self.name, self.low, self.high, self.volume = name, low, high, volume
        self.triangles, self.tolerance, self.closed = triangles, tolerance, closed


def near(a, b, tolerance):
    return all(abs(x - y) <= tolerance for x, y in zip(a, b))


def read_volume(path):
    data = path.read_bytes()
    columns, rows, slices = struct.unpack_from("<3I", data, 8)
    numbers = struct.unpack_from("<16d", data, 20)
    samples = struct.unpack_from("<%dh" % (columns * rows * slices), data, 148)
    return (columns, rows, slices), numbers, samples


def read_mesh(path):
    data = path.read_bytes()
    vertices, triangles = struct.unpack_from("<2I", data, 8)
    numbers = struct.unpack_from("<%df" % (3 * vertices), data, 16)
    corners = struct.unpack_from("<%dI" % (3 * triangles), data, 16 + 24 * vertices)
    points = [numbers[3 * i:3 * i + 3] for i in range(vertices)]
    return points, [corners[3 * i:3 * i + 3] for i in range(triangles)]


def volume_of(points, triangles):
    total = 0
    for a, b, c in ([points[i] for i in t] for t in triangles):
        total += (a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0])
                  + a[2] * (b[0] * c[1] - b[1] * c[0])) / 6
    return total


def is_closed(triangles):
    edges = set()
    for t in triangles:
        for a, b in ((t[0], t[1]), (t[1], t[2]), (t[2], t[0])):
            if (a, b) in edges:
                return False
            edges.add((a, b))
    return all((b, a) in edges for a, b in edges)


def series_problem(path, said, wanted):
    size, n, samples = read_volume(path)
    if size != tuple(wanted.size):
        return "has the size %s, not %s" % (size, wanted.size)
    if not near(n[0:3], wanted.origin, 1e-3):
        return "begins at %s, not %s" % (n[0:3], wanted.origin)
    for i in range(3):
        if not near(n[3 + 3 * i:6 + 3 * i], wanted.steps[i], 1e-3):
            return "has the step %s, not %s" % (n[3 + 3 * i:6 + 3 * i], wanted.steps[i])
    if tuple(said.get("missing_slices", ())) != tuple(wanted.missing):
        return "lacks the slices %s" % (said.get("missing_slices"),)
    if wanted.window and not near(n[14:16], wanted.window, 1e-9 + 0.02 * abs(wanted.window[1])):
        return "has the window %s, not %s" % (n[14:16], wanted.window)
    i = 0
    for z in range(size[2]):
        for y in range(size[1]):
            for x in range(size[0]):
                found = n[12] * samples[i] + n[13]
                i += 1
                if z in wanted.missing:
                    continue
                if not math.isclose(found, wanted.value(x, y, z), abs_tol=wanted.tolerance,
                                    rel_tol=1e-9):
                    return "has %g at %s, not %g" % (found, (x, y, z), wanted.value(x, y, z))
    return None


def part_problem(path, said, wanted):
    points, triangles = read_mesh(path)
    if wanted.name and said["name"] != wanted.name:
        return "has the name '%s', not '%s'" % (said["name"], wanted.name)
    low = [min(p[i] for p in points) for i in range(3)]
    high = [max(p[i] for p in points) for i in range(3)]
    for found, corner in ((low, wanted.low), (high, wanted.high)):
        if corner and not near(found, corner, wanted.tolerance):
            return "has a corner at %s, not %s" % (found, corner)
    if wanted.triangles and len(triangles) != wanted.triangles:
        return "has %d triangles, not %d" % (len(triangles), wanted.triangles)
    if wanted.closed and not is_closed(triangles):
        return "is not closed"
    volume = volume_of(points, triangles)
    if wanted.volume and not math.isclose(volume, wanted.volume, rel_tol=0.02):
        return "has a volume of %g mm3, not %g" % (volume, wanted.volume)
    return None


def problem(wanted, code, text, case):
    """The fault of an import; None if it has none."""
    if wanted.refused is not None:
        return None if code == 1 and wanted.refused in text else "was not refused so: " + text
    if code != 0:
        return "was refused: " + text
    manifest = json.loads((case / "case.json").read_text())
    for remark in wanted.remarks:
        if remark not in text:
            return "has no remark '%s': %s" % (remark, text)
    if wanted.silent and "remark:" in text:
        return "has a remark: " + text
    for kind, check in (("series", series_problem), ("parts", part_problem)):
        expected = getattr(wanted, kind)
        if expected is None:
            continue
        if len(manifest[kind]) != len(expected):
            return "has %d %s, not %d" % (len(manifest[kind]), kind, len(expected))
        for said, one in zip(manifest[kind], expected):
            if found := check(case / said["file"], said, one):
                return "%s: %s" % (said["name"], found)
    if wanted.pictures is not None and len(manifest.get("pictures", ())) != wanted.pictures:
        return "has %d pictures" % len(manifest.get("pictures", ()))
    return None
