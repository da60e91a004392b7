# SPDX-License-Identifier: Apache-2.0
"""GLB whose corners and triangles are packed: with Draco (its bitstream 2.2, sequential) and with meshoptimizer (the
appendix of EXT_meshopt_compression and of its successor of KHR), in the plainest form that the formats have."""

import struct

from expected import Input, Part
from mesh_inputs import box as stl_box
from mesh_inputs import COMPONENTS, CORNERS, HIGH, LOW, TRIANGLES, VOLUME, glb, stl_binary

DRACO, MESHOPT = "KHR_draco_mesh_compression", "EXT_meshopt_compression"
SUCCESSOR = "KHR_meshopt_compression"
DRACO_TYPES = {"b": 1, "B": 2, "h": 3, "H": 4, "i": 5, "I": 6, "f": 9}
# The box, as Debian's draco_encoder packs it (edgebreaker, 14 bits a coordinate).
DRACO_ENCODER = ("445241434f02020101000000080c000b0000035f4b1501011001ff000001000903000002010101000f03011001082b01280400ba1c8100"
                 "4000180007000080002c0800022000000040000c8001000880ff2f00000000ff3f00000ad7233c8fc2f53cec5138bd0ad7233d0e")


def metres():
    """LPS (x, y, z) is (x, z, -y) here."""
    return [(p[0] / 1000, p[2] / 1000, -p[1] / 1000) for p in CORNERS]


def quantized(top):
    low = [min(p[a] for p in metres()) for a in range(3)]
    return [tuple(round((p[a] - low[a]) / 0.04 * top) for a in range(3)) for p in metres()], low


def varint(value):
    out = b""
    while value >= 128:
        out += bytes([value & 127 | 128])
        value >>= 7
    return out + bytes([value])


def draco(points, number="f", triangles=TRIANGLES, identity=0, count=None):
    out = b"DRACO\2\2\1\0\0\0" + varint(len(triangles)) + varint(len(points) if count is None else count) + b"\1"
    out += bytes(corner for t in triangles for corner in t)
    out += b"\1\1\0" + bytes([DRACO_TYPES[number], 3, 0]) + varint(identity) + b"\0"
    return out + b"".join(struct.pack("<3" + number, *p) for p in points)


def zigzag(value, bits):
    value &= (1 << bits) - 1
    return (value << 1 ^ (-1 if value >> (bits - 1) else 0)) & ((1 << bits) - 1)


def meshopt_vertices(data, stride, version=0):
    """Each byte as its difference from that of the vertex before, in groups of 16 plain ones; one block."""
    count = len(data) // stride
    assert count <= min(8192 // stride & ~15, 256)
    groups = (count + 15) // 16
    # Version 1 says of each byte, in two bits, that it is plain, and last of four bytes each that they are differences of bytes.
    out, first = bytes([0xa0 + version]) + b"\xff" * (version * stride // 4), data[:stride]
    channels = bytes(version * stride // 4)
    for k in range(stride):
        column = [data[i * stride + k] for i in range(count)]
        steps = [zigzag(value - before, 8) for value, before in zip(column, [first[k]] + column)]
        steps += [0] * (16 * groups - count)
        out += b"\xff" * ((groups + 3) // 4 * (1 - version)) + bytes(steps)
    return out + (first + channels).rjust(24 if version else 32, b"\0")


def meshopt_triangles(indices):
    out, last = b"", 0
    for i in range(0, len(indices), 3):
        out += b"\xff"
        for index in indices[i:i + 3]:
            out += varint(zigzag(index - last, 32))
            last = index
    return b"\xe1" + b"\xff" * (len(indices) // 3) + out + bytes(16)


def meshopt_sequence(indices):
    out, last = b"", 0
    for index in indices:
        out += varint(zigzag(index - last, 32) << 1)
        last = index
    return b"\xd1" + out + bytes(4)


def node(place=None):
    return dict({"name": "liver", "mesh": 0}, **(place or {}))


def root_of(accessors, views, buffers, extension, place=None, primitive=None):
    return {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [node(place)],
            "meshes": [{"primitives": [dict({"attributes": {"POSITION": 0}, "indices": 1}, **(primitive or {}))]}],
            "accessors": accessors, "bufferViews": views, "buffers": buffers, "extensionsUsed": [extension],
            "extensionsRequired": [extension]}


def draco_glb(data, number="f", normalized=False, place=None, count=8, identity=0, mode=4):
    accessors = [{"componentType": COMPONENTS[number], "count": count, "type": "VEC3", "normalized": normalized},
                 {"componentType": 5123, "count": 36, "type": "SCALAR"}]
    packed = {DRACO: {"bufferView": 0, "attributes": {"POSITION": identity}}}
    return glb(root_of(accessors, [{"buffer": 0, "byteOffset": 0, "byteLength": len(data)}],
                       [{"byteLength": len(data)}], DRACO, place, {"extensions": packed, "mode": mode}), data)


def meshopt_glb(number="f", filter=None, mode="TRIANGLES", index="H", cut=0, change=None, normalized=False, shared=False,
                extension=MESHOPT, version=0, required=True):
    place = None
    points, low = metres(), None
    if number != "f":
        top = {"h": 32767, "H": 65535, "b": 127, "B": 255}[number]
        points, low = quantized(top)
        place = {"translation": low, "scale": [0.04 / (1 if normalized else top)] * 3}
    stride = -(-struct.calcsize("3" + number) // 4) * 4
    plain = b"".join(struct.pack("<3" + number, *p).ljust(stride, b"\0") for p in points)
    if filter == "EXPONENTIAL":
        # A number is 24 bits times a power of two.
        plain = b"".join(struct.pack("<I", (-23 & 255) << 24 | round(v * 2**23) & 0xffffff) for p in points for v in p)
    if shared:
        plain = bytes(stride * 8) + plain
    indices = [i for t in TRIANGLES for i in t]
    vertices = meshopt_vertices(plain, stride, version)
    packed = vertices[:len(vertices) - cut]
    packed += bytes(-len(packed) % 4)
    triangles = meshopt_triangles(indices) if mode == "TRIANGLES" else meshopt_sequence(indices)
    width = struct.calcsize(index)
    count = len(plain) // stride
    about = [{"buffer": 0, "byteOffset": 0, "byteLength": len(vertices) - cut, "byteStride": stride, "count": count,
              "mode": "ATTRIBUTES"},
             {"buffer": 0, "byteOffset": len(packed), "byteLength": len(triangles), "byteStride": width, "count": 36,
              "mode": mode}]
    if filter:
        about[0]["filter"] = filter
    # The second buffer is where other programs would find them plain; this file has none.
    views = [{"buffer": 1, "byteOffset": 0, "byteLength": len(plain), "byteStride": stride, "extensions": {extension: about[0]}},
             {"buffer": 1, "byteOffset": len(plain), "byteLength": 36 * width, "extensions": {extension: about[1]}}]
    accessors = [{"bufferView": 0, "componentType": COMPONENTS[number], "count": 8, "type": "VEC3",
                  "normalized": normalized, "byteOffset": stride * 8 if shared else 0},
                 {"bufferView": 1, "componentType": COMPONENTS[index], "count": 36, "type": "SCALAR"}]
    buffer = packed + triangles
    root = root_of(accessors, views, [{"byteLength": len(buffer)},
                                      {"byteLength": len(plain) + 36 * width, "extensions": {extension: {"fallback": True}}}],
                   extension, place)
    root["extensionsRequired"] = root["extensionsUsed"] = [extension, "KHR_mesh_quantization"]
    if not required:
        del root["extensionsRequired"]
    if change:
        change(root)
    return glb(root, buffer)


def box(tolerance=0.01, volume=VOLUME):
    return Part("o", LOW, HIGH, volume, 12, tolerance)


def inputs():
    for one in (*draco_inputs(), *meshopt_inputs()):
        one.name = "GLB " + one.name
        yield one


def draco_inputs():
    refused = "is damaged, or compressed in a way that is not supported"
    plain = draco(metres())
    yield Input("Draco", {"o.glb": draco_glb(plain)}, parts=[box()], silent=True)
    yield Input("Draco, an identity of 7", {"o.glb": draco_glb(draco(metres(), identity=7), identity=7)}, parts=[box()])
    yield Input("Draco, announced as a strip", {"o.glb": draco_glb(plain, mode=5)}, parts=[box()])
    for number, top in (("h", 32767), ("H", 65535), ("B", 255)):
        points, low = quantized(top)
        for normalized in (False, True):
            place = {"translation": low, "scale": [0.04 / (1 if normalized else top)] * 3}
            data = draco_glb(draco(points, number), number, normalized, place)
            yield Input("Draco %s %s" % (number, normalized), {"o.glb": data},
                        parts=[box(0.4, None) if number == "B" else box()])
    yield Input("Draco of its encoder", {"o.glb": draco_glb(bytes.fromhex(DRACO_ENCODER))}, parts=[box(0.01)])
    for cut in (1, 20, 90, len(plain) - 3):
        yield Input("Draco cut off by %d" % cut, {"o.glb": draco_glb(plain[:-cut])}, refused=refused)
    yield Input("Draco, another identity", {"o.glb": draco_glb(plain, identity=3)}, refused=refused)
    yield Input("Draco, more corners announced", {"o.glb": draco_glb(plain, count=9)}, refused="fewer triangles")
    yield Input("Draco, a corner that is none",
                {"o.glb": draco_glb(draco(metres(), triangles=[(0, 1, 99)] + TRIANGLES[1:]))}, refused="damaged")


def meshopt_inputs():
    refused = "is damaged, or compressed in a way that is not supported"
    for number in "fhH":
        for index in "HI":
            yield Input("meshopt %s %s" % (number, index), {"o.glb": meshopt_glb(number, index=index)}, parts=[box()],
                        silent=True)
    yield Input("meshopt b", {"o.glb": meshopt_glb("b")}, parts=[box(0.4, None)])
    yield Input("meshopt normalized", {"o.glb": meshopt_glb("h", normalized=True)}, parts=[box()])
    yield Input("meshopt, indices in their order", {"o.glb": meshopt_glb(mode="INDICES")}, parts=[box()])
    yield Input("meshopt, exponents", {"o.glb": meshopt_glb(filter="EXPONENTIAL")}, parts=[box()])
    yield Input("meshopt, no filter by name", {"o.glb": meshopt_glb(filter="NONE")}, parts=[box()])
    yield Input("meshopt, two accessors in a view", {"o.glb": meshopt_glb("h", shared=True)}, parts=[box()])
    yield Input("meshopt, directions as corners", {"o.glb": meshopt_glb(filter="OCTAHEDRAL")}, refused=refused)
    yield from successor_inputs(refused)
    for cut in (1, 40, 150):
        yield Input("meshopt cut off by %d" % cut, {"o.glb": meshopt_glb(cut=cut)}, refused=refused)

    def change_of(field, value, view=0):
        def change(root):
            root["bufferViews"][view]["extensions"][MESHOPT][field] = value
        return change
    for field, value, words in (("count", 10**9, refused), ("count", 0, refused), ("byteStride", 300, refused),
                                ("byteStride", 6, refused), ("mode", "POINTS", refused), ("byteOffset", 10**6, "fewer triangles"),
                                ("buffer", 1, "fewer triangles"), ("count", "8", refused)):
        yield Input("meshopt with %s %s" % (field, value), {"o.glb": meshopt_glb(change=change_of(field, value))},
                    refused=words)


def successor_inputs(refused):
    def file(**more):
        return {"o.glb": meshopt_glb(extension=SUCCESSOR, **more)}
    for number in "fhH":
        yield Input("meshopt of KHR %s" % number, file(number=number), parts=[box()], silent=True)
    yield Input("meshopt of KHR, not needed by its list", file(required=False), parts=[box()])
    yield Input("meshopt of KHR, indices in their order", file(mode="INDICES", index="I"), parts=[box()])
    yield Input("meshopt of KHR, exponents", file(filter="EXPONENTIAL"), parts=[box()])
    yield Input("meshopt of KHR cut off", file(cut=40), refused=refused)
    yield Input("meshopt of KHR, colours as corners", file(filter="COLOR"), refused=refused)
    newer = "needs the glTF extension 'KHR_meshopt_compression, version 1', which is not read"
    for number in "fh":
        yield Input("meshopt of KHR, version 1 %s" % number, file(number=number, version=1), refused=newer)
    yield Input("meshopt of KHR, version 1 beside", dict(file(version=1), **{"liver.stl": stl_binary()}),
                parts=[stl_box("liver")], remarks=["o.glb' is left out", newer])

    def colored(root):
        view = {"buffer": 0, "byteOffset": 0, "byteLength": 40, "byteStride": 4, "count": 8, "mode": "ATTRIBUTES",
                "filter": "COLOR"}
        root["bufferViews"].append({"buffer": 1, "byteLength": 32, "byteStride": 4, "extensions": {SUCCESSOR: view}})
        root["accessors"].append({"bufferView": 2, "componentType": 5121, "count": 8, "type": "VEC4", "normalized": True})
        root["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"] = 2
    yield Input("meshopt of KHR, colours by their filter", file(change=colored), parts=[box()], silent=True)
