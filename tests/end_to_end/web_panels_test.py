# SPDX-License-Identifier: Apache-2.0
"""Panels and form of the page for slow hands, the keyboard alone, long names, small screens and a host that is away."""
import contextlib
import pathlib
import tempfile
import time
import unittest

from browser import CHROMIUM, Browser
from theatron_process import PROGRAM, Process, host

PAGE = pathlib.Path(PROGRAM).parent / "web/files.txt"
CAMERA = "synthetic:seconds=2,fps=10,quality=quick,loop=1"
FOCUSED = "document.activeElement?.dataset?.label ?? document.activeElement?.id"
MUTE = "#room_panels [data-label$=\"/Mute\"]"


@unittest.skipUnless(CHROMIUM, "chromium is not installed: apt-get install chromium")
@unittest.skipUnless(PAGE.exists(), "there is no browser client: make build")
class WebPanels(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.stack = contextlib.ExitStack()
        cls.folder = pathlib.Path(cls.stack.enter_context(tempfile.TemporaryDirectory()))
        cls.host = cls.stack.enter_context(host(cls.folder / "host", CAMERA))
        cls.link = cls.host.greeting["links"]["operator"]
        cls.browser = cls.stack.enter_context(Browser())

    @classmethod
    def tearDownClass(cls):
        cls.stack.close()

    def enter(self, way="room", size=(640, 480)):
        page = self.browser.open(self.link, size)
        page.enter("Ada", way=way)
        page.wait_for("theatron.state.phase === 'joined'")
        return page

    def leave(self, page):
        page.evaluate("document.getElementById('leave').click()")
        page.wait_for("theatron.state.phase === 'left'")

    def test_a_slow_click_acts_while_ages_change_and_the_keyboard_keeps_its_button(self):
        with Process("join", self.link, "--no-window", "--name", "Ben", "--every", "0.5", "--json") as ben:
            page = self.enter()
            page.wait_for("theatron.state.people.some(p => p.name === 'Ben') && theatron.state.cameras[0]?.frames > 3")
            page.wait_for(f"!!document.querySelector('{MUTE}')")
            page.evaluate(f"document.querySelector('{MUTE}').scrollIntoView()")
            at = page.middle(MUTE)
            page.mouse("mousePressed", *at)
            ages = page.evaluate("document.getElementById('room_panels').textContent")
            time.sleep(0.8)
            page.mouse("mouseReleased", *at)
            ben.wait_for(lambda f: f["muted"], 30)
            page.wait_for(f"!document.querySelector('{MUTE}') && document.querySelector('#room_panels').textContent.includes('Unmute')")
            # Beside the buttons the ages go on.
            page.wait_for(f"document.getElementById('room_panels').textContent !== {ages!r}")
            # By the keyboard: its label changes under the focus.
            page.evaluate("[...document.querySelectorAll('#room_panels button')].find(b => b.textContent === 'Unmute').focus()")
            page.press("Enter", "Enter", 13, "\r")
            ben.wait_for(lambda f: not f["muted"], 30)
            page.wait_for(f"({FOCUSED} ?? '').endsWith('/Mute')")
            self.assertEqual(page.problems, [])
            self.leave(page)

    def test_a_click_never_meets_another_row(self):
        page = self.enter()
        found = page.evaluate("""import(performance.getEntriesByType('resource').find(({ name }) => name.includes('/panels.')).name).then(({ command_of }) => {
                const row = (text, command) => ({ text, detail: "", buttons: [{ label: "Remove", command }] });
                const button = { dataset: { label: "People/Ben/Remove", command: "1" } };
                const of = (...all) => command_of(button, [{ title: "People", rows: all.flatMap(one => [{ text: one.text, detail: "", buttons: [] }, { ...one, text: "" }]) }]);
                return [of(row("Eve", 1), row("Ben", 2)), of(row("Eve", 1)), of(row("Ben", 3), row("Ben", 4)), of(row("Ben", 1), row("Ben", 2))];
            })""")
        self.assertEqual(found, [2, None, None, 1])
        self.leave(page)

    def test_a_long_name_moves_nothing_off_the_screen(self):
        with Process("join", self.link, "--no-window", "--name", "W" * 64, "--every", "0.5", "--json") as other:
            other.read_json()
            page = self.browser.open(self.link, (360, 640))
            page.wait_for("document.getElementById('session_lines')?.innerText.includes('WWWW')")
            self.assertLessEqual(page.evaluate("document.getElementById('lobby').scrollWidth"), 360)
            page = self.enter(size=(1280, 720))
            page.wait_for("theatron.state.people.some(p => p.name.startsWith('WW'))")
            page.wait_for(f"!!document.querySelector('{MUTE}')")
            side = page.evaluate("document.getElementById('side').getBoundingClientRect().right")
            rights = page.evaluate("[...document.querySelectorAll('#room_panels button')].map(b => b.getBoundingClientRect().right)")
            self.assertLessEqual(max(rights), side)
            self.leave(page)

    def test_the_2d_view_has_the_keys_of_the_voice_and_no_buttons_of_the_room(self):
        page = self.enter("flat")
        page.wait_for("theatron.state.has_picture")
        self.assertFalse(page.evaluate("[...document.querySelectorAll('#tools [data-key]')].some(b => b.checkVisibility())"))
        page.evaluate("document.getElementById('show_picture').focus(); document.getElementById('flat').focus()")
        page.press("F7", "F7", 118)
        page.wait_for("document.getElementById('push_to_talk').getAttribute('aria-pressed') === 'true'")
        page.press("h", "KeyH", 72, "h")
        page.wait_for("document.getElementById('help').open")
        page.evaluate("document.getElementById('help').close()")
        self.leave(page)

    def test_in_the_2d_view_an_operator_decides_on_people(self):
        with Process("join", self.link, "--no-window", "--name", "Ben", "--every", "0.5", "--json") as ben:
            page = self.enter("flat")
            page.wait_for(f"!!document.querySelector('{MUTE}')")
            self.assertFalse(page.evaluate("[...document.querySelectorAll('#room_panels button')].some(b => ['Go', 'See'].includes(b.textContent.split(' ')[0]))"))
            page.evaluate(f"document.querySelector('{MUTE}').click()")
            ben.wait_for(lambda f: f["muted"], 30)
            remove = "[...document.querySelectorAll('#room_panels button')].find(b => b.textContent.includes('{}'))"
            page.evaluate(remove.format("Remove") + ".click()")
            page.wait_for("!!" + remove.format("Really"))
            page.evaluate(remove.format("Really") + ".click()")
            ben.end()
            page.wait_for("document.getElementById('room_panels').textContent.includes('Ben') === false")
            self.leave(page)

    def test_a_phone_in_landscape_begins_with_the_room_and_has_its_buttons_whole(self):
        page = self.browser.open("about:blank", (640, 360))
        page.call("Emulation.setTouchEmulationEnabled", enabled=True)
        page.call("Emulation.setEmulatedMedia", features=[{"name": "pointer", "value": "coarse"}, {"name": "hover", "value": "none"}])
        page.call("Page.navigate", url=self.link)
        page.enter("Ada", way="room")
        page.wait_for("theatron.state.pictures > 0")
        self.assertTrue(page.evaluate("document.getElementById('side').classList.contains('folded')"))
        boxes = page.evaluate("""[...document.querySelectorAll('#touch button, #menu')].filter(b => b.checkVisibility()).map(b => {
            const { left, top, right, bottom } = b.getBoundingClientRect();
            return [left, top, right, bottom];
        })""")
        self.assertGreater(len(boxes), 8)
        for i, (left, top, right, bottom) in enumerate(boxes):
            self.assertTrue(0 <= left and 0 <= top and right <= 640 and bottom <= 360, boxes[i])
            for other in boxes[:i]:
                self.assertFalse(left < other[2] and other[0] < right and top < other[3] and other[1] < bottom, (boxes[i], other))
        page.evaluate("document.getElementById('menu').click()")
        page.wait_for("!document.getElementById('touch').checkVisibility()")
        self.leave(page)

    def test_a_name_of_blanks_is_no_name(self):
        page = self.browser.open(self.link, (640, 480))
        page.wait_for("document.getElementById('invitation')?.textContent && !document.getElementById('enter').disabled")
        page.evaluate("document.getElementById('name').value = '   '; document.getElementById('enter').click()")
        time.sleep(0.5)
        self.assertEqual(page.evaluate("theatron.state.phase"), "left")
        self.assertFalse(page.evaluate("document.getElementById('lobby').hidden || document.getElementById('enter').disabled"))

    def test_a_host_that_is_away_is_told_in_the_form_and_escape_leaves_from_any_button(self):
        with tempfile.TemporaryDirectory() as folder, host(pathlib.Path(folder) / "host", CAMERA) as other:
            link = other.greeting["links"]["operator"]
            form = self.browser.open(link, (640, 480))
            form.wait_for("document.getElementById('session_lines')?.innerText.includes('live')")
            page = self.browser.open(link, (640, 480))
            page.enter("Ada", way="room")
            page.wait_for("theatron.state.phase === 'joined'")
            other.process.kill()
            form.wait_for("document.getElementById('session_lines').innerText.includes('does not answer')")
            self.assertFalse(form.evaluate("document.getElementById('session_lines').innerText.includes('live')"))
            page.wait_for("!['joined', 'left'].includes(theatron.state.phase)")
            page.evaluate("document.getElementById('show_picture').focus()")
            page.press("Escape", "Escape", 27)
            page.wait_for("theatron.state.phase === 'left'")


if __name__ == "__main__":
    unittest.main()
