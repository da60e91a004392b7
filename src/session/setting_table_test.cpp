// SPDX-License-Identifier: Apache-2.0
#include "session/setting_table.h"

#include <gtest/gtest.h>

#include <set>

#include "session/key_requests.h"

namespace theatron::session {
namespace {

constexpr ParticipantId alice{1}, bob{2}, carol{3}, dave{4};

TEST(SettingTable, OneSettingPerDistinctWish) {
    SettingNumbers numbers;
    SettingTable table(numbers);
    table.wish(alice, "trvl");
    table.wish(bob, "trvl");
    EXPECT_EQ(table.active().size(), 1u);
    EXPECT_EQ(table.given(alice), table.given(bob));
    table.wish(bob, "rvl");
    EXPECT_EQ(table.active().size(), 2u);
    EXPECT_EQ(table.given(bob).codec, "rvl");
}

TEST(SettingTable, NothingIsNotEncodedAndTakesNoPlace) {
    SettingNumbers numbers;
    SettingTable table(numbers, "strata");
    table.wish(alice, "none");
    EXPECT_TRUE(table.active().empty());
    EXPECT_EQ(table.given(alice).codec, "none");
    table.wish(bob, "trvl");
    table.wish(carol, "zstd");
    table.wish(dave, "raw");
    EXPECT_EQ(table.active().size(), SettingTable::max_active);
    for (const ActiveSetting& setting : table.active())
        EXPECT_NE(setting.id, table.given(alice).id);
    // Nor does anybody get it in place of another.
    table.wish(ParticipantId{5}, "lz4");
    EXPECT_EQ(table.given(ParticipantId{5}).codec, "strata");
    table.wish(alice, "trvl");
    EXPECT_EQ(table.given(alice), table.given(bob));
}

TEST(SettingTable, BeyondThreeTheNearestIsGivenUntilAPlaceIsFree) {
    SettingNumbers numbers;
    SettingTable table(numbers);
    table.wish(alice, "trvl");
    table.wish(bob, "zstd");
    table.wish(carol, "raw");
    table.wish(dave, "zstd:delta=1");
    EXPECT_EQ(table.active().size(), SettingTable::max_active);
    EXPECT_EQ(table.given(dave).codec, "zstd");
    table.wish(dave, "lz4");
    EXPECT_EQ(table.given(dave).codec, "trvl");
    table.leave(carol);
    EXPECT_EQ(table.given(dave).codec, "lz4");
}

TEST(SettingTable, NobodyTakesThePlaceOfTheUsualSetting) {
    SettingNumbers numbers;
    SettingTable table(numbers, "strata");
    table.wish(alice, "zstd:level=19");
    table.wish(bob, "ans");
    table.wish(carol, "raw");
    EXPECT_EQ(table.active().size(), SettingTable::max_active) << "nobody gets the usual one yet";
    table.wish(dave, "strata");
    EXPECT_EQ(table.given(dave).codec, "strata");
    EXPECT_EQ(table.active().size(), SettingTable::max_active + 1);
    table.wish(dave, "lz4");
    EXPECT_EQ(table.given(dave).codec, "strata") << "nothing is nearer";
    table.wish(dave, "zstd:level=1");
    EXPECT_EQ(table.given(dave).codec, "zstd:level=19") << "the same codec is nearer";
    table.set_slow(table.given(alice).id, true);
    EXPECT_EQ(table.given(dave).codec, "strata") << "but not if it is slow";
    EXPECT_EQ(table.given(alice).codec, "zstd:level=19") << "who wants it gets it";
    table.leave(dave);
    EXPECT_EQ(table.active().size(), SettingTable::max_active);
}

// Numbers are 16 bits wide in the media header and in recordings.
TEST(SettingTable, NumbersInUseAreGivenToNothingElseHoweverManyThereWere) {
    SettingNumbers numbers;
    SettingTable depth(numbers, "strata"), color(numbers, "jpeg");
    depth.wish(alice, "strata");
    color.wish(alice, "jpeg");
    const ActiveSetting usual_depth = depth.given(alice), usual_color = color.given(alice);
    SettingId before{};
    for (int i = 0; i < 200'000; ++i) {
        depth.wish(bob, i % 2 ? "rvl" : "lz4");
        if (i % 3 == 0)
            color.wish(bob, i % 2 ? "raw" : "h264");
        const std::set<SettingId> given{depth.given(alice).id, color.given(alice).id,
                                        depth.given(bob).id, color.given(bob).id};
        ASSERT_EQ(given.size(), 4u) << i;
        ASSERT_FALSE(given.contains(SettingId{0})) << i;
        ASSERT_NE(depth.given(bob).id, before) << i;
        before = depth.given(bob).id;
    }
    EXPECT_EQ(depth.given(alice), usual_depth);
    EXPECT_EQ(color.given(alice), usual_color);
}

TEST(SettingNumbers, ANumberComesAgainOnlyAfterAllOthers) {
    SettingNumbers numbers;
    const SettingId first = numbers.take();
    numbers.give_back(first);
    std::size_t others = 0;
    for (SettingId next = numbers.take(); next != first; next = numbers.take(), ++others)
        numbers.give_back(next);
    EXPECT_EQ(others, SettingNumbers::how_many - 1);
}

TEST(KeyRequests, AreCoalescedAndNeverLost) {
    KeyRequests requests;
    const KeyRequests::Key key{StreamId{2}, SettingId{1}};
    requests.request(key);
    requests.request(key);
    EXPECT_EQ(requests.take(from_us(0)).size(), 1u);
    requests.request(key);
    EXPECT_TRUE(requests.take(from_us(499'999)).empty());
    EXPECT_EQ(requests.take(from_us(500'000)).size(), 1u);
    EXPECT_TRUE(requests.take(from_us(9'000'000)).empty());
}

}  // namespace
}  // namespace theatron::session
