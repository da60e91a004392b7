// SPDX-License-Identifier: Apache-2.0
#include "net/places.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <vector>

namespace theatron::net {
namespace {

constexpr TimePoint start = from_us(1'000'000);

// Handshakes that begin from now on in `duration`, looked at every millisecond.
std::vector<Places::Id> handshakes(Places& places, TimePoint from, Duration duration) {
    std::vector<Places::Id> begun;
    for (TimePoint now = from; now < from + duration; now += 1ms)
        while (const auto id = places.next_handshake(now))
            begun.push_back(*id);
    return begun;
}

TEST(Places, AFloodFromOneAddressDisplacesOnlyItself) {
    Places places;
    const auto quiet = places.enter("10.0.0.1");
    std::vector<Places::Id> flood;
    std::size_t evicted = 0;
    for (int i = 0; i < 10'000; ++i) {
        const auto entered = places.enter("10.0.0.2");
        flood.push_back(entered.id);
        if (entered.evicted) {
            EXPECT_EQ(*entered.evicted, flood[evicted]) << "the oldest of those that flood";
            ++evicted;
        }
        ASSERT_LE(places.pending(), Places::max_pending);
    }
    EXPECT_FALSE(quiet.evicted);
    EXPECT_EQ(evicted, 10'000 - (Places::max_pending - 1));
}

TEST(Places, AmongManyAddressesTheOldestGoes) {
    Places places;
    const auto first = places.enter("10.0.0.0");
    for (std::size_t i = 1; i < Places::max_pending; ++i)
        EXPECT_FALSE(places.enter("10.0.0." + std::to_string(i)).evicted);
    EXPECT_EQ(places.enter("10.0.1.0").evicted, first.id);
}

TEST(Places, StrangersOfAnyNumberTakeNoPlaceFromAKnownAddress) {
    Places places;
    places.note_known("192.168.1.5");
    const auto back = places.enter("192.168.1.5");
    for (int i = 0; i < 2000; ++i) {
        const auto entered = places.enter("10.0." + std::to_string(i % 250) + ".1");
        EXPECT_NE(entered.evicted, back.id);
    }
    for (std::size_t i = 1; i < Places::max_pending; ++i)
        EXPECT_FALSE(places.enter("192.168.1.5").evicted);
    EXPECT_EQ(places.enter("192.168.1.5").evicted, back.id);
    EXPECT_EQ(places.pending(), 2 * Places::max_pending);
}

TEST(Places, TheAddressHeardOfLongestAgoIsForgotten) {
    Places places;
    places.note_known("first");
    places.note_known("second");
    places.note_known("first");
    for (std::size_t i = 2; i <= Places::max_known; ++i)
        places.note_known(std::to_string(i));
    EXPECT_TRUE(places.is_known("first"));
    EXPECT_FALSE(places.is_known("second"));
}

TEST(Places, HandshakesAreLimitedPerAddressAndInTotal) {
    Places places;
    for (std::size_t i = 0; i < Places::max_pending; ++i)
        places.want_handshake(places.enter(i < 200 ? "10.0.0.1" : "10.0.0.2").id);
    const auto first = handshakes(places, start, 100ms);
    // The burst and what the time allows of each.
    EXPECT_NEAR(double(first.size()), 2 * Places::handshakes_per_second_and_address * 0.2, 4);

    Places one;
    for (std::size_t i = 0; i < Places::max_pending; ++i)
        one.want_handshake(one.enter("10.0.0.1").id);
    EXPECT_NEAR(double(handshakes(one, start, 1s).size()),
                Places::handshakes_per_second_and_address * 1.1, 2);
}

TEST(Places, KnownAddressesThenThoseThatHadFewestHandshakesComeFirst) {
    Places places;
    places.note_known("192.168.1.5");
    for (int i = 0; i < 50; ++i)
        places.want_handshake(places.enter("10.0.0.1").id);
    (void)handshakes(places, start, 20ms);
    const auto other = places.enter("10.0.0.2");
    const auto known = places.enter("192.168.1.5");
    places.want_handshake(other.id);
    places.want_handshake(known.id);
    const auto next = handshakes(places, start + 50ms, 1ms);
    ASSERT_GE(next.size(), 2u);
    EXPECT_EQ(next[0], known.id);
    EXPECT_EQ(next[1], other.id);
}

TEST(Places, AnAddressIsWhatOneNetworkHas) {
    EXPECT_EQ(address_group("10.0.0.1"), "10.0.0.1");
    EXPECT_EQ(address_group("::ffff:10.0.0.1"), "10.0.0.1");
    EXPECT_EQ(address_group("2001:db8:1:2:3:4:5:6"), address_group("2001:db8:1:2::9"));
    EXPECT_NE(address_group("2001:db8:1:3::9"), address_group("2001:db8:1:2::9"));
}

TEST(Places, AnAddressThatShowsWrongTokensWaitsForItsNextTry) {
    Places places;
    std::size_t tries = 0;
    std::optional<Places::Id> connection;
    for (TimePoint now = start; now < start + 60s; now += 1ms) {
        if (!connection) {
            connection = places.enter("10.0.0.2").id;
            places.want_handshake(*connection);
        }
        while (const auto id = places.next_handshake(now)) {
            ++tries;
            places.leave(*id);
            connection.reset();
            places.note_wrong_token("10.0.0.2", now);
        }
    }
    EXPECT_LE(tries, 130u);
    EXPECT_GE(tries, 60u);

    // Others do not, nor does an address from which the token came.
    const TimePoint later = start + 60s;
    const auto other = places.enter("10.0.0.3");
    places.want_handshake(other.id);
    EXPECT_EQ(places.next_handshake(later), other.id);
    places.note_known("192.168.1.5");
    for (int i = 0; i < 10; ++i)
        places.note_wrong_token("192.168.1.5", later);
    const auto back = places.enter("192.168.1.5");
    places.want_handshake(back.id);
    EXPECT_EQ(places.next_handshake(later), back.id);
}

TEST(Places, ManyWrongTokensHoldUpAnAddressForTwoSecondsAtMost) {
    Places places;
    for (int i = 0; i < 1000; ++i)
        places.note_wrong_token("10.0.0.2", start);
    const auto honest = places.enter("10.0.0.2");
    places.want_handshake(honest.id);
    EXPECT_TRUE(handshakes(places, start, 1s).empty());
    EXPECT_EQ(handshakes(places, start + 1s, 1s), std::vector{honest.id});
}

TEST(Places, BehindAProxyEachClientHasTheLimitOfItsOwnAddress) {
    Places places;
    // One client floods, and one comes alone, both through the proxy.
    for (std::size_t i = 0; i + 1 < Places::max_pending; ++i) {
        const auto id = places.enter_of_proxy("10.0.0.1").id;
        EXPECT_FALSE(places.act_for(id, "192.0.2.1"));
        places.want_handshake(id);
    }
    const auto alone = places.enter_of_proxy("10.0.0.1").id;
    EXPECT_FALSE(places.act_for(alone, "192.0.2.2"));
    places.want_handshake(alone);
    const auto begun = handshakes(places, start, 100ms);
    EXPECT_LE(begun.size(), 1 + 0.2 * Places::handshakes_per_second_and_address + 1);
    EXPECT_NE(std::find(begun.begin(), begun.begin() + 3, alone), begun.begin() + 3);
    // A further one displaces one of those that flood.
    const auto next = places.enter_of_proxy("10.0.0.1").id;
    const auto evicted = places.act_for(next, "192.0.2.3");
    ASSERT_TRUE(evicted);
    EXPECT_NE(*evicted, alone);
    EXPECT_NE(*evicted, next);
    EXPECT_EQ(places.pending(), Places::max_pending);
}

TEST(Places, TheHandshakesOfAProxyAreNotCountedAgainstItsAddress) {
    Places places;
    for (std::size_t i = 0; i < Places::max_pending; ++i)
        places.want_handshake(places.enter_of_proxy("10.0.0.1").id);
    places.note_wrong_token("10.0.0.1", start);
    EXPECT_GT(handshakes(places, start, 1000ms).size(),
              Places::handshakes_per_second_and_address * 1.5);
}

TEST(Places, AWrongTokenThroughAProxyCostsOnlyTheClient) {
    Places places;
    places.note_wrong_token("192.0.2.1", start);
    const auto guesser = places.enter_of_proxy("10.0.0.1").id;
    const auto other = places.enter_of_proxy("10.0.0.1").id;
    (void)places.act_for(guesser, "192.0.2.1");
    (void)places.act_for(other, "192.0.2.2");
    places.want_handshake(guesser);
    places.want_handshake(other);
    EXPECT_EQ(handshakes(places, start, 100ms), std::vector{other});
}

}  // namespace
}  // namespace theatron::net
