# SPDX-License-Identifier: Apache-2.0
"""Videos, recordings and folders of pictures as other programs and cameras write them, made by FFmpeg. The right values are those
that FFmpeg shows (values.py). Only for compare_readers.py."""

import struct
import subprocess

# Not too colourful: a recording keeps colour as JPEG, which cuts the brightest ones off. The source has even sides alone.
SOURCE = "testsrc2=size=%s:rate=%s:duration=%s,hue=s=0.5,scale=%s"
H264 = ("-c:v", "libx264", "-preset", "veryfast", "-crf", "12", "-g", "5")


def ffmpeg(*words):
    subprocess.run(["ffmpeg", "-v", "error", "-y", *map(str, words)], check=True, timeout=120)


def source(size="320x240", rate=25, seconds=0.6):
    return "-f", "lavfi", "-i", SOURCE % (size, rate, seconds, size.replace("x", ":"))


def colors(matrix, full):
    """Converts to these colours, and says so in the stream."""
    names = {"bt601": ("smpte170m", "bt601"), "bt709": ("bt709", "bt709"), "bt2020": ("bt2020nc", "bt2020")}
    tag, scale = names[matrix]
    kind = "pc" if full else "tv"
    return ("-vf", "scale=out_color_matrix=%s:out_range=%s,format=yuv420p" % (scale, kind), "-colorspace", tag, "-color_range", kind)


def videos(folder):
    """(name, file, how FFmpeg shows it as it is meant, where that is not by itself)"""
    def made(name, ending, *words, begin=source(), shown=()):
        file = folder / (name.replace(" ", "_").replace(",", "") + ending)
        ffmpeg(*begin, *words, file)
        return name, file, shown
    square = ("-vf", "scale=iw*sar:ih")
    for matrix in ("bt601", "bt709", "bt2020"):
        for full in (False, True):
            yield made("H.264, %s, %s range" % (matrix, "full" if full else "limited"), ".mp4", *colors(matrix, full), *H264)
    yield made("H.264, large, nothing said of its colours", ".mp4", "-vf", "scale=out_color_matrix=bt709,format=yuv420p", *H264,
               begin=source("1280x720"), shown=("-vf", "scale=in_color_matrix=bt709"))
    for pixels in ("yuv422p", "yuv444p", "yuv420p10le", "yuv422p10le", "gray"):
        yield made("H.264, " + pixels, ".mkv", "-vf", "scale=out_color_matrix=bt709:out_range=tv", "-pix_fmt", pixels, "-colorspace",
                   "bt709", "-color_range", "tv", *H264)
    for pixels, codec in (("rgb24", "ffv1"), ("bgra", "ffv1"), ("gbrp", "libx264rgb"), ("gray16le", "ffv1"), ("bgr24", "rawvideo"),
                          ("rgb555le", "rawvideo")):
        name = "gbrp, x264" if codec == "libx264rgb" else "%s, %s" % (pixels, codec)
        words = ("-c:v", codec) if codec != "libx264rgb" else ("-c:v", "libx264rgb", "-crf", "0")
        yield made(name, ".avi" if codec == "rawvideo" else ".mkv", *(() if codec == "libx264rgb" else ("-pix_fmt", pixels)), *words)
    yield made("odd sides", ".mkv", "-pix_fmt", "yuv444p", *H264, begin=source("321x241"))
    plain = made("plain", ".mp4", "-pix_fmt", "yuv420p", *H264)[1]
    for angle in (90, 180, 270):
        turned = folder / ("turned_%d.mp4" % angle)
        ffmpeg("-i", plain, "-c", "copy", "-metadata:s:v:0", "rotate=%d" % angle, turned)
        yield "turned by %d degrees" % angle, turned, ()
    yield made("variable frame rate", ".mkv", "-vf", "select='not(eq(n,3)+eq(n,4)+eq(n,9))'", "-vsync", "vfr", "-pix_fmt", "yuv420p",
               *H264)
    yield made("interlaced", ".mp4", "-vf", "interlace,format=yuv420p", "-flags", "+ilme+ildct", *H264)
    yield made("interlaced MPEG-2", ".mpg", "-vf", "interlace,format=yuv420p", "-flags", "+ilme+ildct", "-c:v", "mpeg2video", "-q:v", "2")
    yield made("PAL, anamorphic", ".mpg", "-aspect", "16:9", "-c:v", "mpeg2video", "-q:v", "2", begin=source("720x576"), shown=square)
    yield made("MJPEG in AVI", ".avi", "-pix_fmt", "yuvj422p", "-c:v", "mjpeg", "-q:v", "2")
    yield made("MJPEG in MOV", ".mov", "-pix_fmt", "yuvj420p", "-c:v", "mjpeg", "-q:v", "2")
    yield made("DV", ".dv", "-pix_fmt", "yuv420p", "-s", "720x576", "-c:v", "dvvideo", shown=square)
    for codec, ending in (("libx265", ".mp4"), ("libvpx-vp9", ".webm"), ("prores_ks", ".mov"), ("mpeg4", ".avi"), ("wmv2", ".wmv")):
        yield made(codec, ending, "-c:v", codec)
    sound = ("-f", "lavfi", "-i", "sine=duration=0.6")
    yield made("sound first", ".mp4", "-map", "0:a", "-map", "1:v", "-pix_fmt", "yuv420p", *H264, begin=(*sound, *source()))
    yield made("sound first, in a transport stream", ".ts", "-map", "0:a", "-map", "1:v", "-pix_fmt", "yuv420p", *H264,
               begin=(*sound, *source()))
    yield made("two video tracks", ".mkv", "-map", "0:v", "-map", "1:v", "-pix_fmt", "yuv420p", *H264,
               begin=(*source(), "-f", "lavfi", "-i", "color=red:size=160x120:duration=0.6"))
    cover = folder / "cover.png"
    ffmpeg("-f", "lavfi", "-i", "color=blue:size=64x64", "-frames:v", "1", cover)
    with_cover = folder / "with_cover.mp4"
    ffmpeg("-i", cover, "-i", plain, "-map", "0", "-map", "1", "-c", "copy", "-disposition:v:0", "attached_pic", with_cover)
    yield "a cover picture first", with_cover, ()
    edited = folder / "edited.mp4"
    ffmpeg("-ss", "0.2", "-i", plain, "-c", "copy", edited)
    yield "an edit list", edited, ()
    yield made("pictures out of order (B)", ".mp4", "-pix_fmt", "yuv420p", "-bf", "3", *H264)
    data = plain.read_bytes()
    fast = folder / "fast.mp4"
    ffmpeg("-i", plain, "-c", "copy", "-movflags", "+faststart", fast)
    for name, content in (("cut off behind its index", fast.read_bytes()[:-9000]), ("index missing", data[:len(data) // 2])):
        file = folder / (name.replace(" ", "_") + ".mp4")
        file.write_bytes(content)
        yield name, file, ()
    stream = folder / "stream.ts"
    ffmpeg("-i", plain, "-c", "copy", stream)
    part = folder / "from_the_middle.ts"
    part.write_bytes(stream.read_bytes()[188 * 20 + 77:])
    yield "a transport stream from its middle", part, ()
    raw = folder / "raw.h264"
    ffmpeg("-i", plain, "-c", "copy", raw)
    yield "a bare stream", raw, ()
    yield made("animated", ".gif")
    yield made("times that jump by 30 hours", ".mkv", "-vf", "setpts=PTS+gte(N\\,8)*108000/TB", "-vsync", "passthrough", "-pix_fmt",
               "yuv420p", *H264)


def element(kind, *content):
    """An element of Matroska, whose content is bytes, numbers and texts."""
    body = b"".join(one if isinstance(one, bytes) else one.encode() if isinstance(one, str) else one.to_bytes(8, "big") for one in content)
    return bytes.fromhex(kind) + b"\1" + len(body).to_bytes(7, "big") + body


def track(number, name, fourcc, size):
    form = struct.pack("<IiiHH4s5I", 40, *size, 1, 16, fourcc, 0, 0, 0, 0, 0)
    return element("ae", element("d7", number), element("73c5", number), element("83", 1), element("86", "V_MS/VFW/FOURCC"),
                   element("63a2", form), element("536e", name), element("23e383", 33_333_333),
                   element("e0", element("b0", size[0]), element("ba", size[1])))


def matroska(tracks, blocks):
    """`blocks`: (track, milliseconds, bytes), in their order."""
    clusters = [element("1f43b675", element("e7", time), element("a3", bytes([0x80 | number, 0, 0, 0x80]), data))
                for number, time, data in blocks]
    return (element("1a45dfa3", element("4282", "matroska"), element("4287", 4), element("4285", 2))
            + element("18538067", element("1549a966", element("2ad7b1", 1_000_000)), element("1654ae6b", *tracks), *clusters))


def pictures(folder, size, *words):
    """The bytes of six pictures each."""
    folder.mkdir()
    ffmpeg(*source("%dx%d" % size, 30, 0.2), *words, folder / "%02d")
    return [file.read_bytes() for file in sorted(folder.iterdir())]


def recordings(folder):
    """As an Azure Kinect writes them: (name, file)"""
    jpeg = ("-c:v", "mjpeg", "-q:v", "2", "-pix_fmt", "yuvj422p", "-f", "image2")
    raw = ("-c:v", "rawvideo", "-pix_fmt", "gray16be", "-f", "image2")

    def written(name, depth_size, color_size, order=None, jump=0):
        depth = [(1, 33 * n + 7 + jump * (n > 3), one) for n, one in enumerate(pictures(folder / (name + " depth"), depth_size, *raw))]
        color = [(2, 33 * n + 5 + jump * (n > 3), one) for n, one in enumerate(pictures(folder / (name + " color"), color_size, *jpeg) if color_size else ())]
        blocks = sorted(depth + color, key=order or (lambda one: one[1]))
        tracks = [track(1, "DEPTH", b"b16g", depth_size)] + ([track(2, "COLOR", b"MJPG", color_size)] if color_size else [])
        file = folder / (name + ".mkv")
        file.write_bytes(matroska(tracks, blocks))
        return name, file
    for size in ((640, 576), (320, 288), (512, 512), (1024, 1024), (321, 241), (16, 16), (17, 3)):
        yield written("depth %dx%d" % size, size, (1280, 720))
    for size in ((1920, 1080), (2048, 1536), (161, 121)):
        yield written("colour %dx%d" % size, (320, 288), size)
    yield written("depth alone", (320, 288), None)
    yield written("a clock that jumps by a day", (320, 288), (640, 480), jump=86_400_000)
    yield written("all colour first", (320, 288), (640, 480), order=lambda one: (-one[0], one[1]))
    name, file = written("cut off", (640, 576), (1280, 720))
    file.write_bytes(file.read_bytes()[:-900_000])
    yield name, file


def folders(folder):
    """(name, folder)"""
    for name, pixels, ending, more in (
            ("RGB", "rgb24", "png", ()), ("alpha", "rgba", "png", ()), ("a table of colours", "pal8", "png", ()), ("grey", "gray", "png", ()),
            ("16 bits", "rgb48be", "png", ()), ("JPEG 4:2:0", "yuvj420p", "jpg", ("-q:v", 2)), ("JPEG 4:4:4", "yuvj444p", "jpg", ("-q:v", 2)),
            ("JPEG grey", "gray", "jpg", ("-q:v", 2)), ("odd sides", "rgb24", "png", ())):
        size = "161x121" if name == "odd sides" else "160x120"
        out = folder / ("folder_" + name.replace(" ", "_").replace(":", ""))
        for kind, form in (("depth", "gray16be"), ("color", pixels)):
            (out / kind).mkdir(parents=True)
            ffmpeg(*source(size, 5, 1), *(more if kind == "color" else ()), "-pix_fmt", form,
                   out / kind / ("%05d." + ("png" if kind == "depth" else ending)))
        yield name, out
