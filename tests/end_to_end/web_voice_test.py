# SPDX-License-Identifier: Apache-2.0
"""Voice between a browser's page and a native participant; the browser's microphone is a file."""
import contextlib
import math
import os
import pathlib
import re
import tempfile
import unittest

from browser import CHROMIUM, Browser
from theatron_process import PROGRAM, Process, host
from voice_test import RATE, chirps, read_wav, write_wav

PAGE = pathlib.Path(PROGRAM).parent / "web/files.txt"
HAS_OPUS = PAGE.exists() and re.search(r"^/opus\.\w+\.wasm", PAGE.read_text(), re.MULTILINE)
SIZE = (640, 360)

# Gathers what the speaker's jitter buffer plays, and the loudness at both ears.
LISTEN = """(() => {
    const { voice } = theatron, [speaker] = voice.speakers.values();
    const tap = new AudioWorkletNode(voice.context, "microphone", { numberOfOutputs: 0 });
    const heard = theatron.heard = { samples: [], ears: [0, 0] };
    tap.port.onmessage = ({ data }) => heard.samples.push(...data);
    speaker.node.connect(tap);
    const ears = new ChannelSplitterNode(voice.context, { numberOfOutputs: 2 });
    speaker.panner.connect(ears);
    for (const ear of [0, 1]) {
        const one = new AudioWorkletNode(voice.context, "microphone", { numberOfOutputs: 0 });
        one.port.onmessage = ({ data }) => heard.ears[ear] += data.reduce((sum, v) => sum + v * v, 0);
        ears.connect(one, ear);
    }
})()"""


# heard_frames(count): the frames that were sent of the newest `count` ones of the microphone, once that number came since
# the last answer; -1 before.
COUNT = """(() => {
    const { voice } = theatron, send = voice.send, sent = [];
    voice.send = (number, ...facts) => {
        sent.push(number);
        send(number, ...facts);
    };
    let asked = voice.number;
    theatron.heard_frames = count => {
        if (voice.number < asked + count)
            return -1;
        asked = voice.number;
        return sent.filter(number => number >= asked - count).length;
    };
})()"""

# A browser without Opus in one direction, or one that knows the codec and refuses it.
NO_ENCODER = "delete globalThis.AudioEncoder;"
NO_DECODER = "delete globalThis.AudioDecoder;"
REFUSES_TO_DECODE = "AudioDecoder.isConfigSupported = async config => ({ supported: false, config });"

# Packets of somebody whose bytes are no Opus, whole and cut, and one that is too long.
DAMAGED = """(() => {
    let seed = 1;
    const random = () => (seed = (seed * 48271) % 2147483647) % 256;
    for (let number = 0; number < 100; ++number) {
        const packet = Uint8Array.from({ length: 17 + (number * 7) % 300 }, random);
        packet.set([1, 0, 20, 30, number, 0, 0, 0]);
        theatron.voice.hear(4000, packet);
    }
    theatron.voice.hear(4000, Uint8Array.from([1, 0, 20, 30, ...Array(1400).fill(7)]));
})()"""


def press(page, key, kind="keydown"):
    page.evaluate(f"document.getElementById('view').dispatchEvent(new KeyboardEvent('{kind}', {{ key: '{key}', bubbles: true }}))")


def mouse(page, kind, element):
    x, y = page.evaluate(f"""(() => {{
        const element = document.getElementById("{element}");
        element.scrollIntoView();
        const {{ left, top, width, height }} = element.getBoundingClientRect();
        return [left + width / 2, top + height / 2];
    }})()""")
    page.call("Input.dispatchMouseEvent", type=kind, x=x, y=y, button="left", clickCount=1)


def pitches(samples):
    """The pitch of each 20 ms in Hz, 97 to 200, by the delay after which 40 ms are most like themselves; 0 in silence."""
    rate = RATE // 8
    low = [sum(samples[i:i + 8]) for i in range(0, len(samples) - 7, 8)]
    found = []
    for begin in range(0, len(low) - rate // 25 - rate // 97, rate // 50):
        block = low[begin:begin + rate // 25]
        power = sum(v * v for v in block)
        def likeness(lag):
            late = low[begin + lag:begin + lag + len(block)]
            return sum(a * b for a, b in zip(block, late)) / math.sqrt(power * sum(v * v for v in late) + 1)
        lag = max(range(rate // 200, rate // 97), key=likeness)
        found.append(rate / lag if power > len(block) * 500 ** 2 and likeness(lag) > 0.7 else 0)
    return found


def pitch_error(part, said):
    """Median relative difference to that part of what was said which fits best; 1 if less than half of it has a pitch."""
    def error(begin):
        differences = sorted(abs(a / b - 1) for a, b in zip(part, said[begin:]) if a and b)
        return differences[len(differences) // 2] if len(differences) > len(part) // 2 else 1
    return min(error(begin) for begin in range(len(said) - len(part)))


@unittest.skipUnless(CHROMIUM, "chromium is not installed: apt-get install chromium")
@unittest.skipUnless(PAGE.exists(), "there is no browser client: make build")
class WebVoice(unittest.TestCase):
    def setUp(self):
        self.stack = contextlib.ExitStack()
        self.addCleanup(self.stack.close)
        self.folder = pathlib.Path(self.stack.enter_context(tempfile.TemporaryDirectory()))
        self.said = chirps(12)
        write_wav(self.folder / "said.wav", self.said)
        self.host = self.stack.enter_context(host(self.folder / "host"))
        self.links = self.host.greeting["links"]

    def native(self, role, *options):
        return self.stack.enter_context(
            Process("join", self.links[role], "--name", "Ben", "--every", "0.2", *options,
                    env={**os.environ, "XDG_STATE_HOME": str(self.folder / "home")}))

    def browser_with_microphone(self):
        return self.stack.enter_context(Browser(
            "--use-fake-device-for-media-stream", "--use-fake-ui-for-media-stream",
            f"--use-file-for-fake-audio-capture={self.folder / 'said.wav'}"))

    def enter(self, browser, role="expert", name="Ada", script="", way=None):
        """`script` runs before the page's own."""
        page = browser.open("about:blank", SIZE)
        page.call("Page.addScriptToEvaluateOnNewDocument", source=script)
        page.call("Page.navigate", url=self.links[role])
        page.wait_for("location.protocol === 'https:'")
        page.enter(name=name, way=way, speaks=True)
        page.wait_for("theatron.state.phase === 'joined'")
        return page

    def assert_heard(self, played):
        """The voice's pitch in some two seconds is that of what was said. On a busy machine others are interrupted."""
        said, heard = pitches(self.said + self.said), pitches(played)
        parts = [heard[i:i + 100] for i in range(0, len(heard) - 100, 50)]
        self.assertLess(min(pitch_error(part, said) for part in parts), 0.03)

    def assert_page_hears(self, page, seconds):
        """The only voice in the page is what was said."""
        page.evaluate(LISTEN)
        page.wait_for(f"theatron.heard.samples.length > {seconds * RATE}")
        self.assert_heard([int(32767 * v) for v in page.evaluate(f"theatron.heard.samples.slice({RATE}, {seconds * RATE})")])

    def assert_survives_damage(self, page):
        """Packets that are no Opus are counted, and the others are still heard."""
        before = page.evaluate("theatron.voice.unreadable")
        page.evaluate(DAMAGED)
        page.wait_for(f"theatron.voice.unreadable > {before + 1}")
        heard = page.evaluate("[...theatron.voice.speakers.values()][0].figures.seconds")
        page.wait_for(f"[...theatron.voice.speakers.values()][0].figures.seconds > {heard + 1}")

    def own_opus(self, page):
        return [url for url in page.requests if "/opus." in url and url.endswith(".wasm")]

    def test_page_and_native_participant_hear_each_other(self):
        browser = self.browser_with_microphone()
        heard = self.folder / "heard.wav"
        ben = self.native("operator", "--microphone", self.folder / "said.wav", "--speaker", heard)
        page = self.enter(browser)
        with self.subTest("the page hears the native participant, from where he stands"):
            ear = page.wait_for("theatron.state.people.length === 2 && theatron.state.ear")
            (x, y, z), ahead = ear["position"], ear["ahead"]
            left = (ahead[2], 0, -ahead[0])  # y is up
            ben.say(" ".join(["stand"] + [f"{v:.3f}" for v in (x + left[0], y, z + left[2], x, y, z)]))
            page.wait_for("theatron.voice.speakers.size === 1 && theatron.state.people.every(p => p.self || p.head)")
            page.wait_for("document.getElementById('speaking').textContent === 'Speaking: Ben'")
            self.assert_page_hears(page, 5)
            left, right = page.evaluate("theatron.heard.ears")
            self.assertGreater(left, 1.3 * right)
            self.assertEqual(self.own_opus(page), [], "the browser has Opus")
        with self.subTest("the native participant hears the page"):
            spoken = ben.wait_for(lambda f: f["voice"]["voices"] and f["voice"]["voices"][0]["seconds"] > 8)
            ada = [person["id"] for person in spoken["room"]["people"] if person["name"] == "Ada"]
            self.assertEqual([voice["id"] for voice in spoken["voice"]["voices"]], ada)
        with self.subTest("the person agrees to be recorded, and no longer, and sees both"):
            def agrees(is_agreed):
                ben.wait_for(lambda f: [p["voice_recorded"] for p in f["room"]["people"] if p["name"] == "Ada"] == [is_agreed])

            recorded = "document.getElementById('voice_recorded').textContent"
            agrees(False)
            self.assertEqual(page.evaluate(recorded), "", "nobody records")
            with Process("record", self.links["expert"], self.folder / "session.mkv", "--seconds", "60") as recorder:
                page.wait_for(f"{recorded}.includes('without your voice')")
                page.evaluate("document.getElementById('voice_recording').click()")
                agrees(True)
                page.wait_for(f"{recorded}.includes('Your voice is recorded')")
                press(page, "F8")
                agrees(False)
                page.wait_for(f"{recorded}.includes('without your voice')")
                recorder.process.kill()
        with self.subTest("push to talk: only what is said while the key or the button is held is sent"):
            page.evaluate(COUNT)
            press(page, "F7")
            self.assertTrue(page.evaluate("theatron.voice.pushes"))
            # The last word goes on for a moment.
            page.wait_for("theatron.heard_frames(30) === 0")
            for hold, release in ((lambda: press(page, "Enter"), lambda: press(page, "Enter", "keyup")),
                                  (lambda: mouse(page, "mousePressed", "talk"), lambda: mouse(page, "mouseReleased", "talk"))):
                hold()
                page.wait_for("theatron.heard_frames(30) > 0")
                release()
                page.wait_for("theatron.heard_frames(30) === 0")
            page.evaluate("document.getElementById('push_to_talk').click()")
            self.assertFalse(page.evaluate("theatron.voice.pushes"))
            page.wait_for("theatron.heard_frames(30) > 0")
        with self.subTest("muted, the page says so and is silent"):
            ben.say("mute Ada")
            page.wait_for("document.getElementById('voice_hint').textContent.includes('muted you')")
            ben.wait_for(lambda f: not f["voice"]["speaking"])
        with self.subTest("a closed microphone is closed"):
            page.evaluate("document.getElementById('microphone').click()")
            self.assertEqual(page.evaluate("theatron.voice.microphone"), "off")
            self.assertIsNone(page.evaluate("theatron.voice.stream"))
        ben.say("quit")
        self.assertEqual(ben.end(), 0)
        self.assert_native_heard(heard, 8)
        self.assertEqual(page.problems, [])

    def assert_native_heard(self, file, seconds):
        # Behind the browser's echo and noise filters the levels are others; the course of the syllables stays.
        played = read_wav(file)
        first = next(i for i, v in enumerate(played) if v > 1000)
        self.assert_heard(played[first:first + seconds * RATE])

    @unittest.skipUnless(HAS_OPUS, "the page was built without libopus, whose sources could not be fetched")
    def test_without_opus_in_the_browser_they_hear_each_other_all_the_same(self):
        heard = self.folder / "heard.wav"
        ben = self.native("operator", "--microphone", self.folder / "said.wav", "--speaker", heard)
        page = self.enter(self.browser_with_microphone(), script=NO_ENCODER + NO_DECODER, way="flat")
        page.wait_for("theatron.voice.speakers.size === 1 && theatron.voice.microphone === 'open'")
        self.assertEqual(len(self.own_opus(page)), 2, "one for each direction")
        self.assert_page_hears(page, 5)
        ben.wait_for(lambda f: f["voice"]["voices"] and f["voice"]["voices"][0]["seconds"] > 5)
        self.assert_survives_damage(page)
        ben.say("quit")
        self.assertEqual(ben.end(), 0)
        self.assert_native_heard(heard, 5)
        self.assertEqual(page.problems, [])

    @unittest.skipUnless(HAS_OPUS, "the page was built without libopus, whose sources could not be fetched")
    def test_each_direction_falls_back_by_itself(self):
        browser = self.browser_with_microphone()
        pages = {codecs: self.enter(browser, name=name, script=script, way="flat") for name, script, codecs in (
            ("Ada", NO_ENCODER, ("OwnEncoder", "BrowserDecoder")),
            ("Eva", REFUSES_TO_DECODE, ("BrowserEncoder", "OwnDecoder")))}
        for codecs, page in pages.items():
            page.wait_for("[...theatron.voice.speakers.values()].some(speaker => speaker.figures.seconds > 1)")
            self.assertEqual(page.evaluate("[theatron.voice.encoder, ...theatron.voice.speakers.values()]"
                                           ".map(user => (user.decoder ?? user).constructor.name)"), list(codecs))
            self.assertEqual(len(self.own_opus(page)), 1)
            self.assert_survives_damage(page)
            self.assertEqual(page.problems, [])

    def test_without_a_microphone_the_page_is_in_the_room_and_says_what_to_do(self):
        browser = self.stack.enter_context(Browser("--use-fake-device-for-media-stream"))
        browser.call("Browser.setPermission", permission={"name": "microphone"}, setting="denied")
        page = self.enter(browser)
        page.wait_for("document.getElementById('voice_hint').textContent.includes('Allow it')")
        self.assertEqual(page.evaluate("theatron.state.phase"), "joined")
        self.native("expert", "--microphone", self.folder / "said.wav")
        page.wait_for("[...theatron.voice.speakers.values()].some(speaker => speaker.figures.seconds > 1)")


if __name__ == "__main__":
    unittest.main()
