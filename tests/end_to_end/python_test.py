# SPDX-License-Identifier: Apache-2.0
"""The Python package reads recordings and folders as the program does."""
import csv
import gc
import json
import os
import struct
import sys
import threading
import unittest

from python_case import PythonCase, example, needs_package, numpy as np, theatron
from theatron_process import host, read_png, run

MEMORY_MB = 8  # by which 90,000 further frames may raise it


def read_ply(path):
    """Points and colours of a file of `theatron export --ply`."""
    points = np.frombuffer(path.read_bytes().split(b"end_header\n", 1)[1], np.dtype([("xyz", "<f4", 3), ("rgb", "u1", 3)]))
    return points["xyz"], points["rgb"]


def memory_mb():
    with open("/proc/self/status") as status:
        return next(int(line.split()[1]) for line in status if line.startswith("VmRSS")) / 1024


def depth_png(path):
    return np.array(read_png(path)[3], np.uint16)


@needs_package
class Recordings(PythonCase):
    def export(self, file, *options):
        code, _, errors = run("export", file, *options)
        self.assertIn(code, (0, 3), errors)

    def test_frames_are_those_of_an_export(self):
        file = self.record()
        self.export(file, "--png", self.folder / "png", "--ply", self.folder / "ply")
        with open(self.folder / "png" / "times.csv") as times:
            rows = list(csv.DictReader(times))
        frames = list(theatron.Recording(file).frames())
        self.assertEqual(len(frames), len(rows))
        for n, (frame, row) in enumerate(zip(frames, rows)):
            depth = depth_png(self.folder / "png" / "depth" / f"{n:05}.png")
            self.assertEqual((frame.depth.dtype, frame.depth.shape), (np.uint16, (120, 160)))
            np.testing.assert_array_equal(frame.depth, depth)
            np.testing.assert_allclose(frame.depth_m(), depth / 1000, rtol=1e-6)
            self.assertEqual(f"{frame.seconds:.6f}", row["seconds"])
            said = frame.utc.strftime("%Y-%m-%dT%H:%M:%S.") + f"{frame.utc.microsecond // 1000:03}Z"
            self.assertEqual(said, row["captured"])
            points, colors = frame.cloud()
            expected_points, expected_colors = read_ply(self.folder / "ply" / f"{n:05}.ply")
            np.testing.assert_array_equal(points, expected_points)
            np.testing.assert_array_equal(colors, expected_colors)
            self.assertEqual(frame.color.shape, (120, 160, 3))

    def test_ten_lines_print_the_mean_depth_of_each_second(self):
        file = self.record(fps=6)  # two seconds
        self.export(file, "--png", self.folder / "png")
        means = {}
        with open(self.folder / "png" / "times.csv") as times:
            for n, row in enumerate(csv.DictReader(times)):
                depth = depth_png(self.folder / "png" / "depth" / f"{n:05}.png")
                means.setdefault(int(float(row["seconds"])), []).append(depth[depth > 0].mean())
        printed = [line.split() for line in example("mean_depth.py", file).splitlines()]
        self.assertGreater(len(printed), 1)
        self.assertEqual([int(second) for second, _ in printed], sorted(means))
        for second, mean in printed:
            self.assertAlmostEqual(float(mean), np.mean(means[int(second)]), places=2)

    def test_seeking_finds_the_first_frame_from_a_time_on(self):
        recording = theatron.Recording(self.record())
        frames = list(recording.frames())
        iterator = recording.frames()
        for wanted in (frames[7], frames[2], frames[-1], frames[0]):
            iterator.seek(wanted.seconds)
            found = next(iterator)
            self.assertEqual(found.number, wanted.number)
            np.testing.assert_array_equal(found.depth, wanted.depth)
        iterator.seek(frames[3].seconds - 0.001)
        self.assertEqual(next(iterator).number, frames[3].number)
        iterator.seek(frames[-1].seconds + 1)
        self.assertRaises(StopIteration, next, iterator)
        part = recording.frames(start=frames[3].seconds, stop=frames[6].seconds)
        self.assertEqual([f.number for f in part], [f.number for f in frames[3:6]])
        for wrong in (-1, float("nan"), 1e300):
            self.assertRaises(ValueError, iterator.seek, wrong)

    def test_arrays_outlive_their_frame_and_may_be_changed(self):
        iterator = theatron.Recording(self.record()).frames()
        kept = next(iterator).depth
        copy = kept.copy()
        kept_color = next(iterator).color
        gc.collect()
        for frame in iterator:
            frame.depth[:] = 0  # nothing refers to it
        np.testing.assert_array_equal(kept, copy)
        self.assertGreater(kept_color.max(), 0)

    def test_damage_is_told_and_counted_as_inspect_does(self):
        file = self.record(options=("--depth-codec", "zstd:delta=1", "--color-codec", "jpeg"))
        whole = file.read_bytes()
        damaged = bytearray(whole)
        for at in range(len(whole) // 3, len(whole) * 2 // 3, len(whole) // 40):
            damaged[at] ^= 0xff
        cut = whole[:len(whole) * 2 // 3]
        for name, content in (("damaged.mkv", bytes(damaged)), ("cut.mkv", cut), ("whole.mkv", whole)):
            (self.folder / name).write_bytes(content)
            _, out, _ = run("inspect", self.folder / name, "--verify", "--json")
            told = json.loads(out)
            text = run("inspect", self.folder / name)[1]
            recording = theatron.Recording(self.folder / name)
            self.assertEqual(recording.complete, told["complete"])
            for remark in recording.remarks:
                self.assertIn(f"  {remark}\n", text)
            self.assertEqual(bool(recording.remarks), name != "whole.mkv")
            minutes = told["cameras"][0]["minutes"]
            self.assertEqual(recording.verify()["cameras"][0], minutes)
            frames = recording.frames()
            pictures = [frame.depth.shape for frame in frames if frame.color is None or frame.color.any()]
            self.assertEqual(len(pictures), sum(m["depth"]["pictures"] for m in minutes))
            self.assertEqual(frames.losses.damaged_depth, sum(m["depth"]["damaged"] for m in minutes))
            self.assertEqual(frames.losses.undecodable_depth, sum(m["depth"]["undecodable"] for m in minutes))

    def test_what_inspect_refuses_is_refused_with_its_sentence(self):
        (self.folder / "text.mkv").write_text("no recording")
        for file in (self.folder / "text.mkv", self.folder / "nowhere.mkv", self.folder):
            code, _, errors = run("inspect", file)
            self.assertEqual(code, 1)
            with self.assertRaises(theatron.Error) as raised:
                theatron.Recording(file)
            self.assertEqual(f"theatron: {raised.exception}\n", errors)
        with self.assertRaisesRegex(theatron.Error, "camera=7 is none of them"):
            theatron.Recording(self.record()).frames(7)

    def test_text_that_is_no_utf8_is_shown(self):
        content = self.record().read_bytes()
        self.assertIn(b"source", content)
        (self.folder / "odd.mkv").write_bytes(content.replace(b"source", b"sour\xff\xfe"))
        recording = theatron.Recording(self.folder / "odd.mkv")
        for name in (recording.cameras[0].name, next(recording.frames()).name):
            self.assertIn(name, ("sour\ufffd\ufffd", "source"))  # a head whose checksum is wrong is not read
        with self.assertRaisesRegex(theatron.Error, "no\ufffd"):
            theatron.Recording(os.fsdecode(b"no\xff"))
        str(recording.remarks), str(recording.cameras), str(recording)

    def test_memory_stays_flat_over_100000_frames(self):
        recording = theatron.Recording(self.record())
        iterator, frames, begin = recording.frames(), 0, 0
        while frames < 100_000:
            iterator.seek(0)
            for frame in iterator:
                frames += 1
                _ = frame.depth[0, 0]
            if begin == 0 and frames >= 10_000:
                begin = memory_mb()
        self.assertLess(memory_mb() - begin, MEMORY_MB)

    def test_other_threads_run_while_it_decodes(self):
        recording = theatron.Recording(self.record())
        go, inside, seen, over = threading.Semaphore(0), False, threading.Event(), False

        def look():
            while go.acquire() and not over:
                if inside:
                    seen.set()

        thread = threading.Thread(target=look)
        thread.start()
        before = sys.getswitchinterval()
        sys.setswitchinterval(1000)  # nobody is made to wait: a lock that is kept stays kept
        try:
            for _ in range(10_000):
                go.release()
                inside = True
                recording.verify()
                inside = False
                if seen.is_set():
                    break
        finally:
            sys.setswitchinterval(before)
            over = True
            go.release()
            thread.join()
        self.assertTrue(seen.is_set())

    def test_a_recorded_session_has_its_room(self):
        self.record(frames=5)
        with host(self.folder / "state", f"folder:{self.folder / 'source'},loop=1") as session:
            code, _, errors = run("record", session.greeting["link"], self.folder / "session.mkv", "--seconds", 1)
            self.assertEqual(code, 0, errors)
        self.export(self.folder / "session.mkv", "--room", self.folder / "room.jsonl")
        lines = [json.loads(line) for line in (self.folder / "room.jsonl").read_text().splitlines()]
        recording = theatron.Recording(self.folder / "session.mkv")
        self.assertGreater(len(lines), 0)
        self.assertEqual(list(recording.room_changes()), lines)
        for line in reversed(lines):
            self.assertEqual(recording.room(line["seconds"])["people"], line["people"])
        moments = [frame.moment for frame in recording.frames()]
        self.assertEqual(moments, sorted(set(moments)))
        self.assertIsNone(theatron.Recording(self.folder / "a.mkv").room(0))


@needs_package
class FoldersAndCameras(PythonCase):
    def test_a_folder_is_read_whole_and_at_once(self):
        self.record()
        source = self.folder / "source"
        frames = list(theatron.open_folder(source, fps=10))
        self.assertEqual(len(frames), 12)
        for n, frame in enumerate(frames):
            np.testing.assert_array_equal(frame.depth, depth_png(source / "depth" / f"{n:05}.png"))
            self.assertAlmostEqual(frame.seconds, n / 10, places=5)
            np.testing.assert_array_equal(frame.color[0, 0], [60, 90, 120])
        self.assertEqual(next(theatron.open_folder(source, fps=10, start=0.45)).number, 5)
        (source / "depth" / "00003.png").write_bytes(b"damaged")
        again = theatron.open_folder(source)
        self.assertEqual([f.number for f in again], [0, 1, 2, *range(4, 12)])
        self.assertEqual(again.losses.damaged_depth, 1)

    def test_a_camera_gives_its_frames_when_they_are_due(self):
        self.record()
        with theatron.open_camera(f"folder:{self.folder / 'source'},fps=100", every=True) as camera:
            frames = list(camera)
            self.assertEqual(len(frames), 12)
            self.assertFalse(frames[0].depth.flags.writeable)
            self.assertRaisesRegex(theatron.Error, "Recording or Folder", camera.seek, 0)
        self.assertEqual(list(camera), [])
        synthetic = next(theatron.open_camera("synthetic:seconds=2,fps=10,quality=quick"))
        self.assertGreater(synthetic.depth.max(), 0)
        for wrong in ("nonsense", "mkv:a.mkv", "folder:", str(self.folder)):
            self.assertRaises(theatron.Error, theatron.open_camera, wrong)


@needs_package
class Codecs(unittest.TestCase):
    def pictures(self, count=6):
        rng = np.random.default_rng(1)
        y, x = np.mgrid[0:50, 0:70]
        return [(1000 + 3 * x + 5 * y + rng.integers(0, 4, x.shape) + 2 * n).astype(np.uint16) for n in range(count)]

    def test_depth_comes_back_bit_exact(self):
        for codec in ("raw", "rvl", "trvl", "zstd", "zstd:delta=1", "lz4", "ans", "strata", "strata:layers=3"):
            encoder, decoder = theatron.DepthEncoder(codec), theatron.DepthDecoder(codec)
            for n, depth in enumerate(self.pictures()):
                encoded = encoder.encode(depth, key=n == 4)
                self.assertEqual(encoded.frame, n)
                if n in (0, 4):
                    self.assertTrue(encoded.key)
                stored = theatron.EncodedDepth(encoded.data, encoded.frame, encoded.reference, encoded.layer, encoded.key)
                np.testing.assert_array_equal(decoder.decode(stored), depth)
            self.assertEqual(encoder.codec, decoder.codec)
            np.testing.assert_array_equal(theatron.decode_depth(theatron.encode_depth(depth, codec), codec), depth)

    def test_rows_with_gaps_and_turned_pictures_are_encoded(self):
        depth = self.pictures(1)[0]
        for view in (depth[:, 10:30], depth[::2], depth.T, depth[::-1, ::-1]):
            np.testing.assert_array_equal(theatron.decode_depth(theatron.encode_depth(view)), view)

    def test_color_comes_back(self):
        color = np.zeros((48, 64, 3), np.uint8)
        color[:, :32] = (200, 30, 60)
        np.testing.assert_array_equal(theatron.ColorDecoder("raw").decode(theatron.ColorEncoder("raw").encode(color).data), color)
        encoded = theatron.ColorEncoder("jpeg:quality=95").encode(color)
        decoded = theatron.ColorDecoder().decode(encoded.data)
        self.assertLess(np.abs(decoded.astype(int) - color).mean(), 4)

    def test_what_is_wrong_is_said(self):
        depth = self.pictures(1)[0]
        data = theatron.encode_depth(depth)
        for n in range(0, len(data), 97):
            with self.assertRaisesRegex(theatron.Error, "cannot be decoded"):
                theatron.decode_depth(data[:n])
        with self.assertRaisesRegex(theatron.Error, "does not exist; choose one of"):
            theatron.DepthEncoder("nonsense")
        for wrong in (depth.astype(float), depth.astype(">u2"), depth[0], [[1]], np.zeros((0, 5), np.uint16), None):
            with self.assertRaises((ValueError, TypeError)):
                theatron.encode_depth(wrong)
        late = theatron.DepthEncoder("zstd:delta=1")
        late.encode(depth)
        with self.assertRaisesRegex(theatron.Error, "missing its reference"):
            theatron.DepthDecoder("zstd:delta=1").decode(late.encode(depth))
        with self.assertRaises(theatron.Error):
            theatron.ColorDecoder().decode(struct.pack("8B", *range(8)))


@needs_package
class Calibrations(unittest.TestCase):
    def test_a_calibration_keeps_what_it_was_made_of(self):
        lens = theatron.CameraModel(64, 48, 60, 61, 31.5, 23.5, [0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8])
        np.testing.assert_allclose(lens.distortion, [0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8])
        np.testing.assert_allclose(lens.matrix, [[60, 0, 31.5], [0, 61, 23.5], [0, 0, 1]])
        turn = np.array([[0, -1, 0, 0.1], [1, 0, 0, 0.2], [0, 0, 1, 0.3], [0, 0, 0, 1.0]])
        made = theatron.Calibration(lens, lens, turn, depth_unit_mm=0.25, room_from_camera=turn)
        np.testing.assert_allclose(made.color_from_depth, turn, atol=1e-9)
        np.testing.assert_allclose(made.room_from_camera, turn, atol=1e-9)
        self.assertTrue(made.registered)
        self.assertEqual(json.loads(made.to_json())["depth"]["width"], 64)
        straight = theatron.CameraModel(4, 3, 2, 2, 1.5, 1)
        np.testing.assert_allclose(straight.rays()[0, 0], [-0.75, -0.5], rtol=1e-6)

    def test_impossible_calibrations_are_refused(self):
        lens = theatron.CameraModel(64, 48, 60, 60, 31.5, 23.5)
        for make in (lambda: theatron.Calibration(theatron.CameraModel(0, 0, 1, 1, 0, 0)),
                     lambda: theatron.Calibration(theatron.CameraModel(64, 48, -1, 60, 0, 0)),
                     lambda: theatron.Calibration(lens, room_from_camera=np.ones((4, 4))),
                     lambda: theatron.Calibration(lens, room_from_camera=np.diag([1.0, 1, -1, 1])),
                     lambda: theatron.Calibration(lens, room_from_camera=np.eye(3)),
                     lambda: theatron.Calibration(lens, depth_unit_mm=float("nan")),
                     lambda: theatron.CameraModel(64, 48, 60, 60, 0, 0, [0.0] * 9)):
            self.assertRaises(ValueError, make)


if __name__ == "__main__":
    unittest.main()
