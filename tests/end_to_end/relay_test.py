# SPDX-License-Identifier: Apache-2.0
"""Pictures that come from a relay: who gets them from it, what the relay may know, and what happens when it ends."""
import json
import pathlib
import shutil
import signal
import socket
import tempfile
import unittest

import patience
from theatron_process import PROGRAM, Process, host, make_recording, wait_until


class Relays(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="theatron_relay_"))
        self.addCleanup(shutil.rmtree, self.folder)
        camera = f"folder:{make_recording(self.folder / 'cart')},loop=1,preload=1"
        self.host = self.enterContext(host(self.folder / "state", camera))
        self.relay_link = self.link("relay")

    def enterContext(self, context):
        entered = context.__enter__()
        self.addCleanup(context.__exit__, None, None, None)
        return entered

    def link(self, role):
        done = patience.run([PROGRAM, "link", "--role", role, "--state", self.folder / "state", "--json"])
        self.assertEqual(done.returncode, 0, done.stderr)
        return json.loads(done.stdout)["link"]

    def relay(self, *options):
        relay = self.enterContext(Process("relay", self.relay_link, "--listen", "127.0.0.1:0", "--address", "127.0.0.1",
                                          "--every", "0.1", *options))
        relay.wait_for(lambda f: f["phase"] == "joined")
        wait_until(lambda: any("receivers come to" in line for line in relay.errors))
        return relay

    def join(self, *options):
        return self.enterContext(Process("join", self.host.greeting["link"], "--every", "0.05", *options))

    def status(self):
        done = patience.run([PROGRAM, "status", self.host.greeting["link"], "--json"])
        self.assertEqual(done.returncode, 0, done.stderr)
        return json.loads(done.stdout)

    @staticmethod
    def camera(process, condition):
        figures = process.wait_for(lambda f: f["cameras"] and condition(f["cameras"][0]))
        return figures["cameras"][0]

    def go_on(self, process, relayed):
        """Thirty more pictures of the camera come, all of them on this way."""
        begun = self.camera(process, lambda c: c["frames"] > 0 and c["relayed"] == relayed)
        later = self.camera(process, lambda c: c["newest_frame"] > begun["newest_frame"] + 30)
        self.assertEqual(later["relayed"], relayed, later)
        return later

    def test_receivers_get_the_pictures_from_the_relay_and_the_host_sends_them_once(self):
        relay = self.relay("--name", "Ward 3")
        first = self.join("--name", "Ann")
        self.go_on(first, True)
        second = self.join("--name", "Ben")
        exact = self.go_on(second, True)
        self.assertEqual(exact["depth_exact"], "everywhere")
        figures = relay.wait_for(lambda f: f["receivers"] == 2)
        self.assertEqual(figures["strangers"], 0)
        people = {p["name"]: p for p in self.status()["participants"]}
        number = people["Ward 3"]["id"]
        self.assertEqual(people["Ward 3"]["role"], "relay")
        for name in ("Ann", "Ben"):
            self.assertEqual((people[name]["relay"], people[name]["relayed"]), (number, [0]))
        # Twice as much goes out as comes in, but for the beginning.
        before = relay.newest_json()
        after = relay.wait_for(lambda f: f["frames_in"] > before["frames_in"] + 60)
        received = after["bytes_in"] - before["bytes_in"]
        self.assertAlmostEqual((after["bytes_out"] - before["bytes_out"]) / received, 2, delta=0.2)

    def test_when_the_relay_is_killed_the_host_sends_and_a_new_relay_takes_over(self):
        relay = self.relay()
        viewer = self.join()
        self.go_on(viewer, True)
        relay.process.send_signal(signal.SIGKILL)
        self.go_on(viewer, False)
        self.relay()
        self.go_on(viewer, True)
        self.assertEqual(viewer.newest_json()["joins"], 1)

    def test_a_relay_that_stands_still_is_left_until_it_goes_on(self):
        relay, viewer = self.relay(), self.join()
        self.go_on(viewer, True)
        relay.send(signal.SIGSTOP)
        self.go_on(viewer, False)
        relay.send(signal.SIGCONT)
        self.go_on(viewer, True)

    def test_strangers_at_its_port_cost_receivers_nothing(self):
        relay, viewer = self.relay(), self.join()
        self.go_on(viewer, True)
        port = relay.newest_json()["port"]
        strangers = [socket.create_connection(("127.0.0.1", port)) for _ in range(100)]
        for i, stranger in enumerate(strangers):
            self.addCleanup(stranger.close)
            # Nothing, a page's request, or what is no TLS.
            stranger.sendall((b"", b"GET / HTTP/1.1\r\nHost: relay\r\n\r\n", bytes(range(256)) * 4)[i % 3])
        self.go_on(viewer, True)

    def test_of_two_relays_the_other_one_takes_over(self):
        relays = [self.relay("--name", "one"), self.relay("--name", "two")]
        viewer = self.join()
        self.go_on(viewer, True)
        serving = next(r for r in relays if r.newest_json()["receivers"] == 1)
        other = next(r for r in relays if r is not serving)
        serving.process.send_signal(signal.SIGKILL)
        other.wait_for(lambda f: f["receivers"] == 1)
        self.go_on(viewer, True)
        self.assertEqual(viewer.newest_json()["joins"], 1)

    def test_a_relay_that_cannot_be_reached_costs_no_picture(self):
        # Nobody listens at port 9 of that address; the relay itself does not know.
        self.enterContext(Process("relay", self.relay_link, "--listen", "127.0.0.1:0", "--address", "127.0.0.2",
                                  "--for", "10.99.0.0/16"))
        self.go_on(self.join(), False)

    def test_who_wants_no_relay_or_records_gets_all_from_the_host(self):
        relay = self.relay()
        self.go_on(self.join("--relay", "off"), False)
        self.enterContext(Process("record", self.host.greeting["link"], self.folder / "out.mkv", "--name", "tape"))
        wait_until(lambda: (self.folder / "out.mkv").exists() and (self.folder / "out.mkv").stat().st_size > 300_000)
        people = {p["name"]: p for p in self.status()["participants"]}
        self.assertEqual((people["tape"]["relay"], people["tape"]["relayed"]), (None, []))
        self.assertEqual(relay.newest_json()["receivers"], 0)

    def test_a_revoked_receiver_is_out_and_the_others_go_on(self):
        relay = self.relay()
        done = patience.run([PROGRAM, "link", "--role", "expert", "--state", self.folder / "state", "--json"])
        made = json.loads(done.stdout)
        guest = self.enterContext(Process("join", made["link"], "--every", "0.05"))
        other = self.join()
        self.go_on(guest, True)
        self.go_on(other, True)
        done = patience.run([PROGRAM, "link", "--revoke", made["name"], "--state", self.folder / "state"])
        self.assertEqual(done.returncode, 0, done.stderr)
        relay.wait_for(lambda f: f["named"] == 1 and f["receivers"] == 1)
        self.assertNotEqual(guest.process.wait(), 0)
        # With the session's next key.
        self.go_on(other, True)

    def test_a_revoked_relay_is_out(self):
        name = self.relay_name()
        relay = self.relay()
        viewer = self.join()
        self.go_on(viewer, True)
        done = patience.run([PROGRAM, "link", "--revoke", name, "--state", self.folder / "state"])
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertNotEqual(relay.process.wait(), 0)
        self.go_on(viewer, False)

    def relay_name(self):
        done = patience.run([PROGRAM, "link", "--list", "--state", self.folder / "state", "--json"])
        return next(link["name"] for link in json.loads(done.stdout) if link["role"] == "relay")

    def test_links_are_for_what_they_say(self):
        for words, sentence in ((["join", self.relay_link, "--no-window", "--seconds", "5"], "theatron relay"),
                                (["record", self.relay_link, self.folder / "recording", "--seconds", "5"], "theatron relay"),
                                (["relay", self.host.greeting["link"], "--seconds", "5"], "--role relay")):
            done = patience.run([PROGRAM, *words])
            self.assertNotEqual(done.returncode, 0, words)
            self.assertIn(sentence, done.stderr)

    def test_mistakes_are_said_before_anything_begins(self):
        for options, sentence in ((["--for", "10.2.0.0/99"], "no IPv4 network"),
                                  (["--address", "https://relay:1"], "no name or address"),
                                  (["--listen", "nowhere"], "nowhere")):
            done = patience.run([PROGRAM, "relay", self.relay_link, *options])
            self.assertNotEqual(done.returncode, 0, options)
            self.assertIn(sentence, done.stderr)


if __name__ == "__main__":
    unittest.main()
