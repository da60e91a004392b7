// SPDX-License-Identifier: Apache-2.0
// The covers of a picture that no longer shows the present: one that the cameras have not renewed, which the client tells, and
// one that this page has not drawn. The second cover is an animation that each drawn picture begins anew. The browser carries
// it out beside the page's own thread, so that it comes also while that hangs. Neither can help where the browser itself
// draws nothing any more.
import { text } from "./texts.js";

const still_after_ms = 2000, begun_anew_every_ms = 250;
const line_px = 40, longest_min = 60;
const lost_phases = ["lost", "ended", "refused"];

// Styles by properties: the page allows no others.
function element(style, content = "") {
    const made = document.createElement("div");
    Object.assign(made.style, style);
    made.textContent = content;
    return made;
}

const over_all = { position: "fixed", inset: "0", pointerEvents: "none" };
const plate = { position: "absolute", left: "50%", top: "40%", transform: "translate(-50%, -50%)", whiteSpace: "pre",
                background: "#181a1e", color: "#ffbe46", padding: "16px 24px", borderRadius: "8px", fontSize: "24px",
                fontWeight: "bold", lineHeight: `${line_px}px`, display: "flex", gap: "0.4em" };

// [milliseconds since the last picture, words], from the first ones of the cover on.
export function ages() {
    const seconds = Array.from({ length: 58 }, (_, i) => [1000 * (i + 2), `${i + 2} s`]);
    const minutes = Array.from({ length: longest_min }, (_, i) => [60000 * (i + 1), `${i + 1} min`]);
    return [...seconds, ...minutes];
}

export class StillCover {
    // Covers what lies before `panels` in the page, and where the page hangs the panels, too.
    constructor(panels) {
        this.cover = element({ ...over_all, background: "rgba(24, 26, 30, 0.8)", display: "none" });
        this.cover.id = "still";
        this.cover.setAttribute("role", "status");
        this.words = element(plate);
        this.cover.append(this.words);
        panels.before(this.cover);

        this.hung = element({ ...over_all, background: "#181a1e", opacity: "0", display: "none" });
        this.hung.id = "hung";
        this.hung.setAttribute("aria-hidden", "true");
        this.sentence = element({});
        const frame = element({ height: `${line_px}px`, overflow: "hidden" });
        this.strip = element({});
        this.strip.append(...ages().map(([, words]) => element({ height: `${line_px}px` }, words)));
        frame.append(this.strip);
        const words = element(plate);
        words.append(this.sentence, frame);
        this.hung.append(words);
        panels.after(this.hung);
        this.animations = [];
        this.begun_ms = -Infinity;
    }

    // The client's words on pictures that do not come. In other phases the message says why; the picture is only darkened.
    show({ phase, has_picture, overlay }) {
        const words = overlay.cover;
        const is_dark = Boolean(words) || (lost_phases.includes(phase) && has_picture);
        this.cover.style.display = is_dark ? "block" : "none";
        this.words.style.display = words ? "flex" : "none";
        if (this.words.textContent !== words)
            this.words.textContent = words;
    }

    // The picture on the page was drawn, or nothing in it has changed.
    beat(now_ms) {
        if (now_ms - this.begun_ms < begun_anew_every_ms)
            return;
        this.begun_ms = now_ms;
        if (!this.animations.length)
            this.begin();
        for (const animation of this.animations)
            animation.currentTime = 0;
    }

    // No picture is shown that could be taken for live.
    rest() {
        for (const animation of this.animations)
            animation.cancel();
        this.animations = [];
        this.begun_ms = -Infinity;
        this.hung.style.display = this.cover.style.display = "none";
        this.words.textContent = "";
    }

    begin() {
        this.sentence.textContent = text("page_stands_still");
        this.hung.style.display = "block";
        const all = ages(), duration = all[all.length - 1][0];
        const timing = { duration, fill: "forwards" };
        const appears = still_after_ms / duration;
        this.animations = [
            this.hung.animate([{ opacity: 0, offset: 0, easing: "steps(1)" }, { opacity: 1, offset: appears }, { opacity: 1, offset: 1 }], timing),
            this.strip.animate([{ transform: "translateY(0)", offset: 0, easing: "steps(1)" }, ...all.map(([ms], i) => ({
                transform: `translateY(${-line_px * i}px)`, offset: ms / duration, easing: "steps(1)" }))], timing),
        ];
    }
}
