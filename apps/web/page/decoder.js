// SPDX-License-Identifier: Apache-2.0
// A decoding worker. Its first message brings the program; the others are the program's own.
import make_client from "./client.mjs";
import { put_bytes, with_program } from "./program.js";
import { offer_h264 } from "./video_decoder.js";

onmessage = async ({ data: { program, origin_ms } }) => {
    const module = await make_client(with_program(program));
    module.cwrap("theatron_use_language", null, ["string"])(navigator.language);
    module.post_reply = bytes => postMessage(bytes.buffer, [bytes.buffer]);
    module._theatron_begin_decoder(origin_ms - performance.timeOrigin);
    onmessage = ({ data }) => {
        put_bytes(module, data);
        module._theatron_decode();
    };
    postMessage({ has_h264: await offer_h264(module) });
};
