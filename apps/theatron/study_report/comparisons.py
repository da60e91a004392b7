# SPDX-License-Identifier: Apache-2.0
"""Tables of a study: scores described by scale and condition, and conditions compared."""
import itertools
import math

import numpy as np
import pandas as pd

from rank_statistics import (APPROXIMATE_CHI, LEVEL, friedman, friedman_exact, holm, needed_pairs, nonzero, quartiles, rank_biserial,
                             rank_biserial_interval, rank_sum, signed_rank)

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
