// SPDX-License-Identifier: Apache-2.0
// Depth images like those of a sensor, for tests.
#pragma once

#include <gtest/gtest.h>

#include <random>

#include "filter/depth_plane.h"
#include "image/image.h"
#include "testing/every_target.h"

namespace theatron {

// Prints a few numbers instead of all pixels when images differ.
inline void PrintTo(const Image<std::uint16_t>& image, std::ostream* out) {
    *out << image.size.width << "x" << image.size.height << ":";
    for (std::size_t i = 0; i < std::min<std::size_t>(image.pixels.size(), 40); ++i)
        *out << ' ' << image.pixels[i];
}

namespace filter {

using testing::on_every_target;

inline DepthPlane plane_of(const DepthImage& image) {
    DepthPlane plane(image.size);
    copy_pixels(image.view(), plane.view());
    return plane;
}

inline DepthImage image_of(const DepthPlane& plane) {
    return copy_of(plane.view());
}

// Two walls with a depth edge between them, noise, and clusters of holes.
inline DepthImage two_walls(Size size, unsigned seed, int noise = 3, int holes_percent = 10) {
    std::mt19937 random(seed);
    const auto below = [&](int n) { return n > 0 ? int(random() % unsigned(n)) : 0; };
    DepthImage image(size);
    const int step_at = 1 + below(size.width);
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x)
            image.view().row(y)[x] =
                std::uint16_t((x < step_at ? 1500 : 2600) + 2 * y + below(2 * noise + 1) - noise);
    const int clumps = int(size.area()) * holes_percent / 1000 + 1;
    for (int i = 0; holes_percent > 0 && i < clumps; ++i) {
        const int left = below(size.width), top = below(size.height);
        const int width = 1 + below(6), height = 1 + below(5);
        for (int y = top; y < std::min(top + height, size.height); ++y)
            for (int x = left; x < std::min(left + width, size.width); ++x)
                image.view().row(y)[x] = 0;
    }
    return image;
}

// Arbitrary values, many of them at the ends of the range and next to each other.
inline DepthImage extremes(Size size, unsigned seed) {
    std::mt19937 random(seed);
    constexpr std::uint16_t values[] = {0,   0,   1,      2,      3,      500,
                                        511, 512, 0x7ffe, 0x8000, 0xfffe, 0xffff};
    DepthImage image(size);
    for (auto& pixel : image.pixels)
        pixel = values[random() % std::size(values)];
    return image;
}

// Sizes that break vector loops: every remainder, and more than one vector.
inline std::vector<Size> awkward_sizes() {
    std::vector<Size> sizes = {{1, 1}, {1, 9}, {640, 3}, {129, 70}};
    for (int width = 2; width <= 70; width += 3)
        sizes.push_back({width, 7});
    return sizes;
}

}  // namespace filter
}  // namespace theatron
