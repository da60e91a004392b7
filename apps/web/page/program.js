// SPDX-License-Identifier: Apache-2.0
// A file of this page may not come: the host closes connections that the browser opened in advance and did not use.
const most_tries = 3;

// The result of `attempt`, of the last one if others failed.
export async function with_patience(attempt) {
    for (let tries = 1; ; ++tries) {
        try {
            return await attempt();
        } catch (error) {
            if (tries === most_tries)
                throw error;
            console.log(`again after: ${error.message}`);
        }
    }
}

// The compiled program (apps/web/main.cpp), which the page and its decoding workers share.

// Options of make_client() for a program that is compiled already.
export function with_program(program) {
    return {
        instantiateWasm(imports, use) {
            WebAssembly.instantiate(program, imports).then(use);
            return {};
        },
    };
}

// For the program's next function.
export function put_bytes(module, buffer) {
    // The memory may grow, and then its views are others.
    const address = module._theatron_memory(buffer.byteLength);
    module.HEAPU8.set(new Uint8Array(buffer), address);
}
