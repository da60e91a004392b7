# SPDX-License-Identifier: Apache-2.0
"""Recordings under faults: other clocks, slow and full disks, restarts, guests, cameras that are unplugged."""
import contextlib
import json
import os
import pathlib
import shutil
import signal
import socket
import struct
import subprocess
import tempfile
import time
import unittest

from raw_peer import ACKNOWLEDGEMENT, FakeHost, RawPeer, camera, media_message
from slow_disk import SlowDisk
from theatron_process import PROGRAM, Process, host, make_recording, run, wait_until, write_png

DAY_S = 86_400
COMPLETE, ENDED_BY_THE_DISK, INCOMPLETE = 0, 1, 3
BUFFER_MB = 1


def clock_ahead(seconds):
    """A command prefix that sets the steady clock ahead; None where that is not allowed."""
    prefix = ("unshare", "--time", "--monotonic", str(seconds))
    if subprocess.run([*prefix, "true"], capture_output=True).returncode != 0:
        return None
    return prefix


def make_noise(folder, width, height, frames=3):
    """Depth of which no codec makes much less than a byte for each pixel."""
    (folder / "depth").mkdir(parents=True)
    for n in range(frames):
        rows = [b"".join(bytes((5, low)) for low in os.urandom(width)) for _ in range(height)]
        write_png(folder / "depth" / f"{n:05}.png", width, height, 16, 1, rows)
    return folder


class RecordFaults(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="theatron_e2e_"))
        self.source = make_recording(self.folder / "source", 160, 120, 6, color=False)
        self.camera = f"folder:{self.source},loop=1,preload=1"
        self.state = self.folder / "state"
        self.file = self.folder / "a.mkv"

    def tearDown(self):
        shutil.rmtree(self.folder)

    def recorder(self, *arguments, **options):
        return Process("record", *arguments, "--json", **options)

    def begun(self, recorder, file=None, more_than=3000):
        """Waits until some of the file is there."""
        file = file or self.file
        wait_until(lambda: recorder.process.poll() is not None or file.exists() and file.stat().st_size > more_than)
        self.assertIsNone(recorder.process.poll(), "".join(recorder.errors))

    def ends(self, recorder, expected, sig=signal.SIGINT):
        """Ends it and returns its figures."""
        if sig:
            recorder.send(sig)
        figures = recorder.read_json()
        self.assertEqual(recorder.end(), expected, "".join(recorder.errors) + json.dumps(figures))
        self.assertEqual(figures["complete"], expected == COMPLETE)
        code, out, _ = run("inspect", self.file, "--json")
        if code == 0:
            self.assertEqual(json.loads(out)["complete"], figures["complete"], out)
        return figures

    def assert_decodes(self, file, at_least=1):
        """Every picture of camera 0 that is in the file can be decoded."""
        code, out, errors = run("inspect", file, "--json")
        self.assertEqual(code, 0, errors)
        depth = json.loads(out)["cameras"][0]["depth"]
        target = self.folder / "png"
        code, _, errors = run("export", file, "--camera", 0, "--png", target)
        # A file that a fault ended may be without its end, which is an exit code of its own.
        lacks = ("was not closed", "it stopped early", "it is not complete")
        self.assertEqual(code, INCOMPLETE if any(words in errors for words in lacks) else 0, errors)
        self.assertEqual(len(list(target.glob("depth/*.png"))), depth["frames"])
        self.assertGreaterEqual(depth["frames"], at_least)
        shutil.rmtree(target)
        return depth

    def test_clocks_that_are_a_day_apart_lose_nothing(self):
        ahead = clock_ahead(DAY_S)
        if not ahead:
            self.skipTest("time namespaces are not allowed here")
        for host_prefix, recorder_prefix in (((), ahead), (ahead, ())):
            with host(self.state, self.camera, prefix=host_prefix) as h, \
                    self.recorder(h.greeting["link"], self.file, prefix=recorder_prefix) as recorder:
                self.begun(recorder, more_than=10_000)
                figures = self.ends(recorder, COMPLETE)
            self.assertEqual(figures["lost"] + figures["dropped"], 0)
            self.assertEqual(self.assert_decodes(self.file)["frames"], figures["cameras"][0]["depth"]["pictures"])
            self.file.unlink()

    def test_pictures_are_acknowledged_also_after_the_sessions_clock_proves_to_be_far_behind(self):
        told = []

        def acknowledged(guest):
            while (envelope := guest.receive())[0] != ACKNOWLEDGEMENT:
                pass
            told.append(struct.unpack_from("<Q", envelope, 1)[0])

        def script(guest):
            guest.receive_control("Join")
            guest.welcome(cameras=[camera(0, has_color=False)])
            guest.send_control("Settings", settings=[{"stream": 0, "setting": 1, "codec": "strata"}])
            guest.send_media(media_message(bytes(10_000), frame=1, captured_us=1))
            acknowledged(guest)
            _, ping = guest.receive_control("Ping")
            guest.send_control("Pong", ping_sent_us=ping["sent_us"], received_us=1, sent_us=1)
            guest.send_media(media_message(bytes(10_000), frame=2, captured_us=2))
            acknowledged(guest)
            guest.send_control("CameraState", camera=0, state=2)
            guest.wait_for_end()

        with FakeHost(script) as fake, self.recorder(fake.link, self.file) as recorder:
            recorder.wait_for_error("camera 0 has ended")
            self.ends(recorder, COMPLETE)
            self.assertEqual(fake.faults, [])
        self.assertGreater(told[1], told[0] + 10_000)

    def record_from_a_fake_host(self, cameras, expected):
        """Pictures of camera 0 come before the session's clock is known, then others in another codec."""
        def script(guest):
            guest.receive_control("Join")
            guest.welcome(cameras=[camera(number, has_color=False) for number in range(cameras)])

            def settings(number, codec):
                guest.send_control("Settings", settings=[{"stream": 2 * n, "setting": number, "codec": codec}
                                                         for n in range(cameras)])

            def pictures(setting, first):
                for n in range(first, first + 5):
                    guest.send_media(media_message(b"12345678", setting=setting, frame=n, key=n == first,
                                                   reference=max(first, n - 1), captured_us=10**12 + n * 33_333))

            settings(1, "trvl")
            pictures(1, 10)
            _, ping = guest.receive_control("Ping")
            guest.send_control("Pong", ping_sent_us=ping["sent_us"], received_us=10**12, sent_us=10**12)
            settings(2, "strata")
            pictures(2, 15)
            for n in range(cameras):
                guest.send_control("CameraState", camera=n, state=2)
            guest.wait_for_end()

        with FakeHost(script) as fake, self.recorder(fake.link, self.file) as recorder:
            recorder.wait_for_error(f"camera {cameras - 1} has ended")
            figures = self.ends(recorder, expected)
            self.assertEqual(fake.faults, [])
        self.assertEqual(figures["cameras"][0]["depth"]["pictures"], 10)
        self.assertEqual(figures["lost"] + figures["dropped"], 0)
        self.assertEqual(figures["segments"], 2)
        return figures

    def test_other_codecs_of_a_host_go_into_a_new_segment_without_loss(self):
        self.record_from_a_fake_host(1, COMPLETE)

    def test_a_stream_without_any_picture_is_missing(self):
        figures = self.record_from_a_fake_host(2, INCOMPLETE)
        self.assertEqual(figures["cameras"][1]["depth"]["pictures"], 0)

    def test_a_camera_whose_number_a_host_gives_again_is_recorded_once(self):
        def script(guest):
            guest.receive_control("Join")
            both = [camera(number, has_color=False) for number in range(2)]
            guest.welcome(cameras=both)

            def pictures(setting, first):
                guest.send_control("Settings", settings=[{"stream": 2, "setting": setting, "codec": "trvl"}])
                for frame in range(first, first + 5):
                    for stream in (0, 2):
                        guest.send_media(media_message(b"12345678", stream=stream, setting=setting if stream else 1, frame=frame, key=True,
                                                       reference=frame, captured_us=10**12 + frame * 33_333))

            guest.send_control("Settings", settings=[{"stream": 0, "setting": 1, "codec": "trvl"}])
            _, ping = guest.receive_control("Ping")
            guest.send_control("Pong", ping_sent_us=ping["sent_us"], received_us=10**12, sent_us=10**12)
            pictures(2, 0)
            guest.send_control("CamerasRemoved", cameras=[1])
            guest.send_control("CamerasAdded", cameras=both[1:])
            pictures(3, 5)
            for number in range(2):
                guest.send_control("CameraState", camera=number, state=2)
            guest.wait_for_end()

        with FakeHost(script) as fake, self.recorder(fake.link, self.file) as recorder:
            recorder.wait_for_error("camera 1 has ended")
            figures = self.ends(recorder, COMPLETE)
            self.assertEqual(fake.faults, [])
        self.assertEqual([c["depth"]["pictures"] for c in figures["cameras"]], [10, 10])
        self.assertEqual(figures["lost"] + figures["dropped"], 0)
        code, out, errors = run("inspect", self.file, "--json")
        self.assertEqual([c["depth"]["frames"] for c in json.loads(out)["cameras"]], [10, 10], errors)

    def test_a_stalled_disk_loses_only_what_exceeds_the_buffer_and_decodes_again(self):
        disk = SlowDisk(self.folder)
        file = disk.folder / "a.mkv"
        camera = f"folder:{make_noise(self.folder / 'noise', 320, 240)},loop=1,preload=1"
        with self.recorder("--camera", camera, file, "--depth-codec", "zstd:delta=1", "--buffer", BUFFER_MB,
                           env=disk.environment) as recorder:
            self.begun(recorder, file, 100_000)
            disk.be("stall")
            recorder.wait_for_error("Missing: ")
            before = file.stat().st_size
            disk.be("well")
            # The content of the buffer, and some frames that came afterwards.
            self.begun(recorder, file, before + (BUFFER_MB << 20) + 500_000)
            figures = self.ends(recorder, INCOMPLETE)
        self.assertGreater(figures["dropped"], 0)
        depth = figures["cameras"][0]["depth"]
        self.assertEqual(self.assert_decodes(file)["frames"], depth["pictures"])

    def test_a_stall_that_fits_the_buffer_loses_nothing(self):
        disk = SlowDisk(self.folder)
        file = disk.folder / "a.mkv"
        with self.recorder("--camera", self.camera, file, env=disk.environment) as recorder:
            self.begun(recorder, file)
            disk.be("stall")
            recorder.wait_for_error("The disk does not keep up")
            disk.be("well")
            recorder.wait_for_error("The disk keeps up again")
            figures = self.ends(recorder, COMPLETE)
        self.assertEqual(self.assert_decodes(file)["frames"], figures["pictures"])

    def test_a_disk_that_is_full_or_gone_ends_it_with_a_word_and_keeps_what_was_before(self):
        disk = SlowDisk(self.folder)
        for state in ("full", "gone"):
            file = disk.folder / f"{state}.mkv"
            with self.recorder("--camera", self.camera, file, env=disk.environment) as recorder:
                self.begun(recorder, file, 10_000)
                disk.be(state)
                figures = self.ends(recorder, ENDED_BY_THE_DISK, sig=None)
                self.assertIn("what came before is kept", figures["problem"])
            disk.be("well")
            depth = figures["cameras"][0]["depth"]
            self.assertEqual(self.assert_decodes(file)["frames"], depth["pictures"])
            self.assertGreater(depth["not_written"] + depth["dropped"], 0)
            if state == "full":
                self.assertIn("the disk was full", run("inspect", file)[1])

    def test_recovering_onto_a_full_disk_leaves_nothing_there(self):
        code, _, errors = run("record", "--camera", f"folder:{self.source}", self.file)
        self.assertIn(code, (COMPLETE, INCOMPLETE), errors)
        disk = SlowDisk(self.folder)
        disk.be("full")
        done = subprocess.run([PROGRAM, "recover", self.file, disk.folder / "b.mkv"], env=disk.environment,
                              capture_output=True, text=True)
        self.assertEqual(done.returncode, 1)
        self.assertIn("The disk is full", done.stderr)
        self.assertEqual(list(disk.folder.iterdir()), [])

    def test_a_size_limit_of_the_system_is_a_sentence(self):
        limited = ("bash", "-c", 'ulimit -f 20; exec "$@"', "-")  # blocks of 1024 bytes
        with self.recorder("--camera", self.camera, self.file, prefix=limited) as recorder:
            figures = self.ends(recorder, ENDED_BY_THE_DISK, sig=None)
        self.assertIn("size that the system allows", figures["problem"])
        self.assert_decodes(self.file)

    def test_a_file_that_is_deleted_meanwhile_is_noticed(self):
        second = self.folder / "a.002.mkv"
        with self.recorder("--camera", self.camera, self.file) as recorder:
            self.begun(recorder)
            self.file.unlink()
            recorder.wait_for_error("was deleted or renamed")
            self.begun(recorder, second)
            self.ends(recorder, INCOMPLETE)
        self.assertGreater(second.stat().st_size, 3000)

    @contextlib.contextmanager
    def two_segments(self):
        """A recorder that writes its second file, since a guest has come."""
        with host(self.state, self.camera) as h, \
                self.recorder(h.greeting["link"], self.file, "--depth-codec", "strata") as recorder:
            self.begun(recorder)
            with Process("publish", h.greeting["publish_link"], "--camera", self.camera, "--may-record"):
                self.begun(recorder, self.folder / "a.002.mkv")
                yield recorder

    def test_an_earlier_file_that_is_deleted_is_told_at_once_and_changes_nothing_else(self):
        with self.two_segments() as recorder:
            time.sleep(1)
            self.file.unlink()
            recorder.wait_for_error(f"'{self.file}' was deleted or renamed; it is a part of this recording")
            figures = self.ends(recorder, INCOMPLETE)
        self.assertEqual((figures["segments"], figures["gone_files"]), (2, [str(self.file)]))
        self.assertEqual(figures["lost"] + figures["dropped"], 0)

    def test_the_last_file_that_is_lost_is_missed(self):
        with self.two_segments() as recorder:
            self.ends(recorder, COMPLETE)
        self.assertEqual(run("inspect", self.file, "--verify")[0], COMPLETE)
        renamed = self.folder / "Müller, Operation 3.mkv"
        self.file.rename(renamed)
        code, out, errors = run("inspect", renamed, "--json")
        self.assertEqual((code, len(json.loads(out)["segments"])), (COMPLETE, 2), errors)
        (self.folder / "a.002.mkv").unlink()
        code, out, errors = run("inspect", renamed, "--verify")
        self.assertEqual(code, INCOMPLETE, errors)
        self.assertIn("at least 1 segment is missing", out + errors)
        code, out, errors = run("record", "--camera", f"recording:{renamed}", self.folder / "copy.mkv", "--json")
        self.assertEqual((code, json.loads(out)["complete"]), (INCOMPLETE, False), errors)
        self.assertIn("goes on in a segment that is missing", errors)

    def test_a_folder_that_is_deleted_meanwhile_is_named_and_made_anew(self):
        folder = self.folder / "operation"
        folder.mkdir()
        with self.recorder("--camera", self.camera, folder / "a.mkv") as recorder:
            self.begun(recorder, folder / "a.mkv")
            shutil.rmtree(folder)
            recorder.wait_for_error(f"The folder '{folder}' was deleted or renamed")
            self.begun(recorder, folder / "a.002.mkv")
            self.ends(recorder, INCOMPLETE)
        code, out, errors = run("inspect", folder / "a.002.mkv", "--verify")
        self.assertEqual(code, INCOMPLETE, errors)
        self.assertIn("every picture that is there was decoded, and a segment is missing", out)

    def test_where_no_folder_can_be_made_anew_nothing_is_called_kept(self):
        folder = self.folder / "disk" / "operation"
        folder.mkdir(parents=True)
        with self.recorder("--camera", self.camera, folder / "a.mkv") as recorder:
            self.begun(recorder, folder / "a.mkv")
            shutil.rmtree(folder.parent)
            figures = self.ends(recorder, ENDED_BY_THE_DISK, sig=None)
        self.assertIn("was deleted by another program", figures["problem"])
        self.assertNotIn("kept", figures["problem"])

    def test_a_file_that_is_cut_meanwhile_is_noticed(self):
        with self.recorder("--camera", self.camera, self.file) as recorder:
            self.begun(recorder, more_than=30_000)
            os.truncate(self.file, 10_000)
            recorder.wait_for_error("Another program has cut")
            figures = self.ends(recorder, INCOMPLETE)
        self.assertGreaterEqual(figures["cut_bytes"], 20_000)
        self.assertEqual(run("inspect", self.file, "--verify")[0], INCOMPLETE)

    def test_a_host_that_is_started_again_is_waited_for_and_the_gap_is_told(self):
        with socket.socket() as probe:
            probe.bind(("127.0.0.1", 0))
            listen = f"127.0.0.1:{probe.getsockname()[1]}"
        with host(self.state, self.camera, listen=listen) as h:
            recorder = self.recorder(h.greeting["link"], self.file)
            self.addCleanup(recorder.__exit__)
            self.begun(recorder)
            h.send(signal.SIGTERM)  # as a service manager ends it
            self.assertEqual(h.end(), 0, h.errors)
            recorder.wait_for_error("Waiting for the host, until it is back")
        with host(self.state, self.camera, listen=listen):
            self.begun(recorder, self.folder / "a.002.mkv")
            figures = self.ends(recorder, INCOMPLETE)
        self.assertGreater(figures["cameras"][0]["depth"]["interruptions"], 0)
        self.assertEqual(run("inspect", self.file, "--verify")[0], INCOMPLETE)

    def test_a_recorder_whose_host_hangs_ends_when_it_is_told_to(self):
        with host(self.state, self.camera) as h, self.recorder(h.greeting["link"], self.file) as recorder:
            self.begun(recorder)
            h.send(signal.SIGSTOP)
            recorder.wait_for_error("No picture of")
            figures = self.ends(recorder, INCOMPLETE, signal.SIGTERM)
            h.send(signal.SIGCONT)
        self.assertGreater(figures["missing_end_seconds"], 0)
        self.assertNotIn("Something did not end in time", "".join(recorder.errors))

    def test_other_participants_never_end_or_change_a_recording(self):
        with host(self.state, self.camera) as h:
            link = h.greeting["link"]
            peers = []
            try:
                # Each says at once who it is: a host waits 2 s for that.
                for codec in ("rvl", "trvl", "lz4"):
                    peers.append(RawPeer(link))
                    peers[-1].join(depth_codec=codec)
                for peer in peers:
                    peer.receive_control("Settings")
                with self.recorder(link, self.file, "--depth-codec", "strata") as recorder:
                    self.begun(recorder)
                    peers[0].close()
                    peers[1].send_control("ChooseCodecs", depth_codec="raw")
                    size = self.file.stat().st_size
                    self.begun(recorder, more_than=size + 10_000)
                    figures = self.ends(recorder, COMPLETE)
            finally:
                for peer in peers:
                    peer.close()
        self.assertEqual(figures["segments"], 1)
        self.assert_decodes(self.file)

    def test_cameras_that_come_and_go_cost_the_others_no_picture(self):
        segments = [self.folder / f"a.{n:03}.mkv" for n in (2, 3)]
        with host(self.state, self.camera) as h, \
                self.recorder(h.greeting["link"], self.file, "--depth-codec", "strata") as recorder:
            self.begun(recorder)
            for segment in segments:
                with Process("publish", h.greeting["publish_link"], "--camera", self.camera, "--may-record") as guest:
                    self.begun(recorder, segment)
                    guest.send(signal.SIGINT)
                    guest.end()
                self.begun(recorder, segment, more_than=segment.stat().st_size + 10_000)
            figures = self.ends(recorder, COMPLETE)
        self.assertEqual((figures["segments"], figures["lost"] + figures["dropped"]), (3, 0))
        code, out, errors = run("inspect", self.file, "--verify", "--json")
        self.assertEqual(code, 0, errors)
        depth = json.loads(out)["cameras"][0]["depth"]
        self.assertEqual(depth["frames"], figures["cameras"][0]["depth"]["pictures"])
        self.assertLess(depth["longest_gap_ms"], 1500)

    def test_the_last_pictures_of_a_camera_that_left_come_although_the_recorder_stood_still(self):
        names = [self.folder / name for name in ("a.mkv", "b.mkv")]
        with host(self.state, self.camera) as h, contextlib.ExitStack() as stack:
            recorders = [stack.enter_context(self.recorder(h.greeting["link"], name, "--depth-codec", "strata")) for name in names]
            for recorder, name in zip(recorders, names):
                self.begun(recorder, name)
            with Process("publish", h.greeting["publish_link"], "--camera", self.camera, "--may-record") as guest:
                for recorder, name in zip(recorders, names):
                    self.begun(recorder, name.with_suffix(".002.mkv"))
                recorders[1].send(signal.SIGSTOP)
                second = names[0].with_suffix(".002.mkv")
                self.begun(recorders[0], second, more_than=second.stat().st_size + 20_000)
                guest.send(signal.SIGINT)
                guest.end()
            recorders[0].wait_for_error("has left")
            recorders[1].send(signal.SIGCONT)
            recorders[1].wait_for_error("has left")
            for recorder, name in zip(recorders, names):
                last = name.with_suffix(".002.mkv")
                self.begun(recorder, last, more_than=last.stat().st_size + 20_000)
            figures = [self.ends(recorder, COMPLETE) for recorder in recorders]
        guests = [f["cameras"][1]["depth"]["pictures"] for f in figures]
        self.assertGreater(guests[0], 20)
        self.assertEqual(guests[0], guests[1])

    def test_a_restarted_host_begins_a_segment_that_plays(self):
        second = self.folder / "a.002.mkv"
        later = clock_ahead(DAY_S) or ()
        with host(self.state, self.camera, prefix=later) as h:
            port = h.greeting["port"]
            with self.recorder(h.greeting["link"], self.file) as recorder:
                self.begun(recorder)
                h.process.kill()
                h.process.wait()
                # Its machine was restarted as well: the clock goes back.
                with host(self.state, self.camera, listen=f"127.0.0.1:{port}"):
                    self.begun(recorder, second)
                    figures = self.ends(recorder, INCOMPLETE)
        self.assertEqual(figures["segments"], 2)
        self.assertLess(figures["seconds"], 3600)
        self.assert_decodes(second)

    def test_a_recorder_that_is_late_by_seconds_gets_everything(self):
        with host(self.state, self.camera) as h, RawPeer(h.greeting["link"]) as viewer:
            viewer.join(target_latency_ms=150)
            with self.recorder(h.greeting["link"], self.file) as recorder:
                self.begun(recorder)
                recorder.send(signal.SIGSTOP)
                time.sleep(1.5)  # the fault itself
                recorder.send(signal.SIGCONT)
                self.begun(recorder, more_than=self.file.stat().st_size + 40_000)
                figures = self.ends(recorder, COMPLETE)
        self.assertEqual(figures["lost"], 0)
        self.assert_decodes(self.file)

    def test_a_camera_that_was_unplugged_is_opened_again_and_said(self):
        # Every second one fault of the six that cameras have.
        faulty = self.camera + ",faults=1,faults_every=1"
        with self.recorder("--camera", faulty, "--camera", self.camera, self.file) as recorder:
            recorder.wait_for_error("is not there")
            recorder.wait_for_error("is live again")
            self.begun(recorder, more_than=self.file.stat().st_size + 10_000)
            figures = self.ends(recorder, INCOMPLETE)
        self.assertTrue(figures["cameras"][0]["was_gone"])
        self.assertFalse(figures["cameras"][1]["was_gone"])
        self.assert_decodes(self.file)


if __name__ == "__main__":
    unittest.main()
