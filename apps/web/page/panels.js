// SPDX-License-Identifier: Apache-2.0
// The panels around the picture, from the client's state. Texts of others are only ever text.
import { text, texts } from "./texts.js";

const $ = id => document.getElementById(id);

function element(tag, content = "", name = "") {
    const made = document.createElement(tag);
    made.textContent = content;
    if (name)
        made.className = name;
    return made;
}

export function fill_texts() {
    for (const place of document.querySelectorAll("[data-text]"))
        place.textContent = text(place.dataset.text);
    for (const [keys, meaning] of texts.keys)
        $("help_list").append(element("dt", keys), element("dd", meaning));
}

// Rebuilds `place` only if `content` is another one, so that focus and scrolling stay.
const shown = new Map();
function update(place, content, fill) {
    const key = JSON.stringify(content);
    if (shown.get(place.id) === key)
        return;
    shown.set(place.id, key);
    const focus = document.activeElement?.dataset?.label;
    place.replaceChildren();
    fill(place, content);
    if (focus)
        [...place.querySelectorAll("button")].find(button => button.dataset.label === focus)?.focus();
}

function set_text(place, content) {
    if (place.textContent !== content)
        place.textContent = content;
}

function age(ms) {
    return ms < 1000 ? `${Math.round(ms / 10) * 10} ms` : `${Math.floor(ms / 1000)} s`;
}

function fill_cameras(list, cameras) {
    for (const camera of cameras) {
        const row = element("li");
        const state = texts.states[camera.state] ?? camera.state;
        row.append(element("span", `${camera.name}: ${state}`, camera.state === "live" ? "" : "warning"),
                   element("div", camera.line, "detail"));
        list.append(row);
    }
}

function fill_panels(place, panels) {
    for (const panel of panels) {
        const section = element("section", "", "panel");
        const list = element("ul");
        for (const row of panel.rows) {
            const item = element("li", row.text);
            if (row.detail)
                item.append(element("div", row.detail, "detail"));
            const buttons = element("div", "", "buttons");
            for (const { label, command } of row.buttons) {
                const button = element("button", label);
                button.dataset.command = command;
                button.dataset.label = `${panel.title}/${row.text}/${label}`;
                if (row.text)
                    button.setAttribute("aria-label", `${label}: ${row.text}`);
                buttons.append(button);
            }
            if (row.buttons.length)
                item.append(buttons);
            list.append(item);
        }
        section.append(element("h2", panel.title), list);
        place.append(section);
    }
}

function fill_facts(place, facts) {
    for (const { label, value, warning } of facts) {
        const fact = element("span");
        fact.append(element("span", `${label}: `, "label"), element("span", value, warning ? "warning" : ""));
        place.append(fact);
    }
}

export function show(state) {
    const { overlay } = state;
    set_text($("message"), [overlay.message, overlay.detail].filter(Boolean).join("\n"));
    set_text($("notice"), [overlay.warning, overlay.notice].filter(Boolean).join("\n"));
    update($("facts"), overlay.facts, fill_facts);
    $("cameras").hidden = state.cameras.length === 0;
    update($("camera_list"), state.cameras.map(({ name, state, depth_frames, fps, age_ms }) => ({
        name, state,
        line: depth_frames ? text("camera_line", { fps: Math.round(fps), age: age(age_ms) }) : text("no_picture"),
    })), fill_cameras);
    update($("room_panels"), overlay.panels, fill_panels);
}
