# SPDX-License-Identifier: Apache-2.0
import unittest

from check_links import problems

PAGES = {"docs/b.md": "# B\n\n## What `x` is, and [why](c.md)\n", "docs/p.png": ""}


def read(path):
    return PAGES.get(str(path))


class Links(unittest.TestCase):
    def problems(self, text):
        return problems("docs/a.md", text, read)

    def test_files_headings_and_other_sites_are_right(self):
        self.assertEqual(self.problems("# A\n[1](b.md) [2](b.md#what-x-is-and-why) [3](#a) ![4](p.png) [5](https://x/y)"), [])

    def test_what_is_not_there_is_named(self):
        self.assertIn("gone.md", self.problems("[1](gone.md)")[0])
        self.assertIn("no such heading", self.problems("[1](b.md#where)")[0])
        self.assertIn("no such heading", self.problems("[1](#where)")[0])

    def test_code_is_no_link(self):
        self.assertEqual(self.problems("```\n[1](gone.md)\n```"), [])


if __name__ == "__main__":
    unittest.main()
