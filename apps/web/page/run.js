// SPDX-License-Identifier: Apache-2.0
// A person's stay, which goes on when the page is loaded again: its number, by which the host sends what was missed and lets
// the older connection go, and what was written, read and raised. It is of this tab, this link and this name, and ends when
// the person leaves.
import { store, stored, tab } from "./storage.js";

const held_for_ms = 2000;  // the page that is loaded again may still hold its number for a moment
const most_own = 100;      // as many messages as a host keeps

function fresh() {
    return [...crypto.getRandomValues(new Uint8Array(8))].map(byte => byte.toString(16).padStart(2, "0")).join("");
}

// A tab that is duplicated has the memory of the first one, but may not be the same stay. Resolves to whether no other tab
// holds the number; this one holds it from then on. Browsers may not have locks, or refuse them.
function take(number) {
    return new Promise(resolve => {
        try {
            const patience = new AbortController();
            setTimeout(() => patience.abort(), held_for_ms);
            navigator.locks.request(`theatron run ${number}`, { signal: patience.signal }, () => {
                resolve(true);
                return new Promise(() => {});  // until the page ends
            }).catch(() => resolve(false));
        } catch {
            resolve(false);
        }
    });
}

const list = value => Array.isArray(value) ? value : [];

// Reads what keep() has written. The memory of a tab may hold anything.
function parsed(words) {
    try {
        const { number = "", name, own, unsent, seen, hand_raised } = JSON.parse(words);
        return { number: String(number), name, own: list(own), unsent: list(unsent), seen: String(seen ?? ""), hand_raised: hand_raised === true };
    } catch {
        return {};
    }
}

export class Run {
    number = "";  // 16 hex digits, from find() until end()

    // `key`: of the person and the link in this tab's memory.
    constructor(key) {
        this.key = `run ${key}`;
    }

    // Begins a stay of this person, or goes on with that of the page before it was loaded again: the next person in this
    // tab is somebody else. Resolves to what was kept of it.
    async find(name) {
        const known = parsed(stored(this.key, tab));
        const is_same = known.name === name && /^[0-9a-f]{16}$/.test(known.number)
            && (known.number === this.number || await take(known.number));
        const kept = is_same ? known : { own: [], unsent: [], seen: "", hand_raised: false };
        this.name = name;
        this.number = is_same ? known.number : fresh();
        if (!is_same)
            take(this.number);
        this.keep(kept);
        return kept;
    }

    // `own`: ids of the messages that the person wrote; `unsent`: {id, text} of those that the host may not have; `seen`: id
    // of the newest message that was seen; `hand_raised`: as the person asked for it.
    keep({ own, unsent, seen, hand_raised }) {
        const kept = JSON.stringify({ number: this.number, name: this.name, own: own.slice(-most_own), unsent, seen, hand_raised });
        if (this.number && kept !== this.kept)
            store(this.key, this.kept = kept, tab);
    }

    end() {
        this.number = this.kept = "";
        store(this.key, "", tab);
    }
}
