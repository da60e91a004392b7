// SPDX-License-Identifier: Apache-2.0
#include "viewer/removal_question.h"

#include <gtest/gtest.h>

#include "wire/clear_objects.h"

namespace theatron::viewer {
namespace {

using namespace std::chrono_literals;
using wire::ManageAction;

constexpr ParticipantId somebody{1}, ben{2};
constexpr TimePoint first_press(100s);

TEST(RemovalQuestion, OnlyTheSecondPressOfTheSameButtonInTimeRemoves) {
    for (const ManageAction action : {ManageAction::remove, wire::clear_objects}) {
        const Decide of_anna{action, somebody, {}}, of_ben{action, ben, {}};
        RemovalQuestion question;
        EXPECT_EQ(question.asked(first_press), std::nullopt);
        EXPECT_FALSE(question.is_meant(of_anna, first_press));
        EXPECT_EQ(question.asked(first_press + 4s), of_anna);
        EXPECT_FALSE(question.is_meant(of_ben, first_press + 1s));
        EXPECT_FALSE(question.is_meant(of_anna, first_press + 2s));
        EXPECT_TRUE(question.is_meant(of_anna, first_press + 3s));
        EXPECT_EQ(question.asked(first_press + 3s), std::nullopt) << "each removal is asked about";
        EXPECT_FALSE(question.is_meant(of_anna, first_press + 4s));
        EXPECT_FALSE(question.is_meant(of_anna, first_press + 9s)) << "too late";
    }
}

TEST(RemovalQuestion, ClearingIsNotConfirmedByRemoving) {
    RemovalQuestion question;
    EXPECT_FALSE(question.is_meant({wire::clear_objects, somebody, {}}, first_press));
    EXPECT_FALSE(question.is_meant({ManageAction::remove, somebody, {}}, first_press + 1s));
}

TEST(RemovalQuestion, OtherDecisionsAreCarriedOutAtOnce) {
    RemovalQuestion question;
    EXPECT_TRUE(question.is_meant({ManageAction::mute, somebody, {}}, first_press));
    EXPECT_EQ(question.asked(first_press), std::nullopt);
}

}  // namespace
}  // namespace theatron::viewer
