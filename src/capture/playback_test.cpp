// SPDX-License-Identifier: Apache-2.0
#include "capture/playback.h"

#include <gtest/gtest.h>

#include "capture/test_recording.h"

namespace theatron::capture {
namespace {

constexpr TimePoint begin = from_us(5'000'000);

struct Shown {
    FrameNumber number;
    Duration due;
    int frame;
    bool operator==(const Shown&) const = default;
    friend void PrintTo(const Shown& s, std::ostream* out) {
        *out << "number " << s.number << " due " << s.due.count() << " frame " << s.frame;
    }
};

// The next frame at `now`, read.
Shown show(Playback& playback, Duration now) {
    const auto upcoming = playback.upcoming(begin + now);
    if (!upcoming)
        return {0, {}, -1};
    Frame frame;
    playback.read(frame);
    return {upcoming->number, upcoming->due - begin, frame.depth.pixels[0]};
}

const Shown nothing{0, {}, -1};

TEST(Playback, FirstFrameIsDueAtOnceAndTheOthersByTheirOffsets) {
    NumberedRecording recording({0ms, 30ms, 70ms});
    Playback playback(recording, 33ms, false, 0);
    EXPECT_EQ(show(playback, 0ms), (Shown{0, 0ms, 0}));
    EXPECT_EQ(show(playback, 0ms), (Shown{1, 30ms, 1}));
    EXPECT_EQ(show(playback, 31ms), (Shown{2, 70ms, 2}));
    EXPECT_EQ(show(playback, 71ms), nothing);
    EXPECT_EQ(show(playback, 72ms), nothing);
}

TEST(Playback, AskingTwiceChangesNothing) {
    NumberedRecording recording({0ms, 30ms});
    Playback playback(recording, 30ms, false, 0);
    show(playback, 0ms);
    EXPECT_EQ(playback.upcoming(begin + 1ms)->number, 1u);
    EXPECT_EQ(playback.upcoming(begin + 2ms)->number, 1u);
}

TEST(Playback, SkipsFramesMoreThanOnePeriodLateAndCountsThem) {
    NumberedRecording recording({0ms, 10ms, 20ms, 30ms, 40ms});
    Playback playback(recording, 10ms, false, 0);
    show(playback, 0ms);
    EXPECT_EQ(show(playback, 20ms), (Shown{1, 10ms, 1})) << "one period late is not too late";
    EXPECT_EQ(show(playback, 41ms), (Shown{4, 40ms, 4}));
}

TEST(Playback, SkipsNoneIfEachIsWanted) {
    NumberedRecording recording({0ms, 10ms, 20ms, 30ms});
    Playback playback(recording, 10ms, false, 0);
    playback.skip_none();
    for (int n = 0; n < 4; ++n)
        EXPECT_EQ(show(playback, n * 1000ms), (Shown{FrameNumber(n), n * 10ms, n}));
    EXPECT_EQ(show(playback, 4000ms), nothing);
}

TEST(Playback, FramesOfOneTimeAreDueOneAfterTheOther) {
    NumberedRecording recording({0ms, 10ms, 10ms, 10ms, 20ms});
    Playback playback(recording, 10ms, false, 0);
    for (const Shown& expected : {Shown{0, 0ms, 0}, Shown{1, 10ms, 1}, Shown{2, 10001us, 2},
                                  Shown{3, 10002us, 3}, Shown{4, 20ms, 4}})
        EXPECT_EQ(show(playback, 0ms), expected);
}

TEST(Playback, LoopsWithOnePeriodBetweenLastAndFirst) {
    NumberedRecording recording({0ms, 10ms});
    Playback playback(recording, 10ms, true, 0);
    for (int n = 0; n < 6; ++n)
        EXPECT_EQ(show(playback, n * 10ms), (Shown{FrameNumber(n), n * 10ms, n % 2}));
    EXPECT_EQ(show(playback, 1005ms), (Shown{100, 1000ms, 0})) << "skips whole rounds";
}

TEST(Playback, OneFrameLoops) {
    NumberedRecording recording({0ms});
    Playback playback(recording, 200ms, true, 0);
    EXPECT_EQ(show(playback, 0ms), (Shown{0, 0ms, 0}));
    EXPECT_EQ(show(playback, 0ms), (Shown{1, 200ms, 0}));
}

TEST(Playback, StartsAtTheFrameAskedFor) {
    NumberedRecording recording({0ms, 10ms, 20ms});
    Playback playback(recording, 10ms, true, 2);
    EXPECT_EQ(show(playback, 0ms), (Shown{0, 0ms, 2}));
    EXPECT_EQ(show(playback, 0ms), (Shown{1, 10ms, 0}));
}

TEST(Playback, EmptyRecordingsEndEvenInALoop) {
    NumberedRecording recording({});
    Playback playback(recording, 10ms, true, 3);
    EXPECT_EQ(show(playback, 0ms), nothing);
}

TEST(MemoryRecording, PlaysWhatItRead) {
    NumberedRecording source({0ms, 10ms});
    double done = 0;
    MemoryRecording memory(source, 2, [&](std::string_view, double d) { done = d; });
    EXPECT_EQ(done, 1);
    ASSERT_EQ(memory.frames(), 2u);
    Frame frame;
    for (int round = 0; round < 2; ++round) {
        for (int n = 0; n < 2; ++n) {
            EXPECT_EQ(memory.offset(), n * 10ms);
            memory.read(frame);
            EXPECT_EQ(frame.depth.pixels[0], n);
        }
        EXPECT_EQ(memory.offset(), std::nullopt);
        memory.rewind();
    }
}

}  // namespace
}  // namespace theatron::capture
