// SPDX-License-Identifier: Apache-2.0
// Any bytes, as a key frame and as a frame that refers to one, end in a status
// or in an image of the size in their header.
#include <cstdlib>

#include "video/depth_codecs.h"

namespace {

using namespace theatron;

Bytes good_key_frame(const codec::DepthSetting& setting) {
    const DepthImage image({16, 16});
    codec::DepthStreamEncoder encoder = video::make_depth_encoder(setting);
    Bytes bytes(encoder.max_encoded_size(image.size));
    bytes.resize(encoder.encode(image.view(), 1, true, bytes).bytes);
    return bytes;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const codec::DepthSetting setting = video::parse_depth_setting("h264").setting;
    static const Bytes key = good_key_frame(setting);
    static codec::DepthStreamDecoder decoder = video::make_depth_decoder(setting);
    const auto input = std::as_bytes(std::span(data, size));
    const auto promised = decoder.read_size(input);
    // Larger pictures only make the search slow.
    if (!promised || promised->area() > 1 << 14)
        return 0;
    DepthImage good({16, 16}), out(*promised);
    for (const bool as_key : {false, true}) {
        if (decoder.decode({1, 1, 0, true}, key, good.view()) != Status::ok)
            std::abort();
        (void)decoder.decode({2, as_key ? 2u : 1u, 0, as_key}, input, out.view());
    }
    return 0;
}
