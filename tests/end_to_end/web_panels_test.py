# SPDX-License-Identifier: Apache-2.0
"""Panels and form of the page for slow hands, the keyboard alone, long names, small screens and a host that is away."""
import pathlib
import tempfile
import time
import unittest

from page_case import PageCase
from theatron_process import Process, host

CAMERA = "synthetic:seconds=2,fps=10,quality=quick,loop=1"
FOCUSED = "document.activeElement?.dataset?.label ?? document.activeElement?.id"
AGES = "document.getElementById('camera_list').textContent"
MUTE = "#room_panels [data-label$=\"/Mute\"]"


class WebPanels(PageCase):
    cameras = (CAMERA,)

    def enter(self, way="room", size=(640, 480), role="operator"):
        page = self.browser.open(self.links[role], size)
        page.enter("Ada", way=way)
        page.wait_for("theatron.state.phase === 'joined'")
        return page

    def test_a_slow_click_acts_while_ages_change_and_the_keyboard_keeps_its_button(self):
        with Process("join", self.links["operator"], "--no-window", "--name", "Ben", "--every", "0.5", "--json") as ben:
            page = self.enter()
            page.wait_for("theatron.state.people.some(p => p.name === 'Ben') && theatron.state.cameras[0]?.frames > 3")
            page.open_sheet("people")
            page.wait_for(f"!!document.querySelector('{MUTE}')")
            page.evaluate(f"document.querySelector('{MUTE}').scrollIntoView()")
            self.assertIn("Mute: Ben", page.evaluate(f"document.querySelector('{MUTE}').ariaLabel"))
            at = page.middle(MUTE)
            page.mouse("mousePressed", *at)
            ages = page.evaluate(AGES)
            time.sleep(0.8)
            page.mouse("mouseReleased", *at)
            ben.wait_for(lambda f: f["muted"])
            page.wait_for(f"!document.querySelector('{MUTE}') && document.querySelector('#room_panels').textContent.includes('Unmute')")
            # The ages go on.
            self.assertIn(" s old", ages)
            page.wait_for(f"{AGES} !== {ages!r}")
            # By the keyboard: its label changes under the focus.
            page.evaluate("[...document.querySelectorAll('#room_panels button')].find(b => b.textContent === 'Unmute').focus()")
            page.press("Enter", "Enter", 13, "\r")
            ben.wait_for(lambda f: not f["muted"])
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
        with Process("join", self.links["operator"], "--no-window", "--name", "W" * 64, "--every", "0.5", "--json") as other:
            other.read_json()
            page = self.browser.open(self.links["operator"], (360, 640))
            page.wait_for("document.getElementById('session_lines')?.innerText.includes('WWWW')")
            self.assertLessEqual(page.evaluate("document.getElementById('lobby').scrollWidth"), 360)
            page = self.enter(size=(1280, 720))
            page.wait_for("theatron.state.people.some(p => p.name.startsWith('WW'))")
            page.open_sheet("people")
            page.wait_for(f"!!document.querySelector('{MUTE}')")
            side = page.evaluate("document.getElementById('sheet').getBoundingClientRect().right")
            rights = page.evaluate("[...document.querySelectorAll('#room_panels button')].map(b => b.getBoundingClientRect().right)")
            self.assertLessEqual(max(rights), side)
            self.leave(page)

    def test_the_2d_view_has_the_keys_of_the_voice_and_no_buttons_of_the_room(self):
        page = self.enter("flat")
        page.wait_for("theatron.state.has_picture")
        self.assertFalse(page.evaluate("['webcam', 'show_case'].some(id => document.getElementById(id).checkVisibility())"))
        self.assertTrue(page.evaluate("['point', 'draw', 'next_camera'].every(id => document.getElementById(id).checkVisibility())"))
        page.evaluate("document.getElementById('show_people').focus(); document.getElementById('flat').focus()")
        page.press("F7", "F7", 118)
        page.wait_for("document.getElementById('push_to_talk').getAttribute('aria-pressed') === 'true'")
        page.press("h", "KeyH", 72, "h")
        page.wait_for("document.getElementById('help').open")
        page.evaluate("document.getElementById('help').close()")
        self.leave(page)

    def test_a_picture_that_does_not_come_leaves_the_lines_of_the_form(self):
        page = self.browser.open("about:blank", (640, 480))
        page.call("Page.addScriptToEvaluateOnNewDocument", source="""(fetched => globalThis.fetch = (path, ...rest) =>
            String(path).startsWith("/thumbnail") ? (globalThis.refused = (globalThis.refused ?? 0) + 1, Promise.reject(new TypeError("no")))
                                                  : fetched(path, ...rest))(fetch)""")
        page.call("Page.navigate", url=self.links["operator"])
        page.wait_for("globalThis.refused > 1")
        page.wait_for("document.getElementById('session_lines').innerText.includes('live')")

    def test_in_the_2d_view_an_operator_decides_on_people(self):
        with Process("join", self.links["operator"], "--no-window", "--name", "Ben", "--every", "0.5", "--json") as ben:
            page = self.enter("flat")
            page.open_sheet("people")
            page.wait_for(f"!!document.querySelector('{MUTE}')")
            self.assertFalse(page.evaluate("[...document.querySelectorAll('#room_panels button')].some(b => ['Go', 'See'].includes(b.textContent.split(' ')[0]))"))
            page.evaluate(f"document.querySelector('{MUTE}').click()")
            ben.wait_for(lambda f: f["muted"])
            remove = "[...document.querySelectorAll('#room_panels button')].find(b => b.textContent.includes('{}'))"
            page.evaluate(remove.format("Remove") + ".click()")
            page.wait_for("!!" + remove.format("Really"))
            page.evaluate(remove.format("Really") + ".click()")
            ben.end()
            page.wait_for("document.getElementById('room_panels').textContent.includes('Ben') === false")
            self.leave(page)

    def test_in_the_2d_view_an_operator_lets_in(self):
        with tempfile.TemporaryDirectory() as folder, host(pathlib.Path(folder) / "host", CAMERA, options=("--admit", "ask")) as other:
            links = other.greeting["links"]
            page = self.browser.open(links["operator"], (640, 480))
            page.enter("Ada", way="flat")
            page.wait_for("theatron.state.phase === 'joined'")
            with Process("join", links["expert"], "--no-window", "--name", "Größe", "--every", "0.5", "--json") as guest:
                page.wait_for("document.getElementById('door').checkVisibility()")
                self.assertIn("Größe", page.evaluate("document.getElementById('door').textContent"))
                page.evaluate("document.getElementById('door').click()")
                let_in = "[...document.querySelectorAll('#room_panels button')].find(b => b.dataset.label.endsWith('Größe/Let in'))"
                page.wait_for("!!" + let_in)
                page.evaluate(let_in + ".click()")
                guest.wait_for(lambda f: f["phase"] == "joined")

    def test_observers_have_no_buttons_that_their_role_forbids(self):
        page = self.enter(role="observer")
        page.open_sheet("more")
        shown = "[...document.querySelectorAll('#tools button, #more [data-key]')].filter(b => b.offsetParent).map(b => b.id || b.dataset.key).join(' ')"
        page.wait_for(f"{shown} === 'show_case show_people leave show_more r'")
        name = page.evaluate("theatron.state.people.find(person => person.self).name")
        self.host.say(f"role {name} expert")
        page.wait_for(f"{shown} === 'microphone webcam point draw show_case show_people leave show_more r n'")
        self.leave(page)

    def test_a_phone_in_landscape_begins_with_the_room_and_has_its_buttons_whole(self):
        page = self.browser.open("about:blank", (640, 360))
        page.call("Emulation.setTouchEmulationEnabled", enabled=True)
        page.call("Emulation.setEmulatedMedia", features=[{"name": "pointer", "value": "coarse"}, {"name": "hover", "value": "none"}])
        page.call("Page.navigate", url=self.links["operator"])
        page.enter("Ada", way="room")
        page.wait_for("theatron.state.pictures > 0")
        self.assertTrue(page.evaluate("document.getElementById('sheet').hidden"))
        boxes = page.evaluate("""[...document.querySelectorAll('#touch button, #bar button')].filter(b => b.checkVisibility()).map(b => {
            const { left, top, right, bottom } = b.getBoundingClientRect();
            return [left, top, right, bottom];
        })""")
        self.assertGreater(len(boxes), 8)
        for i, (left, top, right, bottom) in enumerate(boxes):
            self.assertTrue(0 <= left and 0 <= top and right <= 640 and bottom <= 360, boxes[i])
            for other in boxes[:i]:
                self.assertFalse(left < other[2] and other[0] < right and top < other[3] and other[1] < bottom, (boxes[i], other))
        page.evaluate("document.getElementById('show_more').click()")
        page.wait_for("!document.getElementById('touch').checkVisibility()")
        self.leave(page)

    def test_a_name_of_blanks_is_no_name(self):
        page = self.browser.open(self.links["operator"], (640, 480))
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
            page.evaluate("document.getElementById('show_people').focus()")
            page.press("Escape", "Escape", 27)
            page.wait_for("theatron.state.phase === 'left'")


if __name__ == "__main__":
    unittest.main()
