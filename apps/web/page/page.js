// SPDX-License-Identifier: Apache-2.0
// The page: the join form, the loop of pictures, and the panels beside them.
import { Chat } from "./chat.js";
import make_client from "./client.mjs";
import { join_workers, start_workers } from "./decoding.js";
import { use_loudspeaker } from "./device_choice.js";
import { Face } from "./face.js";
import { picture_box } from "./flat_marks.js";
import { name_full_screen, offer_full_screen } from "./full_screen.js";
import { FlatView, Patience, find_graphics, note_lost_graphics, take_lost_graphics } from "./graphics.js";
import { Headset, headset_kinds } from "./headset.js";
import { listen } from "./input.js";
import { Lobby } from "./lobby.js";
import { Notices } from "./notices.js";
import { command_of, face_problem, fill_texts, has_draw_tools, show, show_face, show_own_screen, show_voices } from "./panels.js";
import { Person } from "./person.js";
import { PicturePanel } from "./picture.js";
import { put_bytes, with_patience, with_program } from "./program.js";
import { ask_for_right_link } from "./right_link.js";
import { Run } from "./run.js";
import { save_picture } from "./saved.js";
import { Screen } from "./screen.js";
import { Sheet } from "./sheet.js";
import { StillCover } from "./still.js";
import { store, stored } from "./storage.js";
import { hold_to_talk } from "./talk.js";
import { TestCall } from "./test_call.js";
import { language, text, texts } from "./texts.js";
import { offer_touch } from "./touch.js";
import { by_touch, follow_touch } from "./touch_mode.js";
import { Tour } from "./tour.js";
import { offer_h264 } from "./video_decoder.js";
import { Voice } from "./voice.js";

const $ = id => document.getElementById(id);
const still = new StillCover($("panels"));
const texts_every_ms = 250;
const poll_every_ms = 1;
const longest_wait_ms = 500;
// A slow computer draws the picture that is to be saved later than that; then the page says that it waits.
const patient_save_ms = 1000;

// The link's part behind '#', which no request contains.
const link = new URLSearchParams(location.hash.slice(1));
const host = location.hostname.replace(/^\[|\]$/g, "");
const port = Number(location.port || 443);

// The client's functions (apps/web/main.cpp), by the names that follow theatron_.
async function load_client() {
    const compiling = with_patience(() => WebAssembly.compileStreaming(fetch("client.wasm")));
    const starting = link.get("decoding") === "page" ? [] : start_workers(compiling);
    const program = await compiling;
    const module = await make_client({
        ...with_program(program), print: line => console.log(line), printErr: line => console.warn(line),
    });
    const numbers = count => Array(count).fill("number");
    const functions = {
        join: [null, ["string", "number", "string", "string", "string", "string", "string", "number", "number"]],
        join_flat: [null, ["string", "number", "string", "string", "string", "string", "number"]],
        flat_picture: ["number", []],
        flat_width: ["number", []],
        flat_height: ["number", []],
        flat_next: [null, []],
        flat_step: ["string", []],
        flat_points: [null, numbers(1)],
        leave: [null, []],
        draw: ["number", numbers(2)],
        finish_drawing: ["number", []],
        prepare: [null, []],
        state: ["string", []],
        command: [null, numbers(1)],
        key: [null, ["string", "string"]],
        hold: [null, numbers(6)],
        point: [null, numbers(2)],
        grab: [null, numbers(3)],
        release: [null, []],
        drag: [null, numbers(3)],
        wheel: [null, numbers(1)],
        redraw: [null, []],
        enter_headset: [null, numbers(2)],
        draw_headset: [null, numbers(1)],
        leave_headset: [null, []],
        headset_scale: ["number", []],
        use_language: [null, ["string"]],
        use_touch: [null, []],
        space_moved: [null, numbers(1)],
        headset_wish: ["number", numbers(1)],
        reset_figures: [null, []],
        speak: [null, [...numbers(4), "array", "number"]],
        allow_voice_recording: [null, numbers(1)],
        use_run: [null, ["string"]],
        go_on: [null, ["string"]],
        chat: ["string", []],
        write_chat: ["number", ["string"]],
        raise_hand: [null, numbers(1)],
        show_face: [null, numbers(3)],
        send_face: [null, numbers(1)],
        note_face: [null, numbers(1)],
        show_screen: [null, ["string", ...numbers(3)]],
        send_screen: [null, numbers(1)],
        face_wish: ["number", []],
        picture_choices: ["string", []],
        choose: [null, ["string", "string"]],
    };
    const client = Object.fromEntries(Object.entries(functions).map(([name, [result, inputs]]) =>
        [name, module.cwrap(`theatron_${name}`, result, inputs)]));
    client.use_language(language);
    follow_touch(() => by_touch() && client.use_touch());
    const voice = new Voice((number, age_us, pauses, level_db, opus) =>
        client.speak(number, age_us, pauses, level_db, opus, opus.length), () => show_voices(voice, page.state));
    module.on_voice = (speaker, packet) => voice.hear(speaker, packet);
    const face = page.face = new Face($("own_face_picture"), module, client);
    const screen = page.screen = new Screen(module, client, () => text("name_of_screen", { name: $("name").value }),
                                            () => show_own_screen(page.screen, page.state));
    page.reset_figures = client.reset_figures;
    page.time_strata = (hex, passes) => {
        put_bytes(module, Uint8Array.from(hex.match(/../g), digits => parseInt(digits, 16)).buffer);
        return module._theatron_time_strata(passes);
    };
    page.time_depth = module._theatron_time_depth;
    page.memory = () => module.HEAPU8.length;
    page.workers = await starting;
    // Also where workers decode: they may end.
    const page_has_h264 = await offer_h264(module);
    page.has_h264 = () => page.workers.length ? page.workers.every(({ has_h264 }) => has_h264) : page_has_h264;
    join_workers(module, page.workers, () => {
        client.leave();
        leave({ voice, face, screen }, text("decoder_ended"));
    });
    return { client, voice, face, screen, module, flat: new FlatView($("flat"), $("flat_marks"), module, client) };
}

// For tests and measurements: the newest state, and milliseconds since the link was opened.
const page = globalThis.theatron = { state: { phase: "left" }, first_picture_ms: null, complete_ms: null, workers: [],
    graphics: "card", way: "room", visit: 0, role: "", headset_kinds: {}, voice_may_record: false, Patience };

function is_complete({ cameras, has_picture }) {
    return has_picture && cameras.every(camera => !camera.is_asked_for ||
        (camera.depth === "none" || camera.depth_frames) && (camera.color_frames || !camera.color));
}

function run({ client, voice, face, screen, module, flat }) {
    const canvas = $("view");
    let patience = new Patience();
    let next_texts = 0;
    const help = () => {
        if (!$("help").open)
            $("help").showModal();
        $("help_text").scrollTop = 0;
    };
    const sheet = page.sheet = new Sheet(name => text(titles[name]), () => next_texts = 0);
    const chat = page.chat = new Chat(client, sheet, page.run);
    const tour = page.tour = new Tour(() => $(page.way === "flat" ? "flat" : "view"));
    $("show_tour").addEventListener("click", () => {
        sheet.close();
        tour.begin();
    });
    let notices = new Notices();
    const follow_drawing = offer_touch($("touch"), [listen(canvas, client), listen($("flat"), client, picture_box)], client,
                                       () => page.state.phase !== "left" && has_draw_tools(page.state.overlay));
    const picture_panel = new PicturePanel(client, () => next_texts = 0);
    follow_touch(() => picture_panel.name());
    for (const id of ["room_panels", "study", "shared_screen"])
        $(id).addEventListener("click", event => {
            const command = event.target.dataset.command === undefined ? null : command_of(event.target, page.state.overlay.panels);
            if (command !== null)
                client.command(command);
            // The panel would lie over what the person wants to see.
            if (command !== null && "leadsAway" in event.target.dataset)
                sheet.close();
            next_texts = 0;
        });
    for (const [id, key] of [["draw", "z"], ["back_to_live", "end"]])
        $(id).addEventListener("click", () => client.key(key, ""));
    $("more").addEventListener("click", event => {
        const { key } = event.target.dataset;
        if (key)
            client.key(key, "");
        next_texts = 0;
    });
    // The people have a row for everybody who waits or calls.
    for (const id of ["door", "call"])
        $(id).addEventListener("click", event => sheet.open("people", event.detail === 0 ? $(id) : null));
    $("webcam").addEventListener("click", () => ["asking", "on"].includes(face.state) ? face.hide() : face.show());
    // When the person asked for the picture that is drawn next; 0: not.
    let asked_to_save_ms = 0;
    $("save_picture").addEventListener("click", () => {
        if (page.way === "flat")
            return save(flat.marks.copy());
        asked_to_save_ms = performance.now();
        client.redraw();
    });
    for (const id of ["share_screen", "end_own_screen"])
        $(id).addEventListener("click", () => ["asking", "on"].includes(screen.state) ? screen.hide() : screen.show());
    $("microphone").addEventListener("click", () => voice.toggle_microphone());
    $("push_to_talk").addEventListener("click", () => change_push_to_talk(voice));
    const change_voice_recording = () => {
        allow_voice_recording(client, page.state.voice_may_record === false);
        next_texts = 0;
    };
    $("voice_recording").addEventListener("click", change_voice_recording);
    hold_to_talk($("talk"), voice);
    // After a click on a button the keys go on to act in the room; a button reached by Tab keeps the focus.
    $("panels").addEventListener("click", event => event.detail > 0 && event.target.closest("button") && !event.target.closest("dialog, #chat_form") &&
        $(page.way === "flat" ? "flat" : "view").focus({ preventScroll: true }));
    document.addEventListener("keydown", event => {
        if (event.key !== "Escape" || event.isComposing || page.state.phase === "left" || document.querySelector("dialog[open]"))
            return;
        if (page.state.phase !== "joined" && !event.target.closest("input"))
            client.leave();
        else if (page.state.draws)
            return;  // the key gives up what is drawn
        else if (sheet.name)
            sheet.close();
        else if (tour.step)
            tour.end();
    });
    // Both ways of seeing have these keys; input.js has the keys of the room.
    const on_key = event => {
        const is_plain = !event.ctrlKey && !event.metaKey && !event.altKey;
        if (is_plain && ["h", "H", "F1"].includes(event.key)) {
            event.preventDefault();
            return help();
        }
        const key = event.key.toLowerCase();
        if (key === "l" && !event.repeat && is_plain)
            voice.toggle_microphone();
        if (Object.hasOwn(sheets, key) && !event.repeat && is_plain && (key !== "o" || page.way === "room"))
            sheet.toggle(sheets[key]);
        if (!["F7", "F8"].includes(event.key))
            return;
        event.preventDefault();  // F7 is the browser's, too
        if (event.repeat)
            return;
        if (event.key === "F7")
            change_push_to_talk(voice);
        else if (page.state.voice_may_record !== null)
            change_voice_recording();
    };
    for (const picture of [canvas, $("flat")]) {
        hold_to_talk(picture, voice);
        picture.addEventListener("keydown", on_key);
    }
    $("show_help").addEventListener("click", help);
    $("leave").addEventListener("click", () => {
        // At once: the next person may be quick.
        page.run.end();
        client.leave();
    });
    // A page that is closed leaves, too: nobody is told that its connection broke.
    addEventListener("pagehide", () => page.state.phase !== "left" && client.leave());
    canvas.addEventListener("webglcontextlost", () => {
        if (page.state.phase !== "left")
            note_lost_graphics(voice.microphone === "open");
        location.reload();
    });

    $("hide_face").addEventListener("click", () => face.hide());
    // The host's refusal is a remark, which is shown.
    const follow_face = () => {
        const wish = client.face_wish();
        if (wish === 1)
            face.show();
        if (wish === 2 || (face.state === "on" && page.state.face_problem))
            face.hide();
        client.note_face({ asking: 1, on: 2 }[face.state] ?? 0);
        show_face(face, page.way);
    };
    // A refusal, and who has ended it for all, are remarks, which are shown.
    const follow_screen = ({ phase, may_show_screen, screen: told }) => {
        const is_refused = phase === "joined" && screen.state === "on" && (told.problem || !may_show_screen);
        if (told.has_ended || is_refused)
            screen.hide();
        show_own_screen(screen, page.state);
    };
    const save = async picture => {
        const problem = await save_picture(picture, page.state).then(() => "", ({ message }) => text("not_saved", { why: message }));
        $("save_hint").textContent = problem;
    };
    const show_state = () => {
        page.state = JSON.parse(client.state());
        // Nothing of a session stays once it is over for this person.
        if (page.state.phase === "ended" || (page.state.phase === "refused" && page.state.joins > 0)) {
            // A page that must be loaded again says so itself.
            const { is_outdated, problem: why } = page.state;
            const problem = is_outdated ? why : text("session_over", { why });
            client.leave();
            page.state = { phase: "left", problem };
        }
        if (page.state.phase === "left") {
            sheet.close();
            tour.show(page.state, page.way);
            return leave({ voice, face, screen }, page.state.problem);
        }
        follow_face();
        follow_screen(page.state);
        // The last picture of a camera that has left does not stay.
        if (page.way === "flat" && !page.state.has_picture)
            flat.clear();
        page.state.face_problem ||= face_problem(face, page.way);
        const way_sentence = show_way(page.state);
        const tip = follow_drawing() === "points" && by_touch() ? text("point_by_touch") : "";
        show(page.state, { sheet, notices, way: page.way, once: [way_sentence, tip], now_ms: performance.now() });
        tour.show(page.state, page.way);
        still.show(page.state);
        picture_panel.show(page.state);
        chat.show(page.state, page.visit);
        place_voices(voice, page.state);
        show_voices(voice, page.state);
        document.title = `${page.state.host || host} - Theatron`;
    };
    // Asks soon, because the time that drawing takes decides on the quality.
    const await_picture = visit => {
        // Its picture went with it.
        if (visit !== page.visit)
            return;
        const is_left = page.state.phase === "left";
        if (!is_left && !client.finish_drawing())
            return setTimeout(() => await_picture(visit), poll_every_ms);
        is_drawing = false;
        if (!is_left)
            note_picture();
    };
    const note_picture = () => {
        if (page.complete_ms !== null)
            return;
        show_state();
        page.first_picture_ms ??= performance.now();
        if (is_complete(page.state))
            page.complete_ms = performance.now();
    };
    // The picture of a visit before goes with it, and nobody is to wait for it.
    const forget_picture = () => {
        ++page.visit;
        is_drawing = false;
        asked_to_save_ms = 0;
        notices = new Notices();
    };
    // The same person enters again, in the other way of seeing.
    const change_way = (way, why) => {
        page.way = way;
        page.why = why;
        patience = new Patience();
        forget_picture();
        enter(client);
        follow_way(face);
        screen.offer();
    };
    $("other_way").addEventListener("click", () => change_way(page.way === "flat" ? "room" : "flat", ""));
    $("next_camera").addEventListener("click", () => client.flat_next());
    let is_drawing = false;
    const wait_for_picture = () => {
        if (!is_drawing) {
            is_drawing = true;
            await_picture(page.visit);
        }
    };
    const show_texts = now => {
        if (now >= next_texts) {
            next_texts = now + texts_every_ms;
            show_state();
            // With a headset one chose the room.
            if (page.way === "room" && !headset.is_on && $("way").value === "auto" && page.why !== "" && patience.is_over(now, page.state))
                change_way("flat", "too_slow");
        }
    };
    // The room follows the cameras' pictures, but waits for none that is late.
    const prepare_room = now => {
        if (page.complete_ms !== null || now > (page.first_picture_ms ?? Infinity) + longest_wait_ms)
            client.prepare();
    };
    const headset = page.headset = new Headset({
        canvas, module, client,
        after_frame: now => {
            still.beat(now);
            voice.hands_free = true;
            show_texts(now);
            prepare_room(now);
            wait_for_picture();
            const wish = client.headset_wish(voice.microphone === "open" ? 1 : 0);
            if (wish === 1)
                voice.toggle_microphone();
            if (wish === 2 || page.state.phase === "left")
                headset.leave();
        },
        ended: () => {
            voice.hands_free = false;
            client.redraw();
            if (page.state.phase !== "left")
                go_on_drawing();
        },
    });
    headset_kinds().then(kinds => page.headset_kinds = kinds);
    for (const kind of ["vr", "ar"])
        $(`enter_${kind}`).addEventListener("click", () => headset.enter(kind).catch(error => {
            $("headset_hint").textContent = text("no_headset", { why: error.message });
            $("headset_hint").hidden = false;
        }));
    let draws_again = false;
    const go_on_drawing = () => {
        if (!draws_again)
            requestAnimationFrame(draw);
        draws_again = true;
    };
    const draw = now => {
        draws_again = false;
        if (headset.is_on)
            return;  // it has a rhythm of its own
        show_texts(now);
        if (page.state.phase === "left")
            return;
        go_on_drawing();
        // A picture that the graphics card does not finish is not drawn.
        if (page.state.has_picture && !is_drawing)
            still.beat(now);
        if (page.way === "flat") {
            if (flat.draw(now))
                note_picture();
            return;
        }
        const ratio = Math.min(devicePixelRatio, 2);
        const width = Math.max(1, Math.round(canvas.clientWidth * ratio));
        const height = Math.max(1, Math.round(canvas.clientHeight * ratio));
        if (canvas.width !== width || canvas.height !== height) {
            canvas.width = width;
            canvas.height = height;
            client.redraw();
        }
        prepare_room(now);
        const drawn = is_drawing ? 0 : client.draw(width, height);
        if (drawn & 2 && asked_to_save_ms) {
            save(canvas);
            asked_to_save_ms = 0;
        } else if (asked_to_save_ms && performance.now() > asked_to_save_ms + patient_save_ms) {
            $("save_hint").textContent = text("save_waits");
        }
        if (drawn & 1)
            wait_for_picture();
    };
    return () => {
        next_texts = 0;
        forget_picture();
        go_on_drawing();
    };
}

function change_push_to_talk(voice) {
    voice.set_push_to_talk(!voice.pushes);
    page.person.remember(page.person.is_remembered, { pushes: voice.pushes ? "yes" : "no" });
}

// In this visit; the next one asks again, since several people may use one browser.
function allow_voice_recording(client, agrees) {
    page.voice_may_record = agrees;
    client.allow_voice_recording(agrees ? 1 : 0);
}

// In the 2D view nobody has a place: all are heard from ahead.
function place_voices(voice, { ear, people }) {
    const others = people.filter(({ self }) => !self);
    voice.place(ear, new Map(ear ? others.filter(({ head }) => head).map(({ id, head }) => [id, head])
                                 : others.map(({ id }) => [id, [0, 0, -1]])));
}

// The panels that keys open, and the titles of all.
const sheets = { p: "people", o: "case", b: "details" };
const titles = { people: "people", chat: "chat", case: "case", draw: "draw", more: "more", details: "details", picture: "picture_settings" };

// Returns the sentence on what is drawn; "": nothing is to be said.
function show_way({ has_picture, flat_camera, cameras }) {
    const is_flat = page.way === "flat";
    const sentence = !is_flat ? (page.graphics === "card" ? "" : text("drawn_by_processor"))
        : !has_picture ? text(cameras.length ? "flat_waits" : "lobby_no_cameras")
        : (page.why ? text(page.why) + " " : "") + text("flat_is_shown", { camera: flat_camera });
    if ($("drawing_text").textContent !== sentence)
        $("drawing_text").textContent = sentence;
    $("other_way").textContent = text(is_flat ? "to_room" : "to_flat");
    $("other_way").hidden = page.graphics === "none";
    for (const kind of ["vr", "ar"])
        $(`enter_${kind}`).hidden = is_flat || !has_picture || !page.headset_kinds[kind];
    return sentence;
}

// As --render-scale of theatron join; 0: chosen by drawing time.
function drawn_scale(asked) {
    const scale = Number(asked);
    return scale >= 0.1 && scale <= 1 ? scale : 0;
}

// Into the session, in the way of seeing that was chosen.
function enter(client) {
    const is_flat = page.way === "flat";
    $("view").hidden = is_flat;
    $("flat").hidden = !is_flat;
    $(is_flat ? "flat" : "view").focus();
    client.use_run(page.run.number);
    const person = [host, port, link.get("join"), $("name").value.trim(), page.person.id];
    const color = [link.get("color") ?? "auto", page.has_h264() ? 1 : 0];
    if (is_flat)
        client.join_flat(...person, ...color);
    else
        client.join(...person, link.get("depth") ?? "", ...color, drawn_scale(link.get("scale")));
    allow_voice_recording(client, page.voice_may_record);
}

// In the 2D view a person has no head that the others see.
function follow_way(face) {
    if (page.way === "flat")
        face.hide();
    else
        face.offer();
}

function leave({ voice, face, screen }, problem) {
    page.run.end();
    page.chat?.forget();
    voice.leave();
    face.hide();
    screen.hide();
    still.rest();
    $("view").hidden = $("flat").hidden = $("panels").hidden = $("session_picture").hidden = true;
    // The canvases would keep their last pictures.
    for (const canvas of [$("view"), $("flat"), $("flat_marks"), $("session_picture")])
        canvas.width = canvas.height = 1;
    $("lobby").hidden = false;
    page.lobby.watch();
    if (problem)
        $("problem").textContent = problem;
    $("name").focus();
}

// Inside, another device takes the place of the one that is open.
function use_device(kind) {
    const { voice, face } = page;
    if (kind === "microphone" && voice?.microphone === "open") {
        voice.close_microphone();
        voice.open_microphone();
    }
    if (kind === "loudspeaker" && voice?.context)
        use_loudspeaker(voice.context);
    if (kind === "webcam" && face?.state === "on") {
        face.hide();
        face.show();
    }
}

// An observer neither speaks nor is seen, so the form does not offer it.
function follow_role(role) {
    page.role = role;
    document.body.classList.toggle("observer", role === "observer");
    $("for_operators").hidden = role !== "operator";
    $("to_operators").href = `/operators${location.hash}`;
}

async function main() {
    const token = link.get("join"), loading = token && load_client();
    page.person = token && await Person.of(token);
    page.run = page.person && new Run(page.person.key);
    document.documentElement.lang = language;
    follow_touch(() => {
        document.body.classList.toggle("touch", by_touch());
        $("touch").hidden = !by_touch();
        fill_texts();
        name_full_screen($("full_screen"));
    });
    offer_full_screen($("full_screen"), sentence => $("screen_hint").textContent = sentence);
    $("problem").textContent = "";
    // Anybody can write into a link; only roles are shown.
    const role = link.get("role");
    $("invitation").textContent = Object.hasOwn(texts.roles, role)
        ? text("invited_as", { host: location.host, role: texts.roles[role] })
        : text("invited", { host: location.host });
    if (/^[0-9a-f]{64}$/.test(link.get("cert") ?? "")) {
        $("fingerprint").textContent = link.get("cert").toUpperCase().match(/../g).join(":");
        $("certificate").hidden = false;
    }
    addEventListener("hashchange", () => location.reload());
    if (!token) {
        $("invitation").textContent = text("no_token");
        $("enter").disabled = true;
        return ask_for_right_link();
    }

    Voice.warm_up();
    follow_role(role);
    page.lobby = new Lobby(token, { on_role: follow_role, on_refusal: ask_for_right_link });
    page.lobby.watch();
    const test_call = page.test_call = new TestCall({
        token, is_heard: () => page.voice?.microphone === "open", chosen: use_device,
        program: () => loading.then(() => ({ time_depth: page.time_depth, graphics: page.graphics, workers: page.workers.length })),
    });
    page.graphics = find_graphics();
    if (page.graphics !== "card") {
        $("graphics_hint").textContent = text(page.graphics === "none" ? "no_webgl" : "no_card");
        $("graphics_hint").hidden = false;
    }
    $("way").value = ["room", "flat"].includes(stored("way")) ? stored("way") : "auto";
    $("name").value = page.person.choice("name") ?? "";
    $("remember").checked = page.person.is_remembered;
    for (const mark of ["speaks", "pushes"])
        $(mark).checked = page.person.choice(mark) === "yes";
    let begin;
    $("join").addEventListener("submit", async event => {
        event.preventDefault();
        const name = $("name").value = $("name").value.trim();
        if (!$("name").reportValidity())
            return;
        $("enter").disabled = true;
        $("problem").textContent = text("loading");
        try {
            const program = await loading, { client, voice, face } = program;
            test_call.close();
            page.lobby.end();
            page.person.remember($("remember").checked, {
                name, speaks: $("speaks").checked ? "yes" : "no", pushes: $("pushes").checked ? "yes" : "no" });
            page.voice = voice;
            page.voice_may_record = $("may_record").checked && page.role !== "observer";
            voice.set_push_to_talk($("pushes").checked);
            begin ??= run(program);
            page.chat.begin(await page.run.find(name));
            $("problem").textContent = "";
            $("lobby").hidden = true;
            store("way", $("way").value);
            page.why = page.graphics === "none" ? "no_webgl" : undefined;
            page.way = page.graphics === "none" || $("way").value === "flat" ? "flat" : "room";
            $("panels").hidden = false;
            enter(client);
            // Opening the sound is one long call of the browser: in a task of its own, while the host answers.
            await new Promise(soon => setTimeout(soon));
            // Without sound the rest goes on; the panels say what is missing.
            voice.begin().catch(error => console.warn(`no sound: ${error.message}`));
            if ($("speaks").checked && page.role !== "observer")
                voice.open_microphone();
            if ($("shows_face").checked && page.role !== "observer" && page.way === "room")
                face.show();
            begin();
        } catch (error) {
            $("problem").textContent = text("no_program", { why: error.message });
        } finally {
            $("enter").disabled = false;
        }
    });
    $("enter").disabled = false;
    $("name").focus();
    const lost = take_lost_graphics();
    if (!lost)
        return;
    $("speaks").checked = lost.speaks;
    if (!lost.is_often)
        $("join").requestSubmit();
    $("problem").textContent = text(lost.is_often ? "graphics_lost_again" : "graphics_lost");
}

main();
