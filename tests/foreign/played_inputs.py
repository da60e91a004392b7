# SPDX-License-Identifier: Apache-2.0
"""Files that play as cameras, as other programs and devices leave them, with what a recording of them must have: numbers of
pictures, the exit code (3: something was not given) and a part of what is said. Whole ones are in video_inputs.py."""

import dataclasses
import shutil
import struct
import subprocess
import zlib

from video_inputs import element, track

DEPTH, COLOR = (8, 6), (16, 12)
COUNT = 8
PERIOD = 33  # milliseconds


@dataclasses.dataclass
class Played:
    name: str
    camera: str  # %s: the folder of `files`
    files: dict  # name: bytes, or the arguments of ffmpeg before the name and what is done with its bytes
    depth: int = COUNT
    color: int = COUNT
    code: int = 0
    said: str = ""
    needs: tuple = ()


def png(size, bits, channels, value):
    """A picture of one value."""
    width, height = size
    rows = (b"\0" + value.to_bytes(bits // 8, "big") * channels * width) * height

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    head = struct.pack(">IIBBBBB", width, height, bits, 0 if channels == 1 else 2, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b"")


def depth_png(n):
    return png(DEPTH, 16, 1, 1000 + n)


def color_png(n):
    return png(COLOR, 8, 3, 20 + 20 * n)


def folder(depth="depth/%05d.png", color="color/%05d.png"):
    return {depth % n: depth_png(n) for n in range(COUNT)} | {color % n: color_png(n) for n in range(COUNT)}


def folders():
    camera = "folder:%s,fps=100"
    beside = {"%s/._%05d.png" % (kind, n): b"\0\5\x16\7" + bytes(120) for kind in ("depth", "color") for n in range(COUNT)}
    yield Played("files of macOS beside the pictures", camera, folder() | beside)
    yield Played("folders in capital letters", camera, folder("Depth/%d.png", "RGB/%d.png"))
    scan = {"depth/%07d-%012d.png" % (n + 1, 33_369 * n): depth_png(n) for n in range(COUNT)}
    scan |= {"rgb/%07d-%012d.png" % (n + 3, 33_369 * n + 7000): color_png(n) for n in range(COUNT)}
    yield Played("numbers and times of a scan", camera, scan)


# A grey JPEG of 16x12.
JPEG = bytes.fromhex(
    "ffd8ffe000104a46494600010100000100010000ffdb004300080606070605080707070909080a0c140d0c0b0b0c1912130f141d1a1f1e"
    "1d1a1c1c20242e2720222c231c1c2837292c30313434341f27393d38323c2e333432ffc0000b08000c001001011100ffc4001400010000"
    "0000000000000000000000000000ffc40014100100000000000000000000000000000000ffda0008010100003f0000ffd9")


def blocks(colors_each=1):
    """(track, milliseconds, bytes) of COUNT pictures of depth, each with colour."""
    for n in range(COUNT):
        yield 1, PERIOD * n, struct.pack(">H", 1000 + n) * (DEPTH[0] * DEPTH[1])
        for k in range(colors_each):
            yield 2, PERIOD * n + PERIOD * k // colors_each, JPEG


def cluster(pairs, head=None):
    begin = pairs[0][1]
    body = element("e7", begin) + b"".join(
        element("a3", bytes([0x80 | number]) + struct.pack(">hB", time - begin, 0x80), data) for number, time, data in pairs)
    return element("1f43b675", body) if head is None else head + body


def kinect(clusters, color_name="COLOR", size_is_known=True):
    content = element("1549a966", element("2ad7b1", 1_000_000)) + element(
        "1654ae6b", track(1, "DEPTH", b"b16g", DEPTH), track(2, color_name, b"MJPG", COLOR)) + b"".join(clusters)
    head = element("1a45dfa3", element("4282", "matroska"), element("4287", 4), element("4285", 2))
    return head + (element("18538067", content) if size_is_known else bytes.fromhex("18538067") + b"\1" + b"\xff" * 7 + content)


def groups(made, count=4):
    made = list(made)
    return [made[i:i + count] for i in range(0, len(made), count)]


def recordings():
    camera = "mkv:%s/k.mkv"
    whole = [cluster(one) for one in groups(blocks())]
    yield Played("a recording of a Kinect", camera, {"k.mkv": kinect(whole)})
    broken = [bytes(12) + one[12:] if n == 1 else one for n, one in enumerate(whole)]
    yield Played("a broken part in its middle", camera, {"k.mkv": kinect(broken)}, COUNT - 2, COUNT - 2, 3,
                 "a part of the recording is damaged")
    endless = [cluster(one, bytes.fromhex("1f43b675") + b"\1" + b"\xff" * 7) for one in groups(blocks())]
    killed = kinect(endless, size_is_known=False)
    yield Played("a recorder that was killed", camera, {"k.mkv": killed})
    yield Played("a recorder that was killed within a picture", camera, {"k.mkv": killed[:-len(JPEG) - 30]}, COUNT - 1, COUNT - 1, 3,
                 "a part of the recording is damaged")
    yield Played("a colour track of another name", camera, {"k.mkv": kinect(whole, "CPLOR")}, color=0,
                 said="in a track that is not called COLOR")
    twice = [cluster(one) for one in groups(blocks(2), 3)]
    yield Played("two colour pictures for each of depth", camera, {"k.mkv": kinect(twice)}, said="colour pictures have no depth")


def cut(data):
    return data[:len(data) * 6 // 10]


PICTURES = ("-f", "lavfi", "-i", "testsrc2=size=64x48:rate=50:duration=0.4")
SOUND = ("-f", "lavfi", "-i", "sine=duration=0.2")


def made(name, arguments, then=lambda data: data):
    return {name: (arguments, then)}


def videos():
    for ending, codec in ((".mkv", "mjpeg"), (".avi", "mpeg4"), (".wmv", "wmv2")):
        name = "v" + ending
        words = (*PICTURES, "-c:v", codec, "-q:v", "3")
        yield Played("a whole %s" % name, "video:%%s/%s" % name, made(name, words), 20, 20, needs=("ffmpeg",))
        # How many pictures are in the rest depends on the codec.
        yield Played("%s, cut off" % name, "video:%%s/%s" % name, made(name, words, cut), -1, -1, 3, "is cut off", ("ffmpeg",))
    cover = (*SOUND, *PICTURES, "-map", "0:a", "-map", "1:v", "-frames:v", "1", "-c:a", "aac", "-c:v", "png",
             "-disposition:v:0", "attached_pic")
    yield Played("sound with a cover", "video:%s/s.m4a", made("s.m4a", cover), 0, 0, 1, "has no video track", ("ffmpeg",))
    for name, text in (("l.m3u8", "#EXTM3U\n#EXT-X-TARGETDURATION:2\n#EXTINF:1.2,\nv.mkv\n#EXT-X-ENDLIST\n"),
                       ("l.txt", "ffconcat version 1.0\nfile 'v.mkv'\n")):
        yield Played("a list of files, " + name, "video:%s/" + name, {name: text.encode()}, 0, 0, 1, "is a list of other files")


def inputs():
    for make in (folders, recordings, videos):
        yield from make()


def write(one, target):
    for name, data in one.files.items():
        path = target / name
        path.parent.mkdir(parents=True, exist_ok=True)
        if isinstance(data, tuple):
            subprocess.run(["ffmpeg", "-v", "error", "-y", *data[0], path], check=True, timeout=120)
            path.write_bytes(data[1](path.read_bytes()))
        else:
            path.write_bytes(data)


def is_possible(one):
    return all(shutil.which(program) for program in one.needs)


def problem(one, code, figures, said):
    """What differs from what must come out; None if nothing does."""
    if code != one.code or one.said not in said:
        return "exit code %d, not %d; said: %s" % (code, one.code, said)
    if code == 1:
        return None
    found = [figures["cameras"][0][kind]["pictures"] if figures["cameras"][0].get(kind) else 0 for kind in ("depth", "color")]
    differs = [wanted not in (-1, count) for count, wanted in zip(found, (one.depth, one.color))]
    return "%d pictures of depth and %d of colour, not %d and %d" % (*found, one.depth, one.color) if any(differs) else None
