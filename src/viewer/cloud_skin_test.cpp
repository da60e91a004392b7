// SPDX-License-Identifier: Apache-2.0
#include "viewer/cloud_skin.h"

#include <gtest/gtest.h>

#include "image/image.h"
#include "image/srgb.h"

namespace theatron::viewer {
namespace {

// A camera 0.6 m before the eyes that looks at them: the person's neck is below its middle.
Calibration camera() {
    Calibration calibration;
    calibration.depth.size = calibration.color.size = {160, 120};
    calibration.depth.fx = calibration.depth.fy = calibration.color.fx = calibration.color.fy = 120;
    calibration.depth.cx = calibration.color.cx = 80;
    calibration.depth.cy = calibration.color.cy = 60;
    // x to the person's left, y down, z to the person, who looks along -z.
    calibration.room_from_camera = look_at({0, 0, -0.6}, {0, 0, 0}, {0, 1, 0});
    return calibration;
}

struct Seen {
    DepthImage depth{Size{160, 120}};
    ColorImage color{Size{160, 120}};
    explicit Seen(Rgb skin) {
        std::fill(depth.pixels.begin(), depth.pixels.end(), std::uint16_t(620));
        std::fill(color.pixels.begin(), color.pixels.end(), skin);
    }
};

TEST(CloudSkin, IsTheColourOfTheNeck) {
    const Calibration calibration = camera();
    const auto rays = make_ray_table(calibration.depth);
    Seen seen({200, 150, 120});
    // Above the neck all is blue.
    for (std::size_t i = 0; i < seen.color.pixels.size() / 2; ++i)
        seen.color.pixels[i] = {0, 0, 255};
    const auto skin = cloud_skin(seen.depth.view(), seen.color.view(), calibration, rays);
    ASSERT_TRUE(skin);
    EXPECT_NEAR(skin->x, srgb_to_linear(200 / 255.0), 0.01);
    EXPECT_NEAR(skin->z, srgb_to_linear(120 / 255.0), 0.01);
}

TEST(CloudSkin, AGownOrNoPictureIsNone) {
    const Calibration calibration = camera();
    const auto rays = make_ray_table(calibration.depth);
    Seen green({40, 160, 120});
    EXPECT_FALSE(cloud_skin(green.depth.view(), green.color.view(), calibration, rays));
    Seen far({200, 150, 120});
    std::fill(far.depth.pixels.begin(), far.depth.pixels.end(), std::uint16_t(2000));
    EXPECT_FALSE(cloud_skin(far.depth.view(), far.color.view(), calibration, rays));
    EXPECT_FALSE(cloud_skin(far.depth.view(), {}, calibration, rays));
}

TEST(CloudSkin, TheGainIsLimited) {
    const Vec3 gain = skin_gain({0.4, 0.2, 0}, {0.2, 10, 0.5});
    EXPECT_EQ(gain, (Vec3{0.5, 2, 1}));
}

}  // namespace
}  // namespace theatron::viewer
