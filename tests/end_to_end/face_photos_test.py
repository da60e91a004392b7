# SPDX-License-Identifier: Apache-2.0
"""Photos of a person's own face: taken from a camera, and marked, in a window."""
import json
import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest

from theatron_process import PROGRAM, Process, run, wait_until
from virtual_screen import VirtualScreen

WIDTH, HEIGHT = 1280, 720
ASKED = (36, 39, 42, 45, 30, 48, 54, 8)  # the landmarks that a person clicks on, in their order
PICTURES = os.environ.get("THEATRON_PICTURES")
MODEL = pathlib.Path("/usr/share/dlib/shape_predictor_68_face_landmarks.dat")
HELPER = pathlib.Path(PROGRAM).parent / "theatron-landmarks"


def landmarks(file):
    return [tuple(map(float, line.split())) for line in file.read_text().splitlines()[3:71]]


def distance(one, other):
    return sum(((a - c) ** 2 + (b - d) ** 2) ** 0.5 for (a, b), (c, d) in zip(one, other)) / len(one)


class FacePhotos(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="theatron_face_photos_"))
        cls.passphrase = cls.folder / "passphrase"
        cls.passphrase.touch(0o600)
        cls.passphrase.write_text("a passphrase of the test\n")
        cls.photos = cls.folder / "photos"
        code, _, errors = run("face", "photos", cls.photos, "--seed", "3", "--noise-px", "0")
        assert code == 0, errors
        # No model of landmarks is there, as for most people: they are marked by hand.
        cls.none = ("--landmark-model", cls.folder / "none.dat")

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder)

    def begin(self, screen, *arguments, title="Your own face"):
        process = Process("face", *arguments, env={**screen.environment})
        self.addCleanup(process.process.kill)
        wait_until(lambda: title in screen.title(), of=process)
        return process

    def mark(self, screen, photo, size):
        """Clicks on the eight places of a photo that fits beside the panel, as the window places it."""
        free = WIDTH * 0.64
        scale = min(free / size[0], HEIGHT / size[1])
        left, top = WIDTH - free + (free - scale * size[0]) / 2, (HEIGHT - scale * size[1]) / 2
        truth = landmarks(photo.with_suffix(".pts"))
        wait_until(lambda: screen.buttons(WIDTH, HEIGHT))  # "Undo": the photo is shown and can be marked
        for landmark in ASKED:
            x, y = truth[landmark]
            place = round(left + scale * x), round(top + scale * y)
            screen.do("mousemove", *place, "click", 1)
            # The landmark is drawn where it was put.
            wait_until(lambda: screen.has((255, 200, 70), 5, place[0] - 4, place[1] - 4, 9, 9))
        return truth

    def test_no_output_replaces_a_photo_a_pipe_or_a_foreign_file(self):
        photo = self.folder / "own.jpg"
        shutil.copy(self.photos / "neutral.jpg", photo)
        before = photo.read_bytes()
        pipe, notes = self.folder / "pipe", self.folder / "notes.txt"
        os.mkfifo(pipe)
        notes.write_text("of somebody")
        for out in (photo, pipe, notes):
            code, _, errors = run("face", "landmarks", photo, "--out", out, "--overwrite", *self.none)
            self.assertNotEqual(code, 0)
            self.assertIn(str(out), errors)
        code, _, errors = run("face", "enrol", "--photo", photo, "--out", pipe, "--overwrite",
                              "--passphrase-file", self.passphrase, *self.none)
        self.assertNotEqual(code, 0)
        self.assertIn("pipe", errors)
        self.assertTrue(pipe.is_fifo())
        self.assertEqual(photo.read_bytes(), before)
        self.assertEqual(notes.read_text(), "of somebody")

    def save(self, screen, name):
        if PICTURES:
            screen.save(pathlib.Path(PICTURES) / f"{name}.png", WIDTH, HEIGHT)

    def test_eight_clicks_make_the_landmarks_of_a_photo(self):
        out = self.folder / "marked.pts"
        photo = self.photos / "neutral.jpg"
        with VirtualScreen(WIDTH, HEIGHT) as screen:
            process = self.begin(screen, "landmarks", photo, "--mark", "--out", out, *self.none)
            process.wait_for_error("You mark eight places")
            truth = self.mark(screen, photo, (960, 1080))
            self.save(screen, "face_marked")
            screen.do("key", "Return")
            wait_until(process.has_ended, of=process)
        self.assertEqual(process.process.returncode, 0, process.errors)
        self.assertEqual(out.stat().st_mode & 0o777, 0o600)
        # The face is 290 px wide.
        self.assertLess(distance(landmarks(out), truth), 12)

    def test_a_camera_takes_the_photos_and_two_make_a_face(self):
        out = self.folder / "camera.face"
        film = self.folder / "film.mkv"
        subprocess.run(["ffmpeg", "-loglevel", "error", "-loop", "1", "-framerate", "15", "-i", self.photos / "neutral.jpg",
                        "-t", "4", "-vf", "scale=960:1080", "-pix_fmt", "yuv420p", film], check=True)
        photo = self.photos / "neutral.jpg"
        with VirtualScreen(WIDTH, HEIGHT) as screen:
            process = self.begin(screen, "enrol", "--camera", film, "--out", out, "--passphrase-file", self.passphrase, "--json", *self.none)
            wait_until(lambda: screen.buttons(WIDTH, HEIGHT), of=process)  # "Take the photo", once there is a picture
            self.save(screen, "face_camera")
            for last in (False, True):
                # Return takes the photo, and the picture stands still with its question.
                screen.do("key", "Return")
                wait_until(lambda: self.is_marking(screen), of=process)
                self.mark(screen, photo, (960, 1080))
                self.save(screen, "face_of_camera")
                if not last:
                    screen.do("key", "Return")
                    wait_until(lambda: not self.is_marking(screen), of=process)
            finish = screen.buttons(WIDTH, HEIGHT)[-1]  # "No more photos"
            screen.do("mousemove", *finish, "click", 1)
            # Four emotions have no photo: "Make the face now" or "Go on with photos".
            wait_until(lambda: len(screen.buttons(WIDTH, HEIGHT)) == 2, of=process)
            self.save(screen, "face_enough")
            self.assertFalse(process.has_ended())
            screen.do("key", "Return")
            wait_until(process.has_ended, of=process)
        self.assertEqual(process.process.returncode, 0, process.errors)
        made = json.loads(process.last_line)
        self.assertEqual(set(made["residuals_px"]), {"neutral", "happiness"})
        self.assertLess(made["residuals_px"]["neutral"], 12)
        self.assertGreater(made["seen_share"], 0.2)
        self.assertEqual(out.stat().st_mode & 0o777, 0o600)
        # Neither photos nor landmarks are kept beside the sealed face.
        self.assertEqual(sorted(file.name for file in self.folder.iterdir()), ["camera.face", "film.mkv", "passphrase", "photos"] if
                         not (self.folder / "marked.pts").exists() else ["camera.face", "film.mkv", "marked.pts", "passphrase", "photos"])

    @staticmethod
    def is_marking(screen):
        """The first row of buttons is "Take it again" and "Undo", perhaps behind "Keep it": only marking has more than one there."""
        buttons = screen.buttons(WIDTH, HEIGHT)
        return sum(abs(y - buttons[0][1]) < 10 for _, y in buttons) > 1 if buttons else False

    def test_leaving_keeps_nothing(self):
        out = self.folder / "left.face"
        with VirtualScreen(WIDTH, HEIGHT) as screen:
            process = self.begin(screen, "enrol", "--photo", self.photos / "neutral.jpg", "--mark", "--out", out,
                                 "--passphrase-file", self.passphrase, "--language", "de", "--size", "800x600", *self.none, title="Ihr eigenes Gesicht")
            screen.do("key", "Escape", "key", "Escape")
            wait_until(process.has_ended, of=process)
        self.assertEqual(process.process.returncode, 1)
        self.assertIn("nothing was written", "".join(process.errors))
        self.assertFalse(out.exists())

    def test_landmarks_that_are_no_faces_are_refused(self):
        right = landmarks(self.photos / "neutral.pts")
        wrong = {
            "exchanged": [(960 - x, y) for x, y in right],
            "head": [(960 - x, 1080 - y) for x, y in right],
            "too small": [(400 + x / 50, 400 + y / 50) for x, y in right],
            "not lie as on a face": [(480, 540)] * 68,
            "outside": [(x + 900, y) for x, y in right],
        }
        for word, points in wrong.items():
            with self.subTest(word):
                file = self.folder / "wrong.pts"
                file.write_text("version: 1\nn_points: 68\n{\n" + "".join(f"{x} {y}\n" for x, y in points) + "}\n")
                code, _, errors = run("face", "enrol", "--photo", self.photos / "neutral.jpg", "--landmarks", file,
                                      "--out", self.folder / "wrong.face", "--passphrase-file", self.passphrase)
                file.unlink()
                self.assertEqual(code, 1)
                self.assertIn(word, errors)
                self.assertIn("wrong.pts", errors)
        self.assertFalse((self.folder / "wrong.face").exists())

    def test_without_a_display_the_other_way_is_said(self):
        code, _, errors = run("face", "landmarks", self.photos / "neutral.jpg", "--mark", "--out", self.folder / "x.pts",
                              *self.none, env={**os.environ, "DISPLAY": "", "WAYLAND_DISPLAY": ""})
        self.assertEqual(code, 1)
        self.assertIn("no display", errors)
        self.assertIn(".pts", errors)
        self.assertNotIn("--offscreen", errors)

    def test_what_cannot_be_found_is_said(self):
        photo = self.photos / "neutral.jpg"
        for arguments, sentence in (
                (("landmarks", photo, "--out", self.folder / "x.pts", *self.none), "--mark"),
                (("enrol", "--photo", photo, "--out", self.folder / "x.face", "--passphrase-file", self.passphrase, *self.none), "--mark"),
                (("enrol", "--out", self.folder / "x.face"), "--camera or --photo"),
                (("enrol", "--camera", "/dev/none", "--out", self.folder / "x.face", "--passphrase-file", self.passphrase), "/dev/none"),
                (("enrol", "--camera", "/dev/none", "--photo", photo, "--out", self.folder / "x.face"), "--photo"),
                (("enrol", "--happiness", photo, "--out", self.folder / "x.face"), "--photo")):
            with self.subTest(sentence=sentence, arguments=arguments[:2]):
                code, output, errors = run("face", *arguments)
                self.assertNotEqual(code, 0, output)
                self.assertIn(sentence, errors)
        self.assertEqual(list(self.folder.glob("x.*")), [])

    @unittest.skipUnless(HELPER.exists(), "theatron-landmarks is not built: install libdlib-dev")
    def test_a_file_that_is_no_model_is_said(self):
        other = self.folder / "photos" / "neutral.pts"
        code, _, errors = run("face", "landmarks", self.photos / "neutral.jpg", "--landmark-model", other, "--out", self.folder / "y.pts")
        self.assertEqual(code, 1)
        self.assertIn("is no model of 68 landmarks", errors)

    @unittest.skipUnless(HELPER.exists() and MODEL.exists(), "no model of landmarks: install libdlib-dev and libdlib-data")
    def test_landmarks_are_found_where_the_model_is(self):
        out = self.folder / "found.pts"
        code, _, errors = run("face", "landmarks", self.photos / "neutral.jpg", "--out", out)
        self.assertEqual(code, 0, errors)
        self.assertIn("excludes commercial use", errors)
        # The drawn person is simpler than those from whom the model learned.
        self.assertLess(distance(landmarks(out), landmarks(self.photos / "neutral.pts")), 30)


if __name__ == "__main__":
    unittest.main()
