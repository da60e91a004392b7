// SPDX-License-Identifier: Apache-2.0
// The page: the join form, the loop of pictures, and the panels beside them.
import make_client from "./client.mjs";
import { listen } from "./input.js";
import { fill_texts, show } from "./panels.js";
import { language, text } from "./texts.js";

const $ = id => document.getElementById(id);
const texts_every_ms = 250;

// The link's part behind '#', which no request contains.
const link = new URLSearchParams(location.hash.slice(1));
const host = location.hostname.replace(/^\[|\]$/g, "");
const port = Number(location.port || 443);

function person_id() {
    let id = localStorage.getItem("person");
    if (!/^[0-9a-f]{32}$/.test(id ?? "")) {
        id = [...crypto.getRandomValues(new Uint8Array(16))].map(b => b.toString(16).padStart(2, "0")).join("");
        localStorage.setItem("person", id);
    }
    return id;
}

// The client's functions (apps/web/main.cpp), by the names that follow theatron_.
async function load_client() {
    const module = await make_client({ print: line => console.log(line), printErr: line => console.warn(line) });
    const numbers = count => Array(count).fill("number");
    const functions = {
        join: [null, ["string", "number", "string", "string", "string"]],
        leave: [null, []],
        draw: ["number", numbers(2)],
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
    };
    return Object.fromEntries(Object.entries(functions).map(([name, [result, inputs]]) =>
        [name, module.cwrap(`theatron_${name}`, result, inputs)]));
}

// For tests and measurements: the newest state, and milliseconds since the link was opened.
const page = globalThis.theatron = { state: { phase: "left" }, first_picture_ms: null, complete_ms: null };

function is_complete({ cameras, has_picture }) {
    return has_picture && cameras.every(camera => camera.depth_frames && (camera.color_frames || !camera.color));
}

function run(client) {
    const canvas = $("view");
    let next_texts = 0;
    const help = () => $("help").open || $("help").showModal();
    listen(canvas, client, help);
    $("room_panels").addEventListener("click", event => {
        const { command } = event.target.dataset;
        if (command !== undefined)
            client.command(Number(command));
        next_texts = 0;
    });
    $("tools").addEventListener("click", event => {
        const { key } = event.target.dataset;
        if (key)
            client.key(key, "");
        next_texts = 0;
    });
    $("full_screen").addEventListener("click", () =>
        document.fullscreenElement ? document.exitFullscreen() : document.documentElement.requestFullscreen());
    $("show_help").addEventListener("click", help);
    $("leave").addEventListener("click", () => client.leave());
    canvas.addEventListener("webglcontextlost", () => location.reload());

    const draw = now => {
        const ratio = Math.min(devicePixelRatio, 2);
        const width = Math.max(1, Math.round(canvas.clientWidth * ratio));
        const height = Math.max(1, Math.round(canvas.clientHeight * ratio));
        if (canvas.width !== width || canvas.height !== height) {
            canvas.width = width;
            canvas.height = height;
            client.redraw();
        }
        const drawn = client.draw(width, height);
        const is_new = drawn && page.complete_ms === null;
        if (now >= next_texts || is_new) {
            next_texts = now + texts_every_ms;
            page.state = JSON.parse(client.state());
            if (page.state.phase === "left")
                return leave(page.state.problem);
            show(page.state);
            document.title = `${page.state.host || host} - Theatron`;
            if (is_new) {
                page.first_picture_ms ??= performance.now();
                if (is_complete(page.state))
                    page.complete_ms = performance.now();
            }
        }
        requestAnimationFrame(draw);
    };
    return () => requestAnimationFrame(draw);
}

function leave(problem) {
    $("view").hidden = $("panels").hidden = true;
    $("lobby").hidden = false;
    $("problem").textContent = problem;
    $("name").focus();
}

async function main() {
    document.documentElement.lang = language;
    fill_texts();
    $("invitation").textContent = link.get("role")
        ? text("invited_as", { host: location.host, role: link.get("role") })
        : text("invited", { host: location.host });
    $("name").value = localStorage.getItem("name") ?? "";
    if (/^[0-9a-f]{64}$/.test(link.get("cert") ?? "")) {
        $("fingerprint").textContent = link.get("cert").toUpperCase().match(/../g).join(":");
        $("certificate").hidden = false;
    }
    addEventListener("hashchange", () => location.reload());
    if (!link.get("join")) {
        $("invitation").textContent = text("no_token");
        $("enter").disabled = true;
        return;
    }

    const loading = load_client();
    let begin;
    $("join").addEventListener("submit", async event => {
        event.preventDefault();
        const name = $("name").value.trim();
        $("enter").disabled = true;
        $("problem").textContent = text("loading");
        try {
            const client = await loading;
            localStorage.setItem("name", name);
            $("problem").textContent = "";
            $("lobby").hidden = true;
            $("view").hidden = $("panels").hidden = false;
            $("view").focus();
            client.join(host, port, link.get("join"), name, person_id());
            begin ??= run(client);
            begin();
        } catch (error) {
            $("problem").textContent = text("no_program", { why: error.message });
        } finally {
            $("enter").disabled = false;
        }
    });
    $("name").focus();
}

main();
