# SPDX-License-Identifier: Apache-2.0
"""The part `development` of an installation: examples/, copied out of the tree, are built with it and run."""
import os
import pathlib
import re
import shutil
import tempfile
import unittest

import patience
from examples_test import SOURCES, save_a_picture
from theatron_process import PROGRAM

BUILD = pathlib.Path(PROGRAM).resolve().parent.parent.parent
ROOT = SOURCES.parent
PROGRAMS = ("publish_camera", "save_picture", "send_camera")


@unittest.skipIf("THEATRON_CUDA:BOOL=ON" in (BUILD / "CMakeCache.txt").read_text(),
                 "a build with CUDA installs no libraries: configure with the release preset")
class InstalledLibraries(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        temporary = tempfile.TemporaryDirectory()
        cls.addClassCleanup(temporary.cleanup)
        cls.folder = pathlib.Path(temporary.name)
        cls.call("cmake", "--install", BUILD, "--prefix", cls.folder / "first", "--component", "development")
        # The files must not name the place where they were.
        cls.prefix = (cls.folder / "first").rename(cls.folder / "second")
        cls.sources = shutil.copytree(SOURCES, cls.folder / "examples")

    @classmethod
    def call(cls, *command, **options):
        done = patience.run(command, **options)
        if done.returncode != 0:
            raise AssertionError(f"{command}:\n{done.stdout}{done.stderr}")
        return done.stdout

    def test_examples_find_the_package_of_cmake(self):
        build = self.folder / "by_cmake"
        self.call("cmake", "-S", self.sources, "-B", build, "-G", "Ninja", f"-DCMAKE_PREFIX_PATH={self.prefix}")
        self.assertIn(f"Theatron_DIR:PATH={self.prefix}/", (build / "CMakeCache.txt").read_text())
        self.call("cmake", "--build", build)
        for program in PROGRAMS:
            self.assertTrue((build / program).exists(), program)
        save_a_picture(self, build)

    def test_examples_find_the_package_of_pkg_config(self):
        build = self.folder / "by_pkg_config"
        build.mkdir()
        (package,) = self.prefix.rglob("theatron.pc")
        flags = self.call("pkg-config", "--static", "--cflags", "--libs", "theatron",
                          env=os.environ | {"PKG_CONFIG_PATH": str(package.parent)}).split()
        for program in PROGRAMS:
            self.call("c++", "-std=c++20", self.sources / f"{program}.cpp", "-o", build / program, *flags)
        save_a_picture(self, build)

    def test_no_file_names_a_place_of_this_machine(self):
        files = [path for path in self.prefix.rglob("*") if path.is_file()]
        self.assertTrue(files)
        for path in files:
            content = path.read_bytes()
            for place in (ROOT, BUILD, self.folder):
                self.assertNotIn(bytes(place), content, path)
            if path.suffix in (".cmake", ".pc"):
                self.assertIsNone(re.search(rb"/usr|/lib/x86|NOTFOUND", content), path)

    def test_each_header_has_those_that_it_includes(self):
        headers = self.prefix / "include" / "theatron"
        modules = {path.name for path in headers.iterdir()}
        self.assertIn("viewer", modules)
        for header in headers.rglob("*.h"):
            for included in re.findall(r'^#include "(([a-z_]+)/[^"]+)"', header.read_text(), re.MULTILINE):
                if included[1] in modules:
                    self.assertTrue((headers / included[0]).exists(), f"{header} includes {included[0]}")


if __name__ == "__main__":
    unittest.main()
