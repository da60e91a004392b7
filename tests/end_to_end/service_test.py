# SPDX-License-Identifier: Apache-2.0
"""The host as a service: its configuration file, what it tells its manager, and the installed manual and completion."""
import os
import pathlib
import re
import shutil
import signal
import socket
import subprocess
import tempfile
import unittest

from raw_peer import https_request
from theatron_process import PROGRAM, Process, run, wait_until

ROOT = pathlib.Path(__file__).resolve().parents[2]


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
        self.assertEqual(run("host", "--config", self.config)[::2], (1, errors))

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
        path = str(self.folder / "notify")
        with socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM) as manager:
            manager.bind(path)
            manager.setblocking(False)
            told = []

            def has_told(beginning):
                try:
                    while True:
                        told.append(manager.recv(1000).decode())
                except BlockingIOError:
                    return [text for text in told if text.startswith(beginning)]

            # A watchdog of two milliseconds hears of every round.
            environment = os.environ | {"NOTIFY_SOCKET": path, "WATCHDOG_USEC": "2000", "XDG_STATE_HOME": str(self.folder)}
            with Process(*words.split(), env=environment) as h:
                greeting = h.read_json()
                self.assertEqual([session["name"] for session in greeting["sessions"]], ["OR 4"])
                h.wait_until(lambda: has_told("READY=1\nSTATUS=2 of 2 sessions open at port "))
                h.wait_until(lambda: len(has_told("WATCHDOG=1")) > 2)

                for request, status in (("/health", 200), ("/status", 401)):
                    self.assertEqual(https_request(greeting["link"], "GET", request)[0], status)

                # Certificates and links are followed anyway, and the service goes on whatever the file says.
                self.config.write_text("nonsense\n")
                h.send(signal.SIGHUP)
                h.wait_until(lambda: has_told("RELOADING=1"))
                h.wait_for_error(":1: nonsense: there is no '='")
                h.wait_until(lambda: len(has_told("READY=1")) == 2)
                self.assertEqual(https_request(greeting["link"], "GET", "/health")[0], 200)

                h.send(signal.SIGTERM)
                self.assertEqual(h.end(), 0)
            self.assertTrue(has_told("STOPPING=1"))

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
