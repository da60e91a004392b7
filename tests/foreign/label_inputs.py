# SPDX-License-Identifier: Apache-2.0
"""Label maps (NIfTI, NRRD) with what an import must make of them."""

import bz2
import gzip
import random
import struct

from expected import Input, Part

SIZE = (20, 16, 12)
STEP = (1.5, 2.0, 3.0)  # millimetres
ORIGIN = (12.0, -30.0, 40.0)  # LPS, of the first sample
# Boxes of samples, ends excluded.
ORGANS = {1: ((3, 10), (2, 12), (2, 9)), 2: ((12, 18), (3, 8), (3, 10))}


def labels(values=(0, 1, 2)):
    out = []
    for z in range(SIZE[2]):
        for y in range(SIZE[1]):
            for x in range(SIZE[0]):
                label = 0
                for number, box in ORGANS.items():
                    if all(a <= v < b for v, (a, b) in zip((x, y, z), box)):
                        label = number
                out.append(values[label])
    return out


def part(number, name):
    """The surface bulges out of the box of samples by less than a sample and is smoothed."""
    box = ORGANS[number]
    low, high, volume = [], [], 1
    for axis in range(3):
        low.append(ORIGIN[axis] + STEP[axis] * (box[axis][0] - 0.5))
        high.append(ORIGIN[axis] + STEP[axis] * (box[axis][1] - 0.5))
        volume *= (box[axis][1] - box[axis][0]) * STEP[axis]
    return Part(name, low, high, volume=volume, tolerance=2.0)


def parts(names=("label 1", "label 2")):
    return [part(1, names[0]), part(2, names[1])]


TYPES = {"int8": "b", "uint8": "B", "int16": "h", "uint16": "H", "int32": "i", "uint32": "I",
         "int64": "q", "uint64": "Q", "float": "f", "double": "d"}
NIFTI_TYPES = {"uint8": 2, "int16": 4, "int32": 8, "float": 16, "double": 64, "int8": 256,
               "uint16": 512, "uint32": 768, "int64": 1024, "uint64": 1280}


def samples(values, kind, order):
    return struct.pack(order + "%d%s" % (len(values), TYPES[kind]), *values)


def nifti(values=None, kind="uint8", order="<", version=1, extension=b"", sform=True, qform=False,
          slope=1.0, intercept=0.0, unit=2, matrix=None, dim=None):
    """RAS, so the axes to the left and back turn. `dim`: more sizes behind the three."""
    values = labels() if values is None else values
    sizes = list(SIZE) + list(dim or [])
    dims = [len(sizes)] + sizes + [1] * (7 - len(sizes))
    scale = {0: 1, 1: 0.001, 2: 1, 3: 1000}[unit]
    steps = [s * scale for s in STEP]
    origin = [-ORIGIN[0] * scale, -ORIGIN[1] * scale, ORIGIN[2] * scale]
    rows = matrix or [(-steps[0], 0, 0, origin[0]), (0, -steps[1], 0, origin[1]), (0, 0, steps[2], origin[2])]
    begin = (352 if version == 1 else 544) + len(extension)
    head = bytearray(348 if version == 1 else 540)

    def put(at, form, *numbers):
        struct.pack_into(order + form, head, at, *numbers)
    # A half turn about z: (0, 0, 1).
    if version == 1:
        put(0, "i", 348)
        put(40, "8h", *dims)
        put(70, "hh", NIFTI_TYPES[kind], 8 * struct.calcsize(TYPES[kind]))
        put(76, "8f", 1, *steps, 0, 0, 0, 0)
        put(108, "3f", begin, slope, intercept)
        head[123] = unit
        put(252, "hh", int(qform), int(sform))
        put(256, "6f", 0, 0, 1, *origin)
        put(280, "12f", *[n for row in rows for n in row])
        head[344:348] = b"n+1\0"
    else:
        put(0, "i", 540)
        head[4:12] = b"n+2\0\r\n\x1a\n"
        put(12, "hh", NIFTI_TYPES[kind], 8 * struct.calcsize(TYPES[kind]))
        put(16, "8q", *dims)
        put(104, "8d", 1, *steps, 0, 0, 0, 0)
        put(168, "q", begin)
        put(176, "2d", slope, intercept)
        put(344, "ii", int(qform), int(sform))
        put(352, "6d", 0, 0, 1, *origin)
        put(400, "12d", *[n for row in rows for n in row])
        put(500, "i", unit)
    mark = bytes([1 if extension else 0, 0, 0, 0])
    return bytes(head) + mark + extension + samples(values, kind, order)


def extension_of(xml, order="<"):
    data = xml.encode() + b"\0" * (-(len(xml) + 8) % 16)
    return struct.pack(order + "ii", len(data) + 8, 0) + data


def nifti_inputs():
    for kind in NIFTI_TYPES:
        for order, ends in (("<", "little"), (">", "big")):
            for version in (1, 2):
                yield Input("NIfTI-%d %s %s" % (version, kind, ends),
                            {"o.nii": nifti(kind=kind, order=order, version=version)}, parts=parts())
    plain = nifti()
    yield Input("gzip", {"o.nii.gz": gzip.compress(plain)}, parts=parts())
    members = b"".join(gzip.compress(plain[at:at + 999]) for at in range(0, len(plain), 999))
    yield Input("gzip members", {"o.nii.gz": members}, parts=parts())
    yield Input("gzip members, an empty one last", {"o.nii.gz": members + gzip.compress(b"")}, parts=parts())
    yield Input("gzip, zeros behind", {"o.nii.gz": gzip.compress(plain) + b"\0" * 512}, parts=parts())
    yield Input("not packed under .gz", {"o.nii.gz": plain}, parts=parts())
    yield Input("packed under .nii", {"o.nii": gzip.compress(plain)}, parts=parts())
    yield Input("bytes behind", {"o.nii": plain + b"\0" * 77}, parts=parts())
    yield Input("cut off", {"o.nii": plain[:-9]}, refused="less than its header announces")
    yield Input("gzip cut off", {"o.nii.gz": gzip.compress(plain)[:-20]}, refused="cut off")
    nan = float("nan")
    for name, slope, intercept in (("NaN", nan, nan), ("slope NaN", nan, 0.0), ("intercept NaN", 1.0, nan),
                                   ("0", 0.0, 0.0), ("1", 1.0, 0.0), ("0 and 5", 0.0, 5.0)):
        yield Input("scale " + name, {"o.nii": nifti(slope=slope, intercept=intercept)}, parts=parts())
    third = nifti(labels((0, 255, 510)), "int16", slope=1 / 255)
    yield Input("scale 1/255", {"o.nii": third}, parts=parts())
    shifted = nifti(labels((-5, -4, -3)), "int16", slope=1.0, intercept=5.0)
    yield Input("intercept 5", {"o.nii": shifted}, parts=parts())
    for name, values in (("0.9999999", (0.0, 0.9999999, 2.0000002)), ("1.0004", (0.0003, 1.0004, 1.9996)),
                         ("NaN outside", (nan, 1.0, 2.0)), ("-0", (-0.0, 1.0, 2.0))):
        for kind in ("float", "double"):
            yield Input("labels %s %s" % (name, kind), {"o.nii": nifti(labels(values), kind)}, parts=parts())
    yield Input("qform alone", {"o.nii": nifti(sform=False, qform=True)}, parts=parts())
    yield Input("both forms", {"o.nii": nifti(qform=True)}, parts=parts())
    yield Input("an empty sform", {"o.nii": nifti(qform=True, matrix=[(0, 0, 0, 0)] * 3)}, parts=parts())
    yield Input("no form", {"o.nii": nifti(sform=False)}, refused="where in the patient it lies")
    for unit, name in ((0, "none"), (1, "m"), (3, "um")):
        yield Input("unit " + name, {"o.nii": nifti(unit=unit)}, parts=parts())
    yield Input("four dimensions of which one is 1", {"o.nii": nifti(dim=[1])}, parts=parts())
    yield Input("five dimensions", {"o.nii": nifti(dim=[1, 1])}, parts=parts())
    xml = ('<?xml version="1.0"?><CaretExtension><VolumeInformation Index="0"><LabelTable>'
           '<Label Key="1" Red="1">%s</Label><Label Key="2" Red="0">%s</Label></LabelTable>'
           '</VolumeInformation></CaretExtension>')
    for version in (1, 2):
        for quoted in (False, True):
            names = ["<![CDATA[%s]]>" % n if quoted else n for n in ("liver", "portal_vein")]
            data = nifti(version=version, extension=extension_of(xml % tuple(names)))
            yield Input("names in the extension %d %s" % (version, quoted), {"o.nii.gz": gzip.compress(data)},
                        parts=parts(("liver", "portal vein")))
    rng = random.Random(7)
    noise = [rng.randrange(1, 200) for _ in range(SIZE[0] * SIZE[1] * SIZE[2])]
    yield Input("an image", {"t1.nii": nifti(noise)}, refused="is an image and no label map")
    ramp = [int(x * 9 + y * 3 + z) for z in range(SIZE[2]) for y in range(SIZE[1]) for x in range(SIZE[0])]
    yield Input("a smooth image", {"t1.nii": nifti(ramp)}, refused="is an image and no label map")
    yield Input("an image beside", {"o.nii": plain, "t1.nii": nifti(noise)}, parts=parts(),
                remarks=["t1.nii' is left out"])
    yield Input("an image of 16 bits beside", {"o.nii": plain, "ct.nii": nifti(labels((-1000, 40, 60)), "int16")},
                parts=parts(), remarks=["ct.nii' is left out", "no labels"])
    many = [x // 2 + 10 * (y // 2) + 80 * (z // 4) + 1 for z in range(SIZE[2]) for y in range(SIZE[1])
            for x in range(SIZE[0])]
    # An atlas of 240 parcels is a label map.
    yield Input("an atlas", {"atlas.nii": nifti(many)})
    yield Input("a mask of 255", {"liver.nii": nifti(labels((0, 255, 0)))}, parts=[part(1, "liver")])
    yield Input("no NIfTI", {"o.nii": plain, "x.nii": b"hello " * 100}, parts=parts(),
                remarks=["x.nii' is left out"])


def nrrd(values=None, kind="short", code="int16", order="<", encoding="raw", fields=None, keys="",
         before=None, end="\n", title=False):
    """`fields`: replaces lines of the header; None takes one out."""
    lines = {"type": kind, "dimension": "3", "space": "left-posterior-superior",
             "sizes": "%d %d %d" % SIZE,
             "space directions": "(%g,0,0) (0,%g,0) (0,0,%g)" % STEP,
             "kinds": "domain domain domain", "endian": "little" if order == "<" else "big",
             "encoding": encoding, "space origin": "(%g,%g,%g)" % ORIGIN}
    for name, value in (fields or {}).items():
        lines.pop(name, None)
        if value is not None:
            lines[name] = value
    text = "NRRD0005" + end + "# generated" + end
    for name, value in lines.items():
        text += "%s: %s%s" % (name.title() if title else name, value, end)
    text += keys + end
    values = labels() if values is None else values
    data = samples(values, code, order)
    if encoding.lower() in ("gzip", "gz"):
        data = gzip.compress(data)
    elif encoding.lower() in ("bzip2", "bz2"):
        data = bz2.compress(data)
    elif encoding.lower() in ("txt", "text", "ascii"):
        data = " ".join(str(v) for v in values).encode()
    return text.encode() + (before or b"") + data


NRRD_TYPES = {"int8": ["signed char", "int8", "int8_t", "char"],
              "uint8": ["uchar", "unsigned char", "uint8", "uint8_t"],
              "int16": ["short", "short int", "signed short", "signed short int", "int16", "int16_t"],
              "uint16": ["ushort", "unsigned short", "unsigned short int", "uint16", "uint16_t"],
              "int32": ["int", "signed int", "int32", "int32_t"],
              "uint32": ["uint", "unsigned int", "uint32", "uint32_t"],
              "int64": ["longlong", "long long", "long long int", "signed long long",
                        "signed long long int", "int64", "int64_t"],
              "uint64": ["ulonglong", "unsigned long long", "unsigned long long int", "uint64", "uint64_t"],
              "float": ["float"], "double": ["double"]}


def nrrd_inputs():
    for code, names in NRRD_TYPES.items():
        for name in names:
            yield Input("type " + name, {"o.nrrd": nrrd(kind=name, code=code)}, parts=parts())
        yield Input("type %s big" % names[0].upper(),
                    {"o.nrrd": nrrd(kind=names[0].upper(), code=code, order=">")}, parts=parts())
    for encoding in ("raw", "RAW", "gzip", "gz", "GZIP", "bzip2", "bz2", "txt", "text", "ascii"):
        yield Input("encoding " + encoding, {"o.nrrd": nrrd(encoding=encoding)}, parts=parts())
    yield Input("encoding hex", {"o.nrrd": nrrd(encoding="hex")}, refused="encoded as 'hex'")
    packed = nrrd(encoding="bzip2")
    yield Input("bzip2 cut off", {"o.nrrd": packed[:-60]}, refused="cut off")
    yield Input("capitals and CR LF", {"o.nrrd": nrrd(title=True, end="\r\n")}, parts=parts())
    for name in ("LPS", "Left-Posterior-Superior", "lps"):
        yield Input("space " + name, {"o.nrrd": nrrd(fields={"space": name})}, parts=parts())
    ras = {"space": "RAS", "space directions": "(%g,0,0) (0,%g,0) (0,0,%g)" % (-STEP[0], -STEP[1], STEP[2]),
           "space origin": "(%g,%g,%g)" % (-ORIGIN[0], -ORIGIN[1], ORIGIN[2])}
    yield Input("space RAS", {"o.nrrd": nrrd(fields=ras)}, parts=parts())
    for name in ("scanner-xyz", "3D-right-handed", None):
        yield Input("space %s" % name, {"o.nrrd": nrrd(fields={"space": name})},
                    refused="where in the patient it lies")
    for unit, scale in (("mm", 1), ("cm", 10), ("m", 1000), ("um", 0.001), ("inch", 25.4)):
        in_unit = {"space units": " ".join(['"%s"' % unit] * 3),
                   "space directions": "(%.9g,0,0) (0,%.9g,0) (0,0,%.9g)" % tuple(s / scale for s in STEP),
                   "space origin": "(%.9g,%.9g,%.9g)" % tuple(o / scale for o in ORIGIN)}
        yield Input("unit " + unit, {"o.nrrd": nrrd(fields=in_unit)}, parts=parts())
    yield Input("unit pixel", {"o.nrrd": nrrd(fields={"space units": '"pixel" "pixel" "pixel"'})},
                refused="has the unit")
    directions = "none (%g,0,0) (0,%g,0) (0,0,%g)" % STEP
    listed = {"dimension": "4", "sizes": "1 %d %d %d" % SIZE, "space directions": directions,
              "kinds": "list domain domain domain"}
    yield Input("a list of one", {"o.seg.nrrd": nrrd(fields=listed)}, parts=parts())
    last = {"dimension": "4", "sizes": "%d %d %d 1" % SIZE,
            "space directions": "(%g,0,0) (0,%g,0) (0,0,%g) none" % STEP, "kinds": "domain domain domain list"}
    yield Input("a list of one, last", {"o.seg.nrrd": nrrd(fields=last)}, parts=parts())
    keys = ("Segment0_Name:=liver\nSegment0_LabelValue:=1\nSegment0_Layer:=0\n"
            "Segment1_Name:=tumour\nSegment1_LabelValue:=1\nSegment1_Layer:=1\n")
    first, second = labels((0, 1, 0)), labels((0, 0, 1))
    for encoding in ("raw", "gzip"):
        yield Input("two layers, " + encoding, {"o.seg.nrrd": nrrd(
            [v for pair in zip(first, second) for v in pair], encoding=encoding, keys=keys,
            fields=dict(listed, sizes="2 %d %d %d" % SIZE))}, parts=parts(("liver", "tumour")))
    yield Input("two layers, last", {"o.seg.nrrd": nrrd(
        first + second, keys=keys, fields=dict(last, sizes="%d %d %d 2" % SIZE))},
        parts=parts(("liver", "tumour")))
    header = nrrd([], fields={"data file": "o.raw"})
    data = samples(labels(), "int16", "<")
    yield Input("detached", {"o.nhdr": header, "o.raw": data}, parts=parts(), silent=True)
    yield Input("detached without an empty line", {"o.nhdr": header.rstrip(b"\n") + b"\n", "o.raw": data},
                parts=parts())
    yield Input("detached, no end of the last line", {"o.nhdr": header.rstrip(b"\n"), "o.raw": data}, parts=parts())
    yield Input("detached, empty", {"o.nhdr": header, "o.raw": b""}, refused="less than its header announces")
    yield Input("detached, skipping", {"o.nhdr": nrrd([], fields={"datafile": "o.raw", "byte skip": "-1"}),
                                       "o.raw": b"head of another format" + data}, parts=parts())
    yield Input("detached, away", {"o.nhdr": header}, refused="which is not beside it")
    yield Input("detached in a folder above", {"o.nhdr": nrrd([], fields={"data file": "../../secret.raw"})},
                refused="which is not beside it")
    for fields, before in (({"byte skip": "10"}, b"0123456789"), ({"line skip": "2"}, b"one\ntwo\n"),
                           ({"byteskip": "-1"}, b"any")):
        yield Input("skips %s" % fields, {"o.nrrd": nrrd(fields=fields, before=before)}, parts=parts())
    yield Input("cut off", {"o.nrrd": nrrd()[:-9]}, refused="less than its header announces")
    yield Input("type block", {"o.nrrd": nrrd(fields={"type": "block"})}, refused="the type 'block'")


def inputs():
    for prefix, group in (("NIfTI", nifti_inputs), ("NRRD", nrrd_inputs)):
        for one in group():
            one.name = prefix + " " + one.name
            yield one
