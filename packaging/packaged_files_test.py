#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Each file that `cmake --install` puts somewhere belongs to a Debian package, and each entry of a package's list has files:
else `make package` fails, which no other test builds. BUILD is the build folder."""

import fnmatch
import os
import pathlib
import subprocess
import tempfile
import unittest

BUILD = pathlib.Path(os.environ["BUILD"])
DEBIAN = pathlib.Path(__file__).resolve().parent.parent / "debian"
# debian/rules builds these; a plain build does not.
OF_PACKAGES = ("usr/lib/python3/dist-packages/theatron", "usr/share/doc/theatron/theatron.spdx.json", "usr/share/theatron/page")


def sources():
    """What the lists of the packages take from the folder of the installation."""
    for file in DEBIAN.glob("*.install"):
        for line in file.read_text().splitlines():
            if line.strip() and not line.startswith("#"):
                yield line.split()[0]


def is_in(path, source):
    return fnmatch.fnmatch(path, source) or path.startswith(source + "/")


class Packages(unittest.TestCase):
    def test_each_installed_file_is_in_a_package_and_each_entry_has_files(self):
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run(("cmake", "--install", BUILD, "--prefix", "/usr"), env=os.environ | {"DESTDIR": folder}, check=True,
                           capture_output=True)
            # debian/rules builds with /etc as the folder of configurations.
            installed = [str(path.relative_to(folder)).replace("usr/etc/", "etc/") for path in pathlib.Path(folder).rglob("*")
                         if path.is_file()]
        wanted = list(sources())
        self.assertIn("usr/bin/theatron", installed)
        self.assertEqual([path for path in installed if not any(is_in(path, source) for source in wanted)], [])
        self.assertEqual([source for source in wanted
                          if source not in OF_PACKAGES and not any(is_in(path, source) for path in installed)], [])


if __name__ == "__main__":
    unittest.main()
