// SPDX-License-Identifier: Apache-2.0
// The links of the operators' page: made, shown for a minute with their QR code, and revoked.
import { language, texts } from "./texts.js";
import { text } from "./operators_texts.js";
import { add_button, add_words, follow_rows } from "./operators_rows.js";

const $ = id => document.getElementById(id);
const shown_ms = 60_000;
const quiet_modules = 4, module_pixels = 6;
const lifetimes = [["1", "one_hour"], ["8", "eight_hours"], ["24", "one_day"], ["168", "one_week"], ["", "no_end"]];
const usual_hours = "8";

export class Links {
    turn = 0;  // an answer that comes after the change to another session is not shown

    // `act(path)` asks the host, and resolves to its answer's JSON, or null where it refused. `session_name()`: that is shown.
    constructor(act, session_name) {
        Object.assign(this, { act, session_name });
        $("link_role").append(...["expert", "observer", "publisher", "operator"].map(role => new Option(texts.roles[role], role)));
        $("link_hours").append(...lifetimes.map(([hours, key]) => new Option(text(key), hours, hours === usual_hours, hours === usual_hours)));
        $("make_link").addEventListener("submit", event => {
            event.preventDefault();
            this.ask({ role: $("link_role").value, hours: $("link_hours").value, for: $("link_for").value.trim() })
                .then(made => made && ($("link_for").value = ""));
        });
        $("hide_link").addEventListener("click", () => this.hide());
        $("copy_link").addEventListener("click", () => this.copy());
        // A page in the background has hardly a clock, and one that is kept for the button "Back" has none.
        document.addEventListener("visibilitychange", () => this.follow_time());
        addEventListener("pagehide", () => this.hide());
    }

    async ask(wish) {
        const turn = this.turn, link = await this.act(`link?${new URLSearchParams(wish)}`);
        if (link && turn === this.turn)
            this.show(link);
        return link;
    }

    hidden_at = 0;  // by the clock of the day, which goes on while the computer sleeps

    show(link) {
        $("shown_link_for").textContent = `${this.session_name()}: ${title_of(link)}`;
        $("link_text").value = link.link;
        $("link_says").textContent = "";
        $("link_code").setAttribute("aria-label", text("code_of_link"));
        draw_code($("link_code"), link.qr);
        $("shown_link").hidden = false;
        $("copy_link").focus();
        this.hidden_at = Date.now() + shown_ms;
        clearInterval(this.timer);
        this.follow_time();
        this.timer = setInterval(() => this.follow_time(), 1000);
    }

    follow_time() {
        const left_ms = this.hidden_at - Date.now();
        if (left_ms > 0)
            $("link_left").textContent = text("link_left", { s: Math.ceil(left_ms / 1000) });
        else
            this.hide();
    }

    // Another session is shown: nothing of the one before.
    leave_session() {
        ++this.turn;
        this.hide();
        $("links").replaceChildren();
    }

    // Nothing of it stays in the page.
    hide() {
        clearInterval(this.timer);
        const had_focus = $("shown_link").contains(document.activeElement);
        $("shown_link").hidden = true;
        $("link_text").value = "";
        Object.assign($("link_code"), { width: 0, height: 0 });
        if (had_focus)
            $("link_for").focus();
    }

    async copy() {
        try {
            await navigator.clipboard.writeText($("link_text").value);
            $("link_says").textContent = text("copied");
        } catch {
            $("link_text").select();
            $("link_says").textContent = text("copy_by_hand");
        }
    }

    follow(links) {
        follow_rows($("links"), links, link => link.name, (row, link) => {
            const { buttons } = add_words(row);
            add_button(buttons, "show", text("show_link"), () => this.ask({ show: link.name }));
            if (!link.is_own)
                add_button(buttons, "revoke", text("revoke_link"),
                           () => this.act(`link?${new URLSearchParams({ revoke: link.name })}`), text("revoke_sure"));
        }, (row, link) => {
            const words = row.querySelector(".words"), shown = `${title_of(link)} · ${end_of(link)}${link.is_own ? ` · ${text("own_link")}` : ""}`;
            if (words.textContent !== shown)
                words.textContent = shown;
            row.querySelector("[data-does=show]").hidden = link.expired;
        });
    }
}

function title_of({ role, for: whom }) {
    const name = texts.roles[role] ?? role;
    return whom ? `${whom} (${name})` : name;
}

function end_of({ until, expired }) {
    if (!until)
        return text("no_end");
    if (expired)
        return text("expired");
    const time = new Date(until);
    return text("until", { time: time.toLocaleString(language, { dateStyle: "medium", timeStyle: "short" }) });
}

// Black on white in the dark scheme as well: many readers take no other codes.
function draw_code(canvas, rows) {
    const width = (rows.length + 2 * quiet_modules) * module_pixels, context = canvas.getContext("2d");
    Object.assign(canvas, { width, height: width });
    context.fillStyle = "#fff";
    context.fillRect(0, 0, width, width);
    context.fillStyle = "#000";
    rows.forEach((row, y) => [...row].forEach((module, x) => {
        if (module === "1")
            context.fillRect((x + quiet_modules) * module_pixels, (y + quiet_modules) * module_pixels, module_pixels, module_pixels);
    }));
}
