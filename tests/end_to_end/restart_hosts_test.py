# SPDX-License-Identifier: Apache-2.0
"""What the packages do with running hosts when another version is installed (packaging/theatron-restart-hosts)."""
import json
import os
import pathlib
import shutil
import signal
import subprocess
import tempfile
import unittest

from theatron_process import PROGRAM, Process, host, make_recording, run, wait_until

SCRIPT = pathlib.Path(__file__).resolve().parents[2] / "packaging/theatron-restart-hosts"


class RestartHosts(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="theatron_restart_"))
        self.addCleanup(shutil.rmtree, self.folder)
        self.states = self.folder / "states"
        self.states.mkdir()
        tools = self.folder / "bin"
        tools.mkdir()
        # The folders above the built program and the script may be closed to the host's user.
        shutil.copy(PROGRAM, tools / "theatron")
        self.script = shutil.copy(SCRIPT, self.folder / SCRIPT.name)
        # It knows the hosts whose state folders there are, and writes down what it is told.
        (tools / "systemctl").write_text(f"""#!/bin/sh
if [ "$1" = list-units ]; then
    for state in {self.states}/*; do
        echo "theatron-host@$(basename "$state").service loaded active running Theatron host"
    done
else
    echo "$@" >> {self.folder}/told
    [ ! -e {self.folder}/fails ]
fi
""")
        (tools / "systemctl").chmod(0o755)
        self.environment = {**os.environ, "PATH": f"{tools}:{os.environ['PATH']}", "THEATRON_STATES": str(self.states)}
        self.camera = f"folder:{make_recording(self.folder / 'box')},loop=1,preload=1"

    def restart_hosts(self):
        """What it says, and what it told systemctl."""
        done = subprocess.run([self.script], env=self.environment, capture_output=True, text=True)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        told = self.folder / "told"
        return done.stdout, told.read_text().splitlines() if told.exists() else []

    def test_a_host_without_people_is_restarted(self):
        with host(self.states / "or-3", options=("--session", "OR: 3", "--camera", self.camera, "--session", "OR 4", "--camera", self.camera)):
            said, told = self.restart_hosts()
        self.assertEqual(told, ["restart theatron-host@or-3.service"])
        self.assertIn("theatron-host@or-3.service was restarted", said)

    def test_a_host_with_people_in_its_second_session_goes_on_and_is_named(self):
        with host(self.states / "or-3", options=("--session", "OR 3", "--camera", self.camera, "--session", "OR 4", "--camera", self.camera)) as h:
            link = subprocess.run([PROGRAM, "link", "--session", "OR 4", "--show", "expert", "--state", self.states / "or-3"],
                                  capture_output=True, text=True, check=True).stdout.strip()
            with Process("join", link, "--no-window", "--every", "0.2") as ben:
                ben.wait_for(lambda figures: figures["fps"] > 0)
                said, told = self.restart_hosts()
        self.assertEqual(told, [])
        self.assertIn("theatron-host@or-3.service goes on", said)
        self.assertIn("(1). When they have left: systemctl restart theatron-host@or-3.service", said)

    def test_people_who_wait_to_be_let_in_and_recorders_keep_a_host_from_it(self):
        with host(self.states / "or-3", self.camera, options=("--admit", "ask")) as h:
            links = h.greeting["links"]
            with Process("join", links["expert"], "--no-window", "--every", "0.2", "--name", 'Ada ,"sessions":[') as ada:
                ada.wait_for(lambda figures: figures["phase"] == "waiting")
                said, told = self.restart_hosts()
                self.assertEqual(told, [])
                self.assertIn("in its sessions or at their doors (1).", said)
            with Process("record", links["operator"], self.folder / "room.mkv", "--json") as recorder:
                wait_until(lambda: json.loads(run("status", links["operator"], "--json")[1])["participants"])
                said, told = self.restart_hosts()
                self.assertEqual(told, [])
                self.assertIn("in its sessions or at their doors (1).", said)
                recorder.send(signal.SIGINT)
                self.assertEqual(recorder.end(), 0)
            wait_until(lambda: not json.loads(run("status", links["operator"], "--json")[1])["participants"])
            self.assertEqual(self.restart_hosts()[1], ["restart theatron-host@or-3.service"])

    def test_one_that_does_not_start_again_keeps_no_other_from_it(self):
        (self.folder / "fails").touch()
        with host(self.states / "or-3", self.camera), host(self.states / "or-4", self.camera):
            said, told = self.restart_hosts()
        self.assertEqual(told, ["restart theatron-host@or-3.service", "restart theatron-host@or-4.service"])
        self.assertEqual(said.count("could not be restarted"), 2)

    @unittest.skipUnless(os.getuid() == 0, "needs root, as a package's script has")
    def test_the_state_belongs_to_the_hosts_user(self):
        state = self.states / "or-3"
        state.mkdir()
        self.folder.chmod(0o755)
        for folder in (state, self.folder / "box"):
            for path in (folder, *folder.rglob("*")):
                shutil.chown(path, "nobody", "nogroup")
        with host(state, self.camera, prefix=("setpriv", "--reuid", "nobody", "--regid", "nogroup", "--clear-groups", "--")):
            self.assertEqual(self.restart_hosts()[1], ["restart theatron-host@or-3.service"])

    def test_a_host_that_cannot_be_asked_is_named(self):
        (self.states / "or-5").mkdir()
        said, told = self.restart_hosts()
        self.assertEqual(told, [])
        self.assertIn("theatron-host@or-5.service does not say", said)


if __name__ == "__main__":
    unittest.main()
