# SPDX-License-Identifier: Apache-2.0
"""Poses of people go through a real host: gathered, to all others, the newest of each."""
import json
import os
import pathlib
import shutil
import struct
import tempfile
import time
import unittest

from raw_peer import STATES, RawPeer
from theatron_process import host, make_recording, run

POSE = 1


def pose(time_us, x):
    """A head at (x, 1.5, 0), not rotated: docs/formats/person_pose.md."""
    return struct.pack("<qB3f4h", time_us, 1, x, 1.5, 0, 32767, 0, 0, 0)


def no_pose_parts(body):
    return body[8] == 0


class Person(RawPeer):
    def __init__(self, link):
        super().__init__(link)
        # Each is a person of its own: after a flood its person is kept out for a while.
        self.join(depth_codec="raw", color_codec="raw", person=list(os.urandom(16)))
        self.number = self.receive_control("Welcome")[1]["participant"]

    def send_state(self, number, body, topic=POSE):
        self.send(bytes([STATES, topic]) + struct.pack("<IH", number, len(body)) + body)

    def receive_poses(self):
        """The bodies by participant, in the next envelope that has poses."""
        while True:
            envelope = self.receive()
            if envelope[0] != STATES:
                continue
            poses, at = {}, 1
            while at < len(envelope):
                topic, number, size = struct.unpack_from("<BIH", envelope, at)
                self_check = topic == POSE and number not in poses
                if not self_check:
                    raise AssertionError(f"topic {topic} of {number}")
                poses[number] = envelope[at + 7:at + 7 + size]
                at += 7 + size
            return poses


class Poses(unittest.TestCase):
    def setUp(self):
        folder = pathlib.Path(tempfile.mkdtemp(prefix="theatron_e2e_"))
        self.addCleanup(shutil.rmtree, folder)
        self.recording = make_recording(folder / "box")
        camera = f"folder:{self.recording},loop=1,preload=1"
        self.host = self.enterContext(host(folder / "state", camera))
        self.link = self.host.greeting["link"]

    def person(self):
        return self.enterContext(Person(self.link))

    def now_us(self):
        """The host's clock is this machine's."""
        return time.monotonic_ns() // 1000

    def test_everybody_gets_the_newest_pose_of_all_others_in_one_message(self):
        people = [self.person() for _ in range(3)]
        numbers = [p.number for p in people]
        for n in range(20):
            for i, p in enumerate(people):
                p.send_state(p.number, pose(self.now_us(), 100 * i + n))
        for i, p in enumerate(people):
            newest, together = {}, 0
            others = {numbers[k]: 100 * k + 19 for k in range(3) if k != i}
            while newest != others:
                got = p.receive_poses()
                self.assertNotIn(p.number, got, "its own")
                together = max(together, len(got))
                for number, body in got.items():
                    newest[number] = struct.unpack_from("<f", body, 9)[0]
            self.assertEqual(together, 2)

    def test_who_joins_later_gets_poses_and_who_leaves_is_gone(self):
        first, second = self.person(), self.person()
        first.send_state(first.number, pose(self.now_us(), 5))
        second.receive_poses()
        late = self.person()
        self.assertEqual(struct.unpack_from("<f", late.receive_poses()[first.number], 9)[0], 5)
        first.close()
        self.assertTrue(no_pose_parts(late.receive_poses()[first.number]))

    def test_nobody_moves_somebody_else(self):
        first, second = self.person(), self.person()
        second.send_state(first.number, pose(self.now_us(), 9))
        second.send_state(second.number, pose(self.now_us(), 3), topic=77)
        second.send_state(second.number, b"no pose")
        second.send_state(second.number, pose(self.now_us(), 4))
        self.assertEqual(struct.unpack_from("<f", first.receive_poses()[second.number], 9)[0], 4)

    def test_a_flood_of_poses_costs_its_connection_only(self):
        first, second = self.person(), self.person()
        body = pose(self.now_us(), 1)
        one = struct.pack("<BIH", POSE, second.number, len(body)) + body
        for _ in range(20):
            second.send(bytes([STATES]) + one * 150)
        self.assertIn("far more", second.receive_control("Refused")[1]["in_english"])
        second.wait_for_end()
        first.send_state(first.number, pose(self.now_us(), 1))
        third = self.person()
        self.assertIn(first.number, third.receive_poses())

    def test_the_benchmark_of_interaction_sees_the_poses_of_all(self):
        camera = f"folder:{self.recording},loop=1,preload=1"
        code, out, errors = run("bench", "interaction", "--camera", camera, "--people", "3", "--seconds", "2", "--warmup", "1",
                                "--json", "-")
        self.assertEqual(code, 0, errors)
        found = json.loads(out)
        self.assertEqual(found["participants"], 5)  # the three, and two that grab
        self.assertGreater(found["poses"], 3 * 60)  # at 90 a second each
        self.assertGreater(found["p50_ms"], 0)
        self.assertGreater(found["pictures"]["fps_min"], 0)


if __name__ == "__main__":
    unittest.main()
