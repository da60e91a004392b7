# SPDX-License-Identifier: Apache-2.0
"""The pages in docs/formats suffice to read the program's output: the decoders in this folder,
written from them alone, give the program's own pixels, bit by bit. (docs/formats/depth_h264.md
describes an H.264 picture, which this folder does not decode.)"""

import os
import pathlib
import re
import struct
import subprocess
import sys
import tempfile
import unittest

import payload
import recording
from ans import decode_ans
from byte_codecs import decode_lz4, decode_raw, decode_zstd
from rvl import decode_rvl, decode_trvl
from strata import decode_strata

sys.path.insert(0, str(pathlib.Path(__file__).parents[2] / "tools"))
import grey_png  # noqa: E402

DOCS = pathlib.Path(__file__).parents[2] / "docs/formats"


def decode(encoded, reference):
    """Pixels, and what a later frame needs of this one."""
    codec = encoded[0]
    if codec == payload.STRATA:
        return decode_strata(encoded, reference)
    if codec in (payload.RAW, payload.RVL):
        pixels = {payload.RAW: decode_raw, payload.RVL: decode_rvl}[codec](encoded)
    else:
        decoders = {payload.TRVL: decode_trvl, payload.ZSTD: decode_zstd, payload.LZ4: decode_lz4,
                    payload.ANS: decode_ans}
        pixels = decoders[codec](encoded, reference)
    return pixels, pixels


def page_vectors(page):
    """The indented hexadecimal bytes of a page's test vectors, remarks left out, in their order."""
    text = (DOCS / page).read_text()
    vectors = [b""]
    for line in text[text.lower().index("test vector"):].splitlines():
        if line.startswith("    "):
            # Bytes are one or two blanks apart; a remark begins further away, or is no byte.
            for word in line[4:].split("   ")[0].split():
                if not re.fullmatch("[0-9a-f]{2}", word):
                    break
                vectors[-1] += bytes([int(word, 16)])
        elif not line.strip() and vectors[-1]:
            vectors.append(b"")
    return [v for v in vectors if v]


def images(*texts):
    return [[int(number) for number in re.findall(r"\d+", text)] for text in texts]


class Pages(unittest.TestCase):
    def test_the_vectors_of_the_strata_page_decode(self):
        intra, delta, bounded, tall_intra, tall_delta = page_vectors("depth_strata.md")
        first, second, third = images("1000 1001 0 / 999 1003 65535", "1001 1001 0 / 1000 1060 1005",
                                      "1000 1000 0 / 999 1004 65535")
        pixels, remembered = decode_strata(intra, None)
        self.assertEqual(pixels, first)
        self.assertEqual(decode_strata(delta, remembered)[0], second)
        self.assertEqual(decode_strata(bounded, None)[0], third)
        pixels, remembered = decode_strata(tall_intra, None)
        self.assertEqual(pixels, [1000 + x + 8 * y for y in range(32) for x in range(130)])
        pixels, _ = decode_strata(tall_delta, remembered)
        self.assertEqual(pixels, [1001 + x + 8 * y + x * y // 512 for y in range(32) for x in range(130)])

    def test_the_vectors_of_the_other_pages_decode(self):
        reference, picture, runs = images("0 5 1000 1001 / 1001 999 7 65535", "0 0 1002 1000 / 1001 999 7 1",
                                          "0 0 1000 1001 / 1001 999 0 65535")
        quantised = images("0 0 1001 999 / 1001 999 7 1")[0]
        for page, expected in (("raw", picture), ("rvl", runs), ("trvl", picture), ("ans", picture),
                               ("lz4", quantised), ("zstd", picture)):
            with self.subTest(page):
                (vector,) = page_vectors(f"depth_{page}.md")
                self.assertEqual(decode(vector, reference)[0], expected)


def png_pixels(path):
    """The pixels of a 16-bit grey PNG."""
    width, _, rows = grey_png.read_png(path)
    return [pixel for row in rows for pixel in struct.unpack(f">{width}H", row)]


def write_png(path, width, height, pixel):
    """16-bit grey; `pixel` gives the value at x, y."""
    grey_png.write_png(path, width, [struct.pack(f">{width}H", *(pixel(x, y) for x in range(width)))
                                     for y in range(height)])


class Recordings(unittest.TestCase):
    def test_a_recordings_depth_is_what_the_program_exports(self):
        """Key and delta frames from the file's own bytes to pixels, by the pages."""
        theatron = os.environ["THEATRON"]
        with tempfile.TemporaryDirectory() as folder:
            folder = pathlib.Path(folder)
            (folder / "camera/depth").mkdir(parents=True)
            for i in range(5):
                def pixel(x, y):
                    hole = (x // 8 + y // 8) % 5 == 0
                    return 0 if hole else 900 + 2 * y + x + 700 * (x > 60 + i) + (x * 7 + y * 13 + i * 5) % 4
                write_png(folder / f"camera/depth/{i}.png", 132, 64, pixel)
            subprocess.run([theatron, "record", "--camera", f"folder:{folder}/camera,loop=1", "--seconds", "1",
                            folder / "some.mkv"], check=True, capture_output=True)
            subprocess.run([theatron, "export", folder / "some.mkv", "--png", folder / "png"],
                           check=True, capture_output=True)
            pictures = sorted((folder / "png").rglob("depth/*.png"))
            frames = [f for f in recording.frames_of((folder / "some.mkv").read_bytes()) if f.stream % 2 == 0]
            self.assertEqual(len(frames), len(pictures))
            self.assertTrue(frames[0].key)
            remembered = {}
            for frame, picture in list(zip(frames, pictures))[:6]:
                before = None if frame.key else remembered[frame.reference]
                pixels, remembered[frame.frame] = decode(frame.payload, before)
                self.assertEqual(pixels, png_pixels(picture), f"frame {frame.frame}")
            self.assertFalse(all(f.key for f in frames[:6]))


class Payloads(unittest.TestCase):
    def test_every_payload_decodes_to_the_programs_pixels(self):
        data = pathlib.Path(os.environ.get("THEATRON_DATA", os.environ["SHARED_DATA"]))
        folders = sorted(str(f) for f in data.glob("*") if (f / "depth").is_dir())
        if not folders:
            print(f"skipped: slow_decoders.recorded_sequences: no {data}: generated pictures only; set THEATRON_DATA to a folder with recorded sequences")
        with tempfile.TemporaryDirectory() as out:
            subprocess.run([os.environ["WRITE_PAYLOADS"], out, *folders], check=True)
            seen = set()
            for line in (pathlib.Path(out) / "index.txt").read_text().splitlines():
                name, setting, begins, frame, reference = line.split()
                if begins == "1":
                    remembered = {}
                encoded = (pathlib.Path(out) / f"{name}.payload").read_bytes()
                raw = (pathlib.Path(out) / f"{name}.depth").read_bytes()
                before = None if frame == reference else remembered[reference]
                pixels, remembered[frame] = decode(encoded, before)
                self.assertEqual(struct.pack(f"<{len(pixels)}H", *pixels), raw, line)
                seen.add(encoded[0])
            self.assertEqual(seen, set(range(payload.RAW, payload.STRATA + 1)) - {payload.H264})


if __name__ == "__main__":
    unittest.main(verbosity=2)
