// SPDX-License-Identifier: Apache-2.0
// The number of a stay, by which the host knows a page that is loaded again: it sends what was missed, and lets the older
// connection go. It is of this tab and this link, and ends when the person leaves.
import { store, stored, tab } from "./storage.js";

const held_for_ms = 2000;  // the page that is loaded again may still hold its number for a moment
const most_own = 100;      // as many messages as a host keeps

function fresh() {
    return [...crypto.getRandomValues(new Uint8Array(8))].map(byte => byte.toString(16).padStart(2, "0")).join("");
}

// A tab that is duplicated has the memory of the first one, but may not be the same stay. Resolves to whether no other tab
// holds the number; this one holds it from then on.
function take(number) {
    return new Promise(resolve => {
        if (!navigator.locks)
            return resolve(false);
        navigator.locks.request(`theatron run ${number}`, { signal: AbortSignal.timeout(held_for_ms) }, () => {
            resolve(true);
            return new Promise(() => {});  // until the page ends
        }).catch(() => resolve(false));
    });
}

export class Run {
    number = "";  // 16 hex digits, once find() has resolved

    // `key`: of the person and the link in this tab's memory.
    constructor(key) {
        this.key = `run ${key}`;
    }

    async find() {
        if (this.number)
            return;
        const known = stored(this.key, tab) ?? "";
        const is_same = /^[0-9a-f]{16}$/.test(known) && await take(known);
        if (is_same)
            this.number = known;
        else
            this.begin();
    }

    // Another stay begins: the next person in this tab is somebody else.
    begin() {
        this.number = fresh();
        take(this.number);
        store(this.key, this.number, tab);
        this.own = new Set();
    }

    // Ids of the messages that were written in this stay.
    get own() {
        return new Set((stored(`${this.key} own`, tab) ?? "").split(" ").filter(Boolean));
    }

    set own(ids) {
        store(`${this.key} own`, [...ids].slice(-most_own).join(" "), tab);
    }
}
