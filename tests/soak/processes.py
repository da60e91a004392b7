# SPDX-License-Identifier: Apache-2.0
"""Programs under test: started, stopped, killed, measured; none outlives this process."""
import contextlib
import ctypes
import json
import os
import pathlib
import signal
import subprocess
import threading
import time

LIBC = ctypes.CDLL(None, use_errno=True)
PR_SET_PDEATHSIG = 1
CLOCK_TICKS = os.sysconf("SC_CLK_TCK")
CLONE_NEWNET = 0x40000000


def die_with_parent():
    LIBC.prctl(PR_SET_PDEATHSIG, signal.SIGKILL)


class Child:
    """One process. Its lines of JSON are read as they come; what it says on stderr goes into `log`."""

    def __init__(self, words, log, environment=None):
        self.started = time.monotonic()
        self.ended = None
        self.newest = None  # the newest line of JSON
        self.first = None
        self.samples = []   # (seconds, MiB resident, seconds of CPU)
        self.log = pathlib.Path(log)
        self._first_line = threading.Event()
        with open(self.log, "ab") as errors:
            # Signals of the terminal are for this process, which ends its children in order.
            self.process = subprocess.Popen([str(word) for word in words], stdin=subprocess.DEVNULL,
                                            stdout=subprocess.PIPE, stderr=errors, env=environment,
                                            start_new_session=True, preexec_fn=die_with_parent)
        self._reader = threading.Thread(target=self._read, daemon=True)
        self._reader.start()

    def _read(self):
        for line in self.process.stdout:
            with contextlib.suppress(ValueError):
                self.newest = json.loads(line)
                self.first = self.first or self.newest
                self._first_line.set()
        self._first_line.set()

    def wait_for_line(self, timeout):
        """The first line of JSON, or None."""
        self._first_line.wait(timeout)
        return self.first

    def running(self):
        if self.process.poll() is None:
            return True
        self.ended = self.ended or time.monotonic()
        return False

    def code(self):
        return self.process.poll()

    def send(self, sig):
        if self.running():
            self.process.send_signal(sig)

    def end(self, sig, timeout):
        """Sends `sig` and waits; kills what is still there then. Returns the exit code."""
        self.send(signal.SIGCONT)
        self.send(sig)
        try:
            self.process.wait(timeout)
        except subprocess.TimeoutExpired:
            self.process.kill()
            self.process.wait()
        self.ended = self.ended or time.monotonic()
        self._reader.join(5)
        self.process.stdout.close()
        return self.process.returncode

    def kill(self):
        return self.end(signal.SIGKILL, 10)

    def sample(self):
        with contextlib.suppress(OSError, ValueError, IndexError):
            pid = self.process.pid
            status = pathlib.Path(f"/proc/{pid}/status").read_text()
            kib = int(status.split("VmRSS:")[1].split()[0])
            fields = pathlib.Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()
            cpu = (int(fields[11]) + int(fields[12])) / CLOCK_TICKS
            self.samples.append((time.monotonic() - self.started, kib / 1024, cpu))

    def last_words(self):
        with contextlib.suppress(OSError):
            lines = self.log.read_text(errors="replace").splitlines()
            return lines[-1] if lines else ""
        return ""


class Role:
    """A program that is started again after faults: all its processes, one after the other."""

    def __init__(self, name, folder, make_words, environment=None):
        self.name, self.folder = name, folder
        self.make_words = make_words  # of the number of the process and the fault's amount
        self.environment = environment
        self.children = []

    @property
    def now(self):
        return self.children[-1] if self.children else None

    def start(self, amount=0):
        number = len(self.children)
        self.children.append(Child(self.make_words(number, amount), self.folder / f"{self.name}-{number:03}.log",
                                   self.environment))
        return self.now

    def running(self):
        return bool(self.children) and self.now.running()

    def sample(self):
        if self.running():
            self.now.sample()

    def kill(self):
        for child in self.children:
            if child.running():
                child.kill()


@contextlib.contextmanager
def inside_network(name):
    """This thread alone enters a network namespace (None: stays) and comes back."""
    if name is None:
        yield
        return
    own = os.open("/proc/thread-self/ns/net", os.O_RDONLY)
    other = os.open(f"/run/netns/{name}", os.O_RDONLY)
    try:
        if LIBC.setns(other, CLONE_NEWNET) != 0:
            raise OSError(ctypes.get_errno(), "cannot enter a network namespace")
        yield
    finally:
        LIBC.setns(own, CLONE_NEWNET)
        os.close(own)
        os.close(other)
