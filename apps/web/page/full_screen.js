// SPDX-License-Identifier: Apache-2.0
// Full screen, where the browser has it for a page: that of an iPhone has it for videos alone.
import { text } from "./texts.js";

const page = document.documentElement;
const element = () => document.fullscreenElement ?? document.webkitFullscreenElement ?? null;

// `tell` gets a sentence when the browser refuses.
export function offer_full_screen(button, tell) {
    const enter = page.requestFullscreen ?? page.webkitRequestFullscreen;
    const leave = document.exitFullscreen ?? document.webkitExitFullscreen;
    button.hidden = !enter || !(document.fullscreenEnabled ?? document.webkitFullscreenEnabled);
    button.addEventListener("click", async () => {
        try {
            await (element() ? leave.call(document) : enter.call(page));
            tell("");
        } catch (error) {
            tell(text("no_full_screen", { why: error?.message ?? "" }));
        }
    });
    for (const event of ["fullscreenchange", "webkitfullscreenchange"])
        document.addEventListener(event, () => name_full_screen(button));
    name_full_screen(button);
}

export function name_full_screen(button) {
    button.textContent = text(element() ? "leave_full_screen" : "full_screen");
}
