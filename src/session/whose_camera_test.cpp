// SPDX-License-Identifier: Apache-2.0
#include "session/whose_camera.h"

#include <gtest/gtest.h>

#include "session/room_bytes.h"

namespace theatron::session {
namespace {

RoomObject person_called(const std::string& name, ParticipantId id) {
    RoomObject person;
    person.kind = ObjectKind::person;
    person.creator = id;
    PersonFacts facts;
    facts.name = name;
    person.properties = encode_person(facts);
    return person;
}

TEST(WhoseCamera, NamesThePersonWhoSendsIt) {
    const RoomObjects room{{ObjectId{1}, person_called("Anna", ParticipantId{4})},
                           {ObjectId{2}, person_called("Ben", ParticipantId{7})}};
    wire::Camera camera;
    camera.name = "webcam";
    camera.publisher = ParticipantId{7};
    EXPECT_EQ(whose_camera(camera, room), "Ben: webcam");
    camera.publisher = ParticipantId{4};
    EXPECT_EQ(whose_camera(camera, room), "Anna: webcam");
}

TEST(WhoseCamera, OfTheHostHasItsNameAlone) {
    wire::Camera camera;
    camera.name = "lamp";
    EXPECT_EQ(whose_camera(camera, {}), "lamp");
    EXPECT_EQ(whose_camera(camera, {{ObjectId{1}, person_called("Anna", ParticipantId{})}}),
              "lamp");
}

TEST(WhoseCamera, OfAnUnknownPersonIsNotTakenForOneOfTheHost) {
    wire::Camera camera;
    camera.name = "lamp";
    camera.publisher = ParticipantId{7};
    EXPECT_EQ(whose_camera(camera, {}), "#7: lamp");
}

}  // namespace
}  // namespace theatron::session
