// SPDX-License-Identifier: Apache-2.0
// Decoding beside the page's thread: workers (decoder.js) with the page's program, each with memory of its own.
import { put_bytes, with_patience } from "./program.js";

const most_workers = 4;

// Workers that are ready, each with `has_h264`. None where the browser starts none: then the page decodes. `program` may
// still be loading; meanwhile the workers load their own script.
export async function start_workers(program) {
    const count = Math.min(Math.max(navigator.hardwareConcurrency ?? 1, 1), most_workers);
    const workers = [], started = [];
    const start_one = () => new Promise((resolve, reject) => {
        const worker = new Worker("decoder.js", { type: "module" });
        started.push(worker);
        worker.onmessage = ({ data: { has_h264 } }) => {
            worker.has_h264 = has_h264;
            workers.push(worker);
            resolve();
        };
        worker.onerror = event => reject(new Error(event.message ?? "a worker did not start"));
        program.then(loaded => worker.postMessage({ program: loaded, origin_ms: performance.timeOrigin }), reject);
    });
    try {
        await Promise.all(Array.from({ length: count }, () => with_patience(start_one)));
        return workers;
    } catch (error) {
        console.log(`The page decodes by itself: ${error.message}`);
        started.forEach(worker => worker.terminate());
        return [];
    }
}

// Joins them to the page's client. `failed`: one ended with a fault; from then on the page decodes.
export function join_workers(module, workers, failed) {
    module.post_work = (index, bytes) => workers[index]?.postMessage(bytes.buffer, [bytes.buffer]);
    workers.forEach((worker, index) => {
        worker.onmessage = ({ data }) => {
            put_bytes(module, data);
            module._theatron_decoded(index);
        };
        worker.onerror = () => {
            workers.forEach(other => other.terminate());
            workers.length = 0;
            module._theatron_use_decoders(0);
            failed();
        };
    });
    module._theatron_use_decoders(workers.length);
}
