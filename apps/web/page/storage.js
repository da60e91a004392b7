// SPDX-License-Identifier: Apache-2.0
// The page's memory on this computer, or of this tab; empty where the browser keeps nothing for this site.
export const computer = () => localStorage, tab = () => sessionStorage;

export function stored(key, memory = computer) {
    try {
        return memory().getItem(key);
    } catch {
        return null;
    }
}

export function store(key, value, memory = computer) {
    try {
        memory().setItem(key, value);
    } catch {
        // The next visit asks again.
    }
}

// All keys of this computer's memory for which `is_meant` holds.
export function forget(is_meant) {
    try {
        for (const key of Object.keys(localStorage).filter(is_meant))
            localStorage.removeItem(key);
    } catch {
        // There is nothing to forget.
    }
}
