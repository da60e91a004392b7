# SPDX-License-Identifier: Apache-2.0
"""The examples in examples/python that read recordings, and the declarations of the Python package."""
import ast
import importlib.util
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import unittest

import patience
from python_case import EXAMPLES, ROOT, PythonCase, example, needs_package, numpy as np, theatron
from theatron_process import read_png, write_png

PACKAGE = ROOT / "apps" / "python" / "theatron"


@needs_package
class Examples(PythonCase):
    @unittest.skipUnless(importlib.util.find_spec("matplotlib"), "python3-matplotlib is missing")
    def test_a_cloud_is_plotted(self):
        example("plot_cloud.py", self.record(), 0.1, self.folder / "cloud.png")
        width, height, _, rows = read_png(self.folder / "cloud.png")
        self.assertEqual((width, height), (800, 600))
        self.assertGreater(len(set(map(bytes, rows))), 100, "the picture shows nothing")

    def test_the_noise_of_a_still_scene_is_what_was_put_in(self):
        rng = np.random.default_rng(3)
        (self.folder / "source" / "depth").mkdir(parents=True)
        for n in range(30):
            depth = np.rint(2100 + 8 * rng.standard_normal((48, 64))).astype(">u2")
            write_png(self.folder / "source" / "depth" / f"{n:05}.png", 64, 48, 16, 1, [row.tobytes() for row in depth])
        out = example("depth_noise.py", self.record(color=False)).splitlines()
        (line,) = [one for one in out if one.startswith("2.0 to 2.5 m")]
        self.assertAlmostEqual(float(line.split(": ")[1].split()[0]), 8, delta=0.8)

    def test_a_moment_becomes_a_cloud_of_open3d(self):
        file = self.record()
        out = example("open3d_cloud.py", file, 0.1, self.folder / "cloud.txt")
        frame = next(theatron.Recording(file).frames(start=0.1))
        self.assertTrue(out.startswith(f"{len(frame.points())} points"), out)
        written = np.loadtxt(self.folder / "cloud.txt")
        self.assertLessEqual(len(written), len(frame.points()))
        np.testing.assert_allclose(written[:, :3].max(0), frame.points(in_room=True).max(0), atol=0.01)

    def test_messages_of_ros_have_the_pictures(self):
        file = self.record(options=("--color-codec", "jpeg"))
        messages = [json.loads(line) for line in example("ros_publish.py", file).splitlines()]
        frames = list(theatron.Recording(file).frames())
        depth = [m for m in messages if m["topic"] == "depth/image_raw"]
        self.assertEqual(len(depth), len(frames))
        self.assertEqual({(m["encoding"], m["step"], m["bytes"]) for m in depth}, {("16UC1", 320, 160 * 120 * 2)})
        np.testing.assert_allclose([m["stamp"] for m in depth], [f.seconds for f in frames], atol=1e-6)
        compressed = [m["bytes"] for m in messages if m["topic"] == "rgb/image_raw/compressed"]
        self.assertEqual(compressed, [len(f.jpeg) for f in frames if f.jpeg])
        info = next(m for m in messages if m["topic"] == "depth/camera_info")
        self.assertEqual(info["K"][0], frames[0].calibration.depth.fx)

    def test_what_is_wrong_is_one_sentence(self):
        for name, *arguments in (("depth_noise.py",), ("open3d_cloud.py", 0, "a.ply"), ("ros_publish.py",)):
            done = example(name, self.folder / "nowhere.mkv", *arguments, check=False)
            self.assertEqual((done.returncode, done.stderr.count("\n")), (1, 1), done.stderr)

    def test_without_their_arguments_they_say_how_they_are_used(self):
        for source in sorted(EXAMPLES.glob("*.py")):
            if source.name == "mean_depth.py":  # the ten lines
                continue
            for arguments in ((), ("a", "b", "c", "d")):
                done = example(source.name, *arguments, check=False)
                self.assertEqual(done.returncode, 1, source.name)
                self.assertRegex(done.stderr, rf"^\w[^\n]*\n\n    {source.name} [A-Z]")

    def test_times_without_frames_and_places_that_cannot_be_written_are_sentences(self):
        file = self.record()
        for name, *arguments in (("plot_cloud.py", 99, self.folder / "a.png"), ("open3d_cloud.py", 99, self.folder / "a.txt"),
                                 ("plot_cloud.py", "soon", self.folder / "a.png"), ("open3d_cloud.py", "soon", self.folder / "a.txt"),
                                 ("plot_cloud.py", 0, self.folder / "nowhere" / "a.png"),
                                 ("open3d_cloud.py", 0, self.folder / "nowhere" / "a.txt"), ("depth_noise.py", "left"), ("ros_publish.py", "left")):
            if name == "plot_cloud.py" and not importlib.util.find_spec("matplotlib"):
                continue
            done = example(name, file, *arguments, check=False)
            self.assertEqual((done.returncode, done.stderr.count("\n")), (1, 1), (name, arguments, done.stderr))

    def test_they_are_short(self):
        self.assertLessEqual(len((EXAMPLES / "mean_depth.py").read_text().splitlines()), 10)
        for source in EXAMPLES.glob("*.py"):
            self.assertLessEqual(len(source.read_text().splitlines()), 70, source)


@needs_package
class Declarations(unittest.TestCase):
    """__init__.pyi says what there is."""

    def test_every_name_is_declared_and_exists(self):
        tree = ast.parse((PACKAGE / "__init__.pyi").read_text())
        types = {"VerifiedPictures", "VerifiedMinute", "Verification"}  # shapes of dictionaries
        declared = {node.name: node for node in tree.body if isinstance(node, (ast.ClassDef, ast.FunctionDef))}
        self.assertEqual(set(declared) - types, set(theatron.__all__) - {"__version__"})
        for name, node in declared.items():
            if name in types or isinstance(node, ast.FunctionDef):
                continue
            members = {one.name for one in node.body if isinstance(one, ast.FunctionDef)}
            found = {one for one in vars(getattr(theatron, name)) if not one.startswith("_")}
            self.assertEqual({one for one in members if not one.startswith("_")}, found, name)
            for one in members:
                self.assertTrue(hasattr(getattr(theatron, name), one), f"{name}.{one}")

    def test_arguments_have_their_declared_names(self):
        tree = ast.parse((PACKAGE / "__init__.pyi").read_text())
        for node in tree.body:
            if isinstance(node, ast.FunctionDef):
                said = getattr(theatron, node.name).__doc__.splitlines()[0]
                for argument in (*node.args.args, *node.args.kwonlyargs):
                    self.assertIn(f"{argument.arg}: ", said)


@needs_package
@unittest.skipUnless(importlib.util.find_spec("mypy"), "python3-mypy is missing")
class Types(PythonCase):
    """What a type checker says of the declarations, and of programs by them."""

    def mypy(self, *words):
        packages = pathlib.Path(theatron.__file__).parent.parent
        done = patience.run([sys.executable, "-m", *map(str, words)], cwd=self.folder, env={**os.environ, "MYPYPATH": str(packages)})
        return done.returncode, done.stdout + done.stderr

    def test_declarations_are_those_of_the_module(self):
        # Metaclass and constructor of pybind11's classes, and dictionaries whose shapes are types of the declarations alone.
        allowed = self.folder / "allowed.txt"
        allowed.write_text("theatron\\.[A-Z]\\w*\n" "theatron\\.\\w+\\.__init__\n")
        code, said = self.mypy("mypy.stubtest", "theatron", "--allowlist", allowed, "--ignore-unused-allowlist")
        self.assertEqual(code, 0, said)

    def test_examples_are_right(self):
        for source in sorted(EXAMPLES.glob("*.py")):
            code, said = self.mypy("mypy", "--check-untyped-defs", "--ignore-missing-imports", source)
            self.assertEqual(code, 0, said)

    def test_what_is_wrong_is_found(self):
        (self.folder / "wrong.py").write_text("""import theatron
frames = theatron.Recording(3).frames(camera="left")
for frame in frames:
    frame.depth.nothing
    theatron.encode_depth(frame.color)
""")
        code, said = self.mypy("mypy", "wrong.py")
        self.assertEqual((code, said.count(": error: ")), (1, 4), said)


@needs_package
class Licences(unittest.TestCase):
    @unittest.skipUnless(shutil.which("readelf"), "readelf is not installed: apt-get install binutils")
    def test_the_module_is_linked_with_nothing_under_the_gpl(self):
        listed = subprocess.run(["readelf", "-d", theatron._theatron.__file__], capture_output=True, text=True, check=True).stdout
        needed = re.findall(r"\(NEEDED\).*\[(.*)\]", listed)
        self.assertIn("libc.so.6", needed)
        for name in needed:
            self.assertNotRegex(name, r"spqr|cholmod|suitesparse|cxsparse|ceres|x264|x265|xvid|libav|libsw")

    def test_the_notices_of_what_it_contains_lie_beside_it(self):
        notices = (pathlib.Path(theatron._theatron.__file__).parent / "licences.txt").read_text()
        for holder in ("Wenzel Jakob", "Niels Lohmann"):
            self.assertIn(holder, notices)


if __name__ == "__main__":
    unittest.main()
