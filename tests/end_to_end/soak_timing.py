# SPDX-License-Identifier: Apache-2.0
"""A short soak with a fixed seed: every kind of fault that this machine allows, once (docs/soak.md)."""
import pathlib
import shutil
import sys
import tempfile
import unittest

import patience

SOAK = pathlib.Path(__file__).resolve().parents[1] / "soak" / "soak.py"
MINUTES, SEED, LONGEST_S, PACE, CONTENT = 0.9, 12, 1.5, 0.35, 2000


class Soak(unittest.TestCase):
    def test_every_missing_picture_is_explained_by_a_fault(self):
        folder = pathlib.Path(tempfile.mkdtemp(prefix="theatron_soak_"))
        self.addCleanup(shutil.rmtree, folder)
        done = patience.run([sys.executable, SOAK, "--minutes", str(MINUTES), "--seed", str(SEED), "--longest",
                               str(LONGEST_S), "--pace", str(PACE), "--content", str(CONTENT), "--out", folder / "soak"])
        self.assertEqual(done.returncode, 0, done.stdout[-8000:] + done.stderr[-2000:])
        for line in done.stdout.splitlines():
            if line.startswith("soak: without"):
                print(line)


if __name__ == "__main__":
    unittest.main()
