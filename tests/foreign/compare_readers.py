#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What `theatron case import` and the readers that Debian has make of the inputs of this folder. Run by hand:

    apt install python3-gdcm python3-nibabel python3-meshio python3-vtk9 dcm2niix dcmtk assimp-utils libinsighttoolkit5-dev
    THEATRON=build/release/apps/theatron/theatron /usr/bin/python3 tests/foreign/compare_readers.py

Another reader counts as reading an input if it gives pixels, samples or triangles of all files of its kind, whatever
their values are; the right values are known for Theatron alone. Readers that are not installed are left out, and named.
ITK has no package for Python: itk_reader is built for it at the first use, in build/itk_reader.
Videos, recordings and folders of pictures (video_inputs.py) are recorded, and compared with what FFmpeg shows.

With --values FOLDER, each folder in that one is an input of which nothing is known: the table has values, boxes and volumes
(values.py) as Theatron has them and as the other readers do.
"""

import argparse
import collections
import importlib.util
import json
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import foreign_test  # noqa: E402
import values  # noqa: E402
import video_inputs  # noqa: E402
from expected import problem  # noqa: E402

LONGEST = 10  # seconds for a reader and an input
KINDS = (("DICOM", ("dicom",)), ("NIfTI", ("nifti",)), ("NRRD", ("nrrd",)), ("STL", ("stl",)), ("PLY", ("ply",)),
         ("glTF", ("glb", "gltf")), ("OBJ", ("obj",)))
PLAYED = (("videos", video_inputs.videos, "video:%s"), ("recordings", video_inputs.recordings, "mkv:%s"),
          ("camera folders", video_inputs.folders, "folder:%s,fps=60"))


def gdcm_reads(path):
    import gdcm
    reader = gdcm.ImageReader()
    reader.SetFileName(str(path))
    return reader.Read() and len(reader.GetImage().GetBuffer()) > 0


def nibabel_reads(path):
    import nibabel
    image = nibabel.load(path)
    return image.get_fdata().size > 0


def meshio_reads(path):
    import meshio
    return any(len(block.data) for block in meshio.read(path).cells if block.type in ("triangle", "quad", "polygon"))


def vtk_reads(path):
    # The package "vtk" as a whole puts a reader for MPI in place of that for NRRD, which reads nothing without MPI.
    from vtkmodules.vtkIOGeometry import vtkOBJReader, vtkSTLReader
    from vtkmodules.vtkIOImage import vtkNIFTIImageReader, vtkNrrdReader
    from vtkmodules.vtkIOPLY import vtkPLYReader
    makers = {".stl": vtkSTLReader, ".ply": vtkPLYReader, ".obj": vtkOBJReader, ".nrrd": vtkNrrdReader,
              ".nhdr": vtkNrrdReader, ".nii": vtkNIFTIImageReader, ".gz": vtkNIFTIImageReader}
    reader = makers[path.suffix.lower()]()
    reader.SetFileName(str(path))
    reader.Update()
    data = reader.GetOutput()
    return reader.GetErrorCode() == 0 and data.GetNumberOfCells() > 0


def run(*command):
    return subprocess.run(command, capture_output=True, timeout=LONGEST).returncode == 0


def dcm2niix_reads(path):
    with tempfile.TemporaryDirectory() as out:
        done = run("dcm2niix", "-s", "y", "-o", out, str(path))
        return done and any(file.suffix == ".nii" for file in pathlib.Path(out).iterdir())


def dcmtk_reads(path):
    with tempfile.TemporaryDirectory() as out:
        return run("dcm2pnm", str(path), out + "/x.pgm")


def assimp_reads(path):
    done = subprocess.run(["assimp", "info", str(path)], capture_output=True, text=True, timeout=LONGEST)
    faces = [line.split()[-1] for line in done.stdout.splitlines() if line.startswith("Faces:")]
    return done.returncode == 0 and faces and faces[0] != "0"


def itk_reads(path):
    return values.by_itk(path) is not None


READERS = (("gdcm", gdcm_reads, "gdcm", ("DICOM",)), ("dcmtk", dcmtk_reads, "dcm2pnm", ("DICOM",)),
           ("dcm2niix", dcm2niix_reads, "dcm2niix", ("DICOM",)), ("itk", itk_reads, values.ITK, ("DICOM", "NIfTI", "NRRD")),
           ("nibabel", nibabel_reads, "nibabel", ("NIfTI",)), ("vtk", vtk_reads, "vtkmodules", ("NIfTI", "NRRD", "STL", "PLY", "OBJ")),
           ("meshio", meshio_reads, "meshio", ("STL", "PLY", "OBJ")), ("assimp", assimp_reads, "assimp", ("STL", "PLY", "glTF", "OBJ")))


def is_module(name):
    return "/" not in name and importlib.util.find_spec(name)


def is_there(what):
    return shutil.which(what) or is_module(what)


def in_process(read, path):
    """Readers may end their process, read without end, or print what they like."""
    child = os.fork()
    if child == 0:
        signal.alarm(LONGEST)
        null = os.open(os.devnull, os.O_WRONLY)
        os.dup2(null, 1)
        os.dup2(null, 2)
        try:
            os._exit(0 if read(path) else 1)
        except BaseException:  # whatever a library throws means that it does not read the file
            os._exit(1)
    return os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) == 0


def kind_of(name):
    first = name.replace(":", " ").split()[0].split("-")[0].lower()
    return next((kind for kind, names in KINDS if first in names), None)


def files_of(kind, folder):
    endings = {"NIfTI": (".nii", ".gz", ".bz2"), "NRRD": (".nrrd", ".nhdr"), "STL": (".stl",), "PLY": (".ply",),
               "glTF": (".glb", ".gltf"), "OBJ": (".obj",)}.get(kind)
    for path in sorted(folder.rglob("*")):
        if path.is_file() and (endings is None or path.suffix.lower() in endings):
            yield path


def outcome(one, folder, program):
    done = subprocess.run([program, "case", "import", folder / "source", folder / "case"], capture_output=True, text=True,
                          timeout=120)
    text = (done.stdout + done.stderr).replace(str(folder), "")
    if found := problem(one, done.returncode, text, folder / "case"):
        return "wrong", found
    return ("right", "") if done.returncode == 0 else ("refused", text.strip())


def played_problem(kind, path, shown, color, depth, code):
    """What differs from what FFmpeg shows; None if nothing does."""
    if kind == "camera folders":
        names = sorted((path / "color").iterdir())
        wanted = values.played_by_ffmpeg(path / "color" / ("%05d" + names[0].suffix))
        wanted_depth = values.depths_by_ffmpeg(path / "depth/%05d.png")
    elif kind == "recordings":
        # Colour whose depth is cut off is not given, which the exit code 3 says.
        pairs = values.played_by_ffmpeg(path, "0:v:0")[0]
        all_colors = values.played_by_ffmpeg(path, "0:v:1")
        wanted = all_colors and values.played_by_ffmpeg(path, "0:v:1", ["-frames:v", str(pairs)])
        wanted_depth = values.depths_by_ffmpeg(path, "0:v:0")
        if wanted and wanted[0] < all_colors[0] and code != 3:
            return "does not say that it lacks colour"
    else:
        wanted, wanted_depth = values.played_by_ffmpeg(path, more=shown), depth
    if depth != wanted_depth:
        return "depth adds up to %s, not %s" % (depth, wanted_depth)
    if (color is None) != (wanted is None) or (wanted and not (color[0] == wanted[0] and values.agree(color, wanted, 0, 2.5))):
        return "colour is %s, not %s" % (color and [round(v) for v in color], wanted and [round(v) for v in wanted])
    return None


def compare_played(program, counts, options):
    for kind, make, camera in PLAYED:
        if options.kind not in (None, kind):
            continue
        with tempfile.TemporaryDirectory() as folder:
            for name, path, *shown in make(pathlib.Path(folder)):
                color, depth, code, said = values.played_by_theatron(camera % path, program)
                found = None if depth is None else played_problem(kind, path, shown[0] if shown else (), color, depth, code)
                # Also where the exit code 3 says that something was not given: what was given must be what FFmpeg shows.
                what = "refused" if depth is None else "wrong" if found else "right"
                by_ffmpeg = kind == "camera folders" or values.played_by_ffmpeg(path, "0:v:0") is not None
                row = counts[kind]
                row.update(["inputs", what] + ["ffmpeg", "others", what + " of others"] * by_ffmpeg)
                if options.list and (what != "right" or code != 0):
                    print("%s, %s: %s (%d) %s; %s" % (kind, name, what, code, found or "", said.splitlines()[-1] if said else ""))


def values_of(kind, paths):
    """Reader -> measure, of those that Theatron has."""
    found = {"DICOM": (("gdcm", values.dicom_by_gdcm), ("dcm2niix", values.dicom_by_dcm2niix), ("itk", values.dicom_by_itk)),
             "NIfTI": (("nibabel", values.labels_by_nibabel), ("itk", values.labels_by_itk)),
             "NRRD": (("vtk", values.labels_by_vtk), ("itk", values.labels_by_itk)),
             "glTF": (("assimp", values.surface_by_assimp),)}.get(
                 kind, (("vtk", values.surface_by_vtk), ("assimp", values.surface_by_assimp)))
    with tempfile.TemporaryDirectory() as folder:
        out = {}
        for name, measure in found:
            file = pathlib.Path(folder) / name
            if in_process(lambda paths: file.write_text(json.dumps(measure(paths))), paths):
                out[name] = json.loads(file.read_text())
        return out


def show(measure):
    return " ".join("%.6g" % v for v in measure) if measure else "-"


def compare_values(program, folder):
    print("| input | Theatron | others | |")
    print("|---|---|---|---|")
    for source in sorted(path for path in folder.iterdir() if path.is_dir()):
        kind = next((kind for kind, names in KINDS if any(name in source.name for name in names)), None)
        if kind is None:
            continue
        with tempfile.TemporaryDirectory() as temporary:
            case = pathlib.Path(temporary) / "case"
            done = subprocess.run([program, "case", "import", source, case], capture_output=True, text=True, timeout=120)
            text = (done.stdout + done.stderr).replace(str(source), "")
            ours = None
            if done.returncode == 0:
                ours = values.series_of_case(case) if kind == "DICOM" else values.surfaces_of_case(case)
        others = values_of(kind, [path for path in files_of(kind, source)])
        same = [name for name, one in others.items() if ours and one and values.agree(
            ours[-1:] if len(one) == 1 else ours, one, 0.03 if kind != "DICOM" else 1e-4, 1.5 if kind != "DICOM" else 0.02)]
        verdict = "refused" if ours is None else "as " + ", ".join(same) if same else "differs" if any(others.values()) else "alone"
        said = [line for line in text.splitlines() if line.startswith(("theatron:", "remark:"))]
        print("| %s | %s | %s | %s |" % (source.name, show(ours), "; ".join("%s %s" % (n, show(o)) for n, o in others.items()), verdict))
        for line in said:
            print("| | %s | | |" % line)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--list", action="store_true", help="also each input that is refused or wrong")
    parser.add_argument("--kind", choices=[row[0] for row in KINDS + PLAYED], help="only inputs of this kind")
    parser.add_argument("--values", type=pathlib.Path, metavar="FOLDER", help="values of inputs of which nothing is known")
    options = parser.parse_args()
    program = os.environ["THEATRON"]
    values.build_itk_reader()
    if options.values:
        compare_values(program, options.values)
        return
    readers = [one for one in READERS if is_there(one[2])]
    for one in READERS:
        if one not in readers:
            print("not installed: " + one[0], file=sys.stderr)
    for _, _, module, _ in readers:
        if is_module(module):
            importlib.import_module(module)
    counts = collections.defaultdict(collections.Counter)
    for one in foreign_test.inputs():
        kind = kind_of(one.name)
        if kind is None or options.kind not in (None, kind):
            continue
        with tempfile.TemporaryDirectory() as temporary:
            folder = pathlib.Path(temporary)
            foreign_test.write(one.files, folder / "source")
            what, words = outcome(one, folder, program)
            paths = list(files_of(kind, folder / "source"))
            read_by = [name for name, read, _, kinds in readers
                       if kind in kinds and paths and all(in_process(read, path) for path in paths)]
        row = counts[kind]
        row["inputs"] += 1
        row[what] += 1
        row.update(read_by)
        if read_by:
            row["others"] += 1
            row[what + " of others"] += 1
        if options.list and what != "right":
            print("%s: %s; read by %s: %s" % (one.name, what, ", ".join(read_by) or "none", words.splitlines()[-1]))
        print("\r%d inputs" % sum(c["inputs"] for c in counts.values()), end="", file=sys.stderr)
    compare_played(program, counts, options)
    print("| kind | inputs | right | refused | wrong | read by others | of these refused | by reader |")
    print("|---|---|---|---|---|---|---|---|")
    for kind, row in counts.items():
        each = ", ".join("%s %d" % (name, row[name]) for name, _, _, kinds in readers if kind in kinds) or "ffmpeg %d" % row["ffmpeg"]
        print("| %s | %d | %d | %d | %d | %d | %d | %s |" % (kind, row["inputs"], row["right"], row["refused"], row["wrong"],
                                                       row["others"], row["refused of others"], each))


if __name__ == "__main__":
    main()
