// SPDX-License-Identifier: Apache-2.0
// The panels around the picture, from the client's state. Texts of others are only ever text.
import { text, texts } from "./texts.js";
import { by_touch } from "./touch_mode.js";

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
    for (const place of document.querySelectorAll("[data-name]"))
        place.setAttribute("aria-label", text(place.dataset.name));
    $("help_list").replaceChildren();
    for (const [keys, meaning] of by_touch() ? texts.touches : texts.keys)
        $("help_list").append(element("dt", keys), element("dd", meaning));
}

// Rebuilds `place` only if `content` is another one, so that focus and scrolling stay.
const shown = new Map();
function update(place, content, fill) {
    const key = JSON.stringify([content, by_touch()]);
    if (shown.get(place.id) === key)
        return;
    shown.set(place.id, key);
    const focus = document.activeElement?.dataset?.place;
    place.replaceChildren();
    fill(place, content);
    if (focus)
        [...place.querySelectorAll("button")].find(button => button.dataset.place === focus)?.focus();
}

// The room's panels are not rebuilt while one of their buttons is pressed: the click would be lost.
let is_pressed = false;
$("room_panels").addEventListener("pointerdown", () => is_pressed = true);
for (const end of ["pointerup", "pointercancel"])
    addEventListener(end, () => setTimeout(() => is_pressed = false), true);  // behind the click

// Rows without buttons, such as those with the cameras' ages, change in place.
function update_panels(place, panels) {
    if (is_pressed)
        return;
    update(place, panels.map(panel => ({ ...panel, rows: panel.rows.map(row => row.buttons.length ? row : { buttons: [] }) })),
           () => fill_panels(place, panels));
    for (const [i, panel] of panels.entries())
        for (const [j, row] of panel.rows.entries()) {
            const item = place.children[i].querySelector("ul").children[j];
            set_text(item.firstElementChild, row.text);
            set_text(item.querySelector(".detail"), row.detail);
        }
}

// The command of a button as the newest state has it. Null if it is gone, so that no click meets another row.
export function command_of(button, panels) {
    const all = panels.flatMap(panel => panel.rows.flatMap((row, i) => row.buttons.map(({ label, command }) => ({
        name: `${place_of(panel, i)}/${label}`, command }))));
    const same = all.filter(({ name }) => name === button.dataset.label);
    const chosen = same.length === 1 ? same[0] : same.find(({ command }) => command === Number(button.dataset.command));
    return chosen?.command ?? null;
}

// A row of buttons alone belongs to the text above it.
function subject_of(panel, i) {
    return panel.rows.slice(0, i + 1).findLast(({ text }) => text)?.text ?? "";
}

function place_of(panel, i) {
    return `${panel.title}/${subject_of(panel, i)}`;
}

function set_text(place, content) {
    if (place.textContent !== content)
        place.textContent = content;
}

function age(ms) {
    if (ms === null)
        return "–";  // the session's time is not known yet
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
        for (const [at, row] of panel.rows.entries()) {
            const item = element("li");
            item.append(element("div", row.text), element("div", row.detail, "detail"));
            const buttons = element("div", "", "buttons");
            for (const [i, { label, command }] of row.buttons.entries()) {
                const button = element("button", label);
                button.dataset.command = command;
                button.dataset.label = `${place_of(panel, at)}/${label}`;
                button.dataset.place = `${place_of(panel, at).split(/[:,] /)[0]}/${i}`;
                const subject = subject_of(panel, at);
                if (subject)
                    button.setAttribute("aria-label", `${label}: ${subject}`);
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
        if (label === "Help" && by_touch())
            continue;  // it names a key
        const fact = element("span");
        fact.append(element("span", `${label}: `, "label"), element("span", value, warning ? "warning" : ""));
        place.append(fact);
    }
}

// The microphone's button and state, and who speaks at present.
export function show_voices(voice, { people = [], is_heard, is_muted, is_recorded, voice_may_record = null }) {
    const button = $("microphone");
    const is_open = voice.microphone === "open";
    set_text(button, text(is_open ? "microphone_close" : "microphone_open"));
    button.setAttribute("aria-pressed", String(is_open));
    $("push_to_talk").setAttribute("aria-pressed", String(voice.pushes));
    $("talk").hidden = !is_open || !voice.pushes || voice.hands_free;
    $("talk").setAttribute("aria-pressed", String(voice.is_held));
    $("voice_recording").hidden = voice_may_record === null;
    $("voice_recording").setAttribute("aria-pressed", String(voice_may_record === true));
    const recorded = !is_open || !is_heard || !is_recorded || voice_may_record === null ? ""
        : text(voice_may_record ? "voice_is_recorded" : "voice_is_not_recorded");
    set_text($("voice_recorded"), recorded);
    $("voice_recorded").classList.toggle("warning", voice_may_record === true);
    const hint = !voice.constructor.is_supported() ? "no_voice"
        : voice.problem ? "no_sound"
        : voice.microphone === "denied" ? "microphone_denied"
        : voice.microphone === "missing" ? "microphone_missing"
        : voice.microphone === "asking" ? "microphone_asking"
        : is_open && is_muted ? "muted"
        : is_open && !is_heard ? "not_heard" : "";
    set_text($("voice_hint"), hint ? text(hint, { why: voice.problem }) : "");
    const names = people.filter(({ id, self }) => !self && voice.is_speaking(id)).map(({ name }) => name);
    set_text($("speaking"), names.length ? text("speaking", { names: names.join(", ") }) : "");
}

// Why the person's own picture is not sent; empty while it is, and where nobody asked for it.
export function face_problem(face, way) {
    const hint = way === "flat" && $("shows_face").checked ? "face_flat"
        : face.state === "denied" ? "face_denied"
        : face.state === "missing" ? "face_missing" : "";
    return hint && text(hint);
}

export function show_face(face, way) {
    $("own_face").hidden = face.state !== "on";
    set_text($("face_hint"), face.state === "asking" ? text("face_asking") : face_problem(face, way));
}

export function show(state) {
    const { overlay } = state;
    set_text($("message"), [overlay.message, overlay.detail].filter(Boolean).join("\n"));
    set_text($("notice"), [overlay.warning, overlay.notice].filter(Boolean).join("\n"));
    update($("facts"), overlay.facts, fill_facts);
    $("cameras").hidden = state.cameras.length === 0;
    // Without a connection no camera is live, whatever the host said last.
    const is_connected = state.phase === "joined";
    update($("camera_list"), state.cameras.map(({ name, state, is_asked_for, frames, fps, age_ms }) => ({
        name, state: is_connected || state !== "live" ? state : "stale",
        line: !is_connected ? text("no_connection") : !is_asked_for ? text("not_shown") : frames ? text("camera_line", { fps: Math.round(fps), age: age(age_ms) }) : text("no_picture"),
    })), fill_cameras);
    update_panels($("room_panels"), overlay.panels);
}
