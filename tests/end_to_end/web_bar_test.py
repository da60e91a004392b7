# SPDX-License-Identifier: Apache-2.0
"""The page's bar of buttons, its panels, its dot and its form: in sight and reached, on large, low and narrow pages."""
import os
import pathlib
import unittest

from page_case import PageCase

PICTURES = os.environ.get("THEATRON_PICTURES")  # a folder where pictures of the page stay
CAMERA = "synthetic:seconds=2,fps=5,quality=quick,loop=1"
SIZES = ((1280, 720), (1366, 650), (390, 844))
BAR = ["microphone", "webcam", "point", "draw", "show_case", "show_people", "leave", "show_more"]
SHOWN = "[...document.querySelectorAll('#tools button')].filter(b => b.checkVisibility())"
# Buttons of the page whose middle is beside the page or belongs to another element, while all that is said beside the
# picture is said at once, and catches what is below it.
COVERED = """(() => {
    const said = [...document.querySelectorAll(".strip, .chip, #message")];
    const before = said.map(e => [e.textContent, e.hidden]);
    for (const e of said) {
        e.textContent = "This computer draws too slowly; the connection is not the cause. ".repeat(2);
        e.hidden = false;
    }
    const all = document.querySelectorAll("#notices, #notices *, #message");
    for (const e of all)
        e.style.pointerEvents = "auto";
    const covered = [...document.querySelectorAll("#bar button, #touch button, #close_sheet")].filter(button => {
        if (!button.checkVisibility())
            return false;
        const box = button.getBoundingClientRect();
        return document.elementFromPoint(box.x + box.width / 2, box.y + box.height / 2)?.closest("button") !== button;
    }).map(button => button.id || button.textContent);
    for (const e of all)
        e.style.pointerEvents = "";
    said.forEach((e, i) => [e.textContent, e.hidden] = before[i]);
    return covered;
})()"""
BOX = "(({ left, top, right, bottom }) => [left, top, right, bottom])(document.querySelector('%s').getBoundingClientRect())"
IMPORT = "import(performance.getEntriesByType('resource').find(({ name }) => name.includes('/%s.')).name)"


class WebBar(PageCase):
    cameras = (CAMERA,)

    def form(self, size=SIZES[0], role="operator", touch=False, link=None):
        page = self.browser.open("about:blank", size)
        if touch:
            page.call("Emulation.setTouchEmulationEnabled", enabled=True, maxTouchPoints=2)
        page.call("Page.navigate", url=link or self.links[role])
        page.wait_for("document.readyState === 'complete' && !!document.getElementById('invitation')?.textContent")
        return page

    def enter(self, size=SIZES[0], role="operator", touch=False):
        page = self.form(size, role, touch)
        page.enter("Ada", way="room")
        page.wait_for("theatron.state.phase === 'joined' && theatron.state.has_picture")
        return page

    def leave(self, page):
        super().leave(page)
        page.close()

    def picture(self, page, name):
        if PICTURES:
            page.screenshot(pathlib.Path(PICTURES) / f"{name}.png")

    def assert_inside(self, page, selector, size):
        left, top, right, bottom = page.evaluate(BOX % selector)
        self.assertTrue(0 <= left < right <= size[0] and 0 <= top < bottom <= size[1], (selector, left, top, right, bottom))

    def test_the_bar_has_its_order_names_and_a_size_for_fingers(self):
        for size in SIZES:
            with self.subTest(size=size):
                page = self.enter(size, touch=size[0] < 600)
                page.wait_for(f"{SHOWN}.map(b => b.id).join() === '{','.join(BAR)}'")
                self.assert_inside(page, "#bar", size)
                for name, title, width, height in page.evaluate(
                        f"{SHOWN}.map(b => [b.ariaLabel, b.title, b.offsetWidth, b.offsetHeight])"):
                    self.assertTrue(name and name == title)
                    self.assertGreaterEqual(min(width, height), 44, name)
                self.assertEqual(page.evaluate(f"{SHOWN}.filter(b => !b.querySelector('svg') || !b.innerText.trim()).length"), 0)
                self.picture(page, f"bar_{size[0]}")
                self.leave(page)

    def test_each_panel_is_whole_after_one_click_at_one_place_and_alone(self):
        for size in SIZES:
            page = self.enter(size)
            places = set()
            for button in ("show_people", "show_case", "show_more", "dot"):
                with self.subTest(size=size, button=button):
                    page.click("#" + button)
                    page.wait_for("document.getElementById('sheet').checkVisibility()")
                    self.assert_inside(page, "#sheet", size)
                    places.add(tuple(page.evaluate(BOX % "#sheet")))
                    self.assertEqual(page.evaluate("document.querySelectorAll('#sheet_content > [data-of]:not([hidden])').length"),
                                     int(button in ("show_more", "dot")))
                    self.assertEqual(page.evaluate(f"document.getElementById('{button}').ariaExpanded"), "true")
                    self.assertEqual(page.evaluate(COVERED), [])
                    self.picture(page, f"panel_{size[0]}_{button}")
            self.assertEqual(len(places), 1, "a panel jumps")
            page.click("#draw")
            page.wait_for("document.getElementById('sheet').dataset.shows === 'draw' && document.getElementById('draw').ariaPressed === 'true'")
            self.assert_inside(page, "#sheet", size)
            page.click("#draw")
            page.wait_for("document.getElementById('sheet').hidden && document.getElementById('draw').ariaPressed === 'false'")
            self.assertEqual(page.problems, [])
            self.leave(page)

    def test_keys_open_and_close_panels_and_the_focus_comes_back(self):
        page = self.enter()
        for key, name in (("p", "people"), ("o", "case"), ("b", "details")):
            for shows in (name, ""):
                page.press(key, f"Key{key.upper()}")
                page.wait_for(f"theatron.sheet.name === '{shows}' && document.getElementById('sheet').hidden === {str(not shows).lower()}")
        page.evaluate("document.getElementById('show_people').focus()")
        page.press("Enter", "Enter", 13, "\r")
        page.wait_for("document.activeElement.id === 'sheet_title'")
        page.press("Escape", "Escape", 27)
        page.wait_for("document.getElementById('sheet').hidden && document.activeElement.id === 'show_people'")
        self.assertEqual(page.evaluate("theatron.state.phase"), "joined")
        self.leave(page)

    def test_on_an_azerty_keyboard_w_opens_the_tools_for_drawing_and_z_which_walks_does_not(self):
        page = self.enter()
        page.evaluate("document.getElementById('view').focus()")
        draws = "document.getElementById('draw').ariaPressed === '{}'"
        page.press("w", "KeyZ")
        page.wait_for(draws.format("true"))
        page.press("w", "KeyZ")
        page.wait_for(draws.format("false"))
        page.press("z", "KeyW")
        page.press("w", "KeyZ")
        page.wait_for(draws.format("true"))
        self.leave(page)

    def test_nothing_that_is_said_covers_a_control(self):
        for size in (*SIZES, (640, 360)):
            with self.subTest(size=size):
                page = self.enter(size, touch=size[0] < 700)
                if size[0] < 700:
                    page.wait_for("document.getElementById('touch').checkVisibility()")
                self.assertEqual(page.evaluate(COVERED), [])
                self.leave(page)

    def test_the_dot_tells_the_age_and_the_rest_is_in_its_details(self):
        page = self.enter()
        words = "document.querySelector('#dot span').textContent"
        page.wait_for(f"/^\\d+(\\.\\d)? s$/.test({words})")
        self.assertIn(page.evaluate("document.getElementById('dot').dataset.level"), ("good", "slow", "bad"))
        self.assertEqual(page.evaluate("[...document.querySelectorAll('#dot svg > *')].filter(e => getComputedStyle(e).display !== 'none').length"), 1)
        self.assertNotRegex(page.evaluate("document.getElementById('panels').innerText"), "(?i)codec|strata|jpeg|mbit|fps|lost|dropped")
        page.click("#dot")
        page.wait_for("document.getElementById('facts').innerText.includes('Left out')")
        self.assertIn("Mbit/s", page.evaluate("document.getElementById('details').innerText"))
        judged = page.evaluate(IMPORT % "dot" + """.then(({ judge }) => {
            const state = { phase: "joined", has_picture: true, age_ms: 80, is_not_live: false, is_slow: false, overlay: { warning: "" } };
            return [[{}, 0], [{ age_ms: 700 }, 0], [{}, 2], [{ is_slow: true, overlay: { warning: "slow" } }, 0], [{ overlay: { warning: "old" } }, 0],
                    [{ age_ms: 3000 }, 0], [{ is_not_live: true }, 0], [{ phase: "lost" }, 0], [{ has_picture: false }, 0]]
                .map(([change, unrest]) => { const { level, words } = judge({ ...state, ...change }, unrest); return `${level} ${words}`; });
        })""")
        self.assertEqual(judged, ["good 0.1 s", "slow 0.7 s", "slow 0.1 s", "slow 0.1 s", "bad 0.1 s", "bad 3.0 s", "bad Not live",
                                  "bad No connection", "slow No picture yet"])
        self.leave(page)

    def test_a_warning_is_shown_once_and_restless_cameras_are_one_sign(self):
        page = self.form()
        said = page.evaluate(IMPORT % "notices" + """.then(({ Notices }) => {
            const notices = new Notices();
            const at = (s, warning, notice = "", of_camera = false, once = "") => {
                const { shown, unrest } = notices.at(1000 * s, { warning, notice, of_camera, once: [once] });
                return [...shown, unrest];
            };
            return [at(0, "It is 3 s old"), at(7, "It is 9 s old"), at(9, "It is 11 s old"), at(10, ""), at(20, "It is 2 s old"), at(100, "It is 2 s old"),
                    at(200, "", "A stands", true), at(203, "", "A is live", true), at(204, "", "View of A"), at(205, "", "A stands", true), at(300, "", ""),
                    at(301, "", "", false, "Camera 1"), at(302, "", "", false, "Camera 2"), at(315, "", "", false, "Camera 2")];
        })""")
        self.assertEqual(said, [["It is 3 s old", 0], ["It is 9 s old", 0], [0], [0], [0], ["It is 2 s old", 0],
                                ["A stands", 0], [2], ["View of A", 2], [3], [0], ["Camera 1", 0], ["Camera 2", 0], [0]])

    def test_the_form_enters_without_scrolling_and_offers_an_observer_no_voice(self):
        for size in SIZES:
            for role in ("operator", "observer"):
                with self.subTest(size=size, role=role):
                    page = self.form(size, role)
                    page.wait_for("document.getElementById('session_lines').children.length > 0")
                    page.wait_for("!document.getElementById('session_picture').hidden")
                    self.assert_inside(page, "#enter", size)
                    self.assertEqual(page.evaluate("document.elementFromPoint(%f, %f).id" % tuple(page.middle("#enter"))), "enter")
                    self.assertFalse(page.evaluate("document.getElementById('remember').checkVisibility()"))
                    page.evaluate("for (const d of document.querySelectorAll('details')) d.open = true")
                    self.assertEqual(page.evaluate("[...document.querySelectorAll('.of_voice')].some(e => e.checkVisibility())"), role != "observer")
                    self.picture(page, f"form_{size[0]}_{role}")
                    page.close()

    def test_an_observer_has_no_button_of_what_an_observer_may_not(self):
        page = self.enter(role="observer")
        page.wait_for(f"{SHOWN}.map(b => b.id).join() === 'show_case,show_people,leave,show_more'")
        self.leave(page)

    def test_a_wrong_link_has_a_sentence_and_a_field_for_the_right_one(self):
        token = self.links["expert"].split("join=")[1].split("&")[0]
        for link in (self.link.split("#")[0], self.links["expert"].replace(token, token[::-1])):
            with self.subTest(link=link.split("#")[0]):
                page = self.form(SIZES[2], link=link)
                page.wait_for("document.getElementById('right_link').checkVisibility()")
                self.assertRegex(page.evaluate("document.getElementById('lobby').innerText"), "no invitation in it|does not know this invitation")
                self.assertFalse(page.evaluate("document.getElementById('name').checkVisibility()"))
                fill = "document.getElementById('link_text').value = '%s'; document.querySelector('#right_link button').click()"
                page.evaluate(fill % "https://example.org/")
                self.assertIn("no link of an invitation", page.evaluate("document.getElementById('link_problem').textContent"))
                page.evaluate(fill % self.links["expert"])
                page.wait_for("document.getElementById('session_lines')?.innerText.includes('The session is open')")
                self.assertTrue(page.evaluate("document.getElementById('name').checkVisibility()"))
                page.close()

    def test_the_help_opens_at_its_top_and_is_opaque(self):
        page = self.enter((640, 360))
        page.press("h", "KeyH")
        page.wait_for("document.getElementById('help').open")
        self.assert_inside(page, "#help_title", (640, 360))
        self.assertEqual(page.evaluate("document.getElementById('help_text').scrollTop"), 0)
        self.assertGreater(page.evaluate("document.getElementById('help_text').scrollHeight"), 360)
        self.assertRegex(page.evaluate("getComputedStyle(document.getElementById('help')).backgroundColor"), r"^rgb\(")
        page.evaluate("document.getElementById('help').close()")
        self.leave(page)


if __name__ == "__main__":
    unittest.main()
