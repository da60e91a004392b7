// SPDX-License-Identifier: Apache-2.0
// The session as the form shows it before one enters: its people, cameras and picture, by the token in a header.
import { ask_host, draw_answer } from "./host_request.js";
import { listed } from "./listed.js";
import { text, texts } from "./texts.js";

const $ = id => document.getElementById(id);
const every_ms = 2000, patience_ms = 3000;
const most_named = 12;  // people or cameras; a host may have very many

export class Lobby {
    timer = null;
    is_watching = false;
    turn = 0;  // an answer of an older one is late

    // `on_role` gets the role that the link gives, `on_refusal` is called where the host does not know the link.
    constructor(token, { on_role, on_refusal }) {
        Object.assign(this, { token, on_role, on_refusal });
    }

    watch() {
        if (this.is_watching)
            return;
        this.is_watching = true;
        this.ask(++this.turn);
    }

    end() {
        this.is_watching = false;
        clearTimeout(this.timer);
    }

    fetch(path) {
        return ask_host(this.token, path, { signal: AbortSignal.timeout?.(patience_ms) });
    }

    async ask(turn) {
        let again = true;
        try {
            if (!document.hidden)
                again = await this.show();
        } catch {
            // It may be back the next time.
            if (this.is_watching && turn === this.turn)
                this.be_silent();
        }
        if (turn !== this.turn)
            return;
        if (this.is_watching && again)
            this.timer = setTimeout(() => this.ask(turn), every_ms);
        else
            this.is_watching = false;
    }

    // False: this link shows nothing, and will not.
    async show() {
        const answer = await this.fetch("/lobby");
        if (answer.status === 401) {
            $("invitation").hidden = true;
            this.tell([text("lobby_unknown")]);
            this.on_refusal();
            return false;
        }
        if (!answer.ok)
            throw new Error(answer.statusText);
        const lobby = await answer.json();
        this.on_role(lobby?.role);
        const session = lobby?.sessions?.[0];
        if (!session || !this.is_watching)
            return true;
        $("session_name").textContent = String(session.name ?? "");
        this.tell(lines_of(session, lobby.role));
        // The lines hold without it.
        await this.show_picture(session).catch(() => $("session_picture").hidden = true);
        return !session.ended;
    }

    // The lines that were shown of the session may be out of date.
    be_silent() {
        this.tell([text("lobby_silent")]);
        $("session_picture").hidden = true;
    }

    tell(lines) {
        $("session").hidden = false;
        const shown = [...$("session_lines").children].map(line => line.textContent);
        if (JSON.stringify(shown) === JSON.stringify(lines))
            return;  // a screen reader would read them again
        $("session_lines").replaceChildren(...lines.map(line => {
            const item = document.createElement("li");
            item.textContent = line;
            return item;
        }));
    }

    async show_picture({ thumbnail, cameras }) {
        const canvas = $("session_picture");
        canvas.hidden ||= !thumbnail || !cameras?.length;
        // The address is the host's; only its own picture is asked for.
        if (!cameras?.length || !/^\/thumbnail(\?session=\d+)?$/.test(thumbnail ?? ""))
            return;
        const answer = await this.fetch(thumbnail);
        if (answer.status !== 200)
            return void (canvas.hidden = true);
        await draw_answer(canvas, answer);
        canvas.hidden = false;
    }
}

// The host's answer in sentences.
function lines_of({ ended, held_back, asks, people, cameras, people_count }, role) {
    if (ended)
        return [text("lobby_ended")];
    const lines = [];
    if (role === "observer")
        lines.push(text("lobby_observer"));
    if (people)
        lines.push(people.length ? text("lobby_people", { names: named(people, ({ name, role }) => `${name} (${texts.roles[role] ?? role})`) })
                                 : text("lobby_nobody"));
    else if (Number.isInteger(people_count))
        lines.push(text("lobby_count", { count: people_count }));
    if (cameras)
        lines.push(cameras.length ? text("lobby_cameras", { names: named(cameras, ({ name, state }) => `${name} (${texts.states[state] ?? state})`) })
                                  : text("lobby_no_cameras"));
    lines.push(text(held_back ? "lobby_held_back" : asks ? "lobby_asks" : "lobby_open"));
    return lines;
}

function named(all, line_of) {
    return listed(all.map(line_of), most_named);
}
