# SPDX-License-Identifier: Apache-2.0
import pathlib
import unittest

from changelog import gathered, section


class Changelog(unittest.TestCase):
    def test_lines_stand_under_their_groups(self):
        lines = gathered({"b.fixed.md": "One.\n", "a.added.md": "- Two.\n\nThree.\n", "c.added.md": "<!-- x -->\nFour.\n"})
        self.assertEqual(section(lines, "0.2.0 (2027-01-31)"),
                         "## 0.2.0 (2027-01-31)\n\n### Added\n\n- Two.\n- Three.\n- Four.\n\n### Fixed\n\n- One.\n")

    def test_a_file_of_another_form_is_named(self):
        with self.assertRaisesRegex(ValueError, "notes.md"):
            gathered({"notes.md": "x"})

    def test_the_files_that_are_there_have_the_form(self):
        folder = pathlib.Path(__file__).resolve().parent.parent / "docs/changes"
        gathered({file.name: file.read_text() for file in folder.glob("*.md") if file.name != "README.md"})


if __name__ == "__main__":
    unittest.main()
