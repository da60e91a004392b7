# SPDX-License-Identifier: Apache-2.0
"""A terminal or pipe that takes nothing costs lines, never pictures, decisions or the end."""
import contextlib
import fcntl
import json
import os
import pathlib
import pty
import shutil
import signal
import struct
import subprocess
import tempfile
import termios
import threading
import time
import unittest

import patience
from raw_peer import RawPeer, calibration
from theatron_process import PROGRAM, host, make_recording, run, wait_until
from virtual_screen import VirtualScreen

PROMISED_END = 2  # seconds after SIGTERM
FLOOD = b"mute nobody of this name\n" * 3000


def waited_for_processor(pid):
    """Seconds that threads of the process wanted to run and could not, by thread."""
    waited = {}
    for task in pathlib.Path(f"/proc/{pid}/task").glob("*"):
        with contextlib.suppress(OSError):
            waited[task.name] = int((task / "schedstat").read_text().split()[1]) / 1e9
    return waited


class Output(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="theatron_output_"))
        self.addCleanup(shutil.rmtree, self.folder)
        self.camera = f"folder:{make_recording(self.folder / 'box')},loop=1"
        self.state = self.folder / "state"
        self.started = 0

    # Readers that read nothing: each gives what a program writes to.

    def never_read(self):
        reader, writer = os.pipe()
        fcntl.fcntl(writer, fcntl.F_SETPIPE_SZ, 4096)
        os.set_blocking(writer, False)
        with contextlib.suppress(BlockingIOError):
            while True:
                os.write(writer, b"x")
        os.set_blocking(writer, True)
        self.addCleanup(os.close, reader)
        return writer

    def closed(self):
        reader, writer = os.pipe()
        os.close(reader)
        return writer

    def stopped_terminal(self):
        master, terminal = pty.openpty()
        self.addCleanup(os.close, master)
        os.write(master, b"\x13")  # Ctrl-S
        return terminal

    def start(self, make_output, *words, env=None, stdin=subprocess.DEVNULL):
        output = make_output()
        self.started += 1  # each is of another person
        process = subprocess.Popen([PROGRAM, *map(str, words)], bufsize=0, stdin=stdin, stdout=output, stderr=output,
                                   env={**(env or os.environ),
                                        "XDG_STATE_HOME": str(self.folder / f"home{self.started}")})
        os.close(output)

        def end():
            process.kill()
            process.wait()
        self.addCleanup(end)
        return process

    def assert_ends(self, process, what, code=0):
        """By SIGTERM, in the time that is promised where the machine gives it a processor."""
        before = waited_for_processor(process.pid)
        begin = time.monotonic()
        process.send_signal(signal.SIGTERM)
        waited = dict(before)

        def has_ended():
            waited.update(waited_for_processor(process.pid))
            return process.poll() is not None
        wait_until(has_ended, f"the end of the {what}", every=0.02)
        took = time.monotonic() - begin
        starved = sum(end - before.get(task, 0) for task, end in waited.items())
        self.assertEqual(process.poll(), code, what)
        self.assertLess(took, PROMISED_END + starved, f"{what}; it waited {starved:.1f} s for a processor")

    def link(self, *options):
        code, output, errors = run("link", "--state", self.state, "--json", *options)
        self.assertEqual(code, 0, errors)
        return json.loads(output)

    def status(self):
        code, output, _ = run("status", self.operator, "--json")
        return json.loads(output) if code == 0 else None

    def refusal(self, link):
        with RawPeer(link) as peer:
            peer.join()
            return peer.receive_control("Welcome", "Refused")[0]

    def programs(self, make_output, link, publish_link):
        """Those that run as long as the session, by the name that they have in it."""
        programs = {
            "recorder": self.start(make_output, "record", link, self.folder / "session.mkv", "--name", "recorder"),
            "sender": self.start(make_output, "publish", publish_link, "--name", "sender", "--camera",
                                 self.camera, "--every", "0.05"),
            "listener": self.start(make_output, "join", link, "--no-window", "--name", "listener", "--every", "0.05"),
        }
        if shutil.which("Xvfb"):
            screen = self.enterContext(VirtualScreen(640, 360))
            for name, options in {"viewer": [], "screen": ["--or-screen"]}.items():
                programs[name] = self.start(make_output, "join", link, "--size", "320x180", "--name", name, *options,
                                            env=screen.environment)
        return programs

    def flood(self, publish_link):
        """Cameras that come and go, about which the others say sentences."""
        cameras = [{"name": "n" * 60 + str(i), "has_color": False, "frames_per_second": 5.0, "may_record": False,
                    "calibration": list(calibration(64, 64, 0, 0)), "frame": 0} for i in range(8)]
        for _ in range(6):
            with RawPeer(publish_link) as peer:
                peer.join(name="a guest", features=[1, 2])
                peer.send_control("Publish", cameras=cameras)
                peer.receive_control("Published")

    def check(self, make_output):
        served = self.start(make_output, "host", "--listen", "127.0.0.1:0", "--state", self.state, "--camera",
                            self.camera, stdin=subprocess.PIPE)
        self.addCleanup(served.stdin.close)
        wait_until(lambda: run("link", "--state", self.state, "--show", "operator")[0] == 0)
        self.operator = self.link("--show", "operator")["link"]
        publish_link = self.link("--show", "publisher")["link"]
        programs = self.programs(make_output, self.link("--show", "expert")["link"], publish_link)

        def figures(name):
            return next((p for p in self.status()["participants"] if p["name"] == name), None)

        def pictures(name):
            if name == "sender":
                return sum(camera["bytes"] for camera in self.status()["published"])
            if name == "recorder":
                return sum(file.stat().st_size for file in self.folder.glob("session*.mkv"))
            # Each report of pictures that were decoded has another age.
            participant = figures(name)
            return participant and participant["age_ms"]

        wait_until(self.status)
        for name, process in programs.items():
            wait_until(lambda name=name: pictures(name), f"pictures of the {name}", of=process)
        flooder = threading.Thread(target=served.stdin.write, args=(FLOOD,), daemon=True)
        flooder.start()
        self.flood(publish_link)
        wait_until(lambda: not flooder.is_alive(), "the end of the flood on standard input")

        # Pictures go on.
        for name, process in programs.items():
            before = pictures(name)
            wait_until(lambda name=name, before=before: pictures(name) not in (None, before),
                       f"further pictures of the {name}", of=process)
        # Decisions, too.
        made = self.link("--role", "expert")
        wait_until(lambda: self.refusal(made["link"]) == "Welcome")
        self.link("--revoke", made["name"])
        self.assertEqual(self.refusal(made["link"]), "Refused")
        # And the end.
        for name, process in programs.items():
            self.assert_ends(process, name)
        self.assert_ends(served, "host")
        code, output, errors = run("inspect", self.folder / "session.mkv", "--verify")
        self.assertEqual(code, 0, output + errors)

    def test_a_pipe_that_nobody_reads(self):
        self.check(self.never_read)

    def test_a_pipe_whose_reader_is_gone(self):
        self.check(self.closed)

    def test_a_terminal_that_is_stopped(self):
        self.check(self.stopped_terminal)

    def test_results_are_complete_where_nobody_reads_the_sentences(self):
        with host(self.state, self.camera) as h:
            errors = self.never_read()
            self.addCleanup(os.close, errors)
            recorder = subprocess.Popen([PROGRAM, "record", h.greeting["link"], str(self.folder / "session.mkv"),
                                         "--seconds", "1", "--json"], stdin=subprocess.DEVNULL,
                                        stdout=subprocess.PIPE, stderr=errors)
            output, _ = recorder.communicate()
            self.assertEqual(recorder.returncode, 0)
            self.assertTrue(json.loads(output)["complete"])

    def test_a_result_waits_a_while_for_its_reader(self):
        with host(self.state, self.camera) as h:
            reader, writer = os.pipe()
            fcntl.fcntl(writer, fcntl.F_SETPIPE_SZ, 4096)
            os.write(writer, b"x" * 4096)
            viewer = subprocess.Popen([PROGRAM, "join", h.greeting["link"], "--no-window", "--json", "--seconds", "1"],
                                      stdin=subprocess.DEVNULL, stdout=writer, stderr=subprocess.DEVNULL)
            os.close(writer)
            h.wait_for_error("participant left")
            with os.fdopen(reader, "rb") as pipe:
                output = pipe.read()
            self.assertEqual(patience.end_of(viewer), 0)
            self.assertIn("cameras", json.loads(output[4096:]))

    def test_lines_that_were_left_out_are_counted_once_somebody_reads_again(self):
        reader, writer = os.pipe()
        served = subprocess.Popen([PROGRAM, "host", "--listen", "127.0.0.1:0", "--json", "--state", str(self.state),
                                   "--camera", self.camera], stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                                  stderr=writer)
        os.close(writer)
        for end in (served.stdout.close, served.stdin.close, served.wait, served.kill):
            self.addCleanup(end)
        json.loads(served.stdout.readline())
        served.stdin.write(FLOOD)
        served.stdin.flush()
        wait_until(lambda: struct.unpack("i", fcntl.ioctl(served.stdin, termios.FIONREAD, bytes(4)))[0] == 0)
        with os.fdopen(reader) as pipe:
            self.assertTrue(any(line.endswith("lines were left out.\n") for line in pipe))
            served.terminate()
            self.assertEqual(patience.end_of(served), 0)

    def test_closed_streams_are_nothing_that_files_get(self):
        """What is meant for people must never land in a file that got the number of a closed stream."""
        closings = ("<&-", ">&-", "2>&-", "<&- >&-", "<&- >&- 2>&-")
        for n, closing in enumerate(closings):
            with self.subTest(closing=closing):
                file = self.folder / f"{n}.mkv"
                subprocess.run(["sh", "-c", f'exec "$@" {closing}', "sh", PROGRAM, "record", "--camera", self.camera.replace(",loop=1", ""), file],
                               timeout=600)
                code, out, errors = run("inspect", file, "--verify")
                self.assertEqual(code, 0, out + errors)
        state = self.folder / "closed"
        for closing in closings:
            with self.subTest(closing=closing):
                subprocess.run(["sh", "-c", f'exec "$@" {closing}', "sh", PROGRAM, "host", "--listen", "127.0.0.1:0", "--camera", self.camera,
                                "--state", state, "--seconds", "1", "--json", "--print-links"], timeout=600)
        tokens = [file.read_text().strip() for file in state.glob("*.token")]
        self.assertGreaterEqual(len(tokens), 4)
        for file in (path for path in state.rglob("*") if path.is_file() and path.suffix != ".token"):
            for token in tokens:
                self.assertNotIn(token.encode(), file.read_bytes(), file.name)
        for line in (state / "audit.jsonl").read_text().splitlines():
            json.loads(line)

    def test_a_short_command_whose_reader_is_gone_ends_with_a_code(self):
        output = self.closed()
        self.addCleanup(os.close, output)
        for words in (["--help"], ["export", "--help"], ["cameras"], ["link", "--list", "--state", self.state]):
            with host(self.state, self.camera) if "link" in words else contextlib.nullcontext():
                done = patience.run([PROGRAM, *words], stdout=output)
            self.assertEqual(done.returncode, 1, words)
            self.assertIn("could not be written", done.stderr)


if __name__ == "__main__":
    unittest.main()
