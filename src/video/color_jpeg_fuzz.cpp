// SPDX-License-Identifier: Apache-2.0
// Any bytes end in a status or in an image of the size in their header, and the
// fast decoder agrees with its reference about status and every pixel.
#include <cstdlib>

#include "video/color_codec.h"
#include "video/jpeg_decoder.h"
#include "video/jpeg_header.h"
#include "video/jpeg_reference_native.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace theatron;
    static const auto decoder = video::make_color_decoder(video::ColorCodecId::jpeg);
    const auto input = std::as_bytes(std::span(data, size));
    const Result<Size> promised = video::read_jpeg_size(input);
    // Larger pictures only make the search slow.
    if (promised && promised->area() > 1 << 16)
        return 0;
    const Status status = decoder->submit(input, 7);
    auto decoded = decoder->poll();
    if (decoded.has_value() != (status == Status::ok) || (decoded && !promised))
        std::abort();
    if (decoded) {
        if (decoded->frame != 7 || decoded->image.size != *promised)
            std::abort();
        decoder->recycle(std::move(decoded->image));
    }

    static video::BaselineJpegDecoder fast;
    static ColorImage image, expected;
    const Status fast_status = fast.decode(input, image);
    if (fast_status != video::decode_jpeg_reference(input, expected) ||
        (fast_status == Status::ok && image != expected))
        std::abort();
    return 0;
}
