// SPDX-License-Identifier: Apache-2.0
// Any bytes give a sentence or an image within the limits of sizes; re-encoding and decoding an
// image preserves it.
#include <cstdlib>

#include "files/png_file.h"

namespace {

template <class Image>
void check(theatron::ByteView input) {
    using namespace theatron;
    Image image, again;
    if (!files::decode_png(input, image).empty())
        return;
    if (!is_valid(image.size) ||
        !files::decode_png(files::encode_png(image.view()), again).empty() || again != image)
        std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace theatron;
    const auto input = std::as_bytes(std::span(data, size));
    // Width and height, at fixed offsets, beyond 255 slow the search and are left out, unless they
    // are so large that they must be refused.
    const auto side = [&](std::size_t at) {
        return std::size_t(data[at]) << 24 | std::size_t(data[at + 1]) << 16 |
               std::size_t(data[at + 2]) << 8 | data[at + 3];
    };
    const auto is_taken = [](std::size_t length) { return length <= std::size_t(max_side); };
    if (size >= 24 && (side(16) > 255 || side(20) > 255) && is_taken(side(16)) &&
        is_taken(side(20)))
        return 0;
    check<DepthImage>(input);
    check<ColorImage>(input);
    return 0;
}
