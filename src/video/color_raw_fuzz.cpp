// SPDX-License-Identifier: Apache-2.0
// Any bytes: decoding stays inside its buffers. Bytes that are accepted:
// encoding the image gives the same bytes again.
#include <cstdlib>
#include <vector>

#include "image/image.h"
#include "video/color_raw.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace theatron;
    const auto input = std::as_bytes(std::span(data, size));
    const Result<Size> found = video::color_raw::read_size(input);
    if (!found)
        return 0;
    ColorImage image(*found);
    if (video::color_raw::decode(input, image.view()) != Status::ok)
        std::abort();
    Bytes again(video::color_raw::encoded_size(*found));
    video::color_raw::encode(image.view(), again);
    if (again.size() != size || std::memcmp(again.data(), data, size) != 0)
        std::abort();
    return 0;
}
