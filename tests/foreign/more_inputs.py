# SPDX-License-Identifier: Apache-2.0
"""More inputs of each kind, as further programs and devices write them."""

import base64
import bz2
import gzip
import struct
import zlib

import dicom_bytes as d
import dicom_inputs
from case_seeds import png
from dicom_bytes import COLUMNS, ROWS, Encoding, file_of, slice_elements, stored
from dicom_inputs import enhanced, folder, good, measured, series
from expected import Input, Part, Series
from label_inputs import ORGANS, ORIGIN, SIZE, STEP, labels, nifti, nrrd, parts, samples
from mesh_inputs import (CORNERS, HIGH, LOW, QUADS, STRIP, TRIANGLES, VOLUME, box, box_glb, ply, stl_binary, stl_text)


def everywhere(**changed):
    return folder(lambda k: file_of(slice_elements(k, **changed)))


def dicom_elements():
    explicit = Encoding()
    inner = {0x00080100: ("SH", "A1"), 0x00080104: ("LO", "a code")}
    yield Input("open sequences in one another", folder(lambda k: file_of(slice_elements(
        k, _00081140=explicit.open_sequence(0x00081140, "SQ", [
            {0x0040a170: explicit.open_sequence(0x0040a170, "SQ", [inner, inner])}])))), [series()])
    unknown = explicit.head(0x00091001, "UN", 0xffffffff) + Encoding(False).item(inner) + struct.pack(
        "<HHI", 0xfffe, 0xe0dd, 0)
    yield Input("a private sequence of unknown type", folder(lambda k: file_of(slice_elements(
        k, _00090010=("LO", "MAKER"), _00091001=unknown))), [series()])
    odd = explicit.head(0x00080070, "LO", 5) + b"MAKER"
    yield Input("a text of odd length", folder(lambda k: file_of(slice_elements(k, _00080070=odd))), [series()])
    lengths = {"_%04x0000" % group: ("UL", struct.pack("<I", 99)) for group in (0x8, 0x10, 0x20, 0x28, 0x7fe0)}
    yield Input("lengths of groups, and wrong ones", everywhere(**lengths), [series()])
    for kind in ("OB", "UN"):
        yield Input("16-bit pixels as %s" % kind, folder(lambda k, kind=kind: file_of(slice_elements(
            k, _7fe00010=(kind, dicom_inputs.words(stored(k)))))), [series()])
    small = {"_00280100": ("US", 8), "_00280101": ("US", 8), "_00280102": ("US", 7)}

    def of_byte(x, y, z):
        return (stored(z)[y * COLUMNS + x] & 255) - 1024
    for kind in ("OB", "OW"):
        yield Input("8 bits as %s" % kind, folder(lambda k, kind=kind: file_of(slice_elements(
            k, _7fe00010=(kind, bytes(v & 255 for v in stored(k))), **small))), [series(of_byte)])
    yield Input("numbers without digits on one side", everywhere(
        _00280030=("DS", ".75\\.5"), _00281053=("DS", "+1."), _00281052=("DS", "-1024.E0 ")), [series()])
    yield Input("a number with a part behind the point where whole ones stand",
                folder(lambda k: file_of(slice_elements(k, _00200013=("IS", "%d.0" % (k + 1))))), [series()])
    yield Input("two windows", everywhere(_00281050=("DS", "40\\-600"), _00281051=("DS", "400\\1500"),
                                          _00281055=("LO", "SOFT\\LUNG")), [series(window=(40, 400))])
    yield Input("a window with a comma is none", everywhere(_00281050=("DS", "40,5")), [series(window=(465.5, 2757))],
                remarks=["window of its images cannot be used"])
    yield Input("a window of no width", everywhere(_00281051=("DS", "0")), [series(window=(465.5, 2757))],
                remarks=["window of its images cannot be used"])
    yield Input("another character set", everywhere(_00080005=("CS", "\\ISO 2022 IR 87"),
                                                    _0008103e=("LO", b"\x1b$B7A\x1b(B")), [series()])


def dicom_files():
    tiff = b"II*\0\x08\0\0\0" + bytes(120)
    yield Input("a preamble that is a head of TIFF", {name: tiff + data[128:] for name, data in good().items()},
                [series()])
    for name, syntax in (("a blank", d.EXPLICIT + " "), ("two zeros", d.EXPLICIT + "\0\0\0")):
        yield Input("transfer syntax with %s behind" % name, folder(lambda k, s=syntax: file_of(
            slice_elements(k), s, encoding=Encoding())), [series()])
    files = good()
    for name in files:
        files[name] = files[name].replace(b"UL\4\0", b"UL\4\0", 1)
        at = files[name].index(b"UL\4\0") + 4
        files[name] = files[name][:at] + struct.pack("<I", 12345) + files[name][at + 4:]
    yield Input("a wrong length of its head", files, [series()])
    yield Input("names without endings, in other scripts", {"\u533b\u5b66/\u00dcbersicht %d" % k: file_of(slice_elements(k))
                                                         for k in range(4)}, [series()])
    yield Input("endings in capitals", folder(lambda k: file_of(slice_elements(k)), name="IM%d.DCM"), [series()])
    yield Input("ten thousand bytes of private elements", folder(lambda k: file_of(slice_elements(
        k, _00290010=("LO", "SIEMENS CSA HEADER"), _00291010=("OB", b"SV10\4\3\2\1" + bytes(10000))))), [series()])
    yield Input("an icon before the pixels", folder(lambda k: file_of(slice_elements(k, _00880200=("SQ", [{
        0x00280010: ("US", 4), 0x00280011: ("US", 4), 0x00280100: ("US", 8), 0x00280101: ("US", 8),
        0x00280102: ("US", 7), 0x7fe00010: ("OW", bytes(16))}])))), [series()])

    def with_table(k):
        packed = d.rle(stored(k))
        whole = d.fragments([packed])
        empty = struct.pack("<HHI", 0xfffe, 0xe000, 0)
        return whole.replace(empty, struct.pack("<HHII", 0xfffe, 0xe000, 4, 0), 1)
    yield Input("RLE with a table of offsets", folder(lambda k: file_of(slice_elements(
        k, _7fe00010=with_table(k)), d.RLE)), [series()])


def dicom_places():
    yield Input("from the head to the feet", folder(lambda k: file_of(slice_elements(
        k, _00200013=("IS", str(9 - k))))), [series()])
    turned = ((0, 0.5, 0), (0, 0, -0.75), (-2, 0, 0))
    yield Input("a sagittal series", folder(lambda k: file_of(slice_elements(
        k, _00200037=("DS", "0\\1\\0\\0\\0\\-1"), _00200032=("DS", "%d\\-20\\50" % (-10 + 2 * k))))),
        [Series((COLUMNS, ROWS, 4), lambda x, y, z: measured(x, y, 3 - z), (-4, -20, 50), turned)])
    yield Input("a distance below 0 that is said and not there", everywhere(_00180088=("DS", "-2"), _00180050=("DS", "5")),
                [series()])
    yield Input("other copies of all", good() | folder(lambda k: file_of(slice_elements(k, _00080018=("UI", "1.9.%d" % k))),
                                                       name="copy%d.dcm"), [series()])
    half = folder(lambda k: file_of(slice_elements(k, _00200032=("DS", "-10\\-20\\%g" % (5 + 0.5 * k)))), 9)
    yield Input("slices of half a millimetre", half, [series(count=9, steps=((0.5, 0, 0), (0, 0.75, 0), (0, 0, 0.5)))])


def dicom_frames():
    explicit = Encoding()

    def place(k):
        return {0x00209113: ("SQ", [{0x00200032: ("DS", "-10\\-20\\%d" % (5 + 2 * (3 - k)))}])}
    yield Input("enhanced, from the other end", {"all.dcm": file_of(enhanced(4, each=place))},
                [series(lambda x, y, z: measured(x, y, 3 - z))])
    phases = []
    for p in (0, 1):
        for k in range(4):
            phases.append({0x00209113: ("SQ", [{0x00200032: ("DS", "-10\\-20\\%d" % (5 + 2 * k))}]),
                           0x00209111: ("SQ", [{0x00209128: ("UL", struct.pack("<I", p + 1))}])})
    pixels = [v + 50 * p for p in (0, 1) for k in range(4) for v in stored(k)]
    yield Input("enhanced, two phases", {"all.dcm": file_of(enhanced(
        8, _52009230=("SQ", phases), _7fe00010=("OW", pixels)))},
        [series(), series(lambda x, y, z: measured(x, y, z) + 50)])
    elements = enhanced(4)
    for tag in (0x52009229, 0x52009230):
        elements[tag] = explicit.open_sequence(tag, "SQ", elements[tag][1])
    yield Input("enhanced, with open sequences", {"all.dcm": file_of(elements)}, [series()])
    window = {0x00289132: ("SQ", [{0x00281050: ("DS", "300"), 0x00281051: ("DS", "700")}])}
    yield Input("enhanced, its window in a sequence", {"all.dcm": file_of(enhanced(
        4, window, _00281050=None, _00281051=None))}, [series(window=(300, 700))])
    several = {"a%d.dcm" % n: file_of(enhanced(2, each=lambda k, n=n: {0x00209113: ("SQ", [
        {0x00200032: ("DS", "-10\\-20\\%d" % (5 + 2 * (2 * n + k)))}])}, _00080018=("UI", "1.7.%d" % n),
        _7fe00010=("OW", stored(2 * n) + stored(2 * n + 1)))) for n in (0, 1)}
    yield Input("enhanced, a series in two files", several, [series()])


def nifti_files():
    plain = nifti()

    def with_bytes(*changes, data=plain):
        out = bytearray(data)
        for at, form, *values in changes:
            struct.pack_into("<" + form, out, at, *values)
        return bytes(out)
    named = gzip.compress(plain)
    named = named[:3] + b"\x08" + named[4:10] + b"organ.nii\0" + named[10:]
    yield Input("packed with its name", {"o.nii.gz": named}, parts=parts())
    yield Input("samples that begin later", {"o.nii": with_bytes((108, "f", 368.0))[:352] + bytes(16) + plain[352:]},
                parts=parts())
    yield Input("a place of samples that is 0", {"o.nii": with_bytes((108, "f", 0.0))}, parts=parts())
    yield Input("forms of other codes", {"o.nii": with_bytes((254, "h", 4))}, parts=parts())
    yield Input("texts and an intent", {"o.nii": with_bytes((68, "h", 1002), (148, "20s", b"organs of a person"),
                                                            (328, "16s", b"labels"))}, parts=parts())
    # A quarter turn about the patient's long axis: RAS (x, y) is (-j, i) steps from the origin.
    quarter = with_bytes((256, "6f", 0.0, 0.0, 0.70710678, -ORIGIN[0], -ORIGIN[1], ORIGIN[2]),
                         data=nifti(sform=False, qform=True))
    yield Input("a quarter turn in its qform", {"o.nii": quarter}, parts=[placed_part(n, lambda i, j, k: (12 + 2 * j, -30 - 1.5 * i, 40 + 3 * k)) for n in (1, 2)])
    left = with_bytes((76, "f", -1.0), (256, "6f", 0.0, 0.0, 0.0, -ORIGIN[0], -ORIGIN[1], ORIGIN[2]),
                      data=nifti(sform=False, qform=True))
    yield Input("a left-handed qform", {"o.nii": left}, parts=[placed_part(n, lambda i, j, k: (12 - 1.5 * i, -30 - 2 * j, 40 - 3 * k)) for n in (1, 2)])
    yield Input("pixels of three bytes", {"o.nii": with_bytes((70, "hh", 128, 24)) + plain[352:] * 2},
                refused="samples")
    flat = with_bytes((40, "4h", 2, SIZE[0], SIZE[1], 1))
    yield Input("two dimensions without a label", {"o.nii": flat}, refused="marks nothing: there are no labels but 0")
    comment = struct.pack("<ii", 32, 6) + b"made by a program".ljust(24, b"\0")
    yield Input("a comment in its extension", {"o.nii": nifti(extension=comment)}, parts=parts())
    yield Input("two extensions", {"o.nii": nifti(extension=comment * 2)}, parts=parts())
    for name, data in (("one part", bz2.compress(plain)), ("two parts", bz2.compress(plain[:999]) + bz2.compress(plain[999:]))):
        yield Input("packed with bzip2, " + name, {"o.nii.bz2": data}, parts=parts())
        yield Input("packed with bzip2 under another name, " + name, {"o.nii.gz": data}, parts=parts())
    yield Input("packed with bzip2 and cut off", {"o.nii.bz2": bz2.compress(plain)[:-30]}, refused="cut off")
    yield Input("an image packed with bzip2", {"o.nii.bz2": bz2.compress(nifti(list(range(3840)), "int16")), "liver.stl": stl_binary()},
                parts=[box("liver")])
    yield Input("a float map of two labels", {"o.nii.gz": gzip.compress(nifti([float(v) for v in labels()], "float"))},
                parts=parts())
    head, samples = plain[:108] + struct.pack("<f", 0) + plain[112:344] + b"ni1\0" + bytes(4), plain[352:]
    yield Input("a head and samples apart", {"o.hdr": head, "o.img": samples}, parts=parts())
    yield Input("a head and packed samples apart", {"o.hdr": head, "o.img.gz": gzip.compress(samples)}, parts=parts())
    yield Input("a packed head and packed samples apart", {"o.hdr.gz": gzip.compress(head), "o.img.gz": gzip.compress(samples)},
                parts=parts())
    yield Input("a head and samples apart in capitals", {"O.HDR": head, "O.IMG": samples}, parts=parts())
    later = plain[:108] + struct.pack("<f", 16) + plain[112:344] + b"ni1\0" + bytes(4)
    yield Input("samples apart that begin later", {"o.hdr": later, "o.img": bytes(16) + samples}, parts=parts())
    yield Input("a head without its samples", {"o.hdr": head}, refused="which is not beside it")
    yield Input("samples apart that are cut off", {"o.hdr": head, "o.img": samples[:-9]}, refused="cut off")
    yield Input("a head of Analyze 7.5", {"liver.stl": stl_binary(), "o.hdr": plain[:344] + bytes(4), "o.img": samples},
                parts=[box("liver")], remarks=["o.hdr", "o.img"])


def placed_part(number, place):
    """`place`: of a sample's numbers, in the patient."""
    ends = [place(*(span[end] - 0.5 for span in ORGANS[number])) for end in (0, 1)]
    volume = 1
    for (a, b), step in zip(ORGANS[number], STEP):
        volume *= (b - a) * step
    return Part("label %d" % number, [min(e) for e in zip(*ends)], [max(e) for e in zip(*ends)], volume, tolerance=2.0)


def nrrd_files():
    for version in (1, 2, 3, 4, 6):
        yield Input("version %d" % version, {"o.nrrd": nrrd().replace(b"NRRD0005", b"NRRD000%d" % version, 1)}, parts=parts())
    yield Input("comments between its lines", {"o.nrrd": nrrd().replace(b"\ndimension", b"\n# more\n#\ndimension", 1)},
                parts=parts())
    yield Input("more fields", {"o.nrrd": nrrd(fields={
        "content": "labels: of organs", "centerings": "cell cell cell", "thicknesses": "nan nan 3", "old min": "0",
        "measurement frame": "(1,0,0) (0,1,0) (0,0,1)", "kinds": "space space space"})}, parts=parts())
    yield Input("blanks in vectors", {"o.nrrd": nrrd(fields={
        "space directions": "( %g , 0, 0 )  (0, %g ,0) (0,0,%g)" % STEP, "space origin": "( %g, %g, %g )" % ORIGIN})},
        parts=parts())
    yield Input("exponents", {"o.nrrd": nrrd(fields={"space directions": "(1.5e0,0.0e+00,0) (0,2E0,-0) (0,0,3.000000000)"})},
                parts=parts())
    yield Input("8 bits without an order of bytes", {"o.nrrd": nrrd(kind="uchar", code="uint8", fields={"endian": None})},
                parts=parts())
    yield Input("16 bits without an order of bytes", {"o.nrrd": nrrd(fields={"endian": None})}, parts=parts())
    packed = nrrd([], encoding="gzip")
    packed = packed[:packed.index(b"\n\n") + 2]
    data = samples(labels(), "int16", "<")
    yield Input("several packed members", {"o.nrrd": packed + gzip.compress(data[:999]) + gzip.compress(data[999:])},
                parts=parts())
    yield Input("a zlib stream that is called gzip", {"o.nrrd": packed + zlib.compress(data)}, refused="damaged")
    yield Input("samples in numbered files", {"o.nhdr": nrrd([], fields={"data file": "s%02d.raw 0 11 1 2"})} | {
        "s%02d.raw" % z: data[640 * z:640 * z + 640] for z in range(12)}, refused="which is not beside it")
    yield Input("samples in listed files", {"o.nhdr": nrrd([], fields={"data file": None}).rstrip(b"\n")
                                            + b"\ndata file: LIST\na.raw\nb.raw\n", "a.raw": data[:3840],
                                            "b.raw": data[3840:]}, refused="another file")
    yield Input("a space by its dimension alone", {"o.nrrd": nrrd(fields={"space": None, "space dimension": "3"})},
                refused="where in the patient it lies")
    yield Input("a detached packed file", {"o.nhdr": nrrd([], fields={"encoding": "gzip", "data file": "./o.raw.gz"})
                                           .replace(gzip.compress(b""), b""), "o.raw.gz": gzip.compress(data)}, parts=parts())


def stl_files():
    colored = bytearray(stl_binary())
    for i in range(12):
        struct.pack_into("<H", colored, 84 + 50 * i + 48, 0x8000 | 1234)
    yield Input("colours of facets", {"liver.stl": bytes(colored)}, parts=[box("liver")])
    yield Input("its ending in capitals", {"liver.STL": stl_binary()}, parts=[box("liver")])
    flat = TRIANGLES + [(0, 0, 1)]
    yield Input("a facet without area", {"liver.stl": stl_binary(triangles=flat)}, parts=[box("liver", None)])
    yield Input("tabs", {"liver.stl": stl_text().replace(b" ", b"\t")}, parts=[box("liver")])
    yield Input("a blank in its last word", {"liver.stl": stl_text().replace(b"endsolid organ", b"end solid organ")},
                parts=[box("liver")])
    yield Input("numbers with signs", {"liver.stl": stl_text(number="%+.7E")}, parts=[box("liver")])
    yield Input("text without a name", {"liver.stl": stl_text(name="")}, parts=[box("liver")])
    yield Input("text with indents", {"liver.stl": stl_text().replace(b"\n", b"\n      ")}, parts=[box("liver")])


def ply_files():
    plain = ply().decode()
    yield Input("lines that other programs add", {"liver.ply": plain.replace(
        "comment made for a test", "obj_info num_cols 512\ncomment\nobj_info a b").encode()}, parts=[box("liver")])
    yield Input("ends of lines as CR", {"liver.ply": ply(end="\r")}, parts=[box("liver")])
    yield Input("blanks around its words", {"liver.ply": plain.replace("format ascii 1.0", "format  ascii  1.0 ").encode()},
                parts=[box("liver")])
    yield Input("empty lines between its elements", {"liver.ply": plain.replace("end_header\n", "end_header\n\n").encode()},
                parts=[box("liver")])
    for form in ("ascii", "binary_little_endian"):
        triangles = [t for t in TRIANGLES]
        yield Input("triangles in " + form, {"liver.ply": ply(form, polygons=triangles)}, parts=[box("liver")])
        yield Input("edges and faces in " + form, {"liver.ply": ply(form, order=("edge", "vertex", "face"))},
                    parts=[box("liver")])
        yield Input("strips and faces in " + form, {"liver.ply": ply(
            form, order=("vertex", "tristrips", "face"), polygons=QUADS[:1], strips=STRIP[5:])}, parts=[box("liver")])


def glb_files():
    def instances(root):
        root["nodes"].append({"name": "copy", "mesh": 0, "translation": [0.2, 0, 0]})
        root["scenes"][0]["nodes"] = [0, 1]
    yield Input("one mesh at two places", {"o.glb": box_glb(change=instances)}, parts=[
        Part(None, LOW, HIGH, VOLUME, 12, 0.01), Part(None, (210, 20, 30), (250, 45, 60), VOLUME, 12, 0.01)])

    def scenes(root):
        root["nodes"].append({"name": "spare", "mesh": 0})
        root["scenes"].append({"nodes": [1]})
    yield Input("two scenes", {"o.glb": box_glb(change=scenes)}, parts=[box(None, tolerance=0.01)])
    half = 0.5 ** 0.5
    # A quarter turn about y (up): x becomes -z, which is y of the patient.
    turned = box_glb(node={"rotation": [0, half, 0, half]})
    yield Input("a turned node", {"o.glb": turned}, parts=[Part(None, (-45, 10, 30), (-20, 50, 60), VOLUME, 12, 0.01)])

    def parents(root):
        root["nodes"] = [{"name": "top", "scale": [2, 2, 2], "children": [1]}, {"name": "liver", "mesh": 0,
                                                                              "translation": [0.1, 0, 0]}]
    yield Input("a node in another", {"o.glb": box_glb(change=parents)},
                parts=[Part(None, (220, 40, 60), (300, 90, 120), 8 * VOLUME, 12, 0.01)])

    def embedded(root):
        root["buffers"][0]["uri"] = "data:application/octet-stream;base64," + base64.b64encode(b"x").decode()
    yield Input("a buffer within its text", {"o.glb": box_glb(change=embedded)}, refused="fewer triangles")
    plain = box_glb()
    extra = struct.pack("<I", 8) + b"XTRA" + bytes(8)
    data = plain[:8] + struct.pack("<I", len(plain) + 16) + plain[12:] + extra
    yield Input("a chunk of another kind", {"o.glb": data}, parts=[box(tolerance=0.01)])
    yield Input("bytes behind", {"o.glb": plain + bytes(5)}, parts=[box(tolerance=0.01)])

    def skinned(root):
        root["skins"] = [{"joints": [0]}]
        root["animations"], root["cameras"] = [{"channels": [], "samplers": []}], [{"type": "perspective"}]
        root["nodes"][0]["extras"] = {"id": 7}
    yield Input("cameras, movements and extras", {"o.glb": box_glb(change=skinned)}, parts=[box(tolerance=0.01)])

    def optional(root):
        root["extensionsUsed"] = ["KHR_draco_mesh_compression", "VENDOR_shape"]
    yield Input("extensions that it does not need", {"o.glb": box_glb(change=optional)}, parts=[box(tolerance=0.01)])
    yield Input("version 1", {"o.glb": plain[:4] + struct.pack("<I", 1) + plain[8:]}, refused="is of version '1' of glTF")


def obj_files():
    corners = ["v %g %g %g" % p for p in CORNERS]
    faces = ["f " + " ".join("%d" % (i + 1) for i in q) for q in QUADS]
    ways = {"colours of corners": [c + " 0.5 0.25 1" for c in corners] + faces,
            "a fourth number": [c + " 1.0" for c in corners] + faces,
            "tabs and comments": ["# made\t"] + [c.replace(" ", "\t") for c in corners] + ["# sides"] + faces,
            "normals and textures": corners + ["vn 0 0 1", "vt 0 0"] + [
                "f " + " ".join("%d/1/1" % (i + 1) for i in q) for q in QUADS],
            "normals alone": corners + ["vn 0 0 1"] + ["f " + " ".join("%d//1" % (i + 1) for i in q) for q in QUADS],
            "smoothing, lines and points": corners + ["s 1"] + faces + ["l 1 2", "p 1"],
            "exponents": ["v " + " ".join("%.6e" % v for v in p) for p in CORNERS] + faces,
            "corners between faces": corners[:4] + faces[:1] + corners[4:] + faces[1:]}
    for name, lines in ways.items():
        yield Input(name, {"liver.obj": "\n".join(lines).encode() + b"\n"}, parts=[box("liver")])
    yield Input("no end of its last line", {"liver.obj": "\n".join(corners + faces).encode()}, parts=[box("liver")])
    groups = corners + ["o one"] + faces + ["v %g %g %g" % (p[0] + 100, p[1], p[2]) for p in CORNERS] + ["o two"] + [
        "f " + " ".join("%d" % (i + 9) for i in q) for q in QUADS]
    yield Input("two objects", {"both.obj": "\n".join(groups).encode() + b"\n"}, parts=[
        Part("one", LOW, HIGH, VOLUME, 12), Part("two", (110, 20, 30), (150, 45, 60), VOLUME, 12)])


def pictures():
    for name, data in (("grey", png(0, 8, 1)), ("with a part that is clear", png(6, 8, 4)), ("16 bits", png(2, 16, 3)),
                       ("a text and a time", png(chunks=[(b"tEXt", b"Comment\0made"), (b"tIME", b"\7\xe8\1\1\0\0\0")])),
                       ("bytes behind", png() + b"\0" * 7)):
        yield Input("PNG, " + name, {"page.png": data}, pictures=1)
    damaged = png()
    yield Input("PNG cut off", {"page.png": damaged[:-25]}, refused="page.png'")


def inputs():
    for prefix, group in (("DICOM", dicom_elements), ("DICOM file", dicom_files), ("DICOM place", dicom_places),
                          ("DICOM frames", dicom_frames), ("NIfTI", nifti_files), ("NRRD", nrrd_files), ("STL", stl_files),
                          ("PLY", ply_files), ("GLB", glb_files), ("OBJ", obj_files), ("picture", pictures)):
        for one in group():
            one.name = "%s: %s" % (prefix, one.name)
            yield one
