// SPDX-License-Identifier: Apache-2.0
// Any bytes: a picture of a size that a case may have, or a reason. Runs in a sandbox otherwise.
#include <cstdlib>

#include "cases/picture_reader.h"
#include "files/photo_orientation.h"
#include "medical/picture.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace theatron;
    const ByteView file = std::as_bytes(std::span(data, size));
    const int orientation = files::exif_orientation(file);
    if (orientation < 1 || orientation > 8)
        std::abort();
    // Sizes that the reader takes and that only cost time are left out. Larger ones must be refused
    // before memory is taken.
    const auto costs_time = [](std::size_t width, std::size_t height) {
        return width <= 65'535 && height <= 65'535 && width * height > 1 << 18 &&
               width * height <= cases::max_picture_pixels;
    };
    const auto side = [&](std::size_t at) {
        return size > at + 1 ? std::size_t(data[at]) << 8 | data[at + 1] : 0;
    };
    if (size > 0 && data[0] == 0x89 &&
        costs_time(side(16) << 16 | side(18), side(20) << 16 | side(22)))
        return 0;
    for (std::size_t at = 0; at + 9 < size; ++at)
        if (data[at] == 0xff && data[at + 1] >= 0xc0 && data[at + 1] <= 0xc2 &&
            costs_time(side(at + 7), side(at + 5)))
            return 0;
    ColorImage picture;
    if (cases::read_picture(file, picture) == cases::Answer::content &&
        (!medical::is_picture_size(picture.size) || picture.pixels.size() != picture.size.area()))
        std::abort();
    return 0;
}
