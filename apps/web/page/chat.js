// SPDX-License-Identifier: Apache-2.0
// Messages of people to all others, and raised hands. Texts of others are only ever text.
import { listed } from "./listed.js";
import { set_text } from "./set_text.js";
import { text } from "./texts.js";
import { by_touch } from "./touch_mode.js";

const $ = id => document.getElementById(id);

// The messages of others behind the newest one that the person has seen, by its id; all, if it is not there.
export function unseen_of(messages, seen) {
    return messages.slice(messages.findIndex(({ id }) => id === seen) + 1).filter(({ is_own }) => !is_own).length;
}

const shows_something = /[^\s\p{C}\p{Z}]/u;
const most_names = 3;
export const names_text = names => listed(names, most_names);

export class Chat {
    version = "";   // of the messages that are shown, and the visit
    was_open = false;
    messages = [];
    unsent = [];
    own = [];       // ids of the messages that the person wrote, also of those that have not come again yet
    times = new Map();  // of messages by their ids, in ms since 1970
    seen = "";      // id of the newest message that the person has seen

    // `run`: of the page (run.js).
    constructor(client, sheet, run) {
        Object.assign(this, { client, sheet, run });
        $("chat_form").addEventListener("submit", event => {
            event.preventDefault();
            this.write();
        });
        for (const button of document.querySelectorAll("[data-quick]"))
            // Not both clicks of a double click.
            button.addEventListener("click", event => event.detail < 2 && this.send(text(button.dataset.quick)));
        $("raise_hand").addEventListener("click", () => client.raise_hand(this.is_raised ? 0 : 1));
        $("hands").addEventListener("click", event => sheet.open("people", event.detail === 0 ? $("hands") : null));
        for (const id of ["unseen", "show_chat"])
            $(id).addEventListener("click", event => {
                if (id === "unseen")
                    sheet.open("chat", event.detail === 0 ? $(id) : null);
                // Behind the click, which gives the focus to the room. By touch a keyboard would cover the messages.
                if (sheet.name === "chat" && !by_touch())
                    setTimeout(() => $("chat_text").focus());
            });
    }

    write() {
        if (this.send($("chat_text").value))
            $("chat_text").value = "";
        $("chat_text").focus();
    }

    send(words) {
        const is_blank = !shows_something.test(words);
        const is_taken = !is_blank && this.client.write_chat(words) !== 0;
        set_text($("chat_hint"), is_taken || is_blank ? "" : text("not_sent"));
        return is_taken;
    }

    // A stay begins, or goes on with what was kept of it (run.js).
    begin({ own, unsent, seen, hand_raised }) {
        this.forget();
        this.seen = seen;
        this.own = own;
        this.client.go_on(JSON.stringify({ own, unsent, hand_raised }));
    }

    // Nothing of a stay is there for the next person.
    forget() {
        Object.assign(this, { version: "", messages: [], unsent: [], own: [], seen: "" });
        this.times.clear();
        $("chat_text").value = "";
        $("chat_list").replaceChildren();
        set_text($("chat_hint"), "");
    }

    // `state`: the client's; `visit`: a number of the way of seeing.
    show({ chat, hands = [] }, visit) {
        const { has_chat = false, may_write = false, version = 0, hand_raised = false, wants_hand = false } = chat ?? {};
        this.is_raised = hand_raised;
        if (this.version !== `${visit} ${version}`) {
            this.version = `${visit} ${version}`;
            const { messages, unsent } = JSON.parse(this.client.chat());
            this.fill(messages, unsent);
        }
        const is_open = this.sheet.name === "chat";
        if (is_open) {
            this.seen = this.messages.at(-1)?.id ?? this.seen;
            if (!this.was_open)
                $("chat_list").scrollTop = $("chat_list").scrollHeight;
        }
        this.was_open = is_open;
        const unseen = unseen_of(this.messages, this.seen);
        $("show_chat").hidden = $("raise_hand").hidden = !has_chat;
        set_text($("show_chat"), unseen ? text("labelled", { label: text("chat"), value: String(unseen) }) : text("chat"));
        $("raise_hand").setAttribute("aria-pressed", String(hand_raised));
        set_text($("raise_hand"), text(hand_raised ? "lower_hand" : "raise_hand"));
        set_text($("unseen"), unseen ? text("unseen", { count: unseen }) : "");
        $("unseen").hidden = !unseen;
        const names = [...(hand_raised ? [text("you")] : []), ...hands];
        set_text($("hands"), names.length ? text("hands", { names: names_text(names) }) : "");
        $("hands").hidden = !names.length;
        this.run.keep({ own: this.own, unsent: this.unsent, seen: this.seen, hand_raised: wants_hand });
        for (const part of [$("chat_text"), $("send"), ...document.querySelectorAll("[data-quick]")])
            part.disabled = !may_write;
        if (!may_write)
            set_text($("chat_hint"), text("may_not_write"));
        else if ($("chat_hint").textContent === text("may_not_write"))
            set_text($("chat_hint"), "");
    }

    fill(messages, unsent) {
        Object.assign(this, { messages, unsent });
        this.own = [...new Set([...this.own, ...messages.filter(({ is_own }) => is_own).map(({ id }) => id)])];
        // Once it is known, the time of a message stays, also while the session's time is not known again.
        for (const { id, age_s } of messages)
            if (age_s !== null && !this.times.has(id))
                this.times.set(id, Date.now() - 1000 * age_s);
        const clock = new Intl.DateTimeFormat(document.documentElement.lang, { hour: "2-digit", minute: "2-digit" });
        const item = (name, words, when, kind) => {
            const row = document.createElement("li");
            row.className = kind;
            const head = document.createElement("span");
            head.className = "detail";
            head.textContent = when ? `${name} · ${when}` : name;
            const body = document.createElement("p");
            body.textContent = words;
            row.append(head, body);
            return row;
        };
        const list = $("chat_list"), at_end = list.scrollHeight - list.scrollTop - list.clientHeight < 40;
        list.replaceChildren(
            ...messages.map(({ id, name, text: words, is_own }) => item(
                is_own ? text("you") : name, words, this.times.has(id) ? clock.format(this.times.get(id)) : "", is_own ? "own" : "")),
            ...unsent.map(({ text: words }) => item(text("not_yet_sent"), words, "", "own unsent")));
        $("no_messages").hidden = messages.length + unsent.length > 0;
        if (at_end)
            list.scrollTop = list.scrollHeight;
    }
}
