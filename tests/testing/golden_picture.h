// SPDX-License-Identifier: Apache-2.0
// Drawn pictures compared with those in tests/golden that were looked at. To accept a wanted change
// run the test with THEATRON_WRITE_GOLDEN=1 and look at the new pictures before keeping them.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <string>

#include "image/image.h"

namespace theatron::testing {

inline std::string golden_header(Size size) {
    return "P6\n" + std::to_string(size.width) + " " + std::to_string(size.height) + "\n255\n";
}

inline void write_golden(const std::string& file, const ColorImage& image) {
    std::ofstream out(file, std::ios::binary);
    out << golden_header(image.size);
    out.write(reinterpret_cast<const char*>(image.pixels.data()),
              std::streamsize(image.pixels.size() * sizeof(Rgb)));
    ASSERT_TRUE(out.flush()) << file;
}

// Returns what write_golden() wrote; an empty image if there is none of this size.
inline ColorImage read_golden(const std::string& file, Size size) {
    std::ifstream in(file, std::ios::binary);
    const std::string bytes((std::istreambuf_iterator<char>(in)), {});
    const std::string header = golden_header(size);
    ColorImage image(size);
    if (bytes.size() != header.size() + image.pixels.size() * sizeof(Rgb) ||
        bytes.compare(0, header.size(), header) != 0)
        return {};
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        const auto at = [&](std::size_t c) {
            return std::uint8_t(bytes[header.size() + 3 * i + c]);
        };
        image.pixels[i] = {at(0), at(1), at(2)};
    }
    return image;
}

// Drivers round differently, which shows where two surfaces are equally near and at outlines. A
// wrong place, size or colour changes far more.
inline void expect_golden(const ColorImage& drawn, const std::string& file,
                          double most_difference = 2.5, double most_other_pixels = 0.04) {
    if (std::getenv("THEATRON_WRITE_GOLDEN"))
        write_golden(file, drawn);
    const ColorImage golden = read_golden(file, drawn.size);
    ASSERT_EQ(golden.size, drawn.size) << "cannot read " << file;
    double sum = 0;
    int different = 0;
    for (std::size_t i = 0; i < golden.pixels.size(); ++i) {
        const Rgb a = drawn.pixels[i], b = golden.pixels[i];
        const int difference = std::abs(a.r - b.r) + std::abs(a.g - b.g) + std::abs(a.b - b.b);
        sum += difference / 3.0;
        different += difference > 60;
    }
    EXPECT_LT(sum / double(golden.pixels.size()), most_difference);
    EXPECT_LT(different, most_other_pixels * double(golden.pixels.size()));
}

}  // namespace theatron::testing
