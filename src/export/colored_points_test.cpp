// SPDX-License-Identifier: Apache-2.0
#include "export/colored_points.h"

#include <gtest/gtest.h>

namespace theatron::exporting {
namespace {

constexpr Size size{12, 2};

Calibration calibration() {
    Calibration c;
    c.depth = c.color = pinhole(size, 60);
    return c;
}

// Every column of the picture has a colour of its own.
Frame frame(std::initializer_list<std::uint16_t> depth) {
    Frame f;
    f.depth = DepthImage(size);
    std::copy(depth.begin(), depth.end(), f.depth.pixels.begin());
    f.color.size = size;
    f.color.pixels = ColorImage(size);
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x)
            f.color.pixels.view().row(y)[x] = {std::uint8_t(10 * x), 0, 200};
    return f;
}

TEST(ColoredPoints, EveryMeasuredPixelIsAPointOfItsColor) {
    std::uint64_t undecoded = 0;
    PointMaker maker(calibration(), undecoded);
    std::vector<ColoredPoint> points;
    maker.append(frame({1000, 0, 1000, 1000, 0, 0, 0, 0, 0, 0, 2000}), points);
    ASSERT_EQ(points.size(), 4u);
    EXPECT_EQ(points[1].color, (Rgb{20, 0, 200}));
    EXPECT_FLOAT_EQ(points[3].z, 2);
    EXPECT_EQ(undecoded, 0u);
}

// A depth below the camera's offset is no measurement, so its pixel makes no point. Here it lies
// too far away to hide others from the colour camera.
TEST(ColoredPoints, PixelsBelowTheDepthOffsetMoveNoColor) {
    Calibration c = calibration();
    c.depth_offset_mm = 50;
    std::uint64_t undecoded = 0;
    PointMaker maker(c, undecoded);
    std::vector<ColoredPoint> points;
    maker.append(frame({20, 20, 0, 0, 0, 0, 0, 0, 0, 0, 1050, 1050}), points);
    ASSERT_EQ(points.size(), 2u);
    EXPECT_EQ(points[0].color, (Rgb{100, 0, 200}));
    EXPECT_EQ(points[1].color, (Rgb{110, 0, 200}));
}

}  // namespace
}  // namespace theatron::exporting
