# SPDX-License-Identifier: Apache-2.0
"""glTF as JSON with its buffers within it or beside it, versions of glTF, and nodes that are hidden."""

import base64
import json
import struct

from expected import Input, Part
from mesh_inputs import HIGH, LOW, VOLUME, box, box_glb, glb, stl_binary

BESIDE = "which must lie beside it and end in .bin"


def opened(data):
    """The JSON and the buffer of a file of one piece."""
    size = struct.unpack_from("<I", data, 12)[0]
    return json.loads(data[20:20 + size]), data[28 + size:]


def data_uri(data, kind="application/octet-stream"):
    return "data:%s;base64,%s" % (kind, base64.b64encode(data).decode())


def gltf(uri, change=None, **more):
    """The box as JSON; `uri` of its buffer, or None."""
    root, buffer = opened(box_glb(**more))
    if uri:
        root["buffers"][0]["uri"] = uri(buffer) if callable(uri) else uri
    if change:
        change(root, buffer)
    return json.dumps(root).encode(), buffer


def organ():
    return [box("liver", tolerance=0.01)]


def buffers():
    for kind in ("application/octet-stream", "application/gltf-buffer", ""):
        yield Input("within it, as '%s'" % kind, {"liver.gltf": gltf(lambda b: data_uri(b, kind))[0]}, parts=organ(), silent=True)
    yield Input("within it, without padding", {"liver.gltf": gltf(lambda b: data_uri(b).rstrip("="))[0]}, parts=organ())
    for name, uri in (("liver.bin", "liver.bin"), ("liver 1.bin", "liver%201.bin"), ("Leber ü.BIN", "Leber%20%C3%BC.BIN"),
                      ("a.glbin", "./a.glbin")):
        text, buffer = gltf(uri)
        yield Input("beside it, %s" % uri, {"liver.gltf": text, name: buffer}, parts=organ(), silent=True)
    text, buffer = gltf("liver.bin")
    yield Input("in another folder", {"a/liver.gltf": text, "b/liver.bin": buffer}, refused=BESIDE)
    yield Input("missing beside another surface", {"liver.stl": stl_binary(), "o.gltf": text}, parts=[box("liver")],
                remarks=["o.gltf' is left out", "'liver.bin', " + BESIDE])
    yield Input("beside it, cut off", {"liver.gltf": text, "liver.bin": buffer[:-20]}, refused="fewer triangles")
    for uri in ("../liver.bin", "/etc/passwd", "sub/liver.bin", "sub\\liver.bin", "http://example.org/liver.bin", "..%2Fliver.bin",
                "file:///etc/passwd", "liver.dcm", "identifiers.json", "..", "liver.bin%00.bin"):
        files = {"in/liver.gltf": gltf(uri)[0], "liver.bin": buffer, "in/sub/liver.bin": buffer, "in/liver.dcm": buffer,
                 "in/identifiers.json": buffer}
        yield Input("buffer at " + uri, files, refused=BESIDE)
    for name, uri in (("no base64", "data:,abc"), ("other signs", "data:;base64,****"), ("a single sign", "data:;base64,A"),
                      ("nothing", "data:")):
        yield Input("within it, " + name, {"o.gltf": gltf(uri)[0]}, refused="impossible 'uri'")

    def apart(root, buffer):
        size = root["bufferViews"][1]["byteOffset"]
        root["buffers"] = [{"uri": data_uri(buffer[:size]), "byteLength": size},
                           {"uri": "indices.bin", "byteLength": len(buffer) - size}]
        root["bufferViews"][1].update(buffer=1, byteOffset=0)
    yield Input("two, within it and beside it", {"liver.gltf": gltf(None, apart)[0], "indices.bin": buffer[96:]}, parts=organ(),
                silent=True)
    yield Input("none", {"o.gltf": gltf(None)[0]}, refused="fewer triangles")

    def one_more(root, buffer):
        root["bufferViews"][1]["buffer"] = 7
    yield Input("one that is not there", {"o.gltf": gltf(data_uri, one_more)[0]}, refused="damaged")
    for number, normalized in (("h", True), ("B", False)):
        yield Input("quantized " + number, {"o.gltf": gltf(data_uri, number=number, normalized=normalized)[0]},
                    parts=[Part("o", LOW, HIGH, None, 12, 0.4 if number == "B" else 0.01)])
    root, buffer = opened(box_glb())
    root["buffers"][0]["uri"] = data_uri(buffer)
    yield Input("a file of one piece, buffer within its text", {"liver.glb": glb(root)}, parts=organ())
    root["buffers"][0]["uri"] = "liver.bin"
    yield Input("a file of one piece, buffer beside it", {"liver.glb": glb(root), "liver.bin": buffer}, parts=organ(), silent=True)
    plain = gltf(data_uri)[0]
    yield Input("text under the other name", {"liver.glb": plain}, parts=organ())
    yield Input("one piece under the other name", {"liver.gltf": box_glb()}, parts=organ())
    yield Input("a mark before its text", {"liver.gltf": b"\xef\xbb\xbf" + plain}, parts=organ())
    yield Input("blanks before its text", {"liver.gltf": b"\n  " + plain}, parts=organ())
    yield Input("its ending in capitals", {"liver.GLTF": plain}, parts=organ())
    yield Input("text cut off", {"o.gltf": plain[:-30]}, refused="damaged")
    yield Input("words", {"o.gltf": b"hello" * 20}, refused="no surface of the format")
    yield Input("a list", {"o.gltf": b"[1, 2]"}, refused="no surface of the format")
    yield Input("nothing", {"o.gltf": b"", "liver.stl": stl_binary()}, parts=[box("liver")], remarks=["o.gltf' is left out"])
    scene = {"liver.gltf": gltf("scene.bin")[0], "scene.bin": buffer, "wood.png.license": b"CC0", "other.bin": b"abc"}
    yield Input("an export with other files", scene, parts=organ(), remarks=["2 files were not read", "other.bin"])


def versions():
    def said(**asset):
        def change(root, buffer=None):
            root["asset"] = asset
        return change
    for asset, words in (({"version": "2.0", "minVersion": "3.0"}, "is of version '3.0' of glTF"),
                         ({"version": "2.1", "minVersion": "2.1"}, "is of version '2.1' of glTF"),
                         ({"version": "3.0"}, "is of version '3.0' of glTF"), ({"version": "1.0"}, "is of version '1.0' of glTF")):
        name = " ".join("%s %s" % pair for pair in asset.items())
        yield Input("JSON, " + name, {"o.gltf": gltf(data_uri, said(**asset))[0]}, refused=words)
        yield Input("one piece, " + name, {"o.glb": box_glb(change=said(**asset)), "liver.stl": stl_binary()}, parts=[box("liver")],
                    remarks=["o.glb' is left out", words])
    for asset in ({"version": "2.0", "minVersion": "2.0"}, {"version": "2.1", "minVersion": "2.0"}, {"version": "2.1"},
                  {"version": "2.0", "minVersion": "1.0"}, {}):
        name = " ".join("%s %s" % pair for pair in asset.items()) or "none"
        yield Input("read, " + name, {"liver.glb": box_glb(change=said(**asset))}, parts=organ(), silent=True)
    old = {"asset": {"version": "1.0"}, "meshes": {"m": {"primitives": []}}, "nodes": {"n": {"meshes": ["m"]}}}
    yield Input("JSON of glTF 1.0", {"o.gltf": json.dumps(old).encode()}, refused="is of version '1.0' of glTF, which is not read")


def visibility():
    def hide(node, need=False, visible=False):
        def change(root):
            root["nodes"].append({"name": "tumour", "mesh": 0, "translation": [0.2, 0, 0]})
            root["nodes"].append({"name": "group", "children": [1]})
            root["scenes"][0]["nodes"] = [0, 2]
            root["extensionsUsed"] = ["KHR_node_visibility"]
            if need:
                root["extensionsRequired"] = ["KHR_node_visibility"]
            for at in node:
                root["nodes"][at]["extensions"] = {"KHR_node_visibility": {"visible": visible} if visible is not None else {}}
        return box_glb(change=change)
    both = organ() + [Part("tumour", (210,) + LOW[1:], (250,) + HIGH[1:], VOLUME, 12, 0.01)]
    for name, data in (("a node", hide([1])), ("a node above", hide([2])), ("and it is needed", hide([1], True))):
        yield Input(name, {"liver.glb": data}, parts=organ(),
                    remarks=["'tumour' is hidden in", "left out"])
    yield Input("all", {"o.glb": hide([0, 2])}, refused="holds no surface that is visible")
    for name, visible in (("said to be visible", True), ("without a word", None)):
        yield Input(name, {"o.glb": hide([1, 2], visible=visible)}, parts=both, silent=True)


def inputs():
    for prefix, group in (("glTF buffers", buffers), ("glTF version", versions), ("glTF hidden", visibility)):
        for one in group():
            one.name = "%s: %s" % (prefix, one.name)
            yield one
