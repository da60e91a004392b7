// SPDX-License-Identifier: Apache-2.0
#include "viewer/tour.h"

#include <gtest/gtest.h>

#include "session/permissions.h"

namespace theatron::viewer {
namespace {

TEST(Tour, ComesOnceWithTheFirstPictureAndEndsBehindItsLastStep) {
    Tour tour(true);
    tour.follow(false);
    EXPECT_EQ(tour.step(), 0);
    for (int step = 1; step <= Tour::steps; ++step) {
        tour.follow(true);
        EXPECT_EQ(tour.step(), step);
        EXPECT_FALSE(tour.is_seen());
        tour.next();
    }
    tour.follow(true);
    EXPECT_EQ(tour.step(), 0);
    EXPECT_TRUE(tour.is_seen());
}

TEST(Tour, IsSkipped) {
    Tour tour(true);
    tour.follow(true);
    tour.skip();
    tour.follow(true);
    EXPECT_EQ(tour.step(), 0);
    EXPECT_TRUE(tour.is_seen());
}

TEST(Tour, ComesAgainWhereTheConnectionBrokeItOff) {
    Tour tour(true);
    tour.follow(true);
    tour.next();
    tour.follow(false);
    EXPECT_EQ(tour.step(), 0);
    EXPECT_FALSE(tour.is_seen());
    tour.follow(true);
    EXPECT_EQ(tour.step(), 1);
}

TEST(Tour, IsNotDueForAPersonWhoHasSeenItButCanBeAskedFor) {
    Tour tour(false);
    tour.follow(true);
    EXPECT_EQ(tour.step(), 0);
    tour.begin();
    tour.follow(true);
    EXPECT_EQ(tour.step(), 1);
    tour.follow(false);
    tour.follow(true);
    EXPECT_EQ(tour.step(), 0) << "it does not come back by itself";
}

TEST(Tour, NamesNoButtonThatTheRoleDoesNotHave) {
    for (const wire::Role role : wire::roles) {
        const bool acts =
            session::may(role, session::Right::speak) && session::may(role, session::Right::point);
        EXPECT_EQ(tour_text(2, role), acts ? Phrase::tour_act : Phrase::tour_watch);
        EXPECT_EQ(tour_text(1, role), Phrase::tour_look);
        EXPECT_EQ(tour_text(3, role), Phrase::tour_leave);
    }
}

}  // namespace
}  // namespace theatron::viewer
