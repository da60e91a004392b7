// SPDX-License-Identifier: Apache-2.0
#include "compare_causes.h"

#include <gtest/gtest.h>

#include "image/image.h"

namespace theatron::bench {
namespace {

constexpr Size size{40, 40};

// One camera where the viewer is, a wall 1 m away, drawn at 2 m. Columns of ten
// pixels: not seen by the camera, not measured, dropped by filters, not drawn.
struct CauseScene {
    DepthImage exact{size}, drawn{size}, measured{size}, arrived{size};
    Image<std::uint8_t> seen{size}, where{size};
    Calibration calibration;
    CauseInput input;

    CauseScene() {
        calibration.depth = pinhole(size, 60);
        calibration.room_from_camera = {};
        for (int y = 0; y < size.height; ++y)
            for (int x = 0; x < size.width; ++x) {
                exact.view().row(y)[x] = 1000;
                drawn.view().row(y)[x] = 2000;
                measured.view().row(y)[x] = x < 20 ? 0 : 1000;
                arrived.view().row(y)[x] = x < 30 ? 0 : 1000;
                seen.view().row(y)[x] = x >= 10;
                where.view().row(y)[x] = 1;
            }
        input.view = render::view_of_camera(calibration.depth, {}, size);
        refresh();
    }
    void refresh() {
        input.drawn_mm = drawn.view();
        input.exact_mm = exact.view();
        input.seen = std::as_const(seen).view();
        input.where = std::as_const(where).view();
    }
    CompareCauses causes() {
        return causes_of(input, {{calibration, measured.view(), arrived.view()}});
    }
};

TEST(CompareCauses, EachPixelCountsForTheStepThatLostIt) {
    const CompareCauses causes = CauseScene().causes();
    // One column beside each border has a measured neighbour among its four pixels.
    EXPECT_NEAR(causes.no_camera, 25, 0.01);
    EXPECT_NEAR(causes.sensor, 25, 2.6);
    EXPECT_NEAR(causes.filters, 25, 2.6);
    EXPECT_NEAR(causes.drawing, 25, 2.6);
    EXPECT_NEAR(causes.sum(), 100, 1e-9);
}

TEST(CompareCauses, WhatIsDrawnIsNotMissing) {
    CauseScene scene;
    scene.drawn = scene.exact;
    scene.refresh();
    EXPECT_EQ(scene.causes().sum(), 0);
}

TEST(CompareCauses, OnlyTheJudgedPixelsCount) {
    CauseScene scene;
    for (int y = 0; y < size.height; ++y)
        for (int x = 10; x < size.width; ++x)
            scene.where.view().row(y)[x] = 0;
    EXPECT_NEAR(scene.causes().no_camera, 100, 1e-9);
}

TEST(CompareCauses, AnotherCameraThatMeasuresTheSurfaceCounts) {
    CauseScene scene;
    const CompareCauses causes =
        causes_of(scene.input, {{scene.calibration, scene.measured.view(), scene.arrived.view()},
                                {scene.calibration, scene.exact.view(), scene.exact.view()}});
    EXPECT_NEAR(causes.drawing, 75, 1e-9);
    EXPECT_NEAR(causes.no_camera, 25, 1e-9);
}

}  // namespace
}  // namespace theatron::bench
