# SPDX-License-Identifier: Apache-2.0
"""A participant and a host that say whatever a test wants: docs/formats/connection.md, byte by byte.

    with RawPeer(link) as peer:              # TLS and WebSocket are done
        peer.join(name="guest")              # a Join message
        peer.send_control("Ping", sent_us=1)
        kind, fields = peer.receive_control("Pong")

    with FakeHost(lambda host: host.welcome()) as fake:
        Process("join", fake.link, ...)

Control messages are made and read by flatc from the program's own schema. Needs the commands flatc and openssl.
"""
import base64
import contextlib
import functools
import hashlib
import json
import os
import pathlib
import re
import select
import socket
import ssl
import struct
import subprocess
import tempfile
import threading
import time
import typing

import patience

SCHEMA = pathlib.Path(__file__).resolve().parents[2] / "src/wire/control.fbs"

SPACE = "theatron.wire.fbs."
PROTOCOL = 3

CONTROL, CHUNK, STATES, VOICE, ACKNOWLEDGEMENT = 1, 2, 3, 4, 5  # kinds of envelopes
TEXT, BINARY, CLOSE, PING, PONG = 1, 2, 8, 9, 10  # kinds of WebSocket frames
CHUNK_SIZE = 16 * 1024             # bytes of media that one envelope may carry
WEBSOCKET_ID = b"258EAFA5-E914-47DA-95CA-C5AB0DC85B11"  # RFC 6455, 1.3


class Link(typing.NamedTuple):
    host: str
    port: int
    token: str
    fingerprint: str

    @classmethod
    def parse(cls, text):
        host, port, token, fingerprint = re.fullmatch(
            r"https://\[?(.*?)\]?:(\d+)/#join=(.*)&cert=([0-9a-f]{64})(?:&.*)?", text).groups()
        return cls(host, int(port), token, fingerprint)

    def __str__(self):
        return f"https://{self.host}:{self.port}/#join={self.token}&cert={self.fingerprint}"


# Control messages.

def _flatc(*arguments):
    done = subprocess.run(["flatc", *map(str, arguments)], capture_output=True, text=True)
    if done.returncode != 0:
        raise ValueError(done.stdout + done.stderr)


@functools.lru_cache(maxsize=256)
def _build(direction, text):
    with tempfile.TemporaryDirectory(prefix="theatron_flatc_") as folder:
        path = pathlib.Path(folder) / "message.json"
        path.write_text(text)
        _flatc("--binary", "--root-type", SPACE + direction, "-o", folder, SCHEMA, path)
        return path.with_suffix(".bin").read_bytes()


def control_message(direction, kind, **fields):
    """One message `direction`, "ToHost" or "ToParticipant". A field given as bytes becomes a string of just these bytes, UTF-8 or not."""
    stand_ins = {}

    def printable(value):
        if isinstance(value, dict):
            return {key: printable(part) for key, part in value.items()}
        if isinstance(value, (list, tuple)):
            return [printable(part) for part in value]
        if isinstance(value, bytes):
            mark = f"<{len(stand_ins)}>".ljust(len(value), "~")
            if len(mark) != len(value):
                raise ValueError("strings of bytes have at least three")
            stand_ins[mark.encode()] = value
            return mark
        return value

    message = _build(direction, json.dumps({"body_type": kind, "body": printable(fields)}, sort_keys=True))
    for mark, value in stand_ins.items():
        message = message.replace(mark, value)
    return message


def read_control_message(direction, message):
    """Returns its kind and its fields."""
    with tempfile.TemporaryDirectory(prefix="theatron_flatc_") as folder:
        path = pathlib.Path(folder) / "message.bin"
        path.write_bytes(message)
        _flatc("--json", "--raw-binary", "--root-type", SPACE + direction, "--strict-json", "--allow-non-utf8", "-o", folder, SCHEMA, "--", path)
        content = json.loads(path.with_suffix(".json").read_text(errors="replace"), strict=False)
    return content.get("body_type"), content.get("body", {})


# Media.

def media_header(payload_size=0, *, codec=8, key=True, layer=0, stream=0, setting=1, frame=1, reference=None,
                 captured_us=1_000_000, version=1):
    """64 bytes: docs/formats/media_header.md."""
    reference = frame if reference is None else reference
    return struct.pack("<BBBBHHIIHHIqqIIIIQ", version, codec, int(key), layer, stream, setting, frame, reference, 0, 1,
                       payload_size, captured_us, captured_us, 0, 0, 0, 0, 0)


def media_message(payload, **fields):
    return media_header(len(payload), **fields) + payload


def chunk(offset, total, data):
    """The envelope of one part of a media message."""
    return bytes([CHUNK]) + struct.pack("<II", offset, total) + data


def calibration(width=640, height=360, color_width=640, color_height=360):
    """338 bytes: docs/formats/calibration.md. No lens, colour where depth is, its place in the room not known."""
    def camera(w, h):
        return struct.pack("<HH13d", w, h, 500, 500, w / 2, h / 2, *[0] * 9)

    pose = struct.pack("<7d", 1, 0, 0, 0, 0, 0, 0)
    return (bytes([1, 0]) + camera(width, height) + camera(color_width, color_height) + pose + struct.pack("<d", 1)
            + pose)


# WebSocket.

class WebSocket:
    """Frames over a stream whose handshakes are done. The participant masks its frames: with zeros, which
    change nothing."""

    def __init__(self, stream, received=b"", masks=True):
        self.stream = stream
        self.received = bytearray(received)
        self.masks = masks
        self.says, self.hears = ("ToHost", "ToParticipant") if masks else ("ToParticipant", "ToHost")
        self.sending = threading.Lock()

    def frame(self, payload, kind=BINARY, last=True, size=None):
        """`size`: what the frame claims to hold, if not what it holds."""
        size = len(payload) if size is None else size
        mask = 0x80 if self.masks else 0
        head = bytes([(0x80 if last else 0) | kind])
        if size < 126:
            head += bytes([mask | size])
        elif size < 1 << 16:
            head += bytes([mask | 126]) + struct.pack(">H", size)
        else:
            head += bytes([mask | 127]) + struct.pack(">Q", size)
        return head + (bytes(4) if self.masks else b"") + payload

    def send_bytes(self, data):
        with self.sending:
            self.stream.sendall(data)

    def send(self, payload, kind=BINARY, last=True):
        self.send_bytes(self.frame(payload, kind, last))

    def _take(self, count):
        wait = None
        while len(self.received) < count:
            # Threads of a test that only listen end with their connection.
            while threading.current_thread() is threading.main_thread() and not readable(self.stream):
                wait = wait or patience.Wait("bytes of the other side")
                wait.check()
            data = self.stream.recv(1 << 16)
            if not data:
                raise EOFError("the other side closed the connection")
            self.received += data
        taken = bytes(self.received[:count])
        del self.received[:count]
        return taken

    def receive(self):
        """The next message that is no ping, pong or close: its bytes. Pings are answered."""
        message = b""
        while True:
            first, size = self._take(2)
            masked, size = size & 0x80, size & 0x7f
            if size == 126:
                size, = struct.unpack(">H", self._take(2))
            elif size == 127:
                size, = struct.unpack(">Q", self._take(8))
            key = self._take(4) if masked else bytes(4)
            payload = self._take(size)
            if any(key):
                repeated = (key * (size // 4 + 1))[:size]
                payload = (int.from_bytes(payload, "big") ^ int.from_bytes(repeated, "big")).to_bytes(size, "big")
            kind = first & 0x0f
            if kind == PING:
                self.send(payload, PONG)
            elif kind == CLOSE:
                raise EOFError("the other side said goodbye")
            elif kind != PONG:
                message += payload
                if first & 0x80:
                    return message

    # Envelopes.

    def send_control(self, kind, **fields):
        self.send(bytes([CONTROL]) + control_message(self.says, kind, **fields))

    def send_media(self, message, chunk_size=CHUNK_SIZE):
        for offset in range(0, len(message), chunk_size):
            self.send(chunk(offset, len(message), message[offset:offset + chunk_size]))

    def receive_control(self, *kinds):
        """The next control message of one of these kinds (of any if none is named); skips others and media."""
        while True:
            envelope = self.receive()
            if envelope[0] == CONTROL:
                kind, fields = read_control_message(self.hears, envelope[1:])
                if not kinds or kind in kinds:
                    return kind, fields

    def wait_for_end(self):
        """Reads until the other side closes the connection."""
        with contextlib.suppress(EOFError, ConnectionError, ssl.SSLError):
            while True:
                self.receive()

    def close(self):
        with contextlib.suppress(OSError):
            self.stream.close()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()


def readable(stream, seconds=0.5):
    """Whether bytes came, or the end, within this time."""
    return getattr(stream, "pending", int)() > 0 or bool(select.select([stream], [], [], seconds)[0])


def connect(link, *, address=None, receive_buffer=None, timeout=600):
    """A TCP connection. `address`: where it comes from, for example 127.0.0.7."""
    link = Link.parse(link) if isinstance(link, str) else link
    stream = socket.socket(socket.AF_INET6 if ":" in link.host else socket.AF_INET)
    try:
        if receive_buffer:
            stream.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, receive_buffer)
        if address:
            stream.bind((address, 0))
        stream.settimeout(timeout)
        stream.connect((link.host, link.port))
    except OSError:
        stream.close()
        raise
    return stream


def connect_tls(link, **options):
    """A TLS connection; like everything here it believes any certificate."""
    stream = connect(link, **options)
    context = ssl.SSLContext(ssl.PROTOCOL_TLS_CLIENT)
    context.check_hostname = False
    context.verify_mode = ssl.CERT_NONE
    try:
        return context.wrap_socket(stream)
    except OSError:
        stream.close()
        raise


def _read_head(stream):
    """A request's or answer's head, and what came behind it."""
    data = b""
    while b"\r\n\r\n" not in data:
        more = stream.recv(4096)
        if not more:
            raise EOFError("closed before the head was complete")
        data += more
    head, _, rest = data.partition(b"\r\n\r\n")
    return head.decode("latin-1").split("\r\n"), rest


def join_message(link, **fields):
    """The envelope of a Join, for those who make it before they connect: a host waits two seconds for it."""
    link = Link.parse(link) if isinstance(link, str) else link
    usual = {"protocol_min": PROTOCOL, "protocol_max": PROTOCOL, "token": link.token, "name": "raw peer",
             "depth_codec": "strata", "color_codec": "jpeg:quality=85"}
    return bytes([CONTROL]) + control_message("ToHost", "Join", **(usual | fields))


class RawPeer(WebSocket):
    """A participant after its handshakes. `headers` are further lines of its request, `name` what its header Host says."""

    def __init__(self, link, *, path="/connection", headers=(), name=None, **options):
        self.link = Link.parse(link) if isinstance(link, str) else link
        stream = connect_tls(self.link, **options)
        try:
            lines = [f"GET {path} HTTP/1.1", f"Host: {name or self.link.host}", "Upgrade: websocket", "Connection: Upgrade",
                     "Sec-WebSocket-Version: 13",
                     "Sec-WebSocket-Key: " + base64.b64encode(os.urandom(16)).decode(), *headers]
            stream.sendall("".join(line + "\r\n" for line in lines).encode() + b"\r\n")
            answer, rest = _read_head(stream)
            if " 101 " not in answer[0]:
                raise ConnectionRefusedError(answer[0])
        except BaseException:
            stream.close()
            raise
        super().__init__(stream, rest)

    def join(self, **fields):
        """Says Join, by default with the link's token and the usual codecs."""
        self.send(join_message(self.link, **fields))

    def acknowledge(self, taken):
        self.send(bytes([ACKNOWLEDGEMENT]) + struct.pack("<QI", taken, 0))


def _connect_patiently(link, **options):
    """The same where connections come faster than a host takes them from one address."""
    for pause in (0.2, 0.5, 1):
        try:
            return connect_tls(link, **options)
        except (ssl.SSLEOFError, ConnectionResetError):
            time.sleep(pause)
    return connect_tls(link, **options)


def https_request(link, method, target, *, headers=(), name=None, body=b"", **options):
    """One plain request: the status, the headers with names in lower case, the body."""
    link = Link.parse(link) if isinstance(link, str) else link
    with _connect_patiently(link, **options) as stream:
        lines = [f"{method} {target} HTTP/1.1", f"Host: {name or link.host}", "Connection: close", *headers]
        stream.sendall("".join(line + "\r\n" for line in lines).encode() + b"\r\n" + body)
        answer, body = _read_head(stream)
        with contextlib.suppress(ssl.SSLError):
            while more := stream.recv(1 << 16):
                body += more
    received = {key.lower(): value.strip() for key, _, value in (line.partition(":") for line in answer[1:])}
    return int(answer[0].split()[1]), received, body


def https_get(link, target, **options):
    """The same for GET: the status, the body."""
    status, _, body = https_request(link, "GET", target, **options)
    return status, body


# A host.

class _Guest(WebSocket):
    """One participant, as a FakeHost's script sees it."""

    def welcome(self, cameras=None, **fields):
        """Says Welcome: one camera, unless `cameras` names others (see camera())."""
        usual = {"protocol": PROTOCOL, "participant": 1, "host_name": "fake host",
                 "cameras": [camera(0)] if cameras is None else cameras}
        self.send_control("Welcome", **(usual | fields))

    def settings(self, depth="strata", color="jpeg:quality=85", number=1, camera=0):
        self.send_control("Settings", settings=[
            {"stream": 2 * camera, "setting": number, "codec": depth},
            {"stream": 2 * camera + 1, "setting": number, "codec": color}])


def camera(number, name=None, calibration_bytes=None, **fields):
    """A camera of a Welcome."""
    usual = {"id": number, "name": name or f"camera {number}", "depth_stream": 2 * number,
             "color_stream": 2 * number + 1, "has_color": True, "frames_per_second": 30.0,
             "may_record": True, "calibration": list(calibration() if calibration_bytes is None else calibration_bytes)}
    return usual | fields


class FakeHost:
    """Listens on loopback and runs `script(guest)` on a thread for each participant, whose connection ends with it.

    `state`: the state folder of a real host whose identity it takes, so that links to that host lead here if
    `port` is that host's, too; by default it makes an identity. `receive_buffer`: of the sockets, small ones show
    soon that nobody reads. `faults` holds the exceptions of scripts.
    """

    def __init__(self, script, *, state=None, token="0" * 32, port=0, receive_buffer=None):
        self.script = script
        self.faults = []
        self.guests = 0
        with contextlib.ExitStack() as stack:
            if state is None:
                state = stack.enter_context(tempfile.TemporaryDirectory(prefix="theatron_fake_"))
                subprocess.run(["openssl", "req", "-x509", "-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:P-256",
                                "-nodes", "-subj", "/CN=fake", "-days", "30", "-keyout", f"{state}/host.key",
                                "-out", f"{state}/host.crt"], check=True, capture_output=True)
            self.context = ssl.SSLContext(ssl.PROTOCOL_TLS_SERVER)
            self.context.minimum_version = ssl.TLSVersion.TLSv1_3
            self.context.load_cert_chain(f"{state}/host.crt", f"{state}/host.key")
            der = ssl.PEM_cert_to_DER_cert(pathlib.Path(state, "host.crt").read_text())
        self.listener = socket.socket()
        self.listener.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        if receive_buffer:
            self.listener.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, receive_buffer)
        self.listener.bind(("127.0.0.1", port))
        self.listener.listen()
        self.link = str(Link("127.0.0.1", self.listener.getsockname()[1], token, hashlib.sha256(der).hexdigest()))
        self.thread = threading.Thread(target=self._listen, daemon=True)
        self.thread.start()

    def _listen(self):
        while True:
            try:
                stream, _ = self.listener.accept()
            except OSError:
                return
            threading.Thread(target=self._serve, args=(stream,), daemon=True).start()

    def _serve(self, stream):
        try:
            with self.context.wrap_socket(stream, server_side=True) as encrypted:
                request, rest = _read_head(encrypted)
                lower = {name.lower(): value.strip()
                         for name, _, value in (line.partition(":") for line in request[1:])}
                accept = base64.b64encode(hashlib.sha1(lower["sec-websocket-key"].encode() + WEBSOCKET_ID).digest())
                encrypted.sendall(b"HTTP/1.1 101 Switching Protocols\r\nUpgrade: websocket\r\n"
                                  b"Connection: Upgrade\r\nSec-WebSocket-Accept: " + accept + b"\r\n\r\n")
                self.guests += 1
                self.script(_Guest(encrypted, rest, masks=False))
                # A socket that is closed with unread bytes is reset, and the guest loses what is on its way to it.
                with contextlib.suppress(OSError):
                    encrypted.shutdown(socket.SHUT_WR)
                    while encrypted.recv(1 << 16):
                        pass
        except Exception as fault:  # the test decides which faults are expected
            self.faults.append(fault)

    def close(self):
        with contextlib.suppress(OSError):
            self.listener.shutdown(socket.SHUT_RDWR)
        self.listener.close()
        self.thread.join(5)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()
