// SPDX-License-Identifier: Apache-2.0
// A camera whose pixels show one surface each, unlike those of time of flight.
#include <gtest/gtest.h>

#include <cmath>

#include "registration/frame_mean.h"
#include "registration/modelled_camera_test.h"
#include "registration/rig_solver.h"
#include "registration/test_views.h"

namespace theatron::registration {
namespace {

// Exact depth: neither noise nor fixed errors, so an error that is found is a false one.
TEST(ExactEdges, AreNoErrorOfDepth) {
    const LatticeTarget target = large_target();
    const CameraModel camera = azure_camera();
    const Image<Ray> rays = make_ray_table(camera);
    LatticeDetector detector(camera, 1.0 / FrameMean::finer, target);
    const std::vector<Pose> cameras{ring_camera(-30, 2), ring_camera(30, 2)};
    const Pose board{rotation_about({1, 0, 0.8}, 0.15), {0, 1.3, 0}};
    std::vector<BoardView> views;
    for (int c = 0; c < 2; ++c) {
        BoardScene scene(camera.size, 3);
        scene.add(target, inverse(cameras[std::size_t(c)]) * board, rays);
        DepthImage depth(camera.size);
        for (std::size_t i = 0; i < depth.pixels.size(); ++i)
            depth.pixels[i] =
                std::uint16_t(std::lround(scene.depth_m.pixels[i] * 1000 * FrameMean::finer));
        const auto detection = detector.detect(std::as_const(depth).view(), FitEffort::measure);
        ASSERT_TRUE(detection) << "camera " << c;
        views.push_back({c, 0, *detection});
    }
    const RigSolution solution = solve_rig(2, 1, views, target);
    ASSERT_TRUE(solution.converged);
    for (const CameraPlace& found : solution.cameras)
        EXPECT_LT(std::abs(found.bias.offset_m), 2 * found.bias_sigma.offset_m);
}

}  // namespace
}  // namespace theatron::registration
