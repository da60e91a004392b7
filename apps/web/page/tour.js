// SPDX-License-Identifier: Apache-2.0
// Three steps for somebody who is here for the first time: how to look around, to point and speak, to leave. The card lies on
// the picture, above the buttons that it names, and takes neither keys nor clicks but those on its own buttons.
import { set_text } from "./set_text.js";
import { store, stored } from "./storage.js";
import { text } from "./texts.js";

const $ = id => document.getElementById(id);
const memory = "tour", steps = 3;

// [key of the text, buttons that it names], by what this person has here.
function content_of(step, way) {
    const has = id => !$(id).hidden;
    if (step === 1)
        return way === "flat" ? ["tour_look_flat", ["next_camera"]] : ["tour_look", []];
    if (step === 2)
        return has("microphone") ? ["tour_act", ["microphone", "point"]] : ["tour_watch", ["show_people"]];
    return ["tour_leave", ["leave", "show_more"]];
}

export class Tour {
    step = 0;  // 1 to 3; 0: it is not shown
    is_due = stored(memory) !== "seen";

    // `home()` returns the element that gets the focus of a card that goes.
    constructor(home) {
        this.home = home;
        $("tour_next").addEventListener("click", () => this.step < steps ? this.go(this.step + 1) : this.end());
        $("tour_skip").addEventListener("click", () => this.end());
    }

    // Follows each state of the client.
    show({ phase, has_picture, cameras }, way) {
        this.way = way;
        if (phase !== "joined" && this.step) {
            this.is_due = true;  // it was broken off, also by the change to the other view
            this.hide();
        } else if (phase === "joined" && this.is_due && !this.step && (has_picture || !cameras.length))
            this.go(1);
        else if (this.step)
            this.fill();
    }

    begin() {
        this.go(1);
        $("tour_next").focus();
    }

    go(step) {
        this.step = step;
        $("tour").hidden = false;
        this.fill();
    }

    // Seen, or skipped: this browser does not show it by itself again.
    end() {
        this.is_due = false;
        store(memory, "seen");
        this.hide();
    }

    hide() {
        const had_focus = $("tour").contains(document.activeElement);
        this.step = 0;
        $("tour").hidden = true;
        this.name([]);
        if (had_focus)
            this.home().focus({ preventScroll: true });
    }

    // Buttons come and go with the role and the way of seeing.
    fill() {
        const [key, names] = content_of(this.step, this.way);
        set_text($("tour_title"), text("tour_step", { step: this.step, steps }));
        set_text($("tour_text"), text(key));
        set_text($("tour_next"), text(this.step < steps ? "tour_next" : "tour_done"));
        $("tour_skip").hidden = this.step === steps;
        this.name(names);
    }

    name(ids) {
        for (const button of document.querySelectorAll("#bar button"))
            button.classList.toggle("named", ids.includes(button.id));
    }
}
