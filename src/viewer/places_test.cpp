// SPDX-License-Identifier: Apache-2.0
#include "viewer/places.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <memory>

namespace theatron::viewer {
namespace {

TEST(Places, PeopleWhoComeToSomebodyStandBesideEachOther) {
    const Pose host{Quat{1, 0, 0, 0}, {1, 1.6, -2}};
    std::vector<Vec3> heads;
    for (int guest = 0; guest < 6; ++guest) {
        const Vec3 place = beside(host, heads).translation;
        EXPECT_NEAR(place.y, 1.6, 1e-9);
        EXPECT_NEAR(place.z, -2, 1e-9) << "in a row";
        EXPECT_LT(length(place - host.translation), 2);
        EXPECT_GT(length(place - host.translation), 0.5);
        for (const Vec3& head : heads)
            EXPECT_GT(length(place - head), 0.5) << guest;
        heads.push_back(place);
    }
    EXPECT_NEAR(heads.front().x, 1.6, 1e-9) << "the first on the right";
}

TEST(Places, FromAboveTheEyeLooksStraightDownAtWhatTheCamerasSee) {
    Calibration calibration;  // not registered
    calibration.depth = pinhole({32, 24}, 70);
    auto frame = std::make_shared<receive::CameraFrame>();
    frame->depth = DepthImage(calibration.depth.size);
    std::fill(frame->depth.pixels.begin(), frame->depth.pixels.end(), std::uint16_t(2000));
    std::map<CameraId, Calibration> calibrations{{CameraId(0), calibration}};
    std::map<CameraId, receive::CameraFramePtr> newest;
    EXPECT_EQ(from_above({calibrations, newest}), std::nullopt);
    newest[CameraId(0)] = frame;
    const auto eye = from_above({calibrations, newest});
    ASSERT_TRUE(eye);
    // The camera stands above the origin and looks along -z.
    EXPECT_NEAR(eye->translation.x, 0, 1e-6);
    EXPECT_NEAR(eye->translation.z, -2, 1e-3);
    EXPECT_GT(eye->translation.y, 3);
    EXPECT_NEAR(rotate(eye->rotation, {0, 0, 1}).y, -1, 1e-6);
    EXPECT_NEAR(rotate(eye->rotation, {0, 1, 0}).z, 1, 1e-6) << "the camera's side is below";
}

}  // namespace
}  // namespace theatron::viewer
