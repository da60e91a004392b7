// SPDX-License-Identifier: Apache-2.0
#include "or_screen/content.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace theatron::or_screen {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using Phase = client::Participant::Phase;

PersonNow person(std::uint32_t id, const std::string& name) {
    PersonNow one;
    one.id = ParticipantId{id};
    one.name = name;
    one.pose_age_ms = 40;
    return one;
}

std::string state_of(const PersonNow& one) {
    return cards_of({one}, 8).at(0).state;
}

std::vector<std::string> names(const std::vector<PersonCard>& cards) {
    std::vector<std::string> result;
    for (const PersonCard& card : cards)
        result.push_back(card.name);
    return result;
}

TEST(Cards, SayWhatAPersonDoes) {
    PersonNow anna = person(1, "Anna");
    EXPECT_EQ(state_of(anna), "listens");
    anna.muted = true;
    EXPECT_EQ(state_of(anna), "muted");
    anna.speaks = true;
    EXPECT_EQ(state_of(anna), "speaks");
    anna.points = true;
    anna.pointed = Sight::visible;
    EXPECT_EQ(state_of(anna), "points");
    EXPECT_TRUE(cards_of({anna}, 8).at(0).speaks);
    anna.points_at_images = true;
    EXPECT_EQ(state_of(anna), "points at images");
}

TEST(Cards, SayWhenAPointerCannotBeSeenInThePicture) {
    PersonNow anna = person(1, "Anna");
    anna.points = true;
    anna.pointed = Sight::hidden;
    EXPECT_EQ(state_of(anna), "points: hidden");
    EXPECT_TRUE(cards_of({anna}, 8).at(0).warns);
    anna.pointed = Sight::outside;
    EXPECT_EQ(state_of(anna), "points elsewhere");
}

TEST(Cards, SayForHowLongNothingCameFromAPerson) {
    PersonNow anna = person(1, "Anna");
    anna.pose_age_ms = 12'000;
    EXPECT_EQ(state_of(anna), "no sign for 12 s");
    EXPECT_TRUE(cards_of({anna}, 8).at(0).warns);
    // A person without a window never has a pose.
    anna.pose_age_ms.reset();
    EXPECT_EQ(state_of(anna), "listens");
}

TEST(Cards, StayInTheirPlacesWhoeverSpeaks) {
    std::vector<PersonNow> people{person(2, "Ben"), person(1, "Anna"), person(3, "Cem")};
    EXPECT_THAT(names(cards_of(people, 8)), ElementsAre("Anna", "Ben", "Cem"));
    people[2].speaks = true;
    EXPECT_THAT(names(cards_of(people, 8)), ElementsAre("Anna", "Ben", "Cem"));
}

TEST(Cards, AreForThoseWhoSpeakOrPointWhereThereIsNoPlaceForAll) {
    std::vector<PersonNow> people{person(1, "Anna"), person(2, "Ben"), person(3, "Cem"),
                                  person(4, "Dana")};
    people[2].speaks = true;
    people[3].points = true;
    EXPECT_THAT(names(cards_of(people, 2)), ElementsAre("Cem", "Dana"));
    EXPECT_THAT(names(cards_of(people, 3)), ElementsAre("Anna", "Cem", "Dana"));
}

TEST(Picture, ItsAgeIsToldAndAnOldOneIsNotTakenForLive) {
    client::CameraFigures camera;
    camera.camera.description.name = "above the table";
    Content live;
    describe_picture(camera, 84.6, live);
    EXPECT_EQ(live.camera, "above the table");
    EXPECT_EQ(live.age, "85 ms");
    EXPECT_FALSE(live.age_warns);
    EXPECT_EQ(live.warning, "");
    Content late;
    describe_picture(camera, 800, late);
    EXPECT_TRUE(late.age_warns);
    EXPECT_EQ(late.warning, "");
    Content frozen;
    describe_picture(camera, 12'300, frozen);
    EXPECT_EQ(frozen.warning, "NOT LIVE: this picture is 12 s old");
    camera.camera.state.condition = wire::CameraCondition::stale;
    Content stale;
    describe_picture(camera, 300, stale);
    EXPECT_THAT(stale.warning, HasSubstr("NOT LIVE"));
}

TEST(Picture, ThatOfARecordingIsNotCalledSoManyMillisecondsOld) {
    const auto described = [](bool live, double age_ms) {
        client::CameraFigures camera;
        camera.camera.state.condition =
            live ? wire::CameraCondition::live : wire::CameraCondition::ended;
        Content content;
        content.playback = "RECORDING 0:12 / 1:02";
        describe_picture(camera, age_ms, content);
        return content;
    };
    EXPECT_EQ(described(true, 131).age, "");
    EXPECT_FALSE(described(true, 800).age_warns);
    EXPECT_EQ(described(true, 131).warning, "");
    EXPECT_EQ(described(true, 12'300).warning, "RECORDING 0:12 / 1:02: no new picture for 12 s");
    EXPECT_EQ(described(false, 300).warning, "RECORDING 0:12 / 1:02: no new picture for 300 ms");
}

TEST(Cards, TellWhoIsPartOfARecording) {
    PersonNow anna = person(1, "Anna"), ben = person(2, "Ben");
    anna.is_recorded = true;
    const auto cards = cards_of({anna, ben}, 8);
    EXPECT_TRUE(cards.at(0).is_recorded);
    EXPECT_FALSE(cards.at(1).is_recorded);
}

TEST(Message, OnlyASessionThatIsJoinedHasNone) {
    client::Participant::Status status;
    status.phase = Phase::joined;
    EXPECT_EQ(message_of(status).text, "");
    for (const Phase phase :
         {Phase::connecting, Phase::waiting, Phase::lost, Phase::refused, Phase::ended}) {
        status.phase = phase;
        EXPECT_NE(message_of(status).text, "");
    }
    status.phase = Phase::lost;
    status.problem = "The host cannot be reached.";
    EXPECT_EQ(message_of(status).text, "The session is not open yet");
    status.joins = 1;
    EXPECT_EQ(message_of(status).text, "No connection to the experts");
    EXPECT_THAT(message_of(status).detail, HasSubstr("cannot be reached"));
}

}  // namespace
}  // namespace theatron::or_screen
