// SPDX-License-Identifier: Apache-2.0
#include "client/left_cameras.h"

#include <gtest/gtest.h>

namespace theatron::client {
namespace {

constexpr TimePoint begin = TimePoint{} + std::chrono::hours(1);
constexpr Duration ms = std::chrono::milliseconds(1);

TEST(LeftCameras, AreForgottenOnceNoPictureHasComeForAWhile) {
    LeftCameras left;
    left.update(CameraId{1}, false, begin);
    left.update(CameraId{2}, false, begin);
    left.on_picture(CameraId{2}, begin + 2000 * ms);
    left.on_picture(CameraId{3}, begin);
    EXPECT_FALSE(left.contains(CameraId{3})) << "it has not left";
    EXPECT_TRUE(left.forget_silent(begin + LeftCameras::patience - ms).empty());
    EXPECT_EQ(left.forget_silent(begin + LeftCameras::patience), std::vector{CameraId{1}});
    EXPECT_EQ(left.all(), std::vector{CameraId{2}});
    left.update(CameraId{2}, false, begin + 2500 * ms);
    EXPECT_EQ(left.forget_silent(begin + 2000 * ms + LeftCameras::patience),
              std::vector{CameraId{2}})
        << "that it has left is no picture";
    EXPECT_TRUE(left.all().empty());
}

// No host of ours gives a number again, but a recorder must not have one twice.
TEST(LeftCameras, AreNotThoseThatAreThereAgain) {
    LeftCameras left;
    left.update(CameraId{1}, false, begin);
    left.update(CameraId{1}, true, begin + ms);
    EXPECT_TRUE(left.all().empty());
    EXPECT_TRUE(left.forget_silent(begin + 2 * LeftCameras::patience).empty());
}

TEST(LeftCameras, AreOnlySoMany) {
    LeftCameras left;
    for (std::uint32_t i = 0; i < 2 * LeftCameras::max; ++i) {
        left.update(CameraId(i), false, begin + i * ms);
        left.on_picture(CameraId{0}, begin + i * ms);
    }
    EXPECT_EQ(left.all().size(), LeftCameras::max);
    EXPECT_TRUE(left.contains(CameraId{0})) << "its pictures come";
    EXPECT_TRUE(left.contains(CameraId{2 * LeftCameras::max - 1}));
    EXPECT_FALSE(left.contains(CameraId{1}));
}

}  // namespace
}  // namespace theatron::client
