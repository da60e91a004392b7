// SPDX-License-Identifier: Apache-2.0
#include "client/left_cameras.h"

#include <gtest/gtest.h>

namespace theatron::client {
namespace {

constexpr TimePoint begin = TimePoint{} + std::chrono::hours(1);
constexpr Duration ms = std::chrono::milliseconds(1);

TEST(LeftCameras, AreForgottenOnceNoPictureHasComeForAWhile) {
    LeftCameras left;
    left.add(CameraId{1}, begin);
    left.add(CameraId{2}, begin);
    left.on_picture(CameraId{2}, begin + 2000 * ms);
    left.on_picture(CameraId{3}, begin);
    EXPECT_FALSE(left.contains(CameraId{3})) << "it has not left";
    EXPECT_TRUE(left.forget_silent(begin + LeftCameras::patience - ms).empty());
    EXPECT_EQ(left.forget_silent(begin + LeftCameras::patience), std::vector{CameraId{1}});
    EXPECT_EQ(left.all(), std::vector{CameraId{2}});
    left.add(CameraId{2}, begin + 2500 * ms);
    EXPECT_EQ(left.forget_silent(begin + 2000 * ms + LeftCameras::patience),
              std::vector{CameraId{2}})
        << "that it has left is no picture";
    EXPECT_TRUE(left.all().empty());
}

TEST(LeftCameras, AreOnlySoMany) {
    LeftCameras left;
    for (std::uint32_t i = 0; i < 2 * LeftCameras::max; ++i) {
        left.add(CameraId(i), begin + i * ms);
        left.on_picture(CameraId{0}, begin + i * ms);
    }
    EXPECT_EQ(left.all().size(), LeftCameras::max);
    EXPECT_TRUE(left.contains(CameraId{0})) << "its pictures come";
    EXPECT_TRUE(left.contains(CameraId{2 * LeftCameras::max - 1}));
    EXPECT_FALSE(left.contains(CameraId{1}));
}

}  // namespace
}  // namespace theatron::client
