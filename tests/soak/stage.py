# SPDX-License-Identifier: Apache-2.0
"""The session under test: who takes part, on which machine, and how each fault is made."""
import contextlib
import json
import os
import pathlib
import signal
import socket
import ssl
import subprocess
import sys
import time

import cameras
from guests import KINDS as GUEST_KINDS
from processes import Child, Role, inside_network
from raw_peer import https_get
from schedule import GUESTS
from shaped_link import HOST_ADDRESS, ShapedLink, missing
from theatron_process import PROGRAM

LINK_SETTINGS = ("rate_mbit=300", "delay_ms=2")
SLOW_DISK = pathlib.Path(os.environ.get("THEATRON_SLOW_DISK", "build/release/tests/slow_disk/libslow_disk.so"))
PORT = 4400  # inside a network namespace of its own


def time_namespaces():
    """True if this machine allows to run a program with another clock."""
    test = ["unshare", "--time", "--monotonic", "60", "true"]
    with contextlib.suppress(OSError):
        return subprocess.run(test, capture_output=True).returncode == 0
    return False


def possible_kinds(kinds):
    """The kinds of faults that this machine allows, and why others are left out."""
    left_out = {}
    if why := missing():
        left_out["link"] = why
    if not time_namespaces():
        left_out["clock"] = "time namespaces need root"
    if not SLOW_DISK.exists():
        left_out["disk"] = f"{SLOW_DISK} has not been built"
    words = {"link": "link ", "clock": "another clock", "disk": "disk "}
    return [kind for kind in kinds if not any(words[w] in kind.name for w in left_out)], left_out


class Stage:
    def __init__(self, folder, seed, with_link):
        self.folder, self.seed = folder, seed
        self.camera_words, self.source = cameras.make_cameras(folder, seed)
        self.recordings = folder / "disk"
        self.recordings.mkdir()
        self.disk_control = folder / "disk.control"
        self.shaper = None
        self.network_names = None
        self.shaped = None
        if with_link:
            self.shaped = ShapedLink(*LINK_SETTINGS)
        self.port = PORT if self.shaped else free_port()
        self.link_near = self.link_far = None
        self.uptime_at_start = time.monotonic()
        self.polls = []  # (seconds, generation of the host, figures)

        environment = None
        if SLOW_DISK.exists():
            self.set_disk("well")
            environment = dict(os.environ, LD_PRELOAD=str(SLOW_DISK.resolve()),
                               SLOW_DISK_FOLDER=str(self.recordings.resolve()), SLOW_DISK_CONTROL=str(self.disk_control))
        self.host = Role("host", folder, self._host_words)
        self.recorder = Role("recorder", folder, self._recorder_words, environment)
        self.viewers = [Role(f"viewer-{n}", folder, self._viewer_words(n)) for n in range(3)]
        self.guests = Role("guest", folder, lambda number, words: words)
        self.roles = [self.host, self.recorder, *self.viewers]

    # Words of the programs.

    def _near(self):
        return self.shaped.at_host() if self.shaped else []

    def _far(self):
        return self.shaped.at_viewer() if self.shaped else []

    def _clock(self, ahead):
        """A clock can be set back at most as far as the machine has been up."""
        if ahead == 0:
            return []
        return ["unshare", "--time", "--monotonic", max(ahead, -int(self.uptime_at_start) + 5)]

    def _host_words(self, number, _):
        address = "0.0.0.0" if self.shaped else "127.0.0.1"
        words = [*self._near(), PROGRAM, "host", "--json", "--state", self.folder / "state", "--filter", "off", "--look-back", "10",
                 "--listen", f"{address}:{self.port}"]
        for camera in self.camera_words:
            words += ["--camera", camera]
        return words

    def _recorder_words(self, number, ahead):
        return [*self._clock(ahead), *self._far(), PROGRAM, "record", self.link_far,
                self.recordings / f"{number:03}.mkv", "--json"]

    def _viewer_words(self, which):
        def words(number, ahead):
            # The first one is beside the host and never comes to harm; the others are behind the link.
            place, link = (self._near(), self.link_near) if which == 0 else (self._far(), self.link_far)
            return [*self._clock(ahead), *place, PROGRAM, "join", link, "--every", "0.5", "--name", f"viewer {which}"]
        return words

    # The run.

    def begin(self):
        greeting = self.host.start().wait_for_line(60)
        if greeting is None:
            raise RuntimeError("the host does not start: " + self.host.now.last_words())
        address, rest = greeting["link"].removeprefix("https://").split(":", 1)
        near, far = ("127.0.0.1", HOST_ADDRESS) if self.shaped else (address, address)
        self.link_near, self.link_far = f"https://{near}:{rest}", f"https://{far}:{rest}"
        self.recorder.start()
        for viewer in self.viewers:
            viewer.start()

    def poll(self):
        """Asks the host how it and its cameras are."""
        token = self.link_near.split("join=")[1].split("&")[0]
        with contextlib.suppress(OSError, EOFError, ValueError, ssl.SSLError):
            with inside_network(self.shaped.names[0] if self.shaped else None):
                _, body = https_get(self.link_near, f"/status?token={token}", timeout=1)
            self.polls.append((time.monotonic(), len(self.host.children), json.loads(body)))

    def set_disk(self, state):
        new = self.disk_control.with_suffix(".new")
        new.write_text(state)
        new.rename(self.disk_control)

    def set_link(self, *settings):
        self.shaped.change(*settings)

    def role_of(self, fault):
        return {"host": self.host, "recording": self.recorder, "viewer 1": self.viewers[1],
                "viewer 2": self.viewers[2]}.get(fault.part)

    def start_fault(self, fault):
        role = self.role_of(fault)
        what = fault.kind.split(" ", 1)[1]
        if fault.kind.startswith("guest"):
            self._start_guest(fault)
        elif fault.kind.startswith("disk"):
            self.set_disk({"stalled": "stall", "slow": f"slow {fault.amount}"}.get(what, what))
        elif fault.kind == "link cut":
            self.set_link("loss=100%")
        elif fault.kind == "link slow":
            self.set_link(f"rate={fault.amount}%")
        elif what == "killed":
            role.now.kill()
        elif what == "stopped":
            role.now.send(signal.SIGSTOP)
        elif what == "with another clock":
            role.now.end(signal.SIGINT, 30)

    def end_fault(self, fault):
        role = self.role_of(fault)
        what = fault.kind.split(" ", 1)[1]
        if fault.kind.startswith("disk"):
            self.set_disk("well")
        elif fault.kind.startswith("link"):
            self.set_link("loss=0%", "rate=100%")
        elif what == "stopped":
            role.now.send(signal.SIGCONT)
        elif what in ("killed", "with another clock"):
            role.start(fault.amount)

    def _start_guest(self, fault):
        name = fault.kind.removeprefix("guest: ")
        assert name in GUESTS and name in GUEST_KINDS
        script = pathlib.Path(__file__).with_name("guests.py")
        self.guests.start([*self._near(), sys.executable, script, name, self.link_near, self.seed, fault.length])

    def sample(self):
        for role in self.roles:
            role.sample()

    def close(self):
        for role in [*reversed(self.roles), self.guests]:
            role.kill()
        if self.shaped:
            self.shaped.close()


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]
