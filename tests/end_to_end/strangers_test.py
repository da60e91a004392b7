# SPDX-License-Identifier: Apache-2.0
"""Those who have no token, and those who misbehave with one, harm nobody else."""
import array
import contextlib
import fcntl
import json
import pathlib
import re
import shutil
import signal
import socket
import subprocess
import tempfile
import termios
import threading
import time
import unittest

import theatron_process
import patience
from raw_peer import FakeHost, Link, RawPeer, chunk, connect, https_get, media_message
from theatron_process import Process, host, make_recording

ROOT = pathlib.Path(__file__).resolve().parents[2]


def constant(file, name):
    """A number from the program's source."""
    text = re.search(rf"\b{name} =\s*([^;]+);", (ROOT / file).read_text())[1]
    return int(eval(text, {"__builtins__": {}}))  # products of numbers, in our own source


MAX_PENDING = constant("src/net/places.h", "max_pending")
FIRST_ENVELOPE = constant("src/wire/envelope.h", "max_first_envelope_size")


class Connections:
    """Opens sockets and keeps them, without a word."""

    def __init__(self, link):
        self.link = link
        self.sockets = []
        self.stopping = threading.Event()
        self.thread = None

    def open(self, count, address=None):
        for _ in range(count):
            with contextlib.suppress(OSError):
                self.sockets.append(connect(self.link, address=address, timeout=2))

    def keep_opening(self, per_second):
        def run():
            while not self.stopping.wait(1 / per_second):
                self.open(1)
        self.thread = threading.Thread(target=run, daemon=True)
        self.thread.start()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.stopping.set()
        if self.thread:
            self.thread.join(5)
        for one in self.sockets:
            one.close()


def join(link, **options):
    with RawPeer(link, **options) as peer:
        peer.join()
        peer.receive_control("Welcome")


class StrangersCase(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="theatron_strangers_"))
        cls.camera = f"folder:{make_recording(cls.folder / 'box', frames=8)},loop=1,preload=1"

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder)

    @contextlib.contextmanager
    def session(self, prefix=()):
        """A host and a viewer that has pictures, who must both be well in the end."""
        with host(self.folder / "state", self.camera, prefix=prefix) as h, \
                Process("join", h.greeting["link"], "--no-window", "--every", "0.1") as viewer:
            viewer.wait_for(lambda f: f["cameras"] and f["cameras"][0]["frames"] > 5)
            before = viewer.newest_json()
            yield h, viewer
            self.assertIsNone(h.process.poll(), "".join(h.errors))
            after = viewer.wait_for(lambda f: f["cameras"][0]["frames"] > before["cameras"][0]["frames"] + 30)
            self.assertEqual(after["joins"], 1, "".join(viewer.errors))

    def enter(self, link):
        """People with a link enter as always."""
        for _ in range(5):
            join(link)

    def idle_sockets_and_new_ones_all_the_time(self):
        with self.session() as (h, _), Connections(h.greeting["link"]) as strangers:
            memory = h.memory_mb()
            strangers.open(max(500, 2 * MAX_PENDING))
            strangers.keep_opening(per_second=100)
            self.enter(h.greeting["link"])
            self.assertEqual(https_get(h.greeting["link"], "/")[0], 200)
            self.assertLess(h.memory_mb(), memory + 32)

    def handshakes_that_go_nowhere(self):
        # The first words of a TLS handshake from another address, again and again.
        with self.session() as (h, _), Connections(h.greeting["link"]) as strangers:
            memory = h.memory_mb()
            hello = self.client_hello(h.greeting["link"])
            for _ in range(2 * MAX_PENDING):
                strangers.open(1, address="127.0.0.9")
                with contextlib.suppress(OSError):
                    strangers.sockets[-1].sendall(hello)
            self.enter(h.greeting["link"])
            self.assertLess(h.memory_mb(), memory + 32)

    def client_hello(self, link):
        """The first bytes of a TLS client, captured from a real one."""
        with socket.create_server(("127.0.0.1", 0)) as listener:
            there = Link.parse(link)._replace(port=listener.getsockname()[1])

            def client():
                with contextlib.suppress(OSError):
                    RawPeer(there, timeout=5)
            thread = threading.Thread(target=client)
            thread.start()
            with listener.accept()[0] as accepted:
                hello = accepted.recv(1 << 14)
            thread.join()
            return hello


class Strangers(StrangersCase):
    def test_idle_sockets_and_new_ones_all_the_time_shut_nobody_out(self):
        self.idle_sockets_and_new_ones_all_the_time()

    def test_handshakes_that_go_nowhere_shut_nobody_out(self):
        self.handshakes_that_go_nowhere()

    def test_what_is_sent_before_joining_is_not_kept(self):
        with self.session() as (h, _):
            memory = h.memory_mb()
            megabytes = 16
            for _ in range(6):
                with RawPeer(h.greeting["link"]) as stranger:
                    with self.assertRaises(OSError):
                        for offset in range(0, megabytes << 20, 1 << 14):
                            stranger.send(chunk(offset, megabytes << 20, bytes(1 << 14)))
                        stranger.wait_for_end()
                        raise OSError("it was closed")
            self.assertLess(h.memory_mb(), memory + megabytes)
            with RawPeer(h.greeting["link"]) as stranger:
                stranger.send(b"\1" + bytes(FIRST_ENVELOPE))
                stranger.wait_for_end()

    def test_media_of_a_participant_ends_its_connection_at_the_first_chunk(self):
        with self.session() as (h, _), RawPeer(h.greeting["link"]) as guest:
            guest.join()
            guest.receive_control("Welcome")
            guest.send(chunk(0, 1 << 20, bytes(100)))
            guest.wait_for_end()

    def test_garbage_after_the_handshake_ends_only_that_connection(self):
        with self.session() as (h, _):
            for noise in (b"", b"\0", b"\1", b"\2", b"\3abc", b"\1" + bytes(200), b"\2" + bytes(8)):
                for joined in (False, True):
                    with self.subTest(noise=noise, joined=joined), RawPeer(h.greeting["link"]) as peer:
                        if joined:
                            peer.join()
                            peer.receive_control("Welcome")
                        peer.send(noise)
                        peer.wait_for_end()
            for frame in (b"\x82\xff" + b"\x7f" * 8 + bytes(4), b"\xff" * 100, b"\x82\x05hello"):
                with self.subTest(frame=frame), RawPeer(h.greeting["link"]) as peer:
                    peer.send_bytes(frame)
                    peer.wait_for_end()

    def test_only_the_documented_path_and_no_foreign_page_gets_a_websocket(self):
        with self.session() as (h, _):
            link = h.greeting["link"]
            for options, status in (({"path": "/"}, "404"), ({"path": "/connections"}, "404"),
                                    ({"headers": ["Origin: https://elsewhere.example"]}, "403")):
                with self.subTest(options), self.assertRaisesRegex(ConnectionRefusedError, status):
                    RawPeer(link, **options)
            own = f"https://{Link.parse(link).host}"
            for options in ({"path": "/connection?x=1"}, {"headers": ["Origin: " + own]}):
                with self.subTest(options):
                    join(link, **options)

    def test_cookies_of_other_services_are_borne_and_too_many_are_answered(self):
        def cookies(kib):
            return [f"Cookie: service{n}={'c' * 1024}" for n in range(kib)]
        with self.session() as (h, _):
            link = Link.parse(h.greeting["link"])
            self.assertEqual(https_get(link, "/", headers=cookies(24))[0], https_get(link, "/")[0])
            join(link, headers=cookies(24))
            for kib in (40, 80):
                with self.subTest(kib=kib):
                    status, body = https_get(link, "/", headers=cookies(kib))
                    self.assertEqual(status, 431)
                    self.assertIn(b"cookies", body)
                    with self.assertRaisesRegex(ConnectionRefusedError, "431"):
                        RawPeer(link, headers=cookies(kib))

    def test_names_of_any_bytes_reach_neither_the_status_nor_the_terminal_as_they_are(self):
        with host(self.folder / "state", self.camera) as h:
            link = Link.parse(h.greeting["link"])
            with RawPeer(link) as guest:
                guest.join(name=b"\x1b]0;owned\x07\xff\xfe\xc2\x9b" + b"x" * 300)
                guest.receive_control("Welcome")
                with RawPeer(link) as other:
                    other.join(depth_codec=b"\x1b[2J" + b"y" * 1000)
                    other.receive_control("Refused")
                    other.wait_for_end()
                status, body = https_get(link, "/status", headers=[f"Authorization: Bearer {link.token}"])
                self.assertEqual(status, 200)
                body.decode()
            h.send(signal.SIGINT)
            self.assertEqual(h.end(), 0)
            logged = "".join(h.errors)
            self.assertIn("owned", logged)
            for unwanted in ("\x1b", "\x9b", "x" * 81, "y" * 81):
                self.assertNotIn(unwanted, logged)

    def test_an_error_output_that_nobody_reads_holds_up_nobody(self):
        process = subprocess.Popen(
            [theatron_process.PROGRAM, "host", "--listen", "127.0.0.1:0", "--json", "--camera", self.camera,
             "--state", str(self.folder / "state")],
            stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        try:
            fcntl.fcntl(process.stderr, fcntl.F_SETPIPE_SZ, 4096)
            link = json.loads(process.stdout.readline())["link"]
            with Process("join", link, "--no-window", "--every", "0.1") as viewer:
                viewer.wait_for(lambda f: f["cameras"] and f["cameras"][0]["frames"] > 5)
                # Every one is worth a line, and it is a pipe of 4 KiB.
                waiting = array.array("i", [0])
                for n in range(200):
                    with contextlib.suppress(OSError), RawPeer(link, address=f"127.0.1.{n + 1}", timeout=2) as peer:
                        peer.send(b"\3")
                    fcntl.ioctl(process.stderr, termios.FIONREAD, waiting)
                    if waiting[0] > 4096 - 200:
                        break
                self.assertGreater(waiting[0], 4096 - 200)
                before = viewer.newest_json()["cameras"][0]["frames"]
                viewer.wait_for(lambda f: f["cameras"][0]["frames"] > before + 20)
            process.terminate()
            self.assertEqual(patience.end_of(process), 0)
        finally:
            process.kill()
            process.wait()
            process.stdout.close()
            process.stderr.close()

    def test_without_descriptors_the_host_neither_spins_nor_shuts_out(self):
        with self.session(prefix=["prlimit", "--nofile=96"]) as (h, _), Connections(h.greeting["link"]) as strangers:
            strangers.open(120)
            door = self.thread_seconds(h.process.pid, "door")
            time.sleep(1)  # a span of the processor time that is measured, not a wait for something
            self.assertLess(self.thread_seconds(h.process.pid, "door") - door, 0.3)
            join(h.greeting["link"])

    def thread_seconds(self, pid, name):
        """Processor time of the threads of this name."""
        total = 0
        for task in pathlib.Path(f"/proc/{pid}/task").iterdir():
            head, _, rest = (task / "stat").read_text().rpartition(")")
            if head.endswith("(" + name):
                total += sum(map(int, rest.split()[11:13])) / 100
        return total


class HostileHost(unittest.TestCase):
    def test_a_host_that_sends_and_never_reads_does_not_end_a_viewer(self):
        over, left = threading.Event(), threading.Event()

        def script(guest):
            guest.receive_control("Join")
            guest.welcome()
            guest.settings()
            # Each small message is acknowledged, so acknowledgements soon find no way out.
            message = guest.frame(chunk(0, 65, media_message(b"x", key=False, frame=7, reference=6)))
            for _ in range(40):
                guest.send_bytes(message * 1000)
            over.set()
            left.wait()

        with FakeHost(script, receive_buffer=4096) as fake, \
                Process("join", fake.link, "--no-window", "--every", "0.1") as viewer:
            viewer.wait_until(lambda: over.is_set() or fake.faults)
            self.assertEqual(fake.faults, [])
            viewer.wait_for(lambda f: f["joins"] == 1)
            self.assertIsNone(viewer.process.poll(), "".join(viewer.errors))
            left.set()


if __name__ == "__main__":
    unittest.main()
