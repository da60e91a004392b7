# SPDX-License-Identifier: Apache-2.0
"""Programs and hosts of protocols that do not go together: one sentence with both numbers and what to do."""
import pathlib
import shutil
import tempfile
import unittest

from raw_peer import PROTOCOL, FakeHost, RawPeer, join_message
from theatron_process import Process, host, make_recording

SENDS_ONLY = 2         # wire::Feature
PROGRAM_TOO_OLD = 101  # wire::TextCode
OLD_PROGRAM = f"Your Theatron is too old for this host (protocol {PROTOCOL}, it needs {PROTOCOL + 1}); update it."
OLD_HOST = f"This host is older than your Theatron (protocol {PROTOCOL - 1}, you need {PROTOCOL}); update the host."


def newer_host(guest):
    guest.receive_control("Join")
    guest.send_control("Refused", in_english="English of a newer host.",
                       reason={"code": PROGRAM_TOO_OLD, "arguments": [str(PROTOCOL), str(PROTOCOL + 1)]})
    guest.wait_for_end()


def welcome_of(protocol):
    """A host that breaks the rule: it takes a participant in without a protocol that both know."""
    def script(guest):
        guest.receive_control("Join")
        guest.welcome(protocol=protocol)
        guest.wait_for_end()
    return script


class Versions(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="theatron_versions_"))
        self.addCleanup(shutil.rmtree, self.folder)
        self.camera = f"folder:{make_recording(self.folder / 'box', frames=3)},loop=1"

    def test_this_host_tells_newer_and_older_programs_what_to_do(self):
        with host(self.folder / "state", self.camera) as h:
            links = h.greeting["links"]
            for link, fields in ((links["expert"], {}), (links["expert"], {"records": True}),
                                 (links["publisher"], {"features": [SENDS_ONLY]})):
                for protocols, expected in (
                        ((PROTOCOL + 1, PROTOCOL + 2),
                         f"This host is older than your Theatron (protocol {PROTOCOL}, you need {PROTOCOL + 1}); update the host."),
                        ((1, PROTOCOL - 1),
                         f"Your Theatron is too old for this host (protocol {PROTOCOL - 1}, it needs {PROTOCOL}); update it.")):
                    join = join_message(link, protocol_min=protocols[0], protocol_max=protocols[1], **fields)
                    with self.subTest(fields=fields, protocols=protocols), RawPeer(link) as peer:
                        peer.send(join)
                        kind, said = peer.receive_control()
                        self.assertEqual((kind, said.get("in_english")), ("Refused", expected))
                        peer.wait_for_end()
            # A newer program that speaks today's protocol, too.
            join = join_message(links["expert"], protocol_min=PROTOCOL, protocol_max=PROTOCOL + 5)
            with RawPeer(links["expert"]) as peer:
                peer.send(join)
                self.assertEqual(peer.receive_control("Welcome", "Refused")[1].get("protocol"), PROTOCOL)

    def test_viewers_publishers_and_recorders_end_with_one_sentence_at_other_hosts(self):
        programs = {
            "join": lambda link: ("join", link, "--no-window"),
            "offscreen": lambda link: ("join", link, "--offscreen", self.folder / "view.png"),
            "publish": lambda link: ("publish", link, "--camera", self.camera),
            "record": lambda link: ("record", link, self.folder / "session.mkv"),
        }
        for script, expected in ((newer_host, OLD_PROGRAM), (welcome_of(PROTOCOL + 1), OLD_PROGRAM),
                                 (welcome_of(PROTOCOL - 1), OLD_HOST)):
            for name, words in programs.items():
                with self.subTest(name, expected=expected), FakeHost(script) as fake, Process(*words(fake.link)) as program:
                    self.assertEqual(program.end(), 1)
                    said = [line for line in program.errors if "protocol" in line or "English" in line]
                    self.assertEqual(len(said), 1, program.errors)
                    self.assertIn(expected, said[0])
                    self.assertEqual(fake.guests, 1, "it is of no use to try again")


if __name__ == "__main__":
    unittest.main()
