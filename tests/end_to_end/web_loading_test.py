# SPDX-License-Identifier: Apache-2.0
"""The page behind a door that closes connections without an answer, as the host's does with silent ones."""
import contextlib
import re
import socket
import threading
import unittest

from page_case import PageCase
from theatron_process import host


class ClosingDoor:
    """Passes connections on to a port of this machine, but closes those with these numbers, counted from 1."""

    def __init__(self, port, closed):
        self.port, self.closed = port, set(closed)
        self.count = 0
        self.listener = socket.create_server(("127.0.0.1", 0))
        self.own_port = self.listener.getsockname()[1]
        threading.Thread(target=self._accept, daemon=True).start()

    def _accept(self):
        with contextlib.suppress(OSError):
            while True:
                client, _ = self.listener.accept()
                self.count += 1
                if self.count in self.closed:
                    client.close()
                    continue
                threading.Thread(target=self._serve, args=(client,), daemon=True).start()

    def _serve(self, client):
        with client, socket.create_connection(("127.0.0.1", self.port)) as server:
            back = threading.Thread(target=self._pass_on, args=(server, client), daemon=True)
            back.start()
            self._pass_on(client, server)
            back.join()

    @staticmethod
    def _pass_on(one, other):
        with contextlib.suppress(OSError):
            while data := one.recv(1 << 16):
                other.sendall(data)
        with contextlib.suppress(OSError):
            other.shutdown(socket.SHUT_WR)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        # shutdown() ends accept(), which close() alone does not.
        self.listener.shutdown(socket.SHUT_RDWR)
        self.listener.close()


class WebLoading(PageCase):
    def enter_behind(self, closed):
        """The number of times that the page itself was asked for."""
        port = int(re.search(r":(\d+)/", self.link)[1])
        with ClosingDoor(port, closed) as door:
            link = self.link.replace(f":{port}/", f":{door.own_port}/")
            page = self.browser.open(link)
            page.wait_for("!!document.getElementById('invitation')?.textContent && !document.getElementById('enter').disabled")
            page.evaluate("document.getElementById('name').value = 'Ada'; document.getElementById('enter').click()")
            page.wait_for("theatron.state.phase === 'joined'")
            self.assertTrue(page.evaluate("document.querySelector('link[rel=stylesheet]').sheet !== null"))
            self.assertGreaterEqual(door.count, max(closed))
            return sum(request.split("#")[0].endswith(f":{door.own_port}/") for request in page.requests)

    def test_files_that_did_not_come_are_asked_for_again(self):
        # The first ones are the page and its script; a browser asks again for the others by itself, some times.
        self.assertTrue(any(self.enter_behind(range(8, end)) > 1 for end in (50, 100, 150)))

    def test_files_of_the_operators_page_are_asked_for_again(self):
        port = int(re.search(r":(\d+)/", self.link)[1])

        def loads_behind(closed):
            with ClosingDoor(port, closed) as door:
                page = self.browser.open(self.links["operator"].replace(f":{port}/#", f":{door.own_port}/operators#"))
                page.wait_for("document.getElementById('all')?.checkVisibility() && document.getElementById('session_title').textContent !== ''")
                return sum(request.split("#")[0].endswith("/operators") for request in page.requests)

        self.assertTrue(any(loads_behind(range(4, end)) > 1 for end in (20, 40, 80)))

    def test_lost_graphics_bring_the_person_back_once(self):
        lose = """(document.getElementById('view').getContext('webgl2').getExtension('WEBGL_lose_context').loseContext(),
            globalThis.is_old = true)"""
        page = self.browser.open(self.link)
        page.enter("Bea", speaks=True)
        page.wait_for("theatron.state.phase === 'joined'")
        page.evaluate("theatron.voice.close_microphone()")
        page.evaluate(lose)
        page.wait_for("!globalThis.is_old && globalThis.theatron?.state.phase === 'joined'")
        page.wait_for("theatron.state.people.some(({ name, self }) => self && name === 'Bea')")  # the room comes after the door's answer
        self.assertEqual(page.evaluate("theatron.voice.microphone"), "off")  # as it was
        # A card that fails again and again would let nobody read why.
        page.evaluate(lose)
        page.wait_for("!globalThis.is_old && document.getElementById('problem')?.textContent.includes('stopped again')")
        self.assertEqual(page.evaluate("theatron.state.phase"), "left")

    def test_sound_that_does_not_open_is_told_and_opens_later(self):
        page = self.browser.open(self.link)
        page.wait_for("!!globalThis.AudioContext && !!document.getElementById('invitation')?.textContent")
        page.evaluate("""(globalThis.Sound = AudioContext,
            globalThis.AudioContext = class { constructor() { throw new Error("no device"); } }, 0)""")
        page.enter("Cem")
        page.wait_for("document.getElementById('voice_hint')?.textContent.includes('no device')")
        page.evaluate("globalThis.AudioContext = Sound, 0")
        page.evaluate("theatron.voice.open_microphone()")
        page.wait_for("theatron.voice.problem === '' && !document.getElementById('voice_hint').textContent.includes('no device')")


if __name__ == "__main__":
    unittest.main()
