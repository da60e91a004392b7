# SPDX-License-Identifier: Apache-2.0
"""Texts of the report's page: tables, notes on the number of participants and the order of conditions, and how all was computed."""
import html
import math

from scipy import stats

from comparisons import conclusion
from rank_statistics import APPROXIMATE, APPROXIMATE_CHI, EFFICIENCY, LEVEL, POWER, RESAMPLES, t_power

MOST_NEEDED = 1000  # larger numbers of participants say only that the difference seen is next to none

STYLE = """body{font:15px/1.5 sans-serif;max-width:66em;margin:2em auto;padding:0 1em;color:#222}
h1{font-size:1.7em;margin-bottom:.2em}h2{font-size:1.25em;margin-top:2em;border-bottom:1px solid #ccc}h3{font-size:1.05em;margin:1.4em 0 .3em}
table{border-collapse:collapse;font-size:13px;margin:.6em 0}th,td{padding:.25em .6em;text-align:right;border-bottom:1px solid #ddd;vertical-align:top}
th{background:#f3f3f3;font-weight:600}td.t,th.t{text-align:left}.note{background:#fff6dd;border-left:4px solid #d9a400;padding:.5em .8em}
svg{max-width:100%;height:auto}figure{margin:.6em 0;break-inside:avoid}tr{break-inside:avoid}small{color:#666}
@media print{body{max-width:none;margin:0;font-size:11px}table{font-size:9px}h2,h3{break-after:avoid}}"""


def number(value, digits=2):
    if not math.isfinite(value):
        return "-"
    return str(int(value)) if float(value).is_integer() else f"{value:.{digits}f}"


def p_text(p, method=""):
    return "-" if math.isnan(p) else ("< 0.001" if p < 0.001 else f"{p:.3f}") + (" ~" if method in (APPROXIMATE, APPROXIMATE_CHI) else "")


def share_text(share, n):
    return "-" if math.isnan(share) else f"{round(share * n)} of {n}"


def needed_text(n):
    return f"> {MOST_NEEDED}" if n > MOST_NEEDED else number(n)


def people(n):
    return "1 participant" if n == 1 else f"{n} participants"


def table_text(heads, rows, texts=1):
    """The first `texts` columns are texts, and so is a last one with conclusions."""
    def cell(tag, i, text):
        is_text = i < texts or heads[i] == "Conclusion"
        return f"<{tag}{' class=t' if is_text else ''}>{html.escape(str(text))}</{tag}>"
    lines = ["<table><tr>" + "".join(cell("th", i, head) for i, head in enumerate(heads)) + "</tr>"]
    lines += ["<tr>" + "".join(cell("td", i, text) for i, text in enumerate(row)) + "</tr>" for row in rows]
    return "\n".join([*lines, "</table>"])


def description_table(rows, with_condition):
    heads = ["Scale", *(["Condition"] if with_condition else []), "n", "Median", "1st quartile", "3rd quartile", "Lowest", "Highest",
             "In lowest third", "In highest third"]
    return table_text(heads, [[r.title, *([r.condition or "-"] if with_condition else []), r.n, number(r.median), number(r.q1), number(r.q3),
                               number(r.minimum), number(r.maximum), share_text(r.lowest_third, r.n), share_text(r.highest_third, r.n)]
                              for r in rows.itertuples()], 2 if with_condition else 1)


def comparison_tables(rows):
    lines = []
    if len(rows) and len(whole := rows[rows.test == "Friedman"]):
        lines.append("<h3>All conditions (Friedman)</h3>")
        lines.append(table_text(["Scale", "n", "Chi squared", "df", "p", "p (Holm)", "Conclusion"],
                                [[r.title, r.n, number(r.statistic), int(r.freedom), p_text(r.p, r.method), p_text(r.p_holm), conclusion(r)]
                                 for r in whole.itertuples()]))
    if len(rows) and len(pairs := rows[rows.test == "signed-rank"]):
        lines.append("<h3>Pairs of conditions (Wilcoxon signed-rank)</h3>")
        lines.append(table_text(
            ["Scale", "Pair", "n", "V", "p", "p (Holm)", "Effect r [95 %]", "n needed", "Rank-sum W, p", "Conclusion"],
            [[r.title, r.pair, r.n, number(r.statistic, 1), p_text(r.p, r.method), p_text(r.p_holm),
              f"{r.effect:.2f}" + ("" if math.isnan(r.effect_low) else f" [{r.effect_low:.2f}, {r.effect_high:.2f}]"), needed_text(r.needed_n),
              "-" if math.isnan(r.rank_sum_p) else f"{number(r.rank_sum_w, 1)}, {p_text(r.rank_sum_p, r.rank_sum_method)}", conclusion(r)] for r in pairs.itertuples()], 2))
    return lines


def complete_pairs(comparisons):
    """(fewest, most) participants of a comparison of two conditions; None: there is none."""
    pairs = comparisons[comparisons.test == "signed-rank"].n if len(comparisons) else []
    return (int(min(pairs)), int(max(pairs))) if len(pairs) else None


def size_note(agreed, conditions, pairs=None):
    """A sentence on what this number of participants can tell at all. `pairs`: as of complete_pairs()."""
    n = agreed if conditions < 2 else pairs[1] if pairs else 0
    if conditions >= 2 and agreed > 0 and n == 0:
        return f"{people(agreed)} agreed, and nobody has rated two conditions yet, so there is nothing to compare."
    if n == 0:
        return "Nobody has agreed to take part yet, so there is nothing to describe."
    if conditions < 2:
        half = stats.binomtest(n // 2, n).proportion_ci(method="exact")
        return (f"{people(n)} and no two conditions: this report describes and compares nothing. A share of so few people is inexact: where "
                f"{n // 2} of {n} say something, {100 * half.low:.0f} to {100 * half.high:.0f} % of all may do so (95 % interval of Clopper and Pearson).")
    who = f"{n} of {people(agreed)} rated two conditions" if n < agreed else people(n)
    who += f" (in some comparisons {pairs[0]})" if pairs[0] < n else ""
    if n < 6:
        return (f"{who}: no comparison of two conditions can reach p &lt; {LEVEL}, whatever they reply. "
                "The study is too small to conclude on pairs; this report describes.")
    effect = next(d / 100 for d in range(5, 1000) if t_power(d / 100, n * EFFICIENCY) >= POWER)
    return (f"{who}: with a probability of {100 * POWER:.0f} % a comparison of two conditions finds differences of at least {effect:.2f} standard "
            "deviations of the differences, before any correction. Smaller ones stay unseen, so \"no difference was found\" never means that there is none.")


def order_note(participants, conditions):
    """A sentence where those who completed the study did not see all orders equally often; empty: they did."""
    orders = participants[participants.state == "complete"].order.value_counts()
    if conditions < 2 or not len(orders) or (orders.max() == orders.min() and (len(orders) > 1 or orders.max() == 1)):
        return ""
    return ("The orders of conditions are not equally frequent among those who completed the study, so an effect of the order looks like one of "
            "the conditions: " + "; ".join(f"{order} ({count})" for order, count in orders.items()) + ".")


METHOD = f"""<p>Quartiles interpolate linearly. Two conditions are compared within participants by Wilcoxon's signed-rank test, two-sided; differences of 0 do not
count, and tied ranks are averaged. p is exact, by all permutations, also of Friedman's test; where a ~ follows, it is the normal or the chi-squared approximation. Holm's correction covers all tests of one
kind in this report. The effect r is the rank-biserial correlation of matched pairs, with the interval of a percentile bootstrap ({RESAMPLES} samples of
participants), not corrected for the number of comparisons; there is none where all differ in one direction. "n needed" is the number of pairs, at a single test, with which a difference as large as the one seen would be found with a probability of {100 * POWER:.0f} %;
the differences of small studies vary much, and so does this number. The rank-sum test stands beside them for comparison with studies that report it; it does
not know that the same people saw both conditions.</p>
<p>A scale that lacks a reply has no value. The time of a step during which the program was started again is left out. Tables: participants.csv, replies.csv,
scores.csv, tasks.csv, items.csv, descriptions.csv, statistics.csv.</p>"""
