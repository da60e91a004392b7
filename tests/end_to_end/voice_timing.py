# SPDX-License-Identifier: Apache-2.0
"""Recorded voices are in step with the session to a click, on a machine that does nothing else (make test-timing)."""
import unittest

from rates_timing import median_of_three
from theatron_process import Process, host, wait_until
from voice_recording_test import IN_STEP_S, VoiceRecordingCase


class VoiceTiming(VoiceRecordingCase):
    def test_each_click_is_in_the_file_when_it_was_spoken(self):
        with host(self.folder / "state", f"folder:{self.camera},loop=1,preload=1") as a_host:
            links = a_host.greeting["links"]
            with self.member(links["expert"], "Ada", "--microphone", self.folder / "clicks.wav", "--voice-may-record") as ada:
                begun_us = ada.wait_for(lambda f: f["voice"].get("microphone_began_us"))["voice"]["microphone_began_us"]

                def latest_s():
                    file = self.folder / "session.mkv"
                    recorder = Process("record", links["expert"], file, "--overwrite", "--json")
                    self.addCleanup(recorder.__exit__)
                    wait_until(lambda: file.exists() and file.stat().st_size > 4096)
                    before = ada.newest_json()["session_us"]
                    ada.wait_for(lambda f: f["session_us"] > before + 5e6)
                    recorder.process.terminate()
                    self.assertEqual(recorder.end(), 0)
                    return max(map(abs, self.click_errors(file, begun_us)))

                self.assertLess(median_of_three(latest_s), IN_STEP_S)


if __name__ == "__main__":
    unittest.main()
