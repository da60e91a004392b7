// SPDX-License-Identifier: Apache-2.0
#include "registration/surface_refinement.h"

#include <gtest/gtest.h>

#include "registration/room_view_test.h"

namespace theatron::registration {
namespace {

double apart_m(const Pose& a, const Pose& b) {
    const Vec3 at{0, 0, 1.8};  // where the cameras look
    return length(a * at - b * at);
}

// Two cameras at the room's table, one of them wrongly placed.
class Refining : public ::testing::Test {
protected:
    Refining() {
        for (int i = 0; i < 2; ++i) {
            RoomCamera camera(i, 2, synthetic::nfov_unbinned());
            poses_.push_back(camera.calibration.room_from_camera);
            cameras_.emplace_back(camera.calibration.depth, 1);
            images_.push_back(camera.image(1s));
        }
    }
    std::vector<SurfaceView> views(const Pose& error) const {
        return {{&cameras_[0], images_[0].view(), poses_[0]},
                {&cameras_[1], images_[1].view(), poses_[1] * error}};
    }
    std::vector<Pose> poses_;
    std::vector<SurfaceCamera> cameras_;
    std::vector<DepthImage> images_;
};

TEST_F(Refining, ACameraThatWasMovedIsBroughtBackByTheScene) {
    const Pose error{rotation_about({0.3, 1, 0.2}, 0.012), {0.015, -0.01, 0.01}};
    const auto refined = refine_on_surfaces(views(error), {0.1, 0.05, 0.03});
    EXPECT_TRUE(refined.is_kept);
    EXPECT_EQ(refined.reference_from_camera[0], poses_[0]);
    EXPECT_GT(apart_m(poses_[1] * error, poses_[1]), 0.02);
    EXPECT_LT(apart_m(refined.reference_from_camera[1], poses_[1]), 0.006);
    EXPECT_LT(refined.after_m, refined.before_m / 2);
    EXPECT_GT(refined.points, 100u);
}

TEST_F(Refining, PlacesThatFitStayAsTheyAre) {
    const auto refined = refine_on_surfaces(views({}));
    EXPECT_LT(apart_m(refined.reference_from_camera[1], poses_[1]), 0.003);
    EXPECT_LE(refined.after_m, refined.before_m);
}

TEST_F(Refining, NothingIsKeptWhereCamerasShareNoView) {
    const Pose elsewhere{rotation_about({0, 1, 0}, 3), {}};
    const auto refined = refine_on_surfaces(views(elsewhere));
    EXPECT_FALSE(refined.is_kept);
    EXPECT_EQ(refined.reference_from_camera[1], poses_[1] * elsewhere);
}

TEST(MostPlacesKept, OneMovedReferenceDoesNotMoveTheRoom) {
    const std::vector<Pose> before{{{}, {0, 0, 0}}, {{}, {1, 0, 0}}, {{}, {2, 0, 0}}};
    // Camera 0 is the reference of the new places, and the one that was moved by 3 cm.
    const std::vector<Pose> now{{{}, {0, 0, 0}}, {{}, {1, 0.03, 0}}, {{}, {2, 0.03, 0}}};
    const std::vector<Pose> kept = with_most_places_kept(before, now);
    EXPECT_NEAR(kept[1].translation.y, 0, 1e-12);
    EXPECT_NEAR(kept[2].translation.y, 0, 1e-12);
    EXPECT_NEAR(kept[0].translation.y, -0.03, 1e-12);
}

}  // namespace
}  // namespace theatron::registration
