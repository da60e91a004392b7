#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Statistics and figures of a study, from the tables that `theatron study report` has written.

    study_report.py FOLDER

FOLDER has participants.csv, scores.csv, replies.csv, tasks.csv, items.csv and study.json; statistics.csv, descriptions.csv,
figures as SVG and report.html come there. The statistics are SciPy's; docs/studies.md says which and why.
"""
import html
import itertools
import json
import math
import pathlib
import sys

try:
    import numpy as np
    import pandas as pd
    from scipy import stats
    import matplotlib
    matplotlib.use("svg")
    from matplotlib import pyplot
except ImportError as missing:
    sys.exit(f"The report needs {missing.name or 'a package'}, which is missing; install it with: "
             "sudo apt install python3-scipy python3-pandas python3-matplotlib")

LEVEL = 0.05
POWER = 0.8
RESAMPLES = 9999
SEED = 20220914  # of the bootstrap: the same tables give the same report
MOST_NEEDED = 1000  # larger numbers of participants say only that the difference seen is next to none
MOST_PERMUTATIONS = 200_000  # beyond them the normal approximation is used, and named
# Efficiency of the signed-rank test relative to the t test where differences are normal (3 / pi).
EFFICIENCY = 3 / math.pi
APPROXIMATE = "normal approximation"
APPROXIMATE_CHI = "chi-squared approximation"
EXACT = "exact"
MOST_ORDERED = 6  # conditions whose orders are all counted: 720 a participant


# Statistics

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


# Tables

KEYS = ["phase", "questionnaire", "scale", "title"]


def in_order(scores, conditions):
    """The rows by questionnaire and scale as they first stand there, and by the protocol's order of conditions."""
    places = {condition: place for place, condition in enumerate(["", *conditions])}
    # The participant with the most scales has them in the order of the protocol; others may have left some out.
    by_length = scores.assign(length=scores.groupby("participant").participant.transform("size")).sort_values("length", ascending=False, kind="stable")
    scales = {key: place for place, key in enumerate(dict.fromkeys(map(tuple, by_length[KEYS].values)))}
    order = sorted(range(len(scores)), key=lambda i: (scales[tuple(scores[KEYS].iloc[i])], places[scores.condition.iloc[i]]))
    return scores.iloc[order].reset_index(drop=True)


def described(scores):
    """A row a scale and condition."""
    rows, keys = [], [*KEYS, "condition"]
    for key, group in scores.groupby(keys, sort=False):
        q1, median, q3 = quartiles(group.score)
        low, high = group.lowest.iloc[0], group.highest.iloc[0]
        third = (high - low) / 3
        shares = [math.nan, math.nan]
        if np.isfinite(high):
            shares = [float((group.score < low + third - 1e-9).mean()), float((group.score > high - third + 1e-9).mean())]
        rows.append([*key, len(group), q1, median, q3, float(group.score.min()), float(group.score.max()), *shares])
    return pd.DataFrame(rows, columns=[*keys, "n", "q1", "median", "q3", "minimum", "maximum", "lowest_third", "highest_third"])


def preferences(replies, participants, conditions):
    """The preference between two conditions, asked by their order, as a scale that points to the second of the protocol."""
    asked = replies[(replies.questionnaire == "own-preference") & replies.value.notna()]
    if len(conditions) != 2 or not len(asked):
        return pd.DataFrame()
    last = {row.participant: row.order.split()[-1] for row in participants.itertuples()}
    rows = [{"participant": row.participant, "condition": "", "position": "", "phase": row.phase, "questionnaire": row.questionnaire,
             "scale": "towards", "title": f"Preference: 0 {conditions[0]}, 3 equal, 6 {conditions[1]}",
             "score": row.value if last[row.participant] == conditions[1] else 6 - row.value, "lowest": 0, "highest": 6}
            for row in asked.itertuples()]
    return pd.DataFrame(rows)


def pair_row(key, pair, differences):
    """The comparison of two conditions by the differences of participants."""
    v, p, method = signed_rank(differences)
    interval = rank_biserial_interval(differences) or (math.nan, math.nan)
    return {**dict(zip(KEYS, key)), "test": "signed-rank", "pair": pair, "n": len(differences), "nonzero": len(nonzero(differences)),
            "median_difference": float(np.median(differences)), "statistic": v, "p": p, "method": method,
            "effect": rank_biserial(differences), "effect_low": interval[0], "effect_high": interval[1],
            "needed_n": needed_pairs(differences) or math.nan, "rank_sum_w": math.nan, "rank_sum_p": math.nan, "rank_sum_method": ""}


def compared(scores, conditions):
    """A row a scale and pair of conditions, and one a scale for Friedman where there are more than two."""
    rows = []
    for key, group in scores[scores.scale == "towards"].groupby(KEYS, sort=False):
        rows.append(pair_row(key, f"{conditions[1]} - {conditions[0]}", (group.score - 3).to_numpy()))
    for key, group in scores[scores.condition != ""].groupby(KEYS, sort=False):
        wide = group.pivot_table(index="participant", columns="condition", values="score").reindex(columns=conditions)
        whole = wide.dropna()
        if len(conditions) > 2 and len(whole) > 1:
            chi2, freedom, p_chi2 = friedman(whole.to_numpy())
            p, method = friedman_exact(whole.to_numpy())
            rows.append({**dict(zip(KEYS, key)), "test": "Friedman", "pair": "all", "n": len(whole), "nonzero": len(whole),
                         "statistic": chi2, "freedom": freedom, "p": p, "method": method, "p_chi_squared": p_chi2})
        for a, b in itertools.combinations(conditions, 2):
            pairs = wide[[a, b]].dropna()
            differences = (pairs[b] - pairs[a]).to_numpy()
            if len(differences) == 0:
                continue
            w, p_sum, method_sum = rank_sum(pairs[b], pairs[a])
            rows.append({**pair_row(key, f"{b} - {a}", differences), "rank_sum_w": w, "rank_sum_p": p_sum, "rank_sum_method": method_sum})
    table = pd.DataFrame(rows, columns=None if rows else [*KEYS, "test", "pair", "n", "nonzero", "statistic", "p", "method"])
    if len(table):
        for _, places in table.groupby("test").groups.items():
            table.loc[places, "p_holm"] = holm(list(table.loc[places, "p"]))
            table.loc[places, "tests"] = len(places)
    return table


def conclusion(row):
    """Words on one comparison."""
    if row.test == "Friedman":
        lowest = math.factorial(int(row.freedom) + 1) ** (1 - int(row.n))  # all agree
        if lowest > LEVEL:
            return f"too small to conclude: {int(row.n)} participants never reach p < {LEVEL}"
        if row.method == APPROXIMATE_CHI and row.n < 6:
            return f"too small to conclude: p is an approximation that {int(row.n)} participants do not allow"
        if row.p_holm < LEVEL:
            return "the conditions differ"
        return ("a hint, which does not hold after Holm's correction" if row.p < LEVEL
                else "too small to conclude: no difference was found, which does not show that there is none")
    if 2 * 0.5 ** row.nonzero > LEVEL:
        return f"too small to conclude: {int(row.nonzero)} of {int(row.n)} pairs differ, and fewer than 6 never reach p < {LEVEL}"
    if row.p_holm < LEVEL:
        return "a difference"
    if row.p < LEVEL:
        return "a hint, which does not hold after Holm's correction" + \
            (f"; with {int(row.nonzero)} pairs and {int(row.tests)} tests none could" if row.tests * 2 * 0.5 ** row.nonzero > LEVEL else "")
    return "too small to conclude: no difference was found, which does not show that there is none"


def task_scores(tasks):
    """Shares of right answers and times as two scales of each task, a value a participant and condition."""
    rows = []
    keys = ["participant", "condition", "position", "phase"]
    for key, group in tasks.groupby(keys, sort=False):
        base = {**dict(zip(keys, key)), "questionnaire": "task"}
        rows.append({**base, "scale": "correct", "title": "Right answers, %", "score": 100 * group.correct.mean(), "lowest": 0, "highest": 100})
        if group.took_ms.notna().any():
            rows.append({**base, "scale": "seconds", "title": "Seconds for an answer, median",
                         "score": group.took_ms.median() / 1000, "lowest": 0, "highest": np.inf})
    return pd.DataFrame(rows)


# Figures

UNITS = {("task", "correct"): "%", ("task", "seconds"): "s"}
COLORS = ["#2c6fbb", "#d9822b", "#3a9a5b", "#8d5bb0", "#b5435a", "#6b6b6b"]


def saved(figure, path):
    figure.savefig(path, format="svg", bbox_inches="tight", metadata={"Date": None})
    pyplot.close(figure)
    text = path.read_text()
    return text[text.index("<svg"):]


def wrapped(text, width):
    lines = [""]
    for word in text.split():
        if lines[-1] and len(lines[-1]) + 1 + len(word) > width:
            lines.append("")
        lines[-1] += (" " if lines[-1] else "") + word
    return "\n".join(lines)


def box_plots(group, conditions, path):
    """One box a scale and condition, with each participant's value as a dot."""
    scales = list(group[["phase", "scale", "title"]].drop_duplicates().itertuples(index=False, name=None))
    names = conditions if (group.condition != "").any() else [""]
    columns = min(len(scales), 4)
    rows = math.ceil(len(scales) / columns)
    figure, axes = pyplot.subplots(rows, columns, figsize=(columns * max(2.2, 0.8 + 0.75 * len(names)), 3.0 * rows), squeeze=False)
    random = np.random.default_rng(SEED)
    for axis in axes.flat[len(scales):]:
        axis.set_visible(False)
    for axis, (phase, scale, title) in zip(axes.flat, scales):
        part = group[(group.phase == phase) & (group.scale == scale)]
        values = [part[part.condition == name].score.to_numpy() for name in names]
        boxes = axis.boxplot(values, widths=0.55, showfliers=False, patch_artist=True, medianprops={"color": "black", "linewidth": 2})
        for place, (box, list_, color) in enumerate(zip(boxes["boxes"], values, itertools.cycle(COLORS)), 1):
            box.set(facecolor=color, alpha=0.35)
            axis.plot(place + random.uniform(-0.16, 0.16, len(list_)), list_, "o", color=color, markersize=4.5,
                      markeredgecolor="white", markeredgewidth=0.4)
        axis.set_xticks(range(1, len(names) + 1), [name or f"all {len(values[0])}" for name in names])
        low, high = part.lowest.iloc[0], part.highest.iloc[0]
        if np.isfinite(high):
            axis.set_ylim(low - 0.04 * (high - low), high + 0.04 * (high - low))
        else:
            axis.set_ylim(bottom=0)
        axis.set_title(wrapped(title, 24), fontsize=9)
        axis.set_ylabel(UNITS.get((part.questionnaire.iloc[0], part.scale.iloc[0]), "Score"), fontsize=8)
        axis.grid(axis="y", alpha=0.3)
        axis.spines[["top", "right"]].set_visible(False)
    figure.tight_layout()
    return saved(figure, path)


def likert_color(point, low, high):
    # The middle of the map is nearly white, as the page is.
    return "#d4d4d4" if 2 * point == low + high else matplotlib.colormaps["RdBu"](0.12 + 0.76 * (point - low) / (high - low))


def likert_plot(replies, items, conditions, path):
    """A bar an item and condition: shares of each point, those above the middle to the right."""
    bars = []
    for item in items.itertuples():
        of_item = replies[replies.item == item.item]
        for condition in ["", *conditions]:
            values = of_item[of_item.condition == condition].value.dropna().astype(int)
            if len(values):
                bars.append((item, condition, values))
    if not bars:
        return ""
    low, high = int(items.lowest.min()), int(items.highest.max())
    points, middle = list(range(low, high + 1)), (low + high) / 2
    same_ends = len(set(zip(items.left, items.right))) == 1
    height = 0.9 + 0.42 * len(bars)
    figure, (words, axis) = pyplot.subplots(1, 2, figsize=(10.5, height), sharey=True, gridspec_kw={"width_ratios": (5, 7), "wspace": 0.14})
    words.axis("off")
    words.set_xlim(0, 1)
    farthest = 0.3
    for place, (item, condition, values) in enumerate(bars):
        shares = [float((values == point).mean()) for point in points]
        left = -sum(share * (1 if point < middle else 0.5 if point == middle else 0) for share, point in zip(shares, points))
        farthest = max(farthest, -left, left + 1)
        for share, point in zip(shares, points):
            if share == 0:
                continue
            axis.barh(-place, share, left=left, height=0.78, color=likert_color(point, low, high), edgecolor="white", linewidth=0.5)
            if share >= 0.06:
                axis.text(left + share / 2, -place, f"{100 * share:.0f}", ha="center", va="center", fontsize=7,
                          color="white" if abs(point - middle) > 0.3 * (high - low) else "black")
            left += share
        if place == 0 or bars[place - 1][0].item != item.item:
            of_it = [i for i, bar in enumerate(bars) if bar[0].item == item.item]
            text = wrapped(item.text, 58)
            if item.left and not same_ends:
                text += "\n" + wrapped(f"({low}: {item.left}, {high}: {item.right})", 58)
            words.text(1, -(of_it[0] + of_it[-1]) / 2, text, ha="right", va="center", fontsize=8)
            if place:
                axis.axhline(-place + 0.5, color="#ddd", linewidth=0.6)
    axis.axvline(0, color="black", linewidth=0.7, zorder=0)
    axis.set_xlim(-farthest - 0.02, farthest + 0.02)
    axis.set_ylim(-len(bars) + 0.4, 0.6)
    axis.set_yticks([-i for i in range(len(bars))], [condition for _, condition, _ in bars], fontsize=8)
    axis.tick_params(axis="y", length=0, labelleft=True)
    axis.xaxis.set_major_formatter(lambda x, _: f"{abs(100 * x):.0f} %")
    axis.spines[["top", "right", "left"]].set_visible(False)
    ends = {low: items.left.iloc[0], high: items.right.iloc[0]} if same_ends else {}
    handles = [matplotlib.patches.Patch(color=likert_color(point, low, high), label=f"{point}: {ends[point]}" if ends.get(point) else str(point))
               for point in points]
    figure.legend(handles=handles, ncol=len(points), loc="upper center", bbox_to_anchor=(0.5, 0.11 - 0.45 / height), fontsize=8,
                  frameon=False, handlelength=1)
    return saved(figure, path)


def choice_plot(replies, item, path):
    choices = item.choices.split(" | ")
    values = replies[replies.item == item.item].value.dropna().astype(int)
    counts = [int((values == i + 1).sum()) for i in range(len(choices))]
    figure, axis = pyplot.subplots(figsize=(6.5, 0.55 + 0.28 * len(choices)))
    axis.barh(range(len(choices)), counts, color=COLORS[0], height=0.7)
    for place, count in enumerate(counts):
        axis.text(count + 0.06, place, f"{count} ({100 * count / max(1, sum(counts)):.0f} %)", va="center", fontsize=8)
    axis.set_yticks(range(len(choices)), choices, fontsize=8)
    axis.set_xlim(0, max([*counts, 1]) * 1.25)
    axis.invert_yaxis()
    axis.xaxis.set_major_locator(matplotlib.ticker.MaxNLocator(integer=True))
    axis.set_xlabel("Participants", fontsize=8)
    axis.spines[["top", "right"]].set_visible(False)
    axis.set_title(item.text, fontsize=9, loc="left")
    return saved(figure, path)


# The page

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


def tell(text):
    """Progress, where somebody waits for it."""
    if sys.stderr.isatty():
        print(text, file=sys.stderr)


def read(folder, name):
    numbers = {column: [""] for column in ("took_ms", "value", "score")}
    return pd.read_csv(folder / name, keep_default_na=False, na_values=numbers,
                       dtype={"participant": str, "condition": str, "reply": str, "position": str, "choices": str, "left": str, "right": str})


METHOD = f"""<p>Quartiles interpolate linearly. Two conditions are compared within participants by Wilcoxon's signed-rank test, two-sided; differences of 0 do not
count, and tied ranks are averaged. p is exact, by all permutations, also of Friedman's test; where a ~ follows, it is the normal or the chi-squared approximation. Holm's correction covers all tests of one
kind in this report. The effect r is the rank-biserial correlation of matched pairs, with the interval of a percentile bootstrap ({RESAMPLES} samples of
participants), not corrected for the number of comparisons; there is none where all differ in one direction. "n needed" is the number of pairs, at a single test, with which a difference as large as the one seen would be found with a probability of {100 * POWER:.0f} %;
the differences of small studies vary much, and so does this number. The rank-sum test stands beside them for comparison with studies that report it; it does
not know that the same people saw both conditions.</p>
<p>A scale that lacks a reply has no value. The time of a step during which the program was started again is left out. Tables: participants.csv, replies.csv,
scores.csv, tasks.csv, items.csv, descriptions.csv, statistics.csv.</p>"""


def write_report(folder):
    study = json.loads((folder / "study.json").read_text())
    participants, scores, replies, tasks, items = (read(folder, f"{name}.csv") for name in ("participants", "scores", "replies", "tasks", "items"))
    conditions = [condition["name"] for condition in study.get("conditions") or []]
    parts = [part for part in (scores, preferences(replies, participants, conditions), task_scores(tasks)) if len(part)]
    scores = in_order(pd.concat(parts, ignore_index=True) if parts else scores, conditions)
    tell("comparing conditions ...")
    descriptions, comparisons = described(scores), compared(scores, conditions)
    descriptions.to_csv(folder / "descriptions.csv", index=False)
    comparisons.to_csv(folder / "statistics.csv", index=False)

    agreed = int((participants.state != "declined").sum())
    page = [f"<h1>{html.escape(study['title'])}</h1>",
            f"<p>{people(agreed)} agreed, {int((participants.state == 'complete').sum())} of them completed the study. "
            + (f"Order of conditions: {html.escape(study['order'])}, seed {study['seed']}.</p>" if conditions else "</p>"),
            f"<p class='note'>{size_note(agreed, len(conditions), complete_pairs(comparisons))}</p>"]
    if note := order_note(participants, len(conditions)):
        page.append(f"<p class='note'>{html.escape(note)}</p>")
    if study["left_out"]:
        page.append(f"<p class='note'>Left out, because they began with another text of the protocol: {html.escape(', '.join(study['left_out']))}.</p>")
    if conditions:
        page.append(table_text(["Condition", "Values"], [[c["name"], c["values"]] for c in study["conditions"]], 2))

    def section(key, title, figures):
        tell(f"{title} ...")
        part = scores[scores.questionnaire == key]
        page.append(f"<h2>{html.escape(title)}</h2>")
        if len(part):
            page.append(description_table(descriptions[descriptions.questionnaire == key], (part.condition != "").any()))
            page.append(f"<figure>{box_plots(part, conditions, folder / f'boxes-{key}.svg')}</figure>")
            page.extend(comparison_tables(comparisons[comparisons.questionnaire == key] if len(comparisons) else comparisons))
        page.extend(figures)

    asked = {key: place for place, key in enumerate(dict.fromkeys(replies.questionnaire))}
    for key, of_it in sorted(items.groupby("questionnaire", sort=False), key=lambda part: asked.get(part[0], len(asked))):
        figures, replied = [], replies[replies.questionnaire == key]
        points = of_it[of_it.choices == ""]
        if len(points) and (points.highest - points.lowest).max() <= 10 and (figure := likert_plot(replied, points, conditions, folder / f"likert-{key}.svg")):
            figures.append(f"<h3>Replies in per cent, as given (reversed items are not turned)</h3><figure>{figure}</figure>")
        for item in of_it[of_it.choices != ""].itertuples():
            if len(replied[replied.item == item.item]):
                figures.append(f"<figure>{choice_plot(replied, item, folder / f'choice-{key}-{item.item}.svg')}</figure>")
        section(key, of_it.questionnaire_title.iloc[0], figures)
        if study["sources"].get(key):
            page.append(f"<p><small>{html.escape(study['sources'][key])}</small></p>")
    if len(tasks):
        section("task", "Task with bricks", [])
    page.append("<h2>Participants</h2>")
    page.append(table_text(["Pseudonym", "State", "Order", "Steps", "Minutes"],
                           [[r.participant, r.state, r.order, f"{r.replied} of {r.steps}", f"{r.minutes:.1f}"] for r in participants.itertuples()], 3))
    page += ["<h2>How this was computed</h2>", METHOD]
    (folder / "report.html").write_text(
        f"<!doctype html><html lang='en'><meta charset='utf-8'><title>{html.escape(study['title'])}</title><style>{STYLE}</style><body>\n" + "\n".join(page)
        + "\n</body></html>\n")


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    matplotlib.rcParams.update({"svg.hashsalt": "theatron", "svg.fonttype": "none", "font.family": "sans-serif", "font.size": 9})
    write_report(pathlib.Path(sys.argv[1]))


if __name__ == "__main__":
    main()
