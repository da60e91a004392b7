// SPDX-License-Identifier: Apache-2.0
#include "viewer/removal_question.h"

#include <gtest/gtest.h>

namespace theatron::viewer {
namespace {

using namespace std::chrono_literals;
using wire::ManageAction;

constexpr ParticipantId anna{1}, ben{2};
constexpr TimePoint begin(100s);

TEST(RemovalQuestion, OnlyTheSecondPressOfTheSamePersonInTimeRemoves) {
    RemovalQuestion question;
    EXPECT_EQ(question.asked(begin), std::nullopt);
    EXPECT_FALSE(question.is_meant({ManageAction::remove, anna, {}}, begin));
    EXPECT_EQ(question.asked(begin + 4s), anna);
    EXPECT_FALSE(question.is_meant({ManageAction::remove, ben, {}}, begin + 1s));
    EXPECT_FALSE(question.is_meant({ManageAction::remove, anna, {}}, begin + 2s));
    EXPECT_TRUE(question.is_meant({ManageAction::remove, anna, {}}, begin + 3s));
    EXPECT_EQ(question.asked(begin + 7s), std::nullopt);
    EXPECT_FALSE(question.is_meant({ManageAction::remove, anna, {}}, begin + 7s));
}

TEST(RemovalQuestion, OtherDecisionsAreCarriedOutAtOnce) {
    RemovalQuestion question;
    EXPECT_TRUE(question.is_meant({ManageAction::mute, anna, {}}, begin));
    EXPECT_EQ(question.asked(begin), std::nullopt);
}

}  // namespace
}  // namespace theatron::viewer
