# SPDX-License-Identifier: Apache-2.0
"""The form of the page before a session: the session itself, and what is remembered of a person."""
import os
import pathlib
import unittest

from page_case import PageCase
from theatron_process import Process, host

PICTURES = os.environ.get("THEATRON_PICTURES")  # a folder where pictures of the page stay
CAMERA = "synthetic:seconds=2,fps=5,quality=quick,loop=1"
SIZE = (800, 900)
NUMBERS = "Object.keys(localStorage).filter(key => key.startsWith('person'))"


class WebEntrance(PageCase):
    cameras = (CAMERA,)
    options = ("--admit", "ask")

    def open(self, role="operator"):
        page = self.browser.open(self.links[role], SIZE)
        page.wait_for("document.readyState === 'complete' && !document.getElementById('enter')?.disabled")
        return page

    def enter(self, page, name="Ada", remembers=False):
        page.evaluate(f"document.getElementById('remember').checked = {str(remembers).lower()}")
        page.enter(name, way="room")
        page.wait_for("theatron.state.phase !== 'left' && theatron.state.phase !== 'connecting'")

    def test_the_form_shows_people_cameras_and_picture_by_a_token_in_no_address(self):
        with Process("join", self.links["operator"], "--name", "Ben", "--every", "0.5") as ben:
            ben.wait_for(lambda f: f["fps"] > 0)
            page = self.open()
            page.wait_for("document.getElementById('session_lines').innerText.includes('Ben (operator)')")
            self.assertIn("Cameras: or0 (live)", page.evaluate("document.getElementById('session_lines').innerText"))
            page.wait_for("!document.getElementById('session_picture').hidden && document.getElementById('session_picture').width > 60")
            if PICTURES:
                page.screenshot(pathlib.Path(PICTURES) / "entrance.png")
            with self.subTest("whom one has to ask shows neither names nor cameras"):
                other = self.open("expert")
                other.wait_for("document.getElementById('session_lines').innerText.includes('knocked')")
                self.assertNotIn("Ben", other.evaluate("document.getElementById('session').innerText"))
                self.assertTrue(other.evaluate("document.getElementById('session_picture').hidden"))
            token = self.links["operator"].split("join=")[1].split("&")[0]
            self.assertTrue([url for url in page.requests if url.endswith("/lobby")])
            self.assertEqual([url for url in page.requests if token in url.split("#")[0]], [])
            with self.subTest("in the room nobody asks any more"):
                self.enter(page)
                page.wait_for("theatron.state.phase === 'joined'")
                self.assertFalse(page.evaluate("theatron.lobby.is_watching"))
                asked = len([url for url in page.requests if url.endswith("/lobby")])
                page.evaluate("new Promise(done => setTimeout(done, 4500))")
                self.assertLessEqual(len([url for url in page.requests if url.endswith("/lobby")]), asked + 1)
                self.leave(page)
                page.wait_for("theatron.lobby.is_watching")
            self.assertEqual(page.problems, [])

    def test_another_user_of_the_browser_is_another_person_unless_it_remembers(self):
        page = self.open()
        page.evaluate("localStorage.setItem('person', 'f'.repeat(32)); localStorage.setItem('name', 'Eve')")
        page = self.open()
        self.assertEqual(page.evaluate("document.getElementById('name').value"), "", "of an older page")
        self.assertEqual(page.evaluate(NUMBERS), [])
        self.enter(page)
        first = page.evaluate("theatron.person.id")
        self.leave(page)
        page.reload()
        page.wait_for("globalThis.theatron?.person?.number")
        self.assertEqual(page.evaluate("theatron.person.id"), first, "the same tab")
        page = self.open()
        self.assertNotEqual(page.evaluate("theatron.person.id"), first)
        self.assertEqual(page.evaluate("document.getElementById('name').value"), "")
        with self.subTest("remembered"):
            self.enter(page, "Bea", remembers=True)
            second = page.evaluate("theatron.person.id")
            self.leave(page)
            again = self.open()
            self.assertEqual(again.evaluate("theatron.person.id"), second)
            self.assertEqual(again.evaluate("document.getElementById('name').value"), "Bea")
            other = self.open("observer")
            self.assertNotEqual(other.evaluate("theatron.person.id"), second, "another link")
        with self.subTest("no longer"):
            self.enter(again, "Bea")
            self.leave(again)
            # A tab that is still open, with the form or behind a session, brings nothing back.
            for tab in (other, page):
                self.assertRegex(tab.evaluate("theatron.person.id"), "^[0-9a-f]{32}$")
            self.assertEqual(again.evaluate(NUMBERS), [])
            self.assertNotEqual(self.open().evaluate("theatron.person.id"), second)

    def test_a_link_that_the_host_does_not_know_invites_nobody(self):
        token = self.links["expert"].split("join=")[1].split("&")[0]
        page = self.browser.open(self.links["expert"].replace(token, token[::-1]), SIZE)
        page.wait_for("!!document.getElementById('session_lines')?.innerText.includes('does not know this invitation')")
        self.assertNotIn("You are invited", page.evaluate("document.getElementById('join').innerText"))

    def test_the_fingerprint_is_no_proof_and_the_page_says_so(self):
        page = self.open()
        text = page.evaluate("document.getElementById('certificate').textContent")
        self.assertIn("cannot check", text)
        self.assertIn("as you received it", text)

    def test_the_panel_picture_chooses_by_name_and_shows_what_the_host_sets(self):
        page = self.open()
        self.enter(page)
        page.wait_for("theatron.state.has_picture")
        page.evaluate("document.getElementById('show_picture').click()")
        choose = "((id, value) => { const s = document.getElementById(id); s.value = value; s.dispatchEvent(new Event('change')); })"
        number = page.evaluate("theatron.state.people.find(person => person.self).id")
        for id, value, came in (("renderer_choice", "disc", "theatron.state.renderer === 'disc'"),
                                ("depth_choice", "rvl", "theatron.state.cameras[0].depth === 'rvl'"),
                                ("color_choice", "raw", "theatron.state.cameras[0].color === 'raw'"),
                                ("scale_choice", "0.5", "theatron.state.scale === 0.5")):
            page.evaluate(f"{choose}('{id}', '{value}')")
            page.wait_for(came)
            page.wait_for(f"document.getElementById('{id}').value === '{value}'")
        page.evaluate(f"{choose}('color_choice', 'auto')")
        page.wait_for("theatron.state.cameras[0].color.startsWith('jpeg') && document.getElementById('color_choice').value === 'auto'")
        if PICTURES:
            page.screenshot(pathlib.Path(PICTURES) / "picture_panel.png")
        self.host.say(f"renderer {number} mesh lock")
        page.wait_for("document.getElementById('renderer_choice').disabled && document.getElementById('renderer_choice').value === 'mesh'")
        self.assertIn("host has set mesh", page.evaluate("document.getElementById('renderer_now').textContent"))
        self.host.say(f"renderer {number} free")
        page.wait_for("!document.getElementById('renderer_choice').disabled")
        self.assertEqual(page.problems, [])
        with self.subTest("full screen, and what is said where the browser refuses it"):
            click = "document.getElementById('full_screen').click()"
            page.evaluate(click)  # no gesture of a person
            page.wait_for("document.getElementById('screen_hint').textContent.includes('full screen')")
            for name in ("Leave full screen", "Full screen"):
                page.call("Runtime.evaluate", expression=click, userGesture=True)
                page.wait_for(f"document.getElementById('full_screen').textContent === '{name}'")
            self.assertEqual(page.evaluate("document.getElementById('screen_hint').textContent"), "")
        self.leave(page)


if __name__ == "__main__":
    unittest.main()
