# SPDX-License-Identifier: Apache-2.0
"""The first minutes with the page: the test call before entering and inside, and the tour of a first visit."""
import json
import os
import pathlib
import unittest

from page_case import PageCase
from web_access_test import AXE, CONTRAST, FINDINGS, FOCUS

PICTURES = os.environ.get("THEATRON_PICTURES")  # a folder where pictures of the page stay
CAMERA = "synthetic:seconds=2,fps=5,quality=quick,loop=1"
SIZES = ((1280, 720), (1366, 650), (390, 844))
FAKE = ("--use-fake-device-for-media-stream", "--use-fake-ui-for-media-stream")

# Counts the tracks of devices that were opened and not stopped.
COUNT_TRACKS = """globalThis.open_tracks = new Set();
const before = MediaDevices.prototype.getUserMedia;
MediaDevices.prototype.getUserMedia = async function (wish) {
    (globalThis.wishes ??= []).push(JSON.stringify(wish));
    const stream = await before.call(this, wish);
    for (const track of stream.getTracks()) {
        open_tracks.add(track);
        const stop = track.stop;
        track.stop = function () { open_tracks.delete(track); stop.call(track); };
    }
    return stream;
};"""
REFUSES = "MediaDevices.prototype.getUserMedia = async () => { throw new DOMException('', '%s'); }"
DARK = """MediaDevices.prototype.getUserMedia = async () => {
    const canvas = document.createElement('canvas');
    canvas.getContext('2d').fillRect(0, 0, 9, 9);
    const stream = canvas.captureStream();
    setInterval(() => canvas.getContext('2d').fillRect(0, 0, 300, 150), 50);
    return stream;
}"""
NO_MEMORY = "Object.defineProperty(window, 'localStorage', { get() { throw new DOMException('', 'SecurityError'); } })"
LINE = "theatron.test_call.figures.line"
COMPUTER = "theatron.test_call.figures.computer"
# Buttons of which the card of the tour covers a part.
BELOW_CARD = """(card => [...document.querySelectorAll("#bar button, #touch button, #talk, #chips button")].filter(button => {
    const box = button.getBoundingClientRect();
    return button.checkVisibility() && box.left < card.right && card.left < box.right && box.top < card.bottom && card.top < box.bottom;
}).map(button => button.id || button.textContent))(document.getElementById("tour").getBoundingClientRect())"""
NAMED = "[...document.querySelectorAll('.named')].map(b => b.id)"


def says(what):
    return f"document.getElementById('{what}_says').textContent"


class WebFirst(PageCase):
    cameras = (CAMERA,)
    flags = FAKE

    def form(self, size=SIZES[0], role="expert", script="", touch=False, language=None):
        page = self.browser.open("about:blank", size)
        if touch:
            page.call("Emulation.setTouchEmulationEnabled", enabled=True, maxTouchPoints=2)
        if language:
            script += f";Object.defineProperty(navigator, 'language', {{ get: () => '{language}' }})"
        if script:
            page.call("Page.addScriptToEvaluateOnNewDocument", source=script)
        page.call("Page.navigate", url=self.links[role])
        page.wait_for("document.readyState === 'complete' && document.getElementById('enter')?.disabled === false")
        return page

    def open_test_call(self, page, button="show_test_call"):
        # A click of a person gives the button the focus, to which the dialog returns it.
        page.evaluate(f"(b => {{ b.focus(); b.click(); }})(document.getElementById('{button}'))")
        page.wait_for("document.getElementById('test_call').open && document.getElementById('microphone_choice').options.length > 0")

    def enter(self, page, way="room", tour=True):
        page.enter(way=way, tour=tour)
        page.wait_for("theatron.state.phase === 'joined'")

    def look(self, page, name):
        """Pictures in light and dark, and the rules for both."""
        for scheme in ("light", "dark"):
            page.call("Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": scheme}])
            self.assertEqual(page.evaluate(CONTRAST), [], scheme)
            if AXE.exists():
                if page.evaluate("globalThis.axe === undefined"):
                    page.evaluate(AXE.read_text() + ";0")
                self.assertEqual(page.evaluate(FINDINGS), [], scheme)
            if PICTURES:
                page.screenshot(pathlib.Path(PICTURES) / f"{name}_{scheme}.png")

    def test_the_test_call_tries_devices_when_asked_remembers_the_choice_and_lets_go(self):
        page = self.form(script=COUNT_TRACKS)
        self.open_test_call(page)
        self.assertIsNone(page.evaluate("globalThis.wishes ?? null"))
        page.evaluate("document.getElementById('test_microphone').click()")
        page.wait_for("document.getElementById('level').value > 0")
        page.wait_for(f"{says('microphone')} === 'This microphone hears you.'")
        page.evaluate("document.getElementById('test_webcam').click()")
        page.wait_for("document.getElementById('preview').videoWidth > 0 && document.getElementById('webcam_choice').options.length > 1")
        page.wait_for(f"{says('webcam')}.includes('The webcam works')")
        self.assertEqual(page.evaluate("getComputedStyle(document.getElementById('preview')).transform"), "matrix(-1, 0, 0, 1, 0, 0)")
        for answer, sentence in (("missed_tone", "Turn it up"), ("heard_tone", "You will hear the others")):
            page.evaluate("document.getElementById('test_tone').click()")
            page.wait_for("document.getElementById('tone_question').checkVisibility()")
            page.evaluate(f"document.getElementById('{answer}').click()")
            self.assertIn(sentence, page.evaluate(says("loudspeaker")))
            self.assertEqual(page.evaluate("document.activeElement.id"), "test_tone")
        self.assertEqual(page.evaluate("open_tracks.size"), 2)
        page.evaluate("(s => { s.selectedIndex = s.options.length - 1; s.dispatchEvent(new Event('change')); })"
                      "(document.getElementById('microphone_choice'))")
        chosen = page.evaluate("document.getElementById('microphone_choice').value")
        self.assertTrue(chosen)
        page.wait_for(f"wishes.at(-1).includes('{chosen}') && open_tracks.size === 2")
        page.press("Escape", "Escape", 27)
        page.wait_for("!document.getElementById('test_call').open && open_tracks.size === 0")
        self.assertEqual(page.evaluate("[theatron.test_call.devices.context, theatron.test_call.running, document.activeElement.id]"),
                         [None, None, "show_test_call"])
        with self.subTest("the choice holds in the room, and the next time"):
            self.enter(page, tour=False)
            page.evaluate("document.getElementById('microphone').click()")
            page.wait_for("theatron.voice.microphone === 'open'")
            self.assertIn(chosen, page.evaluate("wishes.at(-1)"))
            with self.subTest("inside it tries beside the room, says that one is heard, and another choice holds at once"):
                asked = len([url for url in page.requests if "/line" in url])
                page.open_sheet("more")
                self.open_test_call(page, "show_test_call_inside")
                self.assertTrue(page.evaluate("document.getElementById('heard_meanwhile').checkVisibility()"))
                page.evaluate("(s => { s.selectedIndex = 0; s.dispatchEvent(new Event('change')); })"
                              "(document.getElementById('microphone_choice'))")
                page.wait_for("theatron.voice.microphone === 'open' && !wishes.at(-1).includes('deviceId')")
                page.evaluate("document.getElementById('test_microphone').click()")
                page.wait_for("document.getElementById('level').value > 0 && open_tracks.size === 2")
                self.assertEqual(len([url for url in page.requests if "/line" in url]), asked, "measured without being asked")
                page.press("Escape", "Escape", 27)
                page.wait_for("!document.getElementById('test_call').open && open_tracks.size === 1")
                self.assertEqual(page.evaluate("[theatron.sheet.name, theatron.state.phase]"), ["more", "joined"])
            self.leave(page)
            page.wait_for("open_tracks.size === 0")
            self.assertEqual(page.problems, [])
            page = self.form()
            self.open_test_call(page)
            self.assertEqual(page.evaluate("document.getElementById('microphone_choice').value"), "")

    def test_line_and_computer_are_measured_and_said_in_sentences(self):
        page = self.form()
        self.open_test_call(page)
        page.wait_for(f"{LINE} && {COMPUTER} && !theatron.test_call.running")
        line, computer = page.evaluate(LINE), page.evaluate(COMPUTER)
        self.assertGreater(min(line.values()), 0)
        self.assertGreater(min(computer["depth_ms"], computer["color_ms"], computer["draw_ms"]), 0)
        print(json.dumps({"line": line, "computer": computer}))
        self.assertRegex(page.evaluate(says("line")), r"^Your line brings .* Mbit/s: .*\.\nFrom you it carries .* Mbit/s: .*\.\nThere and back takes \d+ ms: .*\.$")
        self.assertRegex(page.evaluate(says("computer")), r"^This computer .*\.$")
        token = self.links["expert"].split("join=")[1].split("&")[0]
        asked = [url for url in page.requests if "/line" in url]
        self.assertTrue(asked)
        self.assertEqual([url for url in page.requests if token in url.split("#")[0]], [])
        page.evaluate("document.getElementById('test_line').click()")
        page.wait_for("!!theatron.test_call.running")
        with self.subTest("closed meanwhile, it ends"):
            page.press("Escape", "Escape", 27)
            page.wait_for("theatron.test_call.running === null")
        self.assertEqual(page.problems, [])

    def test_what_the_figures_mean(self):
        page = self.form()
        module = "import(performance.getEntriesByType('resource').find(({ name }) => name.includes('/%s.')).name)"
        judged = page.evaluate(module % "line" + """.then(({ judge_line, rate_of }) => [
            ...[[20, 200, 50], [200, 31, 1], [500, 16, 0.1], [20, 8, 2], [20, 2.5, 2], [20, 1, 2]].map(([round_trip_ms, down_mbit, up_mbit]) =>
                Object.values(judge_line({ round_trip_ms, down_mbit, up_mbit })).map(([key]) => key.slice(5)).join()),
            judge_line({ round_trip_ms: 0.2, down_mbit: 100, up_mbit: 3.14 }).down[1].rate,
            rate_of([]), rate_of([[0, 9]]), rate_of([[0, 0], [250, 1000], [1000, 751000]])])""")
        self.assertEqual(judged, ["short,many,shown", "long,many,voice", "very_long,one,mute", "short,few,shown", "short,flat,shown",
                                  "short,narrow,shown", "more than 100", 0, 100, 8])
        judged = page.evaluate(module % "computer" + """.then(({ count_cameras, judge_computer }) => [
            ["card", 2, 8, 1, 4], ["card", 10, 10, 1, 2], ["card", 2, 8, 12, 4], ["card", 100, 8, 1, 1], ["processor", 6, 8, 90, 2],
            ["none", 1, 1, 1, 8], ["card", -1, 8, 1, 4]].map(([graphics, depth_ms, color_ms, draw_ms, workers]) =>
                judge_computer({ graphics, cameras: count_cameras({ graphics, depth_ms, color_ms, draw_ms, workers }) })
            ).map(([key, { count }]) => `${key.slice(9)} ${count}`))""")
        self.assertEqual(judged, ["most 6", "many 2", "many 2", "slow 0", "one 1", "flat 0", "slow 0"])

    def test_what_is_missing_denied_or_refused_has_one_sentence(self):
        for script, device, sentence in ((REFUSES % "NotAllowedError", "microphone", "does not give it to this page"),
                                         (REFUSES % "NotFoundError", "webcam", "There is none, or another program uses it"),
                                         (DARK, "webcam", "The picture is black")):
            with self.subTest(sentence):
                page = self.form(script=script)
                self.open_test_call(page)
                page.evaluate(f"document.getElementById('test_{device}').click()")
                page.wait_for(f"{says(device)}.includes('{sentence}')")
                page.close()
        with self.subTest("an old browser"):
            page = self.form(script="delete MediaDevices.prototype.getUserMedia")
            self.open_test_call(page)
            for device in ("microphone", "webcam"):
                self.assertIn("Use a newer one", page.evaluate(says(device)))
                self.assertTrue(page.evaluate(f"document.getElementById('test_{device}').disabled"))
            page.close()
        for answer, sentence in (("new Response('', { status: 429 })", "Try again in half a minute"),
                                 ("new Response('', { status: 410 })", "Ask for a new one"),
                                 ("new Response('', { status: 404 })", "This host is older"),
                                 ("Promise.reject(new TypeError('no line'))", "The host did not answer")):
            with self.subTest(sentence):
                page = self.form(script="const before = fetch; globalThis.fetch = (url, ...more) => "
                                        f"String(url).startsWith('/line') ? {answer} : before(url, ...more)")
                self.open_test_call(page)
                page.wait_for(f"{says('line')}.includes('{sentence}')")
                page.wait_for(f"!theatron.test_call.running && {says('computer')}.startsWith('This computer')")
                self.assertEqual(page.problems, [])
                page.close()

    def test_an_observer_tries_loudspeaker_line_and_computer_alone(self):
        page = self.form(role="observer")
        page.evaluate("document.getElementById('show_test_call').click()")
        shown = page.evaluate("[...document.querySelectorAll('#test_call_content button, #test_call_content select')].filter(e => e.checkVisibility()).map(e => e.id)")
        self.assertEqual(shown, ["loudspeaker_choice", "test_tone", "test_line", "test_computer"])

    def test_the_test_call_fits_and_is_reached_by_keys(self):
        for size in SIZES:
            with self.subTest(size=size):
                page = self.form(size, touch=size[0] < 600)
                if PICTURES:
                    page.screenshot(pathlib.Path(PICTURES) / f"form_{size[0]}.png")
                page.evaluate("document.getElementById('show_test_call').focus()")
                page.press("Enter", "Enter", 13, "\r")
                page.wait_for(f"{COMPUTER} && !theatron.test_call.running")
                for button in ("test_microphone", "test_webcam", "test_tone"):
                    page.evaluate(f"document.getElementById('{button}').click()")
                page.wait_for(f"{says('webcam')}.includes('works') && {says('microphone')}.includes('hears you.')")
                left, right = page.evaluate("(b => [b.left, b.right])(document.getElementById('test_call').getBoundingClientRect())")
                self.assertTrue(0 <= left < right <= size[0])
                self.assertEqual(page.evaluate("document.getElementById('test_call_content').scrollWidth - document.getElementById('test_call_content').clientWidth"), 0)
                self.look(page, f"test_call_{size[0]}")
                page.evaluate("document.getElementById('test_call_content').scrollTop = 9999")
                if PICTURES:
                    page.screenshot(pathlib.Path(PICTURES) / f"test_call_{size[0]}_end.png")
                page.evaluate("document.getElementById('test_call_title').focus()")
                reached = set()
                for _ in range(20):
                    page.press("Tab", "Tab", 9)
                    focus = page.evaluate(FOCUS)
                    if not focus["is_body"]:
                        self.assertTrue(focus["is_seen"], focus)
                        reached.add(focus["name"])
                self.assertLessEqual({"microphone_choice", "test_microphone", "test_tone", "heard_tone", "missed_tone", "webcam_choice",
                                      "test_webcam", "test_line", "test_computer"}, reached)
                page.close()

    def test_the_tour_has_three_steps_and_covers_nothing(self):
        for size in (*SIZES, (640, 360)):
            with self.subTest(size=size):
                page = self.form(size, touch=size[0] < 700)
                page.evaluate("localStorage.removeItem('tour')")
                self.enter(page)
                page.wait_for("document.getElementById('tour').checkVisibility()")
                self.assertEqual(page.evaluate("document.activeElement.id"), "view", "keys go on to act in the room")
                for step, names in enumerate(([], ["microphone", "point"], ["leave", "show_more"]), 1):
                    page.wait_for(f"document.getElementById('tour_title').textContent === 'Tour: {step} of 3'")
                    self.assertEqual(page.evaluate(NAMED), names)
                    self.assertEqual(page.evaluate(BELOW_CARD), [])
                    left, top, right, bottom = page.evaluate("(b => [b.left, b.top, b.right, b.bottom])(document.getElementById('tour').getBoundingClientRect())")
                    self.assertTrue(0 <= left < right <= size[0] and 0 <= top < bottom <= size[1], (left, top, right, bottom))
                    self.look(page, f"tour_{size[0]}_{step}")
                    x, y = page.middle("#tour_next")
                    page.mouse("mousePressed", x, y)
                    page.mouse("mouseReleased", x, y)
                page.wait_for("document.getElementById('tour').hidden")
                self.assertEqual(page.evaluate(NAMED), [])
                self.leave(page)
                page.reload()
                page.wait_for("document.getElementById('enter')?.disabled === false")
                self.enter(page)
                page.wait_for("theatron.tour && theatron.state.has_picture")
                self.assertEqual(page.evaluate("[theatron.tour.step, theatron.tour.is_due]"), [0, False], "once for each browser")
                self.assertEqual(page.problems, [])
                self.leave(page)
                page.close()

    def test_the_tour_goes_by_keys_and_is_found_again(self):
        page = self.form()
        page.evaluate("localStorage.removeItem('tour')")
        self.enter(page)
        page.wait_for("theatron.tour.step === 1")
        self.assertEqual(page.evaluate("document.getElementById('tour_text').getAttribute('role')"), "status")
        page.press("Tab", "Tab", 9)
        self.assertEqual(page.evaluate("document.activeElement.id"), "tour_next")
        page.press("Enter", "Enter", 13, "\r")
        page.wait_for("theatron.tour.step === 2 && document.activeElement.id === 'tour_next'")
        page.press("Escape", "Escape", 27)
        page.wait_for("theatron.tour.step === 0 && document.activeElement.id === 'view'")
        self.assertEqual(page.evaluate("[localStorage.getItem('tour'), theatron.state.phase]"), ["seen", "joined"])
        page.open_sheet("more")
        page.evaluate("document.getElementById('show_tour').focus()")
        page.press("Enter", "Enter", 13, "\r")
        page.wait_for("theatron.tour.step === 1 && theatron.sheet.name === '' && document.activeElement.id === 'tour_next'")
        with self.subTest("an open panel is closed first"):
            page.open_sheet("people")
            page.press("Escape", "Escape", 27)
            page.wait_for("theatron.sheet.name === '' && theatron.tour.step === 1")
        with self.subTest("in the 2D view it speaks of what is there"):
            page.evaluate("document.getElementById('other_way').click()")
            page.wait_for("theatron.state.phase === 'joined' && !document.getElementById('flat').hidden")
            page.wait_for(f"theatron.tour.step === 1 && {NAMED}.join() === 'next_camera'")
            page.evaluate("document.getElementById('tour_next').click()")
            page.wait_for(f"{NAMED}.join() === 'microphone,point'")
        page.evaluate("document.getElementById('tour_skip').click()")
        page.wait_for("theatron.tour.step === 0")
        self.leave(page)
        self.assertEqual(page.evaluate("document.getElementById('tour').hidden"), True)

    def test_without_a_memory_it_comes_again_and_an_observer_gets_its_own(self):
        page = self.form(role="observer", script=NO_MEMORY)
        for _ in range(2):
            self.enter(page)
            page.wait_for("theatron.tour.step === 1")
            page.evaluate("document.getElementById('tour_next').click()")
            page.wait_for(f"{NAMED}.join() === 'show_people'")
            page.evaluate("document.getElementById('tour_skip').click()")
            self.leave(page)
            page.reload()
            page.wait_for("document.getElementById('enter')?.disabled === false")
        self.assertEqual(page.problems, [])

    def test_all_languages_fit(self):
        for language in ("de-DE", "fr-FR"):
            with self.subTest(language):
                page = self.form(SIZES[2], language=language, touch=True)
                page.evaluate("localStorage.removeItem('tour')")
                if PICTURES:
                    page.screenshot(pathlib.Path(PICTURES) / f"form_{language}.png")
                self.open_test_call(page)
                page.wait_for(f"{COMPUTER} && !theatron.test_call.running")
                self.assertEqual(page.evaluate("document.getElementById('test_call_content').scrollWidth - document.getElementById('test_call_content').clientWidth"), 0)
                page.evaluate("document.getElementById('test_call_content').scrollTop = 9999")
                self.look(page, f"test_call_{language}")
                page.press("Escape", "Escape", 27)
                self.enter(page)
                page.wait_for("theatron.tour.step === 1")
                for step in (1, 2, 3):
                    self.assertEqual(page.evaluate(BELOW_CARD), [])
                    self.look(page, f"tour_{language}_{step}")
                    page.evaluate("document.getElementById('tour_next').click()")
                self.leave(page)
                page.close()


if __name__ == "__main__":
    unittest.main()
