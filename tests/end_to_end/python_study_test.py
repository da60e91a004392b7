# SPDX-License-Identifier: Apache-2.0
"""The statistics of a study's report against those of R.

The reference values are from R 4.2.2 with coin 1.4-2 and exactRankTests 0.8-35 (Debian's r-base-core, r-cran-coin and
r-cran-exactranktests); the command that made each stands beside it. In R the data are

    a7  <- c(3,4,2,5,3,4,4);  b7 <- c(4,4,4,5,5,3,5);  c7 <- c(5,4,4,4,5,5,5)
    a12 <- c(3.2,4.0,2.4,5.1,3.3,4.4,4.8,2.9,3.7,1.5,4.6,3.0)
    b12 <- c(4.1,4.6,3.1,4.9,5.3,3.0,5.6,3.8,4.9,3.3,4.7,4.2)
    c12 <- c(4.4,4.0,3.9,5.0,4.1,4.2,5.0,3.1,4.0,2.2,4.6,4.4)
    x5  <- c(1,1,2,2,9);  y8 <- c(2,3,3,4,4,4,5,9)
    xu  <- c(1.1,2.7,3.9,8.2,5.5);  yu <- c(6.1,7.3,9.4,10.2,2.2,11.8,4.7)
    u   <- c(.4,.9,-.3,1.4,2.1,.7,-1.1,1.9,.2,1.2,.6,1.7)
    set.seed(1); l1 <- round(rnorm(40),1); l2 <- round(rnorm(40,0.4),1)
"""
import pathlib
import sys
import types
import unittest

try:
    import matplotlib.pyplot
    import numpy as np
    import pandas
    import scipy.stats
    MISSING = ""
except ImportError as missing:
    MISSING = f"needs python3-numpy, python3-scipy, python3-pandas and python3-matplotlib: {missing}"
if not MISSING:
    sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "apps/theatron/study_report"))
    import comparisons
    import page
    import rank_statistics

A7, B7, C7 = [3, 4, 2, 5, 3, 4, 4], [4, 4, 4, 5, 5, 3, 5], [5, 4, 4, 4, 5, 5, 5]
A12 = [3.2, 4.0, 2.4, 5.1, 3.3, 4.4, 4.8, 2.9, 3.7, 1.5, 4.6, 3.0]
B12 = [4.1, 4.6, 3.1, 4.9, 5.3, 3.0, 5.6, 3.8, 4.9, 3.3, 4.7, 4.2]
C12 = [4.4, 4.0, 3.9, 5.0, 4.1, 4.2, 5.0, 3.1, 4.0, 2.2, 4.6, 4.4]
X5, Y8 = [1, 1, 2, 2, 9], [2, 3, 3, 4, 4, 4, 5, 9]
XU, YU = [1.1, 2.7, 3.9, 8.2, 5.5], [6.1, 7.3, 9.4, 10.2, 2.2, 11.8, 4.7]
U = [.4, .9, -.3, 1.4, 2.1, .7, -1.1, 1.9, .2, 1.2, .6, 1.7]
L1 = [-0.6, 0.2, -0.8, 1.6, 0.3, -0.8, 0.5, 0.7, 0.6, -0.3, 1.5, 0.4, -0.6, -2.2, 1.1, 0, 0, 0.9, 0.8, 0.6, 0.9, 0.8, 0.1, -2, 0.6, -0.1,
      -0.2, -1.5, -0.5, 0.4, 1.4, -0.1, 0.4, -0.1, -1.4, -0.4, -0.4, -0.1, 1.1, 0.8]
L2 = [0.2, 0.1, 1.1, 1, -0.3, -0.3, 0.8, 1.2, 0.3, 1.3, 0.8, -0.2, 0.7, -0.7, 1.8, 2.4, 0, -0.6, 1, 0.3, 2.8, 0.4, 1.1, 0.4, -0.3, 0.6,
      -1.4, 1.9, 0.6, 2.6, 0.9, -0.3, 1, -0.5, -0.9, 0.7, 0, 0.4, 0.5, -0.2]


@unittest.skipIf(MISSING, MISSING)
class Statistics(unittest.TestCase):
    def same(self, found, expected):
        for f, e in zip(found, expected, strict=True):
            self.assertLessEqual(abs(f - e), 1e-9, f"{found} instead of {expected}")

    def test_quartiles(self):
        self.same(rank_statistics.quartiles(A7), (3, 4, 4))  # quantile(a7, c(.25,.5,.75))
        self.same(rank_statistics.quartiles(B12), (3.675, 4.4, 4.9))  # quantile(b12, c(.25,.5,.75))

    def test_signed_rank_without_ties_is_exact(self):
        v, p, method = rank_statistics.signed_rank(U)  # wilcox.test(u)
        self.same((v, p), (69, 0.01611328125))
        self.assertEqual(method, "exact")

    def test_signed_rank_with_ties_and_zeros_is_exact(self):
        # wilcox.exact(b7, a7, paired=TRUE); pvalue(wilcoxsign_test(b7~a7, distribution="exact", zero.method="Wilcoxon"))
        v, p, method = rank_statistics.signed_rank(np.subtract(B7, A7))
        self.same((v, p), (13, 0.25))
        self.assertEqual(method, "exact")
        # wilcox.exact(round(b12-a12, 9)), and the same p by coin
        self.same(rank_statistics.signed_rank(np.subtract(B12, A12))[:2], (66, 0.03173828125))

    def test_signed_rank_of_many_is_approximate(self):
        # wilcox.test(round(l1-l2, 9), exact=FALSE, correct=TRUE)
        v, p, method = rank_statistics.signed_rank(np.subtract(L1, L2))
        self.same((v, p), (240.5, 0.037455503417511894))
        self.assertEqual(method, "normal approximation")

    def test_rank_sum_without_ties_is_exact(self):
        self.same(rank_statistics.rank_sum(XU, YU)[:2], (8, 0.14898989898989901))  # wilcox.test(xu, yu, exact=TRUE)

    def test_rank_sum_with_ties_is_exact(self):
        # wilcox.exact(b7, a7); wilcox.exact(x5, y8); the same p by pvalue(wilcox_test(..., distribution="exact"))
        self.same(rank_statistics.rank_sum(B7, A7)[:2], (35, 0.23193473193473196))
        self.same(rank_statistics.rank_sum(X5, Y8)[:2], (8.5, 0.097902097902097904))

    def test_rank_sum_of_many_is_approximate(self):
        # wilcox.test(l1, l2, exact=FALSE, correct=TRUE); wilcox.test(b12, a12, exact=FALSE, correct=TRUE)
        self.same(rank_statistics.rank_sum(L1, L2)[:2], (623, 0.089144688557641738))
        w, p, method = rank_statistics.rank_sum(B12, A12)
        self.same((w, p), (101.5, 0.093782545286703656))
        self.assertEqual(method, "normal approximation")

    def test_holm(self):
        # p.adjust(c(0.01,0.04,0.03,0.005,0.5), "holm")
        self.same(rank_statistics.holm([0.01, 0.04, 0.03, 0.005, 0.5]), (0.04, 0.09, 0.09, 0.025, 0.5))

    def test_a_hint_says_if_no_difference_could_have_held(self):
        row = types.SimpleNamespace(test="signed-rank", n=7, nonzero=7, p=2 / 128, p_holm=8 / 128, tests=4)
        self.assertEqual(comparisons.conclusion(row), "a hint, which does not hold after Holm's correction; with 7 pairs and 4 tests none could")
        row.nonzero = row.n = 12
        self.assertEqual(comparisons.conclusion(row), "a hint, which does not hold after Holm's correction")
        row.nonzero = row.n = 5
        self.assertIn("too small to conclude", comparisons.conclusion(row))

    def test_the_first_lines_of_a_study_without_comparisons_speak_of_shares(self):
        # binom.test(6, 12)$conf.int: 0.2109446 0.7890554
        self.assertIn("where 6 of 12 say something, 21 to 79 % of all may do so", page.size_note(12, 0))
        self.assertIn("Nobody has agreed", page.size_note(0, 2))
        self.assertIn("5 participants: no comparison", page.size_note(5, 2, (5, 5)))
        self.assertIn("too small to conclude", page.size_note(5, 2, (5, 5)))
        self.assertIn("7 participants: with a probability", page.size_note(7, 2, (7, 7)))
        self.assertIn("differences of at least", page.size_note(7, 2, (7, 7)))
        # Those who agreed and broke off compare nothing.
        self.assertIn("5 of 13 participants rated two conditions: no comparison", page.size_note(13, 2, (5, 5)))
        self.assertIn("12 participants (in some comparisons 6): with a probability", page.size_note(12, 2, (6, 12)))
        self.assertIn("nobody has rated two conditions yet", page.size_note(1, 2))

    def test_friedman(self):
        # friedman.test(cbind(a12, b12, c12)); friedman.test(cbind(a7, b7, c7))
        self.same(rank_statistics.friedman(np.transpose([A12, B12, C12])), (6.7826086956521738, 2, 0.033664737722352886))
        self.same(rank_statistics.friedman(np.transpose([A7, B7, C7])), (3.9, 2, 0.14227407158651359))

    def test_friedman_of_few_is_exact(self):
        """Against all orders of all participants' ranks, counted one by one; a table with ties."""
        import itertools
        from scipy import stats
        for table in ([[1, 2, 3], [2, 2, 5], [0, 4, 4], [3, 1, 6]], [[1, 2, 3, 4], [4, 2, 2, 9], [0, 1, 5, 5]]):
            ranks = [stats.rankdata(row) for row in table]
            seen = np.square(np.sum(ranks, axis=0)).sum()
            all_of_them = [np.square(np.sum(orders, axis=0)).sum()
                           for orders in itertools.product(*(itertools.permutations(row) for row in ranks))]
            p, method = rank_statistics.friedman_exact(table)
            self.same([p], [np.mean(np.array(all_of_them) >= seen - 1e-9)])
            self.assertEqual(method, rank_statistics.EXACT)
        self.assertEqual(rank_statistics.friedman_exact(np.arange(24).reshape(2, 12))[1], rank_statistics.APPROXIMATE_CHI)

    def test_a_few_participants_conclude_nothing_on_many_conditions(self):
        row = types.SimpleNamespace(test="Friedman", n=2, freedom=2, p=1 / 6, p_holm=1 / 6, method=rank_statistics.EXACT)
        self.assertEqual(comparisons.conclusion(row), "too small to conclude: 2 participants never reach p < 0.05")
        row = types.SimpleNamespace(test="Friedman", n=2, freedom=11, p=0.024, p_holm=0.024, method=rank_statistics.APPROXIMATE_CHI)
        self.assertIn("too small to conclude", comparisons.conclusion(row))
        row = types.SimpleNamespace(test="Friedman", n=3, freedom=2, p=1 / 36, p_holm=1 / 36, method=rank_statistics.EXACT)
        self.assertEqual(comparisons.conclusion(row), "the conditions differ")

    def test_needed_pairs(self):
        # ceiling(power.t.test(delta=mean(d), sd=sd(d), power=.8, type="paired")$n), divided by 3/pi: 15 and 22
        self.assertEqual(rank_statistics.needed_pairs(np.subtract(B12, A12)), 16)
        self.assertEqual(rank_statistics.needed_pairs(np.subtract(B7, A7)), 24)
        self.assertIsNone(rank_statistics.needed_pairs([1, -1, 1, -1]))

    def test_rank_biserial(self):
        # The share of ranks: (13 - 2) / 15 of b7 - a7, from V above.
        self.same([rank_statistics.rank_biserial(np.subtract(B7, A7))], [11 / 15])
        self.assertEqual(rank_statistics.rank_biserial([0, 0]), 0)
        self.assertEqual(rank_statistics.rank_biserial([1, 2, 0]), 1)

    def test_the_interval_is_that_of_all_samples(self):
        """The bootstrap with all 3 125 samples of five participants, within its error from 9 999 of them."""
        import itertools
        differences = np.array([2, -1, 0, 1, 3])
        all_of_them = [rank_statistics.rank_biserial(sample) for sample in itertools.product(differences, repeat=5)]
        low, high = np.percentile(all_of_them, (2.5, 97.5))
        found = rank_statistics.rank_biserial_interval(differences)
        # A quantile of 9 999 samples lies between those of all samples at 2.5 % +- 3 * 0.16 %.
        for value, share in ((found[0], 2.5), (found[1], 97.5)):
            self.assertGreaterEqual(value, np.percentile(all_of_them, share - 0.5) - 1e-9)
            self.assertLessEqual(value, np.percentile(all_of_them, share + 0.5) + 1e-9)
        self.assertLess(low, high)
        self.assertIsNone(rank_statistics.rank_biserial_interval([1, 2, 3]))

    def test_one_direction_has_no_interval(self):
        self.assertIsNone(rank_statistics.rank_biserial_interval([1, 2, 3, 0, 4]))

    def test_equal_values_give_no_difference(self):
        self.assertEqual(rank_statistics.signed_rank([0, 0, 0]), (0.0, 1.0, "no difference"))
        self.assertEqual(rank_statistics.signed_rank([0, 0, 2]), (1.0, 1.0, "exact"))
        self.assertEqual(rank_statistics.rank_sum([2, 2], [2, 2])[1:], (1.0, "no difference"))
        self.assertEqual(rank_statistics.friedman([[1, 1, 1], [2, 2, 2]])[2], 1.0)
        self.assertEqual(rank_statistics.friedman_exact([[1, 1, 1], [2, 2, 2]]), (1.0, rank_statistics.EXACT))

        # 0.1 + 0.2 is not 0.3 in floating point; scores that are equal on paper are equal here.
        self.assertEqual(rank_statistics.signed_rank([0.1 + 0.2 - 0.3] * 7)[1], 1.0)


if __name__ == "__main__":
    unittest.main()
