// SPDX-License-Identifier: Apache-2.0
#include "session/delivery.h"

#include <gtest/gtest.h>

namespace theatron::session {
namespace {

// 2 Mbit/s of depth that needs no reference, so that half of the frames can be left out.
std::string reason_with_ceiling_of(std::uint32_t kbit_per_second) {
    Delivery delivery;
    CodecSteps codecs;
    codecs.layered = [](const std::string& codec) { return CodecSteps::Layered{codec, true}; };
    delivery.set_codecs(codecs, false);
    delivery.set_wish("rvl", "");
    wire::ChooseDelivery goal;
    goal.target_latency_ms = 150;
    goal.max_kbit_per_s = kbit_per_second;
    delivery.set_goal(goal);
    const ActiveSetting depth{SettingId(1), "rvl", depth_traits("rvl", codecs)};
    StreamRates rates;
    TimePoint now{std::chrono::seconds(10)};
    for (int frame = 0; frame < 60; ++frame, now += std::chrono::milliseconds(33))
        rates.add(depth.id, layer_by_number(FrameNumber(frame)), 2'000'000 / 8 / 30, now);
    LinkMeasure link;
    link.bytes_per_second = 1e7;
    const Delivery::Given given{&depth, nullptr, "rvl", ""};
    delivery.update(link, {&given, 1}, 30, rates, Duration(0), now);
    return wire::english(delivery.message(Duration(0)).reason);
}

TEST(Delivery, NamesTheCeilingAsItWasGiven) {
    EXPECT_EQ(reason_with_ceiling_of(1500), "your ceiling is 1.5 Mbit/s");
    EXPECT_EQ(reason_with_ceiling_of(1000), "your ceiling is 1 Mbit/s");
}

// A ceiling holds also for those who get no depth.
TEST(Delivery, ColorAloneHasFewerFramesAndIsThenCoarser) {
    CodecSteps codecs;
    codecs.layered = [](const std::string& codec) { return CodecSteps::Layered{codec}; };
    codecs.coarser = [](const std::string& codec) {
        return std::vector{CodecSteps::Coarser{codec + ":quality=20", 0.25}};
    };
    codecs.lossy_outside_region = [](const std::string& codec) { return codec + ":lossy"; };
    const Ladder ladder = make_ladder("none", "jpeg", codecs, true);
    ASSERT_EQ(ladder.size(), 4u);
    EXPECT_EQ(ladder[2].frames, 0.25);
    EXPECT_EQ(ladder[2].color_codec, "jpeg");
    EXPECT_EQ(ladder[3].color_codec, "jpeg:quality=20");
    for (const LadderStep& step : make_ladder("none", "none", codecs, true)) {
        EXPECT_EQ(step.depth_codec, "none");
        EXPECT_EQ(step.color_codec, "none");
    }
}

}  // namespace
}  // namespace theatron::session
