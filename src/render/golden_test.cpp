// SPDX-License-Identifier: Apache-2.0
// Small pictures of every renderer, compared with those in tests/golden. To
// accept a wanted change run this test with THEATRON_WRITE_GOLDEN=1 and look at
// the new pictures before keeping them.
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <iterator>

#include "render/ball_scene.h"
#include "render/cloud_set.h"
#include "render/test_context.h"

namespace theatron::render {
namespace {

constexpr Size picture_size = golden_picture_size;

std::string header(Size size) {
    return "P6\n" + std::to_string(size.width) + " " + std::to_string(size.height) + "\n255\n";
}

void write_ppm(const std::string& file, const ColorImage& image) {
    std::ofstream out(file, std::ios::binary);
    out << header(image.size);
    out.write(reinterpret_cast<const char*>(image.pixels.data()),
              std::streamsize(image.pixels.size() * sizeof(Rgb)));
    ASSERT_TRUE(out.flush()) << file;
}

// Reads what write_ppm wrote; an empty image if that is not there.
ColorImage read_ppm(const std::string& file) {
    std::ifstream in(file, std::ios::binary);
    const std::string bytes((std::istreambuf_iterator<char>(in)), {});
    const std::string expected = header(picture_size);
    ColorImage image(picture_size);
    if (bytes.size() != expected.size() + image.pixels.size() * sizeof(Rgb) ||
        bytes.compare(0, expected.size(), expected) != 0)
        return {};
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        const auto at = [&](std::size_t c) {
            return std::uint8_t(bytes[expected.size() + 3 * i + c]);
        };
        image.pixels[i] = {at(0), at(1), at(2)};
    }
    return image;
}

class GoldenTest : public ::testing::TestWithParam<std::string> {};

INSTANTIATE_TEST_SUITE_P(EveryRenderer, GoldenTest, ::testing::ValuesIn(renderer_names()),
                         [](const auto& test) { return test.param; });

// Drivers round differently, which shows where two surfaces are equally near and at
// outlines. A wrong place, size or colour changes far more.
void expect_golden(const ColorImage& drawn, const std::string& file) {
    if (std::getenv("THEATRON_WRITE_GOLDEN"))
        write_ppm(file, drawn);
    const ColorImage golden = read_ppm(file);
    ASSERT_EQ(golden.size, picture_size) << "cannot read " << file;
    double sum = 0;
    int different = 0;
    for (std::size_t i = 0; i < golden.pixels.size(); ++i) {
        const Rgb a = drawn.pixels[i], b = golden.pixels[i];
        const int difference = std::abs(a.r - b.r) + std::abs(a.g - b.g) + std::abs(a.b - b.b);
        sum += difference / 3.0;
        different += difference > 60;
    }
    EXPECT_LT(sum / double(golden.pixels.size()), 2.5);
    EXPECT_LT(different, int(golden.pixels.size()) / 25);
}

TEST_P(GoldenTest, DrawsThePictureThatWasLookedAt) {
    test_context();
    CloudSet scene;
    show_golden_scene(scene);
    expect_golden(scene.render(golden_view(), picture_size, GetParam()).color,
                  "tests/golden/render_" + GetParam() + ".ppm");
}

TEST_P(GoldenTest, DrawsSensorsOfDifferentKindsTogether) {
    test_context();
    CloudSet scene;
    show_mixed_golden_scene(scene);
    expect_golden(scene.render(golden_view(), picture_size, GetParam()).color,
                  "tests/golden/render_mixed_" + GetParam() + ".ppm");
}

}  // namespace
}  // namespace theatron::render
