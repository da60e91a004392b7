# SPDX-License-Identifier: Apache-2.0
"""Pictures that go from their publisher straight to a receiver, in three networks that reach each other."""
import contextlib
import json
import os
import pathlib
import shutil
import tempfile
import unittest
import urllib.parse

import shaped_link
import patience
from theatron_process import PROGRAM, Process, host, make_recording, wait_until
from three_networks import ThreeNetworks, missing


def at(link, address):
    """The same link for those who see the host at another address."""
    parts = urllib.parse.urlsplit(link)
    return parts._replace(netloc=f"{address}:{parts.port}").geturl()


class Meeting:
    """A host without cameras, a publisher and a receiver, each in its own network."""

    def __init__(self, networks, folder, camera, options=()):
        self.networks, self.options = networks, options
        self.folder, self.camera = folder, camera

    def __enter__(self):
        n = self.networks
        self.host = host(self.folder / "state", listen="0.0.0.0:0", prefix=n.at("host"), options=self.options)
        links = self.host.greeting
        self.status_link = at(links["link"], "127.0.0.1")
        self.publisher = Process("publish", at(links["publish_link"], n.AT_PUBLISHER), "--camera", self.camera,
                                 prefix=n.at("publisher"))
        self.receiver = Process("join", at(links["link"], n.AT_RECEIVER), "--every", "0.05",
                                prefix=n.at("receiver"))
        return self

    def __exit__(self, *_):
        for process in (self.receiver, self.publisher, self.host):
            process.__exit__()

    def wait_for(self, condition):
        """The camera at the receiver as soon as that is true of it."""
        figures = self.receiver.wait_for(lambda f: f["cameras"] and condition(f["cameras"][0]))
        return figures["cameras"][0]

    def status(self):
        done = patience.run([*self.networks.at("host"), PROGRAM, "status", self.status_link, "--json"])
        if done.returncode != 0:
            raise AssertionError(done.stderr)
        return json.loads(done.stdout)

    def host_bytes(self):
        """That the host has received of the camera."""
        return self.status()["published"][0]["bytes"]


class DirectSending(unittest.TestCase):
    def setUp(self):
        if why := missing():
            self.skipTest(why)
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="theatron_direct_"))
        self.addCleanup(shutil.rmtree, self.folder)
        self.camera = f"folder:{make_recording(self.folder / 'cart')},loop=1,preload=1"

    def test_the_host_carries_nothing_until_the_direct_way_is_cut(self):
        with ThreeNetworks() as networks, Meeting(networks, self.folder, self.camera) as meeting:
            direct = meeting.wait_for(lambda c: c["direct"])
            meeting.wait_for(lambda c: c["newest_frame"] > direct["newest_frame"] + 15)
            # The publisher may still be sending what it was told too late not to send.
            before = meeting.host_bytes()
            while (now := meeting.host_bytes()) != before:
                before = now
            begun = meeting.wait_for(lambda c: True)
            later = meeting.wait_for(lambda c: c["newest_frame"] >= begun["newest_frame"] + 30)
            self.assertTrue(later["direct"], later)
            status = meeting.status()
            self.assertEqual(status["published"][0]["bytes"], before, "the host carries none of these frames")
            self.assertEqual([p["direct"] for p in status["participants"] if p["name"] != "cameras"], [[0]])

            networks.cut()
            last = meeting.wait_for(lambda c: not c["direct"])
            meeting.wait_for(lambda c: c["newest_frame"] > last["newest_frame"])
            self.assertGreater(meeting.host_bytes(), before)

            networks.mend()
            again = meeting.wait_for(lambda c: c["direct"])
            meeting.wait_for(lambda c: c["newest_frame"] > again["newest_frame"] + 5)
            self.assertEqual(meeting.receiver.newest_json()["joins"], 1)

    def test_the_host_may_forbid_it(self):
        with ThreeNetworks() as networks, \
                Meeting(networks, self.folder, self.camera, ["--direct", "off"]) as meeting:
            first = meeting.wait_for(lambda c: c["frames"] > 0)
            later = meeting.wait_for(lambda c: c["frames"] > first["frames"] + 30)
            self.assertFalse(later["direct"])


class FullUplink(unittest.TestCase):
    def test_receivers_that_the_publishers_link_does_not_carry_get_the_hosts_copy(self):
        if why := shaped_link.missing():
            self.skipTest(why)
        folder = pathlib.Path(tempfile.mkdtemp(prefix="theatron_uplink_"))
        self.addCleanup(shutil.rmtree, folder)
        camera = f"folder:{make_recording(folder / 'cart')},loop=1,preload=1,fps=12"
        # 3.7 Mbit/s for each copy: one passes, and three do not.
        with contextlib.ExitStack() as stack:
            link = stack.enter_context(shaped_link.ShapedLink("rate_mbit=5", "delay_ms=5", "buffer_ms=300"))
            h = stack.enter_context(host(folder / "state", listen="0.0.0.0:0", prefix=link.at_host()))
            program = lambda word, of, *words, **options: stack.enter_context(Process(
                word, at(h.greeting[of], shaped_link.HOST_ADDRESS), *words,
                env={**os.environ, "XDG_STATE_HOME": str(folder / words[-1])}, **options))
            publisher = program("publish", "publish_link", "--camera", camera, "--name", "cart", prefix=link.at_viewer())
            receivers = [program("join", "link", "--every", "0.1", "--depth-codec", "raw", "--name", name,
                                 prefix=link.at_host()) for name in ("Ann", "Ben", "Eva")]
            for receiver in receivers:
                receiver.wait_for(lambda f: f["cameras"] and f["cameras"][0]["frames"] > 0)
            said = lambda text: sum(text in line for line in publisher.errors)
            wait_until(lambda: said("receiver is left to the host") >= 2)
            frames = [receiver.newest_json()["cameras"][0]["frames"] for receiver in receivers]
            for receiver, before in zip(receivers, frames):
                receiver.wait_for(lambda f: f["cameras"][0]["frames"] > before + 30)
            self.assertLessEqual(said("receivers=3"), 2, "all three together are not tried again and again")


if __name__ == "__main__":
    unittest.main()
