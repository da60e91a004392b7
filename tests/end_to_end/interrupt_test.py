# SPDX-License-Identifier: Apache-2.0
"""Ctrl-C at moments at which the program is busy with something else."""
import os
import pathlib
import shutil
import signal
import subprocess
import tempfile
import unittest

import patience
from slow_disk import SlowDisk
from theatron_process import PROGRAM, make_recording, wait_until


def children_of(pid):
    return [int(child) for path in pathlib.Path(f"/proc/{pid}/task").glob("*/children")
            for child in path.read_text().split()]


def runs(pid):
    try:
        return pathlib.Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()[0] != "Z"
    except OSError:
        return False


class Interrupt(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="theatron_e2e_"))
        self.addCleanup(shutil.rmtree, self.folder)

    def start(self, *words, environment=None):
        process = subprocess.Popen([PROGRAM, *map(str, words)], stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                                   stderr=subprocess.PIPE, text=True, env=environment)

        def end():
            process.kill()
            process.wait()
            process.stderr.close()
        self.addCleanup(end)
        return process

    def test_while_the_generated_room_is_drawn(self):
        cache = self.folder / "cache"
        host = self.start("host", "--state", self.folder / "state", "--listen", "127.0.0.1:0", "--camera",
                          f"synthetic:room,cache={cache}")
        wait_until(lambda: any(cache.glob("*.part")), of=host)
        host.send_signal(signal.SIGINT)
        _, errors = patience.finish(host)
        self.assertEqual(host.returncode, 1, errors)
        self.assertIn("Stopped", errors)
        self.assertEqual(list(cache.glob("*")), [])

    def test_a_measurement_leaves_nobody_behind(self):
        camera = f"folder:{make_recording(self.folder / 'box')},loop=1"
        bench = self.start("bench", "pipeline", "--camera", camera, "--seconds", 60)
        wait_until(lambda: len(children_of(bench.pid)) == 2, of=bench)
        children = children_of(bench.pid)
        os.kill(bench.pid, signal.SIGINT)
        patience.end_of(bench)
        wait_until(lambda: not any(map(runs, children)))

    def test_while_a_case_is_imported(self):
        source, made = self.folder / "source", self.folder / "cases"
        source.mkdir()
        made.mkdir()
        triangle = "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 40 0 0\nvertex 0 40 0\nendloop\nendfacet\n"
        for i in range(200):
            (source / f"part_{i}.stl").write_text(f"solid a\n{triangle}endsolid\n")
        importing = self.start("case", "import", source, made / "liver")
        wait_until(lambda: any(made.iterdir()), of=importing)
        importing.send_signal(signal.SIGINT)
        _, errors = patience.finish(importing)
        self.assertEqual(importing.returncode, 1, errors)
        self.assertIn("Stopped before the case was complete; nothing of it was kept.", errors)
        self.assertEqual(list(made.iterdir()), [])

    def test_while_a_recording_is_exported(self):
        recording, disk = self.folder / "a.mkv", SlowDisk(self.folder)
        box = make_recording(self.folder / "box", width=640, height=576, frames=40, color=False)
        subprocess.run([PROGRAM, "record", recording, "--camera", f"folder:{box}"], check=True, stdout=subprocess.DEVNULL,
                       stderr=subprocess.DEVNULL)
        for form, place, begun in (("--png", "png", "png/depth/00000.png"), ("--ply", "ply", "ply/00000.ply"),
                                   ("--k4a", "a.mkv", "a.part.mkv")):
            with self.subTest(form):
                # Each write takes a while, so that the signal comes before the end.
                disk.be("slow 100")
                export = self.start("export", recording, form, disk.folder / place, environment=disk.environment)
                wait_until(lambda: (disk.folder / begun).exists(), of=export)
                export.send_signal(signal.SIGTERM)
                _, errors = patience.finish(export)
                self.assertEqual(export.returncode, 1, errors)
                self.assertIn("Stopped before the end of the recording", errors)
                self.assertEqual([path for path in disk.folder.rglob("*.part*")] + list(disk.folder.glob("*.mkv")), [])
                disk.be("well")
                again = subprocess.run([PROGRAM, "export", recording, form, disk.folder / place, "--overwrite"],
                                       capture_output=True, text=True)
                self.assertEqual(again.returncode, 0, again.stderr)


if __name__ == "__main__":
    unittest.main()
