# SPDX-License-Identifier: Apache-2.0
"""Foreign recordings are read by a process of their own, which harms nobody but its own camera."""
import ctypes
import os
import pathlib
import platform
import shutil
import signal
import struct
import tempfile
import unittest

import patience
from theatron_process import PROGRAM, Process, host, make_recording, run, wait_until


def readers_of(pid):
    """The processes that `pid` started for foreign files."""
    found = []
    for entry in pathlib.Path("/proc").iterdir():
        try:
            if entry.name.isdigit() and int((entry / "stat").read_text().rpartition(")")[2].split()[1]) == pid \
                    and b"--sandboxed-reader" in (entry / "cmdline").read_bytes():
                found.append(int(entry.name))
        except OSError:
            pass  # it has just ended
    return found


def without_filters():
    """In a new process: from now on the system refuses all further system-call filters."""
    seccomp, prctl, set_seccomp, allow, refuse = 317, 157, 22, 0x7fff0000, 0x00050000 | 22
    load, equal, end = 0x20, 0x15, 0x06
    code = [(load, 0, 0, 0), (equal, 4, 0, seccomp), (equal, 0, 2, prctl), (load, 0, 0, 16),
            (equal, 1, 0, set_seccomp), (end, 0, 0, allow), (end, 0, 0, refuse)]
    program = ctypes.create_string_buffer(b"".join(struct.pack("=HBBI", *line) for line in code))
    head = ctypes.create_string_buffer(struct.pack("@HP", len(code), ctypes.addressof(program)))
    libc = ctypes.CDLL(None)
    if libc.prctl(38, 1, 0, 0, 0) != 0 or libc.prctl(22, 2, ctypes.byref(head), 0, 0) != 0:
        os._exit(99)


class Sandbox(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="theatron_e2e_"))
        # An Azure Kinect has pictures of this size.
        cls.pictures = make_recording(cls.folder / "camera", 320, 288, frames=6, color=False)
        cls.mkv = cls.folder / "kinect.mkv"
        for command in (["record", "--camera", f"folder:{cls.pictures},loop=1", "--seconds", "1", cls.folder / "r.mkv"],
                        ["export", cls.folder / "r.mkv", "--k4a", cls.mkv]):
            code, _, errors = run(*command)
            assert code == 0, errors
        cls.camera = f"mkv:{cls.mkv},loop=1,preload=0"

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder)

    def test_a_reader_that_crashes_costs_its_camera_alone(self):
        with host(self.folder / "state", self.camera, f"folder:{self.pictures},loop=1") as h, \
                Process("join", h.greeting["link"], "--no-window", "--every", "0.2") as viewer:
            viewer.wait_for(lambda f: len(f["cameras"]) == 2 and all(c["frames"] > 3 for c in f["cameras"]))
            readers = readers_of(h.process.pid)
            self.assertEqual(len(readers), 1)
            os.kill(readers[0], signal.SIGSEGV)
            h.wait_for_error("kinect.mkv' made its reader crash")
            before = max(c["frames"] for c in viewer.newest_json()["cameras"])
            viewer.wait_for(lambda f: max(c["frames"] for c in f["cameras"]) > before + 10)
            self.assertIsNone(h.process.poll())
            self.assertEqual(readers_of(h.process.pid), [])

    def test_a_camera_that_can_come_back_gets_a_new_reader(self):
        # For tests a camera with faults counts as live; none comes up in so short a time.
        with host(self.folder / "state", self.camera + ",faults=1,faults_every=3600") as h, \
                Process("join", h.greeting["link"], "--no-window", "--every", "0.2") as viewer:
            viewer.wait_for(lambda f: f["cameras"] and f["cameras"][0]["frames"] > 3)
            first = readers_of(h.process.pid)
            os.kill(first[0], signal.SIGKILL)
            wait_until(lambda: set(readers_of(h.process.pid)) - set(first), "a new reader")
            before = viewer.newest_json()["cameras"][0]["frames"]
            viewer.wait_for(lambda f: f["cameras"][0]["frames"] > before + 10)

    def test_a_reader_ends_with_its_host(self):
        with host(self.folder / "state", self.camera) as h:
            readers = readers_of(h.process.pid)
            self.assertEqual(len(readers), 1)
            h.process.kill()
            wait_until(lambda: not pathlib.Path(f"/proc/{readers[0]}").exists(), "the reader's end")

    @unittest.skipUnless(platform.machine() == "x86_64", "the test's own filter has numbers of x86-64")
    def test_without_filters_nothing_foreign_is_read_unless_asked_for(self):
        def start(**environment):
            return patience.run(
                [PROGRAM, "host", "--listen", "127.0.0.1:0", "--state", self.folder / "state", "--camera", self.camera,
                 "--camera", self.camera, "--seconds", "0.5"],
                preexec_fn=without_filters, env={**os.environ, **environment})

        done = start()
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertIn("has no system-call filter (seccomp)", done.stderr)
        self.assertIn("kinect.mkv", done.stderr)
        done = start(THEATRON_UNFILTERED_READERS="1")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(done.stderr.count("without a system-call filter"), 1, done.stderr)


if __name__ == "__main__":
    unittest.main()
