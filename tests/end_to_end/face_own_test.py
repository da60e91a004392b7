# SPDX-License-Identifier: Apache-2.0
"""A person's own face: a model that is imported, photos, the face that is made of them, and its end."""
import json
import os
import pathlib
import shutil
import struct
import subprocess
import tempfile
import unittest

import patience
from theatron_process import PROGRAM, run

ICT = pathlib.Path(os.environ.get("THEATRON_FACE", "../shared/face/ict-facekit-light"))
PASSPHRASE = "a passphrase of the test"


def shapes(names, vertices, move):
    """A file of shapes in which each moves one vertex."""
    body = b"ICTFKL01" + struct.pack("<III", len(names), vertices, 0)
    for number, name in enumerate(names):
        offsets = [0] * (3 * vertices)
        offsets[3 * (number % vertices) + 1] = move
        body += struct.pack("<H", len(name)) + name.encode() + struct.pack(f"<f{3 * vertices}h", 0.001, *offsets)
    return body


def small_model(folder, side=12):
    """A folder in the layout of ICT-FaceKit Light: a bent sheet as a face, in centimetres."""
    folder.mkdir()
    lines = ["mtllib none.mtl"]
    for row in range(side):
        for column in range(side):
            x, y = 18 * column / (side - 1) - 9, 11 - 22 * row / (side - 1)
            lines.append(f"v {x:.4f} {y:.4f} {10 - x * x / 12 - y * y / 25:.4f}")
    for row in range(side):
        for column in range(side):
            lines.append(f"vt {column / (side - 1):.4f} {1 - row / (side - 1):.4f}")
    lines.append("usemtl M_Face")
    for row in range(side - 1):
        for column in range(side - 1):
            a = row * side + column + 1
            lines.append(f"f {a}/{a} {a + side}/{a + side} {a + side + 1}/{a + side + 1} {a + 1}/{a + 1}")
    (folder / "generic_neutral_mesh.obj").write_text("\n".join(lines) + "\n")
    (folder / "expressions53_i16.bin").write_bytes(shapes(["jawOpen", "eyeBlink_L", "browInnerUp_L", "browInnerUp_R"], side * side, 400))
    (folder / "identity100_i16.bin").write_bytes(shapes(["identity000", "identity001"], side * side, 200))
    landmarks = [(37 * i) % (side * side) for i in range(68)]
    (folder / "landmarks.json").write_text(json.dumps({"landmark68_multipie": landmarks}))
    return folder


class OwnFace(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="theatron_own_face_"))
        cls.passphrase = cls.folder / "passphrase"
        cls.passphrase.touch(0o600)
        cls.passphrase.write_text(PASSPHRASE + "\n")
        cls.photos = cls.folder / "photos"
        cls.drawn = run("face", "photos", cls.photos, "--seed", "3")
        cls.own = cls.folder / "me.face"
        cls.enrolled = cls.enrol(cls.own, "--json", happiness="happiness", anger="anger")

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder)

    @classmethod
    def enrol(cls, out, *options, neutral="neutral", **emotions):
        photos = ["--photo", cls.photos / f"{neutral}.jpg", "--landmarks", cls.photos / f"{neutral}.pts"]
        for emotion, name in emotions.items():
            photos += [f"--{emotion}", cls.photos / f"{name}.jpg", f"--{emotion}-landmarks", cls.photos / f"{name}.pts"]
        return run("face", "enrol", *photos, "--out", out, "--passphrase-file", cls.passphrase, *options)

    def refused(self, *arguments):
        code, output, errors = run("face", *arguments)
        self.assertEqual(code, 1, output)
        self.assertRegex(errors, r"^theatron: [^\n]+\n$")
        return errors

    def test_a_face_is_made_of_photos_shown_and_deleted(self):
        self.assertEqual(self.drawn[0], 0, self.drawn[2])
        code, output, errors = self.enrolled
        self.assertEqual(code, 0, errors)
        figures = json.loads(output)
        self.assertEqual(set(figures["residuals_px"]), {"neutral", "happiness", "anger"})
        self.assertLess(figures["residual_px"], 5)
        self.assertEqual(self.own.stat().st_mode & 0o777, 0o600)
        kept = self.own.read_bytes()
        for plain in (b"TFOWN", b"JFIF", b"\xff\xd8\xff"):
            self.assertNotIn(plain, kept)
        picture = self.folder / "faces.png"
        code, _, errors = run("face", "show", self.own, "--out", picture, "--passphrase-file", self.passphrase)
        self.assertEqual(code, 0, errors)
        self.assertGreater(picture.stat().st_size, 50_000)
        self.assertEqual(picture.stat().st_mode & 0o777, 0o600)
        gone = self.folder / "gone.face"
        shutil.copy(self.own, gone)
        code, output, errors = run("face", "delete", gone)
        self.assertEqual(code, 0, errors)
        self.assertIn("deleted", output)
        self.assertFalse(gone.exists())

    def test_it_opens_with_its_passphrase_alone(self):
        other = self.folder / "other"
        other.touch(0o600)
        other.write_text("another passphrase\n")
        picture = self.folder / "not.png"
        self.assertIn("does not open", self.refused("show", self.own, "--out", picture, "--passphrase-file", other))
        self.assertFalse(picture.exists())
        other.chmod(0o644)
        self.assertIn("chmod 600", self.refused("show", self.own, "--out", picture, "--passphrase-file", other))
        # Without a terminal nothing waits for one.
        done = patience.run([PROGRAM, "face", "show", self.own, "--out", picture], start_new_session=True,
                            stdin=subprocess.DEVNULL)
        self.assertEqual(done.returncode, 1)
        self.assertIn("--passphrase-file", done.stderr)
        other.chmod(0o600)
        other.write_text("short\n")
        code, _, errors = run("face", "enrol", "--photo", self.photos / "neutral.jpg", "--landmarks", self.photos / "neutral.pts",
                              "--out", self.folder / "short.face", "--passphrase-file", other)
        self.assertEqual(code, 1)
        self.assertIn("eight characters", errors)

    def test_mistakes_are_one_sentence_and_change_nothing(self):
        before = self.own.read_bytes()
        code, _, errors = self.enrol(self.own)
        self.assertEqual(code, 1)
        self.assertIn("--overwrite", errors)
        self.assertEqual(self.own.read_bytes(), before)
        garbage = self.folder / "garbage"
        garbage.write_bytes(b"\x00\x01garbage" * 50)
        new = self.folder / "new.face"
        shutil.copy(garbage, self.photos / "broken.jpg")
        shutil.copy(self.photos / "neutral.pts", self.photos / "broken.pts")
        code, _, errors = self.enrol(new, neutral="broken")
        self.assertEqual(code, 1)
        self.assertIn("no photo as JPEG or PNG", errors)
        shutil.copy(self.photos / "neutral.jpg", self.photos / "unmarked.jpg")
        shutil.copy(garbage, self.photos / "unmarked.pts")
        code, _, errors = self.enrol(new, neutral="unmarked")
        self.assertIn("68 landmarks", errors)
        lines = (self.photos / "neutral.pts").read_text().split("\n")
        lines[3] = "9999 9999"  # the first landmark
        (self.photos / "unmarked.pts").write_text("\n".join(lines))
        code, _, errors = self.enrol(new, neutral="unmarked")
        self.assertIn("outside of their photo", errors)
        self.assertFalse(new.exists())
        link = self.folder / "link.face"
        link.symlink_to(self.own)
        self.assertIn("is a link to", self.refused("delete", link))
        self.assertIn("is a link to", self.enrol(link, "--overwrite")[2])
        photo = (self.photos / "neutral.jpg").read_bytes()
        self.assertIn("is not a face", self.enrol(self.photos / "neutral.jpg", "--overwrite")[2])
        self.assertEqual((self.photos / "neutral.jpg").read_bytes(), photo)
        self.assertEqual(self.own.read_bytes(), before)
        self.assertIn("is no face of", self.refused("delete", garbage))
        self.assertTrue(garbage.exists())
        self.assertIn("is no face of", self.refused("show", garbage, "--out", self.folder / "x.png",
                                                    "--passphrase-file", self.passphrase))
        self.assertIn("is no morphable head", self.refused("model", "show", garbage, "--out", self.folder / "x.png"))
        self.assertIn("PNG picture", self.refused("model", "show", "--out", garbage))

    def test_a_damaged_face_does_not_open(self):
        damaged = self.folder / "damaged.face"
        kept = bytearray(self.own.read_bytes())
        kept[len(kept) // 2] ^= 1
        damaged.write_bytes(kept)
        said = self.refused("show", damaged, "--out", self.folder / "x.png", "--passphrase-file", self.passphrase)
        self.assertIn("the file was changed", said)

    def test_a_model_is_imported_and_drawn(self):
        folder = small_model(self.folder / "small")
        model = self.folder / "small.head"
        code, output, errors = run("face", "model", "import", folder, "--out", model)
        self.assertEqual(code, 0, errors)
        self.assertIn("144 vertices, 2 ways", output)
        code, _, errors = run("face", "model", "show", model, "--out", self.folder / "small.png")
        self.assertEqual(code, 0, errors)
        (folder / "landmarks.json").write_text("{}")
        self.assertIn("landmark68_multipie", self.refused("model", "import", folder, "--out", self.folder / "no.head"))
        (folder / "landmarks.json").unlink()
        self.assertIn("landmarks.json", self.refused("model", "import", folder, "--out", self.folder / "no.head"))
        self.assertFalse((self.folder / "no.head").exists())

    @unittest.skipUnless(ICT.is_dir(), "ICT-FaceKit Light is not there; docs/face.md says how to get it (THEATRON_FACE)")
    def test_ict_facekit_is_imported_and_photos_are_fitted_to_it(self):
        model, photos, own = self.folder / "ict.head", self.folder / "ict_photos", self.folder / "ict.face"
        code, output, errors = run("face", "model", "import", ICT, "--out", model)
        self.assertEqual(code, 0, errors)
        self.assertIn("100 ways in which persons differ, 53 expressions", output)
        code, _, errors = run("face", "photos", photos, "--model", model)
        self.assertEqual(code, 0, errors)
        code, output, errors = run("face", "enrol", "--photo", photos / "neutral.jpg", "--landmarks", photos / "neutral.pts",
                                   "--model", model, "--out", own, "--passphrase-file", self.passphrase, "--json")
        self.assertEqual(code, 0, errors)
        self.assertLess(json.loads(output)["residual_px"], 5)


if __name__ == "__main__":
    unittest.main()
