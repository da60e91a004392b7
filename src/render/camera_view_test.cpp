// SPDX-License-Identifier: Apache-2.0
#include "render/camera_view.h"

#include <gtest/gtest.h>

#include "image/image.h"

namespace theatron::render {
namespace {

// A wall, and before it a person who fills this share of the columns.
DepthImage person_before_wall(double share) {
    DepthImage depth({96, 72});
    for (int y = 0; y < 72; ++y)
        for (int x = 0; x < 96; ++x)
            depth.view().row(y)[x] =
                std::abs(x - 48) < 48 * share ? std::uint16_t(1200 + y) : std::uint16_t(3500);
    return depth;
}

double distance_of_interest(const DepthImage& depth) {
    Calibration calibration;
    calibration.room_from_camera = {};
    return point_of_interest(calibration, depth.view()).z;
}

TEST(PointOfInterest, IsThePersonHoweverMuchOfTheMiddleTheWallFills) {
    // A third of the columns are looked at: these are 18, 36 and 84 % of them.
    for (const double share : {0.06, 0.12, 0.28})
        EXPECT_NEAR(distance_of_interest(person_before_wall(share)), 1.236, 0.03) << share;
}

TEST(PointOfInterest, IsNoStrayPixelBeforeTheScene) {
    DepthImage depth = person_before_wall(0);
    depth.view().row(36)[48] = 400;
    depth.view().row(32)[44] = 420;
    EXPECT_NEAR(distance_of_interest(depth), 3.5, 1e-9);
}

TEST(PointOfInterest, IsOneMetreAheadWhereNothingIsMeasured) {
    EXPECT_NEAR(distance_of_interest(DepthImage({96, 72})), 1, 1e-9);
}

}  // namespace
}  // namespace theatron::render
