// SPDX-License-Identifier: Apache-2.0
#include "session/link_budgets.h"

#include <gtest/gtest.h>

#include "wire/control.h"

namespace theatron::session {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using Answer = LinkBudgets::Answer;

class Budgets : public ::testing::Test {
protected:
    static Bytes joining_person(int number) {
        Bytes id(wire::person_id_size);
        store_le(id.data(), std::uint32_t(number));
        return id;
    }
    // Each is another person. Returns how many come in.
    int newcomers(const std::string& link, int count, Duration apart) {
        int in = 0;
        for (int i = 0; i < count; ++i, now += apart)
            in += budgets.join(link, joining_person(++people), now) == Answer::granted;
        return in;
    }

    LinkBudgets budgets;
    TimePoint now = from_us(1'000'000);
    int people = 1000;
};

TEST_F(Budgets, OneLinkBringsSoManyNewcomersAtOnceAndThenOneASecond) {
    EXPECT_EQ(newcomers("observer", 500, Duration(0)), int(LinkBudgets::newcomers.at_once));
    EXPECT_NEAR(newcomers("observer", 6000, milliseconds(10)), 60, 1);
    EXPECT_EQ(budgets.join("expert", joining_person(1), now), Answer::granted) << "by another link";
}

TEST_F(Budgets, SomebodyWhoWasHereComesBackAlthoughTheLinkIsUsedUp) {
    ASSERT_EQ(budgets.join("observer", joining_person(1), now), Answer::granted);
    now += std::chrono::hours(2);
    budgets.note_here("observer", joining_person(1), now);
    newcomers("observer", 500, Duration(0));
    EXPECT_EQ(budgets.join("observer", joining_person(2), now), Answer::too_often);
    // Its four programs, whose network breaks each five seconds for twenty minutes.
    for (int i = 0; i < 240; ++i, now += seconds(5))
        for (int program = 0; program < 4; ++program)
            EXPECT_EQ(budgets.join("observer", joining_person(1), now), Answer::granted) << i;
    now += LinkBudgets::remembered + seconds(1);
    newcomers("observer", 500, Duration(0));
    EXPECT_EQ(budgets.join("observer", joining_person(1), now), Answer::too_often) << "forgotten";
}

TEST_F(Budgets, OnePersonComesBackOnceASecond) {
    int in = 0;
    for (int i = 0; i < 6000; ++i, now += milliseconds(10))
        in += budgets.join("observer", joining_person(1), now) == Answer::granted;
    EXPECT_NEAR(in, 60 + LinkBudgets::own_returns.at_once + 1, 1);
}

TEST_F(Budgets, ManyPeopleOfALinkComeBackEightTimesASecond) {
    newcomers("observer", 64, Duration(0));
    int in = 0;
    for (int i = 0; i < 60'000; ++i, now += milliseconds(1))
        in += budgets.join("observer", joining_person(1001 + i % 64), now) == Answer::granted;
    EXPECT_LE(in, 60 * LinkBudgets::returns.per_second + LinkBudgets::returns.at_once + 1);
}

TEST_F(Budgets, SomebodyWhoStayedComesBackWhileOthersComeAndGoByTheSameLink) {
    ASSERT_EQ(budgets.join("expert", joining_person(1), now), Answer::granted);
    for (int i = 0; i < 12; ++i, now += seconds(1))
        budgets.note_here("expert", joining_person(1), now);
    newcomers("expert", 64, Duration(0));
    for (int i = 0; i < 60'000; ++i, now += milliseconds(1)) {
        (void)budgets.join("expert", joining_person(1001 + i % 64), now);
        if (i % 5000 == 0) {
            EXPECT_EQ(budgets.join("expert", joining_person(1), now), Answer::granted) << i;
        }
    }
}

// Each is seen once in a short visit.
TEST_F(Budgets, ManyShortVisitsAreNoStay) {
    for (int i = 0; i < 64; ++i, now += milliseconds(10)) {
        ASSERT_EQ(budgets.join("expert", joining_person(2000 + i), now), Answer::granted);
        budgets.note_here("expert", joining_person(2000 + i), now + seconds(1));
    }
    now += seconds(60);
    int in = 0;
    for (int i = 0; i < 60'000; ++i, now += milliseconds(1))
        in += budgets.join("expert", joining_person(2000 + i % 64), now) == Answer::granted;
    EXPECT_LE(in, 60 * LinkBudgets::returns.per_second + LinkBudgets::returns.at_once + 1);
}

TEST_F(Budgets, PeopleWithoutANumberNeverComeBack) {
    int in = 0;
    for (int i = 0; i < 1000; ++i)
        in += budgets.join("observer", {}, now) == Answer::granted;
    EXPECT_EQ(in, int(LinkBudgets::newcomers.at_once));
}

TEST_F(Budgets, OffersSurviveTheConnection) {
    int offered = 0;
    for (int i = 0; i < 1000; ++i)
        offered += budgets.offer("publisher", joining_person(1), 1, now);
    EXPECT_EQ(offered, int(LinkBudgets::own_offers.at_once));
    now += seconds(4);
    EXPECT_TRUE(budgets.offer("publisher", joining_person(1), 8, now));
    EXPECT_FALSE(budgets.offer("publisher", joining_person(1), 1, now));
    // Ever new people of one link have its own limit.
    int of_all = 0;
    for (int i = 0; i < 1000; ++i)
        of_all += budgets.offer("expert", joining_person(2000 + i), 1, now);
    EXPECT_EQ(of_all, int(LinkBudgets::offers.at_once));
    EXPECT_TRUE(budgets.offer("other", joining_person(1), 8, now)) << "by another link";
}

TEST_F(Budgets, AfterAFloodItsPersonIsKeptOutForSomeSecondsAndTheLinkHasFewerNewcomers) {
    ASSERT_EQ(budgets.join("observer", joining_person(1), now), Answer::granted);
    ASSERT_EQ(budgets.join("observer", joining_person(2), now), Answer::granted);
    budgets.note_flood("observer", joining_person(1), now);
    EXPECT_EQ(budgets.join("observer", joining_person(1), now), Answer::after_flood);
    EXPECT_EQ(budgets.join("observer", joining_person(2), now), Answer::granted)
        << "others come back";
    EXPECT_EQ(newcomers("observer", 100, Duration(0)),
              int(LinkBudgets::newcomers.at_once - 2 - LinkBudgets::flood_cost));
    now += LinkBudgets::flood_pause;
    EXPECT_EQ(budgets.join("observer", joining_person(1), now), Answer::granted);
}

// Each connection is that of another person, and ends as a flood.
TEST_F(Budgets, FloodsOfALinkBecomeFew) {
    int floods = 0;
    const TimePoint end = now + seconds(120);
    for (; now < end; now += milliseconds(20))
        if (const Bytes id = joining_person(++people);
            budgets.join("observer", id, now) == Answer::granted) {
            ++floods;
            budgets.note_flood("observer", id, now);
        }
    EXPECT_LE(floods, 64 / 11 + 120 / 11 + 2);
}

TEST_F(Budgets, OfManyPeopleThoseAreForgottenWhoWereHereLongestAgo) {
    ASSERT_EQ(budgets.join("observer", joining_person(1), now), Answer::granted);
    for (int i = 0; i < int(LinkBudgets::max_people); ++i) {
        now += seconds(1);
        budgets.note_here("observer", joining_person(1), now);
        (void)budgets.join("observer", joining_person(5000 + i), now);
    }
    newcomers("observer", 100, Duration(0));
    EXPECT_EQ(budgets.join("observer", joining_person(1), now), Answer::granted);
    EXPECT_EQ(budgets.join("observer", joining_person(5000), now), Answer::too_often);
}

}  // namespace
}  // namespace theatron::session
