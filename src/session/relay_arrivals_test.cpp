// SPDX-License-Identifier: Apache-2.0
#include "session/relay_arrivals.h"

#include <gtest/gtest.h>

#include "session/key_gate.h"

namespace theatron::session {
namespace {

using namespace std::chrono_literals;

constexpr StreamId arriving{4};
constexpr Duration arrival_period = 33ms;

class RelayArrivalsTest : public ::testing::Test {
protected:
    bool come(FrameNumber frame, Way way, SettingId setting = SettingId{1}) {
        wire::MediaHeader header;
        header.stream = arriving;
        header.setting = setting;
        header.frame = frame;
        return arrivals.take(header, way, now);
    }
    SettingId relayed() { return arrivals.relayed_setting(arriving, arrival_period, now); }

    TimePoint now = from_us(5'000'000);
    RelayArrivals arrivals;
};

TEST_F(RelayArrivalsTest, EachFrameIsTakenOnceWhicheverWayIsFaster) {
    EXPECT_TRUE(come(10, Way::by_host));
    EXPECT_FALSE(arrivals.is_used()) << "nothing is kept of streams that do not come directly";
    EXPECT_TRUE(come(11, Way::by_relay));
    EXPECT_TRUE(arrivals.is_used());
    EXPECT_FALSE(come(11, Way::by_host));
    EXPECT_TRUE(come(12, Way::by_host));
    EXPECT_FALSE(come(12, Way::by_relay));
    EXPECT_TRUE(come(14, Way::by_relay));
    EXPECT_FALSE(come(13, Way::by_host)) << "a newer one has been taken";
    EXPECT_TRUE(come(15, Way::by_host));
}

TEST_F(RelayArrivalsTest, FrameNumbersWrap) {
    EXPECT_TRUE(come(0xffffffff, Way::by_relay));
    EXPECT_TRUE(come(0, Way::by_host));
    EXPECT_FALSE(come(0xffffffff, Way::by_host));
}

TEST_F(RelayArrivalsTest, AnEncoderThatCountsAnewIsFollowed) {
    EXPECT_TRUE(come(1000, Way::by_relay));
    EXPECT_FALSE(come(3, Way::by_relay));
    now += RelayArrivals::memory + 1ms;
    EXPECT_TRUE(come(4, Way::by_relay));
    EXPECT_TRUE(come(2, Way::by_relay, SettingId{2})) << "another setting has another encoder";
}

TEST_F(RelayArrivalsTest, AStreamIsByRelayAsLongAsItsFramesCome) {
    EXPECT_EQ(relayed(), SettingId{});
    come(1, Way::by_relay);
    EXPECT_EQ(relayed(), SettingId{1});
    now += RelayArrivals::patience;
    come(2, Way::by_host);
    EXPECT_EQ(relayed(), SettingId{1});
    now += 1ms;
    EXPECT_EQ(relayed(), SettingId{});
    EXPECT_EQ(arrivals.relayed_setting(arriving, 1s, now), SettingId{1}) << "of a slow camera";
    come(3, Way::by_relay, SettingId{2});
    EXPECT_EQ(relayed(), SettingId{2});
    arrivals.end(arriving);
    EXPECT_EQ(relayed(), SettingId{});
    arrivals.end(StreamId{99});
}

TEST(KeyGate, ChainsPassFromAKeyFrameOn) {
    wire::MediaHeader key, delta, other;
    key.setting = delta.setting = SettingId{1};
    key.key = true;
    other.setting = SettingId{2};
    other.key = true;
    KeyGate gate;
    EXPECT_FALSE(gate.passes(delta));
    EXPECT_TRUE(gate.passes(key));
    EXPECT_TRUE(gate.passes(delta));
    gate.hold({SettingId{1}});
    EXPECT_TRUE(gate.is_held(SettingId{1}));
    EXPECT_FALSE(gate.passes(key));
    EXPECT_TRUE(gate.passes(other));
    gate.hold({});
    EXPECT_FALSE(gate.passes(delta));
    EXPECT_TRUE(gate.passes(key));
    gate.interrupt(SettingId{1});
    EXPECT_FALSE(gate.passes(delta));
    EXPECT_TRUE(gate.passes(other));
}

}  // namespace
}  // namespace theatron::session
