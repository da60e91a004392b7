# SPDX-License-Identifier: Apache-2.0
"""Figures of a study as SVG: boxes of scores, bars of replies, counts of choices. Each returns the text of the picture that it wrote."""
import itertools
import math

import matplotlib
from matplotlib import pyplot
import numpy as np

from rank_statistics import SEED

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
