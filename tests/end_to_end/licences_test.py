# SPDX-License-Identifier: Apache-2.0
"""A binary may be shipped under the Apache License: what it is linked with, what it prints, and life without FFmpeg."""
import glob
import os
import pathlib
import re
import shutil
import subprocess
import tempfile
import unittest

from theatron_process import PROGRAM, Process, host, run

CAMERA = "synthetic:seconds=2,fps=10,quality=quick,loop=1"
# A mount namespace of its own, in which FFmpeg's libraries are empty files.
HIDDEN = "for file in {}; do mount --bind /dev/null $file || exit 77; done; exec \"$@\""


def without_ffmpeg():
    """The words before a command with which it finds no FFmpeg; None where that is not possible."""
    files = [file for name in ("avutil", "avcodec", "avformat", "swscale")
             for file in glob.glob(f"/usr/lib/*/lib{name}.so.*") if not os.path.islink(file)]
    prefix = ["unshare", "--mount", "sh", "-c", HIDDEN.format(" ".join(files)), "sh"]
    works = shutil.which("unshare") and subprocess.run([*prefix, "true"], capture_output=True).returncode == 0
    return prefix if works else None


class Licences(unittest.TestCase):
    @unittest.skipUnless(shutil.which("readelf"), "readelf is not installed: apt-get install binutils")
    def test_the_program_is_linked_with_nothing_under_the_gpl(self):
        listed = subprocess.run(["readelf", "-d", PROGRAM], capture_output=True, text=True, check=True).stdout
        needed = re.findall(r"\(NEEDED\).*\[(.*)\]", listed)
        self.assertIn("libc.so.6", needed)
        for name in needed:
            self.assertNotRegex(name, r"spqr|cholmod|suitesparse|cxsparse|ceres|x264|x265|xvid|libav|libsw")

    def test_it_prints_its_licence_and_the_notices_of_what_it_contains(self):
        code, shown, _ = run("--licences")
        self.assertEqual(code, 0)
        self.assertTrue(shown.startswith("Theatron, copyright"))
        for holder in ("Omar Cornut", "University of Cincinnati", "Niels Lohmann", "Bitstream"):
            self.assertIn(holder, shown)

    def test_without_ffmpeg_a_session_runs_with_strata_and_jpeg(self):
        prefix = without_ffmpeg()
        if not prefix:
            self.skipTest("FFmpeg's libraries cannot be hidden here: needs root and unshare")
        with tempfile.TemporaryDirectory() as folder, \
             host(pathlib.Path(folder) / "host", CAMERA, prefix=prefix) as source:
            picture = pathlib.Path(folder) / "view.png"
            with Process("join", source.greeting["link"], "--color-codec", "jpeg:quality=85", "--no-window", "--json", "--every", "1",
                         prefix=prefix) as guest:
                guest.wait_for(lambda said: said.get("cameras") and said["cameras"][0].get("frames", 0) > 5)
            film = pathlib.Path(folder) / "film.mkv"
            film.write_bytes(b"\x1a\x45\xdf\xa3")
            for camera in (f"mkv:{film}", f"video:{film}"):
                done = subprocess.run([*prefix, PROGRAM, "record", "--camera", camera, str(picture)],
                                      capture_output=True, text=True, stdin=subprocess.DEVNULL)
                self.assertEqual(done.returncode, 1, done.stderr)
                self.assertRegex(done.stderr, r"FFmpeg's library libavutil\.so\.\d+ is missing .*apt install")

    def test_without_ffmpeg_h264_is_refused_with_the_reason(self):
        prefix = without_ffmpeg()
        if not prefix:
            self.skipTest("FFmpeg's libraries cannot be hidden here: needs root and unshare")
        done = subprocess.run([*prefix, PROGRAM, "join", "https://127.0.0.1:9/#join=a&cert=" + 64 * "0", "--no-window",
                               "--color-codec", "h264"],
                              capture_output=True, text=True, stdin=subprocess.DEVNULL)
        self.assertNotEqual(done.returncode, 0)
        self.assertRegex(done.stderr, r"no H\.264 decoder on this machine .*libavutil")


if __name__ == "__main__":
    unittest.main()
