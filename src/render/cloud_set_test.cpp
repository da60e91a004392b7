// SPDX-License-Identifier: Apache-2.0
#include "render/cloud_set.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "render/test_context.h"

namespace theatron::render {
namespace {

using ::testing::HasSubstr;

constexpr CameraId first_camera{0}, second_camera{7};
constexpr std::uint16_t wall_mm = 2000, step_mm = 1200;
constexpr Rgb background{32, 34, 38};

// A wall with a nearer board in front of it, and a hole in the board.
// The hole is too wide to be taken for a gap of the sensor.
bool on_board(int x, int y) {
    return x >= 30 && x < 60 && y >= 20 && y < 50;
}
bool in_hole(int x, int y) {
    return x >= 39 && x < 51 && y >= 29 && y < 41;
}
DepthImage wall_and_board(Size size) {
    DepthImage depth(size);
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x)
            depth.view().row(y)[x] = in_hole(x, y) ? 0 : on_board(x, y) ? step_mm : wall_mm;
    return depth;
}

// Colour that tells its column (red) and row (green); at most 256 a side.
ColorImage position_colors(Size size) {
    ColorImage color(size);
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x)
            color.view().row(y)[x] = {std::uint8_t(x), std::uint8_t(y), 128};
    return color;
}

// Depth and colour camera are one pinhole.
Calibration simple_calibration(Size size = {96, 72}) {
    Calibration calibration;
    calibration.depth = pinhole(size, 60);
    calibration.color = calibration.depth;
    calibration.registered = true;
    calibration.room_from_camera = {Quat{0, 1, 0, 0}, Vec3{0.2, 1.4, 0.3}};
    return calibration;
}

// A colour camera as on real devices: beside the depth camera, turned a little, with
// a distorting lens and more pixels.
Calibration real_calibration() {
    Calibration calibration = simple_calibration();
    calibration.depth.k = {0.2, -0.05, 0.01, 0.1, 0.02, 0};
    calibration.color = pinhole({256, 144}, 80);
    calibration.color.k = {0.12, -0.08, 0.01, 0, 0, 0};
    calibration.color.p1 = 0.001;
    calibration.color.p2 = -0.002;
    calibration.color_from_depth = {rotation_about({1, 0.2, 0}, 0.05), {-0.032, -0.002, 0.004}};
    return calibration;
}

CameraView own_view(const Calibration& calibration) {
    return view_of_camera(calibration.depth, calibration.room_from_camera, calibration.depth.size);
}

class CloudSetTest : public ::testing::TestWithParam<std::string> {
protected:
    void SetUp() override {
        test_context();
        scene = std::make_unique<CloudSet>();
    }
    void TearDown() override {
        scene.reset();
        EXPECT_EQ(test_context().errors(), errors_before) << test_context().first_error();
    }

    // Shows one camera with the step scene and colours that tell positions.
    void show(const Calibration& calibration) {
        scene->set_camera(first_camera, calibration);
        ASSERT_EQ(scene->upload(first_camera, wall_and_board(calibration.depth.size).view(),
                                position_colors(calibration.color.size).view()),
                  Status::ok);
    }
    Picture render(const CameraView& view, Size size = {96, 72}) {
        return scene->render(view, size, GetParam());
    }

    const int errors_before = test_context().errors();
    std::unique_ptr<CloudSet> scene;
};

INSTANTIATE_TEST_SUITE_P(EveryRenderer, CloudSetTest, ::testing::ValuesIn(renderer_names()),
                         [](const auto& test) { return test.param; });

// Pixels at a step or at a hole may belong to either side, and "blend" may close a hole's
// corners.
bool near_an_edge(int x, int y, const std::string& renderer) {
    if (renderer == "blend" && in_hole(x, y))
        return true;
    for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx)
            if (on_board(x + dx, y + dy) != on_board(x, y) ||
                in_hole(x + dx, y + dy) != in_hole(x, y))
                return true;
    return false;
}

TEST_P(CloudSetTest, FromTheCamerasOwnPoseTheDepthIsTheDepthImage) {
    const Calibration calibration = simple_calibration();
    show(calibration);
    const DepthImage expected = wall_and_board(calibration.depth.size);
    const DepthImage drawn = render(own_view(calibration)).depth_mm;
    for (int y = 1; y + 1 < drawn.size.height; ++y)
        for (int x = 1; x + 1 < drawn.size.width; ++x)
            if (!near_an_edge(x, y, GetParam())) {
                ASSERT_NEAR(drawn.view().row(y)[x], expected.view().row(y)[x], 1)
                    << "at " << x << ", " << y;
            }
}

TEST_P(CloudSetTest, FromTheCamerasOwnPoseTheColorIsNotShifted) {
    const Calibration calibration = simple_calibration();
    show(calibration);
    const ColorImage expected = position_colors(calibration.color.size);
    const ColorImage drawn = render(own_view(calibration)).color;
    for (int y = 1; y + 1 < drawn.size.height; ++y)
        for (int x = 1; x + 1 < drawn.size.width; ++x)
            if (!near_an_edge(x, y, GetParam()) && !in_hole(x, y)) {
                const Rgb want = expected.view().row(y)[x], got = drawn.view().row(y)[x];
                ASSERT_NEAR(got.r, want.r, 1) << "at " << x << ", " << y;
                ASSERT_NEAR(got.g, want.g, 1) << "at " << x << ", " << y;
                ASSERT_EQ(got.b, 128);
            }
}

TEST_P(CloudSetTest, LensesAreCorrectedAndTheColorComesFromItsOwnCamera) {
    const Calibration calibration = real_calibration();
    show(calibration);
    CameraModel eye = calibration.depth;  // without its distortion: what the view shows
    eye.k = {};
    const Picture drawn = render(own_view(calibration));
    const DepthImage depth = wall_and_board(calibration.depth.size);
    int compared = 0;
    double sum_x = 0, sum_y = 0;  // a point's place within its pixel evens out, a shift does not
    for (int y = 2; y < 70; ++y)
        for (int x = 2; x < 94; ++x) {
            const double z = drawn.depth_mm.view().row(y)[x] / 1000.0;
            const Vec2 ray = unproject(eye, {double(x), double(y)}).value();
            const Vec3 point{ray.x * z, ray.y * z, z};
            const auto source = project(calibration.depth, point);
            if (!source ||
                near_an_edge(int(std::lround(source->x)), int(std::lround(source->y)), GetParam()))
                continue;
            EXPECT_NEAR(depth.view().row(int(std::lround(source->y)))[std::lround(source->x)],
                        z * 1000, 1);
            const Vec2 expected =
                project(calibration.color, calibration.color_from_depth * point).value();
            if (expected.x < 3 || expected.x > 252 || expected.y < 3 || expected.y > 140)
                continue;
            const Rgb got = drawn.color.view().row(y)[x];
            const double error_x = got.r - expected.x, error_y = got.g - expected.y;
            // One pixel of the depth camera is up to two of the colour camera.
            ASSERT_NEAR(error_x, 0, 2.2) << "at " << x << ", " << y;
            ASSERT_NEAR(error_y, 0, 2.2) << "at " << x << ", " << y;
            sum_x += error_x;
            sum_y += error_y;
            ++compared;
        }
    EXPECT_GT(compared, 4500);
    // Where splats overlap at equal depth the first one, to the upper left, wins.
    EXPECT_NEAR(sum_x / compared, 0, 0.5);
    EXPECT_NEAR(sum_y / compared, 0, 0.5);
}

TEST_P(CloudSetTest, WhatTheColorCameraDoesNotSeeIsNotPaintedWithTheForeground) {
    Calibration calibration = simple_calibration();
    calibration.color = pinhole({384, 288}, 60);
    calibration.color_from_depth.translation = {-0.1, 0, 0};
    constexpr Rgb red{255, 0, 0}, blue{0, 0, 255};
    ColorImage color(calibration.color.size);
    for (int y = 0; y < color.size.height; ++y)
        for (int x = 0; x < color.size.width; ++x) {
            const Vec2 ray = unproject(calibration.color, {double(x), double(y)}).value();
            const Vec3 on_near_plane{ray.x * 1.2 + 0.1, ray.y * 1.2, 1.2};
            const Vec2 pixel = project(calibration.depth, on_near_plane).value();
            const bool board = on_board(int(std::lround(pixel.x)), int(std::lround(pixel.y)));
            color.view().row(y)[x] = board ? red : blue;
        }
    scene->set_camera(first_camera, calibration);
    ASSERT_EQ(scene->upload(first_camera, wall_and_board({96, 72}).view(), color.view()),
              Status::ok);
    const Picture drawn = render(own_view(calibration));
    int wrong = 0;
    for (int y = 2; y < 70; ++y)
        for (int x = 10; x < 94; ++x)
            if (!near_an_edge(x, y, GetParam()) && !in_hole(x, y)) {
                const Rgb got = drawn.color.view().row(y)[x];
                wrong += std::abs(got.r - (on_board(x, y) ? 255 : 0)) > 60;
            }
    // The shadow covers some 240 pixels; its corner may keep a few.
    EXPECT_LE(wrong, 5);
}

int count_drawn(const Picture& picture) {
    return int(std::count_if(picture.depth_mm.pixels.begin(), picture.depth_mm.pixels.end(),
                             [](std::uint16_t mm) { return mm > 0; }));
}

TEST_P(CloudSetTest, WithHalfThePresenceHalfOfItIsSeen) {
    const Calibration calibration = simple_calibration();
    show(calibration);
    const Picture full = render(own_view(calibration));
    scene->set_presence(first_camera, 0.5);
    const Picture half = render(own_view(calibration));
    scene->set_presence(first_camera, 0);
    const Picture none = render(own_view(calibration));
    double blue = 0;  // 128 where all is seen, 38 where the background is
    for (int y = 4; y < 18; ++y)
        for (int x = 4; x < 90; ++x)
            blue += half.color.view().row(y)[x].b / (14.0 * 86);
    EXPECT_NEAR(blue, (128 + 38) / 2.0, 4);
    EXPECT_EQ(count_drawn(none), 0);
    EXPECT_GT(count_drawn(full), 6000);
}

TEST_P(CloudSetTest, OfAPersonOnlyWhatIsNearTheirBodyIsShown) {
    const Calibration calibration = simple_calibration();
    show(calibration);
    CloudCut cut;
    cut.keep = {calibration.room_from_camera * Vec3{0, 0, 1.2}, 0.5};
    scene->set_cut(first_camera, cut);
    const Picture drawn = render(own_view(calibration));
    EXPECT_EQ(drawn.depth_mm.view().row(44)[45], step_mm) << "the board";
    EXPECT_EQ(drawn.depth_mm.view().row(10)[80], 0) << "the wall behind";
}

TEST_P(CloudSetTest, WhatBlocksOnesViewIsNotShownAndFadesAtItsBorder) {
    const Calibration calibration = simple_calibration();
    show(calibration);
    CloudCut cut;
    cut.remove = {calibration.room_from_camera * Vec3{0, 0, 0.5},
                  calibration.room_from_camera * Vec3{0, 0, 1.2}, 0.1};
    cut.border_m = 0.2;
    scene->set_cut(first_camera, cut);
    const Picture drawn = render(own_view(calibration));
    int removed = 0, faded = 0, kept = 0;
    for (int y = 41; y < 48; ++y)
        for (int x = 31; x < 59; ++x) {
            const Vec2 ray = unproject(calibration.depth, {double(x), double(y)}).value();
            const double away = 1.2 * std::hypot(ray.x, ray.y);
            const bool shown = drawn.depth_mm.view().row(y)[x] == step_mm;
            if (away < 0.09)
                removed += shown;
            else if (away > 0.18 && away < 0.22)
                ++(shown ? kept : faded);
        }
    EXPECT_EQ(removed, 0);
    EXPECT_GT(kept, 3);
    EXPECT_GT(faded, 3);
    EXPECT_EQ(drawn.depth_mm.view().row(10)[80], wall_mm);
}

TEST_P(CloudSetTest, HolesStayHoles) {
    const Calibration calibration = simple_calibration();
    show(calibration);
    const Picture drawn = render(own_view(calibration));
    for (int y = 34; y < 36; ++y)
        for (int x = 44; x < 46; ++x) {
            EXPECT_EQ(drawn.depth_mm.view().row(y)[x], 0);
            EXPECT_EQ(drawn.color.view().row(y)[x], background);
        }
}

TEST_P(CloudSetTest, NothingIsDrawnBetweenTheBoardAndTheWall) {
    const Calibration calibration = simple_calibration();
    show(calibration);
    const CameraView side =
        orbited(own_view(calibration),
                point_of_interest(calibration, wall_and_board({96, 72}).view()), 50, 0);
    const Picture drawn = render(side, {192, 144});
    // Each drawn pixel, carried back to the camera, lies on one of the two planes.
    const Pose camera_from_eye = inverse(calibration.room_from_camera) * side.room_from_eye;
    int on_planes = 0, between = 0;
    for (int y = 0; y < 144; ++y)
        for (int x = 0; x < 192; ++x) {
            const double z = drawn.depth_mm.view().row(y)[x] / 1000.0;
            if (z == 0)
                continue;
            const double tx = side.left + (side.right - side.left) * (x + 0.5) / 192;
            const double ty = side.top + (side.bottom - side.top) * (y + 0.5) / 144;
            const double depth = (camera_from_eye * Vec3{tx * z, ty * z, z}).z;
            // A splat faces the viewer, so its rim leaves the plane by its radius.
            const bool on_plane = std::abs(depth - 1.2) < 0.03 || std::abs(depth - 2) < 0.03;
            ++(on_plane ? on_planes : between);
        }
    EXPECT_GT(on_planes, 5000);
    EXPECT_EQ(between, 0);
}

TEST_P(CloudSetTest, ASteepWallHasNoGapsWhenSeenFromTheFront) {
    // The camera looks along the wall at 30 degrees: its points are two pixels apart
    // across the wall when one looks at it straight.
    const Calibration calibration = simple_calibration();
    DepthImage depth(calibration.depth.size);
    for (int y = 0; y < depth.size.height; ++y)
        for (int x = 0; x < depth.size.width; ++x) {
            const Vec2 ray = unproject(calibration.depth, {double(x), double(y)}).value();
            // Through (0, 0, 2), with its normal at 60 degrees to the axis.
            depth.view().row(y)[x] =
                std::uint16_t(std::lround(2000 / (1 + std::tan(1.0472) * ray.x * 0.99)));
        }
    scene->set_camera(first_camera, calibration);
    ASSERT_EQ(scene->upload(first_camera, depth.view(), {}), Status::ok);
    const Vec3 middle = calibration.room_from_camera * Vec3{0, 0, 2};
    const Picture drawn = render(orbited(own_view(calibration), middle, -60, 0), {192, 144});
    for (int y = 52; y < 92; ++y)
        for (int x = 76; x < 116; ++x)
            ASSERT_NEAR(drawn.depth_mm.view().row(y)[x], 2000, 60) << "at " << x << ", " << y;
}

TEST_P(CloudSetTest, FromTheSideACornerIsWhereGeometrySaysItIs) {
    const Calibration calibration = simple_calibration();
    show(calibration);
    const Size size{384, 288};
    const CameraView side = orbited(own_view(calibration), {0.2, 1.4, -1.0}, -25, 15);
    const Picture drawn = render(side, size);
    // The board's upper right corner: leaving it to the right the depth jumps to the wall.
    const Vec2 ray = unproject(calibration.depth, {59, 20}).value();
    const Vec3 corner = calibration.room_from_camera * Vec3{ray.x * 1.2, ray.y * 1.2, 1.2};
    const Vec3 eye = inverse(side.room_from_eye) * corner;
    const double x = (eye.x / eye.z - side.left) / (side.right - side.left) * size.width;
    const double y = (eye.y / eye.z - side.top) / (side.bottom - side.top) * size.height;
    const auto depth_at = [&](double dx, double dy) {
        return int(drawn.depth_mm.view().row(int(y + dy))[int(x + dx)]);
    };
    // One pixel of the camera is about five here.
    EXPECT_NEAR(depth_at(-4, 4), eye.z * 1000, 25);
    EXPECT_GT(std::abs(depth_at(8, 4) - eye.z * 1000), 300);
    EXPECT_GT(std::abs(depth_at(-4, -8) - eye.z * 1000), 300);
}

TEST_P(CloudSetTest, MovingACameraInTheRoomMovesItsPicture) {
    Calibration calibration = simple_calibration();
    show(calibration);
    const CameraView view = own_view(calibration);
    const DepthImage before = render(view).depth_mm;
    calibration.room_from_camera.translation.z -= 0.5;  // away from the viewer
    scene->set_camera(first_camera, calibration);
    const DepthImage after = render(view).depth_mm;
    EXPECT_EQ(before.view().row(36)[36], step_mm);
    EXPECT_EQ(after.view().row(36)[36], step_mm + 500);
    EXPECT_EQ(after.view().row(0)[0], 0) << "the picture became smaller";
}

TEST_P(CloudSetTest, CamerasOfDifferentSizesAreDrawnTogether) {
    const Calibration near = simple_calibration();
    Calibration far = simple_calibration({160, 40});
    far.room_from_camera.translation.x += 40;
    show(near);
    scene->set_camera(second_camera, far);  // moves the first to larger textures
    DepthImage flat(far.depth.size);
    flat.pixels.assign(flat.size.area(), 1500);
    ASSERT_EQ(scene->upload(second_camera, flat.view(), {}), Status::ok);

    EXPECT_EQ(render(own_view(near)).depth_mm.view().row(10)[10], wall_mm);
    const Picture second = render(own_view(far), far.depth.size);
    EXPECT_EQ(second.depth_mm.view().row(20)[80], 1500);
    EXPECT_EQ(second.color.view().row(20)[80], (Rgb{102, 102, 102})) << "grey without colour";

    scene->remove_camera(first_camera);
    EXPECT_EQ(render(own_view(near)).depth_mm.view().row(10)[10], 0);
    EXPECT_EQ(render(own_view(far), far.depth.size).depth_mm.view().row(20)[80], 1500);
}

TEST_P(CloudSetTest, ACameraWithoutColorShowsItsShape) {
    Calibration calibration = simple_calibration();
    calibration.color = {};
    scene->set_camera(first_camera, calibration);
    DepthImage depth(calibration.depth.size);
    for (int y = 0; y < depth.size.height; ++y)
        for (int x = 0; x < depth.size.width; ++x)
            depth.view().row(y)[x] = std::uint16_t(x < 48 ? 1500 : 1500 + 18 * (x - 48));
    ASSERT_EQ(scene->upload(first_camera, depth.view(), {}), Status::ok);
    const Picture picture = render(own_view(calibration));
    const Rgb facing = picture.color.view().row(36)[20],
              turned_away = picture.color.view().row(36)[70];
    EXPECT_NEAR(facing.r, 168, 8);
    EXPECT_LT(turned_away.r, 130);
    EXPECT_TRUE(facing.r == facing.g && facing.g == facing.b);
}

TEST_P(CloudSetTest, WhatHasItsColorWinsOverWhatHasNone) {
    const Calibration calibration = simple_calibration();
    show(calibration);
    scene->set_camera(second_camera, calibration);
    DepthImage nearer = wall_and_board(calibration.depth.size);
    for (std::uint16_t& mm : nearer.pixels)
        mm = std::uint16_t(mm > 0 ? mm - 5 : 0);
    ASSERT_EQ(scene->upload(second_camera, nearer.view(), {}), Status::ok);
    EXPECT_NEAR(render(own_view(calibration)).color.view().row(40)[75].r, 75, 1);
}

TEST_P(CloudSetTest, DepthUnitsAreThoseOfTheCalibration) {
    Calibration calibration = simple_calibration();
    calibration.depth_unit_mm = 0.25;
    show(calibration);
    EXPECT_EQ(render(own_view(calibration)).depth_mm.view().row(10)[10], wall_mm / 4);
}

// An odd size: the last column and row have no partner.
TEST_P(CloudSetTest, WithFewerPointsEverythingStaysInItsPlace) {
    Calibration calibration = real_calibration();
    calibration.depth.size = {95, 71};
    show(calibration);
    const CameraView view = own_view(calibration);
    const Picture all = render(view);
    scene->set_depth_step(2);
    EXPECT_EQ(count_drawn(render(view)), 0);
    show(calibration);
    const Picture fewer = render(view);
    int same = 0, seen = 0, differ = 0;
    for (int y = 2; y < 69; ++y)
        for (int x = 2; x < 93; ++x) {
            const int want = all.depth_mm.view().row(y)[x];
            const int got = fewer.depth_mm.view().row(y)[x];
            seen += want > 0;
            if (want == 0 || std::abs(got - want) > 5)
                continue;
            ++same;
            // Colours tell places in the colour picture.
            const Rgb a = all.color.view().row(y)[x], b = fewer.color.view().row(y)[x];
            differ += std::abs(a.r - b.r) > 4 || std::abs(a.g - b.g) > 4;
        }
    EXPECT_GT(same, 0.85 * seen);
    EXPECT_LT(differ, 0.05 * same);
    EXPECT_NE(fewer.depth_mm.pixels, all.depth_mm.pixels);

    scene->set_depth_step(1);
    show(calibration);
    EXPECT_EQ(render(view).depth_mm.pixels, all.depth_mm.pixels);
}

TEST_P(CloudSetTest, WithFewerPointsPresenceAndCutsStay) {
    const Calibration calibration = simple_calibration();
    show(calibration);
    CloudCut board_only;
    board_only.keep = {calibration.room_from_camera * Vec3{0, 0, 1.2}, 0.5};
    scene->set_cut(first_camera, board_only);
    scene->set_depth_step(2);
    show(calibration);
    const auto farthest = [&] {
        const auto picture = render(own_view(calibration)).depth_mm;
        return *std::max_element(picture.pixels.begin(), picture.pixels.end());
    };
    EXPECT_NEAR(farthest(), step_mm, 50);
    scene->set_presence(first_camera, 0);
    scene->set_depth_step(3);
    show(calibration);
    EXPECT_EQ(farthest(), 0);
}

TEST(CloudSet, RefusesImagesOfAnotherSizeThanCalibrated) {
    test_context();
    CloudSet scene;
    const DepthImage depth({64, 48});
    EXPECT_EQ(scene.upload(first_camera, depth.view(), {}), Status::size_mismatch);
    scene.set_camera(first_camera, simple_calibration());
    EXPECT_EQ(scene.upload(first_camera, depth.view(), {}), Status::size_mismatch);
}

TEST(CloudSet, AnUnknownRendererIsAnsweredWithTheChoices) {
    try {
        check_renderer_name("raytrace");
        FAIL() << "accepted";
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), HasSubstr("\"raytrace\""));
        for (const std::string& name : renderer_names())
            EXPECT_THAT(error.what(), HasSubstr(name));
    }
}

TEST(CloudSet, AnEmptySceneIsItsBackground) {
    test_context();
    CloudSet scene;
    const Picture picture = scene.render({}, {4, 4}, "mesh");
    EXPECT_EQ(picture.depth_mm.pixels, std::vector<std::uint16_t>(16, 0));
    EXPECT_EQ(picture.color.pixels.front(), picture.color.pixels.back());
}

}  // namespace
}  // namespace theatron::render
