# SPDX-License-Identifier: Apache-2.0
"""Files as other programs and devices write them, generated: each is imported, and what comes out is
compared with what went in. Generated are also the files with which the fuzz targets begin:

    python3 tests/foreign/foreign_test.py --seeds FOLDER
    python3 tests/foreign/foreign_test.py --write FOLDER [PART OF A NAME]
"""

import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import case_seeds  # noqa: E402
import device_inputs  # noqa: E402
import dicom_inputs  # noqa: E402
import folder_inputs  # noqa: E402
import further_inputs  # noqa: E402
import gltf_inputs  # noqa: E402
import label_inputs  # noqa: E402
import mesh_inputs  # noqa: E402
import more_inputs  # noqa: E402
import own_seeds  # noqa: E402
import packed_glb  # noqa: E402
import played_inputs  # noqa: E402
import unusual_inputs  # noqa: E402
from expected import problem  # noqa: E402

LEAST = 200
FUZZERS = {".stl": "stl_fuzz", ".ply": "ply_fuzz", ".glb": "glb_fuzz", ".gltf": "glb_fuzz", ".nii": "nifti_fuzz",
           ".nrrd": "nrrd_fuzz", ".nhdr": "nrrd_fuzz", ".dcm": "dicom_fuzz", "": "dicom_fuzz"}
LONGEST_SEED = 1 << 16


def inputs():
    for module in (dicom_inputs, label_inputs, mesh_inputs, gltf_inputs, packed_glb, folder_inputs, more_inputs,
                   unusual_inputs, device_inputs, further_inputs):
        yield from module.inputs()


def write(files, folder):
    for name, data in files.items():
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(data)


def plain_name(name):
    return re.sub("[^A-Za-z0-9.-]+", "_", name)


def write_seeds(folder):
    """The first file of each input, for the target that reads its kind."""
    for one in inputs():
        name, data = next(iter(one.files.items()))
        name = name.removesuffix(".gz").removesuffix(".bz2")
        extension = pathlib.PurePath(name).suffix
        target = FUZZERS.get(extension)
        if target and len(data) <= LONGEST_SEED:
            path = folder / target / plain_name(one.name)
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(data)
    for target, name, data in (*case_seeds.seeds(), *own_seeds.seeds()):
        path = folder / target / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(data)


class ForeignFiles(unittest.TestCase):
    def run_all(self, module):
        program = os.environ["THEATRON"]
        count = 0
        for one in module.inputs():
            count += 1
            with self.subTest(one.name), tempfile.TemporaryDirectory() as temporary:
                folder = pathlib.Path(temporary)
                write(one.files, folder / "source")
                done = subprocess.run([program, "case", "import", folder / "source", folder / "case"],
                                      capture_output=True, text=True, timeout=120)
                text = (done.stdout + done.stderr).replace(str(folder), "")
                self.assertIsNone(problem(one, done.returncode, text, folder / "case"))
        return count

    def test_dicom(self):
        self.run_all(dicom_inputs)

    def test_label_maps(self):
        self.run_all(label_inputs)

    def test_surfaces_and_pictures(self):
        self.run_all(mesh_inputs)

    def test_gltf(self):
        self.run_all(gltf_inputs)

    def test_packed_surfaces(self):
        self.run_all(packed_glb)

    def test_whole_folders(self):
        self.run_all(folder_inputs)

    def test_more_of_each_kind(self):
        self.run_all(more_inputs)

    def test_unusual_values(self):
        self.run_all(unusual_inputs)

    def test_habits_of_devices(self):
        self.run_all(device_inputs)

    def test_further_habits(self):
        self.run_all(further_inputs)

    def import_closed(self, closed):
        """The result of an import of a good series by a user who may not open `closed`."""
        other = 65534  # nobody: root may open everything
        user = {"user": other, "group": other, "extra_groups": []} if os.geteuid() == 0 else {}
        with tempfile.TemporaryDirectory() as temporary:
            folder = pathlib.Path(temporary)
            folder.chmod(0o777)
            # The folders above the built program may be closed to that user.
            program = shutil.copy(os.environ["THEATRON"], folder / "theatron")
            write(dicom_inputs.good() | {name: b"x" * 400 for name in closed}, folder / "source")
            for name in closed:
                (folder / "source" / name.split("/")[0]).chmod(0)
            done = subprocess.run([program, "case", "import", folder / "source", folder / "case"], cwd=folder,
                                  capture_output=True, text=True, timeout=120, **user)
            for name in closed:
                (folder / "source" / name.split("/")[0]).chmod(0o700)
            return done.returncode, done.stdout + done.stderr

    def test_what_may_not_be_opened_is_named(self):
        for name in ("lost+found/x", "notes", "o.hdr"):
            with self.subTest(name):
                code, text = self.import_closed([name])
                self.assertEqual(code, 0, text)
                self.assertIn(name.split("/")[0] + "' may not be opened by this user, so what it holds is left out.", text)
        code, text = self.import_closed(["notes", "lost+found/x"])
        self.assertEqual(code, 0, text)
        self.assertIn("2 files and folders may not be opened by this user", text)
        code, text = self.import_closed(["IM004.dcm"])
        self.assertEqual(code, 1, text)
        self.assertIn("IM004.dcm': Permission denied", text)

    def test_there_are_enough_and_each_has_its_name(self):
        names = [one.name for one in inputs()]
        self.assertGreaterEqual(len(names), LEAST)
        self.assertEqual(len(set(names)), len(names))

    def test_each_fuzz_target_begins_with_files(self):
        root = pathlib.Path(__file__).resolve().parents[2]
        with tempfile.TemporaryDirectory() as folder:
            write_seeds(pathlib.Path(folder))
            seeded = {path.name for path in pathlib.Path(folder).iterdir()}
        seeded |= {path.name.removesuffix(".tar.gz") for path in (root / "tests/corpus").iterdir()}
        self.assertEqual(seeded, {path.stem for folder in ("src", "apps", "tests") for path in root.glob(f"{folder}/*/*_fuzz.cpp")})


class PlayedFiles(unittest.TestCase):
    def test_what_is_given_and_what_is_said(self):
        left_out = [one.name for one in played_inputs.inputs() if not played_inputs.is_possible(one)]
        for one in played_inputs.inputs():
            if one.name in left_out:
                continue
            with self.subTest(one.name), tempfile.TemporaryDirectory() as temporary:
                folder = pathlib.Path(temporary)
                played_inputs.write(one, folder / "source")
                done = subprocess.run([os.environ["THEATRON"], "record", "--camera", one.camera % (folder / "source"), folder / "r.mkv",
                                       "--json"], capture_output=True, text=True, timeout=120)
                figures = json.loads(done.stdout) if done.stdout.startswith("{") else {}
                self.assertIsNone(played_inputs.problem(one, done.returncode, figures, done.stderr.replace(str(folder), "")))
        if left_out:
            self.skipTest("without ffmpeg no videos can be made: " + ", ".join(left_out))


def main():
    if len(sys.argv) >= 3 and sys.argv[1] == "--seeds":
        write_seeds(pathlib.Path(sys.argv[2]))
    elif len(sys.argv) >= 3 and sys.argv[1] == "--write":
        for one in inputs():
            if len(sys.argv) < 4 or sys.argv[3] in one.name:
                write(one.files, pathlib.Path(sys.argv[2]) / plain_name(one.name))
    else:
        unittest.main()


if __name__ == "__main__":
    main()
