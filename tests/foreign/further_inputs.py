# SPDX-License-Identifier: Apache-2.0
"""Habits of programs that take names out, of copies that do not end, of new packings, and of single programs for surfaces."""

import gzip
import math
import struct

import dicom_bytes as d
import dicom_inputs
from dicom_bytes import COLUMNS, ROWS, Encoding, file_of, slice_elements, stored
from dicom_inputs import enhanced, folder, good, measured, series
from expected import Input, Part
from label_inputs import ORGANS, SIZE, STEP, labels, nifti, nrrd, part, parts, samples
from mesh_inputs import CORNERS, HIGH, LOW, QUADS, TRIANGLES, VOLUME, box, ply, stl_binary, stl_text

OTHER = {"_0020000e": ("UI", "1.2.3.9")}
PIXELS = 0x7fe00010


def every(count=4, **changed):
    return folder(lambda k: file_of(slice_elements(k, **changed)), count)


def written_otherwise():
    def backwards(k):
        elements, encoding = slice_elements(k), Encoding()
        pixels = encoding.element(PIXELS, *elements.pop(PIXELS))
        body = b"".join(encoding.element(tag, *elements[tag]) for tag in sorted(elements, reverse=True))
        return bytes(128) + b"DICM" + d.meta(d.EXPLICIT) + body + pixels
    yield Input("elements from the last to the first", folder(backwards), [series()])
    yield Input("a slope behind the pixels", folder(lambda k: file_of(
        slice_elements(k, _00281053=None), tail=Encoding().element(0x00281053, "DS", "2"))),
        [series(lambda x, y, z: measured(x, y, z, 2))])
    for tag, kind, first, second, words in ((0x00281053, "DS", "2", "3", "rescale slope"),
                                            (0x00280030, "DS", "0.75\\0.5", "1\\1", "pixel spacing"),
                                            (0x00280103, "US", 0, 1, "pixel representation")):
        def twice(k, tag=tag, kind=kind, values=(first, second)):
            elements = slice_elements(k)
            elements[tag] = b"".join(Encoding().element(tag, kind, value) for value in values)
            return file_of(elements)
        yield Input("two values: " + words, folder(twice), refused="has two values of its " + words)
    slope = Encoding().element(0x00281053, "DS", "1")
    yield Input("one value twice", every(_00281053=slope * 2), [series()])
    yield Input("a place with a backslash behind", folder(lambda k: file_of(slice_elements(
        k, _00200032=("DS", "-10\\-20\\%g\\" % (5 + 2 * k))))), [series()])
    yield Input("its mark without a preamble", {name: data[128:] for name, data in good().items()}, [series()])
    yield Input("MONOCHROME2 in small letters", every(_00280004=("CS", "monochrome2  ")), [series()])
    length = struct.pack("<HH", 0x7fe0, 0x0010) + b"OB\0\0"

    def with_length(k):
        open_ended = d.fragments([d.rle(stored(k))])
        return length + struct.pack("<I", len(open_ended) - 12) + open_ended[12:]
    yield Input("packed pixels with a length", folder(lambda k: file_of(slice_elements(k, _7fe00010=with_length(k)), d.RLE)), [series()])


def pixels():
    words = "at least twice the pixels"
    yield Input("16 bits that are said to be 8", every(_00280100=("US", 8), _00280101=("US", 8), _00280102=("US", 7)), refused=words)
    double = folder(lambda k: file_of(slice_elements(k, _7fe00010=("OW", stored(k) * 2))))
    yield Input("two images, said to be one", double, refused=words)
    beside = folder(lambda k: file_of(slice_elements(k, _7fe00010=("OW", stored(k) * 2), **OTHER)), name="x%d.dcm")
    yield Input("two images, said to be one, beside", good() | beside, [series()], remarks=["A series is left out", words])
    yield Input("a row of zeros behind", folder(lambda k: file_of(slice_elements(k, _7fe00010=("OW", stored(k) + [0] * COLUMNS)))),
                [series()])
    for name, syntax in (("HTJ2K", "1.2.840.10008.1.2.4.201"), ("JPEG XL", "1.2.840.10008.1.2.4.110"),
                         ("deflate", "1.2.840.10008.1.2.8.1"), ("1.2.3.4.99", "1.2.3.4.99")):
        packed = folder(lambda k, syntax=syntax: file_of(slice_elements(k, _7fe00010=d.fragments([b"\1\2\3\4" + bytes(200)]), **OTHER),
                                                         syntax), name="x%d.dcm")
        said = "has its pixels packed as %s, which is not read; export it uncompressed" % name
        yield Input("packed as %s beside" % name, good() | packed, [series()], remarks=["A series is left out", said])
        yield Input("packed as %s" % name, packed, refused=said)
    yield Input("scales of 16 bits that differ", folder(lambda k: file_of(slice_elements(
        k, _00281053=("DS", str(1 + k)), _00281052=("DS", str(-32768 * k)), _00281050=None, _00281051=None,
        _7fe00010=("OW", [16 * v & 0xffff for v in stored(k)])))), [series(
            lambda x, y, z: (1 + z) * (16 * stored(z)[y * COLUMNS + x] & 0xffff) - 32768 * z, tolerance=4.1)])


def without_names():
    yield Input("a frame of reference of each image", folder(lambda k: file_of(slice_elements(
        k, _00200052=("UI", "1.9.%d" % k))), 8), [series(count=8)], remarks=["names a frame of reference of its own"])
    yield Input("a series of each image", folder(lambda k: file_of(slice_elements(k, _0020000e=("UI", "1.9.%d" % k))), 8),
                [series(count=8)], remarks=["8 images that name a series of their own each lie in one row"])
    both = folder(lambda k: file_of(slice_elements(k, _0020000e=("UI", "1.9.%d" % k), _0008103e=("LO", "ABDOMEN"))), 8)
    yield Input("a series of each image, beside another", good() | {"b/" + name: data for name, data in both.items()},
                [series(count=8), series()])
    yield Input("two images of two series", folder(lambda k: file_of(slice_elements(k, _0020000e=("UI", "1.9.%d" % k))), 2),
                [series(count=1, steps=((0.5, 0, 0), (0, 0.75, 0), (0, 0, 1))),
                 series(lambda x, y, z: measured(x, y, 1), count=1, origin=(-10, -20, 7), steps=((0.5, 0, 0), (0, 0.75, 0), (0, 0, 1)))])

    def turned(k):
        a = math.radians(10 * k)
        return file_of(slice_elements(k, _00080008=("CS", "DERIVED\\SECONDARY\\AXIAL\\MIP"), _00200037=(
            "DS", "%.6f\\%.6f\\0\\0\\0\\-1" % (math.cos(a), math.sin(a))), _00200032=(
                "DS", "%.4f\\%.4f\\50" % (-10 * math.cos(a), -10 * math.sin(a))), **OTHER))
    views = folder(turned, 18, "mip%02d.dcm")
    words = "Each of the 18 images of the series lies in another plane"
    yield Input("views from all around beside", good() | views, [series()], remarks=["A series is left out: " + words])
    yield Input("views from all around", views, refused=words)
    files = {"P%d-%d.dcm" % (p, k): file_of(slice_elements(k, _00200012=("IS", str(p + 1)), _7fe00010=(
        "OW", [v + 50 * p for v in stored(k)]))) for p in range(4) for k in range(4) if (p, k) != (2, 1)}
    yield Input("four phases, of which one lacks an image", files, [series(
        lambda x, y, z, p=p: measured(x, y, z) + 50 * p, missing=[1] if p == 2 else []) for p in range(4)], remarks=["lacks 1 of 4 slices"])


def frames():
    echoes = [{0x00209113: ("SQ", [{0x00200032: ("DS", "-10\\-20\\%d" % (5 + 2 * k))}]),
               0x00189114: ("SQ", [{0x00189082: ("FD", struct.pack("<d", 2.3 + 2 * e))}])} for k in range(4) for e in (0, 1)]
    values = [v + 50 * e for k in range(4) for e in (0, 1) for v in stored(k)]
    yield Input("enhanced, two echoes", {"a.dcm": file_of(enhanced(8, _52009230=("SQ", echoes), _7fe00010=("OW", values)))},
                [series(), series(lambda x, y, z: measured(x, y, z) + 50)], remarks=["2 images at each place"])
    yield Input("enhanced, direction and spacing of each", {"a.dcm": file_of(enhanced(4, each=lambda k: {
        0x00209113: ("SQ", [{0x00200032: ("DS", "-10\\-20\\%d" % (5 + 2 * k))}]),
        0x00209116: ("SQ", [{0x00200037: ("DS", "1\\0\\0\\0\\1\\0")}]), 0x00289110: ("SQ", [{0x00280030: ("DS", "0.75\\0.5")}])},
        _52009229=("SQ", [{}])))}, [series()])
    packed = [d.rle(stored(k)) for k in range(4)]
    offsets = [sum(8 + len(p) for p in packed[:k]) for k in range(4)]
    yield Input("enhanced, long offsets", {"a.dcm": file_of(enhanced(4, _7fe00001=("OV", struct.pack("<4Q", *offsets)), _7fe00002=(
        "OV", struct.pack("<4Q", *map(len, packed))), _7fe00010=d.fragments(packed)), d.RLE)}, [series()])
    nuclear = slice_elements(0, _00080060=("CS", "NM"), _00280008=("IS", "4"), _00540022=("SQ", [{
        0x00200032: ("DS", "-10\\-20\\5"), 0x00200037: ("DS", "1\\0\\0\\0\\1\\0")}]), _00200032=None, _00200037=None, _7fe00010=(
            "OW", [v for k in range(4) for v in stored(k)]), **OTHER)
    yield Input("SPECT in one file beside", good() | {"nm.dcm": file_of(nuclear)}, [series()],
                remarks=["nm.dcm' is left out: it holds several images"])
    surface = file_of({0x00080016: ("UI", "1.2.840.10008.5.1.4.1.1.104.3"), 0x00080060: ("CS", "M3D"), 0x00100020: ("LO", "GEN-1"),
                       0x0020000e: ("UI", "1.2.9"), 0x00420011: ("OB", stl_binary())})
    yield Input("a surface as a document beside", good() | {"m.dcm": surface}, [series()],
                remarks=["m.dcm' is left out: it holds a surface as a DICOM document"])
    yield Input("a surface as a document", {"m.dcm": surface}, refused="holds a surface as a DICOM document")


def copies():
    whole = good()
    for end in (".part", ".filepart", ".crdownload"):
        yield Input("a copy that did not end (%s)" % end, whole | {"IM002.dcm" + end: whole["IM002.dcm"][:500]}, [series()],
                    remarks=["IM002.dcm%s' is left out: it is a copy that did not end" % end])
    deep = {"a/b/c/d/e/f/g/h/i/j/k/l/" + name: data for name, data in whole.items()}
    yield Input("twelve folders deep", deep, [series()])
    yield Input("forty folders deep", {"x/" * 40 + name: data for name, data in whole.items()} | {"liver.stl": stl_binary()}, [],
                [box("liver")], remarks=["lies too many folders deep, so what it holds is left out"])
    yield Input("names that differ in case alone", whole | {name.lower(): data for name, data in whole.items()}, [series()],
                remarks=["4 images are in the series twice"])
    yield Input("blanks and points at the end of names", {"CT Abdomen /IM %d ." % k: file_of(slice_elements(k)) for k in range(4)},
                [series()])


def pictures():
    damaged = {"VIEWER/icon.jpg": b"\xff\xd8\xff\xe0" + bytes(40), "VIEWER/logo.png": b"\x89PNG\r\n\x1a\n" + bytes(40)}
    yield Input("damaged ones of a disc's viewer", good() | damaged, [series()], pictures=0,
                remarks=["2 files are left out, since each of them is damaged"])
    yield Input("damaged ones alone", damaged, refused="is damaged")
    maps = {"%s.nii.gz" % name: gzip.compress(nifti(labels((0, 1, 0)))) for name in ("liver", "spleen", "colon", "heart", "aorta")}
    far = folder(lambda k: file_of(slice_elements(k, _00200032=("DS", "900\\900\\%d" % (900 + 2 * k)))))
    yield Input("parts outside of all images", maps | far, remarks=["5 parts lie outside of all images; check"])


def shape_of(keep):
    return [int(keep(x, y, z)) for z in range(SIZE[2]) for y in range(SIZE[1]) for x in range(SIZE[0])]


def turned_part(number, place):
    spans = [[end - 0.5 for end in span] for span in ORGANS[number]]
    corners = [place(i, j, k) for i in spans[0] for j in spans[1] for k in spans[2]]
    volume = math.prod((b - a) * step for (a, b), step in zip(ORGANS[number], STEP))
    return Part("label %d" % number, [min(c) for c in zip(*corners)], [max(c) for c in zip(*corners)], volume, tolerance=2.5)


def nifti_files():
    c, s = math.cos(math.radians(30)), math.sin(math.radians(30))
    a, b, e = STEP
    rows = [(-a, 0, 0, -12), (0, -b * c, -e * s, 30), (0, -b * s, e * c, 40)]

    def place(i, j, k):
        x, y, z = (row[0] * i + row[1] * j + row[2] * k + row[3] for row in rows)
        return -x, -y, z
    yield Input("turned by 30 degrees", {"o.nii.gz": gzip.compress(nifti(matrix=rows))}, parts=[turned_part(n, place) for n in (1, 2)])
    hollow = shape_of(lambda x, y, z: 2 <= x < 18 and 2 <= y < 14 and 2 <= z < 10
                      and not (6 <= x < 14 and 5 <= y < 11 and 4 <= z < 8))
    yield Input("a hollow organ", {"liver.nii": nifti(hollow)}, parts=[Part("liver", volume=(16 * 12 * 8 - 8 * 6 * 4) * 9)])
    yield Input("a single sample", {"liver.nii": nifti(shape_of(lambda x, y, z: (x, y, z) == (9, 7, 5)))}, parts=[Part("liver", volume=9)])
    yield Input("a label up to all borders", {"body.nii": nifti(shape_of(lambda x, y, z: True))}, parts=[Part("body", volume=3840 * 9)])


def nrrd_files():
    data = samples(labels(), "int16", "<")
    for path in ("C:\\data\\o.raw", "\\\\server\\share\\o.raw", "/home/user/o.raw", "./o.raw"):
        yield Input("samples at " + path, {"o.nhdr": nrrd([], fields={"data file": path}), "o.raw": data}, parts=parts(), silent=True)
    for path in ("data/o.raw", "..\\o.raw", "../o.raw"):
        yield Input("samples at %s, another file beside" % path, {"o.nhdr": nrrd([], fields={"data file": path}), "o.raw": data,
                                                                  "data/o.raw": data},
                    refused="keeps its samples in another file, '%s', which is not beside it" % path)
    yield Input("a field twice", {"o.nrrd": nrrd(keys="space origin: (0,0,0)\n")}, refused="has the field 'space origin' twice")
    yield Input("a field twice, with one value", {"o.nrrd": nrrd(keys="dimension: 3\n")}, parts=parts())
    keys = ("Segment0_ID:=Segment_1\nSegment0_Name:=Leber größe Ω\nSegment0_LabelValue:=1\nSegment0_Layer:=0\n"
            "Segment0_Tags:=Segmentation.Status:inprogress|TerminologyEntry:Seg~x|\nSegment0_Extent:=3 9 2 11 2 8\n")
    yield Input("names and terms of 3D Slicer", {"o.seg.nrrd": nrrd(labels((0, 1, 0)), keys=keys, encoding="gzip")},
                parts=[part(1, "Leber größe Ω")])


def surfaces():
    ras = [Part("liver", (-50, -45, 30), (-10, -20, 60), VOLUME, 12)]
    yield Input("STL of 3D Slicer in RAS", {"liver.stl": stl_binary(b"3D Slicer output. SPACE=RAS")}, parts=ras)
    small = [tuple(low + (v - low) * 0.5 + (high - low) * 0.25 for v, low, high in zip(p, LOW, HIGH)) for p in CORNERS]
    facets = [[CORNERS[i] for i in t] for t in TRIANGLES] + [[small[i] for i in reversed(t)] for t in TRIANGLES]
    cavity = bytes(80) + struct.pack("<I", 24) + b"".join(
        bytes(12) + b"".join(struct.pack("<3f", *p) for p in facet) + bytes(2) for facet in facets)
    yield Input("STL with a cavity", {"liver.stl": cavity}, parts=[Part("liver", LOW, HIGH, VOLUME * 7 / 8, 24)])
    yield Input("STL with four numbers of a corner", {"o.stl": stl_text().replace(b"vertex ", b"vertex 1 ")}, refused="is damaged")
    yield Input("STL with Fortran's exponents", {"o.stl": stl_text(number="%.3e").replace(b"e+", b"D+")}, refused="is damaged")
    corners = ["v %g %g %g" % p for p in CORNERS]
    faces = ["f " + " ".join("%d" % (i + 1) for i in q) for q in QUADS]
    sides = [line for n, face in enumerate(faces) for line in ("g side%d" % n, face)]
    yield Input("OBJ with a group of each side", {"liver.obj": "\n".join(corners + sides).encode()}, parts=[box("liver")], silent=True)
    other = ["v %g %g %g" % (p[0] + 100, p[1], p[2]) for p in CORNERS] + ["g tumour"] + [
        "f " + " ".join("%d" % (i + 9) for i in q) for q in QUADS]
    tumour = Part("tumour", (110, 20, 30), (150, 45, 60), VOLUME, 12)
    yield Input("OBJ with a group of each organ", {"o.obj": "\n".join(corners + ["g liver"] + faces + other).encode()},
                parts=[box("liver"), tumour])
    yield Input("OBJ with groups of sides beside an organ", {"o.obj": "\n".join(corners + sides + other).encode()},
                parts=[box(None), tumour])
    yield Input("OBJ of 3D Slicer in RAS", {"liver.obj": "\n".join(["# 3D Slicer output. SPACE=RAS"] + corners + faces).encode()},
                parts=ras)
    head = (b"ply\nformat binary_little_endian 1.0\nelement vertex 8\nproperty float x\nproperty float y\nproperty float z\n"
            b"element face 6\nproperty list uchar float vertex_indices\nend_header\n")
    body = b"".join(struct.pack("<3f", *p) for p in CORNERS) + b"".join(struct.pack("<B4f", 4, *q) for q in QUADS)
    yield Input("PLY with indices as floating-point numbers", {"liver.ply": head + body}, parts=[box("liver")])
    half = ply(extra=False)
    for p in CORNERS:
        line = "%g %g %g\n" % p
        half = half.replace(line.encode(), (" ".join("%.1f" % (v + 0.5) for v in p).replace(".", ",") + "\n").encode())
    yield Input("PLY with decimal commas", {"liver.ply": half}, parts=[Part("liver", [v + 0.5 for v in LOW], [v + 0.5 for v in HIGH],
                                                                          VOLUME, 12)])


def inputs():
    for prefix, groups in (("DICOM", (written_otherwise, pixels, without_names, frames, copies)), ("picture", (pictures,)), ("NIfTI", (nifti_files,)),
                           ("NRRD", (nrrd_files,)), ("", (surfaces,))):
        for group in groups:
            for one in group():
                one.name = "%s further: %s" % (prefix, one.name) if prefix else one.name.replace(" ", " further: ", 1)
                yield one
