#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The software bill of materials of the built program (THEATRON) names all that its process maps, with versions."""

import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import sbom  # noqa: E402

PROGRAM = os.environ["THEATRON"]
COMPILED_IN = pathlib.Path(PROGRAM).parent / "licences.txt.packages"


def run(folder, program=PROGRAM, epoch="1700000000"):
    sources = folder / "versions.txt"
    sources.write_text("libzstd 1.5.4+dfsg2-5\nopus 1.3.1-3\n")
    out = folder / "out.json"
    done = subprocess.run((sys.executable, "-B", sbom.__file__, "--version", "1.2.3", "--program", program, "--compiled-in", COMPILED_IN,
                           "--page-sources", sources, "--output", out), capture_output=True, text=True,
                          env=os.environ | {"SOURCE_DATE_EPOCH": epoch})
    return done, out


class Bill(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)

    def bill(self):
        done, out = run(self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        return json.loads(out.read_text())

    def test_what_the_program_is_linked_with_and_made_of_is_named_with_its_version(self):
        bill = self.bill()
        packages = {package["name"]: package for package in bill["packages"]}
        for line in subprocess.run(("ldd", PROGRAM), capture_output=True, text=True, check=True).stdout.splitlines():
            name = line.split()[0]
            if name in ("libssl.so.3", "libpng16.so.16", "libseccomp.so.2"):
                self.assertIn(sbom.packages_of([line.split()[2]])[0], packages)
        for name in COMPILED_IN.read_text().split():
            self.assertEqual(packages[name]["versionInfo"], sbom.output_of("dpkg-query", "--show", "--showformat", "${Version}", name))
        self.assertEqual(packages["theatron"]["licenseDeclared"], "Apache-2.0")
        self.assertEqual(packages["libzstd"]["externalRefs"][0]["referenceLocator"],
                         "pkg:deb/debian/libzstd@1.5.4%2Bdfsg2-5?arch=source&distro=debian-12")

    def test_each_relation_is_between_things_that_are_there(self):
        bill = self.bill()
        ids = [package["SPDXID"] for package in bill["packages"]]
        self.assertEqual(len(ids), len(set(ids)))
        ends = {end for relation in bill["relationships"] for end in (relation["spdxElementId"], relation["relatedSpdxElement"])}
        self.assertEqual(ends - {"SPDXRef-DOCUMENT"}, set(ids))
        for package in bill["packages"]:
            self.assertRegex(package["SPDXID"], r"^SPDXRef-[A-Za-z0-9.-]+$")
            self.assertTrue(package["versionInfo"] and package["supplier"])

    def test_two_bills_of_one_time_are_the_same_bytes(self):
        first, second = self.folder / "a", self.folder / "b"
        first.mkdir()
        second.mkdir()
        self.assertEqual(run(first)[1].read_bytes(), run(second)[1].read_bytes())

    def test_another_file_than_the_program_is_told(self):
        done, out = run(self.folder, program="/bin/sh" + "-that-is-not-there")
        self.assertEqual(done.returncode, 1)
        self.assertRegex(done.stderr, "^sbom: .*that-is-not-there")
        self.assertFalse(out.exists())


if __name__ == "__main__":
    unittest.main()
