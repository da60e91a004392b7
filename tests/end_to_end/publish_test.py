# SPDX-License-Identifier: Apache-2.0
"""Participants whose cameras join and leave a session; nobody else's camera notices."""
import contextlib
import json
import pathlib
import random
import shutil
import signal
import tempfile
import unittest

from raw_peer import RawPeer, calibration, media_message
from theatron_process import Process, host, make_recording, run, wait_until

PUBLISH = 1  # wire::Feature


def viewer(link, *options):
    return Process("join", link, "--every", "0.2", *options)


def names(figures):
    return sorted(c["name"] for c in figures["cameras"])


def camera(figures, number):
    """A camera by its number in the session."""
    return next((c for c in figures["cameras"] if c["id"] == number), None)


class Publishing(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="theatron_publish_"))
        cls.addClassCleanup(shutil.rmtree, cls.folder)
        cls.cameras = {name: f"folder:{make_recording(cls.folder / name)},loop=1,preload=1"
                       for name in ("lamp", "face", "hand")}
        cls.state = cls.folder / "state"

    def test_a_participants_camera_comes_and_leaves_and_others_go_on(self):
        with host(self.state, self.cameras["lamp"]) as h, viewer(h.greeting["link"]) as seen:
            seen.wait_for(lambda f: names(f) == ["lamp"] and f["fps"] > 0)
            with viewer(h.greeting["publish_link"], "--publish", self.cameras["face"]) as publisher:
                both = seen.wait_for(lambda f: len(f["cameras"]) == 2 and camera(f, 1)["frames"] > 20)
                self.assertEqual(camera(both, 1)["name"], "face")
                self.assertGreater(camera(both, 1)["publisher"], 0)
                self.assertEqual(names(publisher.newest_json()), ["lamp"], "one's own is not sent back")
                # Codecs are chosen for each camera.
                seen.say("depth rvl 1")
                chosen = seen.wait_for(lambda f: "rvl" in camera(f, 1)["depth_codec"]
                                       and camera(f, 1)["fps"] > 0)
                self.assertEqual(camera(chosen, 0)["depth_codec"], "strata")
                publisher.process.kill()
                alone = seen.wait_for(lambda f: len(f["cameras"]) == 1)
                seen.wait_until(lambda: "Camera face is gone: the connection of its sender broke." in "".join(seen.errors))
            later = seen.wait_for(lambda f: camera(f, 0)["frames"] > camera(alone, 0)["frames"] + 30)
            self.assertEqual(later["joins"], 1)
            # Numbers never come again, and a publisher finds back by itself.
            with viewer(h.greeting["publish_link"], "--publish", self.cameras["hand"],
                        "--publish", self.cameras["face"]):
                seen.wait_for(lambda f: camera(f, 2) and camera(f, 3) and camera(f, 3)["frames"] > 5)

    def test_a_machine_without_a_screen_only_sends(self):
        with host(self.state, self.cameras["lamp"]) as h, viewer(h.greeting["link"]) as seen:
            seen.wait_for(lambda f: f["fps"] > 0)
            with Process("publish", h.greeting["publish_link"], "--camera", self.cameras["face"],
                         "--name", "cart", "--every", "0.2") as cart:
                both = seen.wait_for(lambda f: camera(f, 1) and camera(f, 1)["frames"] > 5)
                self.assertNotEqual(camera(both, 1)["filter"], "", "filtered as the host's own are")
                sent = cart.wait_for(lambda f: f["cameras"][0]["encoders"] > 0)
                self.assertEqual(sent["cameras"][0]["id"], 1)

                def listed():
                    code, out, errors = run("status", h.greeting["link"], "--json")
                    self.assertEqual(code, 0, errors)
                    one, = json.loads(out)["published"]
                    return one["name"], one["id"], one["state"]

                wait_until(lambda: listed() == ("face", 1, "live"))
                # It stands still with its connection open: nobody may take its last picture for the present.
                cart.send(signal.SIGSTOP)
                stale = seen.wait_for(lambda f: camera(f, 1)["state"] == "stale")
                self.assertEqual(camera(stale, 1)["problem"], "Its pictures do not arrive any more.")
                seen.wait_for(lambda f: camera(f, 0)["state"] == "live" and camera(f, 1)["state"] == "stale")
                wait_until(lambda: listed() == ("face", 1, "stale"))
                with viewer(h.greeting["link"]) as late:
                    told = late.wait_for(lambda f: camera(f, 1) and camera(f, 1)["state"] == "stale")
                    self.assertEqual(camera(told, 1)["problem"], "None of its pictures has arrived yet.")
                    self.assertIsNone(camera(told, 1)["age_now_ms"])
                cart.send(signal.SIGCONT)
                seen.wait_for(lambda f: camera(f, 1)["state"] == "live")
                wait_until(lambda: listed() == ("face", 1, "live"))
                cart.send(signal.SIGTERM)
                self.assertEqual(cart.end(), 0)
            seen.wait_for(lambda f: len(f["cameras"]) == 1)
            seen.wait_until(lambda: "Camera face has left." in "".join(seen.errors))
            self.assertNotIn("broke", "".join(seen.errors))
            code, _, errors = run("publish", h.greeting["link"], "--camera", self.cameras["face"])
            self.assertEqual(code, 1)
            self.assertIn("lets you send no cameras", errors)

    def test_a_viewers_link_lets_no_camera_in(self):
        with host(self.state, self.cameras["lamp"]) as h, viewer(h.greeting["link"]) as seen:
            seen.wait_for(lambda f: f["fps"] > 0)
            with viewer(h.greeting["link"], "--publish", self.cameras["face"]) as publisher:
                publisher.wait_for(lambda f: f["fps"] > 0)
                self.assertEqual(names(seen.newest_json()), ["lamp"])
                publisher.say("quit")
                self.assertEqual(publisher.end(), 0)
                self.assertIn("publishers", "".join(publisher.errors))
            # Not even with a program that does not ask.
            with RawPeer(h.greeting["link"]) as peer:
                peer.join()
                peer.receive_control("Welcome")
                peer.send_media(media_message(b"x" * 100, stream=0))
                peer.wait_for_end()

    def test_a_publisher_sends_pictures_of_its_own_cameras_only(self):
        with host(self.state, self.cameras["lamp"]) as h, viewer(h.greeting["link"]) as seen:
            seen.wait_for(lambda f: f["fps"] > 0)
            offer = {"name": "made up", "has_color": False, "frames_per_second": 30.0,
                     "calibration": list(calibration(color_width=0, color_height=0))}
            with RawPeer(h.greeting["publish_link"]) as peer:
                peer.join(features=[PUBLISH, 999])
                self.assertEqual(peer.receive_control("Welcome")[1].get("features"), [PUBLISH])
                peer.send_control("Publish", cameras=[offer])
                number, = peer.receive_control("Published")[1]["cameras"]
                setting = peer.receive_control("Encode")[1]["settings"][0]
                self.assertEqual(setting["stream"], 2 * number)
                peer.send_media(media_message(b"no depth", stream=2 * number, setting=setting["setting"]))
                # Each setting begins with a key frame.
                self.assertEqual(peer.receive_control("EncodeKey")[1]["stream"], 2 * number)
                seen.wait_for(lambda f: names(f) == ["lamp", "made up"])
                peer.send_media(media_message(b"a lie", stream=0, setting=1))
                self.assertIn("no camera of this participant", peer.receive_control("Refused")[1]["in_english"])
                peer.wait_for_end()
            seen.wait_for(lambda f: names(f) == ["lamp"])
            with RawPeer(h.greeting["publish_link"]) as peer:
                peer.join(features=[PUBLISH])
                peer.send_control("Publish", cameras=[offer])
                number, = peer.receive_control("Published")[1]["cameras"]
                # Larger than any picture of that camera.
                with contextlib.suppress(OSError):
                    peer.send_media(media_message(b"x" * 4_000_000, stream=2 * number))
                peer.wait_for_end()

    def test_links_expire(self):
        with host(self.state, self.cameras["lamp"], options=("--link-hours", "0.0000001")) as h:
            code, _, errors = run("join", h.greeting["link"], "--json", "--seconds", "1")
            self.assertNotEqual(code, 0)
            self.assertIn("expired", errors)

    def test_three_publishers_come_and_go_while_two_watch_and_one_records(self):
        choice = random.Random(1)
        file = self.folder / "many.mkv"
        with host(self.state, self.cameras["lamp"]) as h, contextlib.ExitStack() as stack:
            watching = [stack.enter_context(viewer(h.greeting["link"], "--depth-codec", codec))
                        for codec in ("strata", "zstd")]
            for one in watching:
                one.wait_for(lambda f: f["fps"] > 0)
            recorder = stack.enter_context(Process("record", h.greeting["link"], file, "--name", "OR recorder"))
            stay = stack.enter_context(viewer(h.greeting["publish_link"], "--publish", self.cameras["face"],
                                              "--may-record"))
            for one in watching:
                one.wait_for(lambda f: camera(f, 1) and camera(f, 1)["frames"] > 20)
            others = {}
            for _ in range(6):
                which = choice.randrange(2)
                if which in others:
                    others.pop(which).__exit__()
                else:
                    others[which] = viewer(h.greeting["publish_link"], "--publish", self.cameras["hand"])
                    stack.callback(others[which].__exit__)
                seen = camera(watching[0].newest_json(), 0)["frames"]
                watching[0].wait_for(lambda f: camera(f, 0)["frames"] > seen + 20)  # time between two changes
            for one in watching:
                figures = one.wait_for(lambda f: len(f["cameras"]) == 2 + len(others))
                one.wait_for(lambda f: all(camera(f, n)["frames"] > camera(figures, n)["frames"] + 5 for n in (0, 1)))
            figures = stay.newest_json()
            self.assertEqual(figures["joins"], 1)
            self.assertEqual([one["name"] for one in figures["recordings"]], ["OR recorder"], "all see who records")
            self.assertGreater(figures["recordings"][0]["seconds"], 1)
            recorder.process.terminate()
            # When a camera joins, a segment begins, with key frames; pictures before them are missing (exit code 3).
            self.assertIn(recorder.end(), (0, 3), recorder.errors)
        code, out, errors = run("inspect", file)
        self.assertIn(code, (0, 3), errors)
        for name in ("lamp", "face"):
            self.assertIn(name, out)
        self.assertNotIn("hand", out, "its participant has not agreed")
        self.assertTrue(any("Camera hand is left out" in line for line in recorder.errors), recorder.errors)


if __name__ == "__main__":
    unittest.main()
