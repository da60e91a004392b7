# SPDX-License-Identifier: Apache-2.0
"""The page for people with a keyboard, a screen reader or weak eyes: names, focus, contrast (WCAG 2.2 AA)."""
import contextlib
import pathlib
import tempfile
import unittest

import theatron_process
from browser import CHROMIUM, Browser
from theatron_process import host

AXE = pathlib.Path(__file__).parent / "node_modules/axe-core/axe.min.js"
PAGE = pathlib.Path(theatron_process.PROGRAM).parent / "web/files.txt"
SIZE = (960, 540)
CONTROLS = {"button", "textbox", "checkbox", "link", "combobox", "slider", "application", "Canvas"}

# Texts with too little contrast. Where the room shines through, a black and a white one count.
CONTRAST = """(() => {
    const parse = color => color.match(/[\\d.]+/g).map(Number);
    const over = ([r, g, b, a = 1], below) => [r, g, b].map((v, i) => v * a + below[i] * (1 - a));
    const light = rgb => rgb.map(v => (v /= 255) <= 0.04045 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4)
        .reduce((sum, v, i) => sum + v * [0.2126, 0.7152, 0.0722][i], 0);
    const ratio = (a, b) => (Math.max(light(a), light(b)) + 0.05) / (Math.min(light(a), light(b)) + 0.05);
    const poor = [];
    const walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
    while (walker.nextNode()) {
        const element = walker.currentNode.parentElement, text = walker.currentNode.data.trim();
        if (!text || !element.checkVisibility({ checkVisibilityCSS: true }) || element.closest(":disabled"))
            continue;
        const layers = [];
        let is_opaque = false;
        for (let at = element; at && !is_opaque; at = at.id === "panels" ? null : at.parentElement) {
            const color = parse(getComputedStyle(at).backgroundColor);
            layers.unshift(color);
            is_opaque = (color[3] ?? 1) === 1;
        }
        const style = getComputedStyle(element), size = parseFloat(style.fontSize);
        const needed = size >= 24 || (size >= 18.66 && style.fontWeight >= 700) ? 3 : 4.5;
        const ratios = [0, 255].map(v => {
            const below = layers.reduce((rgb, layer) => over(layer, rgb), [v, v, v]);
            return ratio(over(parse(style.color), below), below);
        });
        if (Math.min(...ratios) < needed)
            poor.push(`${text.slice(0, 40)}: ${Math.min(...ratios).toFixed(2)}`);
    }
    return poor;
})()"""

REACHABLE = """[...document.querySelectorAll("button, input, select, summary, a[href], [tabindex]")].filter(e =>
    e.checkVisibility({ checkVisibilityCSS: true }) && !e.disabled && e.tabIndex >= 0)"""
NAME = """(e => e.id || e.dataset.key || e.dataset.label || e.textContent)"""
FOCUS = f"""(() => {{
    const e = document.activeElement, style = getComputedStyle(e);
    return {{ name: {NAME}(e), is_body: e === document.body,
              is_seen: style.outlineStyle !== "none" && parseFloat(style.outlineWidth) >= 2 }};
}})()"""


# The findings of axe-core but the smallest, each with its first element.
FINDINGS = """axe.run(document, { resultTypes: ["violations"] }).then(({ violations }) => violations
    .filter(({ impact }) => impact !== "minor")
    .map(({ id, help, nodes }) => `${id}: ${help}: ${nodes[0].html} ${nodes[0].failureSummary}`))"""


@unittest.skipUnless(CHROMIUM, "chromium is not installed: apt-get install chromium")
@unittest.skipUnless(PAGE.exists(), "there is no browser client: make build")
class WebAccess(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.stack = contextlib.ExitStack()
        folder = pathlib.Path(cls.stack.enter_context(tempfile.TemporaryDirectory()))
        cls.host = cls.stack.enter_context(host(folder / "host"))
        cls.page = cls.stack.enter_context(Browser()).open(cls.host.greeting["link"], SIZE)
        cls.page.wait_for("document.readyState === 'complete' && !!document.getElementById('invitation')?.textContent")
        cls.page.call("Accessibility.enable")

    @classmethod
    def tearDownClass(cls):
        cls.stack.close()

    def check(self):
        """Checks the rules that hold for everything that the page shows."""
        page = self.page
        self.assertIn(page.evaluate("document.documentElement.lang"), ("en", "de"))
        controls = [node for node in page.call("Accessibility.getFullAXTree")["nodes"]
                    if not node["ignored"] and node["role"]["value"] in CONTROLS]
        self.assertEqual([node for node in controls if not node.get("name", {}).get("value", "").strip()], [])
        self.assertTrue(controls)
        for scheme in ("light", "dark"):
            page.call("Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": scheme}])
            self.assertEqual(page.evaluate(CONTRAST), [], scheme)
            with self.subTest("axe-core"):
                if not AXE.exists():
                    self.skipTest("axe-core is not installed: npm ci --prefix tests/end_to_end")
                if page.evaluate("globalThis.axe === undefined"):
                    page.evaluate(AXE.read_text() + ";0")
                self.assertEqual(page.evaluate(FINDINGS), [], scheme)

    def tab_order(self, from_element):
        """Names of what the Tab key reaches from there until it leaves the page."""
        # A key first: a browser shows the focus that a script has set only to somebody who uses the keyboard.
        self.page.press("Tab", "Tab", 9)
        self.page.evaluate(f"document.querySelector('{from_element}').focus()")
        reached = []
        while not (focus := self.page.evaluate(FOCUS))["is_body"] and len(reached) < 60:
            if focus["name"] in reached:
                break
            self.assertTrue(focus["is_seen"], f"the focus is not seen on {focus['name']}")
            reached.append(focus["name"])
            self.page.press("Tab", "Tab", 9)
        return reached

    def test_lobby_room_and_help_are_named_legible_and_reached_by_keys(self):
        page = self.page
        self.check()
        page.wait_for("document.getElementById('session_lines').children.length > 0")
        page.evaluate("document.getElementById('choices').open = true")
        self.check()
        expected = page.evaluate(f"{REACHABLE}.map({NAME})")
        self.assertEqual(self.tab_order("#name"), expected[expected.index("name"):])

        # By itself the page goes over to the flat view where the computer draws too slowly.
        page.evaluate("document.getElementById('way').value = 'room'; document.getElementById('name').value = 'Ada'; "
                      "document.getElementById('name').focus()")
        page.press("Enter", "Enter", 13, "\r")
        page.wait_for("theatron.state.phase === 'joined'")
        self.assertEqual(page.evaluate("document.activeElement.id"), "view")
        self.check()
        self.assertEqual(self.tab_order("#view"), page.evaluate(f"{REACHABLE}.map({NAME})"))
        for name in ("people", "case", "more", "details", "picture"):
            page.open_sheet(name)
            if name == "picture":
                page.wait_for("document.getElementById('renderer_now').textContent !== ''")
            with self.subTest(panel=name):
                self.check()
                self.assertEqual(self.tab_order("#view"), page.evaluate(f"{REACHABLE}.map({NAME})"))
        page.open_sheet("")

        page.evaluate("document.getElementById('view').focus()")
        page.press("h", "KeyH")
        page.wait_for("document.getElementById('help').open")
        self.assertTrue(page.evaluate("document.getElementById('help').contains(document.activeElement)"))
        self.check()
        page.press("Escape", "Escape", 27)
        page.wait_for("!document.getElementById('help').open")
        self.assertEqual(page.evaluate("document.activeElement.id"), "view")

        # With a finger there are buttons, which keys and screen readers reach, too.
        page.call("Emulation.setTouchEmulationEnabled", enabled=True, maxTouchPoints=2)
        page.touch("touchStart", (SIZE[0] * 0.6, SIZE[1] * 0.3))
        page.touch("touchEnd")
        page.wait_for("document.getElementById('touch').checkVisibility()")
        self.check()
        self.assertEqual(self.tab_order("#view"), page.evaluate(f"{REACHABLE}.map({NAME})"))
        page.call("Emulation.setTouchEmulationEnabled", enabled=False)
        page.evaluate("document.getElementById('other_way').click()")
        page.wait_for("theatron.state.phase === 'joined' && !document.getElementById('flat').hidden")
        self.check()
        self.assertEqual(self.tab_order("#flat"), page.evaluate(f"{REACHABLE}.map({NAME})"))


if __name__ == "__main__":
    unittest.main()
