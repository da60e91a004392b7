# SPDX-License-Identifier: Apache-2.0
"""Values that formats forbid or hardly ever have: each is read as it can only be meant, or refused with the name of its field."""

import math
import struct

import dicom_inputs
from dicom_bytes import file_of, slice_elements
from expected import Input, Part
from label_inputs import ORIGIN, STEP, labels, nifti, nrrd, part, parts
from mesh_inputs import CORNERS, HIGH, LOW, QUADS, TRIANGLES, VOLUME, box, box_glb, ply
from more_inputs import placed_part


def glb(name, change, **wanted):
    return Input(name, {"o.glb": box_glb(change=change)}, **wanted)


def node_with(**properties):
    return lambda root: root["nodes"][0].update(properties)


def glb_places():
    turned = [Part(None, (-45, 10, 30), (-20, 50, 60), VOLUME, 12, 0.01)]
    for length in (2, 0.5, 0.999):
        part = length * 0.5 ** 0.5
        yield glb("a rotation of length %g" % length, node_with(rotation=[0, part, 0, part]), parts=turned)
    yield glb("a rotation of zeros", node_with(rotation=[0, 0, 0, 0]), refused="has an impossible 'rotation'")
    for name, at, value in (("a last number of 2", 15, 2), ("perspective", 3, 0.5)):
        matrix = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]
        matrix[at] = value
        yield glb("a matrix with " + name, node_with(matrix=matrix), refused="has an impossible 'matrix'")
    yield glb("a translation of two numbers", node_with(translation=[1, 2]), refused="has an impossible 'translation'")
    yield glb("a scale in words", node_with(scale=["1", "1", "1"]), refused="has an impossible 'scale'")
    for signs, low, high in (((-1, -1, 1), (-50, 20, -60), (-10, 45, -30)), ((-1, -1, -1), (-50, -45, -60), (-10, -20, -30))):
        yield glb("mirrored by %s" % (signs,), node_with(scale=list(signs)), parts=[Part(None, low, high, VOLUME, 12, 0.01)])
    yield glb("bent by a skeleton", node_with(skin=0), refused="is bent by a skeleton")

    def beside(root):
        root["nodes"].append({"name": "copy", "mesh": 0, "translation": [0.2, 0, 0]})
        root["scenes"][0]["nodes"] = [0.0, 1.0]
    yield glb("numbers of nodes with a point", beside, parts=[
        Part(None, LOW, HIGH, VOLUME, 12, 0.01), Part(None, (210, 20, 30), (250, 45, 60), VOLUME, 12, 0.01)])


def glb_numbers():
    def offset(value):
        def change(root):
            root["bufferViews"][1]["byteOffset"] = value
        return change
    right = [box(tolerance=0.01)]
    yield glb("a place with a point", offset(96.0), parts=right)
    for value in (96.5, "96", -96):
        yield glb("a place of %r" % value, offset(value), refused="fewer triangles than it announces")

    def stride(root):
        root["bufferViews"][0]["byteStride"] = 4
    yield glb("corners that overlap", stride, refused="has an impossible 'byteStride'")

    def mode(root):
        root["meshes"][0]["primitives"][0]["mode"] = "4"
    yield glb("a mode in words", mode, refused="has an impossible 'mode'")

    def normalized(root):
        root["accessors"][0]["normalized"] = True
        # In place of the node's: the corners themselves lie beyond -1.
        root["nodes"][0]["translation"] = [2, 0, 0]
    far = bytearray(box_glb(change=normalized))
    begin = far.index(b"BIN\0") + 4
    for at in range(begin, begin + 96, 12):
        struct.pack_into("<f", far, at, struct.unpack_from("<f", far, at)[0] - 2)
    yield Input("floating-point numbers as parts of the largest", {"o.glb": bytes(far)}, parts=right)


def glb_shapes():
    """The target is the box itself, so a weight of 1 moves each corner as far as it is from the middle of the room."""
    for on, weights, scale in (("meshes", [1], 2), ("meshes", [0], 1), ("meshes", [], 1), ("nodes", [0.5], 1.5)):
        def change(root, on=on, weights=weights):
            root["meshes"][0]["primitives"][0]["targets"] = [{"POSITION": 0}]
            root["meshes"][0]["weights"] = [0]
            root[on][0]["weights"] = weights
        low, high = ([scale * v for v in corner] for corner in (LOW, HIGH))
        yield glb("another shape, %s %s" % (on, weights), change, parts=[Part(None, low, high, scale ** 3 * VOLUME, 12, 0.02)])

    def words(root):
        root["meshes"][0]["primitives"][0]["targets"] = [{"POSITION": 0}]
        root["meshes"][0]["weights"] = ["1"]
    yield glb("a weight in words", words, refused="has an impossible 'weights'")


def stl_text(polygons, tail="endsolid q\n"):
    out = "solid q\n"
    for polygon in polygons:
        out += "facet normal 0 0 0\nouter loop\n"
        out += "".join("vertex %g %g %g\n" % CORNERS[corner] for corner in polygon) + "endloop\nendfacet\n"
    return (out + tail).encode()


def surfaces():
    refused = "has facets that are no triangles"
    yield Input("STL quads", {"o.stl": stl_text(QUADS)}, refused=refused)
    yield Input("STL hexagons", {"o.stl": stl_text([(0, 2, 3, 1, 5, 4)] * 2)}, refused=refused)
    first, second, *others = TRIANGLES
    yield Input("STL two corners, then four", {"o.stl": stl_text([first[:2], second + (0,), *others])}, refused=refused)
    yield Input("STL a loop of none", {"o.stl": stl_text([(), *TRIANGLES])}, refused=refused)
    plain = ply(extra=False).decode()
    capitals = plain
    for axis in "xyz":
        capitals = capitals.replace("float " + axis, "float " + axis.upper())
    yield Input("PLY axes in capitals", {"liver.ply": capitals.encode()}, parts=[box("liver")])
    yield Input("PLY without z", {"o.ply": plain.replace("float z", "float depth").encode()}, refused="gives its corners no x, y and z")
    listed = plain.replace("property float z", "property list uchar float z")
    yield Input("PLY with a list as z", {"o.ply": listed.encode()}, refused="gives its corners no x, y and z")
    lines = ["v %g %g %g" % p for p in CORNERS] + ["f " + " ".join("%d" % (i + 1) for i in q) for q in QUADS]
    yield Input("OBJ a mark first", {"liver.obj": ("\ufeff" + "\n".join(lines) + "\n").encode()}, parts=[box("liver")])
    for end in ("f", "f 2", "f 2 ", "f 2 6\n"):
        yield Input("OBJ ends with %r" % end, {"o.obj": "\n".join(lines[:-1] + [end]).encode()}, refused="fewer triangles")
    folded = [line.replace(" ", " \\\n", 1) for line in lines]
    yield Input("OBJ a last line in two", {"liver.obj": "\n".join(folded).encode()}, parts=[box("liver")])
    for name, first in (("a word", "v N/A 20 30"), ("two numbers", "v 10 20"), ("no number", "v nan 20 30")):
        yield Input("OBJ a corner of " + name, {"o.obj": "\n".join([first] + lines[1:]).encode()}, refused="o.obj'")
    half = [tuple(v + 0.5 for v in p) for p in CORNERS]
    commas = [("v %.2f %.2f %.2f" % p).replace(".", ",") for p in half] + lines[8:]
    yield Input("OBJ decimal commas", {"liver.obj": "\n".join(commas).encode()}, parts=[
        Part("liver", [v + 0.5 for v in LOW], [v + 0.5 for v in HIGH], VOLUME, 12)])


def nifti_files():
    def changed(*fields, data=None):
        out = bytearray(data or nifti(sform=False, qform=True))
        for at, form, *values in fields:
            struct.pack_into("<" + form, out, at, *values)
        return {"o.nii": bytes(out)}
    yield Input("a quaternion of length 2", changed((256, "3f", 0, 0, 2)), refused="no rotation")
    yield Input("a quaternion a bit too long", changed((256, "3f", 0, 0, 1.00001)), parts=parts())
    yield Input("a step below 0", changed((80, "f", -1.5)), refused="has a step below 0 (pixdim)")
    for factor in (0, 5):
        yield Input("a hand of %d" % factor, changed((76, "f", factor)), parts=parts())
    yield Input("unit 5", changed((123, "B", 5)), refused="has the unit 5 (xyzt_units)")
    yield Input("a unit of time beside", changed((123, "B", 10)), parts=parts())
    for value in (352.5, -4, math.nan, math.inf):
        yield Input("samples at %g" % value, changed((108, "f", value)), refused="(vox_offset)")
    yield Input("an infinite slope", changed((112, "f", math.inf)), refused="infinite scale")
    yield Input("an infinite intercept", changed((116, "f", math.inf)), refused="infinite scale")
    yield Input("a slope of -1", {"o.nii": nifti(labels((0, -1, -2)), "int16", slope=-1.0)}, parts=parts())
    yield Input("a fourth side of 0", changed((40, "5h", 4, 20, 16, 12, 0)), parts=parts())
    yield Input("seven sides, zeros behind", changed((40, "8h", 7, 20, 16, 12, 1, 0, 0, 0)), parts=parts())
    left = nifti(matrix=[(STEP[0], 0, 0, -ORIGIN[0]), (0, -STEP[1], 0, -ORIGIN[1]), (0, 0, STEP[2], ORIGIN[2])])
    yield Input("a left-handed sform", {"o.nii": left}, parts=[
        placed_part(n, lambda i, j, k: (12 - 1.5 * i, -30 + 2 * j, 40 + 3 * k)) for n in (1, 2)])


def nrrd_files():
    def with_field(name, value):
        return {"o.nrrd": nrrd(fields={name: value})}
    for name, value in (("space origin", "(12,abc,-30,40)"), ("space origin", "(12,5,-30,40)"), ("space origin", "12,-30,40"),
                        ("space directions", "(1.5mm,0,0) (0,2mm,0) (0,0,3mm)"), ("space directions", "(1,5,0,0) (0,2,0) (0,0,3)"),
                        ("space directions", "(1.5;0;0) (0;2;0) (0;0;3)"), ("space directions", "(1.5,0,0) (0,2,0) (0,0,3"),
                        ("sizes", "20x16x12"), ("sizes", "0x14 16 12"), ("sizes", "20.5 16 12"), ("sizes", "20 16"),
                        ("endian", "middle"), ("byte skip", "abc"), ("byte skip", "1.5"), ("byte skip", "-2"), ("line skip", "-1"),
                        ("line skip", "1 2")):
        yield Input("%s: %s" % (name, value), with_field(name, value), refused="has the field '%s' with '%s'" % (name, value))
    yield Input("signs and commas of vectors", with_field("space directions", "(+1.5,0.,-0)(0,2.0,0)\t(0,0,3)"), parts=parts())
    middle = {"dimension": "4", "space directions": "(1.5,0,0) none (0,2,0) (0,0,3)", "kinds": "domain list domain domain"}
    yield Input("a list of one, in the middle", {"o.nrrd": nrrd(fields=dict(middle, sizes="20 1 16 12"))}, parts=parts())
    first, second = labels((0, 1, 0)), labels((0, 0, 2))
    rows = [v for at in range(0, len(first), 20) for layer in (first, second) for v in layer[at:at + 20]]
    planes = [v for at in range(0, len(first), 320) for layer in (first, second) for v in layer[at:at + 320]]
    for name, values, sizes, directions in (("second", rows, "20 2 16 12", middle["space directions"]),
                                            ("third", planes, "20 16 2 12", "(1.5,0,0) (0,2,0) none (0,0,3)")):
        fields = dict(middle, sizes=sizes, **{"space directions": directions})
        yield Input("a list of two, as the %s axis" % name, {"o.nrrd": nrrd(values, fields=fields)}, parts=parts())
    name = "Segment0_Name:=liver\nSegment0_LabelValue:=%s\n"
    yield Input("a label's number with a comma", {"o.seg.nrrd": nrrd(keys=name % "1,5")}, parts=parts())
    yield Input("a label's number with blanks", {"o.seg.nrrd": nrrd(keys=name % " 1 ")}, parts=[part(1, "liver"), part(2, "label 2")])


def dicom_files():
    def files(**changed):
        return {"a%d.dcm" % k: file_of(slice_elements(k, **changed)) for k in range(dicom_inputs.SLICES)}
    for frames in ("0", "1.0", "1."):
        yield Input("%s frames" % frames, files(_00280008=("IS", frames)), [dicom_inputs.series()])
    yield Input("rows in words", files(_00280010=("IS", "12.0")), [dicom_inputs.series()])
    yield Input("the kind of values 2", files(_00280103=("US", 2)), refused="has the pixel representation 2")
    for slope in ("0x1", "1 HU", "inf", "nan", "--1"):
        yield Input("a slope of " + slope, files(_00281053=("DS", slope)), refused="has the rescale slope '%s'" % slope)
    yield Input("directions of length 2", files(_00200037=("DS", "2\\0\\0\\0\\2\\0")), [dicom_inputs.series()])
    yield Input("spacings with a unit", files(_00280030=("DS", "0.75mm\\0.5mm")), refused="has the pixel spacing '0.75mm")


def inputs():
    for prefix, groups in (("GLB", (glb_places, glb_numbers, glb_shapes)), ("", (surfaces,)), ("NIfTI", (nifti_files,)),
                           ("NRRD", (nrrd_files,)), ("DICOM", (dicom_files,))):
        for group in groups:
            for one in group():
                one.name = "%s unusual: %s" % (prefix, one.name) if prefix else one.name.replace(" ", " unusual: ", 1)
                yield one
