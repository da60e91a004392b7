// SPDX-License-Identifier: Apache-2.0
#include "viewer/room_panel.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

#include "room/moving.h"
#include "session/room_bytes.h"
#include "testing/speaking.h"
#include "wire/clear_objects.h"

namespace theatron::viewer {
namespace {

TEST(RoomPanel, ListsPeopleWithWhatTheyDoAndPlaces) {
    client::Participant::Room room;
    room.self = ParticipantId{1};
    session::RoomObject anna;
    anna.kind = session::ObjectKind::person;
    anna.creator = ParticipantId{2};
    session::PersonFacts facts;
    facts.name = "Anna";
    facts.records = true;
    anna.properties = session::encode_person(facts);
    room.objects[session::ObjectId{1}] = anna;
    session::RoomObject brick;
    brick.kind = session::ObjectKind::brick;
    brick.grip = {ParticipantId{2}, 1};
    room.objects[session::ObjectId{2}] = brick;

    room::RoomPerson person;
    person.id = ParticipantId{2};
    person.name = "Anna";
    person.head = Pose{};
    room::RoomPerson absent;
    absent.id = ParticipantId{3};
    absent.name = "Ben";
    RoomPanelFacts facts_now{room, {person, absent}, {{"Overview", {}}}, ParticipantId{2}, false,
                             {}};
    const RoomPanel panel = room_panel(facts_now);
    ASSERT_EQ(panel.panels.size(), 2u);
    const auto& rows = panel.panels[0].rows;
    ASSERT_EQ(rows.size(), 2u);
    EXPECT_EQ(rows[0].text, "Anna");
    EXPECT_EQ(rows[0].detail, "expert, records, holds an object, you see through their eyes");
    ASSERT_EQ(rows[0].buttons.size(), 2u);
    const auto* look = std::get_if<LookThrough>(&panel.commands.at(rows[0].buttons[1].command));
    ASSERT_TRUE(look);
    EXPECT_EQ(look->person, ParticipantId{2});
    EXPECT_TRUE(rows[1].buttons.empty()) << "nobody knows where Ben is";
    const auto& place = panel.panels[1].rows.at(0).buttons.at(0);
    EXPECT_TRUE(std::holds_alternative<GoToPlace>(panel.commands.at(place.command)));
}

TEST(RoomPanel, HasAButtonForThePersonsOwnFaceWhereThereIsAWebcam) {
    RoomPanelFacts facts;
    const std::size_t without = room_panel(facts).commands.size();
    for (const auto& [state, shows] :
         {std::pair{OwnFace::off, true}, {OwnFace::opening, false}, {OwnFace::seen, false}}) {
        facts.own_face = state;
        const RoomPanel panel = room_panel(facts);
        ASSERT_EQ(panel.commands.size(), without + 1);
        const auto* face = std::get_if<ShowFace>(&panel.commands.back());
        ASSERT_TRUE(face);
        EXPECT_EQ(face->shown, shows);
    }
}

TEST(RoomPanel, OperatorsDecideOnPeople) {
    RoomPanelFacts facts;
    facts.room.self = ParticipantId{1};
    session::RoomObject anna;
    anna.kind = session::ObjectKind::person;
    anna.creator = ParticipantId{2};
    session::PersonFacts person_facts;
    person_facts.role = wire::Role::observer;
    person_facts.name = "Anna";
    anna.properties = session::encode_person(person_facts);
    facts.room.objects[session::ObjectId{1}] = anna;
    room::RoomPerson person;
    person.id = ParticipantId{2};
    person.name = "Anna";
    facts.people = {person};
    wire::Visitor visitor;
    visitor.participant = ParticipantId{7};
    visitor.name = "Ben";
    facts.visitors = {visitor};
    EXPECT_TRUE(room_panel(facts).commands.empty()) << "not an operator";
    facts.is_operator = true;
    const RoomPanel panel = room_panel(facts);
    ASSERT_EQ(panel.panels.size(), 2u);
    // Below: nothing that is clicked moves when somebody knocks.
    const auto& door = panel.panels[1].rows.at(0);
    facts.visitors.clear();
    EXPECT_EQ(room_panel(facts).panels.at(0), panel.panels[0]);
    EXPECT_EQ(door.text, "Ben");
    const auto& admit = std::get<Decide>(panel.commands.at(door.buttons.at(0).command));
    EXPECT_EQ(admit.action, wire::ManageAction::admit);
    EXPECT_EQ(admit.person, ParticipantId{7});
    const auto& buttons = panel.panels[0].rows.at(1).buttons;
    ASSERT_EQ(buttons.size(), 4u);
    const auto& role = std::get<Decide>(panel.commands.at(buttons[1].command));
    EXPECT_EQ(role.action, wire::ManageAction::set_role);
    EXPECT_EQ(role.role, wire::Role::expert);
    const Decide clear{wire::clear_objects, person.id, {}};
    const Decide remove{wire::ManageAction::remove, person.id, {}};
    EXPECT_EQ(std::get<Decide>(panel.commands.at(buttons[2].command)), clear);
    EXPECT_EQ(std::get<Decide>(panel.commands.at(buttons[3].command)), remove);
    const auto labels = [&] {
        const RoomPanel panel = room_panel(facts);
        const auto& buttons = panel.panels[0].rows.at(1).buttons;
        return buttons[2].label + "; " + buttons[3].label;
    };
    EXPECT_EQ(labels(), "Clear; Remove");
    for (std::size_t i = 0; i < language_count; ++i) {
        const testing::Speaking spoken{Language(i)};
        const RoomPanel of_language = room_panel(facts);
        for (const window::Panel& shown : of_language.panels)
            for (const window::PanelRow& row : shown.rows) {
                std::set<std::string> different;
                for (const window::PanelButton& button : row.buttons)
                    EXPECT_TRUE(different.insert(button.label).second) << button.label;
            }
    }
    facts.asked = remove;
    EXPECT_EQ(labels(), "Clear; Really remove " + person.name);
    facts.asked = clear;
    EXPECT_EQ(labels(), "Really clear all by " + person.name + "; Remove");
}

TEST(RoomPanel, OffersToGoToWhoeverCallsAndToCall) {
    EXPECT_TRUE(call_panel({}).panels.empty());
    room::RoomPerson anna, ben;
    anna.id = ParticipantId{2};
    anna.name = "Anna";
    anna.calls = true;
    anna.head = ben.head = Pose{};
    ben.id = ParticipantId{3};
    RoomPanelFacts facts;
    facts.people = {anna, ben};
    EXPECT_EQ(room_panel(facts).commands.size(), 4u) << "an observer calls nobody";
    facts.may_call = true;
    const RoomPanel panel = joined(call_panel({anna}), room_panel(facts));
    ASSERT_EQ(panel.panels.size(), 2u);
    const auto& offer = panel.panels[0].rows.at(0);
    EXPECT_EQ(offer.text, "Anna");
    for (const std::size_t answer : {0, 1}) {
        const auto& answered =
            std::get<AnswerCall>(panel.commands.at(offer.buttons.at(answer).command));
        EXPECT_EQ(answered.person, anna.id);
        EXPECT_EQ(answered.comes, answer == 0);
    }
    const auto& rows = panel.panels[1].rows;
    EXPECT_EQ(rows.at(0).detail, "asks all to come");
    EXPECT_EQ(std::get<GoToPerson>(panel.commands.at(rows.at(1).buttons.at(0).command)).person,
              ben.id);
    EXPECT_TRUE(std::get<Call>(panel.commands.at(rows.at(2).buttons.at(0).command)).begins);
    facts.is_calling = true;
    const RoomPanel calling = room_panel(facts);
    EXPECT_FALSE(std::get<Call>(calling.commands.back()).begins);
}

TEST(RoomPanel, MarksThePersonWhoSpeaks) {
    room::RoomPerson anna, ben;
    anna.id = ParticipantId{2};
    ben.id = ParticipantId{3};
    RoomPanelFacts facts;
    facts.people = {anna, ben};
    facts.speaking = {{anna.id, -25}};
    const RoomPanel panel = room_panel(facts);
    EXPECT_EQ(panel.panels.at(0).rows.at(0).detail, "speaks |||.., not in the room");
    EXPECT_EQ(panel.panels.at(0).rows.at(1).detail, "not in the room");
}

TEST(RoomPanel, SaysThatNobodyIsHere) {
    const RoomPanel panel = room_panel({});
    ASSERT_EQ(panel.panels.size(), 1u);
    EXPECT_EQ(panel.panels[0].rows.at(0).text, "Nobody else is here");
}

TEST(Places, AreAroundThePointThatTheCamerasLookAt) {
    Calibration calibration;
    calibration.depth = pinhole({64, 48}, 60);
    calibration.room_from_camera = look_at({0, 1.8, 2}, {0, 1, 0}, {0, 1, 0});
    calibration.registered = true;
    auto frame = std::make_shared<receive::CameraFrame>();
    frame->depth = DepthImage({64, 48});
    std::fill(frame->depth.pixels.begin(), frame->depth.pixels.end(), std::uint16_t(2150));
    const std::map<CameraId, Calibration> calibrations{{CameraId{0}, calibration}};
    const std::map<CameraId, receive::CameraFramePtr> newest{{CameraId{0}, frame}};
    const std::vector<Place> places = places_of({calibrations, newest});
    ASSERT_EQ(places.size(), 4u);
    for (const Place& place : places) {
        // Every place shows the point in the middle of the picture.
        const Vec3 seen = inverse(place.room_from_eye) * Vec3{0, 1, 0};
        EXPECT_GT(seen.z, 0) << place.name;
        EXPECT_LT(std::hypot(seen.x, seen.y) / seen.z, 0.15) << place.name;
    }
    EXPECT_NEAR(places[0].room_from_eye.translation.y, room::standing_eyes_m, 1e-9);
    const std::map<CameraId, Calibration> no_calibrations;
    const std::map<CameraId, receive::CameraFramePtr> no_frames;
    EXPECT_TRUE(places_of({no_calibrations, no_frames}).empty());
}

TEST(Places, BesideAPersonTheViewIsTheSame) {
    const Pose head = look_at({1, 1.6, 0}, {0, 1.6, 0}, {0, 1, 0}) * Pose{Quat{0, 1, 0, 0}, {}};
    const Pose eye = beside(head);
    EXPECT_LT(length(rotate(eye.rotation, {0, 0, 1}) - Vec3{-1, 0, 0}), 1e-9);
    EXPECT_NEAR(eye.translation.y, 1.6, 1e-9);
    EXPECT_NEAR(length(eye.translation - head.translation), 0.6, 1e-9);
}

}  // namespace
}  // namespace theatron::viewer
