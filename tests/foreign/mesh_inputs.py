# SPDX-License-Identifier: Apache-2.0
"""Surfaces (STL, PLY, GLB, OBJ) with what an import must make of them."""

import json
import struct

from expected import Input, Part

LOW, HIGH = (10, 20, 30), (50, 45, 60)
VOLUME = 40 * 25 * 30
QUADS = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
CORNERS = [tuple((HIGH if i >> axis & 1 else LOW)[axis] for axis in range(3)) for i in range(8)]
TRIANGLES = [t for a, b, c, d in QUADS for t in ((a, b, c), (a, c, d))]


def box(name=None, triangles=12, **more):
    return Part(name, LOW, HIGH, VOLUME, triangles, **more)


def stl_binary(header=b"", triangles=TRIANGLES, count=None, tail=b""):
    out = header.ljust(80, b"\0") + struct.pack("<I", len(triangles) if count is None else count)
    for t in triangles:
        out += struct.pack("<12fH", 0, 0, 0, *[v for corner in t for v in CORNERS[corner]], 0)
    return out + tail


def stl_text(normal="0 0 1", end="\n", upper=False, close=True, start="", number="%g", name="organ", one_line=False):
    out = start + "solid %s%s" % (name, end)
    for t in TRIANGLES:
        lines = ["facet normal " + normal, "outer loop"]
        lines += ["vertex " + " ".join(number % v for v in CORNERS[corner]) for corner in t]
        lines += ["endloop", "endfacet"]
        out += (" " if one_line else end).join(lines) + end
    if close:
        out += "endsolid %s%s" % (name, end)
    return (out.upper() if upper else out).encode()


def stl_inputs():
    for header in (b"", b"solid organ", b"SOLID by exporter", b"COLOR=\xff\0\xff\xff"):
        for tail in (b"", b"\0", b"\0" * 50, b"made by an exporter"):
            yield Input("binary %r, %d bytes behind" % (header[:6], len(tail)),
                        {"liver.stl": stl_binary(header, tail=tail)}, parts=[box("liver")], silent=True)
    for normal in ("0 0 1", "-1.#IND -1.#IND -1.#IND", "-nan(ind) -nan(ind) -nan(ind)", "nan nan nan",
                   "1.#QNAN 0 0"):
        yield Input("text, normal %s" % normal.split()[0], {"liver.stl": stl_text(normal)}, parts=[box("liver")])
    for name, end in (("LF", "\n"), ("CR LF", "\r\n"), ("CR", "\r")):
        yield Input("text, " + name, {"liver.stl": stl_text(end=end)}, parts=[box("liver")])
        yield Input("text in capitals, " + name, {"liver.stl": stl_text(end=end, upper=True)}, parts=[box("liver")])
    for name, more in (("without its end", {"close": False}), ("an empty line first", {"start": "\n\n"}),
                       ("a mark first", {"start": "\ufeff"}), ("exponents", {"number": "%.3e"}),
                       ("a long name", {"name": "facet vertex 1 2 3"}), ("long lines", {"one_line": True})):
        yield Input("text, " + name, {"liver.stl": stl_text(**more)}, parts=[box("liver")])
    comma = stl_text(number="%.2f").replace(b".", b",")
    yield Input("text, decimal commas", {"liver.stl": comma}, parts=[box("liver")])
    yield Input("cut off", {"liver.stl": stl_binary()[:-60]}, refused="fewer triangles than it announces")
    yield Input("text cut off", {"liver.stl": stl_text(close=False)[:-40]}, refused="fewer triangles")
    yield Input("announces more", {"liver.stl": stl_binary(count=13)}, refused="fewer triangles")
    good = {"liver.stl": stl_binary()}
    for name, data, words in (("no facets", stl_binary(triangles=[]), "holds no triangles"),
                              ("no facets in text", b"solid x\nendsolid x\n", "holds no triangles"),
                              ("words", b"hello world\n" * 20, "no surface of the format"),
                              ("nothing", b"", "is empty; copy it again")):
        yield Input(name + " beside", dict(good, **{"empty.stl": data}), parts=[box("liver")],
                    remarks=["empty.stl' is left out", words])
        yield Input(name + " alone", {"empty.stl": data}, refused=words)


def ply(form="ascii", number="float", index="int", count="uchar", polygons=QUADS, order=("vertex", "face"),
        strips=None, end="\n", extra=True, name="vertex_indices", comment=""):
    codes = {"char": "b", "uchar": "B", "short": "h", "ushort": "H", "int": "i", "uint": "I", "float": "f",
             "double": "d", "float32": "f", "float64": "d", "int32": "i", "uint8": "B", "uint32": "I", "int16": "h"}
    mark = {"ascii": None, "binary_little_endian": "<", "binary_big_endian": ">"}[form]

    def write(values):
        if mark is None:
            return (" ".join("%g" % v for _, v in values) + end).encode()
        return b"".join(struct.pack(mark + codes[kind], v) for kind, v in values)
    head = ["ply", "format %s 1.0" % form, "comment made for a test" + comment]
    body = b""
    for element in order:
        if element == "vertex":
            head += ["element vertex 8"] + ["property uchar quality"] * extra
            head += ["property %s %s" % (number, axis) for axis in "xyz"] + ["property float confidence"] * extra
            for p in CORNERS:
                body += write([("uchar", 200)] * extra + [(number, v) for v in p] + [("float", 0.5)] * extra)
        elif element == "face":
            head += ["element face %d" % len(polygons), "property list %s %s %s" % (count, index, name)]
            head += ["property list uchar float texcoord"] * extra
            for polygon in polygons:
                body += write([(count, len(polygon))] + [(index, i) for i in polygon]
                              + ([("uchar", 2), ("float", 0.5), ("float", 0.25)] if extra else []))
        elif element == "tristrips":
            head += ["element tristrips 1", "property list int int vertex_indices"]
            body += write([("int", len(strips))] + [("int", i) for i in strips])
        else:
            head += ["element %s 2" % element, "property int a", "property list uchar int list_of_others"]
            for _ in range(2):
                body += write([("int", 5), ("uchar", 3), ("int", 1), ("int", 2), ("int", 3)])
    return (end.join(head + ["end_header"]) + end).encode() + body


STRIP = []
for quad in QUADS:
    STRIP += [quad[0], quad[1], quad[3], quad[2], -1]


def ply_inputs():
    forms = ("ascii", "binary_little_endian", "binary_big_endian")
    for form in forms:
        for number in ("float", "double", "float32", "float64", "short"):
            yield Input("%s %s" % (form, number), {"liver.ply": ply(form, number)}, parts=[box("liver")])
        for index, count in (("int", "uchar"), ("uint", "uint8"), ("uchar", "int"), ("ushort", "ushort"),
                             ("int32", "uint32"), ("short", "char")):
            yield Input("%s indices %s %s" % (form, index, count),
                        {"liver.ply": ply(form, index=index, count=count)}, parts=[box("liver")])
        for order in (("face", "vertex"), ("material", "vertex", "face"), ("vertex", "edge", "face", "camera")):
            yield Input("%s %s" % (form, " ".join(order)), {"liver.ply": ply(form, order=order)},
                        parts=[box("liver")])
        yield Input(form + " strips", {"liver.ply": ply(form, order=("vertex", "tristrips"), strips=STRIP)},
                    parts=[box("liver")])
        yield Input(form + " vertex_index", {"liver.ply": ply(form, name="vertex_index")}, parts=[box("liver")])
        yield Input(form + " plain", {"liver.ply": ply(form, extra=False)}, parts=[box("liver")])
        yield Input(form + " points", {"liver.stl": stl_binary(), "marks.ply": ply(form, order=("vertex",))},
                    parts=[box("liver")], remarks=["marks.ply' is left out: it holds no triangles"])
        cut = ply(form)
        yield Input(form + " cut off", {"liver.ply": cut[:-5]}, refused="fewer triangles")
        wrong = [q if q != QUADS[2] else (0, 1, 99, 4) for q in QUADS]
        yield Input(form + " wrong index", {"liver.ply": ply(form, polygons=wrong)}, refused="damaged")
    yield Input("CR LF", {"liver.ply": ply(end="\r\n")}, parts=[box("liver")])
    yield Input("CR LF head of binary", {"liver.ply": ply("binary_little_endian", end="\r\n")}, parts=[box("liver")])
    yield Input("RAS", {"liver.ply": ply(comment=" SPACE=RAS")},
                parts=[Part("liver", (-50, -45, 30), (-10, -20, 60), VOLUME, 12)])
    yield Input("no mesh", {"liver.ply": b"obj\n" * 30}, refused="no surface of the format")


def chunk(kind, data, fill):
    data += fill * (-len(data) % 4)
    return struct.pack("<I", len(data)) + kind + data


def glb(root, buffer=b""):
    body = chunk(b"JSON", json.dumps(root).encode(), b" ") + (chunk(b"BIN\0", buffer, b"\0") if buffer else b"")
    return b"glTF" + struct.pack("<II", 2, 12 + len(body)) + body


COMPONENTS = {"b": 5120, "B": 5121, "h": 5122, "H": 5123, "I": 5125, "f": 5126}


def box_glb(number="f", normalized=False, index="H", mode=4, node=None, stride=0, parts=1, change=None):
    """A box in metres with y up whose place in the patient is that of the others; integers count
    millimetres, or parts of the largest number."""
    # LPS (x, y, z) is (x, z, -y) here.
    metres = [(p[0] / 1000, p[2] / 1000, -p[1] / 1000) for p in CORNERS]
    top = {"b": 127, "B": 255, "h": 32767, "H": 65535}.get(number, 1)
    low = [min(p[a] for p in metres) for a in range(3)]
    size = 0.04
    if number == "f":
        values, place = metres, {}
    else:
        values = [tuple(round((p[a] - low[a]) / size * top) for a in range(3)) for p in metres]
        scale = size if normalized else size / top
        place = {"translation": low, "scale": [scale] * 3}
    width = struct.calcsize(number) * 3
    step = stride or width + (-width % 4)
    vertices = b"".join(struct.pack("<3" + number, *p).ljust(step, b"\xee") for p in values)
    if mode == 5:
        order, links = [], []
        for q in QUADS:
            piece = [q[0], q[1], q[3], q[2]]
            order += ([order[-1], piece[0]] if order else []) + piece
        indices = order
    else:
        indices = [i for t in TRIANGLES for i in t]
    root = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
            "nodes": [dict(place, name="liver", mesh=0, **(node or {}))],
            "meshes": [{"name": "mesh", "primitives": []}],
            "accessors": [{"bufferView": 0, "componentType": COMPONENTS[number], "count": 8, "type": "VEC3",
                           "normalized": normalized}],
            "bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": len(vertices), "byteStride": step}],
            "buffers": []}
    buffer = vertices
    share = len(indices) // parts
    for i in range(parts):
        piece = indices[i * share:(i + 1) * share]
        primitive = {"attributes": {"POSITION": 0}, "mode": mode}
        if index:
            data = struct.pack("<%d%s" % (len(piece), index), *piece)
            root["bufferViews"].append({"buffer": 0, "byteOffset": len(buffer), "byteLength": len(data)})
            root["accessors"].append({"bufferView": 1 + i, "componentType": COMPONENTS[index],
                                      "count": len(piece), "type": "SCALAR"})
            primitive["indices"] = 1 + i
            buffer += data + b"\0" * (-len(data) % 4)
        root["meshes"][0]["primitives"].append(primitive)
    root["buffers"] = [{"byteLength": len(buffer)}]
    if number != "f":
        root["extensionsUsed"] = root["extensionsRequired"] = ["KHR_mesh_quantization"]
    if change:
        change(root)
    return glb(root, buffer)


def glb_inputs():
    for number in "fbBhH":
        for normalized in ((False,) if number == "f" else (False, True)):
            for index in "BHI":
                tolerance = 0.4 if number in "bB" else 0.01
                yield Input("%s %s %s" % (number, normalized, index),
                            {"o.glb": box_glb(number, normalized, index)},
                            parts=[Part("o", LOW, HIGH, None, 12, tolerance)], silent=True)
    yield Input("strip", {"o.glb": box_glb(mode=5)}, parts=[box(tolerance=0.01)])
    yield Input("wide stride", {"o.glb": box_glb(stride=40)}, parts=[box(tolerance=0.01)])
    yield Input("two materials", {"o.glb": box_glb(parts=2)}, parts=[box("o", tolerance=0.01)])
    yield Input("three materials", {"o.glb": box_glb(parts=3)}, parts=[box("o", tolerance=0.01)])
    mirror = {"scale": [-1, 1, 1]}
    yield Input("mirrored", {"o.glb": box_glb(node=mirror)},
                parts=[Part(None, (-50, 20, 30), (-10, 45, 60), VOLUME, 12, 0.01)])
    turned = {"matrix": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0.1, 0.2, 0.3, 1]}
    yield Input("matrix", {"o.glb": box_glb(node=turned)},
                parts=[Part(None, (110, -280, 230), (150, -255, 260), VOLUME, 12, 0.01)])
    for name in ("EXT_mesh_gpu_instancing", "VENDOR_shape"):
        def need(root, name=name):
            root["extensionsRequired"] = root["extensionsUsed"] = [name]
            if name == "EXT_mesh_gpu_instancing":
                root["nodes"][0]["extensions"] = {name: {"attributes": {}}}
        yield Input("needs " + name, {"o.glb": box_glb(change=need)}, refused="needs the glTF extension '%s'" % name)
        yield Input("needs %s, beside" % name, {"o.glb": box_glb(change=need), "liver.stl": stl_binary()},
                    parts=[box("liver")], remarks=["o.glb' is left out", name])
    for name in ("KHR_materials_unlit", "KHR_texture_transform", "KHR_lights_punctual"):
        def harmless(root, name=name):
            root["extensionsRequired"] = root["extensionsUsed"] = [name]
        yield Input("needs " + name, {"o.glb": box_glb(change=harmless)}, parts=[box(tolerance=0.01)])

    def no_scene(root):
        del root["scene"], root["scenes"]
    yield Input("no scene", {"o.glb": box_glb(change=no_scene)}, parts=[box(tolerance=0.01)])

    def outside(root):
        root["bufferViews"][0]["byteLength"] = 10**6
    yield Input("a view beyond the buffer", {"o.glb": box_glb(change=outside)}, refused="fewer triangles")

    def wrong(root):
        root["nodes"].append({"children": [0]})
        root["nodes"][0]["children"] = [1]
    yield Input("a ring of nodes", {"o.glb": box_glb(change=wrong)}, refused="damaged")

    def senseless(root):
        root["accessors"][0] = 5
    yield Input("an accessor that is none", {"o.glb": box_glb(change=senseless)}, refused="damaged")

    def far(root):
        root["buffers"][0]["uri"] = "other.bin"
    yield Input("buffer elsewhere", {"o.glb": box_glb(change=far)}, refused="'other.bin', which must lie beside it")

    def lines(root):
        root["meshes"][0]["primitives"][0]["mode"] = 1
    yield Input("lines", {"o.glb": box_glb(change=lines)}, refused="holds no triangles")
    yield Input("words", {"o.glb": b"hello" * 20}, refused="no surface of the format")
    yield Input("cut off", {"o.glb": box_glb()[:-60]}, refused="damaged")


def obj(materials=1, polygons=QUADS, end="\n", offset=0, name="organ"):
    lines = ["mtllib organ.mtl"]
    lines += ["v %g %g %g" % p for p in CORNERS] + ["o " + name]
    for i, polygon in enumerate(polygons):
        if i % (len(polygons) // materials) == 0:
            lines.append("usemtl m%d" % i)
        lines.append("f " + " ".join(str(v - 8 if offset else v + 1) for v in polygon))
    return (end.join(lines) + end).encode()


def obj_inputs():
    for materials in (1, 2, 3, 6):
        yield Input("%d materials" % materials, {"liver.obj": obj(materials)}, parts=[box("liver")])
    yield Input("CR LF", {"liver.obj": obj(end="\r\n")}, parts=[box("liver")])
    yield Input("counted from the end", {"liver.obj": obj(offset=1)}, parts=[box("liver")])
    yield Input("triangles", {"liver.obj": obj(polygons=TRIANGLES)}, parts=[box("liver")])


def picture_inputs():
    for name, head in (("HEIC", b"\0\0\0\x18ftypheic"), ("WebP", b"RIFF\x20\0\0\0WEBPVP8 "), ("GIF", b"GIF89a"),
                       ("nothing", b""), ("words", b"<html>")):
        for extension in ("jpg", "png"):
            yield Input("%s as .%s" % (name, extension),
                        {"liver.stl": stl_binary(), "photo." + extension: head + b"\x11" * 100 * bool(head)},
                        parts=[box("liver")], pictures=0, remarks=["photo.%s' is left out" % extension])


def inputs():
    for prefix, group in (("STL", stl_inputs), ("PLY", ply_inputs), ("GLB", glb_inputs), ("OBJ", obj_inputs),
                          ("picture", picture_inputs)):
        for one in group():
            one.name = prefix + " " + one.name
            yield one
