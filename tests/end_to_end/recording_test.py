# SPDX-License-Identifier: Apache-2.0
"""theatron record, inspect and export, and recordings as cameras."""
import datetime
import json
import pathlib
import re
import shutil
import signal
import struct
import tempfile
import time
import unittest

from theatron_process import Process, host, make_recording, read_png, run, wait_until, write_png

FRAMES = 6


class Recording(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="theatron_e2e_"))
        # A size that an Azure Kinect gives, for --k4a.
        self.source = make_recording(self.folder / "source", 320, 288, FRAMES, color=False)

    def tearDown(self):
        shutil.rmtree(self.folder)

    def record(self, name, *arguments):
        code, out, errors = run("record", *arguments, "--json", self.folder / name)
        figures = json.loads(out)
        # A busy machine passes over pictures, which is said.
        self.assertEqual(code, 0 if figures["complete"] else 3, errors)
        return figures

    def inspect(self, name):
        code, out, errors = run("inspect", self.folder / name, "--json")
        self.assertEqual(code, 0, errors)
        return json.loads(out)

    def assert_same_depth(self, exported):
        """Every exported picture is one of the source's; those passed over on a busy machine are missing."""
        originals = [read_png(self.source / "depth" / f"{n:05}.png") for n in range(FRAMES)]
        pictures = sorted(exported.glob("depth/*.png"))
        self.assertGreater(len(pictures), 0)
        at = 0
        for picture in pictures:
            at = originals.index(read_png(picture), at) + 1

    def test_raw_recordings_refuse_what_would_change_depth(self):
        camera = ("--camera", f"folder:{self.source}", "--raw", "--depth-codec")
        code, _, errors = run("record", *camera, "lz4:quant_mm=2", self.folder / "raw.mkv")
        self.assertNotEqual(code, 0)
        self.assertIn("lossless", errors)
        self.assertGreater(self.record("raw.mkv", *camera, "strata")["pictures"], 0)

    def test_pictures_come_back_bit_exact_through_every_format(self):
        figures = self.record("a.mkv", "--camera", f"folder:{self.source}", "--depth-codec", "zstd:delta=1")
        self.assertEqual(figures["dropped"], 0)
        code, _, errors = run("export", self.folder / "a.mkv", "--png", self.folder / "png", "--k4a",
                              self.folder / "kinect.mkv", "--ply", self.folder / "ply")
        self.assertEqual(code, 0, errors)
        self.assert_same_depth(self.folder / "png")
        # The source's lens has no distortion, so nothing moves.
        code, _, errors = run("export", self.folder / "a.mkv", "--png", self.folder / "straight", "--undistort")
        self.assertEqual(code, 0, errors)
        self.assert_same_depth(self.folder / "straight")
        code, _, errors = run("record", "--camera", f"folder:{self.source}", self.folder / "a.mkv")
        self.assertEqual(code, 1)
        self.assertIn("exists already", errors)
        clouds = sorted((self.folder / "ply").glob("*.ply"))
        self.assertEqual(len(clouds), figures["pictures"])
        header = clouds[0].read_bytes().split(b"end_header\n")[0].decode()
        self.assertIn("comment x right, y down, z forward in metres, from the depth camera\n", header)
        captured = datetime.datetime.fromisoformat(
            re.search("comment captured ([^Z]+)Z\n", header)[1] + "+00:00")
        self.assertLess(abs(captured.timestamp() - time.time()), 300)

        self.record("b.mkv", "--camera", f"mkv:{self.folder / 'kinect.mkv'}", "--depth-codec", "raw")
        code, _, errors = run("export", self.folder / "b.mkv", "--png", self.folder / "again")
        self.assertEqual(code, 0, errors)
        self.assert_same_depth(self.folder / "again")

        self.record("c.mkv", "--camera", f"folder:{self.folder / 'png'}")
        self.assertEqual(self.inspect("c.mkv")["cameras"][0]["calibration"],
                         self.inspect("a.mkv")["cameras"][0]["calibration"])

    def test_the_last_depth_of_own_cameras_has_its_colour(self):
        source = make_recording(self.folder / "coloured", 640, 480, FRAMES)
        for n in range(6):
            figures = self.record(f"end{n}.mkv", "--camera", f"folder:{source},loop=1", "--seconds", 0.2)
            recorded = figures["cameras"][0]
            pictures = recorded["depth"]["pictures"] - recorded["color"]["pictures"]
            self.assertLessEqual(abs(pictures), recorded["not_encoded"], "named where it is missing")

    def board_before_a_wall(self):
        """A red board 1 m away before a green wall at 2.5 m; the colour camera is 60 mm further right."""
        width, height, f, baseline = 160, 120, 120.0, 0.06
        source = self.folder / "board"
        (source / "depth").mkdir(parents=True)
        (source / "color").mkdir()
        camera = {"width": width, "height": height, "fx": f, "fy": f, "cx": 79.5, "cy": 59.5}
        (source / "calibration.json").write_text(json.dumps({
            "depth": camera, "color": camera,
            "color_from_depth": {"rotation": [1, 0, 0, 0, 1, 0, 0, 0, 1], "translation": [-baseline, 0, 0]}}))

        def on_board(x, y, eye):
            return abs(eye + (x - 79.5) / f) < 0.2 and abs((y - 59.5) / f) < 0.2

        depth = [b"".join(struct.pack(">H", 1000 if on_board(x, y, 0) else 2500) for x in range(width))
                 for y in range(height)]
        color = [b"".join(b"\xff\0\0" if on_board(x, y, baseline) else b"\0\xff\0" for x in range(width))
                 for y in range(height)]
        for n in range(2):
            write_png(source / "depth" / f"{n:05}.png", width, height, 16, 1, depth)
            write_png(source / "color" / f"{n:05}.png", width, height, 8, 3, color)
        return source

    def test_the_foregrounds_colour_is_not_painted_on_what_it_hides(self):
        self.record("board.mkv", "--camera", f"folder:{self.board_before_a_wall()}", "--color-codec", "raw")
        code, _, errors = run("export", self.folder / "board.mkv", "--ply", self.folder / "points",
                              "--png", self.folder / "rgbd", "--registered")
        self.assertEqual(code, 0, errors)
        width, height, _, depth = read_png(self.folder / "rgbd" / "depth" / "00000.png")
        color = read_png(self.folder / "rgbd" / "color" / "00000.png")
        self.assertEqual(color[:3], (width, height, 3))
        seen = {(near, name): 0 for near in (True, False) for name in ("red", "green", "black")}
        for depth_row, color_row in zip(depth, color[3]):
            for x, mm in enumerate(depth_row):
                red, green = color_row[3 * x:3 * x + 2]
                seen[mm == 1000, "red" if red else "green" if green else "black"] += 1
        self.assertGreater(seen[True, "red"], 2000)
        self.assertGreater(seen[False, "green"], 10000)
        self.assertGreater(seen[False, "black"], 100, "wall that the board hides")
        self.assertLess(seen[False, "red"] + seen[True, "green"], 60, "but for the board's rim")
        # The same in the points: 15 bytes each.
        points = (self.folder / "points" / "00000.ply").read_bytes().split(b"end_header\n", 1)[1]
        far = [points[at + 12:at + 15] for at in range(0, len(points), 15)
               if struct.unpack("<f", points[at + 8:at + 12])[0] > 2]
        self.assertLess(far.count(b"\xff\0\0"), 60)
        self.assertGreater(far.count(b"\x80\x80\x80"), 100, "not seen: grey")

    def test_a_session_is_recorded_as_it_comes(self):
        with host(self.folder / "state", f"folder:{self.source},loop=1", f"folder:{self.source},loop=1",
                  options=("--filter", "off", "--filter", "0=kalman")) as h:
            code, out, errors = run("record", h.greeting["link"], self.folder / "session.mkv", "--seconds", 1,
                                    "--json", "--depth-codec", "trvl")
            self.assertEqual(code, 0, errors)
        seen = self.inspect("session.mkv")
        self.assertTrue(seen["complete"])
        self.assertEqual([c["depth"]["codec"] for c in seen["cameras"]], ["trvl", "trvl"])
        self.assertGreater(min(c["depth"]["frames"] for c in seen["cameras"]), 5)
        self.assertEqual([c["depth"]["filtered"] for c in seen["cameras"]], [seen["cameras"][0]["depth"]["frames"], 0])
        named = [[(c["from_frame"], c["filters"]) for c in camera["depth"]["filters"]] for camera in seen["cameras"]]
        self.assertEqual([list(dict(named[0]).values())[-1:], named[1]], [["kalman"], []])
        code, _, errors = run("export", self.folder / "session.mkv", "--camera", 1, "--png", self.folder / "png")
        self.assertEqual(code, 0, errors)
        originals = [read_png(self.source / "depth" / f"{n:05}.png") for n in range(FRAMES)]
        for picture in sorted((self.folder / "png" / "depth").glob("*.png"))[:4]:
            self.assertIn(read_png(picture), originals)

    def test_ctrl_c_ends_it_and_a_crash_leaves_a_file_that_opens(self):
        for sig, name in ((signal.SIGINT, "ended.mkv"), (signal.SIGHUP, "hung_up.mkv"), (signal.SIGKILL, "killed.mkv")):
            path = self.folder / name
            with Process("record", "--camera", f"folder:{self.source},loop=1", path) as recorder:
                wait_until(lambda: path.exists() and path.stat().st_size > 100_000)
                recorder.send(sig)
                recorder.end()
            seen = self.inspect(name)
            self.assertEqual(seen["complete"], sig != signal.SIGKILL)
            self.assertGreater(seen["cameras"][0]["depth"]["frames"], 0)

    def test_damage_is_passed_over_told_and_left_out_of_what_is_recovered(self):
        path = self.folder / "damaged.mkv"
        self.record(path.name, "--camera", f"folder:{self.source}", "--depth-codec", "rvl")
        code, out, errors = run("inspect", path, "--verify", "--json")
        self.assertEqual(code, 0, errors)
        whole = json.loads(out)
        pictures = whole["cameras"][0]["depth"]["frames"]
        self.assertEqual(sum(m["depth"]["pictures"] for m in whole["cameras"][0]["minutes"]), pictures)
        content = bytearray(path.read_bytes())
        content[len(content) // 2] ^= 4
        content[1] ^= 1
        path.write_bytes(content)

        code, out, errors = run("inspect", path, "--verify", "--json")
        self.assertEqual(code, 3, errors)
        seen = json.loads(out)
        self.assertTrue(seen["damaged"] and seen["segments"][0]["head_damaged"])
        self.assertEqual(sum(m["depth"]["damaged"] for m in seen["cameras"][0]["minutes"]), 1)
        code, out, errors = run("export", path, "--png", self.folder / "png", "--json")
        self.assertEqual(code, 3, errors)
        self.assertEqual((json.loads(out)["count"], json.loads(out)["lost_depth"]), (pictures - 1, 1))
        self.assert_same_depth(self.folder / "png")

        code, out, errors = run("recover", path, "--json")
        self.assertEqual((code, json.loads(out)["complete"]), (3, False), errors)
        saved = json.loads(out)
        self.assertEqual(saved["cameras"][0]["depth"], {"saved": pictures - 1, "damaged": 1, "undecodable": 0})
        self.assertEqual(saved["files"], [str(self.folder / "damaged.recovered.mkv")])
        code, out, errors = run("inspect", saved["files"][0], "--verify")
        self.assertEqual(code, 3, errors)
        self.assertIn("it is not complete: pictures are missing", out)
        code, _, errors = run("recover", path)
        self.assertEqual(code, 1)
        self.assertIn("exists already", errors)

    def test_what_cannot_be_is_one_sentence(self):
        self.record("own.mkv", "--camera", f"folder:{self.source}")
        code, _, errors = run("export", self.folder / "own.mkv", "--k4a", self.folder / "kinect.mkv")
        self.assertEqual(code, 0, errors)
        for arguments, part in (
                (("record", self.folder / "x.mkv"), "Say what to record"),
                (("record", "--camera", f"folder:{self.source}", "/nowhere/x.mkv"), "Cannot create"),
                (("inspect", self.source / "depth" / "00000.png"), "is no Matroska file"),
                (("export", self.folder / "x.mkv", "--png", "y"), "Cannot open"),
                (("export", self.folder / "x.mkv"), "Say into what to export"),
                (("inspect", self.folder / "kinect.mkv"), "use mkv:FILE"),
                (("host", "--listen", "127.0.0.1:0", "--camera", f"mkv:{self.folder / 'own.mkv'}"), "recording:FILE"),
                (("recover", self.folder / "x.mkv"), "Cannot open")):
            code, _, errors = run(*arguments)
            self.assertEqual(code, 1)
            self.assertIn(part, errors)
            self.assertEqual(errors.count("theatron: "), 1)


if __name__ == "__main__":
    unittest.main()
