// SPDX-License-Identifier: Apache-2.0
// Measures the line to the host: its rate in both directions, and the time of the way there and back. The host bounds
// the bytes (docs/limits.md); here the time is bounded, to about two seconds.
import { ask_host } from "./host_request.js";
import { language, text } from "./texts.js";

const round_trips = 4, down_bytes = 2 << 20, longest_way_ms = 900, patience_ms = 4000;
const up_bytes = [16 << 10, 64 << 10, 256 << 10];
const clear_ms = 250;     // a body that took so long says enough
const warm_share = 0.25;  // of the time of an answer, in which the line is still being felt for
const part_ms = 200;       // of an answer, that shows its rate
const entry_waits_ms = 300;
const most_mbit = 100;  // more is not told apart

// Why nothing could be measured: a key of a text.
export class LineProblem extends Error {}

const problems = { 401: "line_refused", 403: "line_refused", 404: "line_old_host", 405: "line_old_host", 410: "line_refused",
                   429: "line_busy" };

let asked = 0;

// `signal` ends the measurement. Throws LineProblem.
export async function measure_line(token, signal) {
    const ask = (bytes, body) => request(token, bytes, signal, body);
    try {
        const trips = [];
        for (let i = 0; i < round_trips; ++i)
            trips.push(await timed(() => ask(0)));
        const round_trip_ms = Math.min(...trips);
        return { round_trip_ms, down_mbit: await measure_down(ask), up_mbit: await measure_up(ask, round_trip_ms) };
    } catch (error) {
        throw signal.aborted || error instanceof LineProblem ? error : new LineProblem("line_silent");
    }
}

// `body`: is sent; without it there is an answer of `bytes`.
async function request(token, bytes, signal, body) {
    const ends = AbortSignal.any?.([signal, AbortSignal.timeout(patience_ms)]) ?? signal;
    const path = `/line?bytes=${bytes}&n=${++asked}`;  // its times are found by this number
    const answer = await ask_host(token, path, { method: body ? "POST" : "GET", body, signal: ends });
    if (!answer.ok)
        throw new LineProblem(problems[answer.status] ?? "line_silent");
    return answer;
}

// Milliseconds of an empty answer or a body, without the making of its connection where the browser tells that.
async function timed(ask) {
    const entry = entry_of(`&n=${asked + 1}`), begin = performance.now();
    try {
        await (await ask()).arrayBuffer();
        const whole_ms = performance.now() - begin;
        const told = await Promise.race([entry.found, new Promise(late => setTimeout(late, entry_waits_ms))]);
        return told?.requestStart > 0 ? told.responseStart - told.requestStart : whole_ms;
    } finally {
        entry.observer.disconnect();
    }
}

// The browser's times of a request whose address ends so.
function entry_of(end) {
    let resolve;
    const found = new Promise(done => resolve = done);
    const observer = new PerformanceObserver(list => {
        const entry = list.getEntries().find(({ name }) => name.endsWith(end));
        if (entry)
            resolve(entry);
    });
    observer.observe({ type: "resource" });
    return { found, observer };
}

async function measure_down(ask) {
    const answer = await ask(down_bytes), reader = answer.body.getReader();
    const begin = performance.now(), marks = [];  // [time, bytes until then]
    let bytes = 0;
    for (let now = begin; now - begin < longest_way_ms;) {
        const { done, value } = await reader.read();
        if (done)
            break;
        now = performance.now();
        marks.push([now, bytes += value.length]);
    }
    reader.cancel().catch(() => {});
    return rate_of(marks);
}

// In Mbit/s, of the best part of this length, or of what came behind the first part of a shorter time: a line is still
// being felt for at first, and a busy computer reads in gusts.
export function rate_of(marks) {
    if (marks.length < 2)
        return marks.length ? most_mbit : 0;
    const [first_ms] = marks[0], [last_ms, last_bytes] = marks.at(-1);
    const [from_ms, from_bytes] = marks.find(([ms]) => ms >= first_ms + warm_share * (last_ms - first_ms));
    let best = mbit_of(last_bytes - from_bytes, last_ms - from_ms), end = 0;
    for (const [ms, bytes] of marks) {
        while (end < marks.length && marks[end][0] < ms + part_ms)
            ++end;
        if (end === marks.length)
            break;
        best = Math.max(best, mbit_of(marks[end][1] - bytes, marks[end][0] - ms));
    }
    return best;
}

function mbit_of(bytes, ms) {
    return Math.min(most_mbit, ms > 0 ? bytes * 8 / 1000 / ms : most_mbit);
}

// The largest body that the time allows says how fast it went.
async function measure_up(ask, round_trip_ms) {
    const begin = performance.now();
    let mbit = 0;
    for (const bytes of up_bytes) {
        const ms = await timed(() => ask(0, noise(bytes)));
        mbit = mbit_of(bytes, Math.max(ms - round_trip_ms, 0.1));
        if (ms > clear_ms || performance.now() - begin > longest_way_ms)
            break;
    }
    return mbit;
}

function noise(bytes) {
    const made = new Uint8Array(bytes), most_at_once = 1 << 16;
    for (let at = 0; at < bytes; at += most_at_once)
        crypto.getRandomValues(made.subarray(at, at + most_at_once));
    return made;
}

// Each direction is judged by the rates that cameras and people take (docs/browser.md).
const camera_mbit = 15, few_mbit = 4, flat_mbit = 2, shown_mbit = 2, voice_mbit = 0.2;
const most_cameras = 6, short_ms = 150, long_ms = 400;

// [key, values] of each sentence: on the way there and back, from the host, to the host.
export function judge_line({ round_trip_ms, down_mbit, up_mbit }) {
    const cameras = Math.min(most_cameras, Math.floor(down_mbit / camera_mbit));
    return {
        back: [round_trip_ms < short_ms ? "line_short" : round_trip_ms < long_ms ? "line_long" : "line_very_long",
               { ms: Math.max(1, Math.round(round_trip_ms)) }],
        down: [cameras > 1 ? "line_many" : cameras === 1 ? "line_one" : down_mbit >= few_mbit ? "line_few" : down_mbit >= flat_mbit
            ? "line_flat" : "line_narrow", { rate: rate_text(down_mbit), count: cameras }],
        up: [up_mbit >= shown_mbit ? "line_shown" : up_mbit >= voice_mbit ? "line_voice" : "line_mute", { rate: rate_text(up_mbit) }],
    };
}

function rate_text(mbit) {
    const digits = new Intl.NumberFormat(language, { maximumFractionDigits: mbit < 10 ? 1 : 0 });
    return mbit >= most_mbit ? text("more_than", { count: most_mbit }) : digits.format(Math.max(mbit, 0.1));
}
