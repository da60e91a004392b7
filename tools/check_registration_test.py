#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Results within and beyond the bounds of registration are told apart."""
import unittest

from check_registration import problems_of


def case(fixed_errors, poses, cameras=2, **other):
    return {"distance_m": 2.0, "angle_deg": 90.0, "cameras": cameras, "poses": poses, "fixed_errors": fixed_errors,
            "bias_mm": 0.0, "occlusion": 0.0, "noise": 1.0, "seeds": 4, "solved": 4, "mean_error_mm": 0.25,
            "median_error_mm": 0.25, "p90_error_mm": 0.4} | other


def result():
    return {"detection": {"precision": 0.996, "recall": 0.98}, "registration": [
        case(False, 1), case(False, 10), case(True, 1), case(True, 10), case(True, 10, cameras=4),
        case(True, 10, distance_m=3.0, mean_error_mm=3.0, median_error_mm=3.0)]}


class CheckRegistration(unittest.TestCase):
    def test_good_results_have_no_problem(self):
        self.assertEqual(problems_of(result()), [])

    def test_each_figure_beyond_its_bound_is_named(self):
        for index, figure in ((0, "mean_error_mm"), (1, "mean_error_mm"), (2, "median_error_mm"), (2, "p90_error_mm"),
                              (3, "median_error_mm"), (3, "p90_error_mm"), (4, "mean_error_mm")):
            for wrong in (9.0, float("nan")):
                bad = result()
                bad["registration"][index][figure] = wrong
                self.assertEqual(len(problems_of(bad)), 1, (index, figure))
        bad = result()
        bad["detection"]["recall"] = 0.9
        self.assertIn("recall 0.900 is below 0.97", problems_of(bad)[0])

    def test_a_seed_that_was_not_solved_and_a_case_that_is_missing_are_named(self):
        bad = result()
        bad["registration"][2]["solved"] = 3
        self.assertIn("3 of 4 were solved", problems_of(bad)[0])
        bad = result()
        del bad["registration"][1]
        self.assertIn("only 4 cases", problems_of(bad)[0])


if __name__ == "__main__":
    unittest.main()
