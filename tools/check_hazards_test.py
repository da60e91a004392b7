# SPDX-License-Identifier: Apache-2.0
import unittest

from check_hazards import problems

PAGE = "| hazard | measure | tests |\n| **Old** | told | `Age.IsKnown`, `end_to_end/age_test.py::test_it` |\n"


class Hazards(unittest.TestCase):
    def problems(self, page, gtests=("Age.IsKnown",), text="    def test_it(self):\n"):
        return problems(page, set(gtests), lambda file: text if file == "end_to_end/age_test.py" else None)

    def test_a_page_whose_tests_exist_is_right(self):
        self.assertEqual(self.problems(PAGE), [])

    def test_a_test_that_is_gone_is_named(self):
        self.assertIn("Age.IsKnown", self.problems(PAGE, gtests=())[0])
        self.assertIn("age_test.py::test_it", self.problems(PAGE, text="def test_another(self):")[0])
        self.assertIn("no such test", self.problems(PAGE.replace("age_test", "gone_test"))[0])

    def test_a_hazard_without_a_test_is_named(self):
        self.assertIn("names no test", self.problems("| **Old** | told | none |")[0])


if __name__ == "__main__":
    unittest.main()
