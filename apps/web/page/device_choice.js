// SPDX-License-Identifier: Apache-2.0
// The microphone, loudspeaker and webcam that the person chose on this computer.
import { store, stored } from "./storage.js";

// {"id","label"} of a kind ("microphone", "loudspeaker", "webcam"), or null: the browser's usual one. Browsers tell
// the names of devices only to a page that may use them, so the label is kept, too.
export function device_choice(kind) {
    try {
        const { id, label } = JSON.parse(stored(`device.${kind}`)) ?? {};
        return typeof id === "string" && id ? { id, label: String(label ?? "") } : null;
    } catch {
        return null;
    }
}

export function choose_device(kind, choice) {
    store(`device.${kind}`, JSON.stringify(choice));
}

// For getUserMedia(): a device that is gone is replaced by the usual one.
export function wanted_device(kind) {
    const choice = device_choice(kind);
    return choice ? { deviceId: { ideal: choice.id } } : {};
}

export const can_choose_loudspeaker = () => "setSinkId" in (globalThis.AudioContext?.prototype ?? {});

// Voices and the test tone come from the chosen loudspeaker, from the usual one where that is gone.
export async function use_loudspeaker(context) {
    const id = device_choice("loudspeaker")?.id ?? "";
    if (can_choose_loudspeaker() && id !== context.sinkId)
        await context.setSinkId(id).catch(() => context.setSinkId("").catch(() => {}));
}
