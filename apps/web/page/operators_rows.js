// SPDX-License-Identifier: Apache-2.0
// Lists of the operators' page that follow the host's facts, without taking the focus or a question from a row that stays.

const sure_ms = 5000;

// A second click within this time is the second half of a double click.
export const double_click_ms = 500;

// Makes, moves and removes the children of `list`: one for each of `items`, by `key_of`. `make` fills a new `li`,
// `update` sets what may change in it.
export function follow_rows(list, items, key_of, make, update) {
    const rows = new Map([...list.children].map(row => [row.dataset.key, row]));
    const seen = new Set();
    items.filter(item => !seen.has(key_of(item)) && seen.add(key_of(item))).forEach((item, at) => {
        const key = String(key_of(item));
        let row = rows.get(key);
        rows.delete(key);
        if (!row) {
            row = document.createElement("li");
            row.dataset.key = key;
            make(row, item);
        }
        update(row, item);
        if (list.children[at] !== row)
            list.insertBefore(row, list.children[at] ?? null);
    });
    for (const row of rows.values()) {
        const next = row.contains(document.activeElement) ? row.nextElementSibling ?? row.previousElementSibling : null;
        row.remove();
        next?.querySelector("button")?.focus();
    }
}

export function add_words(row) {
    const words = document.createElement("div");
    words.className = "words";
    row.append(words);
    const buttons = document.createElement("div");
    buttons.className = "buttons";
    row.append(buttons);
    return { words, buttons };
}

// `sure`: asks by this word, and acts at a second click within some seconds.
export function add_button(parent, id, word, act, sure = null) {
    const button = document.createElement("button");
    button.type = "button";
    button.dataset.does = id;
    parent.append(button);
    return set_button(button, word, act, sure);
}

export function set_button(button, word, act, sure = null) {
    button.textContent = word;
    let timer = null, asked_at = 0;
    const be_calm = button.be_calm = () => {
        clearTimeout(timer);
        timer = null;
        button.textContent = word;
        button.classList.remove("sure");
    };
    const ask = () => {
        button.textContent = sure;
        button.classList.add("sure");
        timer = setTimeout(be_calm, sure_ms);
        asked_at = performance.now();
    };
    button.addEventListener("click", () => {
        if (timer && performance.now() - asked_at < double_click_ms)
            return;
        if (timer)
            be_calm();
        else if (sure)
            return ask();
        act();
    });
    button.addEventListener("blur", () => timer && be_calm());
    return button;
}
