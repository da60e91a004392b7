# SPDX-License-Identifier: Apache-2.0
"""Rank tests, their effect sizes and intervals, of plain sequences of numbers. The tests are SciPy's; docs/studies.md says which and why."""
import itertools
import math

import numpy as np
from scipy import stats

LEVEL = 0.05
POWER = 0.8
RESAMPLES = 9999
SEED = 20220914  # of the bootstrap: the same tables give the same report
MOST_PERMUTATIONS = 200_000  # beyond them the normal approximation is used, and named
# Efficiency of the signed-rank test relative to the t test where differences are normal (3 / pi).
EFFICIENCY = 3 / math.pi
APPROXIMATE = "normal approximation"
APPROXIMATE_CHI = "chi-squared approximation"
EXACT = "exact"
MOST_ORDERED = 6  # conditions whose orders are all counted: 720 a participant


def rounded(values):
    """Scores that are equal on paper are equal, also after 0.1 + 0.2."""
    return np.round(np.asarray(values, float), 9)


def quartiles(values):
    """(first quartile, median, third quartile) by linear interpolation, type 7 of R."""
    return tuple(float(q) for q in np.percentile(np.asarray(values, float), (25, 50, 75)))


def nonzero(differences):
    differences = rounded(differences)
    return differences[differences != 0]


def signed_rank(differences):
    """(V, two-sided p, method) of Wilcoxon's signed-rank test; differences of 0 do not count."""
    differences = nonzero(differences)
    n = len(differences)
    if n == 0:
        return 0.0, 1.0, "no difference"
    ranks = stats.rankdata(np.abs(differences))
    v = float(ranks[differences > 0].sum())
    if n == 1:
        return v, 1.0, "exact"  # either sign is as far from the middle
    if 2 ** n <= MOST_PERMUTATIONS:
        middle = ranks.sum() / 2

        # Given the sizes, each sign is equally likely; ties keep their middle ranks.
        def distance(signed, axis=-1):
            return np.abs(np.where(signed > 0, np.abs(signed), 0).sum(axis=axis) - middle)

        done = stats.permutation_test((np.sign(differences) * ranks,), distance, permutation_type="samples", vectorized=True,
                                      n_resamples=np.inf, alternative="greater", batch=10_000)
        return v, float(done.pvalue), "exact"
    return v, float(stats.wilcoxon(differences, correction=True, mode="approx").pvalue), APPROXIMATE


def rank_sum(x, y):
    """(W, two-sided p, method) of Wilcoxon's rank-sum test; W is that of R, the U of Mann and Whitney."""
    x, y = rounded(x), rounded(y)
    if len(x) == 0 or len(y) == 0:
        return 0.0, 1.0, "no values"
    both = np.concatenate((x, y))
    if len(set(both)) == len(both):
        is_small = len(both) <= 60
        done = stats.mannwhitneyu(x, y, method="exact" if is_small else "asymptotic")
        return float(done.statistic), float(done.pvalue), "exact" if is_small else APPROXIMATE
    ranks = stats.rankdata(both)
    w = float(ranks[:len(x)].sum() - len(x) * (len(x) + 1) / 2)
    if len(set(both)) == 1:
        return w, 1.0, "no difference"
    if min(len(x), len(y)) > 1 and math.comb(len(both), len(x)) <= MOST_PERMUTATIONS:
        middle = len(x) * (len(both) + 1) / 2

        def distance(a, b, axis=-1):
            return np.abs(a.sum(axis=axis) - middle)

        done = stats.permutation_test((ranks[:len(x)], ranks[len(x):]), distance, permutation_type="independent", vectorized=True,
                                      n_resamples=np.inf, alternative="greater", batch=10_000)
        return w, float(done.pvalue), "exact"
    return w, float(stats.mannwhitneyu(x, y, method="asymptotic").pvalue), APPROXIMATE


def rank_biserial(differences):
    """Of matched pairs: from -1 to 1, the share of ranks in favour less the share against (Kerby 2014)."""
    differences = nonzero(differences)
    if len(differences) == 0:
        return 0.0
    ranks = stats.rankdata(np.abs(differences))
    return float((ranks * np.sign(differences)).sum() / ranks.sum())


def rank_biserial_interval(differences, resamples=RESAMPLES):
    """The 95 % interval of rank_biserial() by percentile bootstrap over participants.

    None with fewer than 4, and where all differences have one direction: each sample then gives the same 1.
    """
    differences = rounded(differences)
    if len(differences) < 4 or len(set(np.sign(nonzero(differences)))) < 2:
        return None

    def of_samples(samples, axis=-1):
        sizes = np.abs(samples)
        # Zeros have the lowest ranks of a row: taken off, the others have the ranks that they have without them.
        zeros = (sizes == 0).sum(axis=axis, keepdims=True)
        ranks = np.where(sizes > 0, stats.rankdata(sizes, axis=axis) - zeros, 0)
        total = ranks.sum(axis=axis)
        return np.where(total > 0, (ranks * np.sign(samples)).sum(axis=axis) / np.where(total > 0, total, 1), 0)

    done = stats.bootstrap((differences,), of_samples, n_resamples=resamples, method="percentile", vectorized=True,
                           random_state=np.random.default_rng(SEED), batch=2_000)
    return float(done.confidence_interval.low), float(done.confidence_interval.high)


def holm(ps):
    """Adjusted p values after Holm (1979), in the order given."""
    order = np.argsort(ps, kind="stable")
    adjusted, highest = [0.0] * len(ps), 0.0
    for place, i in enumerate(order):
        highest = max(highest, min(1.0, (len(ps) - place) * ps[i]))
        adjusted[i] = highest
    return adjusted


def friedman(table):
    """(chi squared, degrees of freedom, p) of a row a participant, a column a condition."""
    table = rounded(table)
    freedom = table.shape[1] - 1
    if all(len(set(row)) == 1 for row in table):
        return 0.0, freedom, 1.0
    done = stats.friedmanchisquare(*table.T)
    return float(done.statistic), freedom, float(done.pvalue)


def friedman_exact(table):
    """(p, method) of the same statistic: by all orders of each participant's ranks where they can be counted, else by the
    normal theory's chi squared. Ties within a participant stay, so the sum of squares of the rank sums orders the tables."""
    ranks = np.apply_along_axis(stats.rankdata, 1, rounded(table))
    n, k = ranks.shape
    doubled = np.rint(2 * ranks).astype(int)  # tied ranks have halves
    measure = lambda sums: sum(value * value for value in sums)
    reached, counts = measure(doubled.sum(axis=0)), {tuple(doubled[0]): 1}
    for row in doubled[1:]:
        orders = list(itertools.permutations(row)) if k <= MOST_ORDERED else []
        if not orders or len(counts) * len(orders) > MOST_PERMUTATIONS:
            return friedman(table)[2], APPROXIMATE_CHI
        following = {}
        for sums, count in counts.items():
            for order in orders:
                # The order of the columns does not matter to the measure.
                key = tuple(sorted(a + b for a, b in zip(sums, order)))
                following[key] = following.get(key, 0) + count
        counts = following
    total = sum(counts.values())
    return sum(count for sums, count in counts.items() if measure(sums) >= reached) / total, EXACT


def t_power(effect, n):
    """Power of a paired t test for a difference of `effect` standard deviations."""
    edge = stats.t.ppf(1 - LEVEL / 2, n - 1)
    with np.errstate(divide="ignore"):
        return float(stats.nct.sf(edge, n - 1, effect * math.sqrt(n)))


def needed_pairs(differences):
    """Pairs with which the signed-rank test would find this difference with power 0.8; None: there is none to find.

    From the t test's power with the mean and deviation that were seen, divided by the test's efficiency.
    """
    differences = np.asarray(differences, float)
    if len(differences) < 3 or np.allclose(differences.std(ddof=1), 0) or np.isclose(differences.mean(), 0):
        return None
    effect = abs(differences.mean()) / differences.std(ddof=1)
    low, high = 2, 4
    while t_power(effect, high) < POWER:
        low, high = high, 2 * high
        if high > 100_000:
            return None
    while high - low > 1:
        middle = (low + high) // 2
        low, high = (middle, high) if t_power(effect, middle) < POWER else (low, middle)
    # With 5 pairs and fewer no p is below the level.
    return max(6, math.ceil(high / EFFICIENCY))
