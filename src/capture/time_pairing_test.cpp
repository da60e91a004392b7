// SPDX-License-Identifier: Apache-2.0
#include "capture/time_pairing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace theatron::capture {
namespace {

// The payload is the time in milliseconds; -1 means no colour.
using Pairing = TimePairing<int>;
using Pairs = std::vector<std::pair<int, int>>;

constexpr int none = -1;

Pairs taken(Pairing& pairing) {
    Pairs pairs;
    while (auto pair = pairing.take())
        pairs.emplace_back(pair->depth.payload, pair->color ? pair->color->payload : none);
    return pairs;
}

void add_depth(Pairing& pairing, int ms) {
    pairing.add_depth({std::chrono::milliseconds(ms), ms});
}
void add_color(Pairing& pairing, int ms) {
    pairing.add_color({std::chrono::milliseconds(ms), ms});
}

Pairs paired(std::initializer_list<int> depth, std::initializer_list<int> color) {
    Pairing pairing(16ms);
    for (const int ms : depth)
        add_depth(pairing, ms);
    for (const int ms : color)
        add_color(pairing, ms);
    pairing.finish();
    return taken(pairing);
}

TEST(TimePairing, TakesTheNearestColorWithinTheTolerance) {
    EXPECT_EQ(paired({0, 33, 66}, {1, 34, 65}), (Pairs{{0, 1}, {33, 34}, {66, 65}}));
    EXPECT_EQ(paired({100}, {86, 97, 105}), (Pairs{{100, 97}}));
    EXPECT_EQ(paired({100}, {116}), (Pairs{{100, 116}}));
    EXPECT_EQ(paired({100}, {117}), (Pairs{{100, none}}));
    EXPECT_EQ(paired({100}, {83}), (Pairs{{100, none}}));
}

TEST(TimePairing, MissingPicturesOfOneTrackDoNotShiftTheOther) {
    EXPECT_EQ(paired({0, 33, 66, 99}, {0, 66, 99}),
              (Pairs{{0, 0}, {33, none}, {66, 66}, {99, 99}}));
    EXPECT_EQ(paired({0, 66}, {0, 33, 66}), (Pairs{{0, 0}, {66, 66}}));
    EXPECT_EQ(paired({0, 33}, {}), (Pairs{{0, none}, {33, none}}));
    EXPECT_EQ(paired({}, {0, 33}), Pairs{});
}

TEST(TimePairing, EveryColorPictureIsUsedOnce) {
    EXPECT_EQ(paired({0, 10}, {5}), (Pairs{{0, 5}, {10, none}}));
}

TEST(TimePairing, WaitsUntilNoNearerColorCanCome) {
    Pairing pairing(16ms);
    add_depth(pairing, 100);
    add_color(pairing, 90);
    EXPECT_EQ(taken(pairing), Pairs{});
    add_color(pairing, 99);
    EXPECT_EQ(taken(pairing), Pairs{});
    add_color(pairing, 130);
    EXPECT_EQ(taken(pairing), (Pairs{{100, 99}}));
}

TEST(TimePairing, DoesNotWaitForEverForATrackThatStopped) {
    Pairing pairing(16ms);
    std::size_t seen = 0;
    for (int n = 0; n < 100; ++n) {
        add_depth(pairing, 33 * n);
        seen += taken(pairing).size();
    }
    EXPECT_EQ(seen, 70u);
    for (int n = 0; n < 1000; ++n)
        add_color(pairing, 10000 + n);
    EXPECT_EQ(taken(pairing).size(), 30u);
    EXPECT_EQ(pairing.left_out().apart, 0u) << "a track that stopped lacks nothing";
}

TEST(TimePairing, CountsColorThatComesTooLongBeforeOrAfterItsDepth) {
    Pairing ahead(16ms);
    for (int n = 0; n < 40; ++n)
        add_color(ahead, 33 * n);
    for (int n = 0; n < 40; ++n)
        add_depth(ahead, 33 * n);
    ahead.finish();
    const Pairs pairs = taken(ahead);
    EXPECT_EQ(std::count_if(pairs.begin(), pairs.end(), [](auto p) { return p.second == none; }),
              10);
    EXPECT_EQ(ahead.left_out().apart, 10u);

    Pairing behind(16ms);
    std::size_t alone = 0;
    for (int n = 0; n < 40; ++n) {
        add_depth(behind, 33 * n);
        alone += taken(behind).size();
    }
    for (int n = 0; n < 40; ++n)
        add_color(behind, 33 * n);
    EXPECT_EQ(alone, 10u);
    EXPECT_EQ(behind.left_out().apart, alone);

    Pairing patient(16ms, 40);
    for (int n = 0; n < 40; ++n)
        add_color(patient, 33 * n);
    for (int n = 0; n < 40; ++n)
        add_depth(patient, 33 * n);
    patient.finish();
    for (const auto& [depth, color] : taken(patient))
        EXPECT_EQ(depth, color);
    EXPECT_EQ(patient.left_out().apart, 0u);
}

TEST(TimePairing, LeavesOutAndCountsPicturesThatGoBackInTime) {
    Pairing pairing(16ms);
    Pairs pairs;
    for (const int ms : {50, 20, 83, 60, 90}) {
        add_depth(pairing, ms);
        add_color(pairing, ms);
        for (const auto& pair : taken(pairing))
            pairs.push_back(pair);
    }
    pairing.finish();
    for (const auto& pair : taken(pairing))
        pairs.push_back(pair);
    EXPECT_EQ(pairs, (Pairs{{50, 50}, {83, 83}, {90, 90}}));
    EXPECT_EQ(pairing.left_out().backward, 4u);
}

TEST(TimePairing, ALiveCamerasPictureDoesNotWaitForTheNextColor) {
    Pairing pairing(16ms, 8ms, 2);
    add_depth(pairing, 33);
    EXPECT_EQ(taken(pairing), Pairs{});
    add_color(pairing, 40);
    EXPECT_EQ(taken(pairing), (Pairs{{33, 40}}));
    add_depth(pairing, 66);
    add_color(pairing, 78);  // the next one could still be nearer
    EXPECT_EQ(taken(pairing), Pairs{});
    add_color(pairing, 111);
    EXPECT_EQ(taken(pairing), (Pairs{{66, 78}}));
}

TEST(TimePairing, ALiveCamerasPictureWaitsForFewOthers) {
    Pairing pairing(16ms, 8ms, 2);
    for (const int ms : {0, 33})
        add_depth(pairing, ms);
    EXPECT_EQ(taken(pairing), Pairs{});
    add_depth(pairing, 66);
    EXPECT_EQ(taken(pairing), (Pairs{{0, none}}));
}

}  // namespace
}  // namespace theatron::capture
