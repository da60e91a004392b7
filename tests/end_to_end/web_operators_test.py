# SPDX-License-Identifier: Apache-2.0
"""The operators' page (docs/operators_page.md) of a real host: cameras, people, links, sessions and a recording."""
import json
import os
import pathlib
import signal
import ssl
import unittest
import urllib.request

from page_case import PageCase
from theatron_process import Process, host, run, wait_until
from web_access_test import AXE, CONTRAST, FINDINGS

PICTURES = os.environ.get("THEATRON_PICTURES")  # a folder where pictures of the page stay
CAMERA = "synthetic:seconds=2,fps=5,quality=quick,loop=1"
SIZES = ((1280, 720), (390, 844))

ROWS = "[...document.querySelectorAll('#%s > li')].map(row => row.querySelector('.words')?.textContent ?? row.textContent)"


def shown(condition):
    return f"document.getElementById('all')?.checkVisibility() && {condition}"


def drawn(canvas, beyond=1):
    """More than `beyond` different values are drawn there. The size alone says nothing: an empty canvas is 300 pixels wide. The
    values are read from a copy: a browser warns of a canvas of a page that is read often."""
    return (f"(c => {{ if (!c) return false; const copy = new OffscreenCanvas(c.width, c.height).getContext('2d', {{ willReadFrequently: true }});"
            "copy.drawImage(c, 0, 0);"
            f"return new Set(copy.getImageData(0, 0, c.width, c.height).data).size > {beyond}; }})(document.querySelector('{canvas}'))")


def recorders_of(file):
    found = []
    for words in pathlib.Path("/proc").glob("[0-9]*/cmdline"):
        try:
            found += [words] if file.name.encode() in words.read_bytes() else []
        except OSError:
            pass  # it has ended meanwhile
    return found


class WebOperators(PageCase):
    cameras = (CAMERA,)

    def member(self, link, name):
        return Process("join", link, "--name", name, "--every", "0.1",
                       env={**os.environ, "XDG_STATE_HOME": str(self.folder / f"home of {name}")})

    def page_of(self, link, size=SIZES[0], language=None):
        page = self.browser.open("about:blank", size)
        if language:
            page.call("Page.addScriptToEvaluateOnNewDocument",
                      source=f"Object.defineProperty(navigator, 'language', {{ get: () => '{language}' }})")
        page.call("Page.navigate", url=link.replace("/#", "/operators#"))
        return page

    def opened(self, **more):
        page = self.page_of(self.links["operator"], **more)
        page.wait_for(shown("document.querySelectorAll('#links > li').length > 0"))
        return page

    def click(self, page, element, times=1):
        page.evaluate("globalThis.later ??= (() => { const now = performance.now.bind(performance); let ms = 0;"
                      "performance.now = () => now() + ms; return () => ms += 1000; })(); 0")
        for i in range(times):
            page.evaluate(f"(b => {{ b.focus(); b.click(); }})({element})")
            if i + 1 < times:  # the second click of a double click does nothing
                page.evaluate(f"{element}.click()")
            page.evaluate("later(); 0")

    def in_row(self, list_id, words, button):
        return (f"[...document.querySelectorAll('#{list_id} > li')].find(row => row.textContent.includes({json.dumps(words)}))"
                f"?.querySelector('[data-does={button}]')")

    def audited(self):
        return [json.loads(line) for line in (self.folder / "host/audit.jsonl").read_text().splitlines()]

    def test_cameras_are_shown_with_live_pictures_and_their_state(self):
        page = self.opened()
        page.wait_for("document.querySelectorAll('#cameras canvas').length === 1")
        page.wait_for(drawn('#cameras canvas', 20))
        page.wait_for("document.querySelector('#cameras .state').textContent.startsWith('live')")
        self.assertEqual(page.problems, [])

    def test_a_link_is_made_shown_for_a_minute_used_and_revoked(self):
        page = self.opened()
        page.evaluate("document.getElementById('link_for').value = 'Dr. Adä & Co'")
        page.evaluate("document.getElementById('link_role').value = 'observer'")
        page.evaluate("document.getElementById('make_link').requestSubmit()")
        page.wait_for("document.getElementById('shown_link').checkVisibility()")
        link = page.evaluate("document.getElementById('link_text').value")
        self.assertTrue(link.startswith("https://"), link)
        self.assertTrue(page.evaluate(drawn('#link_code')))
        self.assertIn("Dr. Adä & Co (observer)", page.evaluate("document.getElementById('shown_link_for').textContent"))
        page.wait_for(f"{ROWS % 'links'}.some(words => words.includes('Dr. Adä & Co (observer) · until '))")
        with self.member(link, "Olga") as olga:
            olga.wait_for(lambda f: f["phase"] == "joined")
            page.wait_for(f"{ROWS % 'people'}.includes('Olga (observer)')")
            with self.subTest("it is hidden, and nothing of it stays in the page"):
                left = page.evaluate("document.getElementById('link_left').textContent")
                self.assertRegex(left, r"^It is hidden again in \d+ s\.$")
                self.click(page, "document.getElementById('hide_link')")
                self.assertNotIn(link.split("join=")[1][:16], page.evaluate("document.documentElement.outerHTML + document.getElementById('link_text').value"))
            with self.subTest("one click asks, the second one revokes"):
                button = self.in_row("links", "Dr. Adä", "revoke")
                self.click(page, button)
                self.assertIn("Really revoke?", page.evaluate(f"{button}.textContent"))
                self.click(page, button)
                page.wait_for(f"!{ROWS % 'links'}.some(words => words.includes('Dr. Adä'))")
                page.wait_for(f"!{ROWS % 'people'}.some(words => words.includes('Olga'))")
        name = next(e["link"] for e in self.audited() if e.get("name") == "Olga")
        own = [(e["event"], e["by"]) for e in self.audited() if e.get("link") == name and "participant" not in e]
        self.assertEqual(own, [("link_made", "page of operator"), ("link_revoked", "page of operator")])

    def test_a_link_goes_by_itself_after_a_minute(self):
        page = self.opened()
        self.click(page, self.in_row("links", "expert", "show"))
        page.wait_for("document.getElementById('link_text').value.startsWith('https://')")
        self.assertRegex(page.evaluate("document.getElementById('link_left').textContent"), r"^It is hidden again in (60|5\d) s\.$")
        page.evaluate("Date.now = (now => () => now() + 60_000)(Date.now.bind(Date)); 0")
        page.wait_for("!document.getElementById('shown_link').checkVisibility() && document.getElementById('link_text').value === ''"
                      " && document.getElementById('link_code').width === 0")

    def test_people_are_muted_and_removed_and_a_page_of_others_shows_nothing(self):
        page = self.opened()
        with self.member(self.links["expert"], "Ben") as ben:
            ben.wait_for(lambda f: f["phase"] == "joined")
            page.wait_for(f"{ROWS % 'people'}.includes('Ben (expert)')")
            self.click(page, self.in_row("people", "Ben", "mute"))
            page.wait_for(f"{ROWS % 'people'}.includes('Ben (expert) · muted')")
            self.click(page, self.in_row("people", "Ben", "mute"))
            page.wait_for(f"{ROWS % 'people'}.includes('Ben (expert)')")
            self.click(page, self.in_row("people", "Ben", "remove"), times=2)
            page.wait_for(f"!{ROWS % 'people'}.some(words => words.includes('Ben'))")
        self.assertEqual([(e["event"], e["by"]) for e in self.audited() if e.get("name") == "Ben" and "by" in e],
                         [(event, "page of operator") for event in ("muted", "unmuted", "removed")])
        for role in ("expert", "observer", "publisher"):
            other = self.page_of(self.links[role])
            other.wait_for("document.getElementById('problem')?.textContent.startsWith('This page is for operators.')")
            self.assertFalse(other.evaluate("document.getElementById('all').checkVisibility()"))
        other = self.page_of(self.host.greeting["link"].split("#")[0] + "#join=wrongwrongwrong")
        other.wait_for("document.getElementById('problem')?.textContent.startsWith('This page needs a valid link')")

    def test_a_link_that_expires_closes_the_page_and_says_so(self):
        page = self.opened()
        made = page.evaluate("""fetch("/operators/link?role=operator&hours=0.003", { method: "POST",
            headers: { Authorization: `Bearer ${new URLSearchParams(location.hash.slice(1)).get("join")}` } }).then(answer => answer.json())""")
        other = self.page_of(made["link"])
        other.wait_for("document.getElementById('problem')?.textContent.startsWith('This link has expired.')")
        self.assertFalse(other.evaluate("document.getElementById('all').checkVisibility()"))

    def test_a_recording_is_begun_and_ended_and_is_whole(self):
        page = self.opened()
        self.click(page, "document.getElementById('start_recording')")
        says = "document.getElementById('recording_says').textContent"
        page.wait_for(f"{says}.startsWith('Recording for 0:0')")
        page.wait_for(f"{ROWS % 'people'}.some(words => words.startsWith('recorder'))")
        page.wait_for("document.getElementById('recording_space').textContent.includes(' GB are free')")
        # Some pictures.
        file = pathlib.Path(page.evaluate("document.getElementById('recording_file').textContent"))
        wait_until(lambda: file.exists() and file.stat().st_size > 200_000)
        self.click(page, "document.getElementById('stop_recording')", times=2)
        page.wait_for(f"{says}.startsWith('The last recording is complete:')")
        code, out, err = run("inspect", file, "--verify", "--json")
        self.assertEqual((code, json.loads(out)["complete"]), (0, True), err)
        self.assertEqual(file.parent, self.folder / "host/recordings")
        self.assertEqual(file.parent.stat().st_mode & 0o777, 0o700)
        events = [e for e in self.audited() if e["event"].startswith("recording_") and file.name in e["detail"]]
        self.assertEqual([(e["event"], e["by"], e["detail"]) for e in events],
                         [("recording_begun", "page of operator", file.name), ("recording_ended", "host", f"{file.name}: whole")])
        page.wait_for(f"!{ROWS % 'links'}.some(words => words.includes('the recording'))")
        self.assertEqual(page.problems, [])

    def test_sessions_are_made_and_ended(self):
        page = self.opened()
        page.evaluate("document.getElementById('new_session').value = 'OR 9'")
        page.evaluate("document.getElementById('create_session').requestSubmit()")
        page.wait_for("[...document.getElementById('session_choice').options].some(option => option.textContent === 'OR 9')")
        page.evaluate("(s => { s.value = [...s.options].find(o => o.textContent === 'OR 9').value; s.dispatchEvent(new Event('change')); })"
                      "(document.getElementById('session_choice'))")
        page.wait_for("document.title.startsWith('OR 9') && document.querySelectorAll('#links > li').length >= 4")
        self.click(page, self.in_row("links", "expert", "show"))
        page.wait_for("document.getElementById('link_text').value.startsWith('https://')")
        with self.member(page.evaluate("document.getElementById('link_text').value"), "Cleo") as cleo:
            cleo.wait_for(lambda f: f["phase"] == "joined")
            page.wait_for(f"{ROWS % 'people'}.includes('Cleo (expert)')")
        page.evaluate("document.getElementById('new_session').value = 'OR 9'")
        page.evaluate("document.getElementById('create_session').requestSubmit()")
        page.wait_for("document.getElementById('problem').textContent.includes(\"There is a session 'OR 9' already\")")
        self.click(page, self.in_row("sessions", "OR 9", "end"), times=2)
        page.wait_for("![...document.getElementById('session_choice').options].some(option => option.textContent === 'OR 9')"
                      " && document.querySelectorAll('#cameras > li').length === 1")
        # The session that is shown has ended: the page acts on its own one again.
        page.evaluate("document.getElementById('make_link').requestSubmit()")
        page.wait_for("document.getElementById('link_text').value.startsWith('https://')")
        self.assertEqual(page.evaluate("document.getElementById('problem').textContent"), "")

    def test_a_host_that_ends_has_a_whole_recording_and_one_that_is_killed_leaves_no_recorder(self):
        for sig, code in ((signal.SIGTERM, 0), (signal.SIGKILL, None)):
            state = self.folder / f"ends by {sig}"
            with host(state, CAMERA) as h, self.subTest(sig):
                link = h.greeting["links"]["operator"]
                token = link.split("join=")[1].split("&")[0]
                address = link.split("/#")[0]
                def ask(path, method):
                    request = urllib.request.Request(f"{address}/operators/{path}", headers={"Authorization": f"Bearer {token}"}, method=method)
                    return urllib.request.urlopen(request, context=ssl._create_unverified_context()).read()

                ask("recording?do=start", "POST")
                facts = json.loads(ask("facts", "GET"))
                file = pathlib.Path(facts["sessions"][0]["recording"]["file"])
                wait_until(lambda: file.exists() and file.stat().st_size > 200_000, of=h)
                h.send(sig)
                if code is not None:
                    self.assertEqual(h.end(), code)
            if code is None:
                # Its file is free once the recorder has ended.
                wait_until(lambda: not recorders_of(file))
            result, out, err = run("inspect", file, "--verify", "--json")
            self.assertIn(result, (0,) if code == 0 else (0, 3), err)
            # A recorder that has not noticed the loss before its own end misses nothing.
            self.assertTrue(json.loads(out)["complete"] or code is None, err)

    def test_it_is_readable_in_each_size_scheme_and_language(self):
        with self.member(self.links["expert"], "Ben") as ben:
            ben.wait_for(lambda f: f["phase"] == "joined")
            for language, sizes in (("en", SIZES), ("de", SIZES[1:]), ("fr", SIZES[:1])):
                for size in sizes:
                    page = self.opened(size=size, language=language)
                    page.wait_for(f"{ROWS % 'people'}.length === 1")
                    page.wait_for(drawn('#cameras canvas', 20))
                    self.click(page, "document.querySelector('#links [data-does=show]')")
                    page.wait_for(drawn('#link_code'))
                    with self.subTest(language=language, size=size):
                        self.assertLessEqual(page.evaluate("document.documentElement.scrollWidth"), size[0], "wider than the page")
                        for scheme in ("light", "dark"):
                            page.call("Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": scheme}])
                            self.assertEqual(page.evaluate(CONTRAST), [], scheme)
                            if AXE.exists():
                                if page.evaluate("globalThis.axe === undefined"):
                                    page.evaluate(AXE.read_text() + ";0")
                                self.assertEqual(page.evaluate(FINDINGS), [], scheme)
                            if PICTURES:
                                page.screenshot(pathlib.Path(PICTURES) / f"operators_{language}_{size[0]}_{scheme}.png")
                    page.close()

    def test_a_raised_hand_is_shown_and_taken_down(self):
        with self.member(self.links["expert"], "Hanna") as hanna:
            hanna.wait_for(lambda f: f["phase"] == "joined" and f["chat"]["may_write"])
            page = self.opened()
            row = self.in_row("people", "Hanna", "lower")
            page.wait_for(f"{row}?.hidden")
            hanna.say("hand up")
            page.wait_for(f"{ROWS % 'people'}.some(words => words.startsWith('Hanna') && words.includes('hand is up')) && !{row}.hidden")
            self.click(page, row)
            hanna.wait_for(lambda f: not any(p["hand_raised"] for p in f["room"]["people"]))
            page.wait_for(f"{row}.hidden")

    def test_a_double_click_makes_one_link(self):
        page = self.opened()
        count = page.evaluate("document.querySelectorAll('#links > li').length")
        page.evaluate("document.getElementById('link_for').value = 'Dbl'")
        page.evaluate("(form => { form.requestSubmit(); form.requestSubmit(); })(document.getElementById('make_link'))")
        page.wait_for("document.getElementById('shown_link').checkVisibility()")
        page.wait_for(f"document.querySelectorAll('#links > li').length > {count}")
        self.assertEqual(page.evaluate(f"{ROWS % 'links'}.filter(words => words.startsWith('Dbl')).length"), 1)

    def test_a_recorder_that_was_removed_keeps_out_no_other_one(self):
        page = self.opened()
        for _ in range(2):
            self.click(page, "document.getElementById('start_recording')")
            page.wait_for("document.getElementById('recording').dataset.phase === 'running'")
            page.wait_for(f"{ROWS % 'people'}.some(words => words.startsWith('recorder'))")
            self.click(page, self.in_row("people", "recorder", "remove"), times=2)
            page.wait_for("['whole', 'incomplete', 'failed'].includes(document.getElementById('recording').dataset.phase)")

    def test_the_person_of_the_pages_own_link_is_not_removed_and_an_ended_session_is_told(self):
        with self.member(self.links["operator"], "Olga") as olga:
            olga.wait_for(lambda f: f["phase"] == "joined")
            page = self.opened()
            page.wait_for(f"{ROWS % 'people'}.some(words => words.startsWith('Olga'))")
            self.click(page, self.in_row("people", "Olga", "remove"), times=2)
            page.wait_for("document.getElementById('problem').textContent.startsWith('That person came by the link')")
            olga.say("end session")
            page.wait_for("document.getElementById('problems').textContent.includes('The session has ended')")
            self.assertTrue(page.evaluate("document.getElementById('start_recording').hidden"))

    def test_a_silent_host_is_told_and_the_form_leads_here(self):
        page = self.browser.open(self.links["operator"], SIZES[0])
        page.wait_for("document.getElementById('for_operators')?.checkVisibility()")
        page.evaluate("document.getElementById('to_operators').click()")
        page.wait_for("location.pathname === '/operators' && document.getElementById('all')?.checkVisibility()")
        page.call("Network.emulateNetworkConditions", offline=True, latency=0, downloadThroughput=-1, uploadThroughput=-1)
        page.wait_for("document.getElementById('problem')?.textContent.startsWith('The host does not answer')")
        with self.subTest("nothing looks live, and the sentence is seen wherever the page is scrolled to"):
            page.wait_for("document.querySelector('#cameras .state').textContent.startsWith('not live')")
            self.assertIn("brightness", page.evaluate("getComputedStyle(document.querySelector('#cameras canvas')).filter"))
            self.assertIn("Not known", page.evaluate("document.getElementById('recording_says').textContent"))
            page.evaluate("scrollTo(0, document.documentElement.scrollHeight)")
            self.assertGreaterEqual(page.evaluate("document.getElementById('problem').getBoundingClientRect().top"), 0)
        page.call("Network.emulateNetworkConditions", offline=False, latency=0, downloadThroughput=-1, uploadThroughput=-1)
        page.wait_for("document.getElementById('problem').textContent === ''")
        page.wait_for("document.querySelector('#cameras .state').textContent.startsWith('live')")
        expert = self.browser.open(self.links["expert"], SIZES[0])
        expert.wait_for("document.getElementById('enter')?.disabled === false")
        self.assertFalse(expert.evaluate("document.getElementById('for_operators').checkVisibility()"))


if __name__ == "__main__":
    unittest.main()
