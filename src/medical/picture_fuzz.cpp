// SPDX-License-Identifier: Apache-2.0
// Any bytes: decoding stays inside them. A picture that was decoded is the same after it was
// written and read again.
#include <cstdlib>

#include "medical/picture.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace theatron;
    const auto picture = medical::decode_picture(std::as_bytes(std::span(data, size)));
    if (!picture)
        return 0;
    const auto again = medical::decode_picture(medical::encode_picture(picture->view()));
    if (!again || !(*again == *picture))
        std::abort();
    const ColorImage small = medical::reduced(*picture, 3);
    if (!medical::is_picture_size(small.size) || small.pixels.size() != small.size.area())
        std::abort();
    return 0;
}
