// SPDX-License-Identifier: Apache-2.0
#include "client/participant_figures.h"

#include <gtest/gtest.h>

namespace theatron::client {
namespace {

using Condition = wire::CameraCondition;

Condition condition(double age_now_ms, std::uint64_t frames = 10, bool is_thinned = false,
                    Condition said = Condition::live) {
    receive::StreamFigures depth;
    depth.has_come = frames > 0;
    depth.age_now_ms = age_now_ms;
    return state_here({CameraId{0}, said, {}, ""}, depth, is_thinned).condition;
}

TEST(CameraState, IsStaleHereWhileItsPicturesDoNotArrive) {
    EXPECT_EQ(condition(30), Condition::live);
    EXPECT_EQ(condition(1900), Condition::live);
    EXPECT_EQ(condition(2100), Condition::stale);
    EXPECT_EQ(condition(2100, 10, true), Condition::live) << "few frames are sent";
    EXPECT_EQ(condition(5100, 10, true), Condition::stale);
    EXPECT_EQ(condition(5100, 0), Condition::live) << "none was asked for";
    EXPECT_EQ(condition(5100, 10, false, Condition::ended), Condition::ended);
}

TEST(CameraState, IsStaleHereWhereNoPictureCameSinceTheyWereAskedFor) {
    receive::StreamFigures depth;
    depth.awaited_ms = 1900;
    const wire::CameraState said{CameraId{0}, Condition::live, {}, ""};
    EXPECT_EQ(state_here(said, depth, false).condition, Condition::live);
    depth.awaited_ms = 2100;
    EXPECT_EQ(state_here(said, depth, true).condition, Condition::live) << "few frames are sent";
    const wire::CameraState state = state_here(said, depth, false);
    EXPECT_EQ(state.condition, Condition::stale);
    EXPECT_EQ(wire::english(state.problem), "None of its pictures has arrived yet.");
    depth.past = true;
    EXPECT_EQ(state_here(said, depth, false).condition, Condition::live);
}

TEST(CameraState, SaysWhyItIsStale) {
    receive::StreamFigures depth;
    depth.has_come = true;
    depth.age_now_ms = 9000;
    const wire::CameraState state =
        state_here({CameraId{3}, Condition::live, {}, "median"}, depth, false);
    EXPECT_EQ(state.camera, CameraId{3});
    EXPECT_EQ(state.filter, "median");
    EXPECT_EQ(wire::english(state.problem), "Its pictures do not arrive any more.");
}

TEST(Figures, HaveNoAgesWhileTheSessionsClockIsUnknown) {
    receive::StreamFigures depth;
    depth.frames = 7;
    depth.age_ms = depth.age_now_ms = -8e7;
    depth.age_p50_ms = depth.age_p99_ms = depth.age_max_ms = depth.awaited_ms = 8e7;
    const receive::StreamFigures shown = without_ages({depth}).front();
    EXPECT_EQ(shown.frames, 7u);
    for (const double age : {shown.age_ms, shown.age_now_ms, shown.age_p50_ms, shown.age_p99_ms,
                             shown.age_max_ms, shown.awaited_ms})
        EXPECT_EQ(age, 0);
}

TEST(StreamFigures, CountedAnewTheyKeepOnlyWhatIsKnownOfTheNewestFrame) {
    receive::StreamFigures told;
    told.stream = StreamId(3);
    told.codec = "strata";
    told.frames = 7;
    told.dropped = 2;
    told.age_now_ms = 40;
    told.age_p95_ms = 90;
    told.has_come = true;
    const receive::StreamFigures anew = counted_anew({told}).front();
    EXPECT_EQ(anew.stream, told.stream);
    EXPECT_EQ(anew.codec, "strata");
    EXPECT_TRUE(anew.has_come);
    EXPECT_EQ(anew.age_now_ms, 40);
    EXPECT_EQ(anew.frames, 0u);
    EXPECT_EQ(anew.dropped, 0u);
    EXPECT_EQ(anew.age_p95_ms, 0);
}

TEST(StreamFigures, OnlyFramesThatHaveComeGrowOlder) {
    receive::StreamFigures come, awaited;
    come.has_come = true;
    come.age_now_ms = 10;
    const std::vector<receive::StreamFigures> later =
        aged_by(std::chrono::milliseconds(25), {come, awaited});
    EXPECT_EQ(later[0].age_now_ms, 35);
    EXPECT_EQ(later[1].age_now_ms, 0);
}

}  // namespace
}  // namespace theatron::client
