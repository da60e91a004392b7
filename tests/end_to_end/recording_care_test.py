# SPDX-License-Identifier: Apache-2.0
"""Recordings that are damaged, joined or in the way, and output that cannot be written: each is said."""
import json
import pathlib
import shutil
import signal
import struct
import subprocess
import tempfile
import unittest

from theatron_process import PROGRAM, Process, host, make_recording, run, wait_until

FRAMES = 6
DEAD_LINK = "https://127.0.0.1:9/#join=0123456789abcdef0123456789abcdef&cert=" + "0" * 64


def headers_in(content, stream):
    """Where the media headers of a stream stand in a recording's file."""
    at = content.find(b"\xa5\xc0\x01")
    while at >= 0:
        if struct.unpack_from("<H", content, at + 2 + 4)[0] == stream:
            yield at + 2
        at = content.find(b"\xa5\xc0\x01", at + 1)


class RecordingCare(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="theatron_e2e_"))
        self.source = make_recording(self.folder / "source", 160, 120, FRAMES)
        self.camera = f"folder:{self.source}"

    def tearDown(self):
        shutil.rmtree(self.folder)

    def record(self, name, *arguments):
        path = self.folder / name
        code, out, errors = run("record", "--camera", self.camera, path, "--json", *arguments)
        self.assertIn(code, (0, 3), errors)  # a busy machine passes over pictures
        return path, json.loads(out)["cameras"][0]

    def damage_payloads(self, path, stream, count):
        """Flips a bit in the encoded pictures of a stream."""
        content = bytearray(path.read_bytes())
        for at in list(headers_in(content, stream))[-count:]:
            size = struct.unpack_from("<I", content, at + 20)[0]
            content[content.rfind(b"\x75\xa1", 0, at) - size // 2] ^= 1
        path.write_bytes(content)

    def test_a_played_file_is_recorded_whole_at_any_rate_and_again(self):
        frames = 90
        source = make_recording(self.folder / "fast", 160, 120, frames)
        camera, seen = f"folder:{source},fps=240,preload=0", []
        for name in ("a.mkv", "b.mkv"):
            path = self.folder / name
            code, out, errors = run("record", "--camera", camera, path, "--json")
            recorded = json.loads(out)["cameras"][0]
            self.assertEqual((recorded["depth"]["pictures"], recorded["color"]["pictures"]), (frames, frames))
            self.assertEqual((code, recorded["lost_in_source"], recorded["not_encoded"]), (0, 0, 0), errors)
            code, out, errors = run("export", path, "--png", self.folder / f"{name}.png", "--json")
            self.assertEqual(code, 0, errors)
            times = (self.folder / f"{name}.png" / "times.csv").read_text().splitlines()[1:]
            seen.append([float(line.split(",")[1]) for line in times])
            camera = f"recording:{path}"
        self.assertEqual(len(seen[0]), frames)
        for first, again in zip(*seen):
            self.assertAlmostEqual(first, again, delta=0.0005)
            self.assertAlmostEqual(first, seen[0].index(first) / 240, delta=0.0005)

    def test_pictures_that_a_folder_cannot_give_are_missing(self):
        whole = (self.source / "depth" / "00002.png").read_bytes()
        (self.source / "depth" / "00002.png").write_bytes(whole[:len(whole) // 2])
        (self.source / "color" / "00004.png").write_bytes(b"no picture")
        code, out, errors = run("record", "--camera", self.camera, self.folder / "a.mkv", "--json")
        recorded = json.loads(out)
        self.assertEqual((code, recorded["complete"]), (3, False), errors)
        self.assertEqual(recorded["cameras"][0]["lost_in_source"], 2)
        self.assertEqual(recorded["cameras"][0]["depth"]["pictures"], FRAMES - 1)
        self.assertIn("a picture is damaged and left out", errors)
        self.assertIn("2 pictures are lost", errors)

    def test_a_camera_that_plays_a_damaged_recording_says_how_many_pictures_are_lost(self):
        path, recorded = self.record("a.mkv", "--depth-codec", "rvl")
        self.damage_payloads(path, 0, 2)
        camera = f"recording:{path},loop=1"
        with host(self.folder / "state", camera) as h:
            def status():
                code, out, errors = run("status", h.greeting["link"], "--json")
                self.assertEqual(code, 0, errors)
                seen = json.loads(out)["cameras"][0]
                return seen if seen["lost_pictures"] == 2 else None
            seen = wait_until(status)
            self.assertEqual(seen["problem"], "Its recording is damaged: 2 pictures are lost.")
            wait_until(lambda: any("has a problem" in line for line in list(h.errors)))
            with Process("join", h.greeting["link"], "--no-window", "--seconds", 20) as viewer:
                wait_until(lambda: any("Its recording is damaged" in line for line in list(viewer.errors)))
        code, out, errors = run("record", "--camera", f"recording:{path}", self.folder / "b.mkv", "--json")
        self.assertEqual(code, 3, errors)
        self.assertIn("Its recording is damaged: 2 pictures are lost.", errors)
        self.assertEqual(json.loads(out)["cameras"][0]["lost_in_source"], 2)
        self.assertEqual(json.loads(out)["cameras"][0]["depth"]["pictures"], recorded["depth"]["pictures"] - 2)

    def test_colour_without_depth_beside_it_is_verified_too(self):
        path, recorded = self.record("a.mkv")
        content = bytearray(path.read_bytes())
        for at in headers_in(content, 0):
            content[at + 12] ^= 1
        path.write_bytes(content)
        code, out, errors = run("inspect", path, "--verify", "--json")
        self.assertEqual(code, 3, errors)
        camera = json.loads(out)["cameras"][0]
        self.assertEqual(camera["depth"]["frames"], 0)
        self.assertEqual(sum(m["color"]["pictures"] for m in camera["minutes"]), recorded["color"]["pictures"])
        self.damage_payloads(path, 1, 1)
        camera = json.loads(run("inspect", path, "--verify", "--json")[1])["cameras"][0]
        self.assertEqual(sum(m["color"]["damaged"] for m in camera["minutes"]), 1)

    def test_a_recording_whose_end_was_cut_says_so_wherever_it_is_used(self):
        path, _ = self.record("a.mkv", "--depth-codec", "rvl")
        content = path.read_bytes()
        path.write_bytes(content[:len(content) // 2])
        code, out, _ = run("inspect", path, "--verify")
        self.assertEqual(code, 3)
        self.assertIn("it was not closed: 0.", out)
        self.assertIn(" s may be missing", out)
        self.assertGreater(json.loads(run("inspect", path, "--json")[1])["segments"][0]["missing_end_seconds"], 0)
        code, out, errors = run("record", "--camera", f"recording:{path}", self.folder / "b.mkv", "--json")
        self.assertIn("it was not closed", errors)
        self.assertIn(f"The recording '{path}' was not closed: ", errors)
        self.assertEqual((code, json.loads(out)["complete"]), (3, False))
        code, _, errors = run("export", path, "--png", self.folder / "png")
        self.assertIn("it was not closed", errors)
        self.assertEqual(code, 3)
        code, _, errors = run("recover", path)
        self.assertIn("recovered from a recording of which this was said: it was not closed",
                      run("inspect", self.folder / "a.recovered.mkv", "--verify")[1])

    def test_an_export_never_mixes_with_an_earlier_one(self):
        path, _ = self.record("a.mkv")
        folder, points = self.folder / "png", self.folder / "points"
        for _ in range(2):
            code, _, errors = run("export", path, "--png", folder, "--ply", points)
        self.assertEqual((code, errors.count("\n")), (1, 1), errors)
        self.assertIn("holds an export already", errors)
        (folder / "notes.txt").write_text("mine")
        left_over = folder / "depth" / "00999.png"
        left_over.write_bytes(b"of a longer recording")
        code, _, errors = run("export", path, "--png", folder, "--overwrite")
        self.assertEqual(code, 0, errors)
        self.assertFalse(left_over.exists())
        self.assertTrue((folder / "notes.txt").exists() and (folder / "depth" / "00000.png").exists())

    def test_files_that_were_joined_are_recovered_without_damage(self):
        path, recorded = self.record("a.mkv")
        other, _ = self.record("b.mkv")
        joined = self.folder / "joined.mkv"
        joined.write_bytes(path.read_bytes() + other.read_bytes() + path.read_bytes())
        code, out, errors = run("recover", joined, "--json")
        self.assertEqual(code, 3, errors)
        saved = json.loads(out)
        self.assertEqual((saved["foreign_files"], saved["cameras"][0]["depth"]["saved"]),
                         (2, recorded["depth"]["pictures"]))
        code, _, errors = run("inspect", saved["files"][0], "--verify")
        self.assertEqual(code, 0, errors)
        said = run("recover", joined, self.folder / "again.mkv")[1]
        self.assertIn(f"another recording begins at byte {path.stat().st_size} of its file", said)
        self.assertIn("1 more file behind it", said)
        # The command that it names gets the other one.
        command = said.split("to get it: ")[1].split(";")[0]
        subprocess.run(command, shell=True, check=True, cwd=self.folder)
        self.assertEqual((self.folder / "other.mkv").read_bytes(), other.read_bytes())

    def test_what_is_wrong_beside_the_pictures_is_named_and_not_called_damaged_pictures(self):
        path, recorded = self.record("a.mkv")
        self.record("b.mkv")
        (self.folder / "b.mkv").rename(self.folder / "a.002.mkv")
        content = bytearray(path.read_bytes())
        content[1] ^= 1
        path.write_bytes(content)
        code, out, errors = run("inspect", path, "--verify")
        self.assertEqual(code, 3, errors)
        for text in ("its beginning or a copy of that is damaged", "a.002.mkv' lies beside it, but does not continue",
                     "every picture was decoded, but a file is not as it was recorded"):
            self.assertIn(text, out)
        with host(self.folder / "state", f"recording:{path},loop=1") as h:
            wait_until(lambda: any("lies beside it, but does not continue" in line for line in list(h.errors)))
            errors = " ".join(h.errors)
        self.assertIn("no picture is lost by this", errors)
        self.assertNotIn("missing", errors)

    def test_recording_waits_for_a_host_as_long_as_it_is_told(self):
        code, _, errors = run("record", DEAD_LINK, self.folder / "x.mkv", "--wait", 2)
        self.assertEqual(code, 1)
        self.assertIn("Waiting for the host, up to 2 s", errors)
        self.assertIn("theatron: No host answers", errors)
        file = self.folder / "lost.mkv"
        with host(self.folder / "state", self.camera + ",loop=1") as h:
            with Process("record", h.greeting["link"], file, "--json", "--wait", 2) as recorder:
                wait_until(lambda: file.exists() and file.stat().st_size > 20_000)
                h.process.kill()
                h.process.wait()
                self.assertFalse(recorder.read_json()["complete"])
                self.assertEqual(recorder.end(), 3)
                self.assertIn("did not come back within 2 s", "".join(recorder.errors))

    def test_a_recording_that_is_replaced_goes_with_all_its_segments(self):
        file, second = self.folder / "a.mkv", self.folder / "a.002.mkv"
        camera = ("--camera", self.camera + ",loop=1")
        with Process("record", *camera, file, "--json") as recorder:
            wait_until(lambda: file.exists() and file.stat().st_size > 20_000)
            renamed = self.folder / "renamed.mkv"
            file.rename(renamed)
            wait_until(lambda: second.exists() and second.stat().st_size > 20_000)
            recorder.send(signal.SIGINT)
            recorder.end()
        code, out, errors = run("inspect", second, "--json")
        self.assertEqual((code, json.loads(out)["missing_segments"]), (0, 0), errors)
        self.assertIn("the recording begins in " + str(renamed), run("inspect", second)[1])
        (self.folder / "elsewhere").mkdir()
        elsewhere = renamed.rename(self.folder / "elsewhere" / "kept.mkv")
        self.assertIn("1 segment is missing", run("inspect", second)[1])
        self.assertIn("1 segment is missing", run("inspect", elsewhere)[1])
        elsewhere.rename(file)
        self.assertIn("the recording begins in " + str(file), run("inspect", second)[1])
        run("record", *camera, file, "--seconds", 1, "--overwrite")
        self.assertFalse(second.exists())

    def test_no_output_replaces_a_recording(self):
        path, _ = self.record("a.mkv")
        link = self.folder / "link.mkv"
        link.symlink_to(path)
        before = path.read_bytes()
        (self.folder / "earlier.mkv").write_bytes(b"kept")
        state = self.folder / "state"
        for arguments, says in (
                (("export", path, "--room", path, "--overwrite"), "has no room"),
                (("export", path, "--k4a", path, "--overwrite"), "is read"),
                (("export", path, "--k4a", link, "--overwrite"), "is read"),
                (("export", path, "--k4a", self.folder / "earlier.mkv", "--overwrite"), "Azure Kinect"),
                (("join", DEAD_LINK, "--offscreen", path), "not a PNG picture"),
                (("join", DEAD_LINK, "--depth", path), "not a PNG picture"),
                (("host", "--camera", self.camera, "--state", state, "--summary", path), "not a summary"),
                (("host", "--camera", self.camera, "--state", state, "--audit", path), "not an audit log")):
            with self.subTest(arguments=arguments):
                code, _, errors = run(*arguments)
                self.assertEqual(code, 1, errors)
                self.assertIn(says, errors)
                self.assertEqual(path.read_bytes(), before)
        self.assertEqual((self.folder / "earlier.mkv").read_bytes(), b"kept")
        self.assertEqual([p.name for p in self.folder.glob("*part*")], [])

    def test_a_second_host_on_one_state_folder_is_refused(self):
        with host(self.folder / "state", self.camera + ",loop=1") as h:
            code, _, errors = run("host", "--listen", "127.0.0.1:0", "--state", self.folder / "state", "--camera",
                                  self.camera)
            self.assertEqual(code, 1)
            self.assertIn(f"Another host (process {h.process.pid}) uses the state folder", errors)
        with host(self.folder / "state", self.camera + ",loop=1"):
            pass  # the first one was killed

    def test_what_cannot_be_written_is_said(self):
        path, _ = self.record("a.mkv")
        for command in (("inspect", path), ("inspect", path, "--json"), ("cameras", "--json"),
                        ("export", path, "--png", self.folder / "p", "--json")):
            with open("/dev/full", "w") as full:
                done = subprocess.run([PROGRAM, *map(str, command)], stdout=full, stderr=subprocess.PIPE, text=True)
            self.assertEqual(done.returncode, 1, command)
            self.assertIn("could not be written", done.stderr)
        long_name = self.folder / ("x" * 300 + ".mkv")
        for command, part in (
                (("record", "--camera", self.camera, long_name), "is too long: it may have 250 bytes"),
                (("record", "--camera", self.camera, "-dash.mkv"), "write './-dash.mkv'"),
                (("join", DEAD_LINK, "--max-mbit", "nan"), "not a number of megabits"),
                (("join", DEAD_LINK, "--offscreen", self.folder / "z.jpg"), "ending .png"),
                (("join", DEAD_LINK, "--offscreen", "/nowhere/z.png"), "Cannot write '/nowhere/z.png'"),
                (("host", "--camera", self.camera, "--summary", "/nowhere/s.json"), "Cannot write '/nowhere/s.json'")):
            code, _, errors = run(*command)
            self.assertNotEqual(code, 0, command)
            self.assertIn(part, errors)
            self.assertNotIn("unexpected", errors)

    def test_playing_from_beyond_the_end_is_one_sentence(self):
        self.source = make_recording(self.folder / "kinect_source", 320, 288, FRAMES, color=False)
        self.camera = f"folder:{self.source}"
        path, recorded = self.record("a.mkv")
        kinect = self.folder / "kinect.mkv"
        code, _, errors = run("export", path, "--k4a", kinect)
        self.assertEqual(code, 0, errors)
        pictures = recorded["depth"]["pictures"]
        for camera in (f"mkv:{kinect}", f"recording:{path}"):
            code, _, errors = run("record", "--camera", f"{camera},start=999", self.folder / "x.mkv")
            self.assertEqual(code, 1, errors)
            self.assertIn(f"has {pictures} frames, so start=999 is too far", errors)


if __name__ == "__main__":
    unittest.main()
