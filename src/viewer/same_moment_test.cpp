// SPDX-License-Identifier: Apache-2.0
#include "viewer/same_moment.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

namespace theatron::viewer {
namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr TimePoint zero{std::chrono::hours(1)};
constexpr Duration period = microseconds(33'333);

receive::CameraFramePtr frame(int camera, int moment, Duration after_moment = {},
                              bool past = false) {
    auto frame = std::make_shared<receive::CameraFrame>();
    frame->camera = CameraId(camera);
    frame->moment = zero + moment * period;
    frame->number = FrameNumber(moment);
    frame->times.captured = frame->moment + after_moment;
    frame->past = past;
    return frame;
}

// "camera:moment" of each.
std::vector<std::string> names(const std::vector<receive::CameraFramePtr>& frames) {
    std::vector<std::string> result;
    for (const auto& f : frames)
        result.push_back(std::to_string(int(f->camera)) + ":" + std::to_string(int(f->number)));
    return result;
}

TEST(SameMoment, OneCameraWaitsForNothing) {
    SameMoment shown;
    shown.add(frame(0, 0), zero);
    EXPECT_THAT(names(shown.take(zero)), ElementsAre("0:0"));
    EXPECT_THAT(shown.take(zero), IsEmpty());
    EXPECT_EQ(shown.skew(zero), std::nullopt);
}

TEST(SameMoment, FramesOfOneMomentAreShownTogether) {
    SameMoment shown;
    for (int camera : {0, 1})
        shown.add(frame(camera, 0), zero);
    EXPECT_THAT(names(shown.take(zero)), ElementsAre("0:0", "1:0"));
    EXPECT_FALSE(shown.waits());
    shown.add(frame(0, 1), zero + period);
    EXPECT_THAT(shown.take(zero + period), IsEmpty());
    EXPECT_TRUE(shown.waits());
    shown.add(frame(1, 1), zero + period + milliseconds(3));
    EXPECT_THAT(names(shown.take(zero + period + milliseconds(3))), ElementsAre("0:1", "1:1"));
    EXPECT_EQ(shown.skew(zero + period + milliseconds(3)), Duration(0));
}

TEST(SameMoment, AFrameWhosePartnerDoesNotComeIsShownAlone) {
    SameMoment shown;
    for (int camera : {0, 1})
        shown.add(frame(camera, 0), zero);
    (void)shown.take(zero);
    const TimePoint then = zero + period;
    shown.add(frame(0, 1), then);
    EXPECT_THAT(shown.take(then + milliseconds(11)), IsEmpty());
    EXPECT_THAT(names(shown.take(then + milliseconds(12))), ElementsAre("0:1"));
    EXPECT_EQ(shown.skew(then + milliseconds(12)), period);
    // The late one waits for nobody.
    shown.add(frame(1, 1), then + milliseconds(20));
    EXPECT_THAT(names(shown.take(then + milliseconds(20))), ElementsAre("1:1"));
}

TEST(SameMoment, ACameraThatIsSilentOrGoneKeepsNobodyWaiting) {
    SameMoment shown;
    for (int camera : {0, 1, 2})
        shown.add(frame(camera, 0), zero);
    (void)shown.take(zero);
    shown.remove(CameraId(2));
    const TimePoint then = zero + 10 * period;  // camera 1 was silent
    shown.add(frame(0, 10), then);
    EXPECT_THAT(names(shown.take(then)), ElementsAre("0:10"));
}

TEST(SameMoment, ThePastAndItsEndAreShownAtOnce) {
    SameMoment shown;
    for (int camera : {0, 1})
        shown.add(frame(camera, 100), zero);
    (void)shown.take(zero);
    shown.add(frame(0, 40, {}, true), zero);
    EXPECT_THAT(names(shown.take(zero)), ElementsAre("0:40"));
    EXPECT_EQ(shown.skew(zero), std::nullopt) << "the past is no part of it";
    shown.add(frame(1, 40, {}, true), zero);
    (void)shown.take(zero);
    shown.add(frame(0, 101), zero);
    shown.add(frame(1, 101), zero);
    EXPECT_THAT(names(shown.take(zero)), ElementsAre("0:101", "1:101"));
}

TEST(SameMoment, ASessionThatBeginsAnewCountsItsMomentsAgain) {
    SameMoment shown;
    for (int moment = 100; moment < 130; ++moment)
        for (int camera : {0, 1})
            shown.add(frame(camera, moment), zero + moment * period);
    (void)shown.take(zero + 130 * period);
    const TimePoint then = zero + 200 * period;
    for (int camera : {0, 1})
        shown.add(frame(camera, 0), then);
    EXPECT_THAT(names(shown.take(then)), ElementsAre("0:0", "1:0"));
}

// Cameras that run for a while, drawn each 2 ms.
struct Seen {
    std::vector<double> waited_ms;  // of each frame of camera 0
    std::size_t together = 0;       // moments whose frames came with one picture
    double skew_ms = 0;             // the middle one
};

// `lateness`: of camera 1 behind camera 0; `loses`: each such frame of it does not come.
Seen watch(Duration lateness, Duration exposed_later, int loses, int moments = 300) {
    SameMoment shown;
    Seen seen;
    std::vector<double> skews;
    std::vector<std::pair<TimePoint, receive::CameraFramePtr>> arriving;
    for (int moment = 0; moment < moments; ++moment) {
        arriving.emplace_back(zero + moment * period, frame(0, moment));
        if (loses == 0 || moment % loses != loses - 1)
            arriving.emplace_back(zero + moment * period + lateness,
                                  frame(1, moment, exposed_later));
    }
    std::ranges::stable_sort(arriving, {}, [](const auto& a) { return a.first; });
    auto next = arriving.begin();
    for (TimePoint now = zero; now < zero + (moments - 1) * period; now += milliseconds(2)) {
        for (; next != arriving.end() && next->first <= now; ++next)
            shown.add(next->second, now);
        const auto frames = shown.take(now);
        for (const auto& f : frames)
            if (f->camera == CameraId(0))
                seen.waited_ms.push_back(to_ms(now - f->moment));
        seen.together += frames.size() == 2 && frames[0]->moment == frames[1]->moment;
        if (const auto skew = shown.skew(now))
            skews.push_back(to_ms(*skew));
    }
    std::ranges::sort(seen.waited_ms);
    std::ranges::sort(skews);
    seen.skew_ms = skews.at(skews.size() / 2);
    return seen;
}
double middle(const std::vector<double>& sorted) {
    return sorted.at(sorted.size() / 2);
}

TEST(SameMoment, CamerasInPhaseAreAlwaysShownTogether) {
    const Seen seen = watch(milliseconds(3), Duration(0), 0);
    EXPECT_GE(seen.together, 298u);
    EXPECT_LE(middle(seen.waited_ms), 5);
    EXPECT_EQ(seen.skew_ms, 0);
}

TEST(SameMoment, CamerasOutOfPhaseWaitForNothingAndTheirSkewIsTheTruth) {
    const Seen seen = watch(milliseconds(15), milliseconds(15), 0);
    EXPECT_LE(middle(seen.waited_ms), 2) << "the time between two pictures that are drawn";
    // 15 ms while both are of one moment, 18.3 ms while the other is of the moment before.
    EXPECT_GE(seen.skew_ms, 15);
    EXPECT_LE(seen.skew_ms, 18.4);
}

TEST(SameMoment, AFrameThatIsLostNowAndThenDelaysItsMomentAlone) {
    const Seen seen = watch(milliseconds(1), Duration(0), 7);
    EXPECT_LE(middle(seen.waited_ms), 5);
    EXPECT_LE(seen.waited_ms.back(), 14);
    EXPECT_GE(seen.together, 300u - 300 / 7 - 2);
}

TEST(SameMoment, ACameraOfHalfTheRateKeepsNobodyWaiting) {
    const Seen seen = watch(milliseconds(1), Duration(0), 2);
    EXPECT_LE(middle(seen.waited_ms), 2);
}

}  // namespace
}  // namespace theatron::viewer
