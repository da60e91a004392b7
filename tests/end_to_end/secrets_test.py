# SPDX-License-Identifier: Apache-2.0
"""Keys, tokens and links: where they are kept, and who can see them."""
import os
import pathlib
import shutil
import tempfile
import unittest

import patience
from theatron_process import PROGRAM, Process, host, make_recording, run


class Secrets(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="theatron_e2e_"))
        self.camera = f"folder:{make_recording(self.folder / 'camera', frames=2, color=False)},loop=1"
        self.state = self.folder / "state"

    def tearDown(self):
        shutil.rmtree(self.folder)

    def refused(self, *options, **environment):
        """The error output of a host that must refuse to start."""
        done = patience.run(
            [PROGRAM, "host", "--camera", self.camera, "--listen", "127.0.0.1:0", "--seconds", "0.2", *options],
            env={**{k: v for k, v in os.environ.items() if k not in ("HOME", "XDG_STATE_HOME")}, **environment})
        self.assertEqual(done.returncode, 1, done.stderr)
        return done.stderr

    def test_without_a_home_nothing_is_kept_where_everybody_writes(self):
        self.assertIn("--state", self.refused())

    def test_keys_and_tokens_that_others_can_read_or_change_are_refused(self):
        with host(self.state, self.camera):
            pass
        for name in ("host.key", "join.token", "metrics.token"):
            self.assertEqual((self.state / name).stat().st_mode & 0o777, 0o600)
            (self.state / name).chmod(0o644)
            self.assertIn(name, self.refused("--state", self.state))
            (self.state / name).chmod(0o600)
        self.state.chmod(0o777)
        self.assertIn("chmod go-w", self.refused("--state", self.state))

    def test_a_token_of_ones_own_is_long(self):
        self.assertIn("could be guessed", self.refused("--state", self.state, "--token", "abc"))

    def test_tokens_are_not_seen_in_the_list_of_processes(self):
        token = "correct-horse-battery-staple"

        def command_line(process):
            return pathlib.Path(f"/proc/{process.process.pid}/cmdline").read_text()

        with host(self.state, self.camera, options=["--token", token]) as h:
            self.assertIn(token, h.greeting["link"])
            self.assertNotIn(token, command_line(h))
            with Process("join", h.greeting["link"], "--no-window", "--every", "0.2") as viewer:
                viewer.read_json()
                self.assertIn("join", command_line(viewer))
                self.assertNotIn(token, command_line(viewer))

    def test_token_and_link_are_read_from_files(self):
        token = self.folder / "token"
        token.touch(0o600)
        token.write_text("correct-horse-battery-staple\n")
        with host(self.state, self.camera, options=["--token-file", token]) as h:
            link = self.folder / "link"
            link.write_text(h.greeting["link"] + "\n")
            code, out, errors = run("status", f"@{link}", "--json")
            self.assertEqual(code, 0, errors)
            with Process("join", "@/dev/stdin", "--no-window", "--every", "0.2") as viewer:
                viewer.say(h.greeting["link"])
                viewer.process.stdin.flush()
                viewer.read_json()

    def test_a_host_prints_links_only_to_a_terminal_or_where_asked(self):
        def printed(*options):
            command = [PROGRAM, "host", "--camera", self.camera, "--listen", "127.0.0.1:0", "--seconds", "0.2", "--state",
                       str(self.state), *options]
            done = patience.run(command)
            self.assertEqual(done.returncode, 0, done.stderr)
            return done.stdout + done.stderr

        in_journal = printed()
        self.assertIn("https://127.0.0.1:", in_journal)
        self.assertIn("theatron link --show expert", in_journal)
        tokens = [(self.state / f"{name}.token").read_text().strip() for name in ("join", "publish", "observer", "operator")]
        for token in tokens:
            self.assertNotIn(token, in_journal)
        asked = printed("--print-links")
        for token in tokens:
            self.assertIn(token, asked)

    def test_a_wrong_link_is_not_repeated_with_its_token(self):
        code, _, errors = run("join", "https://or3:4400/#join=0123456789abcdef", "--no-window")
        self.assertEqual(code, 1)
        self.assertIn("https://or3:4400/", errors)
        self.assertNotIn("0123456789abcdef", errors)


if __name__ == "__main__":
    unittest.main()
