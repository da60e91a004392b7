// SPDX-License-Identifier: Apache-2.0
#include "viewer/shown_moment.h"

#include <gtest/gtest.h>

namespace theatron::viewer {
namespace {

receive::CameraFramePtr frame_of(double captured_s, bool past = false) {
    const auto made = std::make_shared<receive::CameraFrame>();
    made->times.captured = from_us(std::int64_t(captured_s * 1e6));
    made->past = past;
    return made;
}

TEST(ShownMoment, IsLiveIfAllCamerasAre) {
    constexpr CameraId left{0}, right{1};
    const TimePoint now = from_us(100'000'000);
    const auto live = shown_moment({{left, frame_of(99.9)}, {right, frame_of(99.5)}}, {}, now);
    EXPECT_TRUE(live.is_live);
    EXPECT_NEAR(live.age_ms, 500, 0.1);
    const auto past = shown_moment({{left, frame_of(69, true)}, {right, frame_of(99.5)}}, {}, now);
    EXPECT_FALSE(past.is_live);
    EXPECT_NEAR(past.age_ms, 31'000, 0.1);
    EXPECT_FALSE(shown_moment({{left, frame_of(99, true)}}, {}, now).is_live);
    EXPECT_FALSE(shown_moment({{left, frame_of(97)}, {right, frame_of(99.5)}}, {}, now).is_live);
    EXPECT_FALSE(shown_moment({{left, frame_of(99.9)}}, {left}, now).is_live);
}

}  // namespace
}  // namespace theatron::viewer
