// SPDX-License-Identifier: Apache-2.0
#include "capture/transport.h"

#include <gtest/gtest.h>

#include "capture/playback.h"
#include "capture/test_recording.h"
#include "testing/manual_clock.h"

namespace theatron::capture {
namespace {

constexpr TimePoint begin = from_us(5'000'000);

TEST(Transport, BeginsWhenItIsAskedFirst) {
    Transport transport(10s, std::nullopt, 2s);
    EXPECT_EQ(transport.state(begin).position, 2s);
    EXPECT_EQ(transport.state(begin + 3s).position, 5s);
    EXPECT_FALSE(transport.state(begin + 3s).at_end);
}

TEST(Transport, PausesSeeksAndGoesOn) {
    Transport transport(10s, std::nullopt, {});
    (void)transport.state(begin);
    transport.pause(begin + 4s);
    EXPECT_EQ(transport.state(begin + 7s).position, 4s);
    EXPECT_TRUE(transport.state(begin + 7s).paused);
    transport.seek(1s, begin + 8s);
    EXPECT_EQ(transport.state(begin + 9s).position, 1s) << "it stays paused";
    transport.resume(begin + 10s);
    EXPECT_EQ(transport.state(begin + 12s).position, 3s);
    EXPECT_EQ(transport.state(begin + 12s).changes, 3u);
    transport.seek(99s, begin + 12s);
    EXPECT_EQ(transport.state(begin + 12s).position, 10s);
    transport.seek(-1s, begin + 12s);
    EXPECT_EQ(transport.state(begin + 12s).position, 0s);
}

TEST(Transport, StaysAtItsEndAndBeginsAgainThere) {
    Transport transport(10s, std::nullopt, {});
    (void)transport.state(begin);
    EXPECT_EQ(transport.state(begin + 60s).position, 10s);
    EXPECT_TRUE(transport.state(begin + 60s).at_end);
    transport.resume(begin + 70s);
    EXPECT_EQ(transport.state(begin + 71s).position, 1s);
    EXPECT_FALSE(transport.state(begin + 71s).at_end);
}

TEST(Transport, GoesRoundInALoop) {
    Transport transport(10s, 11s, {});
    (void)transport.state(begin);
    EXPECT_EQ(transport.state(begin + 10500ms).position, 10s);
    EXPECT_EQ(transport.state(begin + 25s).position, 3s);
    EXPECT_EQ(transport.state(begin + 25s).rounds, 2u);
    EXPECT_FALSE(transport.state(begin + 25s).at_end);
}

// 60 frames, 10 ms apart.
std::unique_ptr<Recording> numbered() {
    std::vector<Duration> offsets;
    for (int i = 0; i < 60; ++i)
        offsets.push_back(10ms * i);
    return std::make_unique<NumberedRecording>(std::move(offsets));
}

class Played : public ::testing::Test {
protected:
    Played() {
        CameraInfo info;
        info.frames_per_second = 100;
        camera = make_recorded_camera(info, numbered(), {}, clock.as<Clock>());
        camera->follow(transport);
    }
    // The next frame's index; -1 at the end.
    int next() {
        while (true) {
            const Capture got = camera->next(20ms);
            if (got.kind == Capture::Kind::end) {
                EXPECT_TRUE(got.may_go_on);
                return -1;
            }
            if (got.kind != Capture::Kind::frame)
                continue;
            EXPECT_GT(got.frame->times.captured, captured) << "time never runs backwards";
            EXPECT_TRUE(captured == TimePoint{} || got.frame->number > number);
            captured = got.frame->times.captured;
            number = got.frame->number;
            return got.frame->depth.pixels[0];
        }
    }

    // The time at which somebody does something, a little after the last picture.
    TimePoint soon() {
        clock.pass(1ms);
        return clock.now();
    }

    testing::ManualClock clock;
    std::shared_ptr<Transport> transport =
        std::make_shared<Transport>(590ms, std::nullopt, Duration(0));
    std::unique_ptr<Camera> camera;
    TimePoint captured;
    FrameNumber number = 0;
};

TEST_F(Played, APausedRecordingIsASceneThatStandsStill) {
    const int first = next();
    transport->pause(soon());
    const int still = next();
    EXPECT_GE(still, first);
    for (int i = 0; i < 5; ++i)
        EXPECT_EQ(next(), still);
    transport->seek(300ms, soon());
    for (int i = 0; i < 3; ++i)
        EXPECT_EQ(next(), 30);
    transport->seek(100ms, soon());
    EXPECT_EQ(next(), 10);
    transport->resume(soon());
    const int after = next();
    EXPECT_GE(after, 10);
    EXPECT_GT(next(), after);
}

TEST_F(Played, ARecordingThatHasEndedCanBePlayedAgain) {
    transport->seek(570ms, soon());
    int last = 0;
    for (int at = next(); at >= 0; at = next())
        last = at;
    EXPECT_EQ(last, 59);
    EXPECT_EQ(next(), -1);
    transport->resume(soon());
    EXPECT_LT(next(), 20);
}

}  // namespace
}  // namespace theatron::capture
