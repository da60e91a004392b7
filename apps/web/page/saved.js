// SPDX-License-Identifier: Apache-2.0
// A file of the picture that is seen, with a line below it: from where and from when it is, and whether it is live.
import { seconds } from "./dot.js";
import { text } from "./texts.js";

// A picture is covered from this age on.
const old_ms = 2000;
const line_px = 28, margin_px = 10;

// The line below the picture, and the name of its file. `state` is the client's, `date` the time of saving.
export function describe_picture({ host, age_ms, is_not_live, phase, overlay }, date) {
    const is_live = phase === "joined" && !is_not_live && !overlay.cover && age_ms !== null && age_ms < old_ms;
    const at = date.toISOString();
    const how = is_live ? text("saved_live_age", { age: seconds(age_ms) }) : text("saved_not_live");
    return {
        line: `${host} · ${at.slice(0, 19).replace("T", " ")} UTC · ${how}`,
        name: `theatron-${at.slice(0, 19).replaceAll(":", "")}Z${is_live ? "" : "-not-live"}.png`,
    };
}

// To be called in the same task in which a canvas of WebGL was drawn: the browser empties it afterwards. Rejects where the
// browser makes no file of it.
export async function save_picture(canvas, state) {
    const { line, name } = describe_picture(state, new Date());
    const copy = document.createElement("canvas");
    copy.width = canvas.width;
    copy.height = canvas.height + line_px;
    const to = copy.getContext("2d");
    to.drawImage(canvas, 0, 0);
    to.fillStyle = "black";
    to.fillRect(0, canvas.height, copy.width, line_px);
    to.fillStyle = "white";
    to.font = "16px sans-serif";
    to.textBaseline = "middle";
    to.fillText(line, margin_px, canvas.height + line_px / 2, copy.width - 2 * margin_px);
    const blob = await new Promise(done => copy.toBlob(done, "image/png"));
    if (!blob)
        throw new Error(text("no_png"));
    const link = document.createElement("a");
    link.href = URL.createObjectURL(blob);
    link.download = name;
    link.click();
    // The browser reads it after the click.
    setTimeout(() => URL.revokeObjectURL(link.href), 60_000);
}
