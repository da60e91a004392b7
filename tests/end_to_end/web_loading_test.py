# SPDX-License-Identifier: Apache-2.0
"""The page behind a door that closes connections without an answer, as the host's does with silent ones."""
import contextlib
import pathlib
import re
import socket
import tempfile
import threading
import unittest

from browser import CHROMIUM, Browser
from theatron_process import PROGRAM, host

PAGE = pathlib.Path(PROGRAM).parent / "web/files.txt"


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


@unittest.skipUnless(CHROMIUM, "chromium is not installed: apt-get install chromium")
@unittest.skipUnless(PAGE.exists(), "there is no browser client: make build")
class WebLoading(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.stack = contextlib.ExitStack()
        folder = pathlib.Path(cls.stack.enter_context(tempfile.TemporaryDirectory()))
        cls.host = cls.stack.enter_context(host(folder / "host"))
        cls.link = cls.host.greeting["link"]
        cls.browser = cls.stack.enter_context(Browser())

    @classmethod
    def tearDownClass(cls):
        cls.stack.close()

    def enter_behind(self, closed):
        """The number of times that the page itself was asked for."""
        port = int(re.search(r":(\d+)/", self.link)[1])
        with ClosingDoor(port, closed) as door:
            link = self.link.replace(f":{port}/", f":{door.own_port}/")
            page = self.browser.open(link)
            page.wait_for("!!document.getElementById('invitation')?.textContent && !document.getElementById('enter').disabled", 30)
            page.evaluate("document.getElementById('name').value = 'Ada'; document.getElementById('enter').click()")
            page.wait_for("theatron.state.phase === 'joined'", 30)
            self.assertTrue(page.evaluate("document.querySelector('link[rel=stylesheet]').sheet !== null"))
            self.assertGreaterEqual(door.count, max(closed))
            return sum(request.split("#")[0].endswith(f":{door.own_port}/") for request in page.requests)

    def test_files_that_did_not_come_are_asked_for_again(self):
        # The first ones are the page and its script; a browser asks a second time for some of the others.
        self.assertGreater(self.enter_behind(range(8, 50)), 1)


if __name__ == "__main__":
    unittest.main()
