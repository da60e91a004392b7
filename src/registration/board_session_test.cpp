// SPDX-License-Identifier: Apache-2.0
#include "registration/board_session.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "registration/modelled_camera_test.h"
#include "registration/room_alignment.h"
#include "registration/test_views.h"

namespace theatron::registration {
namespace {

using ::testing::HasSubstr;

// Two cameras a quarter circle apart, and a board in a person's hands.
class Carrying : public ::testing::Test {
protected:
    // Frames with the board at `room_from_board`; `blind` cameras see the wall alone.
    void hold(const LatticeTarget& cut, const Pose& room_from_board, int frames = 42,
              std::optional<std::size_t> blind = {}) {
        std::vector<BoardScene> scenes;
        for (std::size_t c = 0; c < 2; ++c) {
            BoardScene& scene = scenes.emplace_back(camera_.size, 4);
            if (blind != c)
                scene.add(cut, inverse(cameras_[c]) * room_from_board, rays_);
        }
        for (int frame = 0; frame < frames; ++frame, now_ += 33ms)
            for (std::size_t c = 0; c < 2; ++c) {
                // Few different frames are enough noise, and quicker.
                if (drawn_[c].size() < 3 || frame < 3) {
                    if (frame == 0)
                        drawn_[c].clear();
                    drawn_[c].push_back(scenes[c].seen_by(sensors_[c], std::uint32_t(frame)));
                }
                session_.add(c, std::as_const(drawn_[c][std::size_t(frame) % 3]).view(), now_);
            }
    }

    const CameraModel camera_ = azure_camera();
    const Image<Ray> rays_ = make_ray_table(camera_);
    const LatticeTarget target_ = large_target();
    const std::vector<Pose> cameras_{ring_camera(-45, 2), ring_camera(45, 2)};
    const Pose board_{rotation_about({1, 0.3, 0.8}, 0.15), {0, 1.3, 0}};
    BoardSession session_{{{"left", camera_, 1}, {"right", camera_, 1}}, target_};
    std::vector<synthetic::DepthSensor> sensors_{{synthetic::nfov_unbinned(), camera_.size, 21},
                                                 {synthetic::nfov_unbinned(), camera_.size, 22}};
    std::vector<DepthImage> drawn_[2];
    TimePoint now_{};
};

TEST_F(Carrying, AStillBoardIsOnePlaceAndRegistersTheCameras) {
    hold(target_, board_);
    EXPECT_EQ(session_.places(), 1);
    EXPECT_EQ(session_.views(0), 1);
    EXPECT_EQ(session_.views(1), 1);
    EXPECT_EQ(session_.sight(0), BoardSession::Sight::taken);
    EXPECT_TRUE(session_.is_complete(session_.solve(), 1));
    EXPECT_FALSE(session_.is_complete(session_.solve(), 2));
    const RigSolution solution = session_.solve();
    EXPECT_EQ(session_.problem(solution), "");
    const Pose truth = inverse(cameras_[0]) * cameras_[1];
    const Vec3 at{0, 0, 2};
    EXPECT_LT(length(solution.cameras[1].reference_from_camera * at - truth * at), 0.006);
    ASSERT_EQ(session_.pairs(solution).size(), 1u);
    EXPECT_EQ(session_.pairs(solution)[0].places, 1);
    EXPECT_LT(session_.pairs(solution)[0].apart_m, 0.008);

    // It goes on being held: no further place. Then it is held elsewhere.
    hold(target_, board_);
    EXPECT_EQ(session_.places(), 1);
    hold(target_, Pose{{}, {0.1, 0.1, 0.05}} * board_);
    EXPECT_EQ(session_.places(), 2);
    EXPECT_EQ(session_.views(1), 2);
}

TEST_F(Carrying, TheNextStepLeadsToPartsOfThePictureWithoutAView) {
    const auto next = [&](int views) { return session_.next_step(session_.solve(), views); };
    EXPECT_THAT(next(2), HasSubstr("in the middle of the picture of 'left'"));
    hold(target_, board_);
    EXPECT_THAT(next(2), HasSubstr("where 'left' and 'right' both see it, in the left of the"));
    EXPECT_EQ(next(1), "");
    EXPECT_EQ(BoardSession::span_m(session_.solve()), Vec3());
    hold(target_, Pose{{}, {0, 0.3, 0}} * board_);
    EXPECT_NEAR(length(BoardSession::span_m(session_.solve())), 0.3, 0.02);
}

TEST_F(Carrying, ABlindCameraIsNamed) {
    hold(target_, board_, 42, 1);
    EXPECT_THAT(session_.next_step(session_.solve(), 1), HasSubstr("'right' and 'left'"));
    EXPECT_FALSE(session_.is_complete(session_.solve(), 1));
    EXPECT_THAT(session_.problem(session_.solve()), HasSubstr("'right' never saw the board"));
}

TEST_F(Carrying, NoBoardEndsInWhatToDo) {
    EXPECT_THAT(session_.problem(session_.solve()), HasSubstr("No camera saw the board"));
}

TEST_F(Carrying, ABoardOfAnotherSizeIsRefused) {
    LatticeTarget smaller = target_;
    for (double LatticeTarget::*size :
         {&LatticeTarget::width_m, &LatticeTarget::height_m, &LatticeTarget::bar_m})
        smaller.*size *= 0.985;
    hold(smaller, board_);
    EXPECT_NE(session_.problem(session_.solve()), "");
    EXPECT_THAT(session_.problem(session_.solve()), HasSubstr("--board"));
}

// A board that is cut through has no handedness: a mirrored drawing gives the same board, turned
// around.
TEST_F(Carrying, AMirroredDrawingMakesNoDifference) {
    hold(target_, board_ * Pose{Quat{0, 0, 1, 0}, {0, 0, -target_.thickness_m}});
    const RigSolution solution = session_.solve();
    EXPECT_EQ(session_.problem(solution), "");
    const Pose truth = inverse(cameras_[0]) * cameras_[1];
    const Vec3 at{0, 0, 2};
    EXPECT_LT(length(solution.cameras[1].reference_from_camera * at - truth * at), 0.006);
}

TEST(RoomAlignment, FindsTheFloorBelowACameraThatLooksDown) {
    const CameraModel camera = azure_camera();
    const Image<Ray> rays = make_ray_table(camera);
    const Pose room_from_camera = look_at({1, 1.8, 2}, {0.9, 0.4, 0.2}, {0, 1, 0});
    DepthImage depth(camera.size);
    for (std::size_t i = 0; i < rays.pixels.size(); ++i) {
        const Vec3 d = rotate(room_from_camera.rotation, {rays.pixels[i].x, rays.pixels[i].y, 1});
        const double to_floor = -1.8 / d.y, to_table = -0.9 / d.y, to_wall = -4 / d.z;
        const Vec3 table = room_from_camera.translation + d * to_table;
        double z = to_wall > 0 ? to_wall : 8;
        if (to_floor > 0)
            z = std::min(z, to_floor);
        if (to_table > 0 && table.x > 0.5 && table.x < 1.5 && table.z > -0.5 && table.z < 0.5)
            z = to_table;
        depth.pixels[i] = std::uint16_t(std::lround(z * 1000));
    }
    const auto floor = find_floor(std::as_const(depth).view(), 1, rays);
    ASSERT_TRUE(floor);
    EXPECT_NEAR(floor->plane.distance_m(), 1.8, 0.003);
    const auto table = find_table(std::as_const(depth).view(), 1, rays, floor->plane);
    ASSERT_TRUE(table);
    EXPECT_NEAR((room_from_camera * table->middle).y, 0.9, 0.01);
    EXPECT_FALSE(find_table(std::as_const(depth).view(), 1, rays, table->plane));
    // The room's frame from it: the same height and the same up.
    const Vec3 middle{0, 0, 2};
    const Pose room = room_from_reference(floor->plane, middle);
    EXPECT_NEAR(room.translation.y, 1.8, 0.003);
    EXPECT_NEAR((room * middle).x, 0, 1e-9);
    EXPECT_NEAR((room * middle).z, 0, 1e-9);
    const Vec3 up = rotate(room.rotation, rotate(conjugate(room_from_camera.rotation), {0, 1, 0}));
    EXPECT_GT(up.y, 0.99999);
    EXPECT_LT(rotate(room.rotation, {0, 0, 1}).z, 0);  // the camera looks along -z

    DepthImage nothing(camera.size);
    EXPECT_FALSE(find_floor(std::as_const(nothing).view(), 1, rays));
}

}  // namespace
}  // namespace theatron::registration
