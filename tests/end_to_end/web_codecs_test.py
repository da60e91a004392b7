# SPDX-License-Identifier: Apache-2.0
"""The depth codecs of the web build: under node on what the native encoders wrote, and in the page as its link says."""
import contextlib
import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest

from browser import CHROMIUM, Browser
from theatron_process import PROGRAM, host

PAGE = pathlib.Path(PROGRAM).parent / "web/files.txt"
DECODERS = pathlib.Path(__file__).resolve().parents[2] / "build/web/tests/web/read_payloads.js"
WRITE_PAYLOADS = os.environ.get("THEATRON_WRITE_PAYLOADS", "build/release/tests/slow_decoders/write_payloads")
NODE = shutil.which("node")
SIZE = (320, 180)
CAMERA = "theatron.state.cameras?.[0]?"

try:
    MISSING = PAGE.with_name("missing.txt").read_text().split(", ")
except FileNotFoundError:
    MISSING = []
HAS_ALL = not {"libzstd", "lz4"} & set(MISSING)


@unittest.skipUnless(NODE and DECODERS.exists(), "there is no web build: cmake --preset web && cmake --build --preset web")
class UnderNode(unittest.TestCase):
    def test_every_portable_codec_decodes_as_natively_and_survives_damage(self):
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run([WRITE_PAYLOADS, folder], check=True)
            done = subprocess.run([NODE, "--no-experimental-fetch", DECODERS, folder], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stdout[-2000:] + done.stderr[-2000:])
        counts = {codec: int(frames) for _, codec, frames in (line.split() for line in done.stdout.splitlines())}
        expected = {"raw", "rvl", "trvl", "ans", "strata"} | ({"zstd", "lz4"} if HAS_ALL else set())
        self.assertEqual(set(counts), expected)
        self.assertGreater(min(counts.values()), 5)


@unittest.skipUnless(CHROMIUM, "chromium is not installed: apt-get install chromium")
@unittest.skipUnless(PAGE.exists(), "there is no browser client: make build")
@unittest.skipUnless(HAS_ALL, "the page was built without zstd and lz4, whose sources could not be fetched")
class InThePage(unittest.TestCase):
    def test_it_shows_the_notices_of_its_libraries(self):
        notices = next(PAGE.parent.glob("licences.*.txt")).read_text()
        for holder in ("Yann Collet", "Meta Platforms", "Xiph.Org", "nlohmann", "musl", "libhwy-dev"):
            self.assertIn(holder, notices)

    def test_the_link_and_the_key_choose_a_codec(self):
        with contextlib.ExitStack() as stack:
            folder = pathlib.Path(stack.enter_context(tempfile.TemporaryDirectory()))
            source = stack.enter_context(host(folder / "host", "synthetic:seconds=2,fps=10,quality=quick,color=off,loop=1"))
            browser = stack.enter_context(Browser())

            def comes(page, codec):
                # On a machine under load the host adds layers to the codec that it chose itself.
                is_shown = f"({CAMERA}.depth === '{codec}' || {CAMERA}.depth?.startsWith('{codec}:layers='))"
                page.wait_for(is_shown)
                before = page.evaluate(f"{CAMERA}.depth_frames")
                page.wait_for(f"{is_shown} && {CAMERA}.depth_frames > {before + 5}")
                self.assertEqual(page.evaluate(f"{CAMERA}.decoder_failures"), 0)

            page = browser.open(source.greeting["link"] + "&depth=zstd:delta=1,layers=2", SIZE)
            page.enter(way="room")
            comes(page, "zstd:delta=1,layers=2")
            page.evaluate("document.getElementById('view').dispatchEvent(new KeyboardEvent('keydown', { key: 'c', code: 'KeyC', bubbles: true }))")
            comes(page, "lz4")
            self.assertEqual(page.problems, [])
            page.close()  # it would draw on, and take the processor from the next one
            page = browser.open(source.greeting["link"] + "&depth=zstf", SIZE)
            page.enter(way="room")
            page.wait_for("document.body.textContent.includes('does not exist')")
            comes(page, "strata")


if __name__ == "__main__":
    unittest.main()
