#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""tools/check_sources.py finds comments without a subject and words that stand for others, and nothing else."""
import pathlib
import unittest

from check_sources import UNNAMED_SUBJECT, comment_blocks, unclear_words


class Words(unittest.TestCase):
    def test_words_that_stand_for_others_with_their_line(self):
        self.assertEqual(unclear_words("int a;\nint b;  // Likewise\n"), [(2, "Likewise")])
        self.assertEqual(unclear_words("// every so many frames"), [(1, "so many")])
        self.assertEqual(unclear_words("// panels take at most so much\n// of the width. All that is left"), [(1, "so much")])
        self.assertEqual(unclear_words("the values of before."), [(1, "of before")])

    def test_words_that_a_line_divides(self):
        self.assertEqual(unclear_words("x\n// waits for so\n    // many frames"), [(2, "so many")])
        self.assertEqual(unclear_words("the pictures of\nbefore"), [(1, "of before")])

    def test_others_are_none(self):
        for text in ("so few", "depth changes so much between frames\n// that keys are smaller", "also much", "many frames", "before it", "of beforehand", "also manyfold", "of it. Before"):
            self.assertEqual(unclear_words(text), [], text)


class Subjects(unittest.TestCase):
    def found(self, text):
        return [bool(UNNAMED_SUBJECT.search(block)) for _, block in comment_blocks(pathlib.Path("a.cpp"), text)]

    def test_a_comment_begins_with_its_subject(self):
        self.assertEqual(self.found("// What is drawn.\nint a;\n// The picture that is drawn.\n"), [True, False])


if __name__ == "__main__":
    unittest.main()
