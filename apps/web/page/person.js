// SPDX-License-Identifier: Apache-2.0
// The page's memory of a person. Without the mark "Remember me" it is of this tab alone: several people may use one browser,
// and the host decides by a person's random number whom it has admitted, muted or removed.
import { computer, forget, store, stored, tab } from "./storage.js";

const of_person = ["name", "speaks", "pushes"];

// A number belongs to a link: with another link one is another person.
async function key_of(token) {
    const digest = await crypto.subtle.digest("SHA-256", new TextEncoder().encode(token));
    return `person.${hex(new Uint8Array(digest, 0, 8))}`;
}

function hex(bytes) {
    return [...bytes].map(byte => byte.toString(16).padStart(2, "0")).join("");
}

export class Person {
    constructor(key) {
        this.key = key;
        this.is_remembered = stored("remember") === "yes";
        const known = (this.is_remembered && stored(key)) || stored(key, tab);
        this.number = /^[0-9a-f]{32}$/.test(known ?? "") ? known : hex(crypto.getRandomValues(new Uint8Array(16)));
        // Older pages kept a number and a name of everybody.
        if (!this.is_remembered)
            forget_all();
    }

    static async of(token) {
        return new Person(await key_of(token));
    }

    // In a tab it stays the same, also if the page is loaded again.
    get id() {
        store(this.key, this.number, this.memory);
        return this.number;
    }

    choice(name) {
        return stored(name, this.memory);
    }

    // With the mark for the next visits on this computer; without it for this tab, and the computer forgets.
    remember(is_wanted, choices) {
        this.is_remembered = is_wanted;
        if (is_wanted)
            store("remember", "yes");
        else
            forget_all();
        for (const [name, value] of Object.entries(choices))
            store(name, value, this.memory);
    }

    // Another tab may have made the computer forget meanwhile.
    get memory() {
        return this.is_remembered && stored("remember") === "yes" ? computer : tab;
    }
}

function forget_all() {
    forget(name => [...of_person, "remember", "person"].includes(name) || name.startsWith("person."));
}
