// SPDX-License-Identifier: Apache-2.0
#include "capture/camera_care.h"

#include <gtest/gtest.h>

namespace theatron::capture {
namespace {

constexpr Duration frame = 33'333us;

// A camera that delivers 40 ms after exposure, as depth cameras do.
class Care : public ::testing::Test {
protected:
    TimePoint now = from_us(5'000'000);
    CameraCare care{{frame, true}, now};
    std::uint64_t picture = 0;

    bool good_frame() {
        now += frame;
        return care.on_frame(now - 40ms, now, {++picture});
    }
    void good_frames(int count) {
        for (int i = 0; i < count; ++i)
            EXPECT_TRUE(good_frame());
    }
    // Time until the camera is stale, with a call of `each` every frame.
    template <class F>
    Duration until_stale(F each) {
        const TimePoint begin = now;
        while (!care.stale() && now - begin < 10s) {
            now += 10ms;
            if ((now - begin) / frame != (now - 10ms - begin) / frame)
                each();
            care.on_time(now);
        }
        return now - begin;
    }
};

TEST_F(Care, AWorkingCameraIsLiveWithAFrameMissingHereAndThere) {
    for (int i = 0; i < 1000; ++i) {
        good_frames(1);
        if (i % 7 == 0)
            now += 2 * frame;
        care.on_time(now);
        EXPECT_FALSE(care.stale());
    }
}

TEST_F(Care, ASilentCameraIsStaleWithin200MsAndOpenedAgain) {
    good_frames(30);
    EXPECT_LE(until_stale([] {}), 200ms);
    EXPECT_EQ(care.trouble(), Trouble::silent);
    EXPECT_FALSE(care.wants_reopen(now));
    now += CameraCare::reopen_after;
    EXPECT_TRUE(care.wants_reopen(now));
    care.on_opened(now);
    EXPECT_FALSE(care.wants_reopen(now));
    care.on_time(now);
    EXPECT_TRUE(care.stale());  // until its first picture
    EXPECT_TRUE(good_frame());
    EXPECT_FALSE(care.stale());
    EXPECT_EQ(care.figures().reopens, 1u);
    EXPECT_EQ(care.figures().troubles[int(Trouble::silent)], 1u);
}

// One that plays a file whose pictures are all wanted.
TEST_F(Care, ACameraWhosePicturesAreWaitedForIsNeverLateOrSilent) {
    CameraCare patient({frame, false, true}, now);
    for (int i = 0; i < 100; ++i) {
        now += 3s;
        patient.on_time(now);
        EXPECT_FALSE(patient.stale());
        EXPECT_TRUE(patient.on_frame(from_us(5'000'000) + i * frame, now, {}));
    }
    EXPECT_FALSE(patient.on_frame(from_us(5'000'000), now, {})) << "times that go back are wrong";
}

TEST_F(Care, ACameraThatWaitsForItsMasterIsLeftAlone) {
    now += 1h;
    care.on_time(now);
    EXPECT_TRUE(care.stale());
    EXPECT_FALSE(care.wants_reopen(now));
    EXPECT_TRUE(good_frame());
    EXPECT_FALSE(care.stale());
}

TEST_F(Care, AStallThatEndsNeedsNoReopening) {
    good_frames(3);
    now += 700ms;
    care.on_time(now);
    EXPECT_TRUE(care.stale());
    good_frames(1);
    EXPECT_FALSE(care.stale());
    EXPECT_EQ(care.figures().reopens, 0u);
}

TEST_F(Care, TheSameTimeAgainIsNoPicture) {
    good_frames(30);
    const TimePoint last = now - 40ms;
    EXPECT_LE(until_stale([&] { EXPECT_FALSE(care.on_frame(last, now, {++picture})); }), 200ms);
    EXPECT_EQ(care.trouble(), Trouble::repeating);
}

TEST_F(Care, TheSamePictureAgainIsNoneForALiveCamera) {
    good_frames(30);
    EXPECT_LE(until_stale([&] { EXPECT_FALSE(care.on_frame(now - 40ms, now, {picture})); }), 200ms);
    EXPECT_EQ(care.trouble(), Trouble::repeating);
    EXPECT_GT(care.figures().repeated_frames, 2u);
}

TEST_F(Care, ARecordingMayStandStill) {
    CameraCare recorded{{frame, false}, now};
    for (int i = 0; i < 30; ++i) {
        now += frame;
        EXPECT_TRUE(recorded.on_frame(now, now, {7}));
    }
    now += 1h;
    recorded.on_time(now);
    EXPECT_TRUE(recorded.stale());
    EXPECT_FALSE(recorded.wants_reopen(now));
}

TEST_F(Care, ACoveredLensIsNoRepetition) {
    for (int i = 0; i < 30; ++i) {
        now += frame;
        EXPECT_TRUE(care.on_frame(now - 40ms, now, {0}));
    }
}

TEST_F(Care, ATimeThatCannotBeIsStaleWithin200Ms) {
    for (const Duration jump : {Duration(-1h), Duration(-500ms), Duration(100ms), Duration(1h)}) {
        good_frames(30);
        EXPECT_LE(
            until_stale([&] { EXPECT_FALSE(care.on_frame(now - 40ms + jump, now, {++picture})); }),
            200ms);
        EXPECT_EQ(care.trouble(), Trouble::time_jump);
        now += CameraCare::reopen_after;
        EXPECT_TRUE(care.wants_reopen(now));
        care.on_opened(now);
    }
    EXPECT_EQ(care.figures().troubles[int(Trouble::time_jump)], 4u);
}

TEST_F(Care, AnUnpluggedCameraIsStaleAtOnceAndTriedWithBackOff) {
    good_frames(3);
    care.on_gone("The cable is out.", now);
    EXPECT_EQ(care.trouble(), Trouble::gone);
    EXPECT_EQ(care.problem(), "The cable is out.");
    const TimePoint begin = now;
    std::vector<Duration> attempts;
    while (now - begin < 20s) {
        now += 10ms;
        if (care.wants_reopen(now)) {
            attempts.push_back(now - begin);
            care.on_open_failed("Still not there.", now);
        }
    }
    EXPECT_EQ(attempts,
              (std::vector<Duration>{250ms, 750ms, 1750ms, 3750ms, 7750ms, 12750ms, 17750ms}));
    care.on_opened(now);
    good_frames(1);
    EXPECT_FALSE(care.stale());
    EXPECT_TRUE(care.problem().empty());
    care.on_gone("Again.", now);
    now += CameraCare::first_wait;
    EXPECT_TRUE(care.wants_reopen(now));  // the timeout starts again
}

TEST_F(Care, ASlowCameraIsGivenItsTime) {
    CameraCare slow{{200ms, true}, now};
    for (int i = 0; i < 20; ++i) {
        now += 200ms;
        slow.on_time(now);
        EXPECT_FALSE(slow.stale());
        EXPECT_TRUE(slow.on_frame(now, now, {++picture}));
    }
}

}  // namespace
}  // namespace theatron::capture
