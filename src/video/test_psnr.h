// SPDX-License-Identifier: Apache-2.0
// For tests: how close a lossy picture is to its original.
#pragma once

#include <cmath>

#include "image/image.h"

namespace theatron::video {

// In dB, over all channels. Both pictures have the same size.
inline double psnr(const ColorImage& a, const ColorImage& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i)
        for (const int d : {a.pixels[i].r - b.pixels[i].r, a.pixels[i].g - b.pixels[i].g,
                            a.pixels[i].b - b.pixels[i].b})
            sum += d * d;
    return 10 * std::log10(255.0 * 255 * 3 * double(a.pixels.size()) / sum);
}

}  // namespace theatron::video
