// SPDX-License-Identifier: Apache-2.0
// Depth images for tests and fuzz targets of the codecs.
#pragma once

#include <initializer_list>
#include <random>

#include "base/bytes.h"
#include "image/image.h"

namespace theatron::codec {

inline Bytes bytes(std::initializer_list<int> values) {
    Bytes result;
    for (const int value : values)
        result.push_back(std::byte(value));
    return result;
}

// Random values everywhere.
inline DepthImage noise(Size size, unsigned seed) {
    DepthImage image(size);
    std::mt19937 random(seed);
    for (auto& pixel : image.pixels)
        pixel = std::uint16_t(random());
    return image;
}

// A sloping wall with sensor noise, a depth edge, holes, and a few pixels at the ends
// of the range. `frame` seeds the noise and moves the edge.
inline DepthImage scene(Size size, unsigned frame) {
    DepthImage image(size);
    std::mt19937 random(frame + 1);
    for (int y = 0; y < size.height; ++y) {
        for (int x = 0; x < size.width; ++x) {
            const int step = x > size.width / 2 + int(frame % 8) ? 700 : 0;
            const int depth = 900 + 2 * y + x + step + int(random() % 5);
            const bool hole = (x / 8 + y / 8) % 5 == 0 || random() % 64 == 0;
            const bool extreme = random() % 512 == 0;
            image.view().row(y)[x] = std::uint16_t(hole ? 0 : extreme ? 0xffff : depth);
        }
    }
    return image;
}

}  // namespace theatron::codec
