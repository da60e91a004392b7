// SPDX-License-Identifier: Apache-2.0
// The panels around the picture, from the client's state. Texts of others are only ever text.
import { judge, seconds, show_dot } from "./dot.js";
import { set_text } from "./set_text.js";
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

// The other buttons of the bar change their titles.
const icon_titles = { point: "point_title", draw: "draw_title", show_case: "show_case_title", show_people: "show_people_title",
                      next_camera: "next_camera_title", leave: "leave_title", show_more: "show_more_title" };

export function fill_texts() {
    for (const place of document.querySelectorAll("[data-text]"))
        place.textContent = text(place.dataset.text);
    for (const place of document.querySelectorAll("[data-name]"))
        place.setAttribute("aria-label", text(place.dataset.name));
    for (const [id, title] of Object.entries(icon_titles))
        name_icon($(id), text(title));
    $("help_list").replaceChildren();
    for (const [keys, meaning] of by_touch() ? texts.touches : texts.keys)
        $("help_list").append(element("dt", keys), element("dd", meaning));
}

// Names a button that has an icon, for the pointer and for a screen reader.
function name_icon(button, name) {
    if (button.title === name)
        return;
    button.title = name;
    button.setAttribute("aria-label", name);
}

// Rebuilds `place` only if `content` is another one, so that focus and scrolling stay.
const shown = new Map();
function update(place, content, fill) {
    const key = JSON.stringify([content, by_touch()]);
    if (shown.get(place.id) === key)
        return;
    shown.set(place.id, key);
    const focus = document.activeElement?.dataset?.place;
    const had_focus = place.id === "study" && place.contains(document.activeElement);
    // Another step of a study has other buttons, even where they have the same place.
    const is_other = place.dataset.keyboard !== String(content?.[0]?.keyboard);
    place.dataset.keyboard = content?.[0]?.keyboard;
    place.replaceChildren();
    fill(place, content);
    const same = focus && [...place.querySelectorAll("button")].find(button => button.dataset.place === focus);
    // A key that is pressed once more must press no other button.
    if (had_focus && (is_other || !same))
        place.focus();
    else if (same)
        same.focus();
}

// The room's panels are not rebuilt while one of their buttons is pressed: the click would be lost.
let is_pressed = false;
for (const id of ["room_panels", "study", "shared_screen"])
    $(id).addEventListener("pointerdown", () => is_pressed = true);
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

// A row of buttons alone belongs to the text above it, unless it says its own.
function subject_of(panel, i) {
    return panel.rows[i].subject ?? panel.rows.slice(0, i + 1).findLast(({ text }) => text)?.text ?? "";
}

function place_of(panel, i) {
    return `${panel.title}/${subject_of(panel, i)}`;
}

const age = ms => ms === null ? "–" : seconds(ms);  // the session's time may not be known yet

function fill_cameras(list, cameras) {
    for (const camera of cameras) {
        const row = element("li");
        const state = texts.states[camera.state] ?? camera.state;
        row.append(element("span", text("labelled", { label: camera.name, value: state }), camera.state === "live" ? "" : "warning"),
                   element("div", camera.line, "detail"), element("div", camera.detail, "detail"));
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
            for (const [i, { label, command, leads_away }] of row.buttons.entries()) {
                const chosen = /^\[(.+)\]$/.exec(label);  // as the client marks the chosen tool
                const button = element("button", chosen?.[1] ?? label);
                if (chosen)
                    button.setAttribute("aria-pressed", "true");
                button.dataset.command = command;
                button.toggleAttribute("data-leads-away", leads_away);
                button.dataset.label = `${place_of(panel, at)}/${label}`;
                button.dataset.place = `${place_of(panel, at).split(/[:,] /)[0]}/${i}`;
                const subject = subject_of(panel, at);
                if (subject)
                    button.setAttribute("aria-label", text("labelled", { label: button.textContent, value: subject }));
                buttons.append(button);
            }
            if (row.buttons.length)
                item.append(buttons);
            list.append(item);
        }
        // The sheet has this title already.
        if (panel.title !== $("sheet_title").textContent)
            section.append(element("h3", panel.title));
        section.append(list);
        place.append(section);
    }
}

function fill_facts(place, facts) {
    for (const { label, value, warning } of facts) {
        if (value === "F1" && by_touch())
            continue;  // it names a key
        const fact = element("span");
        fact.append(element("span", text("labelled", { label, value: "" }), "label"), element("span", value, warning ? "warning" : ""));
        place.append(fact);
    }
}

// The microphone's button and state, and who speaks at present.
export function show_voices(voice, { people = [], is_heard, is_muted, is_recorded, may_speak = true, voice_may_record = null }) {
    const button = $("microphone");
    const is_open = voice.microphone === "open";
    set_text(button.querySelector("span"), text(is_open ? "mute" : "speak"));
    name_icon(button, text(is_open ? "mute_title" : "speak_title"));
    button.setAttribute("aria-pressed", String(is_open));
    button.hidden = $("push_to_talk").hidden = !may_speak && !is_open;
    $("push_to_talk").setAttribute("aria-pressed", String(voice.pushes));
    $("talk").hidden = !is_open || !voice.pushes || voice.hands_free;
    $("talk").setAttribute("aria-pressed", String(voice.is_held));
    $("voice_recording").hidden = voice_may_record === null || !may_speak;
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
    const is_on = face.state === "on";
    $("own_face").hidden = !is_on;
    $("webcam").setAttribute("aria-pressed", String(is_on));
    name_icon($("webcam"), text(is_on ? "webcam_off_title" : "webcam_on_title"));
    set_text($("face_hint"), face.state === "asking" ? text("face_asking") : face_problem(face, way));
}

// The button, the panel that says so while a screen is shown, and why none is.
export function show_own_screen(screen, { phase, may_show_screen, screen: told }) {
    const is_on = screen.state === "on";
    set_text($("own_screen_text"), text(phase === "joined" && told?.is_taken ? "screen_on" : "screen_waits"));
    $("own_screen").hidden = !is_on;
    $("share_screen").hidden = !screen.constructor.is_supported() || (!may_show_screen && !is_on);
    set_text($("share_screen"), text(is_on ? "end_own_screen" : "share_screen"));
    set_text($("share_hint"), { asking: text("screen_asking"), refused: text("screen_refused") }[screen.state] ?? "");
}

// The kinds of the client's panels that each of the page's panels has, from top to bottom.
const kinds = { people: ["door", "call", "people", "screens", "sound", "places"], case: ["case"], draw: ["marks"], more: ["past"] };

const of_kind = (overlay, kind) => overlay.panels.filter(panel => panel.kind === kind);
export const has_draw_tools = overlay => of_kind(overlay, "marks").length > 0;

// Shows what the role and the way of seeing allow.
function show_buttons(state, way) {
    const is_flat = way === "flat";
    $("webcam").hidden = is_flat || !state.may_be_seen;
    $("point").hidden = !state.may_point;
    $("draw").hidden = !state.may_handle;
    $("show_case").hidden = is_flat;
    $("next_camera").hidden = !is_flat;
    $("save_picture").disabled = !state.has_picture;
    $("draw").setAttribute("aria-pressed", String(has_draw_tools(state.overlay)));
    for (const key of ["r", "n"])
        document.querySelector(`#more [data-key="${key}"]`).hidden = is_flat || (key === "n" && !state.may_handle);
}

// The panel of the tools comes and goes with them.
let was_drawing = false;
function follow_drawing(overlay, sheet) {
    const is_on = has_draw_tools(overlay);
    if (is_on && !was_drawing)
        sheet.open("draw");
    if (!is_on && sheet.name === "draw" && !overlay.message)
        sheet.close();
    was_drawing = is_on;
}

// These are shown whatever else is hidden: a recording, a person at the door, a call.
function show_chips({ overlay, is_past }) {
    const fact_of = kind => overlay.facts.find(fact => fact.kind === kind);
    const recorded = fact_of("recording"), door = fact_of("door"), [call] = of_kind(overlay, "call");
    set_text($("recorded"), recorded ? text("labelled", recorded) : "");
    set_text($("door"), door ? text("labelled", door) : "");
    $("door").hidden = !door;
    set_text($("call"), call ? text("labelled", { label: call.rows.map(row => row.text).join(", "), value: call.title }) : "");
    $("call").hidden = !call;
    $("back_to_live").hidden = !is_past;
}

function show_details(state, signs) {
    update($("signs"), signs, (place, lines) => place.append(...lines.map(line => element("li", line))));
    update($("facts"), state.overlay.facts, fill_facts);
    $("cameras").hidden = state.cameras.length === 0;
    // Without a connection no camera is live, whatever the host said last.
    const is_connected = state.phase === "joined";
    const details = of_kind(state.overlay, "cameras").flatMap(panel => panel.rows.map(row => row.detail));
    update($("camera_list"), state.cameras.map(({ name, state, is_asked_for, frames, fps, age_ms }, i) => ({
        name, state: is_connected || state !== "live" ? state : "stale", detail: details[i] ?? "",
        line: !is_connected ? text("no_connection") : !is_asked_for ? text("not_shown") : frames ? text("camera_line", { fps: Math.round(fps), age: age(age_ms) }) : text("no_picture"),
    })), fill_cameras);
}

// Beside the other panels, until the study ends. A screen reader says each new question.
function show_study(panels) {
    $("study").hidden = panels.length === 0;
    update_panels($("study"), panels);
    set_text($("study_news"), panels[0]?.rows[0]?.text ?? "");
}

// `sheet` is the page's Sheet, `notices` its Notices; `way` is "room" or "flat",
// and `once` has sentences of the page itself, such as why another way than before is shown.
export function show(state, { sheet, notices, way, once, now_ms }) {
    const { overlay } = state;
    set_text($("message"), [overlay.message, overlay.detail].filter(Boolean).join("\n"));
    // That a picture is not of the present is said as long as it is so.
    const played = overlay.facts.find(fact => fact.kind === "not_live");
    set_text($("not_live"), !state.is_not_live ? "" : overlay.warning || (played ? text("labelled", played) : ""));
    const { shown, warning, unrest } = notices.at(now_ms, {
        warning: state.is_not_live ? "" : overlay.warning, notice: overlay.notice, of_camera: state.is_of_camera, once });
    set_text($("notice"), shown.join("\n"));
    show_dot($("dot"), judge(state, unrest));
    show_chips(state);
    show_buttons(state, way);
    follow_drawing(overlay, sheet);
    if (way === "flat" && sheet.name === "case")
        sheet.close();  // nothing of them is in this view
    show_details(state, [warning, unrest ? text("unrest", { count: unrest }) : ""].filter(Boolean));
    show_study(of_kind(overlay, "study"));
    update_panels($("shared_screen"), of_kind(overlay, "shared"));
    sheet.entitle();
    update_panels($("room_panels"), (kinds[sheet.name] ?? []).flatMap(kind => of_kind(overlay, kind)));
}
