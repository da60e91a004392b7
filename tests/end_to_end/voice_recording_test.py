# SPDX-License-Identifier: Apache-2.0
"""Voices in the recording of a session: only of people who agree, as standard Opus tracks that ffmpeg plays at the
time at which they were spoken, verified, recovered, exported and heard again in a replay."""
import array
import json
import os
import pathlib
import shutil
import struct
import subprocess
import tempfile
import unittest

from theatron_process import Process, host, make_recording, run, stand, wait_until
from voice_test import RATE, chirps, read_wav, write_wav

CLICKS_EVERY = 1  # seconds
IN_STEP_S = 0.04


def clicks(seconds):
    """1 ms of a loud 4 kHz tone at each multiple of CLICKS_EVERY but 0, in quiet noise."""
    samples = array.array("h", ((i * 7919) % 61 - 30 for i in range(seconds * RATE)))
    for second in range(CLICKS_EVERY, seconds, CLICKS_EVERY):
        for i in range(RATE // 1000):
            samples[second * RATE + i] = 20000 if i // 6 % 2 == 0 else -20000
    return samples


def onsets(samples):
    """The places of clicks: much louder than the millisecond before, nothing loud for half a second before."""
    found, block = [], RATE // 1000
    for i in range(0, len(samples) - block, block):
        if max(map(abs, samples[i:i + block])) > 3000 and (not found or i - found[-1] > RATE // 2):
            found.append(next(n for n in range(i, i + block) if abs(samples[n]) > 1500))
    return found


def ffmpeg(*arguments):
    return subprocess.run(["ffmpeg", "-v", "error", "-nostdin", *map(str, arguments)], check=True, capture_output=True).stdout


def probe(file):
    return json.loads(subprocess.run(["ffprobe", "-v", "error", "-of", "json", "-show_streams", str(file)],
                                     check=True, capture_output=True).stdout)["streams"]


class VoiceRecordingCase(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="theatron_voice_recording_"))
        self.addCleanup(shutil.rmtree, self.folder)
        self.camera = make_recording(self.folder / "box")
        stand(self.camera)
        write_wav(self.folder / "clicks.wav", clicks(40))
        write_wav(self.folder / "said.wav", chirps(30))

    def member(self, link, name, *options):
        return Process("join", link, "--name", name, "--every", "0.1", *options,
                       env={**os.environ, "XDG_STATE_HOME": str(self.folder / f"home of {name}")})

    def session_begin(self, file):
        """Session time of a recording's time 0 in us, from segment.bin."""
        head = file.read_bytes()[:65536]
        return struct.unpack_from("<q", head, head.index(b"TheatSeg") + 40)[0]

    def track(self, file, number):
        """Samples of the audio track of this number, as ffmpeg gives them, and the time of the first in seconds."""
        out = self.folder / f"track{number}.wav"
        ffmpeg("-y", "-i", file, "-map", f"0:a:{number}", "-c:a", "pcm_s16le", "-ac", "1", "-ar", RATE, out)
        first = subprocess.run(["ffprobe", "-v", "error", "-of", "csv=p=0", "-select_streams", f"a:{number}", "-show_entries",
                                "frame=pts_time", "-read_intervals", "%+#1", str(file)], check=True, capture_output=True).stdout
        return read_wav(out), float(first.split()[0].strip(b","))

    def click_errors(self, file, begun_us):
        """Seconds by which each click in the first track is late. `begun_us`: when the microphone with the clicks began, in
        session time, which is the machine's steady clock here."""
        samples, first = self.track(file, 0)
        zero = self.session_begin(file) / 1e6
        heard = [zero + first + n / RATE for n in onsets(samples)]
        self.assertGreaterEqual(len(heard), 3)
        return [(t - begun_us / 1e6 + CLICKS_EVERY / 2) % CLICKS_EVERY - CLICKS_EVERY / 2 for t in heard]


class VoiceRecording(VoiceRecordingCase):
    def test_voices_are_recorded_in_sync_of_those_who_agree_only(self):
        file = self.folder / "session.mkv"
        with host(self.folder / "state", f"folder:{self.camera},loop=1,preload=1") as a_host:
            links = a_host.greeting["links"]
            with self.member(links["expert"], "Ada", "--microphone", self.folder / "clicks.wav", "--voice-may-record") as ada, \
                    self.member(links["expert"], "Ben", "--microphone", self.folder / "said.wav") as ben:
                agreed_people = {"Ada": True, "Ben": False}
                ben.wait_for(lambda f: {p["name"]: p["voice_recorded"] for p in f["room"]["people"]} == agreed_people)
                recorder = Process("record", links["expert"], file, "--json")
                self.addCleanup(recorder.__exit__)
                agreed = ben.wait_for(lambda f: {p["name"]: p["voice_recorded"] for p in f["room"]["people"]} ==
                                      {**agreed_people, "recorder": False})
                self.assertEqual((ada.newest_json()["voice"]["may_record"], ben.newest_json()["voice"]["may_record"]), (True, False))
                begun = ada.wait_for(lambda f: f["voice"].get("microphone_began_us"))["voice"]["microphone_began_us"]
                wait_until(lambda: file.exists() and file.stat().st_size > 4096)
                ben.wait_for(lambda f: f["session_us"] > agreed["session_us"] + 3e6)
                # Ben agrees, speaks for a while, and takes it back.
                ben.say("voice-recording on")
                spoken = ben.wait_for(lambda f: f["voice"]["may_record"])
                ben.wait_for(lambda f: f["session_us"] > spoken["session_us"] + 2e6)
                ben.say("voice-recording off")
                silent = ben.wait_for(lambda f: not f["voice"]["may_record"])
                ben.wait_for(lambda f: f["session_us"] > silent["session_us"] + 2e6)
                recorder.process.terminate()
                figures = recorder.read_json()
                # 3: a busy machine passes over pictures; then the file says so, too.
                recorded = recorder.end()
                self.assertIn(recorded, (0, 3))
        voices = {v["name"]: v for v in figures["voices"]}
        self.assertEqual(set(voices), {"Ada", "Ben"})
        self.assertEqual(figures["voices_not_agreed"], ["Ben"])
        self.assertEqual(figures["segments"], 1, "there were spare tracks")

        streams = probe(file)
        audio = [s for s in streams if s.get("codec_type") == "audio"]
        # One who agreed when it began, and eight spare ones.
        self.assertEqual([s["codec_name"] for s in audio], ["opus"] * 9)
        self.assertEqual([s["tags"]["title"] for s in audio[:2]], ["Ada", "voice 2"])
        # A track that is out of step has all clicks late. That each one is in time: voice_timing.py.
        errors = self.click_errors(file, begun)
        self.assertLess(sorted(map(abs, errors))[len(errors) // 2], IN_STEP_S, errors)
        print("clicks in the file, ms late:", [round(1000 * e, 1) for e in errors])

        # Ben's words are there only while he agreed.
        zero = self.session_begin(file) / 1e6
        samples, first = self.track(file, 1)
        loud = [zero + first + i / RATE for i in range(0, len(samples), 480) if max(map(abs, samples[i:i + 480])) > 500]
        self.assertGreater(len(loud), 80)
        self.assertGreater(loud[0], spoken["session_us"] / 1e6 - 0.5)
        self.assertLess(loud[-1], silent["session_us"] / 1e6 + 0.5)
        self.assert_kept(file, voices, recorded)
        self.assert_heard_again(file)

    def test_a_session_without_cameras_is_recorded_and_cameras_that_come_later_too(self):
        file = self.folder / "meeting.mkv"
        with host(self.folder / "state") as a_host:
            links = a_host.greeting["links"]
            with self.member(links["expert"], "Ada", "--microphone", self.folder / "said.wav", "--voice-may-record") as ada:
                ada.wait_for(lambda f: any(p["voice_recorded"] for p in f["room"]["people"]))
                recorder = Process("record", links["expert"], file, "--json")
                self.addCleanup(recorder.__exit__)
                wait_until(lambda: file.exists() and file.stat().st_size > 20000)
                ada.say("brick 0.5 1 0.25")
                ada.wait_for(lambda f: any(o["kind"] == "brick" for o in f["room"]["objects"]))
                before = ada.newest_json()["session_us"]
                ada.wait_for(lambda f: f["session_us"] > before + 2e6)
                second = self.folder / "meeting.002.mkv"
                self.assertFalse(second.exists())
                with Process("publish", links["publisher"], "--camera", f"folder:{self.camera},loop=1,preload=1", "--may-record"):
                    wait_until(lambda: second.exists() and second.stat().st_size > 20000)
                    recorder.process.terminate()
                    figures = recorder.read_json()
                    # 3: a busy machine passes over pictures; then the file says so, too.
                    recorded = recorder.end()
                    self.assertIn(recorded, (0, 3), "".join(recorder.errors))
        self.assertEqual([v["name"] for v in figures["voices"]], ["Ada"])
        self.assertEqual((figures["segments"], len(figures["cameras"])), (2, 1))

        # The first segment by itself has no camera, and says that another one follows it.
        alone = self.folder / "alone" / "meeting.mkv"
        alone.parent.mkdir()
        shutil.copy(file, alone)
        code, out, errors = run("inspect", alone, "--json", "--verify")
        self.assertEqual(code, 3, errors)
        found = json.loads(out)
        self.assertEqual((found["cameras"], found["missing_segments"], found["segments"][0]["pictures"]), ([], 1, 0))
        self.assertGreater(found["seconds"], 1.9)
        self.assertEqual(sorted(found["room"]["people"]), ["Ada", "recorder"])
        self.assertGreater(found["voices"]["people"][0]["packets"], 50)
        code, out, errors = run("inspect", file, "--json", "--verify")
        self.assertEqual(code, recorded, out + errors)
        self.assertFalse(json.loads(out)["damaged"], out)
        self.assertEqual(len(json.loads(out)["cameras"]), 1)
        self.assertEqual(run("recover", alone, alone.parent / "saved.mkv")[0], 3)
        code, _, errors = run("export", alone.parent / "saved.mkv", "--voices", self.folder / "words", "--room", self.folder / "room.jsonl")
        self.assertEqual(code, 3, errors)
        self.assertIn("1 segment is missing", errors)
        self.assertEqual(len(list((self.folder / "words").glob("*.wav"))), 1)
        self.assertIn('"kind":"brick"', (self.folder / "room.jsonl").read_text().replace(" ", ""))
        code, _, errors = run("export", alone, "--ply", self.folder / "points")
        self.assertEqual(code, 1)
        self.assertIn("no camera was there", errors)
        with host(self.folder / "replay", f"recording:{alone},loop=1") as a_host, \
                self.member(a_host.greeting["link"], "Guest", "--speaker", self.folder / "guest.wav") as guest:
            guest.wait_for(lambda f: any(p["recorded"] and p["name"] == "Ada" for p in f["room"]["people"]) and
                           any(o["recorded"] for o in f["room"]["objects"]))
            wait_until(lambda: (self.folder / "guest.wav").exists() and
                       max(map(abs, read_growing(self.folder / "guest.wav")), default=0) > 500)

    def assert_kept(self, file, voices, recorded):
        code, out, errors = run("inspect", file, "--json", "--verify")
        self.assertEqual(code, recorded, errors)
        found = json.loads(out)["voices"]
        self.assertEqual({p["name"]: p["packets"] for p in found["people"]}, {n: v["packets"] for n, v in voices.items()})
        self.assertEqual(found["damaged"], 0)
        code, _, errors = run("export", file, "--voices", self.folder / "said")
        self.assertEqual(code, recorded, errors)
        exported = self.folder / "said" / f"voice-{voices['Ada']['participant']}.wav"
        theirs, ours = onsets(self.track(file, 0)[0]), onsets(read_wav(exported))
        self.assertEqual(len(ours), len(theirs))
        self.assertNotEqual(run("export", file, "--voices", self.folder / "said")[0], 0, "they exist already")

        # A byte of one packet of Ben changes: it alone is lost, and said.
        bytes_ = bytearray(file.read_bytes())
        packets = subprocess.run(["ffprobe", "-v", "error", "-of", "json", "-select_streams", "a:1", "-show_packets", str(file)],
                                 check=True, capture_output=True).stdout
        large = max(json.loads(packets)["packets"], key=lambda p: int(p["size"]))
        bytes_[int(large["pos"]) + 30] ^= 1
        damaged = self.folder / "damaged.mkv"
        damaged.write_bytes(bytes_)
        code, out, _ = run("inspect", damaged, "--json", "--verify")
        self.assertEqual((code, json.loads(out)["voices"]["damaged"]), (3, 1))
        code, out, errors = run("recover", damaged, self.folder / "saved.mkv", "--json")
        self.assertEqual(code, 3, errors)
        self.assertEqual(json.loads(out)["voices"]["damaged"], 1)
        self.assertEqual(run("inspect", self.folder / "saved.mkv", "--verify")[0], 3, "it says that it lacks something")
        self.assertEqual(len(onsets(self.track(self.folder / "saved.mkv", 0)[0])), len(theirs))

    def assert_heard_again(self, file):
        with host(self.folder / "replay", f"recording:{file},loop=1") as a_host, \
                self.member(a_host.greeting["link"], "Guest", "--speaker", self.folder / "guest.wav") as guest:
            def recorded_speakers(f):
                people = {p["id"]: p["name"] for p in f["room"]["people"] if p["recorded"]}
                return {people.get(voice["id"]) for voice in f["voice"]["voices"]}
            guest.wait_for(lambda f: "Ada" in recorded_speakers(f))
            wait_until(lambda: (self.folder / "guest.wav").exists() and
                       len(onsets(read_growing(self.folder / "guest.wav"))) >= 2)


def read_growing(path):
    samples = array.array("h")
    content = path.read_bytes()[44:]
    samples.frombytes(content[:len(content) // 2 * 2])
    return samples


if __name__ == "__main__":
    unittest.main()
