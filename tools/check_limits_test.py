#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""tools/check_limits.py reads constants as a compiler does, and notices what differs."""
import unittest

from check_limits import Problem, check_row, constants_of, rows_of, value_in_page, value_of

SOURCE = """
constexpr std::size_t max_a = std::size_t(64) << 20;  // max_b = 3;
inline constexpr int max_b = 8'192, max_c = 2 * max_b;
    static constexpr Duration patience = std::chrono::milliseconds(250);
constexpr Duration waits = 2s, longest_wait = 1500ms;
constexpr std::size_t max_d = sizeof(int);
static constexpr std::array<Limit, 2> limits{
    {{2, 5}, {0.5, 20'000}}};
constexpr std::size_t max_e = wire::max_b + 1;
"""


class Limits(unittest.TestCase):
    def setUp(self):
        self.known = constants_of(SOURCE)

    def value(self, name):
        return value_of(self.known[name], self.known)

    def test_constants_have_the_values_that_the_compiler_gives_them(self):
        self.assertEqual(self.value("max_a"), 64 << 20)
        self.assertEqual((self.value("max_b"), self.value("max_c"), self.value("max_e")), (8192, 16384, 8193))
        self.assertAlmostEqual(self.value("patience"), 0.25)
        self.assertAlmostEqual(self.value("longest_wait"), 1.5)

    def test_numbers_of_a_list_are_counted_from_0(self):
        self.assertEqual([self.value(f"limits[{n}]") for n in range(4)], [2, 5, 0.5, 20000])

    def test_an_expression_that_is_not_understood_is_no_value(self):
        self.assertRaises(Problem, self.value, "max_d")

    def test_the_page_writes_values_with_units(self):
        self.assertEqual(value_in_page("64 MiB"), 64 << 20)
        self.assertEqual(value_in_page("2048 x 2048"), 2048 * 2048)
        self.assertAlmostEqual(value_in_page("250 ms"), 0.25)
        self.assertEqual(value_in_page("1 048 576"), 1 << 20)
        self.assertIsNone(value_in_page("many"))

    def test_rows_name_constants(self):
        page = "| bound | constant | why |\n|---|---|---|\n| 5 s | `src/a/b.h:c_d` | closed |\n"
        self.assertEqual(list(rows_of(page)), [(3, "5 s", "src/a/b.h", "c_d")])

    def test_a_wrong_number_and_a_constant_that_is_gone_are_problems(self):
        envelope = "src/wire/envelope.h"
        check_row("64 KiB", envelope, "max_control_size", {})
        self.assertRaises(Problem, check_row, "65 KiB", envelope, "max_control_size", {})
        self.assertRaises(Problem, check_row, "64 KiB", envelope, "max_gone", {})
        self.assertRaises(Problem, check_row, "64 KiB", "src/wire/gone.h", "max_control_size", {})


if __name__ == "__main__":
    unittest.main()
