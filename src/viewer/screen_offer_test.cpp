// SPDX-License-Identifier: Apache-2.0
#include "viewer/screen_offer.h"

#include <gtest/gtest.h>

#include "session/shared_screen.h"

namespace theatron::viewer {
namespace {

class ScreenOfferTest : public ::testing::Test {
protected:
    static constexpr ParticipantId self{1}, ben{2};
    static constexpr session::ObjectId first{7}, second{9};
    static constexpr TimePoint begin{std::chrono::hours(1)};

    static session::RoomObject screen_of(ParticipantId by, std::string name = "scope") {
        session::RoomObject object;
        object.kind = session::ObjectKind::screen;
        object.creator = by;
        object.scale = 1.2;
        object.properties = session::encode_shared_screen(
            {CameraId{3}, false, {1920, 1080}, "Ben", std::move(name)});
        return object;
    }

    ScreenOffer offer;
};

TEST_F(ScreenOfferTest, AScreenOfAnotherPersonIsOfferedForAWhile) {
    offer.follow({}, self, begin);
    EXPECT_FALSE(offer.is_open(begin));
    const session::RoomObjects objects{{first, screen_of(ben)}};
    offer.follow(objects, self, begin);
    ASSERT_TRUE(offer.is_open(begin));
    RoomPanel panel;
    const window::PanelRow row = offer.row(panel, begin);
    EXPECT_EQ(row.text, "Ben shares a screen: scope");
    ASSERT_EQ(row.buttons.size(), 2u);
    EXPECT_EQ(std::get<ShowScreen>(panel.commands.at(0)).screen, first);
    EXPECT_TRUE(std::holds_alternative<CloseScreenOffer>(panel.commands.at(1)));
    // The same screen again changes nothing.
    offer.follow(objects, self, begin + ScreenOffer::offered_for / 2);
    EXPECT_TRUE(offer.is_open(begin + ScreenOffer::offered_for - 1ms));
    EXPECT_FALSE(offer.is_open(begin + ScreenOffer::offered_for));
}

TEST_F(ScreenOfferTest, OnceClosedItComesBackOnlyForAnotherScreen) {
    offer.follow({{first, screen_of(ben)}}, self, begin);
    offer.close(first);
    offer.follow({{first, screen_of(ben)}}, self, begin);
    EXPECT_FALSE(offer.is_open(begin));
    offer.follow({{first, screen_of(ben)}, {second, screen_of(ben, "monitor")}}, self, begin);
    ASSERT_TRUE(offer.is_open(begin));
    RoomPanel panel;
    EXPECT_EQ(offer.row(panel, begin).text, "Ben shares a screen: monitor");
}

TEST_F(ScreenOfferTest, OfTwoTheNewerIsOfferedAndThenTheOther) {
    offer.follow({{first, screen_of(ben)}, {second, screen_of(ben, "monitor")}}, self, begin);
    RoomPanel panel;
    EXPECT_EQ(offer.row(panel, begin).text, "Ben shares a screen: monitor");
    EXPECT_EQ(std::get<CloseScreenOffer>(panel.commands.at(1)).screen, second);
    offer.close(second);
    ASSERT_TRUE(offer.is_open(begin));
    EXPECT_EQ(offer.row(panel, begin).text, "Ben shares a screen: scope");
    offer.close(first);
    EXPECT_FALSE(offer.is_open(begin));
}

TEST_F(ScreenOfferTest, AScreenThatWasShownElsewhereIsNotOfferedAnyMore) {
    offer.follow({{first, screen_of(ben)}, {second, screen_of(ben, "monitor")}}, self, begin);
    offer.close(first);  // by the panel of people
    RoomPanel panel;
    EXPECT_EQ(offer.row(panel, begin).text, "Ben shares a screen: monitor");
    offer.close(second);
    EXPECT_FALSE(offer.is_open(begin));
}

TEST_F(ScreenOfferTest, AnEndedShareIsNotOfferedAndNeitherAreOnesOwnAndTheHosts) {
    offer.follow({{first, screen_of(ben)}}, self, begin);
    offer.follow({}, self, begin);
    EXPECT_FALSE(offer.is_open(begin));
    offer.follow({{first, screen_of(self)}, {second, screen_of(ParticipantId{})}}, self, begin);
    EXPECT_FALSE(offer.is_open(begin));
}

}  // namespace
}  // namespace theatron::viewer
