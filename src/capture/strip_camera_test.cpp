// SPDX-License-Identifier: Apache-2.0
#include "capture/strip_camera.h"

#include <gtest/gtest.h>

#include "base/error.h"
#include "photon/strip_finder.h"
#include "testing/manual_clock.h"

namespace theatron::capture {
namespace {

FramePtr next_frame(Camera& camera) {
    while (true)
        if (Capture got = camera.next(5ms); got.kind == Capture::Kind::frame)
            return got.frame;
}

TEST(StripCamera, PicturesComeLateByTheDelayAndShowWhenTheyWereTaken) {
    testing::ManualClock clock;
    const auto camera = make_strip_camera({.delay = 80ms}, clock.as<Clock>());
    std::optional<TimePoint> before;
    for (int i = 0; i < 5; ++i) {
        const FramePtr frame = next_frame(*camera);
        EXPECT_EQ(clock.now(), frame->times.captured + 80ms);
        if (before) {
            EXPECT_EQ(frame->times.captured - *before, Duration(33'333));
        }
        before = frame->times.captured;
        photon::GreyImage grey;
        photon::grey_of(frame->color.pixels.view(), grey);
        const auto strips = photon::find_strips(grey.view());
        ASSERT_EQ(strips.size(), 1u);
        ASSERT_TRUE(strips[0].time);
        EXPECT_NEAR(photon::age_ms(clock.now(), *strips[0].time), 80, 0.5);
    }
}

TEST(StripCamera, LeavesOutWhatIsLate) {
    testing::ManualClock clock;
    const auto camera = make_strip_camera({}, clock.as<Clock>());
    const TimePoint first = next_frame(*camera)->times.captured;
    clock.pass(1s);
    const FramePtr frame = next_frame(*camera);
    EXPECT_GT(frame->times.captured, first + 900ms);
    EXPECT_EQ(frame->number, FrameNumber(1));
}

TEST(StripCamera, RefusesDelaysThatCannotBe) {
    EXPECT_THROW((void)open_camera("strip:delay=-1"), Error);
    EXPECT_THROW((void)open_camera("strip:delay=99999"), Error);
    EXPECT_THROW((void)open_camera("strip:left"), Error);
}

}  // namespace
}  // namespace theatron::capture
