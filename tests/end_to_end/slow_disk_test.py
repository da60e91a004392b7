# SPDX-License-Identifier: Apache-2.0
"""The disk with faults itself: each state does what it says, below its folder only."""
import errno
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

from slow_disk import SlowDisk

WRITER = """
import os, sys, time
for line in sys.stdin:
    path, what = line.split()
    begin = time.monotonic()
    try:
        file = os.open(path, os.O_RDWR | os.O_CREAT, 0o600)
        if what == "grow":
            os.pwrite(file, b"12345678", os.fstat(file).st_size)
        elif what == "overwrite":
            os.pwrite(file, b"x", 0)
        else:
            os.fdatasync(file)
        os.close(file)
        answer = 0
    except OSError as e:
        answer = e.errno
    print(answer, time.monotonic() - begin, flush=True)
"""


class Faults(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="theatron_e2e_"))
        self.disk = SlowDisk(self.folder)
        self.writer = subprocess.Popen([sys.executable, "-c", WRITER], stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                                       text=True, env=self.disk.environment)

    def tearDown(self):
        self.writer.kill()
        self.writer.communicate()
        shutil.rmtree(self.folder)

    def ask(self, what, path=None):
        self.writer.stdin.write(f"{path or self.disk.folder / 'file'} {what}\n")
        self.writer.stdin.flush()

    def answer(self):
        code, seconds = self.writer.stdout.readline().split()
        return int(code), float(seconds)

    def after(self, what, path=None):
        self.ask(what, path)
        return self.answer()[0]

    def test_each_state_fails_what_it_says(self):
        self.assertEqual([self.after(what) for what in ("grow", "overwrite", "sync")], [0, 0, 0])
        for state, expected in (("full", [errno.ENOSPC, 0, 0]), ("error", [errno.EIO] * 3),
                                ("gone", [errno.ENODEV] * 3), ("well", [0, 0, 0])):
            self.disk.be(state)
            self.assertEqual([self.after(what) for what in ("grow", "overwrite", "sync")], expected, state)

    def test_other_folders_are_not_concerned(self):
        self.disk.be("gone")
        self.assertEqual([self.after(what, self.folder / "other") for what in ("grow", "overwrite", "sync")], [0, 0, 0])

    def test_a_stalled_disk_goes_on_when_it_is_well_again(self):
        self.disk.be("stall")
        self.ask("grow")
        self.assertEqual(self.after_file_size(), 0, "nothing is written yet")
        self.disk.be("slow 80")
        code, seconds = self.answer()
        self.assertEqual(code, 0)
        self.assertGreaterEqual(seconds, 0.08)
        self.assertEqual(os.stat(self.disk.folder / "file").st_size, 8)

    def after_file_size(self):
        """The size of the file as soon as the writer has opened it."""
        while not (self.disk.folder / "file").exists():
            self.assertIsNone(self.writer.poll())
        return os.stat(self.disk.folder / "file").st_size


if __name__ == "__main__":
    unittest.main()
