// SPDX-License-Identifier: Apache-2.0
// The test call: do microphone, loudspeaker and webcam work, what does the line to the host carry, how many cameras does this
// computer draw. A dialog, before one enters and inside. Nothing but the test of the line leaves the computer, and closing it
// ends all of it.
import { judge_computer, measure_computer } from "./computer.js";
import { DeviceCheck } from "./devices.js";
import { LineProblem, judge_line, measure_line } from "./line.js";
import { text } from "./texts.js";

const $ = id => document.getElementById(id);

export class TestCall {
    running = null;  // AbortController of what is measured
    figures = {};    // for tests and measurements: what was measured last

    // `token` of the link; `program()` resolves to { time_depth, graphics, workers } once the page's program is there;
    // `is_heard()`: the others hear this microphone now; `chosen(kind)` follows the choice of another device.
    constructor({ token, program, is_heard, chosen }) {
        Object.assign(this, { token, program, is_heard });
        this.devices = new DeviceCheck(chosen);
        for (const id of ["show_test_call", "show_test_call_inside"])
            $(id).addEventListener("click", () => this.open());
        $("test_call").addEventListener("close", () => this.close());
        $("test_line").addEventListener("click", () => this.measure(signal => this.try_line(signal)));
        $("test_computer").addEventListener("click", () => this.measure(signal => this.try_computer(signal)));
    }

    // Inside, a measurement waits until somebody asks: pictures are drawn and sent meanwhile.
    open() {
        const is_inside = $("lobby").hidden;
        $("heard_meanwhile").hidden = !is_inside || !this.is_heard();
        $("test_call").showModal();
        $("test_call_content").scrollTop = 0;
        this.devices.begin();
        if (!is_inside && !this.figures.line && !this.figures.computer)
            this.measure(async signal => {
                await this.try_line(signal);
                await this.try_computer(signal);
            });
    }

    close() {
        this.running?.abort();
        this.running = null;
        this.devices.close();
        if ($("test_call").open)
            $("test_call").close();
    }

    // One measurement at a time: two would measure each other.
    async measure(act) {
        if (this.running)
            return;
        const { signal } = this.running = new AbortController();
        this.show();
        try {
            await act(signal);
        } catch (error) {
            if (!signal.aborted)
                throw error;
        } finally {
            if (this.running?.signal === signal)
                this.running = null;
            this.show();
        }
    }

    async try_line(signal) {
        say("line", [["line_runs"]]);
        try {
            const line = await measure_line(this.token, signal), { back, down, up } = judge_line(line);
            this.figures.line = line;
            say("line", [down, up, back]);
        } catch (error) {
            say("line", error instanceof LineProblem ? [[error.message]] : []);
            if (!(error instanceof LineProblem))
                throw error;
        }
    }

    async try_computer(signal) {
        say("computer", [["computer_runs"]]);
        try {
            const { graphics, ...program } = await this.program();
            signal.throwIfAborted();
            const computer = await measure_computer({ ...program, graphics, signal });
            this.figures.computer = computer;
            say("computer", [judge_computer({ ...computer, graphics })]);
        } catch (error) {
            say("computer", signal.aborted ? [] : [["computer_unknown", { why: error.message }]]);
            signal.throwIfAborted();
        }
    }

    show() {
        for (const id of ["test_line", "test_computer"])
            $(id).setAttribute("aria-disabled", String(!!this.running));  // a disabled one would lose the focus
    }
}

function say(what, sentences) {
    $(`${what}_says`).textContent = sentences.map(([key, values]) => text(key, values)).join("\n");
}
