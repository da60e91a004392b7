# SPDX-License-Identifier: Apache-2.0
"""The browser client in a real browser: by the host's link into the room, with a native participant there."""
import gzip
import http.client
import json
import os
import pathlib
import signal
import socket
import ssl
import unittest

from page_case import PAGE, PageCase
from theatron_process import Process, host, read_png

PICTURES = os.environ.get("THEATRON_PICTURES")  # a folder where pictures of the page stay
CAMERAS = tuple(f"synthetic:seconds=2,fps=10,quality=quick,camera={i},loop=1" for i in (0, 1))
SIZE = (960, 540)

# The highest name that Emscripten gave an object of WebGL.
NOTE_NAMES = """globalThis.highest_name = 0;
for (const bind of ["bindBuffer", "bindTexture", "bindFramebuffer"]) {
    const before = WebGL2RenderingContext.prototype[bind];
    WebGL2RenderingContext.prototype[bind] = function (target, object) {
        highest_name = Math.max(highest_name, object?.name ?? 0);
        return before.call(this, target, object);
    };
}"""


def get(link, path, headers=None, body=True):
    """The answer to a request, and its content if it has to be read."""
    address = link.split("/")[2]
    connection = http.client.HTTPSConnection(address, context=ssl._create_unverified_context())
    connection.request("GET", path, headers=headers or {})
    answer = connection.getresponse()
    content = answer.read() if body else b""
    connection.close()
    return answer, content


class Web(PageCase):
    cameras = CAMERAS

    def picture(self, page, name):
        file = pathlib.Path(PICTURES or self.folder) / f"{name}.png"
        page.screenshot(file)
        return read_png(file)

    def enter(self, link, name):
        page = self.browser.open(link, SIZE)
        page.enter(name)
        return page

    def test_the_page_has_strict_headers_and_is_compressed_and_kept_by_its_hash(self):
        answer, plain = get(self.link, "/")
        self.assertEqual(answer.status, 200)
        self.assertEqual(answer.headers["Cache-Control"], "no-cache")
        names = [line.split()[0] for line in PAGE.read_text().splitlines()]
        script = next(name for name in names if name.startswith("/page.") and name.endswith(".js"))
        self.assertIn(f'"{script[1:]}"', plain.decode())
        for name in ("/", script):
            answer, packed = get(self.link, name, {"Accept-Encoding": "gzip"})
            self.assertEqual(answer.headers["Content-Encoding"], "gzip")
            self.assertEqual(gzip.decompress(packed), get(self.link, name)[1])
            self.assertIn("default-src 'none'", answer.headers["Content-Security-Policy"])
            self.assertEqual(answer.headers["X-Content-Type-Options"], "nosniff")
            self.assertEqual(answer.headers["Cross-Origin-Embedder-Policy"], "require-corp")
        self.assertIn("immutable", answer.headers["Cache-Control"])
        for path in ("/files.txt", "/..%2f", "/page.js"):
            self.assertEqual(get(self.link, path)[0].status, 404, path)

    def test_a_page_of_another_origin_cannot_connect(self):
        upgrade = {"Connection": "Upgrade", "Upgrade": "websocket", "Sec-WebSocket-Version": "13",
                   "Sec-WebSocket-Key": "AAAAAAAAAAAAAAAAAAAAAA=="}
        own = "https://" + self.link.split("/")[2]
        for origin, status in ((own, 101), ("https://elsewhere.example", 403), ("null", 403)):
            answer = get(self.link, "/connection", upgrade | {"Origin": origin}, body=False)[0]
            self.assertEqual(answer.status, status)
            self.assertNotIn("Boost", answer.headers.get("Server", ""))

    def test_by_the_link_into_the_room_to_a_native_participant(self):
        with Process("join", self.link, "--name", "Ben", "--every", "0.2") as ben:
            ben.wait_for(lambda f: f["fps"] > 0)
            page = self.enter(self.link, "Ada")
            page.wait_for("theatron.complete_ms !== null")
            state = page.wait_for("theatron.state.people.length === 2 && theatron.state.pictures > 3 && theatron.state")
            self.assertEqual({person["name"]: person["self"] for person in state["people"]},
                             {"Ada": True, "Ben": False})
            page.wait_for("theatron.state.cameras.map(c => c.state).join() === 'live,live'")
            self.assertGreater(state["decoders"], 0)
            width, height, channels, rows = self.picture(page, "room")
            # Right of the panels there are the cameras' surfaces, not one background.
            colors = {bytes(rows[y][channels * x:channels * x + 3])
                      for y in range(40, height - 60, 5) for x in range(width // 2, width, 5)}
            self.assertGreater(len(colors), 300)

            # A brick before the eye, seen and then dragged.
            # Behind a click on a button the keys still act in the room.
            page.open_sheet("more")
            x, y = page.evaluate("(b => [b.x + b.width / 2, b.y + b.height / 2])"
                                 "(document.querySelector('[data-key=r]').getBoundingClientRect())")
            page.mouse("mousePressed", x, y)
            page.mouse("mouseReleased", x, y)
            page.open_sheet("")
            page.press("n", "KeyN")
            bricks = lambda f: [o for o in f["room"]["objects"] if o["kind"] == "brick"]
            before = bricks(ben.wait_for(bricks))[0]["position"]
            middle = (SIZE[0] / 2, SIZE[1] * 0.57)  # the camera's axis is not quite in the middle
            drawn = page.wait_for("theatron.state.bricks === 1 && theatron.state.pictures")
            page.wait_for(f"theatron.state.pictures > {drawn + 1}")
            page.mouse("mouseMoved", *middle, "none")
            page.mouse("mousePressed", *middle)
            held = ben.wait_for(lambda f: bricks(f)[0]["held_by"] != 0)
            ada = next(person["id"] for person in held["room"]["people"] if person["name"] == "Ada")
            self.assertEqual(bricks(held)[0]["held_by"], ada)
            for step in range(1, 6):
                page.mouse("mouseMoved", middle[0] + 30 * step, middle[1])
            self.picture(page, "brick")
            page.mouse("mouseReleased", middle[0] + 150, middle[1])
            after = bricks(ben.wait_for(lambda f: bricks(f)[0]["held_by"] == 0))[0]["position"]
            self.assertGreater(sum((a - b) ** 2 for a, b in zip(after, before)) ** 0.5, 0.1)

            token = self.link.split("join=")[1].split("&")[0]
            own = "https://" + self.link.split("/")[2] + "/"
            self.assertEqual([url for url in page.requests if token in url.split("#")[0] or not url.startswith(own)], [])
            self.assertEqual(page.problems, [])
            self.assertLess(page.bytes, 1_000_000)
            page.evaluate("document.getElementById('leave').click()")
            ben.wait_for(lambda f: [person["name"] for person in f["room"]["people"]] == ["Ben"])

    def test_visits_use_the_names_of_gl_again(self):
        page = self.browser.open("about:blank", (320, 180))
        page.call("Page.addScriptToEvaluateOnNewDocument", source=NOTE_NAMES)
        page.call("Page.navigate", url=self.link)
        highest = []
        for visit in range(4):
            page.enter(way="room")
            page.wait_for("theatron.state.phase === 'joined' && theatron.state.has_picture && theatron.state.pictures > 3")
            highest.append(page.evaluate("highest_name"))
            self.leave(page)
        # Places in tables of Emscripten, which never become shorter.
        self.assertLessEqual(highest[-1], highest[0] + 50, highest)
        self.assertEqual(page.problems, [])

    def test_a_page_without_workers_decodes_by_itself_and_says_so(self):
        page = self.enter(self.link + "&decoding=page", "Ada")
        page.wait_for("theatron.complete_ms !== null")
        self.assertEqual(page.evaluate("theatron.state.decoders"), 0)
        self.assertIn("Decoding: in the page", page.evaluate("document.getElementById('facts').textContent"))
        self.leave(page)

    def test_after_a_fault_of_a_worker_one_enters_again_and_the_page_decodes(self):
        page = self.enter(self.link, "Ada")
        page.wait_for("theatron.complete_ms !== null")
        page.evaluate("theatron.workers[0].dispatchEvent(new ErrorEvent('error'))")
        page.wait_for("theatron.state.phase === 'left'")
        self.assertIn("Decoding ended", page.evaluate("document.getElementById('problem').textContent"))
        page.evaluate("document.getElementById('enter').click()")
        page.wait_for("theatron.state.phase === 'joined' && theatron.state.cameras.every(c => c.depth_frames > 0)")
        self.assertEqual(page.evaluate("theatron.state.decoders"), 0)
        self.leave(page)

    # The names of the bar's buttons that are shown, and the elements that reach beyond a narrow page's sides.
    BAR = "[...document.querySelectorAll('#tools button')].filter(b => b.checkVisibility()).map(b => b.innerText)"
    BESIDE = """[...document.querySelectorAll('button, p, li, h2')].filter(e => e.checkVisibility() && e.textContent !== '' &&
        (e.getBoundingClientRect().left < 0 || e.getBoundingClientRect().right > innerWidth + 0.5)).map(e => e.textContent)"""

    def in_language(self, link, wanted):
        """The form of an invitation in a browser that wants this language first."""
        page = self.browser.open(link, SIZE)
        page.call("Emulation.setUserAgentOverride", userAgent="test", acceptLanguage=wanted)
        # A strict browser keeps nothing for the site.
        page.call("Page.addScriptToEvaluateOnNewDocument", source="Object.defineProperty(window, 'localStorage', "
                  "{ get() { throw new DOMException('no', 'SecurityError'); } })")
        page.reload()
        page.wait_for(f"document.documentElement?.lang === '{wanted[:2]}' && !!document.getElementById('invitation')?.textContent")
        return page

    def test_a_browser_shows_its_language_also_in_the_panels(self):
        languages = {"de-DE": ("Niemand sonst ist hier", ("Gastgeber", "Kameras", "Daten"), "Der Zugangscode dieses Links ist falsch"),
                     "fr-CA": ("Personne d'autre n'est là", ("Hôte", "Caméras", "Données"), "Le code d'accès de ce lien est faux")}
        for wanted, (nobody, facts_words, wrong) in languages.items():
            with self.subTest(wanted):
                page = self.in_language(self.link.replace("role=expert", "role=nobody+you+know"), wanted)
                self.assertNotIn("nobody", page.evaluate("document.getElementById('invitation').textContent"))
                page.enter()
                page.wait_for("theatron.state.phase === 'joined' && theatron.state.people.length > 0")
                page.open_sheet("people")
                page.wait_for(f"document.getElementById('room_panels').innerText.includes({json.dumps(nobody)})")
                facts = page.wait_for("document.getElementById('facts').textContent")
                for word in facts_words:
                    self.assertIn(word, facts)
                # Keys of the client and its sentences, which come from the program.
                self.assertEqual(page.evaluate("""[...document.querySelectorAll('#room_panels button')].map(b => b.textContent)
                    .filter(label => /^(Go|Call|Make|Show|Hide|Remove)/.test(label))"""), [])
                names = page.evaluate(self.BAR)
                self.assertGreater(len(names), 3)
                self.assertEqual(len(set(names)), len(names), names)
                page.call("Emulation.setDeviceMetricsOverride", width=390, height=844, deviceScaleFactor=1, mobile=False)
                self.assertEqual(page.evaluate(self.BESIDE), [])
                page.evaluate("document.getElementById('leave').click()")
                page.wait_for("theatron.state.phase === 'left'")
                # A reason that the host gives as a code.
                page = self.in_language(self.link.replace("join=", "join=wrong"), wanted)
                page.enter()
                page.wait_for(f"document.getElementById('problem').textContent.startsWith({json.dumps(wrong)})")

    def test_a_link_without_a_token_or_with_a_wrong_one_is_explained(self):
        page = self.browser.open(self.link.split("#")[0], SIZE)
        page.wait_for("!!document.getElementById('invitation')?.textContent")
        self.assertTrue(page.evaluate("document.getElementById('enter').disabled"))
        self.assertIn("no invitation", page.evaluate("document.getElementById('invitation').textContent"))
        page = self.enter(self.link.replace("join=", "join=wrong"), "Eve")
        page.wait_for("theatron.state.phase === 'left' && document.getElementById('problem').textContent")
        self.picture(page, "refused")

    def test_after_a_restart_of_the_host_the_page_is_in_the_room_again(self):
        with socket.socket() as probe:
            probe.bind(("127.0.0.1", 0))
            listen = f"127.0.0.1:{probe.getsockname()[1]}"
        with host(self.folder / "other", CAMERAS[0], listen=listen) as first:
            page = self.enter(first.greeting["link"], "Ada")
            page.wait_for("theatron.state.phase === 'joined' && theatron.state.cameras.length === 1")
            first.send(signal.SIGKILL)
            first.end()
            page.wait_for("theatron.state.phase === 'lost'")
            # Nothing that the page shows calls a camera live.
            page.wait_for("document.getElementById('camera_list').textContent.includes('no connection')")
            with host(self.folder / "other", listen=listen):
                page.wait_for("theatron.state.phase === 'joined' && theatron.state.joins === 2")


if __name__ == "__main__":
    unittest.main()
