# SPDX-License-Identifier: Apache-2.0
"""Starts the program as a user would, and makes and reads small pictures."""
import contextlib
import json
import os
import pathlib
import queue
import re
import signal
import struct
import subprocess
import tempfile
import threading
import zlib

import patience
from patience import wait_until  # for the tests, which take it from here

PROGRAM = os.environ.get("THEATRON", "build/release/apps/theatron/theatron")
# Exit codes of programs that ended themselves; tests send other signals.
CRASHES = [-one for one in (signal.SIGSEGV, signal.SIGABRT, signal.SIGBUS, signal.SIGFPE, signal.SIGILL)]
DATA = pathlib.Path(os.environ.get("THEATRON_DATA", "../shared/data"))


# The counts of a report: they move when the program gets on, and stand when only its timer runs.
COUNTS = re.compile(r'"(?:\w*frames?|\w*bytes|pictures|packets|joins|segments)": ?\d+')


def settle(state_home):
    """The person of this folder has seen the tour of a first visit, which would lie over what a test looks at."""
    settings = pathlib.Path(state_home) / "theatron" / "settings"
    if not settings.exists():
        settings.parent.mkdir(mode=0o700, parents=True, exist_ok=True)
        settings.touch(mode=0o600)
        settings.write_text("tour_seen yes\n")


class Process:
    """A running theatron whose output lines can be waited for. `is_new`: the person has never used its window."""

    def __init__(self, *arguments, prefix=(), is_new=False, **options):
        # Each program is another person's, unless the test says whose it is.
        self.home = None if "env" in options else tempfile.TemporaryDirectory(prefix="theatron_home_")
        if self.home:
            options["env"] = {**os.environ, "XDG_STATE_HOME": self.home.name}
        if "join" in arguments and not is_new and options["env"].get("SDL_VIDEODRIVER") and options["env"].get("XDG_STATE_HOME"):
            settle(options["env"]["XDG_STATE_HOME"])
        self.process = subprocess.Popen(
            [*prefix, PROGRAM, *map(str, arguments)], stdin=subprocess.PIPE, stdout=subprocess.PIPE,
            stderr=subprocess.PIPE, text=True, **options)
        self.lines = queue.Queue()
        self.errors = []
        self.moves, self.last_line = 0, ""
        self.output_thread = threading.Thread(target=self._read_output, daemon=True)
        self.output_thread.start()
        self.error_thread = threading.Thread(target=self._read_errors, daemon=True)
        self.error_thread.start()
        patience.watch(self)

    def _read_output(self):
        counts = None
        for line in self.process.stdout:
            if (now := COUNTS.findall(line) or line) != counts:
                self.moves, counts = self.moves + 1, now
            self.last_line = line
            self.lines.put(line)
        self.lines.put(None)

    def _read_errors(self):
        for line in self.process.stderr:
            self.errors.append(line)

    def counted(self):
        return self.moves + len(self.errors)

    def has_ended(self):
        if self.process.poll() is None:
            return False
        self.error_thread.join(5)  # what it said last is read
        return True

    def crashed(self):
        return self.process.poll() in CRASHES

    def last_words(self):
        words = " ".join(map(str, self.process.args[:4]))
        state = f"ended with {self.process.returncode}" if self.has_ended() else "runs"
        return f"{words} ({state}): {self.last_line.strip()[:2000]} {''.join(self.errors[-5:])}"

    def read_json(self, wait=None):
        """The next line. `wait`: of which this line is a part."""
        wait = wait or patience.Wait(f"a line of {self.process.args[1:3]}")
        while True:
            try:
                line = self.lines.get(timeout=0.2)
                break
            except queue.Empty:
                wait.check()
        if line is None:
            self.error_thread.join(5)
            raise AssertionError("the program ended: " + "".join(self.errors))
        return json.loads(line)

    def newest_json(self):
        """The last complete line so far, waiting for at least one."""
        newest = self.read_json()
        while not self.lines.empty():
            newest = self.read_json()
        return newest

    def wait_for(self, condition):
        """Reads JSON lines until one meets the condition; returns it. One in which a list has no such entry yet does not."""
        wait = patience.Wait(condition)
        while True:
            figures = self.read_json(wait)
            with contextlib.suppress(IndexError):
                if condition(figures):
                    return figures
            wait.check()

    def wait_until(self, condition):
        """The condition's first true value; fails when the program has ended without it."""
        return patience.wait_until(condition, of=self)

    def wait_for_error(self, text):
        """Waits until the program has said this on stderr."""
        return patience.wait_until(lambda: any(text in line for line in list(self.errors)), f"'{text}' on stderr", of=self)

    def memory_mb(self):
        with open(f"/proc/{self.process.pid}/status") as status:
            for line in status:
                if line.startswith("VmRSS"):
                    return int(line.split()[1]) / 1024
        return 0

    def send(self, sig):
        self.process.send_signal(sig)

    def say(self, text):
        self.process.stdin.write(text + "\n")
        self.process.stdin.flush()

    def end(self):
        """Waits for its end; returns its exit code."""
        code = patience.end_of(self.process)
        self.error_thread.join(5)
        return code

    def __enter__(self):
        return self

    def __exit__(self, kind=None, *_):
        code = self.process.poll()
        if code is None:
            self.process.send_signal(signal.SIGCONT)
            self.process.kill()
        self.process.wait()
        patience.forget(self)
        self.error_thread.join(5)
        self.output_thread.join(5)
        for pipe in (self.process.stdin, self.process.stdout, self.process.stderr):
            pipe.close()
        if self.home:
            self.home.cleanup()
        if kind is None and code in CRASHES:
            raise AssertionError(f"the program ended by {signal.Signals(-code).name}: " + "".join(self.errors[-20:]))


def host(state, *cameras, listen="127.0.0.1:0", options=(), prefix=()):
    arguments = ["host", "--listen", listen, "--json", "--state", state, *options]
    for camera in cameras:
        arguments += ["--camera", camera]
    process = Process(*arguments, prefix=prefix)
    process.greeting = process.read_json()
    return process


def run(*arguments, env=None):
    """Runs to the end; returns exit code, output and errors."""
    done = patience.run([PROGRAM, *arguments], env=env)
    return done.returncode, done.stdout, done.stderr


def tell_result(result, problems, file):
    """The end of a program that measures: prints and saves the figures; returns its exit code."""
    text = json.dumps(result | {"problems": problems}, indent=2)
    print(text)
    if file:
        pathlib.Path(file).write_text(text)
    return 1 if problems else 0


def write_png(path, width, height, bits, channels, rows):
    """rows: one bytes object each, big endian for 16 bits."""
    color_type = {1: 0, 3: 2}[channels]
    raw = b"".join(b"\0" + row for row in rows)

    def chunk(kind, body):
        return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))

    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, bits,
                                                                      color_type, 0, 0, 0))
                     + chunk(b"IDAT", zlib.compress(raw, 1)) + chunk(b"IEND", b""))


def read_png(path):
    """Returns width, height, channels, and rows of numbers (8 or 16 bits)."""
    data = path.read_bytes()
    at, packed = 8, b""
    while at < len(data):
        length, kind = struct.unpack(">I4s", data[at:at + 8])
        body = data[at + 8:at + 8 + length]
        if kind == b"IHDR":
            width, height, bits, color_type = struct.unpack(">IIBB", body[:10])
        elif kind == b"IDAT":
            packed += body
        at += 12 + length
    channels = {0: 1, 2: 3, 6: 4}[color_type]
    step = channels * bits // 8
    raw, rows, above = zlib.decompress(packed), [], bytearray(width * step)
    for y in range(height):
        start = y * (width * step + 1)
        method, row = raw[start], bytearray(raw[start + 1:start + 1 + width * step])
        for x in range(len(row)):
            left = row[x - step] if x >= step else 0
            up, corner = above[x], above[x - step] if x >= step else 0
            if method == 1:
                row[x] = (row[x] + left) & 255
            elif method == 2:
                row[x] = (row[x] + up) & 255
            elif method == 3:
                row[x] = (row[x] + (left + up) // 2) & 255
            elif method == 4:
                guess = left + up - corner
                a, b, c = abs(guess - left), abs(guess - up), abs(guess - corner)
                row[x] = (row[x] + (left if a <= b and a <= c else up if b <= c else corner)) & 255
        above = row
        rows.append(struct.unpack(f">{len(row) // 2}H", bytes(row)) if bits == 16 else bytes(row))
    return width, height, channels, rows


def make_recording(folder, width=160, height=120, frames=20, color=True):
    """A wall, a floor and a box that moves: depth in mm, colour with bright marks."""
    (folder / "depth").mkdir(parents=True)
    if color:
        (folder / "color").mkdir()
    for n in range(frames):
        left = 20 + 3 * n
        depth, pixels = [], []
        for y in range(height):
            row = [1500 + 2 * y + (x * 7 + y * 13 + n * 5) % 4 for x in range(width)]
            line = [(60 + y % 80, 90, 120)] * width
            if 40 <= y < 90:
                for x in range(left, min(left + 40, width)):
                    row[x] = 900 + (x + y + n) % 3
                    line[x] = (220, 60, 40)
            depth.append(struct.pack(f">{width}H", *row))
            pixels.append(b"".join(bytes(p) for p in line))
        write_png(folder / "depth" / f"{n:05}.png", width, height, 16, 1, depth)
        if color:
            write_png(folder / "color" / f"{n:05}.png", width, height, 8, 3, pixels)
    return folder


def stand(recording):
    """The camera of make_recording() stands 1.6 m above the floor and looks level along -z."""
    lens = {"width": 160, "height": 120, "fx": 130, "fy": 130, "cx": 80, "cy": 60}
    pose = {"quaternion": [0, 1, 0, 0], "translation": [0, 1.6, 0]}
    (recording / "calibration.json").write_text(json.dumps({"depth": lens, "color": lens, "room_from_camera": pose}))
