#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Checks the result of `theatron_bench registration --json FILE` against the accuracy that docs/registration.md promises."""
import json
import sys

# For two cameras 90 degrees apart, the board at 2 m: fixed errors, poses -> figure, most millimetres.
TWO_CAMERAS = {
    (False, 1): {"mean_error_mm": 0.5},
    (False, 10): {"mean_error_mm": 0.3},
    (True, 1): {"median_error_mm": 2.0, "p90_error_mm": 3.5},
    (True, 10): {"median_error_mm": 1.2, "p90_error_mm": 2.0},
}
RING = {"mean_error_mm": 1.5}
LEAST_PRECISION, LEAST_RECALL = 0.995, 0.97


def bounds_of(case):
    """The bounds of a case; None where nothing is promised for it."""
    if case["bias_mm"] or case["occlusion"] or case["noise"] != 1 or case["distance_m"] != 2:
        return None
    if case["cameras"] == 4:
        return RING
    return TWO_CAMERAS.get((case["fixed_errors"], case["poses"])) if case["angle_deg"] == 90 else None


def problems_of(result):
    problems = []
    detection = result["detection"]
    for figure, least in (("precision", LEAST_PRECISION), ("recall", LEAST_RECALL)):
        if detection[figure] < least:
            problems.append(f"detection: {figure} {detection[figure]:.3f} is below {least}")
    checked = 0
    for case in result["registration"]:
        name = "{cameras} cameras, {poses} poses, fixed errors {fixed_errors}".format(**case)
        bounds = bounds_of(case)
        if bounds is None:
            continue
        checked += 1
        if case["solved"] < case["seeds"]:
            problems.append(f"{name}: {case['solved']} of {case['seeds']} were solved")
        problems += [f"{name}: {figure} {case[figure]:.2f} is above {most}"
                     for figure, most in bounds.items() if not case[figure] <= most]
    if checked < len(TWO_CAMERAS) + 1:
        problems.append(f"only {checked} cases with a bound were measured")
    return problems


def main():
    with open(sys.argv[1]) as file:
        problems = problems_of(json.load(file))
    for problem in problems:
        print(problem)
    print("The accuracy holds." if not problems else f"{len(problems)} bounds do not hold.")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
