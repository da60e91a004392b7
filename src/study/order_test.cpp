// SPDX-License-Identifier: Apache-2.0
#include "study/order.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

namespace theatron::study {
namespace {

TEST(Order, WilliamsDesignsAreBalanced) {
    for (std::size_t n = 2; n <= max_conditions; ++n) {
        const auto rows = williams_design(n);
        ASSERT_EQ(rows.size(), n % 2 ? 2 * n : n);
        std::map<std::pair<std::size_t, std::size_t>, int> places, followers;
        for (const auto& row : rows) {
            EXPECT_EQ(std::set(row.begin(), row.end()).size(), n);
            for (std::size_t i = 0; i < n; ++i) {
                ++places[{i, row[i]}];
                if (i > 0)
                    ++followers[{row[i - 1], row[i]}];
            }
        }
        EXPECT_EQ(places.size(), n * n);
        for (const auto& [place, count] : places)
            EXPECT_EQ(count, int(rows.size() / n)) << n;
        EXPECT_EQ(followers.size(), n * (n - 1));
        for (const auto& [pair, count] : followers)
            EXPECT_EQ(count, n % 2 ? 2 : 1) << n;
    }
}

TEST(Order, EachGroupOfParticipantsHasAllRows) {
    for (const std::size_t conditions : {2u, 3u, 4u}) {
        const int rows = int(williams_design(conditions).size());
        for (int group = 0; group < 3; ++group) {
            std::set<std::vector<std::size_t>> orders;
            for (int i = 1; i <= rows; ++i)
                orders.insert(
                    condition_order(Order::latin_square, conditions, 7, group * rows + i));
            EXPECT_EQ(int(orders.size()), rows);
        }
    }
}

TEST(Order, ASeedGivesTheSameOrdersEverywhere) {
    // Golden: a study goes on with another build and has the orders of the first.
    std::string text;
    for (int i = 1; i <= 8; ++i)
        for (const std::size_t place : condition_order(Order::random, 3, 2022, i))
            text += char('a' + place);
    std::string again;
    for (int i = 1; i <= 8; ++i)
        for (const std::size_t place : condition_order(Order::random, 3, 2023, i))
            again += char('a' + place);
    EXPECT_NE(text, again);
    EXPECT_EQ(text, "bacbacabccabcabcbabcacba");
}

TEST(Order, RandomOrdersAreAllEquallyLikely) {
    std::map<std::vector<std::size_t>, int> counts;
    for (int i = 1; i <= 6000; ++i)
        ++counts[condition_order(Order::random, 3, 5, i)];
    EXPECT_EQ(counts.size(), 6u);
    for (const auto& [order, count] : counts)
        EXPECT_NEAR(count, 1000, 150);
}

TEST(Order, AsWrittenIsAsWritten) {
    EXPECT_EQ(condition_order(Order::as_written, 3, 1, 5), (std::vector<std::size_t>{0, 1, 2}));
    EXPECT_TRUE(condition_order(Order::random, 0, 1, 5).empty());
}

}  // namespace
}  // namespace theatron::study
