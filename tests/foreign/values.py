# SPDX-License-Identifier: Apache-2.0
"""What is in files: values of images, places and volumes of organs, colours of pictures; as Theatron has them after an import or
a recording, and as the readers that Debian has give them. Each measure is a list of numbers; two of one kind are compared by
`agree`."""

import json
import math
import pathlib
import subprocess
import tempfile

from expected import read_mesh, read_volume, volume_of

LONGEST = 60  # seconds for a program
HERE = pathlib.Path(__file__).resolve().parent
ITK_FOLDER = HERE.parents[1] / "build/itk_reader"
ITK = str(ITK_FOLDER / "itk_reader")


def agree(a, b, relative=0.02, absolute=1.0):
    return len(a) == len(b) and all(math.isclose(x, y, rel_tol=relative, abs_tol=absolute) for x, y in zip(a, b))


def spread(values):
    """Number of values, the smallest, the largest, the mean."""
    return [len(values), min(values), max(values), sum(values) / len(values)]


# ---- ITK

def build_itk_reader():
    """Where ITK is installed; it is left out elsewhere."""
    if any(pathlib.Path("/usr/lib/cmake").glob("ITK-*")):
        subprocess.run(["cmake", "-S", HERE / "itk_reader", "-B", ITK_FOLDER, "-DCMAKE_BUILD_TYPE=Release"], check=True,
                       capture_output=True)
        subprocess.run(["cmake", "--build", ITK_FOLDER], check=True, capture_output=True)


def by_itk(path):
    """The numbers that itk_reader prints; None where ITK does not read the file."""
    endings = {".nii": "nifti", ".gz": "nifti", ".bz2": "nifti", ".nrrd": "nrrd", ".nhdr": "nrrd"}
    kind = "dicom" if path.name.lower().endswith((".dcm.gz", ".ima.gz")) else endings.get(path.suffix.lower(), "dicom")
    done = subprocess.run([ITK, kind, str(path)], capture_output=True, text=True, timeout=LONGEST)
    return json.loads(done.stdout) if done.returncode == 0 else None


def dicom_by_itk(paths):
    found = [one for one in map(by_itk, paths) if one]
    if not found:
        return None
    count = sum(one[0] for one in found)
    return [count, min(one[1] for one in found), max(one[2] for one in found), sum(one[0] * one[3] for one in found) / count]


def labels_by_itk(paths):
    found = [by_itk(path) for path in paths]
    return [sum(one[4] * one[5] for one in found)] if all(found) else None


# ---- a case

def series_of_case(case):
    values = []
    for said in json.loads((case / "case.json").read_text())["series"]:
        size, n, samples = read_volume(case / said["file"])
        plane = size[0] * size[1]
        for z in range(size[2]):
            if z not in said.get("missing_slices", ()):
                values += [n[12] * v + n[13] for v in samples[z * plane:(z + 1) * plane]]
    return spread(values) if values else None


def surfaces_of_case(case):
    """The box around all parts, and their volume."""
    points, volume = [], 0
    for said in json.loads((case / "case.json").read_text())["parts"]:
        part, triangles = read_mesh(case / said["file"])
        points += part
        volume += abs(volume_of(part, triangles))
    return bounds(points) + [volume] if points else None


def bounds(points):
    return [f(p[i] for p in points) for f in (min, max) for i in range(3)]


# ---- DICOM

def dicom_by_gdcm(paths):
    import gdcm
    import numpy
    kinds = {gdcm.PixelFormat.UINT8: "u1", gdcm.PixelFormat.INT8: "i1", gdcm.PixelFormat.UINT12: "u2", gdcm.PixelFormat.INT12: "i2",
             gdcm.PixelFormat.UINT16: "<u2", gdcm.PixelFormat.INT16: "<i2"}
    values = []
    for path in paths:
        reader = gdcm.ImageReader()
        reader.SetFileName(str(path))
        if not reader.Read():
            continue
        image = reader.GetImage()
        raw = image.GetBuffer().encode("utf-8", "surrogateescape")
        samples = numpy.frombuffer(raw, kinds[image.GetPixelFormat().GetScalarType()])
        values += (samples * image.GetSlope() + image.GetIntercept()).tolist()
    return spread(values) if values else None


def dicom_by_dcm2niix(paths):
    import nibabel
    with tempfile.TemporaryDirectory() as out:
        subprocess.run(["dcm2niix", "-z", "n", "-o", out, str(paths[0].parent)], capture_output=True, timeout=LONGEST)
        values = []
        for file in sorted(pathlib.Path(out).glob("*.nii")):
            values += nibabel.load(file).get_fdata().ravel().tolist()
    return spread(values) if values else None


# ---- label maps and surfaces

def labels_by_nibabel(paths):
    import nibabel
    import numpy
    points, volume = [], 0
    for path in paths:
        image = nibabel.load(path)
        where = numpy.argwhere(numpy.nan_to_num(image.get_fdata()) > 0.5)
        if len(where) == 0:
            continue
        unit = {"meter": 1000, "micron": 1e-3}.get(image.header.get_xyzt_units()[0], 1)
        place = image.affine * numpy.array([[unit]] * 3 + [[1]])
        corners = [place @ [*(end[:3] - 0.5), 1] for end in (where.min(0), where.max(0) + 1)]
        points += [(-c[0], -c[1], c[2]) for c in corners]
        volume += len(where) * abs(numpy.linalg.det(place[:3, :3]))
    return bounds(points) + [volume] if points else None


def labels_by_vtk(paths):
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkIOImage import vtkNrrdReader
    volume = 0
    for path in paths:
        reader = vtkNrrdReader()
        reader.SetFileName(str(path))
        reader.Update()
        data = reader.GetOutput()
        sides = data.GetSpacing()
        scalars = data.GetPointData().GetScalars()
        if reader.GetErrorCode() or scalars is None:
            return None
        volume += int((vtk_to_numpy(scalars) > 0).sum()) * sides[0] * sides[1] * sides[2]
    return [volume]


def surface_by_vtk(paths):
    from vtkmodules.vtkFiltersCore import vtkMassProperties, vtkTriangleFilter
    from vtkmodules.vtkIOGeometry import vtkOBJReader, vtkSTLReader
    from vtkmodules.vtkIOPLY import vtkPLYReader
    boxes, volume = [], 0
    for path in paths:
        reader = {".stl": vtkSTLReader, ".ply": vtkPLYReader, ".obj": vtkOBJReader}[path.suffix.lower()]()
        reader.SetFileName(str(path))
        triangles = vtkTriangleFilter()
        triangles.SetInputConnection(reader.GetOutputPort())
        triangles.Update()
        if triangles.GetOutput().GetNumberOfCells() == 0:
            continue
        b = triangles.GetOutput().GetBounds()
        boxes += [(b[0], b[2], b[4]), (b[1], b[3], b[5])]
        mass = vtkMassProperties()
        mass.SetInputConnection(triangles.GetOutputPort())
        volume += mass.GetVolume()
    return bounds(boxes) + [volume] if boxes else None


def surface_by_assimp(paths):
    with tempfile.TemporaryDirectory() as out:
        file = pathlib.Path(out) / "x.obj"
        subprocess.run(["assimp", "export", str(paths[0]), str(file), "-ptv"], capture_output=True, timeout=LONGEST)
        if not file.exists():
            return None
        lines = [line.split() for line in file.read_text().splitlines()]
    points = [tuple(float(v) for v in line[1:4]) for line in lines if line[:1] == ["v"]]
    if paths[0].suffix.lower() in (".glb", ".gltf"):
        points = [(1000 * x, -1000 * z, 1000 * y) for x, y, z in points]
    faces = [[int(v.split("/")[0]) - 1 for v in line[1:]] for line in lines if line[:1] == ["f"]]
    triangles = [(f[0], f[i], f[i + 1]) for f in faces for i in range(1, len(f) - 1)]
    return bounds(points) + [abs(volume_of(points, triangles))] if points else None


# ---- pictures in time

def tiles(raw, width, height):
    """The mean colours of the four quarters of a picture."""
    import numpy
    picture = numpy.frombuffer(raw, "u1")[:3 * width * height].reshape(height, width, 3).astype(float)
    halves = (slice(0, height // 2), slice(height // 2, height)), (slice(0, width // 2), slice(width // 2, width))
    return [c for rows in halves[0] for columns in halves[1] for c in picture[rows, columns].mean((0, 1)).tolist()]


def tiles_of_file(command, more=()):
    """Of the first picture and the last one that FFmpeg makes of these arguments, behind their number and sides."""
    done = subprocess.run(["ffmpeg", "-v", "error", *command, *more, "-f", "image2pipe", "-c:v", "ppm", "-"],
                          capture_output=True, timeout=LONGEST)
    found, at, data = [], 0, done.stdout
    while data[at:at + 2] == b"P6":
        words, end = [], at + 2
        while len(words) < 3:
            while data[end:end + 1].isspace():
                end += 1
            begin = end
            while not data[end:end + 1].isspace():
                end += 1
            words.append(int(data[begin:end]))
        found.append((end + 1, words[0], words[1]))
        at = end + 1 + 3 * words[0] * words[1]
    if not found:
        return None
    out = [len(found), found[0][1], found[0][2]]
    for begin, width, height in (found[0], found[-1]):
        out += tiles(data[begin:begin + 3 * width * height], width, height)
    return out


def played_by_ffmpeg(path, track="0:V:0", more=()):
    """A video, a track of it, or pictures whose name is a pattern, as a player shows them."""
    return tiles_of_file(["-i", str(path), "-map", track, "-vsync", "passthrough"], ["-pix_fmt", "rgb24", *more])


def depths_by_ffmpeg(path, track="0:V:0"):
    """The sum of all values of the depth pictures in a track, or in files whose name is a pattern."""
    import numpy
    done = subprocess.run(["ffmpeg", "-v", "error", "-i", str(path), "-map", track, "-vsync", "passthrough", "-pix_fmt", "gray16le",
                           "-f", "rawvideo", "-"], capture_output=True, timeout=LONGEST)
    return int(numpy.frombuffer(done.stdout, "<u2").sum(dtype="u8"))


def played_by_theatron(camera, program):
    """(colour, sum of depth, exit code, what was said); the first two are None where nothing was played."""
    with tempfile.TemporaryDirectory() as out:
        file = pathlib.Path(out) / "r.mkv"
        done = subprocess.run([program, "record", "--camera", camera, "--raw", str(file)], capture_output=True, text=True,
                              timeout=LONGEST)
        said = (done.stdout + done.stderr).strip()
        subprocess.run([program, "export", str(file), "--png", out + "/p"], capture_output=True, timeout=LONGEST)
        pictures = sorted(pathlib.Path(out).rglob("p/color/*"))
        color = depth = None
        if pictures:
            first, last = (played_by_ffmpeg(one) for one in (pictures[0], pictures[-1]))
            color = [len(pictures)] + first[1:15] + last[3:15]
        if sorted(pathlib.Path(out).rglob("p/depth/*")):
            depth = depths_by_ffmpeg(out + "/p/depth/%05d.png")
        return color, depth, done.returncode, said
