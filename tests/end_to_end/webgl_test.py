# SPDX-License-Identifier: Apache-2.0
"""The renderers as WebGL 2 in a browser: the pictures are those of the native build."""
import pathlib
import re
import shutil
import tempfile
import unittest

import patience

ROOT = pathlib.Path(__file__).resolve().parents[2]
PAGE = ROOT / "build/web/tests/web/golden_page.html"
GOLDEN = ROOT / "tests/golden"
BROWSER = shutil.which("chromium")


def read_golden(renderer):
    magic, size, depth, pixels = (GOLDEN / f"render_{renderer}.ppm").read_bytes().split(b"\n", 3)
    assert (magic, depth) == (b"P6", b"255")
    return size.decode(), pixels


@unittest.skipUnless(BROWSER, "chromium is not installed: apt-get install chromium")
@unittest.skipUnless(PAGE.exists() and PAGE.with_suffix(".js").exists(),
                     "there is no web build: cmake --preset web && cmake --build --preset web")
class WebGl(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        with tempfile.TemporaryDirectory(prefix="theatron_browser_") as profile:
            page = patience.run(
                [BROWSER, "--headless=new", "--no-sandbox", "--disable-dev-shm-usage",
                 "--use-gl=angle", "--use-angle=gles-egl", "--ignore-gpu-blocklist",
                 f"--user-data-dir={profile}", "--timeout=60000", "--dump-dom", PAGE.as_uri()])
        result = re.search(r'<pre id="result">(.*?)</pre>', page.stdout, re.DOTALL)
        assert result, page.stdout[-2000:] + page.stderr[-2000:]
        cls.lines = result.group(1).splitlines()
        cls.pictures = {}
        for line in cls.lines:
            if line.startswith("picture "):
                _, name, width, height, pixels = line.split()
                cls.pictures[name] = (f"{width} {height}", bytes.fromhex(pixels))

    def test_no_shader_fails_and_no_gl_error_is_raised(self):
        self.assertEqual([line for line in self.lines if line.startswith("problem")], [])

    def test_every_picture_is_the_golden_one(self):
        names = sorted(file.stem.removeprefix("render_") for file in GOLDEN.glob("render_*.ppm"))
        self.assertEqual(sorted(self.pictures), names)
        for name in names:
            with self.subTest(renderer=name):
                size, drawn = self.pictures[name]
                golden_size, golden = read_golden(name)
                self.assertEqual(size, golden_size)
                differences = [abs(a - b) for a, b in zip(drawn, golden)]
                # As in golden_test.cpp: drivers may round differently.
                self.assertLess(sum(differences) / len(differences), 2.5)
                outliers = sum(sum(differences[i:i + 3]) > 60 for i in range(0, len(differences), 3))
                self.assertLess(outliers, len(differences) // 3 // 25)


if __name__ == "__main__":
    unittest.main()
