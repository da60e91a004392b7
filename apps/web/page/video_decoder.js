// SPDX-License-Identifier: Apache-2.0
// H.264 by the browser's own decoders (WebCodecs), for the program's (src/video/h264_web.cpp). In a page as well as in a
// worker; decoding itself happens on threads of the browser.

// A picture of which nothing is heard in all these looks does not come any more. They are looks and no time: a page that
// stood still for seconds has not heard yet what is there.
const look_every_ms = 250;
const most_looks = 8;
// Any that the programs send; the stream's own is given with its first picture.
const usual = "avc1.42c01f";

const config_of = codec => ({ codec, optimizeForLatency: true });

export async function decodes_h264() {
    try {
        return (await VideoDecoder.isConfigSupported(config_of(usual))).supported === true;
    } catch {
        return false;  // no WebCodecs here
    }
}

// True if the program can decode H.264 from now on.
export async function offer_h264(module) {
    if (!await decodes_h264())
        return false;
    const all = new Map();
    let newest = 0;
    module.h264 = {
        open() {
            all.set(++newest, new Decoder(newest, module));
            return newest;
        },
        decode: (id, ...picture) => all.get(id).decode(...picture),
        close(id) {
            all.get(id).close();
            all.delete(id);
        },
    };
    module._theatron_use_h264(1);
    return true;
}

class Decoder {
    decoder = null;
    codec = "";
    buffer = new ArrayBuffer(0);
    copying = Promise.resolve();
    waiting = 0;  // pictures
    looks = 0;  // in vain, since anything was heard
    timer = null;

    constructor(id, module) {
        Object.assign(this, { id, module });
    }

    // Answers later in any case. A key frame begins anew after a failure.
    decode(codec, is_key, number, data) {
        try {
            if (!this.decoder || codec !== this.codec)
                this.begin(codec);
            this.decoder.decode(new EncodedVideoChunk({ type: is_key ? "key" : "delta", timestamp: number, data }));
            if (++this.waiting === 1)
                this.watch();
        } catch (error) {
            this.fail(error);
        }
    }

    begin(codec) {
        this.close();
        const decoder = this.decoder = new VideoDecoder({
            // Pictures are copied one after the other, so that their order stays.
            output: frame => { this.copying = this.copying.then(() => this.take(frame, decoder)); },
            error: error => this.decoder === decoder && this.fail(error),
        });
        this.codec = codec;
        decoder.configure(config_of(codec));
    }

    async take(frame, decoder) {
        try {
            if (this.decoder !== decoder)
                return;
            await this.hand_over(frame, decoder);
        } catch (error) {
            if (this.decoder === decoder)
                this.fail(error);
        } finally {
            frame.close();
        }
    }

    async hand_over(frame, decoder) {
        const is_planar = frame.format === "I420" || frame.format === "NV12";
        // Those of graphics cards may have a form of their own.
        const options = is_planar ? {} : { format: "RGBX" };
        const size = frame.allocationSize(options);
        if (this.buffer.byteLength < size)
            this.buffer = new ArrayBuffer(size);
        const planes = await frame.copyTo(this.buffer, options);
        if (this.decoder !== decoder)
            return;
        const { id, module } = this;
        const { width, height } = frame.visibleRect;
        // The memory may grow, and then its views are others.
        const address = module._theatron_h264_memory(id, size);
        if (!address)
            throw new Error("the picture is too large");
        module.HEAPU8.set(new Uint8Array(this.buffer, 0, size), address);
        --this.waiting;
        this.watch();
        const [y, u, v = { offset: u?.offset + 1, stride: u?.stride }] = planes;
        if (is_planar)
            module._theatron_h264_planes(id, frame.timestamp, width, height, y.offset, y.stride, u.offset, v.offset, u.stride,
                frame.format === "NV12" ? 2 : 1);
        else
            module._theatron_h264_pixels(id, frame.timestamp, width, height, y.offset, y.stride);
    }

    watch() {
        this.looks = 0;
        clearInterval(this.timer);
        if (this.waiting > 0)
            this.timer = setInterval(() => this.look(), look_every_ms);
    }

    look() {
        if (++this.looks === most_looks)
            this.fail(new Error(`no picture came for ${most_looks * look_every_ms} ms`));
    }

    // The program may be at work: it is told afterwards.
    fail(error) {
        console.log(`H.264 failed: ${error.message}`);
        this.close();
        queueMicrotask(() => this.module._theatron_h264_failed(this.id));
    }

    close() {
        clearInterval(this.timer);
        if (this.decoder && this.decoder.state !== "closed")
            this.decoder.close();
        this.decoder = null;
        this.waiting = 0;
    }
}
