# SPDX-License-Identifier: Apache-2.0
"""Whole folders as people have them: the result of a segmentation, a scene of 3D Slicer, a disc, an export of an archive. Each is
imported in one command."""

import gzip
import random

import dicom_inputs
from dicom_bytes import COLUMNS, ROWS, file_of, slice_elements
from expected import Input
from label_inputs import labels, nifti, nrrd, part
from mesh_inputs import box, stl_binary

DIRECTORY = "1.2.840.10008.1.3.10"
REPORT, PDF, PRESENTATION, CAPTURE = ("1.2.840.10008.5.1.4.1.1." + of for of in ("88.33", "104.1", "11.1", "7"))


def image():
    """Values as of CT, which differ from sample to sample."""
    noise = random.Random(7)
    return [noise.randrange(-1000, 1500) for _ in labels()]


def without_pixels(kind, modality, **more):
    pixels = {"_%08x" % tag: None for tag in slice_elements(0) if tag >> 16 in (0x0028, 0x7fe0)}
    return file_of(slice_elements(70, _00080016=("UI", kind), _00080060=("CS", modality),
                                  _0020000e=("UI", "1.2.3.9." + kind[-3:]), _00200032=None, _00200037=None,
                                  **(pixels | more)))


def capture():
    """A picture of a screen, in colour."""
    return file_of(slice_elements(80, _00080016=("UI", CAPTURE), _00080060=("CS", "OT"), _0020000e=("UI", "1.2.3.8"),
                                  _00200032=None, _00200037=None, _00280002=("US", 3), _00280004=("CS", "RGB"),
                                  _00280100=("US", 8), _00280101=("US", 8), _00280102=("US", 7),
                                  _00280006=("US", 0), _7fe00010=("OB", bytes(3 * COLUMNS * ROWS))))


def total_segmentator():
    names = ("liver", "kidney_left")
    files = {"ct.nii.gz": gzip.compress(nifti(image(), "int16"))}
    for number, name in enumerate(names, 1):
        files["segmentations/%s.nii.gz" % name] = gzip.compress(nifti(labels([int(n == number) for n in range(3)])))
    files["segmentations/spleen.nii.gz"] = gzip.compress(nifti(labels((0, 0, 0))))
    files["statistics.json"] = b'{"liver": {"volume": 1}}'
    yield Input("result of TotalSegmentator", files, parts=[part(2, "kidney left"), part(1, "liver")],
                remarks=["ct.nii.gz' is left out: it holds values that are no labels", "statistics.json", "spleen"])


def slicer_scene():
    keys = "".join("Segment%d_%s:=%s\n" % (k, key, value) for k, name in enumerate(("liver", "tumour"))
                   for key, value in (("LabelValue", k + 1), ("Layer", 0), ("Name", name), ("ID", "Segment_%d" % k)))
    scene = b'<MRML version="Slicer5.6" userTags=""><Volume name="CT"/></MRML>'
    files = {"2024-05-01-Scene.mrml": scene, "CT.nrrd": nrrd(image()), "Segmentation.seg.nrrd": nrrd(keys=keys),
             "vessels.stl": stl_binary(), "Model.vtk": b"# vtk DataFile Version 5.1\nmodel\nASCII\nDATASET POLYDATA\n",
             "Camera.mrk.json": b'{"markups": []}', "2024-05-01-Scene.mrb": b"PK\3\4" + bytes(60)}
    yield Input("scene of 3D Slicer", dict(files), parts=[box("vessels")],
                remarks=["2 files are not used: ", "Segmentation.seg.nrrd'; with --from-labels parts are made of their labels",
                         "Model.vtk' is left out: it may hold a surface", "Scene.mrb' is left out: it is an archive"])
    del files["vessels.stl"]
    yield Input("scene of 3D Slicer without a surface", files, parts=[part(1, "liver"), part(2, "tumour")],
                remarks=["CT.nrrd' is left out: it holds values that are no labels", "Model.vtk"])


def disc():
    files = {"DICOM/PAT0/STU0/SER0/IM%d" % k: file_of(slice_elements(k)) for k in range(dicom_inputs.SLICES)}
    files["DICOM/PAT0/STU0/SER1/PS0"] = without_pixels(PRESENTATION, "PR")
    files["DICOMDIR"] = without_pixels(DIRECTORY, "CT")
    files |= {"AUTORUN.INF": b"[autorun]\r\nopen=VIEWER.EXE\r\n", "VIEWER/VIEWER.EXE": b"MZ" + bytes(200),
              "VIEWER/help.html": b"<html></html>", "README.TXT": b"Insert the disc.\r\n", "DICOM/empty.dcm": b""}
    yield Input("disc with a directory", files, [dicom_inputs.series()],
                remarks=["holds no image", "4 files were not read", "DICOMDIR"])


def archive():
    files = {"CT/" + name: data for name, data in dicom_inputs.good().items()}
    for k, turned in enumerate(("0\\1\\0\\0\\0\\-1", "1\\0\\0\\0\\0\\-1")):
        files["CT/scout%d.dcm" % k] = file_of(slice_elements(60 + k, _00200037=("DS", turned),
                                                             _00080008=("CS", "ORIGINAL\\PRIMARY\\LOCALIZER")))
    files["SR/dose.dcm"] = without_pixels(REPORT, "SR")
    files["DOC/letter.dcm"] = without_pixels(PDF, "DOC", _00420011=("OB", b"%PDF-1.4 "))
    files["SC/screen.dcm"] = capture()
    yield Input("export of an archive", files, [dicom_inputs.series()],
                remarks=["a scout?", "holds no image", "picture in colour"])


def finder_file():
    """AppleDouble: macOS writes one beside each file on a disc of another system, under its name with "._" before it."""
    return b"\0\5\x16\7\0\2\0\0Mac OS X        " + bytes(120)


def stick():
    """A folder of Windows, packed by macOS."""
    files = {"Fall Müller 1/CT Bilder/Img%02d.DCM" % k: file_of(slice_elements(k)) for k in range(dicom_inputs.SLICES)}
    files |= {"Fall Müller 1/Modelle für OP/Leber.STL": stl_binary(), "Fall Müller 1/desktop.ini": b"[.ShellClassInfo]\r\n",
              "Fall Müller 1/CT Bilder/Thumbs.db": b"\xd0\xcf\x11\xe0" + bytes(600), ".DS_Store": b"\0\0\0\1Bud1" + bytes(100),
              "Fall Müller 1.zip": b"PK\3\4" + bytes(300), "Befund.pdf": b"%PDF-1.7\n" + bytes(200)}
    for name in ("Leber.STL", "Img00.DCM", "scan.nii.gz", "scan.nii", "vein.ply", "photo.jpg", "mask.nrrd"):
        files["__MACOSX/Fall Müller 1/._" + name] = finder_file()
    yield Input("stick of Windows and macOS", dict(files), [dicom_inputs.series()], [box("Leber")], pictures=0,
                remarks=["10 files were not read, being of no kind that is imported", "1.zip' is left out: it is an archive",
                         "Befund.pdf' is left out: it may hold pictures"])
    del files["Fall Müller 1/Modelle für OP/Leber.STL"]
    files["Fall Müller 1/maske.nii.gz"] = gzip.compress(nifti())
    yield Input("stick with a label map", files, [dicom_inputs.series()], [part(1, "label 1"), part(2, "label 2")],
                remarks=["10 files were not read"])


def two_of_one_name():
    files = {"export/ser%d/%08d" % (n, k): file_of(slice_elements(
        k, _0020000e=("UI", "1.2.3.4.%d" % n), _0008103e=("LO", "ABDOMEN 2.0 B30f"), _00080018=("UI", "1.7.%d.%d" % (n, k))))
        for n in (1, 2) for k in range(dicom_inputs.SLICES)}
    yield Input("two series of one description", files, [dicom_inputs.series()] * 2)


def empty_segments():
    names = ("aorta", "colon", "heart", "kidney_left", "kidney_right", "lung", "spleen")
    files = {"segmentations/%s.nii.gz" % name: gzip.compress(nifti(labels((0, 0, 0)))) for name in names}
    words = "7 files are left out, since each of them marks nothing: there are no labels but 0"
    yield Input("segments of which none is there", dict(files), refused=words)
    files["segmentations/liver.nii.gz"] = gzip.compress(nifti(labels((0, 1, 0))))
    yield Input("segments of which one is there", files, parts=[part(1, "liver")], remarks=[words])


def one_file():
    yield Input("folder of a single file", {"Patient 7/Scan (2)/o.nii.gz": gzip.compress(nifti())},
                parts=[part(1, "label 1"), part(2, "label 2")], silent=True)


def inputs():
    for make in (total_segmentator, slicer_scene, disc, archive, stick, two_of_one_name, empty_segments, one_file):
        yield from make()
