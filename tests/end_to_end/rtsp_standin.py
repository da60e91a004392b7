# SPDX-License-Identifier: Apache-2.0
"""A stand-in for an RTSP server on loopback: H.264 over RTP, interleaved; and servers that mean harm."""
import base64
import hashlib
import os
import random
import re
import socket
import struct
import subprocess
import threading
import time

TRACK = "trackID=0"


def encode(width, height, frames, fps=30, source="testsrc2"):
    """The units (NAL) of each picture, by ffmpeg."""
    done = subprocess.run(
        ["ffmpeg", "-v", "error", "-f", "lavfi", "-i", f"{source}=s={width}x{height}:r={fps}", "-frames:v", str(frames),
         "-c:v", "libx264", "-preset", "ultrafast", "-tune", "zerolatency", "-g", "15", "-threads", "1",
         "-x264-params", "slices=1:aud=1", "-f", "h264", "-"], capture_output=True, check=True)
    pictures = []
    for unit in re.split(b"\0\0\0?\1", done.stdout)[1:]:
        if unit[0] & 31 == 9:  # an access unit begins
            pictures.append([])
        else:
            pictures[-1].append(unit)
    return pictures


class RtspStandIn:
    """Serves one connection after another with `serve`, one of the functions below or a test's own."""

    def __init__(self, serve, **options):
        self.serve, self.options = serve, options
        self.listener = socket.create_server(("127.0.0.1", 0))
        self.port = self.listener.getsockname()[1]
        self.url = f"rtsp://127.0.0.1:{self.port}/live"
        self.connections, self.open = 0, []
        threading.Thread(target=self._accept, daemon=True).start()

    def _accept(self):
        while True:
            try:
                peer, _ = self.listener.accept()
            except OSError:
                return
            self.connections += 1
            self.open.append(peer)
            threading.Thread(target=self._run, args=(peer,), daemon=True).start()

    def _run(self, peer):
        try:
            self.serve(peer, **self.options)
        except OSError:
            pass
        peer.close()

    def drop(self):
        """Ends all connections, as a camera does that loses power."""
        for peer in self.open:
            try:
                peer.shutdown(socket.SHUT_RDWR)
            except OSError:
                pass
        self.open = []

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.listener.close()
        self.drop()


def read_request(peer):
    head = b""
    while not head.endswith(b"\r\n\r\n"):
        byte = peer.recv(1)
        if not byte:
            raise OSError("closed")
        head += byte
    text = head.decode()
    fields = dict(re.findall(r"(?m)^([\w-]+): *(.*?)\r$", text))
    return text.split(" ")[0], text.split(" ")[1], fields


def answer(peer, fields, status="200 OK", headers="", body=""):
    length = f"Content-Length: {len(body)}\r\n" if body else ""
    peer.sendall(f"RTSP/1.0 {status}\r\nCSeq: {fields.get('CSeq', 0)}\r\n{headers}{length}\r\n{body}".encode())


class Counted:
    """Reads requests as a camera does whose one nonce must be used with a number that grows."""

    def __init__(self, password):
        self.password, self.last = password, 0

    def read_request(self, peer):
        def md5(text):
            return hashlib.md5(text.encode()).hexdigest()
        while True:
            method, url, fields = read_request(peer)
            given = dict(re.findall(r'(\w+)="?([^",]*)"?', fields.get("Authorization", "")))
            rest = f"n0nce:{given.get('nc')}:{given.get('cnonce')}:auth:{md5(method + ':' + given.get('uri', ''))}"
            if given.get("response") == md5(f"{md5(f'cart:or:{self.password}')}:{rest}") and int(given["nc"], 16) > self.last:
                self.last = int(given["nc"], 16)
                return method, url, fields
            answer(peer, fields, "401 Unauthorized", 'WWW-Authenticate: Digest realm="or", nonce="n0nce", qop="auth,auth-int"\r\n')


def is_allowed(method, fields, password, nonce="n0nce"):
    """Digest (RFC 2617) of the user `cart`."""
    given = dict(re.findall(r'(\w+)="([^"]*)"', fields.get("Authorization", "")))

    def md5(text):
        return hashlib.md5(text.encode()).hexdigest()
    wanted = md5(f"{md5(f'cart:or:{password}')}:{nonce}:{md5(method + ':' + given.get('uri', ''))}")
    return given.get("response") == wanted and given.get("username") == "cart"


class NewNonces:
    """Reads requests as a camera does that takes each nonce once: every request is asked for the newest one."""

    def __init__(self, password):
        self.password, self.number = password, 0

    def read_request(self, peer):
        while True:
            method, url, fields = read_request(peer)
            if is_allowed(method, fields, self.password, f"n{self.number}"):
                self.number += 1
                return method, url, fields
            self.number += 1
            answer(peer, fields, "401 Unauthorized", f'WWW-Authenticate: Digest realm="or", nonce="n{self.number}"\r\n')


def shake_hands(peer, pictures, password=None, read=read_request, session="a=control:*", encoding="H264/90000", base="", play_at=""):
    units = [unit for picture in pictures[:1] for unit in picture if unit[0] & 31 in (7, 8)]
    sets = ",".join(base64.b64encode(unit).decode() for unit in units)
    description = (f"v=0\r\no=- 1 1 IN IP4 127.0.0.1\r\ns=stand-in\r\nc=IN IP4 0.0.0.0\r\nt=0 0\r\n{session}\r\n"
                   "m=audio 0 RTP/AVP 0\r\na=control:trackID=7\r\n"
                   f"m=video 0 RTP/AVP 96\r\na=rtpmap:96 {encoding}\r\n"
                   f"a=fmtp:96 packetization-mode=1;sprop-parameter-sets={sets}\r\na=control:{TRACK}\r\n")
    while True:
        method, url, fields = read(peer)
        if password and not is_allowed(method, fields, password):
            answer(peer, fields, "401 Unauthorized",
                   'WWW-Authenticate: Basic realm="or"\r\nWWW-Authenticate: Digest realm="or", nonce="n0nce"\r\n'
                   'WWW-Authenticate: Digest realm="or", nonce="n0nce", algorithm=SHA-256\r\n')
            continue
        if method == "DESCRIBE":
            answer(peer, fields, headers=f"Content-Type: application/sdp\r\n{base}", body=description)
        elif method == "SETUP":
            assert url.endswith(TRACK), url
            answer(peer, fields, headers="Transport: RTP/AVP/TCP;unicast;interleaved=0-1\r\n"
                                         "Session: 12345678;timeout=2\r\n")
        elif method == "PLAY" and not url.endswith(play_at):
            answer(peer, fields, "460 Only Aggregate Operation Allowed")
        elif method == "PLAY":
            answer(peer, fields, headers="Session: 12345678\r\n")
            return


def packets(picture, number, stamp):
    """RTP packets of a picture's units (RFC 6184)."""
    made = []

    def packet(payload, last):
        made.append(struct.pack(">BBHII", 0x80, 96 | (0x80 if last else 0), (number + len(made)) & 0xffff,
                                stamp & 0xffffffff, 0x1234) + payload)
    for i, unit in enumerate(picture):
        is_last_unit = i + 1 == len(picture)
        if len(unit) < 1400:
            packet(unit, is_last_unit)
            continue
        parts = [unit[at:at + 1400] for at in range(1, len(unit), 1400)]
        for k, part in enumerate(parts):
            begin, end = k == 0, k + 1 == len(parts)
            packet(bytes([unit[0] & 0xe0 | 28, (0x80 if begin else 0) | (0x40 if end else 0) | unit[0] & 31]) + part,
                   is_last_unit and end)
    return made


def send_packet(peer, packet, channel=0):
    peer.sendall(struct.pack(">cBH", b"$", channel, len(packet)) + packet)


def answer_all(peer, read):
    try:
        while True:
            answer(peer, read(peer)[2])
    except OSError:
        pass


def play(peer, pictures, fps=30, count=None, password=None, read=read_request, between=b"", **hands):
    """A good server, which also answers keep-alives; after `count` pictures it says nothing more. `between` comes before
    each packet."""
    shake_hands(peer, pictures, password, read, **hands)
    begin, number = time.monotonic(), 0
    threading.Thread(target=answer_all, args=(peer, read), daemon=True).start()
    n = 0
    while count is None or n < count:
        for packet in packets(pictures[n % len(pictures)], number, 90000 * n // fps):
            peer.sendall(between)
            send_packet(peer, packet)
            number += 1
        n += 1
        time.sleep(max(0, begin + n / fps - time.monotonic()))
    time.sleep(60)


def play_with_new_nonces(peer, pictures, password, **options):
    """Every request needs the newest nonce, also PLAY and keep-alives; a keep-alive that has none ends the session."""
    play(peer, pictures, read=NewNonces(password).read_request, **options)


def play_and_ask(peer, pictures, asked):
    """Asks whether the client is still there, and notes its answers in `asked`."""
    shake_hands(peer, pictures)
    begin, number, waiting = time.monotonic(), 0, b""
    peer.setblocking(True)
    for n in range(3000):
        if n % 10 == 5:
            method = ("OPTIONS", "GET_PARAMETER", "SET_PARAMETER")[n // 10 % 3]
            peer.sendall(f"{method} rtsp://127.0.0.1/live RTSP/1.0\r\nCSeq: {1000 + n}\r\n\r\n".encode())
        for packet in packets(pictures[n % len(pictures)], number, 3000 * n):
            send_packet(peer, packet)
            number += 1
        peer.settimeout(max(0.001, begin + n / 30 - time.monotonic()))
        try:
            waiting += peer.recv(4096)
        except TimeoutError:
            pass
        peer.settimeout(None)
        while b"\r\n\r\n" in waiting:
            head, _, waiting = waiting.partition(b"\r\n\r\n")
            if head.startswith(b"RTSP/1.0 200"):
                asked.append(int(re.search(rb"CSeq: (\d+)", head)[1]))
            else:
                answer(peer, dict(re.findall(r"(?m)^([\w-]+): *(.*?)\r?$", head.decode())))


class LineFeeds:
    """A connection that ends the lines of its answers with a line feed alone."""

    def __init__(self, peer):
        self.peer = peer

    def recv(self, count):
        return self.peer.recv(count)

    def sendall(self, data):
        head, _, body = data.partition(b"\r\n\r\n")
        self.peer.sendall(head.replace(b"\r\n", b"\n") + b"\n\n" + body if data.startswith(b"RTSP") else data)


def play_with_line_feeds(peer, pictures):
    play(LineFeeds(peer), pictures)


def refuse(peer, pictures, at, status, headers=""):
    """Answers the requests of the method `at` with `status`."""
    def read(peer):
        while True:
            method, url, fields = read_request(peer)
            if method != at:
                return method, url, fields
            answer(peer, fields, status, headers)
    play(peer, pictures, read=read)


def move_to_a_path(peer, pictures):
    """The stream is at another path, of which the server says the path alone."""
    def read(peer):
        while True:
            method, url, fields = read_request(peer)
            if "/live" not in url:
                return method, url, fields
            answer(peer, fields, "307 Temporary Redirect", "Location: /other\r\n")
    play(peer, pictures, read=read)


def move(peer, to):
    """The stream is at another address."""
    while True:
        answer(peer, read_request(peer)[2], "302 Moved Temporarily", f"Location: {to}\r\n")


def say_nothing(peer):
    time.sleep(60)


def send_garbage(peer):
    while True:
        peer.sendall(os.urandom(4096))


def send_endless_headers(peer):
    read_request(peer)
    peer.sendall(b"RTSP/1.0 200 OK\r\n")
    while True:
        peer.sendall(b"X-More: " + b"a" * 1000 + b"\r\n")


def promise_much(peer):
    """A description of a gigabyte."""
    _, _, fields = read_request(peer)
    answer(peer, fields, headers="Content-Length: 1000000000\r\n")
    while True:
        peer.sendall(b"v=0\r\n" * 1000)


def send_damaged_packets(peer, pictures):
    """The handshake is right, then nothing is; the same damage each time."""
    shake_hands(peer, pictures)
    chance = random.Random(5)
    for n in range(3000):
        for packet in packets(pictures[n % len(pictures)], n, 3000 * n)[:3]:
            harmed = bytearray(packet)
            for _ in range(4):
                harmed[chance.randrange(len(harmed))] = chance.randrange(256)
            send_packet(peer, bytes(harmed), chance.randrange(4))
    peer.sendall(b"$\0\xff\xff")
    time.sleep(60)
