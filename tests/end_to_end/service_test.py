# SPDX-License-Identifier: Apache-2.0
"""The host as a service: its configuration file, what it tells its manager, and the installed manual and completion."""
import json
import os
import pathlib
import re
import shutil
import signal
import socket
import subprocess
import tempfile
import threading
import unittest

from raw_peer import https_request
from theatron_process import Process, run

ROOT = pathlib.Path(__file__).resolve().parents[2]


class Manager:
    """A service manager's socket. A thread reads it at once, since its queue is short: a program that finds it full may go
    on without a message."""

    def __init__(self, path):
        self.path, self.told = str(path), []
        self.environment = os.environ | {"NOTIFY_SOCKET": self.path}
        self.socket = socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM)
        self.socket.bind(self.path)
        self.thread = threading.Thread(target=self._read)
        self.thread.start()

    def _read(self):
        # An empty message is the end.
        while text := self.socket.recv(1000):
            self.told.append(text.decode())

    def has_told(self, beginning):
        return [text for text in list(self.told) if text.startswith(beginning)]

    def __enter__(self):
        return self

    def __exit__(self, *_):
        with socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM) as own:
            own.sendto(b"", self.path)
        self.thread.join()
        self.socket.close()


class Service(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory(prefix="theatron_e2e_")
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)
        self.config = self.folder / "or-3.conf"

    def check(self, text):
        self.config.write_text(text)
        return run("host", "--config", self.config, "--check-config")

    def test_mistakes_are_told_with_line_and_key_and_the_host_does_not_start(self):
        text = "# OR 3\nsession = OR 3\nlook-back = 61\ncamra = synthetic\nhsts = maybe\n"
        code, out, errors = self.check(text)
        self.assertEqual((code, out), (1, ""))
        lines = errors.splitlines()[-3:]
        self.assertRegex(lines[0], rf"{re.escape(str(self.config))}:3: look-back: .*0 to 60")
        self.assertRegex(lines[1], r":4: camra: there is no such option")
        self.assertRegex(lines[2], r":5: hsts: 'maybe' is neither yes nor no")
        # A code of its own, at which the unit does not start it again.
        unit = (ROOT / "packaging/theatron-host@.service").read_text()
        code = int(re.search(r"^RestartPreventExitStatus=(\d+)$", unit, re.M)[1])
        self.assertNotIn(code, (0, 1))
        self.assertEqual(run("host", "--config", self.config)[::2], (code, errors))
        self.assertEqual(run("host", "--config", self.folder / "none.conf")[0], code)

    def test_a_configuration_without_mistakes_is_told_and_nothing_is_started(self):
        code, out, errors = self.check((ROOT / "packaging/operating-room.conf").read_text())
        self.assertEqual((code, errors), (0, ""))
        self.assertIn("can be used", out)
        code, _, errors = run("host", "--check-config")
        self.assertEqual(code, 1)
        self.assertIn("--config FILE", errors)

    def test_what_the_unit_runs_is_ready_alive_looks_again_and_ends(self):
        unit = (ROOT / "packaging/theatron-host@.service").read_text()
        words = re.search(r"^ExecStart=/usr/bin/theatron (.*)$", unit, re.M)[1]
        state = self.folder / "state"
        words = words.replace("/var/lib/theatron/%i", str(state)).replace("/etc/theatron/%i.conf", str(self.config))
        self.config.write_text("listen = 127.0.0.1:0\nsession = OR 3\njson = yes\nsession = OR 4\n")
        with Manager(self.folder / "notify") as manager:
            # A watchdog of two milliseconds hears of every round.
            environment = manager.environment | {"WATCHDOG_USEC": "2000", "XDG_STATE_HOME": str(self.folder)}
            has_told = manager.has_told
            with Process(*words.split(), env=environment) as h:
                greeting = h.read_json()
                self.assertEqual([session["name"] for session in greeting["sessions"]], ["OR 4"])
                h.wait_until(lambda: has_told("READY=1\nSTATUS=2 sessions open at port "))
                h.wait_until(lambda: len(has_told("WATCHDOG=1")) > 2)

                for request, status in (("/health", 200), ("/status", 401)):
                    self.assertEqual(https_request(greeting["link"], "GET", request)[0], status)

                self.assertEqual(run("session", "create", "OR 5", "--state", state)[0], 0)
                h.wait_until(lambda: has_told("STATUS=3 sessions open at port "))

                # Certificates and links are followed anyway, and the service goes on whatever the file says.
                self.config.write_text("nonsense\n" + "camera = nokind:1\n" * 9)
                h.send(signal.SIGHUP)
                h.wait_until(lambda: has_told("RELOADING=1"))
                h.wait_for_error(":1: nonsense: there is no '='")
                h.wait_for_error(":10: camera: There is no camera 'nokind'")
                h.wait_for_error("The host goes on as it was started.")
                h.wait_until(lambda: len(has_told("READY=1")) == 2)
                self.assertEqual(https_request(greeting["link"], "GET", "/health")[0], 200)

                h.send(signal.SIGTERM)
                self.assertEqual(h.end(), 0)
        self.assertTrue(has_told("STOPPING=1"))

    def test_the_log_is_json_on_request(self):
        state = self.folder / "state"
        self.config.write_text("listen = 127.0.0.1:0\n")
        with Process("host", "--config", self.config, "--state", state, "--json-log") as h:
            h.wait_for_error('"listening"')
            self.assertEqual(run("link", "--show", "expert", "--state", state)[0], 0)
            h.send(signal.SIGTERM)
            self.assertEqual(h.end(), 0)
        lines = [json.loads(line) for line in h.errors]
        listening = next(line for line in lines if line.get("event") == "listening")
        self.assertEqual((listening["level"], listening["area"]), ("info", "host"))
        self.assertRegex(listening["time"], r"^\d{4}-\d\d-\d\dT\d\d:\d\d:\d\d\.\d{3}Z$")
        self.assertRegex(listening["fields"]["address"], r"^https://127\.0\.0\.1:\d+/$")

    def test_without_a_manager_the_end_of_its_terminal_is_the_end_of_the_host(self):
        self.config.write_text("listen = 127.0.0.1:0\njson = yes\n")
        arguments = ["host", "--config", self.config, "--state", self.folder / "state"]
        with Process(*arguments) as h:
            h.read_json()
            h.send(signal.SIGHUP)
            self.assertEqual(h.end(), 0)
        # One that was started to outlive it does.
        with Process(*arguments, prefix=["nohup"]) as h:
            link = h.read_json()["link"]
            h.send(signal.SIGHUP)
            for _ in range(3):
                self.assertEqual(https_request(link, "GET", "/health")[0], 200)
            h.send(signal.SIGTERM)
            self.assertEqual(h.end(), 0)

    def test_when_it_looks_again_the_command_line_still_counts(self):
        state = self.folder / "state"
        self.config.write_text("listen = 127.0.0.1:0\njson = yes\nseconds = 0.1\n")
        self.assertEqual(run("host", "--config", self.config, "--state", state)[0], 0)
        # The certificate of this key stands on the command line.
        self.config.write_text(f"listen = 127.0.0.1:0\njson = yes\nkey = {state / 'host.key'}\n")
        with Manager(self.folder / "notify") as manager, \
                Process("host", "--config", self.config, "--certificate", state / "host.crt", "--state", self.folder / "other",
                        env=manager.environment) as h:
            h.read_json()
            h.wait_until(lambda: manager.has_told("READY=1"))
            h.send(signal.SIGHUP)
            h.wait_for_error("The configuration can be used")

    def test_the_manual_names_every_command_and_shells_complete_them(self):
        self.assertEqual(run("--write-manual", self.folder)[0], 0)
        commands = re.search(r"Subcommands:\n(.*)", run("--help")[1], re.S)[1]
        names = re.findall(r"^  (\w+)  ", commands, re.M)
        self.assertIn("host", names)
        pages = {page.stem for page in (self.folder / "man1").iterdir()}
        self.assertEqual(pages, {"theatron"} | {f"theatron-{name}" for name in names})

        def complete(*words):
            script = f'source "{self.folder}/theatron.bash"; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _theatron; ' \
                     'printf "%s\\n" "${COMPREPLY[@]}"'
            return subprocess.run(["bash", "-c", script, "bash", *words], capture_output=True, text=True,
                                  check=True).stdout.split()

        self.assertEqual(complete("theatron", "ho"), ["host"])
        self.assertEqual(complete("theatron", "host", "--camera", "x", "--admit", ""), ["all", "ask"])
        self.assertEqual(complete("theatron", "host", "--look"), ["--look-back"])
        self.assertEqual(complete("theatron", "session", "cr"), ["create"])
        self.assertIn("--admit", complete("theatron", "session", "create", "--a"))
        if shutil.which("zsh"):
            subprocess.run(["zsh", "-n", self.folder / "_theatron"], check=True)


if __name__ == "__main__":
    unittest.main()
