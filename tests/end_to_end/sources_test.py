# SPDX-License-Identifier: Apache-2.0
"""Windows, displays, devices and network streams as screens in the room; and servers that mean harm."""
import contextlib
import json
import os
import pathlib
import shutil
import signal
import subprocess
import tempfile
import unittest

import rtsp_standin
from rtsp_standin import RtspStandIn
from theatron_process import PROGRAM, Process, host, make_recording, read_png, run, wait_until
from virtual_screen import VirtualScreen

STANDIN = os.environ.get("THEATRON_V4L2_STANDIN", "build/release/tests/v4l2_standin/libv4l2_standin.so")
INCOMPLETE = 3  # exit code of `record` where a picture was lost, as on a busy machine


def camera(figures, name):
    return next((c for c in figures["cameras"] if c["name"] == name), None)


def shown(name, frames=10):
    return lambda f: camera(f, name) and camera(f, name)["frames"] >= frames


class Sources(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="theatron_sources_"))
        cls.addClassCleanup(shutil.rmtree, cls.folder)
        cls.lamp = f"folder:{make_recording(cls.folder / 'lamp')},loop=1,preload=1,place=0:1.5:0"
        cls.pictures = rtsp_standin.encode(320, 180, 30)

    def test_a_stream_is_shown_and_comes_back(self):
        with host(self.folder / "state", self.lamp) as h, \
                RtspStandIn(rtsp_standin.play, pictures=self.pictures, password="kn:fe") as server:
            url = server.url.replace("rtsp://", "rtsp://cart:kn%3afe@")
            code, _, errors = run("publish", h.greeting["publish_link"], "--share", server.url)
            self.assertEqual(code, 1)
            self.assertIn("user and password", errors)
            with Process("publish", h.greeting["publish_link"], "--share", url + ",name=tower", "--every", "0.2") as cart, \
                    Process("join", h.greeting["link"], "--every", "0.2") as seen:
                seen.wait_for(shown("tower", 30))
                before = server.connections
                server.drop()
                cart.wait_for(lambda f: camera(f, "tower")["state"] == "stale")
                cart.wait_for(lambda f: camera(f, "tower")["state"] == "live")
                self.assertGreater(server.connections, before)
                self.assertNotIn("kn", "".join(cart.errors))

    def assert_plays(self, h, server, url, frames=90):
        """`frames` pictures come, for longer than two keep-alives, from one connection."""
        before = server.connections
        with Process("publish", h.greeting["publish_link"], "--share", url + ",name=tower", "--every", "0.2") as cart:
            cart.wait_for(shown("tower", frames))
            self.assertEqual(server.connections, before + 1, "".join(cart.errors))

    def test_servers_with_habits_of_their_own_play(self):
        """As FFmpeg and VLC bear them: cameras that want the newest nonce in every request, that put stray bytes between
        packets, that ask whether the client is still there, that have moved."""
        stray, asked = b"\0\x24\r\n", []
        with host(self.folder / "habits") as h, contextlib.ExitStack() as stack:
            def serve(serve, **options):
                return stack.enter_context(RtspStandIn(serve, **options))
            nonces = serve(rtsp_standin.play_with_new_nonces, pictures=self.pictures, password="kn")
            with self.subTest("newest nonce"):
                self.assert_plays(h, nonces, nonces.url.replace("rtsp://", "rtsp://cart:kn@"))
            for between in (b"\0\0", stray):
                with self.subTest(between=between):
                    server = serve(rtsp_standin.play, pictures=self.pictures, between=between)
                    self.assert_plays(h, server, server.url)
            asks = serve(rtsp_standin.play_and_ask, pictures=self.pictures, asked=asked)
            with self.subTest("requests of the server"):
                self.assert_plays(h, asks, asks.url)
                self.assertGreater(len(asked), 5)
                self.assertTrue(all(number >= 1000 for number in asked), asked)
            counted = rtsp_standin.Counted("kn")
            announced = b"ANNOUNCE rtsp://127.0.0.1/live RTSP/1.0\r\nCSeq: 9\r\n\r\n"
            for name, options in (("a number that grows", {"read": counted.read_request}),
                                  ("requests that nobody knows", {"between": announced}),
                                  ("played at the session's address", {"session": "a=control:rtsp://127.0.0.1/all/", "play_at": "/all/"}),
                                  ("played at the base", {"base": "Content-Base: rtsp://127.0.0.1/base/\r\n", "play_at": "/base/"}),
                                  ("a number of channels", {"encoding": "h264/90000/1"})):
                with self.subTest(name):
                    server = serve(rtsp_standin.play, pictures=self.pictures, **options)
                    self.assert_plays(h, server, server.url.replace("rtsp://", "rtsp://cart:kn@"), 30)
            feeds = serve(rtsp_standin.play_with_line_feeds, pictures=self.pictures)
            with self.subTest("line feeds"):
                self.assert_plays(h, feeds, feeds.url, 30)
            path = serve(rtsp_standin.move_to_a_path, pictures=self.pictures)
            with self.subTest("moved to a path"), Process("publish", h.greeting["publish_link"], "--share", path.url + ",name=tower",
                                                          "--every", "0.2") as cart:
                cart.wait_for(shown("tower", 30))
            udp = "Transport: RTP/AVP;unicast;client_port=5000-5001\r\nSession: 1\r\n"
            for at, status, headers, words in (("DESCRIBE", "404 Not Found", "", "knows no such path"),
                                               ("SETUP", "461 Unsupported Transport", "", "comes over UDP only"),
                                               ("SETUP", "200 OK", udp, "comes over UDP only")):
                with self.subTest(status + headers):
                    server = serve(rtsp_standin.refuse, pictures=self.pictures, at=at, status=status, headers=headers)
                    code, _, errors = run("publish", h.greeting["publish_link"], "--share", server.url)
                    self.assertEqual(code, 1)
                    self.assertIn(words, errors)
            target = serve(rtsp_standin.play, pictures=self.pictures, password="kn")
            moved = serve(rtsp_standin.move, to=target.url)
            with self.subTest("moved"):
                self.assert_plays(h, target, moved.url.replace("rtsp://", "rtsp://cart:kn@"), 30)
            for to, words in (("rtsp://192.0.2.1/live", "moved it to another host"), ("http://127.0.0.1/", "moved it")):
                with self.subTest(to):
                    away = serve(rtsp_standin.move, to=to)
                    code, _, errors = run("publish", h.greeting["publish_link"], "--share", away.url)
                    self.assertEqual(code, 1)
                    self.assertIn(words, errors)
            around = serve(rtsp_standin.move, to="")
            around.options["to"] = around.url
            code, _, errors = run("publish", h.greeting["publish_link"], "--share", around.url)
            self.assertEqual(code, 1)
            self.assertIn("again and again", errors)

    def test_a_wrong_password_is_said_also_where_only_play_asks_for_it(self):
        def only_play(peer, pictures):
            rtsp_standin.shake_hands(peer, pictures, read=self.read_until_play)
        with host(self.folder / "only_play") as h, RtspStandIn(only_play, pictures=self.pictures) as server:
            code, _, errors = run("publish", h.greeting["publish_link"], "--share",
                                  server.url.replace("rtsp://", "rtsp://cart:wrong@"))
            self.assertEqual(code, 1)
            self.assertIn("user and password", errors)

    @staticmethod
    def read_until_play(peer):
        while True:
            method, url, fields = rtsp_standin.read_request(peer)
            if method != "PLAY":
                return method, url, fields
            rtsp_standin.answer(peer, fields, "401 Unauthorized", 'WWW-Authenticate: Digest realm="or", nonce="n"\r\n')

    def test_a_stream_that_stalls_is_called_stale_and_opened_again(self):
        with host(self.folder / "state2") as h, \
                RtspStandIn(rtsp_standin.play, pictures=self.pictures, count=60) as server, \
                Process("publish", h.greeting["publish_link"], "--share", server.url + ",name=tower", "--every", "0.2") as cart:
            cart.wait_for(lambda f: camera(f, "tower")["state"] == "stale")
            cart.wait_for(lambda f: server.connections >= 2 and camera(f, "tower")["state"] == "live")
            wait_until(lambda: any('"tower" goes on.' in line for line in list(cart.errors)))
            self.assertTrue(any('"tower" stands still' in line for line in cart.errors), cart.errors)

    def test_servers_that_mean_harm_end_only_their_screen(self):
        large = rtsp_standin.encode(4112, 2800, 1, source="color")
        harm = ((rtsp_standin.send_garbage, {}, "nothing that Theatron reads as video"),
                (rtsp_standin.send_endless_headers, {}, "nothing that Theatron reads as video"),
                (rtsp_standin.promise_much, {}, "nothing that Theatron reads as video"),
                (rtsp_standin.play, {"pictures": large}, "4096 x 2700"),
                (rtsp_standin.say_nothing, {}, "without an answer"))
        with host(self.folder / "state3", self.lamp) as h, Process("join", h.greeting["link"], "--every", "0.2") as seen, \
                contextlib.ExitStack() as stack:
            seen.wait_for(shown("lamp"))
            tries = []
            for serve, options, words in harm:
                server = stack.enter_context(RtspStandIn(serve, **options))
                tries.append((serve.__name__, words, stack.enter_context(
                    Process("publish", h.greeting["publish_link"], "--share", server.url, "--seconds", "20"))))
            damage = stack.enter_context(RtspStandIn(rtsp_standin.send_damaged_packets, pictures=self.pictures))
            code, _, errors = run("publish", h.greeting["publish_link"], "--share", damage.url, "--seconds", "3")
            self.assertEqual(code, 0, errors)  # its pictures are wrong, but it is a video
            for name, words, publisher in tries:
                with self.subTest(name):
                    self.assertEqual(publisher.end(), 1)
                    errors = "".join(publisher.errors)
                    self.assertIn(words, errors)
                    self.assertEqual(errors.count("\n"), 1, errors)
            before = camera(seen.newest_json(), "lamp")["frames"]
            seen.wait_for(lambda f: camera(f, "lamp")["state"] == "live" and camera(f, "lamp")["frames"] > before + 10)

    def test_what_is_not_there_is_said(self):
        with host(self.folder / "state4") as h:
            for shared, words in (("rtsp://127.0.0.1:1/x", "Cannot connect"),
                                  ("rtsp://cart:kn1fe@127.0.0.1:1/x?password=kn1fe", "'rtsp://127.0.0.1:1/x...'"),
                                  ("rtsp://127.0.0.1:1/x?password=kn1fe,width=kn", "is not a number"),
                                  ("rtsp://", "is written as rtsp://HOST/PATH"),
                                  ("v4l2:/dev/video99", "There is no video device"),
                                  ("v4l2:/dev/null", "is no video device"),
                                  (f"v4l2:{__file__}", "is no video device"),
                                  ("x11:", "Name a window")):
                code, _, errors = run("publish", h.greeting["publish_link"], "--share", shared)
                self.assertEqual(code, 1)
                self.assertIn(words, errors)
                self.assertNotIn("kn1fe", errors)
                self.assertEqual(errors.count("\n"), 1, errors)


class Devices(unittest.TestCase):
    """A USB webcam that does not exist (tests/v4l2_standin/standin_device.h): the program opens it, and a reader in its
    sandbox gets its pictures by the same system calls as from a real one."""

    DEVICE = "/dev/video42"

    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="theatron_devices_"))
        cls.addClassCleanup(shutil.rmtree, cls.folder)

    def environment(self, **more):
        return {**os.environ, "LD_PRELOAD": str(pathlib.Path(STANDIN).resolve()), "V4L2_STANDIN_DEVICE": self.DEVICE, **more}

    def recorded(self, link, name):
        """Six colour pictures, without loss."""
        file = self.folder / f"{name}.mkv"

        # Depth may begin half a second behind colour, and a picture without depth is not exported.
        def has_enough():
            code, out, _ = run("inspect", file, "--json")
            cameras = json.loads(out)["cameras"] if code in (0, INCOMPLETE) else []
            return bool(cameras) and all(kind and kind["frames"] > 6 for one in cameras for kind in (one["depth"], one["color"]))
        with Process("record", link, file, "--color-codec", "raw") as recorder:
            recorder.wait_until(lambda: file.exists() and has_enough())
            recorder.send(signal.SIGINT)
            self.assertIn(recorder.end(), (0, INCOMPLETE), recorder.last_words())
        code, _, errors = run("export", file, "--png", self.folder / name)
        self.assertIn(code, (0, INCOMPLETE), errors)
        return [read_png(picture) for picture in sorted((self.folder / name / "color").glob("*.png"))[:6]]

    def assert_stripes(self, picture, size, third):
        width, height, _, rows = picture
        self.assertEqual((width, height), size)
        for n, color in enumerate(((255, 0, 0), (0, 255, 0), third)):
            x = (2 * n + 1) * width // 6
            pixel = tuple(rows[height // 4][3 * x:3 * x + 3])
            self.assertTrue(all(abs(a - b) < 10 for a, b in zip(pixel, color)), (pixel, color))

    def test_a_device_is_shown_in_its_colours(self):
        with host(self.folder / "state") as h, \
                Process("publish", h.greeting["publish_link"], "--share", f"v4l2:{self.DEVICE},size=640x480,name=scope",
                        "--may-record", env=self.environment()), \
                Process("join", h.greeting["link"], "--every", "0.2") as seen:
            seen.wait_for(shown("scope", 20))
            pictures = self.recorded(h.greeting["link"], "small")
        places = []
        for picture in pictures:
            self.assert_stripes(picture, (640, 480), (0, 0, 255))
            last = picture[3][-1]
            places.append(next(x for x in range(640) if min(last[3 * x:3 * x + 3]) > 200))
        # The white block moves by a step for each picture.
        self.assertGreater(len(set(places)), 2, places)
        self.assertTrue(all(x % 16 < 2 for x in places), places)

    def test_its_largest_picture_is_shown_at_the_full_rate(self):
        """This device gives its largest pictures without loss at a third of the rate only: JPEG is taken."""
        with host(self.folder / "state2") as h, \
                Process("publish", h.greeting["publish_link"], "--share", f"v4l2:{self.DEVICE},name=scope", "--may-record",
                        env=self.environment()), \
                Process("join", h.greeting["link"], "--every", "0.2") as seen:
            seen.wait_for(shown("scope", 20))
            for picture in self.recorded(h.greeting["link"], "large"):
                self.assert_stripes(picture, (1280, 720), (255, 0, 255))

    def test_a_device_that_is_unplugged_comes_back(self):
        with host(self.folder / "state3") as h, \
                Process("publish", h.greeting["publish_link"], "--share", f"v4l2:{self.DEVICE},size=640x480,name=scope",
                        "--every", "0.2", env=self.environment(V4L2_STANDIN_PICTURES="40")) as cart:
            gone = cart.wait_for(lambda f: camera(f, "scope")["state"] == "stale")
            self.assertEqual(camera(gone, "scope")["problem"], f"The video device '{self.DEVICE}' has ended.")
            before = camera(gone, "scope")["frames"]
            cart.wait_for(lambda f: camera(f, "scope")["state"] == "live" and camera(f, "scope")["frames"] > before)

    def test_it_is_a_webcam_too(self):
        with host(self.folder / "state4") as h, \
                Process("join", h.greeting["link"], "--name", "Ben", "--webcam", self.DEVICE, "--every", "0.2",
                        env=self.environment()) as ben, \
                Process("join", h.greeting["link"], "--name", "Ada", "--every", "0.2") as ada:
            ben.wait_for(lambda f: f["webcam"]["state"] == "seen")
            ada.wait_for(shown("face"))


class Windows(unittest.TestCase):
    """Two windows of another program: one green, and a red one that covers half of it."""

    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="theatron_windows_"))
        cls.addClassCleanup(shutil.rmtree, cls.folder)

    def window(self, screen, color, title, place, size="320x180"):
        process = subprocess.Popen(
            ["ffmpeg", "-v", "error", "-re", "-f", "lavfi", "-i", f"color={color}:s={size}:r=10", "-pix_fmt", "rgb24",
             "-window_title", title, "-window_x", str(place), "-window_y", str(place), "-f", "sdl", title],
            env=screen.environment, stdin=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        self.addCleanup(process.wait)
        self.addCleanup(process.kill)
        return process

    def picture(self, h, name):
        file = self.folder / "seen.png"
        code, _, errors = run("join", h.greeting["link"], "--offscreen", file, "--size", "320x240", "--seconds", "1",
                              "--color-codec", "raw", "--view", "camera:0")
        self.assertEqual(code, 0, errors)
        return read_png(file)[3]

    def test_a_window_is_shared_without_what_lies_over_it(self):
        with VirtualScreen(800, 600) as screen:
            green = self.window(screen, "0x00ff00", "liver", 0)
            def windows():
                _, out, _ = run("cameras", "--json", env=screen.environment)
                return [w for w in json.loads(out)["windows"] if w["title"] == "liver"]

            listed = wait_until(windows)
            self.assertEqual(listed[0]["size"], [320, 180])
            self.window(screen, "0xff0000", "over", 100)
            def is_red(x, y):
                blue, green, red = screen.pixels(x, y, 1, 1)[0][:3]
                return red > 200 and green < 60 and blue < 60

            wait_until(lambda: is_red(200, 200), "the window that lies over it")
            lamp = f"folder:{make_recording(self.folder / 'lamp')},loop=1,preload=1,place=0:1.5:0"
            place = ",width=0.4,place=0:1.5:-0.5"
            with host(self.folder / "state", lamp) as h, \
                    Process("publish", h.greeting["publish_link"], "--share", f"x11:liver,name=liver,cursor=0{place}",
                            "--every", "0.2", env=screen.environment) as cart, \
                    Process("join", h.greeting["link"], "--every", "0.2") as seen:
                seen.wait_for(shown("liver"))
                rows = self.picture(h, "liver")
                for x in (150, 160, 170):
                    red, green_value, blue = rows[125][3 * x:3 * x + 3]
                    self.assertTrue(red < 40 and green_value > 215 and blue < 40, (x, red, green_value, blue))
                green.kill()
                cart.wait_for(lambda f: camera(f, "liver")["state"] == "stale")
                self.window(screen, "0x00ff00", "liver", 0, "400x100")
                cart.wait_for(lambda f: camera(f, "liver")["state"] == "live")

    def test_the_whole_display_is_shared_and_a_missing_one_is_said(self):
        with VirtualScreen(640, 360) as screen, host(self.folder / "state2") as h, \
                Process("publish", h.greeting["publish_link"], "--share", "x11:display,fps=20", "--every", "0.2",
                        env=screen.environment) as cart, \
                Process("join", h.greeting["link"], "--every", "0.2") as seen:
            seen.wait_for(shown("display"))
            cart.wait_for(lambda f: f["cameras"][0]["state"] == "live")
            done = subprocess.run([PROGRAM, "publish", h.greeting["publish_link"], "--share", "x11:nobody"],
                                  env=screen.environment, capture_output=True, text=True, stdin=subprocess.DEVNULL)
            self.assertIn("There is no visible window 'nobody'", done.stderr)
        without = {k: v for k, v in os.environ.items() if k != "DISPLAY"}
        done = subprocess.run([PROGRAM, "publish", "https://127.0.0.1:1/#join=x&cert=y", "--share", "x11:display"],
                              env=without, capture_output=True, text=True, stdin=subprocess.DEVNULL)
        self.assertEqual(done.returncode, 1)


if __name__ == "__main__":
    unittest.main()
