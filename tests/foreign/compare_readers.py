#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What `theatron case import` and the readers that Debian has make of the inputs of this folder. Run by hand:

    apt install python3-gdcm python3-nibabel python3-meshio python3-vtk9 dcm2niix dcmtk assimp-utils
    THEATRON=build/release/apps/theatron/theatron /usr/bin/python3 tests/foreign/compare_readers.py

Another reader counts as reading an input if it gives pixels, samples or triangles of all files of its kind, whatever
their values are; the right values are known for Theatron alone. Readers that are not installed are left out, and named.
"""

import argparse
import collections
import importlib.util
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import foreign_test  # noqa: E402
from expected import problem  # noqa: E402

LONGEST = 10  # seconds for a reader and an input
KINDS = (("DICOM", ("dicom",)), ("NIfTI", ("nifti",)), ("NRRD", ("nrrd",)), ("STL", ("stl",)), ("PLY", ("ply",)),
         ("GLB", ("glb",)), ("OBJ", ("obj",)))


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


READERS = (("gdcm", gdcm_reads, "gdcm", ("DICOM",)), ("dcmtk", dcmtk_reads, "dcm2pnm", ("DICOM",)),
           ("dcm2niix", dcm2niix_reads, "dcm2niix", ("DICOM",)),
           ("nibabel", nibabel_reads, "nibabel", ("NIfTI",)), ("vtk", vtk_reads, "vtkmodules", ("NIfTI", "NRRD", "STL", "PLY", "OBJ")),
           ("meshio", meshio_reads, "meshio", ("STL", "PLY", "OBJ")), ("assimp", assimp_reads, "assimp", ("STL", "PLY", "GLB", "OBJ")))


def is_there(what):
    return shutil.which(what) or importlib.util.find_spec(what)


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
    endings = {"NIfTI": (".nii", ".gz"), "NRRD": (".nrrd", ".nhdr"), "STL": (".stl",), "PLY": (".ply",), "GLB": (".glb",),
               "OBJ": (".obj",)}.get(kind)
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


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--list", action="store_true", help="also each input that is refused or wrong")
    parser.add_argument("--kind", choices=[kind for kind, _ in KINDS], help="only inputs of this kind")
    options = parser.parse_args()
    program = os.environ["THEATRON"]
    readers = [one for one in READERS if is_there(one[2])]
    for one in READERS:
        if one not in readers:
            print("not installed: " + one[0], file=sys.stderr)
    for _, _, module, _ in readers:
        if importlib.util.find_spec(module):
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
    print("| kind | inputs | right | refused | wrong | read by others | of these refused | by reader |")
    print("|---|---|---|---|---|---|---|---|")
    for kind, row in counts.items():
        each = ", ".join("%s %d" % (name, row[name]) for name, _, _, kinds in readers if kind in kinds)
        print("| %s | %d | %d | %d | %d | %d | %d | %s |" % (kind, row["inputs"], row["right"], row["refused"], row["wrong"],
                                                       row["others"], row["refused of others"], each))


if __name__ == "__main__":
    main()
