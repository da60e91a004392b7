// SPDX-License-Identifier: Apache-2.0
#include "registration/rig_solver.h"

#include <gtest/gtest.h>

#include "registration/frame_mean.h"
#include "registration/modelled_camera_test.h"
#include "registration/test_views.h"

namespace theatron::registration {
namespace {

constexpr double hundredth_mm = 1e-5;
const LatticeTarget target = large_target();

BoardView seen(int camera, int place, const Pose& room_from_camera, const Pose& room_from_board,
               Face face = Face::front, double longer_m = 0) {
    return exact_view(camera, place, inverse(room_from_camera) * room_from_board, target, face,
                      longer_m);
}

double apart_m(const Pose& a, const Pose& b, Vec3 point) {
    return length(a * point - b * point);
}

TEST(RigSolver, FindsExactPosesThroughChainsOfCameras) {
    // The first and the last camera never see the same place.
    const std::vector<Pose> cameras{ring_camera(0, 2), ring_camera(120, 2), ring_camera(240, 2)};
    const std::vector<Pose> boards{{rotation_about({0, 1, 0}, 0.8), {0.1, 1.2, 0}},
                                   {rotation_about({1, 0, 0}, 0.4), {-0.2, 1.4, 0.1}}};
    const auto solution =
        solve_rig(3, 2,
                  {seen(0, 0, cameras[0], boards[0]), seen(1, 0, cameras[1], boards[0]),
                   seen(1, 1, cameras[1], boards[1]), seen(2, 1, cameras[2], boards[1])},
                  target);
    ASSERT_TRUE(solution.converged);
    for (std::size_t c = 0; c < cameras.size(); ++c)
        EXPECT_LT(apart_m(solution.cameras[c].reference_from_camera,
                          inverse(cameras[0]) * cameras[c], {0.3, 0.2, 2}),
                  hundredth_mm)
            << c;
}

TEST(RigSolver, JoinsCamerasThatSeeTheTwoFacesOfTheBoard) {
    const std::vector<Pose> cameras{ring_camera(0, 2), ring_camera(180, 2)};
    const Pose board{rotation_about({0, 0, 1}, 0.3), {0.1, 1.3, 0}};
    const auto solution = solve_rig(
        2, 1,
        {seen(0, 0, cameras[0], board, Face::front), seen(1, 0, cameras[1], board, Face::back)},
        target);
    ASSERT_TRUE(solution.converged);
    EXPECT_LT(apart_m(solution.cameras[1].reference_from_camera, inverse(cameras[0]) * cameras[1],
                      {0, 0, 2}),
              hundredth_mm);
}

TEST(RigSolver, NamesCamerasThatNothingJoins) {
    const Pose board{Quat{0, 1, 0, 0}, {0, 0, 2}};
    const auto solution = solve_rig(3, 2, {seen(0, 0, {}, board), seen(2, 1, {}, board)}, target);
    EXPECT_EQ(solution.separate, (std::vector<int>{1, 2}));
    EXPECT_FALSE(solution.converged);
    EXPECT_TRUE(solution.cameras.empty());
}

TEST(RigSolver, TheEdgesTellHowMuchTooFarACameraMeasures) {
    constexpr double longer_m = 0.004;
    std::vector<BoardView> views;
    for (int place = 0; place < 4; ++place)
        views.push_back(seen(0, place, {}, {Quat{0, 1, 0, 0}, {0.1 * place, 0, 1.5 + 0.3 * place}},
                             Face::front, longer_m));
    const auto solution = solve_rig(1, 4, views, target);
    ASSERT_TRUE(solution.converged);
    EXPECT_NEAR(solution.cameras[0].bias.offset_m, longer_m, 0.0006);
    EXPECT_LT(solution.cameras[0].bias_sigma.offset_m, 0.001);
}

TEST(RigSolver, OneWrongViewDoesNotMoveTheCameras) {
    const std::vector<Pose> cameras{ring_camera(-45, 2), ring_camera(45, 2)};
    std::vector<BoardView> views;
    for (int place = 0; place < 6; ++place) {
        const Pose board{rotation_about({0, 1, 0}, 0.1 * place - 0.3), {0.1 * place, 1.3, 0}};
        for (int c = 0; c < 2; ++c) {
            // In place 2 the board moved 3 cm between the two cameras' pictures.
            const Pose moved{{}, {0, 0, place == 2 && c == 1 ? 0.03 : 0}};
            views.push_back(seen(c, place, cameras[std::size_t(c)], board * moved));
        }
    }
    const auto solution = solve_rig(2, 6, views, target);
    ASSERT_TRUE(solution.converged);
    EXPECT_LT(apart_m(solution.cameras[1].reference_from_camera, inverse(cameras[0]) * cameras[1],
                      {0, 0, 2}),
              0.001);
    // And it is named by its error.
    EXPECT_GT(solution.view_error_m[5], 0.01);
    EXPECT_LT(solution.view_error_m[7], 0.001);
}

// A difference that the edges' own errors explain is no error of depth.
TEST(RigSolver, FindsNoErrorOfDepthWhereTheEdgesAreUncertain) {
    constexpr double edge_sigma_m = 0.003;
    // One millimetre remains in the mean.
    constexpr double wrong_m[] = {0.004, 0.002, -0.002, 0.004, -0.002, 0.002, -0.001, 0.001};
    std::vector<BoardView> views;
    for (int place = 0; place < 8; ++place) {
        BoardView view =
            seen(0, place, {}, {Quat{0, 1, 0, 0}, {0.1 * place, 0, 1.5 + 0.1 * place}});
        LatticeFit& fit = view.detection.fit;
        fit.edge_covariance(5, 5) = edge_sigma_m * edge_sigma_m;
        fit.camera_from_face_by_edges =
            fit.camera_from_face_by_edges * Pose{{}, {0, 0, wrong_m[place]}};
        views.push_back(view);
    }
    const auto solution = solve_rig(1, 8, views, target);
    ASSERT_TRUE(solution.converged);
    EXPECT_NEAR(solution.cameras[0].bias.offset_m, 0, 0.0002);
    EXPECT_LT(solution.cameras[0].bias_sigma.offset_m, 0.0005);
}

// The mean distance between where points of the working volume are and where `found` has them; the
// same as in `theatron bench registration`.
double mean_error_m(const Pose& found, const Pose& truth, const Pose& room_from_camera) {
    const Pose camera_from_room = inverse(room_from_camera);
    double sum = 0;
    int n = 0;
    for (int x = -7; x <= 7; ++x)
        for (int z = -7; z <= 7; ++z)
            for (int y = 8; y <= 18; ++y, ++n)
                sum += apart_m(found, truth,
                               camera_from_room * (Vec3{double(x), double(y), double(z)} * 0.1));
    return sum / n;
}

// Two cameras a quarter circle apart see the board at two metres through the modelled sensor.
TEST(RigSolver, TwoModelledCamerasAgreeOnTheWorkingVolume) {
    const CameraModel camera = azure_camera();
    const Image<Ray> rays = make_ray_table(camera);
    LatticeDetector detector(camera, 1.0 / FrameMean::finer, target);
    const std::vector<Pose> cameras{ring_camera(-45, 2), ring_camera(45, 2)};
    const Pose board{rotation_about({1, 0.3, 0.8}, 0.15), {0, 1.3, 0}};
    std::vector<BoardView> views;
    for (int c = 0; c < 2; ++c) {
        synthetic::DepthSensor sensor(noise_alone(), camera.size, 10 + std::uint32_t(c));
        BoardScene scene(camera.size, 4);
        scene.add(target, inverse(cameras[std::size_t(c)]) * board, rays);
        FrameMean mean(camera.size);
        for (std::uint32_t frame = 0; frame < 10; ++frame) {
            const DepthImage depth = scene.seen_by(sensor, frame);
            mean.add(depth.view());
        }
        const DepthImage depth = mean.mean();
        const auto detection = detector.detect(depth.view(), FitEffort::measure);
        ASSERT_TRUE(detection) << "camera " << c;
        views.push_back({c, 0, *detection});
    }
    const auto solution = solve_rig(2, 1, views, target);
    ASSERT_TRUE(solution.converged);
    const CameraPlace& found = solution.cameras[1];
    const Pose truth = inverse(cameras[0]) * cameras[1];
    // One pose and noise alone: the mean over 20 seeds of 30 frames is below 0.5 mm.
    EXPECT_LT(mean_error_m(found.reference_from_camera, truth, cameras[1]), 0.001);
    // The stated uncertainty is that of the error.
    const Vec3 shift = rotate(conjugate(truth.rotation),
                              found.reference_from_camera.translation - truth.translation);
    EXPECT_LT(std::abs(shift.x), 4 * std::sqrt(found.covariance(3, 3)));
    EXPECT_LT(std::sqrt(found.covariance(3, 3)), 0.005);
}

}  // namespace
}  // namespace theatron::registration
