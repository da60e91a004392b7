// SPDX-License-Identifier: Apache-2.0
#include "session/past.h"

#include <gtest/gtest.h>

#include <vector>

namespace theatron::session {
namespace {

constexpr StreamId kept_depth = depth_stream(CameraId{0}), kept_other = depth_stream(CameraId{1});
constexpr std::size_t kept_size = 100;

class PastOfACamera : public ::testing::Test {
protected:
    PastOfACamera() : past({std::chrono::seconds(60), 100'000}) {}

    bool add(StreamId stream, TimePoint at, bool key, std::size_t bytes = kept_size) {
        wire::MediaHeader header;
        header.stream = stream;
        header.setting = SettingId{1};
        header.frame = next++;
        header.key = key;
        header.captured = at;
        return past.add(header, Bytes(bytes), "trvl", at);
    }
    // Pictures of a second; the first is a key frame.
    void add_second(int second) {
        for (int tenth = 0; tenth < 10; ++tenth)
            (void)add(kept_depth, at(second + tenth / 10.0), tenth == 0);
    }
    static TimePoint at(double s) { return from_us(std::int64_t(s * 1e6)); }

    Past past;
    FrameNumber next = 0;
};

TEST_F(PastOfACamera, IsPlayedFromTheKeyFrameBefore) {
    EXPECT_FALSE(past.start(at(0)));
    for (int second = 0; second < 10; ++second)
        add_second(second);
    ASSERT_TRUE(past.start(at(4.55)));
    EXPECT_EQ(past.find(*past.start(at(4.55)))->at, at(4));
    EXPECT_EQ(past.find(*past.start(at(4)))->at, at(4));
    // Before the oldest: from the oldest on.
    EXPECT_EQ(past.find(*past.start(at(-9)))->at, at(0));
    EXPECT_EQ(past.find(past.end()), nullptr);
}

TEST_F(PastOfACamera, BeginsWhereAllItsStreamsCanBegin) {
    (void)add(kept_depth, at(1), true);
    (void)add(kept_other, at(2), true);
    (void)add(kept_depth, at(3), false);
    EXPECT_EQ(past.find(*past.start(at(3)))->at, at(1));
    // A stream whose last key frame is long ago has ended.
    (void)add(kept_other, at(9), true);
    EXPECT_EQ(past.find(*past.start(at(9)))->at, at(9));
}

TEST_F(PastOfACamera, ForgetsWhatIsOlderThanItsReach) {
    for (int second = 0; second < 100; ++second)
        add_second(second);
    EXPECT_LE(at(99.9) - past.find(past.begin())->at, past.reach() + Past::margin);
    EXPECT_GE(at(99.9) - past.find(past.begin())->at, past.reach() + Past::margin / 2);
    EXPECT_EQ(past.find(past.begin() - 1), nullptr);
    // Also while no pictures come.
    past.on_time(at(300));
    EXPECT_EQ(past.begin(), past.end());
    EXPECT_EQ(past.bytes(), 0u);
}

TEST_F(PastOfACamera, HoldsNoMoreBytesThanItsBound) {
    for (int i = 0; i < 50; ++i)
        (void)add(kept_depth, at(i / 10.0), i % 10 == 0, 9'000);
    EXPECT_EQ(past.bytes(), 99'000u);
    EXPECT_EQ(past.end() - past.begin(), 11u);
    EXPECT_EQ(past.find(past.end() - 1)->at, at(4.9));
    (void)add(kept_depth, at(5), true, 100'001);  // never
    EXPECT_EQ(past.find(past.end() - 1)->at, at(4.9));
}

TEST_F(PastOfACamera, AsksForAKeyFrameEveryTwoSeconds) {
    EXPECT_TRUE(add(kept_depth, at(10), false));
    EXPECT_FALSE(add(kept_depth, at(10.1), true));
    std::vector<TimePoint> keys;
    bool wanted = false;
    for (int i = 0; i < 300; ++i) {
        const TimePoint now = at(10.2 + i / 30.0);
        if (wanted)
            keys.push_back(now);
        wanted = add(kept_depth, now, wanted);
    }
    ASSERT_EQ(keys.size(), 5u);
    for (std::size_t i = 1; i < keys.size(); ++i)
        EXPECT_NEAR(to_seconds(keys[i] - keys[i - 1]), 2, 0.05);
}

TEST_F(PastOfACamera, KeepsNothingWithoutAReach) {
    Past none({});
    EXPECT_FALSE(none.add({}, Bytes(kept_size), "trvl", at(1)));
    EXPECT_EQ(none.begin(), none.end());
}

TEST_F(PastOfACamera, ForgetsACameraAndWhatItCapturedUntilThen) {
    (void)add(kept_depth, at(1), true);
    (void)add(kept_other, at(1), true);
    past.forget(CameraId{0}, at(2));
    EXPECT_EQ(past.bytes(), kept_size);
    EXPECT_EQ(past.find(past.begin())->message, nullptr);
    EXPECT_EQ(past.find(*past.start(at(2)))->header.stream, kept_other);
    // Encoded later, captured before.
    wire::MediaHeader late;
    late.stream = kept_depth;
    late.key = true;
    late.captured = at(1.99);
    (void)past.add(late, Bytes(kept_size), "trvl", at(2.1));
    EXPECT_EQ(past.bytes(), kept_size);
    late.captured = at(2);
    (void)past.add(late, Bytes(kept_size), "trvl", at(2.1));
    EXPECT_EQ(past.bytes(), 2 * kept_size);
}

}  // namespace
}  // namespace theatron::session
