// SPDX-License-Identifier: Apache-2.0
#include "record/segment_pace.h"

#include <gtest/gtest.h>

namespace theatron::record {
namespace {

using std::chrono::hours;
using std::chrono::milliseconds;
using std::chrono::seconds;

class Pace : public ::testing::Test {
protected:
    // Somebody wants a segment all the time. Returns how many begin.
    int begun_in(Duration time) {
        int begun = 0;
        for (const TimePoint end = now_ + time; now_ < end; now_ += milliseconds(100))
            if (pace_.may_begin(now_)) {
                pace_.begin(now_);
                ++begun;
            }
        return begun;
    }
    SegmentPace pace_;
    TimePoint now_ = from_us(1'000'000);
};

TEST_F(Pace, AFewSegmentsBeginAtOnce) {
    EXPECT_EQ(begun_in(seconds(5)), SegmentPace::at_once);
}

TEST_F(Pace, ThenOneAfterTenSecondsAndOneAfterTwenty) {
    begun_in(seconds(5));
    EXPECT_EQ(begun_in(seconds(4)), 0);
    EXPECT_EQ(begun_in(seconds(4)), 1);
    EXPECT_EQ(begun_in(seconds(17)), 0);
    EXPECT_EQ(begun_in(seconds(3)), 1);
    EXPECT_EQ(begun_in(seconds(36)), 0);
    EXPECT_EQ(begun_in(seconds(5)), 1);
}

TEST_F(Pace, ADayOfChangesMakesFewFiles) {
    EXPECT_LE(begun_in(hours(24)), 24 * 3600 / 160 + SegmentPace::at_once + 5);
}

TEST_F(Pace, AfterACalmTimeAllIsAsAtFirst) {
    begun_in(hours(1));
    now_ += SegmentPace::calm;
    EXPECT_EQ(begun_in(seconds(5)), SegmentPace::at_once);
}

}  // namespace
}  // namespace theatron::record
