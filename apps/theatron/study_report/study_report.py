#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Statistics and figures of a study, from the tables that `theatron study report` has written.

    study_report.py FOLDER

FOLDER has participants.csv, scores.csv, replies.csv, tasks.csv, items.csv and study.json; statistics.csv, descriptions.csv,
figures as SVG and report.html come there. The statistics are SciPy's; docs/studies.md says which and why.
"""
import html
import json
import pathlib
import sys

try:
    import matplotlib
    import pandas as pd
    import scipy.stats
    matplotlib.use("svg")
except ImportError as missing:
    sys.exit(f"The report needs {missing.name or 'a package'}, which is missing; install it with: "
             "sudo apt install python3-scipy python3-pandas python3-matplotlib")

from comparisons import compared, described, in_order, preferences, task_scores
from figures import box_plots, choice_plot, likert_plot
from page import METHOD, STYLE, comparison_tables, complete_pairs, description_table, order_note, people, size_note, table_text


def tell(text):
    """Progress, where somebody waits for it."""
    if sys.stderr.isatty():
        print(text, file=sys.stderr)


def read(folder, name):
    numbers = {column: [""] for column in ("took_ms", "value", "score")}
    return pd.read_csv(folder / name, keep_default_na=False, na_values=numbers,
                       dtype={"participant": str, "condition": str, "reply": str, "position": str, "choices": str, "left": str, "right": str})


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
