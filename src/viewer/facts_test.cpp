// SPDX-License-Identifier: Apache-2.0
#include "viewer/facts.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "testing/speaking.h"

namespace theatron::viewer {
namespace {

using ::testing::HasSubstr;
using Phase = client::Participant::Phase;

Facts healthy() {
    Facts facts;
    facts.received.status.phase = Phase::joined;
    facts.received.status.host_name = "OR 3";
    client::CameraFigures camera;
    camera.depth.frames = 100;
    camera.depth.has_come = true;
    camera.depth.frames_per_second = 30;
    camera.depth.codec = "strata";
    camera.depth.exact = receive::Exactness::everywhere;
    facts.received.cameras.push_back(camera);
    facts.has_picture = true;
    facts.age_ms = 40;
    facts.drawn_per_second = 30;
    facts.way.renderer = "mesh";
    return facts;
}

window::OverlayContent overlay(const Facts& facts) {
    return overlay_of(facts, "host:4400", [](const std::string& text) { return text; });
}

window::Fact fact(const window::OverlayContent& content, const std::string& label) {
    const auto found = std::find_if(content.facts.begin(), content.facts.end(),
                                    [&](const window::Fact& f) { return f.label == label; });
    return found == content.facts.end() ? window::Fact{} : *found;
}

TEST(FilterText, HasTheWordsOfThePersonsLanguage) {
    const testing::Speaking french(Language::french);
    EXPECT_EQ(filter_text(""), "aucun");
    EXPECT_EQ(filter_text("default"), "par défaut");
    EXPECT_EQ(filter_text("holes+kalman"), "holes+kalman");
}

TEST(Overlay, SaysNothingAloudWhileAllIsWell) {
    const window::OverlayContent content = overlay(healthy());
    EXPECT_EQ(content.message + content.warning + content.notice, "");
    EXPECT_EQ(fact(content, "Depth").value, "strata");
    EXPECT_FALSE(fact(content, "Depth").warning);
    EXPECT_EQ(fact(content, "Host").value, "OR 3");
}

TEST(Overlay, SaysHowFarApartTheMomentsOfTheCamerasAre) {
    Facts facts = healthy();
    EXPECT_EQ(fact(overlay(facts), "One moment").value, "") << "one camera";
    facts.skew_ms = 1.5;
    EXPECT_EQ(fact(overlay(facts), "One moment").value, "cameras together");
    facts.skew_ms = 15.2;
    facts.received.moments.unpaired = 7;
    EXPECT_EQ(fact(overlay(facts), "One moment").value, "cameras 15 ms apart, 7 pictures alone");
    facts.past = "NOT LIVE: 23 s ago";
    EXPECT_EQ(fact(overlay(facts), "One moment").value, "");
}

TEST(Overlay, IsGermanForAGerman) {
    const testing::Speaking german(Language::german);
    Facts facts = healthy();
    facts.age_ms = 12'000;
    facts.received.status.standing.role = wire::Role::operator_;
    facts.received.cameras[0].camera.state.problem = {wire::TextCode::camera_covered};
    const window::OverlayContent content = overlay(facts);
    EXPECT_EQ(content.cover, "Dieses Bild ist 12 s alt");
    EXPECT_EQ(fact(content, "Gastgeber").value, "OR 3");
    EXPECT_EQ(fact(content, "Sie").value, "Sitzungsleitung");
    EXPECT_EQ(fact(content, "Kameras").value, "1 live");
    EXPECT_THAT(fact(content, "Kamera ").value, HasSubstr("Sie ist verdeckt"));
    EXPECT_EQ(fact(content, "Empfangen").value, "30 Bilder/s");
}

TEST(Overlay, IsFrenchForAFrenchPerson) {
    const testing::Speaking french(Language::french);
    Facts facts = healthy();
    facts.age_ms = 12'000;
    facts.received.status.standing.role = wire::Role::operator_;
    facts.received.cameras[0].camera.description.name = "gauche";
    facts.received.cameras[0].camera.state.problem = {wire::TextCode::camera_covered};
    const window::OverlayContent content = overlay(facts);
    EXPECT_EQ(content.cover, "Cette image date d'il y a 12 s");
    EXPECT_EQ(fact(content, "Hôte").value, "OR 3");
    EXPECT_EQ(fact(content, "Vous").value, "responsable");
    EXPECT_EQ(fact(content, "Caméras").value, "1 en direct");
    EXPECT_THAT(fact(content, "Caméra gauche").value, HasSubstr("Elle est couverte"));
    EXPECT_EQ(fact(content, "Reçu").value, "30 images/s");
    EXPECT_EQ(fact(content, "Couleur").value, "aucun");
    facts.received.cameras[0].camera.state.condition = wire::CameraCondition::stale;
    facts.trust = true;
    EXPECT_THAT(overlay(facts).panels.at(0).rows.at(0).text, HasSubstr("\u00a0: PAS EN DIRECT"));
}

TEST(Overlay, SaysAboveAllThatThePictureIsOfThePast) {
    Facts facts = healthy();
    facts.past = "NOT LIVE: 23 s ago";
    facts.age_ms = 23'000;
    EXPECT_EQ(overlay(facts).warning, "NOT LIVE: 23 s ago. End: live again");
    EXPECT_EQ(fact(overlay(facts), "Cameras").value, "NOT LIVE: 23 s ago");
    EXPECT_TRUE(fact(overlay(facts), "Cameras").warning);
    facts.frozen = true;
    EXPECT_THAT(overlay(facts).warning, HasSubstr("NOT LIVE: 23 s ago, frozen"));
}

TEST(Overlay, CoversAPictureThatStandsStillUnlessItIsMarked) {
    Facts facts = healthy();
    facts.received.cameras[0].depth.age_now_ms = 1900;
    EXPECT_EQ(overlay(facts).cover, "");
    facts.received.cameras[0].depth.age_now_ms = 5100;
    EXPECT_EQ(overlay(facts).cover, "No picture for 5 s");
    EXPECT_EQ(overlay(facts).warning, "") << "which would say it again";
    facts.frozen = true;
    EXPECT_EQ(overlay(facts).cover, "");
    facts.frozen = false;
    facts.past = "NOT LIVE: 23 s ago";
    EXPECT_EQ(overlay(facts).cover, "");
    facts.past = {};
    facts.received.status.phase = Phase::lost;
    EXPECT_EQ(overlay(facts).cover, "") << "the message is there";
    facts.received.status.phase = Phase::joined;
    facts.received.cameras.push_back(healthy().received.cameras[0]);
    EXPECT_EQ(overlay(facts).cover, "") << "another camera is live";
}

TEST(Overlay, ARecordingThatTheHostPlaysIsNeverLive) {
    Facts facts = healthy();
    facts.received.cameras[0].played = client::CameraFigures::Played::goes_on;
    facts.played = "RECORDING 0:02 / 0:03";
    EXPECT_EQ(fact(overlay(facts), "Cameras").value, "1 recording");
    EXPECT_TRUE(fact(overlay(facts), "Cameras").warning);
    EXPECT_EQ(fact(overlay(facts), "Not live").value, "RECORDING 0:02 / 0:03");
    facts.received.cameras[0].played = client::CameraFigures::Played::paused;
    facts.played = "RECORDING 0:02 / 0:03, paused by Anna";
    facts.line = false;
    EXPECT_EQ(fact(overlay(facts), "Cameras").value, "1 paused");
    EXPECT_EQ(fact(overlay(facts), "Not live").value, facts.played) << "also in a hidden line";
    facts.trust = true;
    EXPECT_THAT(overlay(facts).panels.at(0).rows.at(0).text, HasSubstr("NOT LIVE, paused"));
}

TEST(Overlay, ShowsTheMicrophoneOfAWindowThatHasOne) {
    Facts facts = healthy();
    EXPECT_EQ(fact(overlay(facts), "Microphone").value, "");
    facts.voices.microphone = Microphone::open;
    facts.received.status.standing.muted = true;
    EXPECT_EQ(fact(overlay(facts), "Microphone").value, "open, but an operator has muted you");
    EXPECT_TRUE(fact(overlay(facts), "Microphone").warning);
}

TEST(Overlay, SaysVisiblyThatThePersonIsSeen) {
    Facts facts = healthy();
    EXPECT_EQ(fact(overlay(facts), "Webcam").value, "");
    facts.own_face = OwnFace::opening;
    EXPECT_EQ(fact(overlay(facts), "Webcam").value, "is being opened");
    facts.own_face = OwnFace::seen;
    facts.line = false;
    EXPECT_EQ(fact(overlay(facts), "Webcam").value, "you are seen") << "also in a hidden line";
    facts.own_face = OwnFace::off;
    EXPECT_EQ(fact(overlay(facts), "Webcam").value, "");
}

TEST(Overlay, MarksDepthThatIsNotWhatTheCameraMeasured) {
    Facts facts = healthy();
    facts.received.cameras[0].depth.codec = "h264";
    facts.received.cameras[0].depth.exact = receive::Exactness::nowhere;
    EXPECT_EQ(fact(overlay(facts), "Depth").value, "h264 (lossy)");
    EXPECT_TRUE(fact(overlay(facts), "Depth").warning);
}

TEST(Overlay, WarnsOfOneCameraThatIsNotLiveBesideOthers) {
    Facts facts = healthy();
    facts.received.cameras.push_back(facts.received.cameras[0]);
    facts.received.cameras[1].camera.description.name = "right";
    facts.received.cameras[1].camera.state.condition = wire::CameraCondition::stale;
    facts.received.cameras[1].depth.age_now_ms = 7000;
    EXPECT_EQ(overlay(facts).warning, "Camera right is NOT LIVE: 7 s old");
    EXPECT_TRUE(overlay(facts).panels.empty());
    facts.trust = true;
    EXPECT_EQ(overlay(facts).panels.at(0).title, "Cameras");
}

TEST(Overlay, NamesACameraThatWasMovedAlsoWithTheLineHidden) {
    Facts facts = healthy();
    facts.received.cameras[0].camera.description.name = "left";
    facts.received.cameras[0].camera.state.problem = {wire::TextCode::camera_moved,
                                                      {"5.2", "0.10"}};
    facts.line = false;
    EXPECT_EQ(fact(overlay(facts), "Camera left").value,
              "The camera was moved by 5.2 mm and 0.10 degrees");
    EXPECT_TRUE(fact(overlay(facts), "Camera left").warning);
}

TEST(Overlay, SaysNothingOfPicturesWhereThereAreNoCameras) {
    Facts facts = healthy();
    facts.received.status.delivery.level = 3;
    EXPECT_TRUE(fact(overlay(facts), "Sent").warning);
    facts.received.cameras.clear();
    for (const window::Fact& shown : overlay(facts).facts)
        for (const char* label : {"Sent", "Received", "Left out", "Depth", "Colour", "Filter"})
            EXPECT_NE(shown.label, label);
}

TEST(Overlay, BlamesTheComputerThatDrawsTooSlowlyAndNotTheConnection) {
    Facts facts = healthy();
    facts.drawn_per_second = 2;
    EXPECT_THAT(overlay(facts).warning, HasSubstr("draws too slowly; press M"));
    EXPECT_TRUE(fact(overlay(facts), "Drawn").warning);
    facts.renderer_chosen_by = Facts::ChosenBy::program;
    EXPECT_THAT(overlay(facts).warning, HasSubstr("connection is not the cause"));
    facts.received.cameras[0].depth.frames_per_second = 3;  // nothing more comes
    EXPECT_EQ(overlay(facts).warning, "");
}

TEST(Overlay, DoesNotBlameTheComputerForDrawingFewPicturesByChoice) {
    Facts facts = healthy();
    facts.most_drawn_per_second = 5;
    facts.drawn_per_second = 4;
    EXPECT_EQ(overlay(facts).warning, "");
    EXPECT_FALSE(fact(overlay(facts), "Drawn").warning);
    facts.drawn_per_second = 1;
    EXPECT_THAT(overlay(facts).warning, HasSubstr("connection is not the cause"));
}

TEST(Overlay, HidesTheLineOfFactsButNotItsWarnings) {
    Facts facts = healthy();
    facts.line = false;
    EXPECT_TRUE(overlay(facts).facts.empty());
    facts.age_ms = 800;
    ASSERT_EQ(overlay(facts).facts.size(), 1u);
    EXPECT_EQ(overlay(facts).facts[0].label, "Age of picture");
}

TEST(Overlay, WarnsOfAnOldPictureFirst) {
    Facts facts = healthy();
    facts.age_ms = 3500;
    facts.drawn_per_second = 0;
    EXPECT_EQ(overlay(facts).cover, "This picture is 3 s old");
}

TEST(Overlay, NamesEachCondition) {
    Facts facts = healthy();
    client::CameraFigures stale = facts.received.cameras[0];
    stale.camera.state.condition = wire::CameraCondition::stale;
    stale.depth.codec = "rvl";
    facts.received.cameras.push_back(stale);
    EXPECT_EQ(fact(overlay(facts), "Cameras").value, "1 live, 1 stale");
    EXPECT_TRUE(fact(overlay(facts), "Cameras").warning);
    EXPECT_EQ(fact(overlay(facts), "Depth").value, "several");
}

TEST(Overlay, TellsWhyThereIsNoConnection) {
    Facts facts = healthy();
    facts.received.status.phase = Phase::lost;
    facts.received.status.joins = 1;
    facts.received.status.problem = "The host closed the connection.";
    facts.age_ms = 7000;
    const window::OverlayContent content = overlay(facts);
    EXPECT_EQ(content.message, "Connection lost, trying again…");
    EXPECT_EQ(content.detail,
              "This picture is 7 s old. The host closed the connection. The picture comes back by "
              "itself as soon as the host answers.");
    EXPECT_EQ(content.warning, "");
}

TEST(Facts, AnOperatorSeesWhoWaitsAndWithWhichKeysToDecide) {
    Facts facts = healthy();
    EXPECT_EQ(fact(overlay(facts), "You").value, "") << "an expert";
    EXPECT_EQ(fact(overlay(facts), "At the door").value, "");
    facts.received.status.standing = {wire::Role::operator_, false};
    facts.visitors = {{ParticipantId{4}, "Ada", {}, wire::Role::observer},
                      {ParticipantId{5}, "Ben", {}, wire::Role::expert}};
    EXPECT_EQ(fact(overlay(facts), "You").value, "operator");
    const window::Fact door = fact(overlay(facts), "At the door");
    EXPECT_EQ(door.value, "Ada (observer) and 1 more: Y lets in, U refuses");
    EXPECT_TRUE(door.warning) << "shown also where the line is hidden";
    facts.received.status.standing = {wire::Role::expert, true};
    EXPECT_EQ(fact(overlay(facts), "You").value, "expert, muted");
}

TEST(Facts, SomeoneWhoWaitsIsToldSo) {
    Facts facts = healthy();
    facts.received.status.phase = Phase::waiting;
    EXPECT_THAT(overlay(facts).message, HasSubstr("Waiting to be let in"));
    EXPECT_EQ(fact(overlay(facts), "Connection").value, "waiting");
}

TEST(Facts, AFrozenPictureSaysSoAtOnceWithItsAgeAndTheKey) {
    Facts facts = healthy();
    facts.frozen = true;
    EXPECT_EQ(overlay(facts).warning,
              "Frozen by you: this picture is 40 ms old. Space: live again");
    facts.age_ms = 12'300;
    EXPECT_EQ(overlay(facts).warning, "Frozen by you: this picture is 12 s old. Space: live again");
}

TEST(Facts, ThePlaceUnderTheMouseIsTheLastFactAndMovesNoOther) {
    Facts facts = healthy();
    const std::vector<window::Fact> before = overlay(facts).facts;
    facts.pointed = "1.28 m from camera 1";
    std::vector<window::Fact> after = overlay(facts).facts;
    ASSERT_EQ(after.size(), before.size() + 1);
    EXPECT_EQ(after.back().value, facts.pointed);
    after.pop_back();
    EXPECT_EQ(after, before);
}

}  // namespace
}  // namespace theatron::viewer
