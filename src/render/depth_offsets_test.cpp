// SPDX-License-Identifier: Apache-2.0
#include "render/depth_offsets.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "render/camera_view.h"

namespace theatron::render {
namespace {

// Cameras around a printed table, each with its own constant error of depth.
class DepthOffsetsTest : public ::testing::Test {
protected:
    struct Images {
        Calibration calibration;
        DepthImage depth;
        ColorImage color;
    };

    // Looks at the origin from this side, 40 degrees downwards.
    static Calibration camera(double degrees) {
        const double a = degrees * std::numbers::pi / 180;
        Calibration c;
        c.depth = pinhole({320, 240}, 70);
        c.color = pinhole({640, 360}, 80);
        c.color_from_depth.translation = {-0.032, 0, 0};
        c.depth_unit_mm = 0.25;
        c.room_from_camera =
            view_towards({1.2 * std::cos(a), 1, 1.2 * std::sin(a)}, {0, 0, 0}, 60, {64, 64})
                .room_from_eye;
        return c;
    }

    // Where the ray meets the table at height 0, as a share of the ray.
    static double to_table(const Pose& room_from_camera, Vec3 ray) {
        return -room_from_camera.translation.y / rotate(room_from_camera.rotation, ray).y;
    }

    Images images(double degrees, double offset_m, double contrast) {
        Images result{camera(degrees), DepthImage(Size{320, 240}), ColorImage(Size{640, 360})};
        const Calibration& c = result.calibration;
        std::normal_distribution<double> noise(0, 0.001);
        for (int y = 0; y < 240; ++y)
            for (int x = 0; x < 320; ++x) {
                const auto ray = unproject(c.depth, {double(x), double(y)});
                const double z = to_table(c.room_from_camera, {ray->x, ray->y, 1});
                if (z > 0 && z < 4)
                    result.depth.view().row(y)[x] = std::uint16_t(
                        std::lround((z + offset_m + noise(random)) * 1000 / c.depth_unit_mm));
            }
        const Pose room_from_color = c.room_from_camera * inverse(c.color_from_depth);
        for (int y = 0; y < 360; ++y)
            for (int x = 0; x < 640; ++x) {
                const auto ray = unproject(c.color, {double(x), double(y)});
                const Vec3 direction{ray->x, ray->y, 1};
                const double z = to_table(room_from_color, direction);
                const Vec3 p = room_from_color * (direction * z);
                const double print =
                    std::sin(130 * p.x + 40 * p.z) + std::sin(150 * p.z - 30 * p.x);
                const auto v = std::uint8_t(std::lround(120 + contrast * print));
                result.color.view().row(y)[x] = {v, v, v};
            }
        return result;
    }

    void show(int camera, double offset_m, double contrast = 30) {
        const Images i = images(100 * camera, offset_m, contrast);
        offsets.add(CameraId(camera), i.calibration, i.depth.view(), i.color.view());
    }

    // Updates until no camera is waiting.
    bool update_all() {
        bool any = false;
        while (offsets.update())
            any = true;
        return any;
    }

    std::mt19937 random{7};
    DepthOffsets offsets;
};

TEST_F(DepthOffsetsTest, FindsWhatEachCameraMeasuresTooMuch) {
    const double exact[] = {0.004, -0.003, 0.0};
    for (int i = 0; i < 3; ++i)
        show(i, exact[i]);
    ASSERT_TRUE(update_all());
    for (int i = 0; i < 3; ++i)
        EXPECT_NEAR(offsets.offset_m(CameraId(i)), exact[i], 0.0007) << "camera " << i;
}

TEST_F(DepthOffsetsTest, ACameraWithAMeasuredOffsetKeepsItAndTheOthersFollow) {
    const auto show_measured = [&](int camera, double offset_m) {
        Images i = images(100 * camera, offset_m, 30);
        i.calibration.depth_offset_mm = offset_m * 1000;
        offsets.add(CameraId(camera), i.calibration, i.depth.view(), i.color.view());
    };
    show(0, -0.003);
    show_measured(1, 0.008);
    show(2, 0.002);
    ASSERT_TRUE(update_all());
    EXPECT_EQ(offsets.offset_m(CameraId(1)), 0);
    EXPECT_NEAR(offsets.offset_m(CameraId(0)), -0.003, 0.001);
    EXPECT_NEAR(offsets.offset_m(CameraId(2)), 0.002, 0.001);

    offsets = {};
    for (int i = 0; i < 3; ++i)
        show_measured(i, 0.002);
    EXPECT_FALSE(update_all()) << "nothing is unknown";
}

TEST_F(DepthOffsetsTest, FindsMuchAsWell) {
    const double exact[] = {0.011, -0.009, 0.007};
    for (int i = 0; i < 3; ++i)
        show(i, exact[i]);
    ASSERT_TRUE(update_all());
    for (int i = 0; i < 3; ++i)
        EXPECT_NEAR(offsets.offset_m(CameraId(i)), exact[i], 0.0015) << "camera " << i;
}

TEST_F(DepthOffsetsTest, WithoutTextureNothingIsChanged) {
    for (int i = 0; i < 3; ++i)
        show(i, 0.004, 0);
    update_all();
    for (int i = 0; i < 3; ++i)
        EXPECT_EQ(offsets.offset_m(CameraId(i)), 0);
}

TEST_F(DepthOffsetsTest, ACameraAloneHasNone) {
    show(0, 0.004);
    EXPECT_FALSE(offsets.update());
    EXPECT_EQ(offsets.offset_m(CameraId(0)), 0);
}

TEST_F(DepthOffsetsTest, ColorThatIsRegisteredToDepthTellsNothing) {
    for (int i = 0; i < 3; ++i) {
        Images here = images(100 * i, 0.004, 30);
        here.calibration.color_from_depth = {};
        offsets.add(CameraId(i), here.calibration, here.depth.view(), here.color.view());
    }
    EXPECT_FALSE(offsets.update());
}

TEST_F(DepthOffsetsTest, FollowsSlowly) {
    Images still[3];
    for (int i = 0; i < 3; ++i)
        still[i] = images(100 * i, 0, 30);
    const Images moved = images(0, 0.003, 30);
    const auto show_all = [&](const Images& first) {
        for (int i = 0; i < 3; ++i) {
            const Images& image = i == 0 ? first : still[i];
            offsets.add(CameraId(i), image.calibration, image.depth.view(), image.color.view());
        }
        return update_all();
    };
    int updates = 0;
    for (int frame = 0; frame < 500; ++frame)
        updates += show_all(still[0]);
    EXPECT_GT(updates, 10);
    EXPECT_LT(updates, 20) << "images are compared now and then";
    const double before = offsets.offset_m(CameraId(0));
    EXPECT_NEAR(before, 0, 0.0007);
    updates = 0;
    while (updates < 2)
        updates += show_all(moved);
    const double change = offsets.offset_m(CameraId(0)) - before;
    EXPECT_GT(change, 2 * 0.0002) << "of each update";
    EXPECT_LT(change, 0.001);
}

}  // namespace
}  // namespace theatron::render
