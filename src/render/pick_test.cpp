// SPDX-License-Identifier: Apache-2.0
#include "render/pick.h"

#include <gtest/gtest.h>

#include "render/test_context.h"

namespace theatron::render {
namespace {

constexpr PickId liver{7}, panel_id{9};

class PickTest : public ::testing::Test {
protected:
    PickTest() {
        test_context();
        ball.emplace(make_sphere_mesh(0.5, 32));
        panel.emplace(make_panel_mesh(2, 1));
    }
    std::optional<SceneMesh> ball, panel;
    SceneFrame frame;
};

TEST_F(PickTest, TheNearestObjectIsFoundWhereItIs) {
    const Pose turned{rotation_about({0, 1, 0}, 0.7), {0, 1, -3}};
    frame.objects.push_back({&*panel, {Quat{}, {0, 1, -5}}, {}, false, panel_id});
    frame.objects.push_back({&*ball, turned, {}, false, liver});
    const auto picked = pick(frame, {{0, 1, 0}, {0, 0, -2}});
    ASSERT_TRUE(picked);
    EXPECT_EQ(picked->id, liver);
    EXPECT_NEAR(picked->distance_m, 2.5, 0.01);
    EXPECT_NEAR(length(picked->place - Vec3{0, 1, -2.5}), 0, 0.01);
    EXPECT_GT(picked->normal.z, 0.99) << "towards the pointer";
    const auto beside = pick(frame, {{0.8, 1, 0}, {0, 0, -1}});
    ASSERT_TRUE(beside);
    EXPECT_EQ(beside->id, panel_id);
    EXPECT_FALSE(pick(frame, {{1.2, 1, 0}, {0, 0, -1}})) << "beside both";
    EXPECT_FALSE(pick(frame, {{0, 1, 0}, {0, 0, 1}})) << "behind the pointer";
}

TEST_F(PickTest, WhatHasNoIdIsTransparentForRays) {
    frame.objects.push_back({&*ball, {Quat{}, {0, 1, -3}}, {}});
    EXPECT_FALSE(pick(frame, {{0, 1, 0}, {0, 0, -1}}));
    frame.objects.push_back({&*panel, {Quat{}, {0, 1, -5}}, {}, false, panel_id});
    EXPECT_EQ(pick(frame, {{0, 1, 0}, {0, 0, -1}})->id, panel_id);
}

TEST_F(PickTest, ARayThroughAPixelMeetsWhatThePixelShows) {
    frame.objects.push_back({&*ball, {Quat{}, {0.4, 1.2, -2}}, {}, false, liver});
    const CameraView view = view_towards({1, 1.7, 1}, {0, 1, -2}, 60, {160, 120});
    const Vec3 in_eye = inverse(view.room_from_eye) * Vec3{0.4, 1.2, -2};
    const Vec2 middle{(in_eye.x / in_eye.z - view.left) / (view.right - view.left),
                      (in_eye.y / in_eye.z - view.top) / (view.bottom - view.top)};
    const auto picked = pick(frame, ray_through(view, middle));
    ASSERT_TRUE(picked);
    EXPECT_NEAR(picked->distance_m, length(in_eye) - 0.5, 0.01);
    EXPECT_FALSE(pick(frame, ray_through(view, {0.02, 0.02})));
}

TEST_F(PickTest, ScaledObjectsAreFoundAtTheirSize) {
    frame.objects.push_back({&*ball, {Quat{}, {0, 1, -3}}, {}, false, liver, 2});
    EXPECT_NEAR(pick(frame, {{0, 1, 0}, {0, 0, -1}})->distance_m, 2, 0.01);
    EXPECT_TRUE(pick(frame, {{0.9, 1, 0}, {0, 0, -1}}));
    frame.objects.back().scale = 0.5;
    EXPECT_NEAR(pick(frame, {{0, 1, 0}, {0, 0, -1}})->distance_m, 2.75, 0.01);
    EXPECT_FALSE(pick(frame, {{0.3, 1, 0}, {0, 0, -1}}));
}

TEST_F(PickTest, WhatIsCutAwayIsTransparentForRays) {
    // The front half is gone: the ray meets the back of the ball from inside.
    frame.objects.push_back(
        {&*ball, {Quat{}, {0, 1, -3}}, {}, false, liver, 1, Cut{{0, 0, 1}, -3}});
    EXPECT_NEAR(pick(frame, {{0, 1, 0}, {0, 0, -1}})->distance_m, 3.5, 0.01);
    EXPECT_NEAR(pick(frame, {{0, 1, -6}, {0, 0, 1}})->distance_m, 2.5, 0.01);
    EXPECT_FALSE(pick(frame, {{0, 1, -2.8}, {0, 0, 1}}));
    frame.objects.back().cut = Cut{{1, 0, 0}, -0.1};
    EXPECT_FALSE(pick(frame, {{0, 1, 0}, {0, 0, -1}}));
    EXPECT_TRUE(pick(frame, {{-0.3, 1, 0}, {0, 0, -1}}));
}

}  // namespace
}  // namespace theatron::render
