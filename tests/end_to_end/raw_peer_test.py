# SPDX-License-Identifier: Apache-2.0
"""The peers that tests speak through are understood by the program, and understand it."""
import pathlib
import tempfile
import threading
import unittest

from raw_peer import FakeHost, RawPeer, https_get, media_message
from theatron_process import Process, host, make_recording


class RawPeers(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="theatron_raw_")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def test_a_raw_peer_joins_and_is_sent_pictures(self):
        recording = make_recording(self.folder / "box", frames=3)
        with host(self.folder / "state", f"folder:{recording},loop=1") as h, \
                RawPeer(h.greeting["link"]) as peer:
            peer.join(name=b"G\xc3\xa4ste", depth_codec="zstd")
            self.assertEqual(peer.receive_control("Welcome")[1]["host_name"], "operating room")
            settings = peer.receive_control("Settings")[1]["settings"]
            self.assertIn("zstd", settings[0]["codec"])
            peer.send_control("Ping", sent_us=5)
            self.assertEqual(peer.receive_control("Pong")[1]["ping_sent_us"], 5)
            while peer.receive()[0] != 2:
                pass
            self.assertEqual(https_get(h.greeting["link"], "/status")[0], 401)

    def test_a_participant_of_protocol_1_is_told_that_it_is_too_old(self):
        recording = make_recording(self.folder / "box", frames=3)
        with host(self.folder / "state", f"folder:{recording},loop=1") as h, RawPeer(h.greeting["link"]) as peer:
            peer.join(protocol_min=1, protocol_max=1)
            self.assertIn("too old", peer.receive_control("Refused")[1]["in_english"])

    def test_a_viewer_joins_a_fake_host_and_notices_damage(self):
        asked, left = threading.Event(), threading.Event()

        def script(guest):
            self.assertEqual(guest.receive_control()[0], "Join")
            guest.welcome()
            guest.settings()
            guest.send_media(media_message(b"no depth image"))
            self.assertEqual(guest.receive_control("RequestKey")[1].get("setting"), 1)
            asked.set()
            left.wait()

        with FakeHost(script) as fake, Process("join", fake.link, "--no-window", "--every", "0.2") as viewer:
            seen = viewer.wait_for(lambda f: f["phase"] == "joined")
            self.assertEqual(seen["host"], "fake host")
            viewer.wait_until(lambda: asked.is_set() or fake.faults)
            left.set()
            self.assertEqual(fake.faults, [])


if __name__ == "__main__":
    unittest.main()
