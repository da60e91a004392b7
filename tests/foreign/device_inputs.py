# SPDX-License-Identifier: Apache-2.0
"""Habits of single devices and programs."""

import struct

import dicom_bytes as d
import dicom_inputs
from dicom_bytes import Encoding, file_of, slice_elements, stored
from dicom_inputs import enhanced, folder, good, measured, series
from expected import Input
from label_inputs import labels, nifti, extension_of, nrrd, part, parts
from mesh_inputs import box, stl_binary

STORAGE = "1.2.840.10008.5.1.4.1.1."
GE_PIXELS = "1.2.840.113619.5.2"


def every(**changed):
    return folder(lambda k: file_of(slice_elements(k, **changed)))


def elements():
    yield Input("pixels alone with their bytes swapped", folder(lambda k: file_of(
        slice_elements(k, _7fe00010=("OW", dicom_inputs.words(stored(k), ">"))), GE_PIXELS, encoding=Encoding(False))), [series()])
    for letters in (b"??", b"OX", b"  ", b"\0\0", b"--"):
        short = struct.pack("<HH", 9, 0x1010) + letters + b"\4\0abcd"
        yield Input("a representation %r" % letters, every(_00091010=short), [series()])
    yield Input("a new representation with a long length", every(
        _00091010=struct.pack("<HH", 9, 0x1010) + b"OX\0\0\4\0\0\0abcd"), [series()])
    two = b"".join(struct.pack("<HH", 9, tag) + b"??\4\0abcd" for tag in (0x1010, 0x1011))
    yield Input("two elements of unknown representation", every(_00091010=two), [series()])
    # Its length is two blanks, too.
    bare = struct.pack("<HHI", 9, 0x1010, 0x2020) + bytes(0x2020)
    yield Input("an element without a representation", every(_00091010=bare), [series()])


def maps():
    other = {"_0020000e": ("UI", "1.2.3.9"), "_00281052": None, "_00281053": None}
    dose = {"_00080016": ("UI", STORAGE + "481.2"), "_00080060": ("CS", "RTDOSE"), "_3004000e": ("DS", "0.0001"), **other}
    mask = {"_00080016": ("UI", STORAGE + "66.4"), "_00080060": ("CS", "SEG"), "_00280100": ("US", 8), "_00280101": ("US", 8),
            "_00280102": ("US", 7), "_7fe00010": ("OB", b"\1" * 768), **other}
    for name, words, file in (
            ("a dose of 16 bits", "holds a radiation dose", file_of(slice_elements(1, **dose))),
            ("a map of whole numbers", "holds computed values", file_of(slice_elements(1, _00080016=("UI", STORAGE + "30"), **other))),
            ("a mask of 8 bits", "holds a segmentation as DICOM", file_of(enhanced(4, **mask))),
            ("contours", "holds a segmentation as DICOM", file_of(slice_elements(1, _00080016=("UI", STORAGE + "481.3"), _00080060=(
                "CS", "RTSTRUCT"), _7fe00010=None, _00280010=None, _00280011=None, **other)))):
        yield Input(name + " beside", good() | {"other.dcm": file}, [series()], remarks=["other.dcm' is left out", words])
        yield Input(name + " alone", {"other.dcm": file}, refused=words)
    tiles = file_of(slice_elements(1, _00080008=("CS", "ORIGINAL\\PRIMARY\\M\\ND\\MOSAIC"), **other))
    yield Input("slices side by side in one picture", good() | {"mosaic.dcm": tiles}, [series()],
                remarks=["mosaic.dcm' is left out: it holds several images in one file"])


def groups():
    for name, tag, kind, value in (("time after an inversion", "_00180082", "DS", "%d00"), ("time of the content", "_00080033", "TM", "12000%d"),
                                   ("trigger", "_00181060", "DS", "%d00")):
        files = {"P%d-%d.dcm" % (p, k): file_of(slice_elements(k, _00080018=("UI", "1.7.%d.%d" % (p, k)), _7fe00010=(
            "OW", [v + 50 * p for v in stored(k)]), **{tag: (kind, value % (p + 1))})) for p in (0, 1) for k in range(4)}
        yield Input("phases by " + name, files, [series(), series(lambda x, y, z: measured(x, y, z) + 50)],
                    remarks=["2 images at each place"])
    scout = file_of(slice_elements(9, _00080008=("CS", "ORIGINAL\\PRIMARY\\LOCALIZER"), _00200032=("DS", "-10\\-20\\61")))
    yield Input("a scout in the plane of its series", good() | {"scout.dcm": scout}, [series()], remarks=["a scout?"])
    scouts = every(_00080008=("CS", "ORIGINAL\\PRIMARY\\LOCALIZER"))
    yield Input("scouts alone", scouts, [series()], silent=True)
    for said in (3, 5):
        yield Input("%d frames are said, 4 described" % said, {"a.dcm": file_of(enhanced(4, _00280008=("IS", str(said))))},
                    refused="says that it has %d images and describes 4" % said)
    yield Input("frames out of order", {"a.dcm": file_of(enhanced(4, each=lambda k: {0x00209113: ("SQ", [{
        0x00200032: ("DS", "-10\\-20\\%d" % (11 - 2 * k))}])}, _7fe00010=("OW", [v for k in (3, 2, 1, 0) for v in stored(k)])))},
        [series()])
    yield Input("four transfer syntaxes", {"%d.dcm" % k: file_of(slice_elements(k), syntax) for k, syntax in enumerate(
        (d.IMPLICIT, d.EXPLICIT, d.BIG_ENDIAN, d.DEFLATED))}, [series()])
    yield Input("from the isocentre, of a tilted gantry", folder(lambda k: file_of(slice_elements(
        k, _00200037=("DS", "1\\0\\0\\0\\0.965926\\-0.258819")))), [series(steps=((0.5, 0, 0), (0, 0.724444, -0.194114), (0, 0, 2)))])


def label_maps():
    names = ('<CaretExtension><LabelTable><Label Key="1">Leber &amp; Galle &lt;1&gt;</Label><Label Key="2"><![CDATA[a &amp; b]]></Label>'
             '</LabelTable></CaretExtension>')
    yield Input("NIfTI names with entities", {"o.nii": nifti(extension=extension_of(names))},
                parts=parts(("Leber & Galle <1>", "a &amp; b")))
    for kind in ("vector", "RGB-color", "3-gradient"):
        fields = {"dimension": "4", "sizes": "3 20 16 12", "space directions": "none (1.5,0,0) (0,2,0) (0,0,3)",
                  "kinds": kind + " domain domain domain"}
        yield Input("NRRD samples of the kind " + kind, {"o.nrrd": nrrd(labels() * 3, fields=fields)},
                    refused="has the kind '%s' (kinds)" % kind.lower())
    fields["sizes"] = "1 20 16 12"
    yield Input("NRRD a vector of one number", {"o.nrrd": nrrd(fields=fields)}, parts=parts())
    first, second = labels((0, 1, 0)), labels((0, 0, 1))
    keys = "Segment0_Name:=liver\nSegment0_LabelValue:=1\nSegment1_Name:=vein\nSegment1_LabelValue:=1\nSegment1_Layer:=1\n"
    fields["sizes"] = "2 20 16 12"
    yield Input("NRRD layers that are called vectors", {"o.seg.nrrd": nrrd(
        [v for pair in zip(first, second) for v in pair], keys=keys, fields=fields)}, parts=[part(1, "liver"), part(2, "vein")])


def surfaces():
    for count in (0, 0xffffffff):
        yield Input("STL a number of facets of %d" % count, {"liver.stl": stl_binary(count=count)}, parts=[box("liver")])
    yield Input("STL a number of facets that is too small", {"o.stl": stl_binary(count=6)},
                refused="holds more triangles than it announces")
    cut = stl_binary(count=0xffffffff)[:-20]
    yield Input("STL cut off, its number of facets the largest", {"o.stl": cut}, refused="fewer triangles than it announces")


def inputs():
    for prefix, groups_ in (("DICOM", (elements, maps, groups)), ("", (label_maps, surfaces))):
        for group in groups_:
            for one in group():
                one.name = "%s habit: %s" % (prefix, one.name) if prefix else one.name.replace(" ", " habit: ", 1)
                yield one
