// SPDX-License-Identifier: Apache-2.0
// The sentences beside the picture, and how long they stay: a warning that lasts is shown once and is then a sign on the dot.

const shown_ms = 8000;    // a warning
const again_ms = 60000;   // a warning that was away for so long is shown again
const unrest_ms = 60000;  // cameras that stand still and go on within this time are one sign

// Ages and counts change; the sentence is the same.
const kind_of = sentence => sentence.replace(/\d+/g, "0");

export class Notices {
    said = new Map();  // kind -> { since, last } in milliseconds
    unrest = [];           // when a camera stood still or went on
    notice = "";

    // The client's sentences at this moment; `of_camera`: the notice tells that a camera stands still or goes on. `once`: the
    // page's own sentences, such as why it shows something else than before; "": none.
    // Returns the sentences to show now, and the warning and the number of such notices that are signs of the dot.
    at(now_ms, { warning, notice, of_camera, once = [] }) {
        const shown = once.filter(sentence => sentence && this.is_new(now_ms, sentence));
        if (warning && this.is_new(now_ms, kind_of(warning)))
            shown.push(warning);
        this.unrest = this.unrest.filter(at_ms => now_ms - at_ms < unrest_ms);
        if (notice !== this.notice) {
            this.notice = notice;
            this.is_merged = of_camera && this.unrest.length > 0;
            if (of_camera)
                this.unrest.push(now_ms);
        }
        if (notice && !this.is_merged)
            shown.push(notice);
        return { shown, warning, unrest: this.unrest.length > 1 ? this.unrest.length : 0 };
    }

    is_new(now_ms, kind) {
        const known = this.said.get(kind);
        const since = known && now_ms - known.last < again_ms ? known.since : now_ms;
        this.said.set(kind, { since, last: now_ms });
        return now_ms - since < shown_ms;
    }
}
