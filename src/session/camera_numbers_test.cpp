// SPDX-License-Identifier: Apache-2.0
#include "session/camera_numbers.h"

#include <gtest/gtest.h>

#include <set>

namespace theatron::session {
namespace {

using std::chrono::hours;
using std::chrono::milliseconds;
using std::chrono::seconds;

class Numbers : public ::testing::Test {
protected:
    // Cameras that come and go at once, until none has a number, at most `most`.
    int come_and_go(int most) {
        int came = 0;
        for (; came < most && numbers_.has(1); ++came)
            numbers_.give_back(numbers_.take());
        return came;
    }
    void pass(Duration time) { numbers_.on_time(now_ += time); }

    CameraNumbers numbers_;
    TimePoint now_ = from_us(1'000'000);
};

TEST_F(Numbers, AreAllUsedOnceBeforeOneIsUsedAgain) {
    pass(seconds(1));
    std::set<CameraId> seen;
    for (int i = 0; i <= max_camera_number; ++i) {
        EXPECT_EQ(numbers_.next(0), CameraId(i));
        const CameraId taken = numbers_.take();
        EXPECT_TRUE(seen.insert(taken).second);
        EXPECT_TRUE(numbers_.was_given(taken));
        numbers_.give_back(taken);
    }
    EXPECT_FALSE(numbers_.has(1)) << "none has rested";
    pass(CameraNumbers::rest - milliseconds(1));
    EXPECT_FALSE(numbers_.has(1));
    pass(milliseconds(1));
    ASSERT_TRUE(numbers_.has(3));
    EXPECT_EQ(numbers_.next(2), CameraId(2));
    EXPECT_EQ(numbers_.take(), CameraId(0));
}

TEST_F(Numbers, ThatAreKeptAreNotGivenOut) {
    numbers_.keep(3);
    EXPECT_TRUE(numbers_.was_given(CameraId(2)));
    EXPECT_EQ(numbers_.next(1), CameraId(4));
    EXPECT_EQ(numbers_.take(), CameraId(3));
}

TEST_F(Numbers, OfSeveralThatHaveRestedTheOneIsUsedThatLeftLongestAgo) {
    pass(seconds(1));
    const CameraId stays = numbers_.take(), leaves_last = numbers_.take();
    come_and_go(max_camera_number - 1);
    pass(CameraNumbers::rest);
    numbers_.give_back(leaves_last);
    EXPECT_EQ(numbers_.next(0), CameraId(2));
    EXPECT_EQ(come_and_go(100'000), max_camera_number - 1) << "not the one that has just left";
    pass(CameraNumbers::rest);
    EXPECT_EQ(numbers_.take(), leaves_last);
    for (int i = 0; i < max_camera_number - 1; ++i)
        EXPECT_NE(numbers_.take(), stays);
    EXPECT_FALSE(numbers_.has(1));
}

// The budgets of links allow less.
TEST_F(Numbers, NeverEndHoweverOftenCamerasComeAndGo) {
    const TimePoint end = now_ + hours(24);
    while (now_ < end) {
        ASSERT_EQ(come_and_go(50), 50);
        pass(seconds(1));
    }
}

}  // namespace
}  // namespace theatron::session
