// SPDX-License-Identifier: Apache-2.0
// The page's memory on this computer; empty where the browser keeps nothing for this site.
export function stored(key) {
    try {
        return localStorage.getItem(key);
    } catch {
        return null;
    }
}

export function store(key, value) {
    try {
        localStorage.setItem(key, value);
    } catch {
        // The next visit asks again.
    }
}
