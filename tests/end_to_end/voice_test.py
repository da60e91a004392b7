# SPDX-License-Identifier: Apache-2.0
"""Voice through real processes: what a listener's loudspeaker plays is what the speaker said, a muted person
is silent at once, and nobody speaks as somebody else."""
import array
import json
import math
import os
import pathlib
import shutil
import struct
import tempfile
import unittest
import wave

from raw_peer import VOICE, RawPeer
from theatron_process import Process, host, make_recording, run, wait_until

RATE = 48000


def chirps(seconds):
    """Speech-like: syllables of 0.3 s with 20 harmonics of a pitch that goes up and down."""
    samples, phase = array.array("h"), 0.0
    for i in range(int(seconds * RATE)):
        t = i / RATE
        phase += 2 * math.pi * (140 + 40 * math.sin(2 * math.pi * 0.37 * t)) / RATE
        loud = (0.15 + 0.85 * abs(math.sin(math.pi * t / 0.3))) * (0.55 + 0.45 * math.sin(1.3 * t * t))
        samples.append(int(4000 * loud * sum(math.sin(k * phase) / k for k in (1, 2, 3, 5, 8))))
    return samples


def write_wav(path, samples):
    with wave.open(str(path), "wb") as file:
        file.setnchannels(1)
        file.setsampwidth(2)
        file.setframerate(RATE)
        file.writeframes(samples.tobytes())


def read_wav(path):
    with wave.open(str(path), "rb") as file:
        assert (file.getframerate(), file.getnchannels(), file.getsampwidth()) == (RATE, 1, 2)
        samples = array.array("h")
        samples.frombytes(file.readframes(file.getnframes()))
        return samples


def read_ears(path):
    """The samples of the left and the right ear."""
    with wave.open(str(path), "rb") as file:
        assert (file.getframerate(), file.getnchannels(), file.getsampwidth()) == (RATE, 2, 2)
        samples = array.array("h")
        samples.frombytes(file.readframes(file.getnframes()))
        return samples[::2], samples[1::2]


def loudness(samples, block=480):
    return [math.sqrt(sum(v * v for v in samples[i:i + block]) / block)
            for i in range(0, len(samples) - block + 1, block)]


def best_correlation(a, b):
    """The best correlation of a's course with a part of b that is as long."""
    def normal(values):
        mean = sum(values) / len(values)
        values = [v - mean for v in values]
        size = math.sqrt(sum(v * v for v in values)) or 1
        return [v / size for v in values]
    a = normal(a)
    return max(sum(x * y for x, y in zip(a, normal(b[i:i + len(a)]))) for i in range(len(b) - len(a) + 1))


class Person(RawPeer):
    def __init__(self, link):
        super().__init__(link)
        self.join(depth_codec="raw", color_codec="raw")
        self.number = self.receive_control("Welcome")[1]["participant"]

    def speak(self, number, packet):
        self.send(bytes([VOICE]) + struct.pack("<I", number) + packet)

    def hear(self):
        """The speaker and the packet of the next envelope of voice."""
        while True:
            envelope = self.receive()
            if envelope[0] == VOICE:
                return struct.unpack_from("<I", envelope, 1)[0], envelope[5:]


class Voice(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="theatron_voice_"))
        self.addCleanup(shutil.rmtree, self.folder)
        self.said = chirps(20)
        write_wav(self.folder / "said.wav", self.said)

    def member(self, link, name, *options):
        return Process("join", link, "--name", name, "--every", "0.1", *options,
                       env={**os.environ, "XDG_STATE_HOME": str(self.folder / f"home of {name}")})

    def start(self):
        return host(self.folder / "state", f"folder:{make_recording(self.folder / 'box')},loop=1,preload=1")

    def test_what_is_said_is_heard_and_a_muted_person_is_silent(self):
        with self.start() as a_host:
            links = a_host.greeting["links"]
            with self.member(links["operator"], "Ada", "--speaker", self.folder / "ada.wav") as ada, \
                    self.member(links["expert"], "Eve", "--speaker", self.folder / "eve.wav") as eve, \
                    self.member(links["expert"], "Ben", "--microphone", self.folder / "said.wav") as ben:
                spoken = ada.wait_for(lambda f: f["voice"]["voices"] and f["voice"]["voices"][0]["seconds"] > 5)
                voice = spoken["voice"]["voices"][0]
                speaker = [p["id"] for p in spoken["room"]["people"] if p["name"] == "Ben"]
                self.assertEqual([voice["id"]], speaker)
                self.assertEqual(ben.newest_json()["voice"]["microphone"], "open")
                ada.wait_for(lambda f: [s["id"] for s in f["voice"]["speaking"]] == speaker)

                ada.say("mute Ben")
                ben.wait_for(lambda f: f["muted"] and not f["voice"]["heard"])
                wait_until(lambda: any("You are muted" in line for line in ben.errors))
                silent = ada.wait_for(lambda f: not f["voice"]["speaking"])
                muted = silent["voice"]["voices"][0]["seconds"]
                # Ben speaks on for a second, and no sample of it is heard.
                later = ada.wait_for(lambda f: f["session_us"] > silent["session_us"] + 1e6)
                self.assertEqual(later["voice"]["speaking"], [])
                self.assertLess(later["voice"]["voices"][0]["seconds"] - muted, 0.3)

                ada.say("unmute Ben")
                ada.wait_for(lambda f: f["voice"]["speaking"])
                ben.say("microphone off")
                ben.wait_for(lambda f: f["voice"]["microphone"] == "closed")
                ada.wait_for(lambda f: not f["voice"]["speaking"])
                for member in (ada, eve, ben):
                    member.say("quit")
                    self.assertEqual(member.end(), 0, member.errors)
        said = loudness(self.said)
        for name in ("ada", "eve"):
            heard = loudness(read_wav(self.folder / f"{name}.wav"))
            begin = next(i for i, v in enumerate(heard) if v > 300)
            # 4 s of what was heard, compared with all that was said.
            self.assertGreater(best_correlation(heard[begin + 20:begin + 420], said), 0.9, name)

    def test_with_push_to_talk_only_what_is_said_meanwhile_is_heard(self):
        with self.start() as a_host:
            link = a_host.greeting["links"]["expert"]
            with self.member(link, "Ada", "--speaker", self.folder / "ada.wav") as ada, \
                    self.member(link, "Ben", "--microphone", self.folder / "said.wav", "--push-to-talk") as ben:
                begun = ben.wait_for(lambda f: f["phase"] == "joined" and f["voice"]["microphone"] == "push")
                later = ada.wait_for(lambda f: f["session_us"] > begun["session_us"] + 1.5e6)
                self.assertEqual((later["voice"]["voices"], ben.newest_json()["voice"]["talks"]), ([], False))
                ben.say("talk on")
                ada.wait_for(lambda f: f["voice"]["speaking"])
                ben.wait_for(lambda f: f["voice"]["talks"])
                ben.say("talk off")
                ada.wait_for(lambda f: not f["voice"]["speaking"])
                ben.wait_for(lambda f: not f["voice"]["talks"])
                ben.say("microphone on")
                ada.wait_for(lambda f: f["voice"]["speaking"])
                self.assertEqual(ben.wait_for(lambda f: f["voice"]["talks"])["voice"]["microphone"], "open")

    def test_a_voice_is_heard_from_where_the_speaker_stands(self):
        with self.start() as a_host:
            link = a_host.greeting["links"]["expert"]
            with self.member(link, "Ada", "--speaker", self.folder / "ada.wav", "--spatial-voices", "on") as ada, \
                    self.member(link, "Ben", "--microphone", self.folder / "said.wav") as ben:
                ada.say("stand 0 1.7 0 0 1.7 -1")
                ben.say("stand -1.5 1.7 0 0 1.7 0")  # at Ada's left
                there = ada.wait_for(lambda f: f["voice"]["speaking"] and any(p.get("head") for p in f["room"]["people"] if p["name"] == "Ben"))
                self.assertEqual(there["voice"]["space"], "hrtf")
                # The end of the file is surely from there.
                ada.wait_for(lambda f: f["session_us"] > there["session_us"] + 2e6)
                for member in (ada, ben):
                    member.say("quit")
                    self.assertEqual(member.end(), 0, member.errors)
        left, right = (ear[-RATE:] for ear in read_ears(self.folder / "ada.wav"))
        # A head is a small obstacle for a voice this low; the delay between the ears says more.
        self.assertGreater(sum(v * v for v in left), 1.5 * sum(v * v for v in right))

        def likeness(delay):
            return sum(left[i] * right[i + delay] for i in range(0, RATE - 100, 7))

        self.assertIn(max(range(0, 60), key=likeness), range(20, 50), "samples of 1/48 ms")

    def test_devices_are_listed_and_exchanged_while_they_run(self):
        code, out, errors = run("join", "--list-devices", "--json",
                                env={**os.environ, "SDL_AUDIODRIVER": "dummy"})
        self.assertEqual(code, 0, errors)
        listed = json.loads(out)
        self.assertEqual(listed["problem"], "")
        self.assertTrue(listed["microphones"] and listed["loudspeakers"], listed)
        code, out, _ = run("join", "--list-devices", "--json", env={**os.environ, "SDL_AUDIODRIVER": "nothing"})
        self.assertIn("has no sound", json.loads(out)["problem"])
        with self.start() as a_host:
            link = a_host.greeting["links"]["expert"]
            write_wav(self.folder / "silence.wav", array.array("h", [0] * RATE))
            with self.member(link, "Ada", "--speaker", self.folder / "ada.wav") as ada, \
                    self.member(link, "Ben", "--microphone", self.folder / "silence.wav") as ben:
                ben.wait_for(lambda f: f["voice"]["microphone"] == "open")
                self.assertEqual(ada.wait_for(lambda f: f["phase"] == "joined")["voice"]["speaking"], [])
                ben.say(f"use microphone {self.folder / 'said.wav'}")
                ada.wait_for(lambda f: f["voice"]["speaking"])
                self.assertTrue(ben.newest_json()["voice"]["microphone_name"].endswith("said.wav"))
                ada.say(f"use speaker {self.folder / 'other.wav'}")
                wait_until(lambda: (self.folder / "other.wav").exists())
                self.assertFalse(ben.newest_json()["voice"]["echo_cancellation"], "a file is sent as it is")
                ben.say("use microphone missing.wav")
                ben.wait_for(lambda f: f["voice"]["microphone"] == "none")
                wait_until(lambda: any("missing.wav' does not exist" in line for line in ben.errors))

    def test_a_microphone_behind_the_echo_canceller_is_heard(self):
        with self.start() as a_host:
            link = a_host.greeting["links"]["expert"]
            with self.member(link, "Ada", "--speaker", self.folder / "ada.wav") as ada, \
                    self.member(link, "Ben", "--microphone", self.folder / "said.wav", "--speaker", self.folder / "ben.wav",
                                "--echo-cancellation", "on") as ben:
                ada.wait_for(lambda f: f["voice"]["voices"] and f["voice"]["voices"][0]["seconds"] > 3)
                self.assertTrue(ben.newest_json()["voice"]["echo_cancellation"])
                for member in (ada, ben):
                    member.say("quit")
                    self.assertEqual(member.end(), 0, member.errors)
        heard = loudness(read_wav(self.folder / "ada.wav"))
        begin = next(i for i, v in enumerate(heard) if v > 300)
        # The recording has gaps where a busy machine did not fill it in time, so one of several seconds must be like what was said.
        said = loudness(self.said)
        parts = [heard[at:at + 200] for at in range(begin + 50, len(heard) - 200, 50)]
        self.assertGreater(max(best_correlation(part, said) for part in parts), 0.7)

    def test_nobody_speaks_as_somebody_else_and_an_observer_does_not_speak(self):
        with self.start() as a_host:
            links = a_host.greeting["links"]
            with Person(links["expert"]) as ada, Person(links["expert"]) as mallory, \
                    Person(links["observer"]) as observer:
                observer.speak(mallory.number, b"observer")
                mallory.speak(ada.number, b"mallory")
                self.assertEqual(ada.hear(), (mallory.number, b"mallory"))
                self.assertEqual(observer.hear(), (mallory.number, b"mallory"))

    def test_sound_that_cannot_be_had_does_not_block_entry(self):
        os.mkfifo(self.folder / "pipe.wav")
        write_wav(self.folder / "empty.wav", array.array("h"))
        dictation = self.folder / "dictation.wav"
        write_wav(dictation, self.said[:4800])
        before = dictation.read_bytes()
        with self.start() as a_host:
            link = a_host.greeting["links"]["expert"]
            for option, file, sentence in (("--microphone", "missing.wav", "missing.wav' does not exist"),
                                           ("--microphone", "pipe.wav", "pipe.wav' is no regular file"),
                                           ("--microphone", "empty.wav", "empty.wav' holds no sound"),
                                           ("--speaker", "dictation.wav", "dictation.wav' exists already")):
                with self.subTest(file), self.member(link, "Ben", option, self.folder / file) as ben:
                    figures = ben.wait_for(lambda f: f["phase"] == "joined")
                    self.assertEqual((figures["voice"]["microphone"], figures["voice"]["speaker"]), ("none", False))
                    wait_until(lambda: any(sentence in line for line in ben.errors))
                    ben.say("microphone on")
                    wait_until(lambda: any("You have no microphone here" in line for line in ben.errors))
        self.assertEqual(dictation.read_bytes(), before)

    def test_an_observer_with_a_microphone_is_told_that_nobody_hears_it(self):
        with self.start() as a_host, \
                self.member(a_host.greeting["links"]["observer"], "Olga", "--microphone", self.folder / "said.wav") as olga:
            olga.wait_for(lambda f: f["phase"] == "joined" and not f["voice"]["heard"])
            wait_until(lambda: any("observers do not speak" in line for line in olga.errors))

    def test_a_loudspeakers_file_on_a_full_disk_is_told(self):
        small = self.folder / "small"
        small.mkdir()
        if os.system(f"mount -t tmpfs -o size=64k none {small} 2>/dev/null") != 0:
            self.skipTest("file systems cannot be mounted here")
        self.addCleanup(os.system, f"umount {small}")
        with self.start() as a_host, \
                self.member(a_host.greeting["links"]["expert"], "Ada", "--speaker", small / "ada.wav") as ada:
            wait_until(lambda: any("cannot be written any more" in line for line in ada.errors))


if __name__ == "__main__":
    unittest.main()
