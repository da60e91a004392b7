# SPDX-License-Identifier: Apache-2.0
"""The beginning of most tests of the browser client: one host and one browser for all tests of a class."""
import contextlib
import pathlib
import tempfile
import unittest

from browser import CHROMIUM, Browser
from theatron_process import PROGRAM, host

PAGE = pathlib.Path(PROGRAM).parent / "web/files.txt"


@unittest.skipUnless(CHROMIUM, "chromium is not installed: apt-get install chromium")
@unittest.skipUnless(PAGE.exists(), "there is no browser client: make build")
class PageCase(unittest.TestCase):
    """`cameras` and `options` are the host's, `flags` the browser's. Contexts that a class enters into `stack` end with it."""
    cameras = ()
    options = ()
    flags = ()

    @classmethod
    def setUpClass(cls):
        cls.stack = contextlib.ExitStack()
        cls.addClassCleanup(cls.stack.close)
        cls.folder = pathlib.Path(cls.stack.enter_context(tempfile.TemporaryDirectory()))
        cls.host = cls.stack.enter_context(host(cls.folder / "host", *cls.cameras, options=cls.options))
        cls.link = cls.host.greeting["link"]
        cls.links = cls.host.greeting["links"]
        cls.browser = cls.stack.enter_context(Browser(*cls.flags))

    def setUp(self):
        # A page that stays open draws on, and takes the processor from those of the next test.
        of_class = set(self.browser.pages.values())
        self.addCleanup(lambda: [page.close() for page in set(self.browser.pages.values()) - of_class])

    def leave(self, page):
        page.evaluate("document.getElementById('leave').click()")
        page.wait_for("theatron.state.phase === 'left'")
