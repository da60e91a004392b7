// SPDX-License-Identifier: Apache-2.0
// Loads the modules of a page, beginning with the one that the attribute data-module names. Where a file of them did not
// come, because the host closed a connection that the browser had opened in advance, the page is loaded again: a browser does
// not ask a second time for a module that failed. The page has this script twice, since it may be the file that did not come.
(() => {
    const most_loads = 4, wait_ms = 300, key = "theatron_loads";
    if (globalThis.theatron_started)
        return;
    globalThis.theatron_started = true;
    const { module } = document.currentScript.dataset;

    // Times that this tab has loaded the page without success; too many where the browser keeps nothing.
    const loads = () => {
        try {
            return Number(sessionStorage.getItem(key));
        } catch {
            return most_loads;
        }
    };
    const note_loads = count => {
        try {
            sessionStorage.setItem(key, String(count));
        } catch {
            // As private windows do.
        }
    };

    const load_again = why => {
        console.log(`A file of the page did not come: ${why}`);
        // Otherwise the page's own sentence stays, which says what to do.
        if (loads() + 1 >= most_loads)
            return;
        note_loads(loads() + 1);
        reload();
    };

    // Once the host answers: where the page itself did not come, the browser's own page would take its place for good.
    const reload = () => setTimeout(() => fetch(location.pathname, { method: "HEAD", cache: "no-store" })
        .then(() => location.reload(), reload), wait_ms);

    const is_styled = () => new Promise((resolve, reject) => {
        const look = () => [...document.querySelectorAll("link[rel=stylesheet]")].every(link => link.sheet) ? resolve() : reject(new Error("the style"));
        if (document.readyState === "complete")
            look();
        else
            addEventListener("load", look);
    });
    const load = () => Promise.all([import(`./${module}`), is_styled()])
        .then(() => note_loads(0), error => load_again(error.message));
    if (document.readyState === "loading")
        addEventListener("DOMContentLoaded", load);
    else
        load();
})();
