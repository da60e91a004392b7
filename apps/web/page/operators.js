// SPDX-License-Identifier: Apache-2.0
// The page of a host's operators (docs/operators_page.md): its cameras, people, links, sessions and a recording, by the token
// of an operator's link in a header. The token stands behind '#' in the address, which no request and no referrer contains.
import { ask_host, draw_answer } from "./host_request.js";
import { Links } from "./operators_links.js";
import { add_button, add_words, double_click_ms, follow_rows, set_button } from "./operators_rows.js";
import { text } from "./operators_texts.js";
import { language, texts } from "./texts.js";

const $ = id => document.getElementById(id);
const every_ms = 2000, patience_ms = 5000;
const late_ms = 1000;          // an older picture's age is told
const little_bytes = 5e9;      // free, of which a warning is worth
const least_rate_seconds = 5;  // of a recording that tells how fast the disk fills

const phase_texts = { none: "recording_none", running: "recording_running", ending: "recording_ending", whole: "recording_whole",
                      incomplete: "recording_incomplete", failed: "recording_failed" };

const token = new URLSearchParams(location.hash.slice(1)).get("join") ?? "";
let session_number = null;  // that is shown; null: the one of the link
let facts = null;           // the host's newest answer
let asked = 0;              // an answer of an older one is late
let newest = { path: "", at_ms: -double_click_ms };  // request to do something

function ask(path, options = {}) {
    return ask_host(token, `/operators/${path}`, { signal: AbortSignal.timeout?.(patience_ms), ...options });
}

function with_session(path) {
    return session_number === null ? path : `${path}${path.includes("?") ? "&" : "?"}session=${session_number}`;
}

// Asks the host to do something. Resolves to its answer's JSON, {} without one, or null where it refused.
// The second half of a double click, which asks for the same, is not sent.
async function act(path) {
    const now_ms = performance.now();
    if (path === newest.path && now_ms - newest.at_ms < double_click_ms)
        return null;
    newest = { path, at_ms: now_ms };
    tell("");
    try {
        const answer = await ask(with_session(path), { method: "POST" });
        const body = await answer.text();
        if (!answer.ok) {
            tell(body.trim() || answer.statusText);
            return null;
        }
        return body ? JSON.parse(body) : {};
    } catch {
        tell(text("silent"));
        return null;
    } finally {
        follow();
    }
}

function tell(sentence) {
    $("problem").textContent = sentence;
    $("problem").hidden = !sentence;
}

const links = new Links(act, () => shown_session().name);

// The host's answer decides what is shown; false where it will not show anything by this link.
async function follow() {
    const turn = ++asked;
    let answer;
    try {
        answer = await ask("facts");
        if (answer.ok)
            facts = await answer.json();
    } catch {
        answer = null;
    }
    if (turn !== asked)
        return true;
    const why_closed = { 401: "no_link", 403: "for_operators", 410: "link_expired" }[answer?.status];
    if (why_closed) {
        $("all").hidden = true;
        links.hide();
        tell(text(why_closed));
        return false;
    }
    document.body.classList.toggle("silent", !answer?.ok);
    if (!answer?.ok) {
        tell(text("silent"));
        show_silence();
    } else {
        if ($("problem").textContent === text("silent") || $("all").hidden)
            tell("");
        show();
    }
    return true;
}

const shown_session = () => facts.sessions.find(({ number, is_own }) => session_number === null ? is_own : number === session_number)
    ?? facts.sessions.find(({ is_own }) => is_own);

// Rows of two sessions may have the same names and numbers.
function show_other_session(number) {
    session_number = number;
    links.leave_session();
    for (const list of ["cameras", "people", "visitors", "problems"])
        $(list).replaceChildren();
    $("stop_recording").be_calm();
}

function show() {
    if (session_number !== null && !facts.sessions.some(({ number }) => number === session_number))
        show_other_session(null);  // it has ended
    const session = shown_session();
    $("all").hidden = false;
    $("session_title").textContent = session.name;
    document.title = `${session.name} · ${text("title")}`;
    show_sessions(session);
    const problems = [...(session.ended ? [text("session_ended")] : []), ...session.problems];
    follow_rows($("problems"), problems.map(sentence => ({ sentence })), ({ sentence }) => sentence,
                (row, { sentence }) => row.textContent = sentence, () => {});
    show_recording(session);
    show_cameras(session.cameras);
    show_people(session);
    links.follow(session.links);
}

function show_sessions(session) {
    const all = facts.sessions, shown = JSON.stringify(all.map(({ number, name }) => [number, name]));
    $("choose_session").hidden = all.length < 2;
    if ($("session_choice").dataset.shown !== shown) {
        $("session_choice").dataset.shown = shown;
        $("session_choice").replaceChildren(...all.map(({ number, name }) => new Option(name, number)));
    }
    $("session_choice").value = session.number;
    $("enter_room").hidden = !session.is_own;
    $("sessions_part").hidden = !facts.may_create;
    const rows = [...all, ...facts.closed.map(closed => ({ ...closed, closed: true, may_end: true }))];
    follow_rows($("sessions"), rows, ({ name, closed }) => `${closed} ${name}`, (row, { name, may_end }) => {
        const { buttons } = add_words(row);
        if (may_end)
            add_button(buttons, "end", text("end_session"), () => act(`session?${new URLSearchParams({ end: name })}`), text("end_session_sure"));
    }, (row, { name, closed, problem, people }) =>
        row.querySelector(".words").textContent = closed ? `${name}: ${problem || text("session_closed")}` : text("session_line", { name, count: people.length }));
}

function size_text(bytes) {
    const digits = new Intl.NumberFormat(language, { maximumFractionDigits: 1 });
    return bytes < 1e9 ? `${digits.format(bytes / 1e6)} MB` : `${digits.format(bytes / 1e9)} GB`;
}

function time_text(seconds) {
    const two = number => String(Math.floor(number)).padStart(2, "0");
    return `${Math.floor(seconds / 3600)}:${two(seconds / 60 % 60)}:${two(seconds % 60)}`;
}

// The host does not answer: nothing of its last answer looks like the present.
function show_silence() {
    if (!facts)
        return;
    for (const row of $("cameras").children) {
        row.dataset.level = "bad";
        row.querySelector(".state").textContent = text("camera_unknown");
    }
    $("recording").dataset.phase = "unknown";
    $("recording_says").textContent = text("recording_unknown");
    $("recording_space").textContent = "";
}

function show_recording({ recording: { phase, file, seconds, bytes, free_bytes, problem }, ended }) {
    const is_on = phase === "running", is_ending = phase === "ending";
    const says = text(phase_texts[phase], { time: time_text(seconds), size: size_text(bytes), problem });
    $("recording_says").textContent = says;
    // A screen reader tells changes, and not each second.
    if ($("recording").dataset.phase !== phase && $("recording").dataset.phase)
        $("recording_news").textContent = says;
    $("recording").dataset.phase = phase;
    const rate = is_on && seconds > least_rate_seconds ? bytes / seconds : 0;
    const hours = rate ? free_bytes / rate / 3600 : null;
    const is_known = free_bytes !== null;
    $("recording_space").textContent = !is_known ? "" : hours === null ? text("space_free", { size: size_text(free_bytes) })
        : text("space_left", { size: size_text(free_bytes), hours: new Intl.NumberFormat(language, { maximumFractionDigits: 1 }).format(hours) });
    $("recording_space").classList.toggle("warning", is_known && (free_bytes < little_bytes || (hours !== null && hours < 1)));
    $("recording_file").textContent = file;
    const had_focus = $("recording").contains(document.activeElement);
    $("start_recording").hidden = is_on || is_ending || ended;
    $("stop_recording").hidden = !is_on;
    if (had_focus && !is_ending)
        $(is_on ? "stop_recording" : "start_recording").focus();
}

function show_cameras(cameras) {
    $("no_cameras").hidden = cameras.length > 0;
    follow_rows($("cameras"), cameras.map((camera, number) => ({ ...camera, number })), ({ number, name }) => `${number} ${name}`, (row, { has_picture }) => {
        for (const kind of [...(has_picture ? ["canvas"] : []), "name", "state", "detail"]) {
            const part = document.createElement(kind === "canvas" ? "canvas" : "p");
            part.className = kind;
            row.append(part);
        }
    }, (row, { name, state, problem, age_ms }) => {
        row.dataset.level = state === "live" ? "good" : ["stale", "failed", "ended"].includes(state) ? "bad" : "";
        row.querySelector(".name").textContent = name;
        const is_late = state === "live" && age_ms > late_ms;
        row.querySelector(".state").textContent = (texts.states[state] ?? state) + (is_late ? `, ${text("old", { s: (age_ms / 1000).toFixed(1) })}` : "");
        row.querySelector(".detail").textContent = problem;
        const canvas = row.querySelector("canvas");
        if (canvas)
            Object.assign(canvas, { role: "img", ariaLabel: text("picture_of", { name }) });
    });
}

// One after the other: a host with ten cameras has other things to do.
async function show_pictures() {
    if (!facts || $("all").hidden)
        return;
    const number = shown_session().number;
    for (const row of [...$("cameras").children]) {
        const canvas = row.querySelector("canvas");
        if (!canvas || shown_session().number !== number)
            continue;
        const answer = await ask(`picture?session=${number}&camera=${parseInt(row.dataset.key)}`).catch(() => null);
        if (answer?.status !== 200)
            continue;
        await draw_answer(canvas, answer);
    }
}

function show_people({ people, visitors }) {
    $("nobody").hidden = people.length + visitors.length > 0;
    const manage = (id, what) => () => act(`person?id=${id}&do=${what}`);
    const line = ({ name, role, muted, records, hand }) => `${name ?? ""} (${texts.roles[role] ?? role})`
        + (hand ? ` · ${text("hand")}` : "") + (muted ? ` · ${text("muted")}` : "") + (records ? ` · ${text("records")}` : "");
    follow_rows($("visitors"), visitors, ({ id }) => id, (row, { id }) => {
        const { buttons } = add_words(row);
        add_button(buttons, "admit", text("admit"), manage(id, "admit")).className = "first";
        add_button(buttons, "turn_away", text("turn_away"), manage(id, "turn_away"));
    }, (row, visitor) => row.querySelector(".words").textContent = text("waits", { who: line(visitor) }));
    follow_rows($("people"), people, ({ id }) => id, (row, { id }) => {
        const { buttons } = add_words(row);
        add_button(buttons, "mute", "", () => manage(id, "muted" in row.dataset ? "unmute" : "mute")());
        add_button(buttons, "lower", text("lower"), manage(id, "lower"));
        add_button(buttons, "remove", text("remove"), manage(id, "remove"), text("remove_sure"));
    }, (row, person) => {
        row.toggleAttribute("data-muted", person.muted);
        row.querySelector(".words").textContent = line(person);
        row.querySelector("[data-does=lower]").hidden = !person.hand;
        row.querySelector("[data-does=mute]").textContent = text(person.muted ? "unmute" : "mute");
    });
}

for (const element of document.querySelectorAll("[data-text]"))
    element.textContent = text(element.dataset.text);
document.documentElement.lang = language;
$("enter_room").addEventListener("click", () => location.href = `/${location.hash}`);
$("session_choice").addEventListener("change", () => {
    show_other_session(Number($("session_choice").value));
    show();
    show_pictures();
});
$("start_recording").addEventListener("click", () => act("recording?do=start"));
set_button($("stop_recording"), text("stop_recording"), () => act("recording?do=stop"), text("stop_sure"));
$("create_session").addEventListener("submit", event => {
    event.preventDefault();
    act(`session?${new URLSearchParams({ create: $("new_session").value.trim() })}`).then(made => made && ($("new_session").value = ""));
});

// A link in the field of the address, or of a program that opens another one in the same tab.
addEventListener("hashchange", () => location.reload());

async function watch() {
    const goes_on = document.hidden || await follow();
    if (!document.hidden)
        await show_pictures().catch(() => {});
    if (goes_on)
        setTimeout(watch, every_ms);
}

if (token)
    watch();
else
    tell(text("no_link"));
