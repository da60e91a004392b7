# SPDX-License-Identifier: Apache-2.0
"""The Python package in a session: cameras from arrays, frames of others, and the examples for cameras that one can buy."""
import signal
import subprocess
import sys
import os
import threading
import unittest

import patience
from python_case import EXAMPLES, STANDINS, PythonCase, needs_package, numpy as np, theatron
from theatron_process import Process, host

sys.path.append(str(STANDINS))


@needs_package
class Session(PythonCase):
    def calibration(self, width=64, height=48):
        lens = theatron.CameraModel(width, height, 60, 60, (width - 1) / 2, (height - 1) / 2)
        return theatron.Calibration(lens, lens)

    def test_arrays_arrive_as_they_were_sent(self):
        import scene
        with host(self.folder / "state", options=("--filter", "off")) as session:
            with theatron.send_camera(session.greeting["publish_link"], self.calibration(), camera="arrays") as camera, \
                    theatron.join(session.greeting["link"], name="reader") as joined:
                frames = joined.frames()
                patience.wait_until(lambda: [c.name for c in joined.cameras] == ["arrays"], "the camera is there", of=session)
                number = joined.cameras[0].number
                self.assertEqual(joined.cameras[0].calibration.depth, self.calibration().depth)
                patience.wait_until(lambda: camera.is_wanted, "somebody sees it", of=session)
                received = []

                def arrived():
                    camera.send(scene.depth(), scene.color())
                    received.append(next(frames))
                    return received[-1].color is not None
                patience.wait_until(arrived, "a frame with colour", of=session)
                frame = received[-1]
                self.assertEqual((frame.camera, frame.name), (number, "arrays"))
                np.testing.assert_array_equal(frame.depth, scene.depth())
                self.assertLess(np.abs(frame.color.astype(int) - scene.color()).mean(), 4)
                self.assertIsNotNone(frame.utc)
                self.assertGreater(camera.taken, 0)
                with self.assertRaisesRegex(theatron.Error, "Depth is 10x10, but the camera's calibration says 64x48"):
                    camera.send(np.zeros((10, 10), np.uint16))
                with self.assertRaisesRegex(theatron.Error, "Colour is 10x10"):
                    camera.send(scene.depth(), np.zeros((10, 10, 3), np.uint8))
                with self.assertRaises(ValueError):
                    camera.send(scene.depth().astype(np.int32))
                camera.close()
                patience.wait_until(lambda: not joined.cameras, "the camera is gone", of=session)
                with self.assertRaisesRegex(theatron.Error, "closed"):
                    camera.send(scene.depth())
                session.send(signal.SIGINT)
                self.assertEqual(list(frames), [])  # the session ends, and so does the loop

    def test_closing_a_session_ends_its_loops(self):
        with host(self.folder / "state") as session:
            joined = theatron.join(session.greeting["link"])
            frames = joined.frames()
            loop = threading.Thread(target=lambda: list(frames), daemon=True)
            loop.start()
            joined.close()
            patience.wait_until(lambda: not loop.is_alive(), "the loop has ended", of=session)

    def test_the_frames_keep_their_session(self):
        with host(self.folder / "state", options=("--filter", "off")) as session, \
                theatron.send_camera(session.greeting["publish_link"], self.calibration(), camera="arrays") as camera:
            import scene
            frames = theatron.join(session.greeting["link"]).frames()
            patience.wait_until(lambda: camera.is_wanted, "somebody sees it", of=session)
            sending = threading.Event()

            def send():
                while not sending.wait(0.02):
                    camera.send(scene.depth(), scene.color())
            sender = threading.Thread(target=send)
            sender.start()
            try:
                np.testing.assert_array_equal(next(frames).depth, scene.depth())
            finally:
                sending.set()
                sender.join()

    def test_a_host_that_does_not_answer_is_told(self):
        with host(self.folder / "state") as session:
            link = session.greeting["link"]
        with self.assertRaises(theatron.Error):
            theatron.join(link, wait=0.5)
        for wait in (0, -1, float("nan")):
            with self.assertRaisesRegex(ValueError, "wait"):
                theatron.join(link, wait=wait)

    def test_wrong_links_and_refusals_are_sentences(self):
        with self.assertRaisesRegex(theatron.Error, "link"):
            theatron.join("nonsense")
        with self.assertRaisesRegex(theatron.Error, "link"):
            theatron.send_camera("nonsense", self.calibration())
        with self.assertRaisesRegex(theatron.Error, "does not exist"):
            theatron.join("nonsense", depth_codec="nonsense")
        with host(self.folder / "state") as session:
            link = session.greeting["link"]
            token = link.split("join=")[1].split("&")[0]
            with self.assertRaises(theatron.Error):
                theatron.join(link.replace(token, "A" * len(token)))


@needs_package
class CameraExamples(PythonCase):
    def check(self, program, unit_mm, depth_range):
        environment = {**os.environ, "PYTHONPATH": os.pathsep.join([os.environ.get("PYTHONPATH", ""), str(STANDINS)])}
        with host(self.folder / program, options=("--filter", "off")) as session, \
                theatron.join(session.greeting["link"]) as joined:
            sender = subprocess.Popen([sys.executable, EXAMPLES / program, session.greeting["publish_link"], "bought"],
                                      env=environment, stderr=subprocess.PIPE, text=True)
            try:
                frame = next(one for one in joined.frames() if one.color is not None)
                self.assertEqual(frame.name, "bought")
                self.assertEqual((int(frame.depth[1].min()), int(frame.depth[1].max())), depth_range)
                self.assertEqual(int(frame.depth[0].max()), 0)
                np.testing.assert_allclose(frame.color[24, 32], [200, 0, 50], atol=8)
                self.assertAlmostEqual(frame.calibration.depth_unit_mm, unit_mm)
            finally:
                sender.send_signal(signal.SIGINT)
                self.assertEqual(patience.end_of(sender), 0, sender.stderr.read())
                sender.stderr.close()
            return frame.calibration

    def check_place_of_color(self, calibration):
        turn = [[0, -1, 0, 0.015], [1, 0, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]
        np.testing.assert_allclose(calibration.color_from_depth, turn, atol=1e-6)
        self.assertAlmostEqual(calibration.depth.fy, 61)

    def test_realsense(self):
        calibration = self.check("realsense_camera.py", 0.25, (1000, 1630))
        self.check_place_of_color(calibration)
        np.testing.assert_allclose(calibration.depth.distortion[:2], [0.1, 0.2])
        np.testing.assert_allclose(calibration.color.distortion, 0)  # of the inverse model

    def test_orbbec(self):
        calibration = self.check("orbbec_camera.py", 0.25, (1000, 1630))
        self.check_place_of_color(calibration)
        np.testing.assert_allclose(calibration.color.distortion, [0.1, 0.2, 0.001, 0.002, 0.3, 0.4, 0.5, 0.6])

    def test_zed(self):
        calibration = self.check("zed_camera.py", 1, (1000, 1630))
        self.assertEqual(calibration.depth, calibration.color)

    def test_a_wrong_link_ends_in_a_sentence(self):
        for program in ("realsense_camera.py", "orbbec_camera.py", "zed_camera.py"):
            environment = {**os.environ, "PYTHONPATH": os.pathsep.join([os.environ.get("PYTHONPATH", ""), str(STANDINS)])}
            done = patience.run([sys.executable, EXAMPLES / program, "nonsense"], env=environment)
            self.assertEqual(done.returncode, 1)
            self.assertRegex(done.stderr, "^[^\n]*link[^\n]*\n$")


if __name__ == "__main__":
    unittest.main()
