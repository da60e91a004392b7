# SPDX-License-Identifier: Apache-2.0
"""Host and participants as processes: joining, slow and dying peers, bad input."""
import json
import pathlib
import re
import shutil
import signal
import socket
import tempfile
import unittest

from theatron_process import DATA, Process, host, make_recording, read_png, run, wait_until, write_png


class Session(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="theatron_e2e_"))
        cls.recording = make_recording(cls.folder / "box")
        cls.camera = f"folder:{cls.recording},loop=1,preload=1"
        cls.state = cls.folder / "state"

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder)

    def test_a_viewer_sees_what_the_camera_saw(self):
        still = self.folder / "still"
        (still / "depth").mkdir(parents=True)
        (still / "color").mkdir()
        for kind in ("depth", "color"):
            shutil.copy(self.recording / kind / "00003.png", still / kind / "00000.png")
        picture, depth = self.folder / "view.png", self.folder / "view_depth.png"
        for renderer in ("mesh", "splat"):
            with self.subTest(renderer=renderer), host(self.state, f"folder:{still},loop=1") as h:
                code, out, errors = run("join", h.greeting["link"], "--offscreen", picture, "--depth", depth,
                                        "--renderer", renderer, "--size", "160x120", "--seconds", "0.5",
                                        "--color-codec", "raw", "--json")
                self.assertEqual(code, 0, errors)
                self.assertEqual(json.loads(out)["codec"], "strata raw")
                _, _, _, source = read_png(still / "depth" / "00000.png")
                _, _, _, seen = read_png(depth)
                _, _, _, color = read_png(still / "color" / "00000.png")
                _, _, _, drawn = read_png(picture)
                valid = near = same = 0
                for y in range(2, 118):
                    for x in range(2, 158):
                        block = [source[y + dy][x + dx] for dy in (-1, 0, 1) for dx in (-1, 0, 1)]
                        if max(block) - min(block) > 20:
                            continue  # at a jump in depth the surface is torn
                        valid += 1
                        near += abs(seen[y][x] - source[y][x]) <= 5
                        same += all(abs(color[y][3 * x + i] - drawn[y][3 * x + i]) <= 24 for i in range(3))
                self.assertGreater(near / valid, 0.95)
                self.assertGreater(same / valid, 0.95)

    def test_codecs_are_chosen_and_changed_live(self):
        with host(self.state, self.camera) as h, \
                Process("join", h.greeting["link"], "--depth-codec", "zstd", "--every", "0.2") as viewer:
            viewer.wait_for(lambda f: f["codec"].startswith("zstd") and f["fps"] > 0)
            viewer.say("depth rvl")
            viewer.say("color raw")
            viewer.wait_for(lambda f: f["codec"] == "rvl raw" and f["fps"] > 0)
            viewer.say("depth nonsense")
            wait_until(lambda: "nonsense" in "".join(viewer.errors))
            frames = viewer.newest_json()["cameras"][0]["frames"]
            viewer.wait_for(lambda f: f["codec"] == "rvl raw" and f["cameras"][0]["frames"] > frames + 30)
            viewer.say("quit")
            self.assertEqual(viewer.end(), 0)

    def test_a_stopped_viewer_harms_nobody_and_comes_back(self):
        with host(self.state, self.camera) as h, \
                Process("join", h.greeting["link"], "--every", "0.2") as lively, \
                Process("join", h.greeting["link"], "--depth-codec", "zstd", "--every", "0.2") as sleeper:
            for viewer in (lively, sleeper):
                viewer.wait_for(lambda f: f["cameras"] and f["cameras"][0]["frames"] > 20)
            def encoded():
                _, out, _ = run("status", h.greeting["link"], "--json")
                camera = json.loads(out)["cameras"][0]
                return camera["frames"] - camera["dropped"]["newer"]
            memory = h.memory_mb()
            slept = sleeper.newest_json()["cameras"][0]
            sleeper.send(signal.SIGSTOP)
            before = lively.newest_json()["cameras"][0]["frames"]
            encoded_before = encoded()
            # Five seconds of the camera, however long a busy machine takes for them.
            lively.wait_for(lambda f: f["cameras"][0]["frames"] >= before + 5 * 30)
            made = encoded() - encoded_before
            lively.newest_json()
            after = lively.read_json()["cameras"][0]["frames"]  # a report from behind the host's
            self.assertGreater(after - before, 0.9 * made)
            self.assertLess(h.memory_mb(), memory + 16)
            newest = lively.newest_json()["cameras"][0]["newest_frame"]
            sleeper.send(signal.SIGCONT)
            # It is given the newest frame again, and not all that it slept through.
            awake = sleeper.wait_for(lambda f: f["cameras"][0]["newest_frame"] > newest)["cameras"][0]
            self.assertLess(awake["frames"] - slept["frames"], (awake["newest_frame"] - slept["newest_frame"]) / 2)

    def test_viewers_find_back_after_the_host_was_killed(self):
        with socket.socket() as probe:
            probe.bind(("127.0.0.1", 0))
            port = probe.getsockname()[1]
        listen = f"127.0.0.1:{port}"
        with host(self.state, self.camera, listen=listen) as first, \
                Process("join", first.greeting["link"], "--every", "0.2") as viewer:
            viewer.wait_for(lambda f: f["fps"] > 0)
            first.send(signal.SIGKILL)
            first.end()
            viewer.wait_for(lambda f: f["phase"] == "lost")
            with host(self.state, self.camera, listen=listen):
                found = viewer.wait_for(lambda f: f["phase"] == "joined" and f["joins"] == 2)
                self.assertEqual(found["host"], "operating room")
            self.assertIn("Reconnecting", "".join(viewer.errors))

    def test_a_session_that_the_host_ends_is_over_for_everybody(self):
        file = self.folder / "over.mkv"
        with host(self.state, self.camera) as h, \
                Process("join", h.greeting["link"], "--every", "0.2") as viewer, \
                Process("record", h.greeting["link"], file, "--json") as recorder:
            viewer.wait_for(lambda f: f["fps"] > 0)
            while not file.exists() or file.stat().st_size < 50_000:
                viewer.read_json()
            h.send(signal.SIGINT)
            self.assertEqual(h.end(), 0)
            for guest in (viewer, recorder):
                self.assertEqual(guest.end(), 0, guest.errors)
                self.assertIn("The host has ended the session.", "".join(guest.errors))
                self.assertNotIn("Reconnecting", "".join(guest.errors))

    def test_nobody_notices_a_killed_viewer(self):
        with host(self.state, self.camera) as h, \
                Process("join", h.greeting["link"], "--every", "0.2") as stays, \
                Process("join", h.greeting["link"], "--every", "0.2") as dies:
            for viewer in (stays, dies):
                viewer.wait_for(lambda f: f["cameras"] and f["cameras"][0]["frames"] > 20)
            dies.send(signal.SIGKILL)
            dies.end()
            before = stays.newest_json()["cameras"][0]["frames"]
            figures = stays.wait_for(lambda f: f["cameras"][0]["frames"] >= before + 2 * 30)
            self.assertEqual(figures["phase"], "joined")
            self.assertEqual(figures["joins"], 1)
            self.assertIsNone(h.process.poll())

    def test_an_ended_camera_is_shown_to_those_who_come_later(self):
        with host(self.state, f"folder:{self.recording}") as h:
            def state():
                _, out, _ = run("status", h.greeting["link"], "--json")
                return json.loads(out)["cameras"][0]["state"]
            wait_until(lambda: state() == "ended")
            picture = self.folder / "ended.png"
            code, out, errors = run("join", h.greeting["link"], "--offscreen", picture, "--size", "160x120",
                                    "--seconds", "0.5", "--json")
            self.assertEqual(code, 0, errors)
            self.assertEqual(json.loads(out)["cameras"][0]["state"], "ended")
            self.assertTrue(picture.exists())

    def refused(self, expected, *arguments):
        code, _, errors = run(*arguments)
        self.assertNotEqual(code, 0, arguments)
        message = [line for line in errors.splitlines() if line.startswith("theatron:")]
        self.assertEqual(len(message), 1, errors)
        self.assertIn(expected, message[0])

    def test_bad_cameras_are_named_in_one_sentence(self):
        state = ("--state", self.state, "--listen", "127.0.0.1:0")
        self.refused("no camera 'banana'", "host", *state, "--camera", "banana:1")
        self.refused("missing", "host", *state, "--camera", f"folder:{self.folder}/missing")
        self.refused("'bogus'", "host", *state, "--camera", f"folder:{self.recording},bogus=1")
        odd = self.folder / "odd"
        shutil.copytree(self.recording, odd)
        write_png(odd / "depth" / "00007.png", 80, 60, 16, 1, [bytes(160)] * 60)
        with host(self.state, f"folder:{odd},preload=1") as h:
            h.wait_for_error("00007.png")  # is left out
        fake = self.folder / "fake"
        (fake / "depth").mkdir(parents=True)
        (fake / "depth" / "00000.png").write_text("this is no picture")
        self.refused("00000.png", "host", *state, "--camera", f"folder:{fake}")

    def test_bad_joins_are_refused_in_one_sentence(self):
        with host(self.state, self.camera) as h:
            link = h.greeting["link"]
            self.refused("access code of this link is wrong", "join", link.replace("join=", "join=x"), "--seconds", "1", "--no-window")
            other = re.sub("cert=[0-9a-f]{4}", "cert=0000", link)
            self.refused("another certificate", "join", other, "--no-window", "--seconds", "1")
            self.refused("'banana' does not exist", "join", link, "--depth-codec", "banana", "--seconds", "1")
            self.refused("no way of drawing", "join", link, "--renderer", "banana", "--offscreen", self.folder / "x.png")
            self.refused("link", "join", "nonsense", "--seconds", "1")
            self.refused("is in use", "host", "--state", self.folder / "other", "--camera", "folder:/opens-later", "--listen",
                         f"127.0.0.1:{h.greeting['port']}")
            # Nothing of this disturbed the host.
            code, out, _ = run("join", link, "--seconds", "1", "--json")
            self.assertEqual(code, 0)
            self.assertGreater(json.loads(out)["cameras"][0]["frames"], 0)

    def test_strangers_and_noise_do_not_disturb_the_host(self):
        with host(self.state, self.camera) as h:
            for noise in (b"GET / HTTP/1.1\r\n\r\n", b"\x16\x03\x01" + bytes(200), b""):
                with socket.create_connection(("127.0.0.1", h.greeting["port"])) as stranger:
                    stranger.sendall(noise)
            code, _, errors = run("join", h.greeting["link"], "--no-window", "--seconds", "0.5")
            self.assertEqual(code, 0, errors)

    @unittest.skipUnless((DATA / "table-person_640x360").exists(), "no recorded sequences beside the checkout")
    def test_real_recordings_render_the_person_at_the_table(self):
        cameras = [f"folder:{DATA}/table-person_640x360,loop=1",
                   f"mkv:{DATA}/azure-nfov-unbinned-1frame_640x576/recording.mkv"]
        picture = self.folder / "table.png"
        with host(self.state, *cameras) as h:
            code, out, errors = run("join", h.greeting["link"], "--offscreen", picture, "--renderer", "mesh",
                                    "--size", "640x360", "--seconds", "2", "--json")
            self.assertEqual(code, 0, errors)
            self.assertEqual(len(json.loads(out)["cameras"]), 2)
            _, _, _, rows = read_png(picture)
            # The white table fills the upper middle of the picture.
            bright = sum(rows[y][3 * x] > 120 for y in range(20, 120) for x in range(150, 500))
            self.assertGreater(bright / (100 * 350), 0.8)


if __name__ == "__main__":
    unittest.main()
