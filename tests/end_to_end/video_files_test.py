# SPDX-License-Identifier: Apache-2.0
"""Videos as phones, cameras and capture cards write them: their colours, their shape, their turn, and their damage."""
import json
import pathlib
import shutil
import subprocess
import tempfile
import unittest

from theatron_process import read_png, run

RED = (190, 61, 29)
FRAMES = 100


def full_range(*arguments):
    """Arguments of ffmpeg for H.264 of BT.709 and full range."""
    return ["-vf", "scale=out_color_matrix=bt709:out_range=full,format=yuvj420p", "-c:v", "libx264", "-preset", "ultrafast",
            "-qp", "4", "-colorspace", "bt709", "-color_primaries", "bt709", "-color_trc", "bt709", "-color_range", "pc", *arguments]


@unittest.skipUnless(shutil.which("ffmpeg"), "without ffmpeg no videos can be made")
class VideoFiles(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="theatron_videos_"))
        self.addCleanup(shutil.rmtree, self.folder)

    def make(self, name, source, *arguments):
        path = self.folder / name
        subprocess.run(["ffmpeg", "-v", "error", "-f", "lavfi", "-i", source, *arguments, path], check=True)
        return path

    def pictures(self, video, options=""):
        """The answer of `record`, and every picture that is in the recording."""
        recording = video.with_suffix(".recording.mkv")
        code, out, errors = run("record", "--camera", f"video:{video}{options}", recording, "--color-codec", "raw", "--json")
        self.assertIn(code, (0, 3), errors)
        exported = self.folder / f"{video.name}.pictures"
        self.assertEqual(run("export", recording, "--png", exported)[0], code, "what the recording lacks, its export lacks")
        return json.loads(out), [read_png(picture) for picture in sorted((exported / "color").glob("*.png"))]

    def assert_color(self, pixel, color, what=None):
        self.assertTrue(all(abs(a - b) <= 2 for a, b in zip(pixel, color)), (pixel, color, what))

    def test_every_picture_has_the_colours_of_the_file(self):
        video = self.make("full.mp4", f"color=0x{bytes(RED).hex()}:s=320x240:r=60:d={FRAMES / 60},format=rgb24", *full_range())
        recorded, pictures = self.pictures(video)
        self.assertTrue(recorded["complete"])
        self.assertEqual(len(pictures), FRAMES)
        for n, (_, _, _, rows) in enumerate(pictures):
            self.assert_color(rows[120][3 * 160:3 * 160 + 3], RED, n)

    def test_a_turned_video_is_upright_and_pixels_are_square(self):
        upright = self.make("upright.mp4", "color=black:s=160x120:r=10:d=0.5,drawbox=w=80:h=60:c=red:t=fill", *full_range())
        turned = self.folder / "turned.mp4"
        subprocess.run(["ffmpeg", "-v", "error", "-i", upright, "-c", "copy", "-metadata:s:v", "rotate=90", turned], check=True)
        stored = json.loads(subprocess.run(["ffprobe", "-v", "error", "-show_streams", "-of", "json", turned], check=True,
                                           capture_output=True).stdout)["streams"][0]
        self.assertTrue(stored.get("side_data_list"), "this ffmpeg writes no display matrix")
        _, pictures = self.pictures(turned)
        width, height, _, rows = pictures[-1]
        self.assertEqual((width, height), (120, 160))
        # As ffmpeg itself shows it.
        shown = self.folder / "shown.png"
        subprocess.run(["ffmpeg", "-v", "error", "-i", turned, "-frames:v", "1", "-pix_fmt", "rgb24", shown], check=True)
        for y in (20, 140):
            for x in (20, 100):
                wanted = read_png(shown)[3][y][3 * x:3 * x + 3]
                self.assertTrue(all(abs(a - b) < 20 for a, b in zip(rows[y][3 * x:3 * x + 3], wanted)), (x, y))

        pal = self.make("pal.mp4", "testsrc2=s=720x576:r=10:d=0.3,setsar=16/15", *full_range())
        _, pictures = self.pictures(pal)
        self.assertEqual(pictures[-1][:2], (768, 576))

    def test_a_video_that_is_cut_off_says_so(self):
        whole = self.make("whole.mp4", "testsrc2=s=320x240:r=30:d=2", *full_range())
        content = whole.read_bytes()
        index = content.index(b"moov") - 4
        cut = self.folder / "cut.mp4"
        cut.write_bytes(content[:index + 300])
        code, _, errors = run("record", "--camera", f"video:{cut}", self.folder / "x.mkv")
        self.assertEqual(code, 1)
        self.assertRegex(errors, "cut off or damaged|damaged at its beginning|has no video track")
        self.assertNotIn("no decoder", errors)
        # The index first, then pictures that are missing at the end.
        first = self.folder / "first.mp4"
        subprocess.run(["ffmpeg", "-v", "error", "-i", whole, "-c", "copy", "-movflags", "+faststart", first], check=True)
        content = first.read_bytes()
        first.write_bytes(content[:len(content) * 2 // 3])
        recorded, pictures = self.pictures(first)
        self.assertFalse(recorded["complete"])
        self.assertGreater(recorded["cameras"][0]["lost_in_source"], 0)
        self.assertGreater(len(pictures), 10)


if __name__ == "__main__":
    unittest.main()
