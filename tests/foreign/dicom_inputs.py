# SPDX-License-Identifier: Apache-2.0
"""DICOM inputs with what an import must make of them."""

import gzip
import struct

import dicom_bytes as d
from dicom_bytes import COLUMNS, ROWS, Encoding, file_of, slice_elements, stored
from expected import Input, Series

SLICES = 4


def measured(x, y, z, slope=1, intercept=-1024):
    return slope * stored(z)[y * COLUMNS + x] + intercept


def folder(make, count=SLICES, name="IM%03d.dcm"):
    return {name % k: make(k) for k in range(count)}


def series(value=measured, count=SLICES, **more):
    return Series((COLUMNS, ROWS, count), value, **more)


def good(count=SLICES):
    return folder(lambda k: file_of(slice_elements(k)), count)


def words(values, order="<"):
    return struct.pack(order + "%dH" % len(values), *[value & 0xffff for value in values])


def ways_of_writing():
    ways = [("implicit", d.IMPLICIT), ("explicit", d.EXPLICIT), ("big-endian", d.BIG_ENDIAN),
            ("deflated", d.DEFLATED)]
    bits = [("u16", 16, 15, 0), ("s16", 16, 15, 1), ("u12", 12, 11, 0), ("s12", 12, 11, 1),
            ("u12-high-15", 12, 15, 0), ("s12-high-15", 12, 15, 1), ("u12-high-13", 12, 13, 0)]
    for way, syntax in ways:
        for kind, count, high, signed in bits:
            def value(x, y, z, signed=signed, count=count):
                number = stored(z)[y * COLUMNS + x]
                return number - (2000 if signed else 0) - 1024

            def make(k, syntax=syntax, count=count, high=high, signed=signed):
                numbers = [(v - (2000 if signed else 0)) & ((1 << count) - 1) for v in stored(k)]
                # Overlays and other planes may use the bits beside.
                beside = 0 if high == 15 else 1 << 15
                numbers = [v << (high + 1 - count) | beside for v in numbers]
                order = ">" if syntax == d.BIG_ENDIAN else "<"
                return file_of(slice_elements(k, _00280101=("US", count), _00280102=("US", high),
                                              _00280103=("US", signed),
                                              _7fe00010=("OW", words(numbers, order))), syntax)
            if count == 12 and signed:
                # 12 bits hold -2048 to 2047.
                yield Input("%s %s" % (way, kind), folder(make), [series(value)])
            else:
                yield Input("%s %s" % (way, kind), folder(make), [series(value)])
        yield Input("%s without preamble" % way,
                    folder(lambda k, s=syntax: file_of(slice_elements(k), s, preamble=False), name="IM%d"),
                    [series()])
    for way, syntax, encoding in [("explicit", d.EXPLICIT, Encoding(True)),
                                  ("implicit", d.IMPLICIT, Encoding(False))]:
        yield Input("only elements, %s" % way,
                    folder(lambda k, s=syntax, e=encoding: file_of(
                        slice_elements(k), s, preamble=False, head=False, encoding=e), name="%d"),
                    [series()])
    for said, written in [(d.EXPLICIT, Encoding(False)), (d.IMPLICIT, Encoding(True)),
                          (d.EXPLICIT, Encoding(True, ">")), (d.BIG_ENDIAN, Encoding(True)),
                          (d.DEFLATED, Encoding(True))]:
        def make(k, said=said, written=written):
            elements = slice_elements(k)
            if said != d.DEFLATED:
                return file_of(elements, said, encoding=written)
            return file_of(elements, d.EXPLICIT).replace(d.EXPLICIT.encode() + b"\0",
                                                         d.DEFLATED.encode() + b"\0" * 0)
        if said == d.DEFLATED:
            continue
        yield Input("says %s, is %s%s" % (said, written.explicit, written.order), folder(make),
                    [series()])


def bytes_around():
    for count in (1, 2, 7, 8, 64, 512, 4096):
        yield Input("%d zeros behind" % count,
                    folder(lambda k, n=count: file_of(slice_elements(k), tail=b"\0" * n)), [series()])
    yield Input("other bytes behind",
                folder(lambda k: file_of(slice_elements(k), tail=b"\xfe\x12\x45\x99" * 9)), [series()])
    yield Input("padding element behind",
                folder(lambda k: file_of(slice_elements(k, _fffcfffc=("OB", b"\0" * 126)))), [series()])
    yield Input("gzip", {"IM%d.dcm.gz" % k: gzip.compress(file_of(slice_elements(k)))
                         for k in range(SLICES)}, [series()])
    yield Input("gzip under a plain name", folder(lambda k: gzip.compress(file_of(slice_elements(k)))),
                [series()])
    for cut in (1, 100, 400):
        files = good()
        files["IM001.dcm"] = files["IM001.dcm"][:-cut]
        yield Input("cut off by %d" % cut, files, refused="IM001.dcm' is cut off")
    files = good()
    files["IM001.dcm"] = files["IM001.dcm"][:500]
    yield Input("cut off in the head", files, refused="IM001.dcm' is cut off")


def texts():
    zeros = {name: ("DS", text + "\0" * (2 - len(text) % 2)) for name, text in
             [("_00280030", "0.75\\0.5"), ("_00281053", "1"), ("_00281052", "-1024")]}
    yield Input("numbers with zeros behind", folder(lambda k: file_of(slice_elements(k, **zeros))),
                [series()])
    blanks = {"_00280030": ("DS", "  0.75 \\ +0.5 "), "_00281053": ("DS", "1.0E0 ")}
    yield Input("numbers with blanks", folder(lambda k: file_of(slice_elements(k, **blanks))),
                [series()])
    for kind in ("UT", "LO", "SH", "UN", "ST"):
        odd = {"_00280030": (kind, "0.75\\0.5"), "_00281053": (kind, "1"),
               "_00200037": (kind, "1\\0\\0\\0\\1\\0")}
        yield Input("numbers as %s" % kind, folder(lambda k, odd=odd: file_of(slice_elements(k, **odd))),
                    [series()])
    binary = {"_00281053": ("FD", struct.pack("<d", 1)), "_00281052": ("FL", struct.pack("<f", -1024)),
              "_00280030": ("FD", struct.pack("<2d", 0.75, 0.5))}
    yield Input("numbers in binary", folder(lambda k: file_of(slice_elements(k, **binary))), [series()])
    sizes = {"_00280010": ("IS", str(ROWS)), "_00280011": ("UL", struct.pack("<I", COLUMNS))}
    yield Input("sizes of other types", folder(lambda k: file_of(slice_elements(k, **sizes))), [series()])
    for name, tag, text, words_ in [
            ("comma", "_00281053", "1,5", "the rescale slope '1,5', which is no number"),
            ("no number", "_00281053", "N/A", "the rescale slope 'N/A'"),
            ("two points", "_00281052", "1.0.2", "the rescale intercept '1.0.2'"),
            ("hexadecimal", "_00281053", "0x10", "the rescale slope '0x10'"),
            ("infinite", "_00281053", "inf", "the rescale slope 'inf'"),
            ("unit", "_00281052", "-1024 HU", "the rescale intercept '-1024 HU'"),
            ("one spacing", "_00280030", "0.75", "the pixel spacing '0.75', which is not 2 numbers"),
            ("spacing with a comma", "_00280030", "0,75\\0,5", "the pixel spacing '0,75"),
            ("five directions", "_00200037", "1\\0\\0\\0\\1", "the orientation '1"),
            ("place in words", "_00200032", "left\\0\\0", "the position 'left")]:
        files = good()
        files["IM001.dcm"] = file_of(slice_elements(1, **{tag: ("DS", text)}))
        yield Input("a number with " + name, files, refused=words_)
    yield Input("empty slope", folder(lambda k: file_of(slice_elements(k, _00281053=("DS", ""),
                                                                       _00281052=None))),
                [series(lambda x, y, z: measured(x, y, z, 1, 0))])
    yield Input("slope 0", folder(lambda k: file_of(slice_elements(k, _00281053=("DS", "0")))),
                refused="rescale slope of 0")
    for stored_bits, high in ((12, 3), (17, 16), (0, 0), (12, 16)):
        yield Input("bits %d %d" % (stored_bits, high),
                    folder(lambda k, b=stored_bits, h=high: file_of(
                        slice_elements(k, _00280101=("US", b), _00280102=("US", h)))),
                    refused="bits, the highest of which")


def table(first, values, bits=16):
    return [{0x00283002: ("US", [len(values) % 65536, first, bits]), 0x00283004: ("LO", "HU"),
             0x00283006: ("US", values)}]


def scales():
    values = [(i * 3 + 100) % 30000 for i in range(4000)]
    plain = {"_00281052": None, "_00281053": None}
    yield Input("table of values",
                folder(lambda k: file_of(slice_elements(k, _00283000=("SQ", table(0, values)), **plain))),
                [series(lambda x, y, z: values[stored(z)[y * COLUMNS + x]])])
    yield Input("table that begins later and ends early",
                folder(lambda k: file_of(slice_elements(
                    k, _00283000=("SQ", table(1000, values[:500])), **plain))),
                [series(lambda x, y, z: values[min(max(stored(z)[y * COLUMNS + x] - 1000, 0), 499)])])
    yield Input("table in an open sequence",
                folder(lambda k: file_of(slice_elements(
                    k, _00283000=Encoding().open_sequence(0x00283000, "SQ", table(0, values)), **plain))),
                [series(lambda x, y, z: values[stored(z)[y * COLUMNS + x]])])
    yield Input("table and slope", folder(lambda k: file_of(slice_elements(
        k, _00283000=("SQ", table(0, values))))), refused="both a rescale slope and a table")
    yield Input("damaged table", folder(lambda k: file_of(slice_elements(
        k, _00283000=("SQ", [{0x00283002: ("US", [4000, 0, 16]), 0x00283006: ("US", [1, 2])}]),
        **plain))), refused="damaged table of its values")
    for name, slopes, intercepts in [("PET", [1.5, 2.25, 0.5, 3.125], [0] * 4),
                                     ("tiny", [1e-6, 2e-6, 3e-6, 1e-6], [0] * 4),
                                     ("intercepts", [1, 1, 1, 1], [-1024, 0, -1000, 5000])]:
        def make(k, s=slopes, i=intercepts):
            return file_of(slice_elements(k, _00280060=None, _00080060=("CS", "PT"),
                                          _00281053=("DS", "%g" % s[k]), _00281052=("DS", "%g" % i[k]),
                                          _00281050=None, _00281051=None))

        def value(x, y, z, s=slopes, i=intercepts):
            return measured(x, y, z, s[z], i[z])
        yield Input("scale of each slice, " + name, folder(make),
                    [series(value, tolerance=max(slopes) * 0.51)])
    yield Input("small values", folder(lambda k: file_of(slice_elements(
        k, _00281053=("DS", "1e-06"), _00281052=("DS", "0"), _00281050=("DS", "0.0015"),
        _00281051=("DS", "0.003")))),
        [series(lambda x, y, z: measured(x, y, z, 1e-6, 0), window=(0.0015, 0.003), tolerance=1e-12)],
        silent=True)
    # Padding far below all values, in most of the picture.
    def padded(k):
        numbers = [63536 if i % 16 < 10 else v for i, v in enumerate(stored(k))]
        return file_of(slice_elements(k, _00280120=("SS", -2000), _00280103=("US", 1),
                                      _00281050=None, _00281051=None, _7fe00010=("OW", numbers)))

    def padded_value(x, y, z):
        return (-2000 if x < 10 else stored(z)[y * COLUMNS + x]) - 1024
    yield Input("padding", folder(padded), [series(padded_value, window=(650, 2540))])


def places():
    yield Input("names out of order", {"%d.dcm" % (7 - k): file_of(slice_elements(k))
                                       for k in range(SLICES)}, [series()])
    for digits in (1, 2, 3):
        def make(k, digits=digits):
            return file_of(slice_elements(k, _00200032=("DS", "-10\\-20\\%.*f" % (digits, 5 + 0.625 * k))))
        yield Input("places with %d digits" % digits, folder(make, 9),
                    [Series((COLUMNS, ROWS, 9), measured, steps=((0.5, 0, 0), (0, 0.75, 0), (0, 0, 0.625)))])
    for turn in (0.0001, 0.0004, 0.002):
        yield Input("directions that differ by %g" % turn, folder(lambda k, t=turn: file_of(
            slice_elements(k, _00200037=("DS", "1\\%g\\0\\%g\\1\\0" % (t * (k % 2), -t * (k % 2)))))), [series()])
    for missing in ([2], [1, 4]):
        files = good(7)
        for k in missing:
            del files["IM%03d.dcm" % k]
        yield Input("lacks %s" % missing, files, [series(count=7, missing=missing)],
                    remarks=["lacks %d of 7 slices" % len(missing)])
    for heights in ([0, 2, 4, 6, 12, 18, 24], [0, 6, 12, 14, 16, 18, 20], [0, 2, 4, 6, 8, 12, 16]):
        files = {"IM%d.dcm" % k: file_of(slice_elements(k, _00200032=("DS", "-10\\-20\\%d" % z)))
                 for k, z in enumerate(heights)}
        yield Input("two distances %s" % heights, files, refused="lie unevenly")
    files = good()
    files["IM009.dcm"] = file_of(slice_elements(9, _00200037=("DS", "0\\1\\0\\0\\0\\-1")))
    yield Input("a scout", files, [series()], remarks=["a scout?"])
    files = good()
    files["IM009.dcm"] = file_of(slice_elements(9, _00200032=None, _00200037=None))
    yield Input("a scout without a place", files, [series()], remarks=["a scout?"])
    files = good()
    for k in range(SLICES):
        files["S%03d.dcm" % k] = file_of(slice_elements(
            k, _00200037=("DS", "0\\1\\0\\0\\0\\-1"), _00200032=("DS", "%d\\-20\\50" % (2 * k))))
    yield Input("two planes in a series", files)
    for name, tag in (("once", 1), ("first", 0)):
        files = good()
        files["IM%03d.dcm" % tag] = file_of(slice_elements(tag, _00200052=None))
        yield Input("frame of reference missing " + name, files, [series()], silent=True)
    files = good()
    files.update({"copy/" + name: data for name, data in good().items()})
    yield Input("all twice", files, [series()], remarks=["in the series twice"])
    # A phase has other values.
    for name, keys in [("acquisition", lambda p, k: {"_00200012": ("IS", str(p + 1))}),
                       ("temporal position", lambda p, k: {"_00200100": ("IS", str(p + 1))}),
                       ("echo", lambda p, k: {"_00180086": ("IS", str(p + 1))}),
                       ("kernel", lambda p, k: {"_00181210": ("SH", "B%d0f" % (p + 3))}),
                       ("numbers", lambda p, k: {"_00200013": ("IS", str(1 + k + 100 * p))}),
                       ("numbers by place", lambda p, k: {"_00200013": ("IS", str(1 + 2 * k + p))})]:
        files = {}
        for p in (0, 1):
            for k in range(SLICES):
                files["P%d-%d.dcm" % (p, k)] = file_of(slice_elements(
                    k, **keys(p, k), _7fe00010=("OW", [v + 50 * p for v in stored(k)])))
        yield Input("phases by " + name, files,
                    [series(), series(lambda x, y, z: measured(x, y, z) + 50)],
                    remarks=["2 images at each place"])
    files = {}
    for p in (0, 1):
        for k in range(SLICES):
            files["P%d-%d.dcm" % (p, k)] = file_of(slice_elements(
                k, _00200013=None, _7fe00010=("OW", [v + 50 * p for v in stored(k)])))
    yield Input("phases that nothing tells apart", files, refused="lie at the same place")


def enhanced(frames, shared=None, each=None, **changed):
    """All slices in one file."""
    of_all = {0x00209116: ("SQ", [{0x00200037: ("DS", "1\\0\\0\\0\\1\\0")}]),
              0x00289110: ("SQ", [{0x00280030: ("DS", "0.75\\0.5")}])}
    of_all.update(shared or {})
    of_each = []
    for k in range(frames):
        one = {0x00209113: ("SQ", [{0x00200032: ("DS", "-10\\-20\\%d" % (5 + 2 * k))}])}
        one.update(each(k) if each else {})
        of_each.append(one)
    pixels = [v for k in range(frames) for v in stored(k)]
    elements = slice_elements(0, _00200032=None, _00200037=None, _00280030=None,
                              _00280008=("IS", str(frames)), _52009229=("SQ", [of_all]),
                              _52009230=("SQ", of_each), _7fe00010=("OW", pixels))
    for name, value in changed.items():
        elements.pop(int(name[1:], 16), None)
        if value is not None:
            elements[int(name[1:], 16)] = value
    return elements


def many_frames():
    for way, syntax in (("explicit", d.EXPLICIT), ("implicit", d.IMPLICIT), ("big-endian", d.BIG_ENDIAN)):
        yield Input("enhanced, " + way, {"all.dcm": file_of(enhanced(SLICES), syntax)}, [series()])
    scale = {0x00289145: ("SQ", [{0x00281052: ("DS", "-1000"), 0x00281053: ("DS", "2")}])}
    yield Input("enhanced with a scale", {"all.dcm": file_of(enhanced(SLICES, scale))},
                [series(lambda x, y, z: measured(x, y, z, 2, -1000))])

    def of_each(k):
        return {0x00289145: ("SQ", [{0x00281052: ("DS", "0"), 0x00281053: ("DS", str(k + 1))}])}
    yield Input("enhanced with a scale of each", {"all.dcm": file_of(enhanced(SLICES, each=of_each))},
                [series(lambda x, y, z: measured(x, y, z, z + 1, 0), tolerance=2.01)])
    yield Input("enhanced, RLE", {"all.dcm": file_of(
        enhanced(SLICES, _7fe00010=d.fragments([d.rle(stored(k)) for k in range(SLICES)])), d.RLE)},
        [series()])
    short = enhanced(SLICES)
    short[0x7fe00010] = ("OW", short[0x7fe00010][1][:-50])
    yield Input("enhanced, cut off", {"all.dcm": file_of(short)}, refused="is cut off")
    files = good()
    cine = slice_elements(0, _00280008=("IS", "4"), _0020000e=("UI", "1.2.3.9"))
    cine[0x7fe00010] = ("OW", [v for k in range(4) for v in stored(k)])
    files["cine.dcm"] = file_of(cine)
    yield Input("a film beside", files, [series()], remarks=["cine.dcm' is left out: it holds several"])


def packed():
    yield Input("RLE", folder(lambda k: file_of(slice_elements(
        k, _7fe00010=d.fragments([d.rle(stored(k))])), d.RLE)), [series()])
    yield Input("RLE without its end", folder(lambda k: file_of(slice_elements(
        k, _7fe00010=d.fragments([d.rle(stored(k))], end=False)), d.RLE)), [series()])
    yield Input("RLE, zeros behind", folder(lambda k: file_of(slice_elements(
        k, _7fe00010=d.fragments([d.rle(stored(k))])), d.RLE, tail=b"\0" * 64)), [series()])
    yield Input("RLE under the name of plain pixels", folder(lambda k: file_of(slice_elements(
        k, _7fe00010=d.fragments([d.rle(stored(k))])), d.EXPLICIT)), [series()])
    yield Input("plain pixels under the name of RLE", folder(lambda k: file_of(
        slice_elements(k), d.RLE)), [series()])
    shifted = [v << 4 for v in stored(0)]
    yield Input("RLE, 12 bits above", {"a.dcm": file_of(slice_elements(
        0, _00280101=("US", 12), _7fe00010=d.fragments([d.rle(shifted)])), d.RLE)}, [series(count=1, steps=(
            (0.5, 0, 0), (0, 0.75, 0), (0, 0, 1)))])


def beside():
    """Whole files that are not for us, beside a good series."""
    other = {"_0020000e": ("UI", "1.2.3.9")}
    cases = {
        "float map": (slice_elements(1, _7fe00010=None, _00280100=("US", 32), _7fe00008=(
            "OF", struct.pack("<192f", *([0.5] * 192))), **other), "pixels of neither 8 nor 16 bits (it may be a map, a mask or a dose)"),
        "double map": (slice_elements(1, _7fe00010=None, _00280100=("US", 64), _7fe00009=(
            "OD", struct.pack("<192d", *([0.5] * 192))), **other), "pixels of neither 8 nor 16 bits (it may be a map, a mask or a dose)"),
        "mask of bits": (slice_elements(1, _00280100=("US", 1), _00280101=("US", 1), _00280102=("US", 0),
                                        _7fe00010=("OB", b"\x55" * 24), **other),
                         "pixels of neither 8 nor 16 bits (it may be a map, a mask or a dose)"),
        "dose of 32 bits": (slice_elements(1, _00280100=("US", 32), _00280101=("US", 32),
                                           _00280102=("US", 31), _7fe00010=("OW", b"\1\0\0\0" * 192),
                                           **other), "pixels of neither 8 nor 16 bits (it may be a map, a mask or a dose)"),
        "report": ({0x00080016: ("UI", "1.2.840.10008.5.1.4.1.1.88.11"), 0x00080060: ("CS", "SR"),
                    0x00100020: ("LO", "GEN-1"), 0x0020000e: ("UI", "1.2.9")}, "holds no image"),
        "sheet": ({0x00080016: ("UI", "1.2.840.10008.5.1.4.1.1.104.1"), 0x00080060: ("CS", "DOC"),
                   0x00100020: ("LO", "GEN-1"), 0x00420011: ("OB", b"%PDF-1.4 ")}, "holds no image"),
        "colour": (slice_elements(1, _00280002=("US", 3), _00280004=("CS", "RGB"), _00280100=("US", 8),
                                  _00280101=("US", 8), _00280102=("US", 7),
                                  _7fe00010=("OB", b"\x10" * 576), **other), "a picture in colour"),
        "palette": (slice_elements(1, _00280004=("CS", "PALETTE COLOR"), **other), "a picture in colour"),
    }
    for name, (elements, words_) in cases.items():
        files = good()
        files["other.dcm"] = file_of(elements)
        yield Input(name + " beside", files, [series()], remarks=[words_, "other.dcm' is left out"])
        yield Input(name + " alone", {"other.dcm": file_of(elements)}, refused=words_)
    for name, data, words_ in [("empty", b"", "is empty; copy it again"), ("short", b"x" * 100, "too short"),
                               ("words", b"hello world " * 50, "no DICOM file"),
                               ("a picture", b"\x89PNG\r\n\x1a\n" + b"\0" * 200, "no DICOM file")]:
        files = good()
        files["Thumbs.dcm"] = data
        yield Input(name + " as .dcm", files, [series()], remarks=["Thumbs.dcm' is left out", words_])
    files = good()
    files["index"] = b"\x08\0\5\0\x0a\0\0\0" + b"some index" * 30
    yield Input("bytes that begin as DICOM does", files, [series()], remarks=["index' is left out", "no DICOM file"])
    files = good()
    files.update({"AUTORUN.INF": b"[autorun]\n", "viewer/README.TXT": b"hello"})
    yield Input("a disc's other files", files, [series()], remarks=["2 files were not read"])


def inputs():
    for group in (ways_of_writing, bytes_around, texts, scales, places, many_frames, packed, beside):
        for one in group():
            one.name = "dicom " + one.name
            yield one
