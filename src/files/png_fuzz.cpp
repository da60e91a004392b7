// SPDX-License-Identifier: Apache-2.0
// Any bytes give a sentence or an image; re-encoding and decoding an image preserves it.
#include <cstdlib>

#include "files/png_file.h"

namespace {

template <class Image>
void check(theatron::ByteView input) {
    using namespace theatron;
    Image image, again;
    if (!files::decode_png(input, image).empty())
        return;
    if (!files::decode_png(files::encode_png(image.view()), again).empty() || again != image)
        std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace theatron;
    const auto input = std::as_bytes(std::span(data, size));
    // Limits width and height, at fixed offsets, to 255: large pictures slow the search.
    if (size >= 24 && (data[16] | data[17] | data[18] | data[20] | data[21] | data[22]) != 0)
        return 0;
    check<DepthImage>(input);
    check<ColorImage>(input);
    return 0;
}
