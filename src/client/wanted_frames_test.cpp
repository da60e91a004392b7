// SPDX-License-Identifier: Apache-2.0
#include "client/wanted_frames.h"

#include <gtest/gtest.h>

namespace theatron::client {
namespace {

receive::CameraFramePtr frame(int camera, FrameNumber number) {
    const auto made = std::make_shared<receive::CameraFrame>();
    made->camera = CameraId(camera);
    made->number = number;
    return made;
}

TEST(WantedFrames, AllAreHandedOnUntilSomebodyAsks) {
    WantedFrames wanted;
    EXPECT_TRUE(wanted.add(frame(0, 1)));
    EXPECT_TRUE(wanted.add(frame(0, 2)));
    EXPECT_TRUE(wanted.want().empty());  // none waits
}

TEST(WantedFrames, OneOfEachCameraForEachWish) {
    WantedFrames wanted;
    (void)wanted.want();
    EXPECT_TRUE(wanted.add(frame(0, 1)));
    EXPECT_FALSE(wanted.add(frame(0, 2)));
    EXPECT_TRUE(wanted.add(frame(1, 2)));
    EXPECT_FALSE(wanted.add(frame(0, 3)));
    const auto newest = wanted.want();
    ASSERT_EQ(newest.size(), 1u);
    EXPECT_EQ(newest[0]->number, 3u);
    // That was camera 0's.
    EXPECT_FALSE(wanted.add(frame(0, 4)));
    EXPECT_TRUE(wanted.add(frame(1, 4)));
    // A wish repeated without a frame in between changes nothing.
    EXPECT_EQ(wanted.want().size(), 1u);
    EXPECT_TRUE(wanted.want().empty());
    EXPECT_TRUE(wanted.add(frame(0, 5)));
}

TEST(WantedFrames, FramesOfCamerasThatAreGoneAreNotHandedOn) {
    WantedFrames wanted;
    (void)wanted.want();
    (void)wanted.add(frame(0, 1));
    (void)wanted.add(frame(0, 2));
    wanted.forget(CameraId(0));
    EXPECT_TRUE(wanted.want().empty());
    wanted.begin_anew();
    EXPECT_TRUE(wanted.add(frame(0, 1)));
    EXPECT_TRUE(wanted.add(frame(0, 2)));
}

}  // namespace
}  // namespace theatron::client
