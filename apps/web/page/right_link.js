// SPDX-License-Identifier: Apache-2.0
// A field for the right link, where this page has a wrong one or none.
import { text } from "./texts.js";

const $ = id => document.getElementById(id);

// The address of an invitation, or null.
export function invitation_in(typed) {
    try {
        const url = new URL(typed.trim());
        const has_token = !!new URLSearchParams(url.hash.slice(1)).get("join");
        return has_token && (url.protocol === "https:" || url.origin === location.origin) ? url.href : null;
    } catch {
        return null;
    }
}

// Instead of the form that enters.
export function ask_for_right_link() {
    if (!$("right_link").hidden)
        return;
    $("right_link").hidden = false;
    document.body.classList.add("wrong_link");
    $("right_link").addEventListener("submit", event => {
        event.preventDefault();
        const address = invitation_in($("link_text").value);
        $("link_problem").textContent = address ? "" : text("not_a_link");
        if (address === location.href)
            location.reload();
        else if (address)
            location.href = address;
    });
    $("link_text").focus();
}
