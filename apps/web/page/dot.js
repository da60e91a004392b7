// SPDX-License-Identifier: Apache-2.0
// The dot that says how the picture is: its colour, its shape, and the age of the picture in words.
import { language, text } from "./texts.js";

const old_ms = 500, not_live_ms = 2000;  // as the client warns (src/viewer/facts.cpp)

const tenths = new Intl.NumberFormat(language, { minimumFractionDigits: 1, maximumFractionDigits: 1 });

export function seconds(ms) {
    return ms < 9950 ? text("seconds", { s: tenths.format(Math.max(ms, 100) / 1000) })
        : ms < 120000 ? text("seconds", { s: Math.floor(ms / 1000) }) : text("minutes", { min: Math.floor(ms / 60000) });
}

// { level, words }: "good" is a circle, "slow" a triangle, "bad" a square. `unrest` as Notices.at() gives it.
export function judge({ phase, has_picture, age_ms, is_not_live, is_slow, overlay }, unrest) {
    if (phase !== "joined")
        return { level: "bad", words: text(phase === "connecting" || phase === "waiting" ? "dot_connecting" : "dot_no_connection") };
    if (is_not_live)
        return { level: "bad", words: text("dot_not_live") };
    if (!has_picture)
        return { level: "slow", words: text("dot_no_picture") };
    const words = age_ms === null ? text("dot_unknown") : seconds(age_ms);
    if (age_ms >= not_live_ms || (overlay.warning && !is_slow))
        return { level: "bad", words };
    return { level: age_ms >= old_ms || is_slow || unrest > 0 ? "slow" : "good", words };
}

const meanings = { good: "dot_good", slow: "dot_slow", bad: "dot_bad" };

// Changes in place: nothing of it is read aloud by itself.
export function show_dot(button, { level, words }) {
    button.dataset.level = level;
    const label = button.querySelector("span");
    if (label.textContent !== words)
        label.textContent = words;
    const name = text("labelled", { label: words, value: text(meanings[level]) });
    if (button.title !== name) {
        button.title = name;
        button.setAttribute("aria-label", name);
    }
}
