// SPDX-License-Identifier: Apache-2.0
#include "registration/lattice_detector.h"

#include <gtest/gtest.h>

#include <random>

#include "registration/frame_mean.h"
#include "registration/modelled_camera_test.h"

namespace theatron::registration {
namespace {

double angle_between(const Pose& a, const Pose& b) {
    const Quat d = conjugate(a.rotation) * b.rotation;
    return 2 * std::asin(std::min(1.0, std::sqrt(d.x * d.x + d.y * d.y + d.z * d.z)));
}

class LatticeDetection : public ::testing::Test {
protected:
    double between(double a, double b) {
        return a + (b - a) * double(rng_()) / double(std::mt19937::max());
    }

    const CameraModel camera_ = azure_camera();
    const Image<Ray> rays_ = make_ray_table(camera_);
    const LatticeTarget target_ = large_target();
    LatticeDetector detector_{camera_, 1, target_};
    synthetic::DepthSensor sensor_{synthetic::nfov_unbinned(), camera_.size, 5};
    std::mt19937 rng_{11};
};

TEST_F(LatticeDetection, FindsEitherFaceAtAnyPlaceAndSaysWhich) {
    for (int i = 0; i < 16; ++i) {
        const double distance = between(1, 3.5), tilt = between(0, 50), about = between(0, 6.28);
        const double off = 0.3 * (distance - 1) / 2.5 + 0.02;
        Pose pose = board_pose(distance, {between(-off, off), between(-off, off)},
                               tilt * std::cos(about), tilt * std::sin(about), between(0, 360));
        const Face face = i % 2 == 0 ? Face::front : Face::back;
        if (face == Face::back)
            pose = pose * Pose{Quat{0, 0, 1, 0}, {0, 0, -target_.thickness_m}};
        BoardScene scene(camera_.size, distance + 1.5);
        scene.add(target_, pose, rays_);
        const DepthImage depth = scene.seen_by(sensor_, std::uint32_t(i));
        const auto found = detector_.detect(depth.view());
        SCOPED_TRACE(::testing::Message() << distance << " m, tilted " << tilt << " degrees");
        ASSERT_TRUE(found);
        EXPECT_EQ(found->match.face, face);
        EXPECT_LT(length(found->camera_from_board.translation - pose.translation), 0.010);
        EXPECT_LT(angle_between(found->camera_from_board, pose), 0.010);
    }
}

TEST_F(LatticeDetection, StatesAnUncertaintyThatHolds) {
    double squares = 0;
    constexpr int boards = 12;
    for (int i = 0; i < boards; ++i) {
        const Pose pose = board_pose(2, {between(-0.1, 0.1), between(-0.1, 0.1)}, between(-30, 30),
                                     between(-30, 30), between(0, 360));
        // Another camera each time: its fixed errors are part of the uncertainty.
        synthetic::DepthSensor sensor(synthetic::nfov_unbinned(), camera_.size,
                                      std::uint32_t(100 + i));
        BoardScene scene(camera_.size, 3.5);
        scene.add(target_, pose, rays_);
        const DepthImage depth = scene.seen_by(sensor, 0);
        const auto found = detector_.detect(depth.view());
        ASSERT_TRUE(found);
        const LatticeFit& fit = found->fit;
        const Pose face = found->match.camera_from_face;
        ASSERT_LT(length(fit.camera_from_face.translation - face.translation), 0.04);
        const Pose truth = pose * board_from_face(target_, found->match.face);
        const Vec3 shift =
            rotate(conjugate(truth.rotation), fit.camera_from_face.translation - truth.translation);
        for (const auto& [error, axis] : {std::pair{shift.x, 3}, {shift.y, 4}, {shift.z, 5}})
            squares += error * error / fit.covariance(axis, axis);
    }
    const double normalised = std::sqrt(squares / (3 * boards));
    EXPECT_GT(normalised, 0.3);
    EXPECT_LT(normalised, 2);
}

TEST_F(LatticeDetection, MeasuresTheEdgesOfAMeanOfManyFramesToHalfAMillimetre) {
    synthetic::DepthSensor sensor(noise_alone(), camera_.size, 7);
    for (const double tilt : {-45, 45}) {
        const Pose pose = board_pose(2, {0, 0}, 5, tilt, 9);
        BoardScene scene(camera_.size, 4);
        scene.add(target_, pose, rays_);
        FrameMean mean(camera_.size);
        for (std::uint32_t frame = 0; frame < 12; ++frame) {
            const DepthImage depth = scene.seen_by(sensor, frame);
            mean.add(depth.view());
        }
        const DepthImage image = mean.mean();
        LatticeDetector detector(camera_, 1.0 / FrameMean::finer, target_);
        const auto found = detector.detect(image.view(), FitEffort::measure);
        ASSERT_TRUE(found);
        const Pose truth = pose * board_from_face(target_, found->match.face);
        const Pose& by_edges = found->fit.camera_from_face_by_edges;
        EXPECT_LT(length(by_edges.translation - truth.translation), 0.0005) << tilt;
        EXPECT_LT(angle_between(by_edges, truth), 0.0007) << tilt;
    }
}

TEST_F(LatticeDetection, FindsABoardOfWhichAPersonHidesAPart) {
    const Pose pose = board_pose(2, {0, 0}, 10, 20, 30);
    BoardScene scene(camera_.size, 3.5);
    scene.add(target_, pose, rays_);
    // An arm across the lower left.
    for (int y = 300; y < 330; ++y)
        for (int x = 100; x < 300; ++x)
            scene.depth_m.view().row(y)[x] = 1.5f;
    const DepthImage depth = scene.seen_by(sensor_, 1);
    const auto found = detector_.detect(depth.view());
    ASSERT_TRUE(found);
    EXPECT_LT(length(found->camera_from_board.translation - pose.translation), 0.010);
}

TEST_F(LatticeDetection, RefusesABoardOfAnotherSize) {
    LatticeTarget smaller = target_;
    smaller.width_m *= 0.85;
    smaller.height_m *= 0.85;
    smaller.bar_m *= 0.85;
    BoardScene scene(camera_.size, 3.5);
    scene.add(smaller, board_pose(2, {0, 0}, 10, 20, 30), rays_);
    const DepthImage depth = scene.seen_by(sensor_, 1);
    EXPECT_FALSE(detector_.detect(depth.view()));
}

TEST_F(LatticeDetection, FindsNoBoardWhereThereIsNone) {
    BoardScene wall(camera_.size, 2.5);
    const DepthImage depth = wall.seen_by(sensor_, 1);
    EXPECT_FALSE(detector_.detect(depth.view()));

    const DepthImage nothing(camera_.size);
    EXPECT_FALSE(detector_.detect(nothing.view()));

    // A plate without holes of the board's size.
    BoardScene plate(camera_.size, 3.5);
    const Pose board_from_camera = inverse(board_pose(2, {0, 0}, 10, 20, 30));
    const Rect r = outline(target_);
    for (std::size_t i = 0; i < rays_.pixels.size(); ++i) {
        const Vec3 d =
            rotate(board_from_camera.rotation, {rays_.pixels[i].x, rays_.pixels[i].y, 1});
        const double z = -board_from_camera.translation.z / d.z;
        const Vec3 at = board_from_camera.translation + d * z;
        if (at.x > r.left && at.x < r.right && at.y > r.bottom && at.y < r.top)
            plate.depth_m.pixels[i] = float(z);
    }
    const DepthImage plate_depth = plate.seen_by(sensor_, 1);
    EXPECT_FALSE(detector_.detect(plate_depth.view()));
}

TEST_F(LatticeDetection, SurvivesAnyDepthImage) {
    DepthImage depth(camera_.size);
    for (int kind = 0; kind < 6; ++kind) {
        for (std::size_t i = 0; i < depth.pixels.size(); ++i) {
            const auto random = std::uint32_t(rng_());
            switch (kind) {
                case 0:
                    depth.pixels[i] = std::uint16_t(random);
                    break;
                case 1:
                    depth.pixels[i] = random % 2 ? 1 : 0xffff;
                    break;
                case 2:
                    depth.pixels[i] = 1;
                    break;
                case 3:
                    depth.pixels[i] = 0xffff;
                    break;
                case 4:
                    depth.pixels[i] = std::uint16_t(i);
                    break;
                default:
                    depth.pixels[i] = std::uint16_t(1500 + i % 640 + random % 4);
                    break;
            }
        }
        EXPECT_FALSE(detector_.detect(std::as_const(depth).view())) << "kind " << kind;
    }
}

}  // namespace
}  // namespace theatron::registration
