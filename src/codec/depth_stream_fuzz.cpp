// SPDX-License-Identifier: Apache-2.0
// A hostile stream: arbitrary links and bytes into the decoder of a stream with three
// layers. Decoding stays inside its buffers, and a valid key frame decodes afterwards.
#include <algorithm>
#include <cstdlib>

#include "codec/depth_stream.h"
#include "codec/test_images.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace theatron;
    using namespace theatron::codec;
    const DepthSetting setting = parse_depth_setting("trvl:layers=3").setting;
    DepthStreamDecoder decoder(setting);
    const Size image_size{16, 9};
    DepthImage out(image_size);

    // Messages: length, frame, reference, layer and key, then the bytes.
    ByteReader in(std::as_bytes(std::span(data, size)));
    while (in.ok() && !in.rest().empty()) {
        const auto length = in.get<std::uint8_t>();
        FrameLink link;
        link.frame = in.get<std::uint8_t>();
        link.reference_frame = in.get<std::uint8_t>();
        const auto kind = in.get<std::int8_t>();
        link.key = (kind & 1) != 0;
        link.layer = kind / 2;
        const ByteView bytes = in.get_bytes(std::min<std::size_t>(length, in.rest().size()));
        (void)decoder.decode(link, bytes, out.view());
    }

    DepthStreamEncoder encoder(setting);
    const DepthImage image = scene(image_size, 1);
    Bytes whole(encoder.max_encoded_size(image_size));
    const EncodedDepth encoded = encoder.encode(image.view(), 7, true, whole);
    if (decoder.decode(encoded, ByteView(whole).first(encoded.bytes), out.view()) != Status::ok ||
        !(out == image))
        std::abort();
    return 0;
}
