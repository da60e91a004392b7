// SPDX-License-Identifier: Apache-2.0
// The panel "Picture": the way of drawing, the codecs and the share of pixels, and what came of each choice.
import { set_text } from "./set_text.js";
import { text } from "./texts.js";

const $ = id => document.getElementById(id);
const scales = [0, 1, 0.75, 0.5, 0.35, 0.25];
const colors = ["auto", "jpeg", "jpeg:quality=60", "h264", "raw"];
const selects = { renderer: "renderer_choice", depth: "depth_choice", color: "color_choice", scale: "scale_choice" };

export class PicturePanel {
    // `next_state()` is called after a choice.
    constructor(client, next_state) {
        const { renderer, depth, color } = JSON.parse(client.picture_choices());
        this.values = { renderer, depth, color: colors.filter(c => c === "auto" || color.includes(c.split(":")[0])), scale: scales.map(String) };
        for (const [what, id] of Object.entries(selects))
            $(id).addEventListener("change", ({ target }) => {
                client.choose(what, target.value);
                next_state();
            });
        this.name();
    }

    // In the page's language.
    name() {
        for (const [what, id] of Object.entries(selects)) {
            const chosen = $(id).value;
            $(id).replaceChildren(...this.values[what].map(value => new Option(name_of(what, value), value)));
            $(id).value = chosen;
        }
    }

    show(state) {
        if ($("sheet").hidden || $("picture").hidden)
            return;
        const { chosen, color, cameras = [] } = state;
        const is_flat = !chosen;
        for (const what of ["renderer", "depth", "scale"])
            $(`${what}_row`).hidden = is_flat;
        this.select("color", color?.is_chosen ? color.asked : "auto");
        const now = came(cameras.map(c => c.color)), why = color?.is_chosen ? "" : color?.reason;
        set_text($("color_now"), now && why ? text("also", { first: now, second: why }) : now || why || "");
        if (is_flat)
            return;
        this.select("renderer", chosen.renderer);
        this.select("depth", chosen.depth);
        this.select("scale", String(chosen.scale));
        $("renderer_choice").disabled = chosen.renderer_locked;
        set_text($("renderer_now"), chosen.renderer_locked ? text("forced_by_host", { name: state.renderer })
            : chosen.renderer === "auto" ? text("now", { name: state.renderer }) : "");
        set_text($("depth_now"), came(cameras.map(c => c.depth)));
        set_text($("scale_now"), text("now", { name: percent(state.scale) }) + (state.depth_step > 1 ? `, ${text("fewer_points")}` : ""));
    }

    // A value that came otherwise (by a key, or by the link) is among them, too.
    select(what, value) {
        const place = $(selects[what]);
        if (document.activeElement === place && place.dataset.was === value)
            return;  // the person is choosing
        place.dataset.was = value;
        const kind = value.split(":")[0];
        if (![...place.options].some(option => option.value === value)) {
            if (value !== kind && what === "color" && value === "jpeg:quality=85")
                value = kind;
            else
                place.append(new Option(name_of(what, value), value));
        }
        place.value = value;
    }
}

// The codecs that the cameras' pictures have, whatever was asked for.
function came(codecs) {
    const all = [...new Set(codecs.filter(Boolean))];
    return all.length ? text("comes_as", { name: all.join(", ") }) : "";
}

const percent = scale => `${Math.round(100 * scale)} %`;

function name_of(what, value) {
    if (what === "scale")
        return value === "0" ? text("automatic") : percent(Number(value));
    return value === "auto" ? text("automatic") : value;
}
