// SPDX-License-Identifier: Apache-2.0
#include "viewer/meeting.h"

#include <gtest/gtest.h>

#include "face/emotion.h"
#include "session/room_bytes.h"

namespace theatron::viewer {
namespace {

constexpr ParticipantId self{1}, anna{2}, ben{3};

client::Participant::Room room_of(const std::vector<ParticipantId>& people) {
    client::Participant::Room room;
    room.self = self;
    for (const ParticipantId id : people) {
        session::RoomObject person;
        person.kind = session::ObjectKind::person;
        person.creator = id;
        person.properties = session::encode_person({{}, false, "person"});
        room.objects[session::ObjectId(10 + std::uint32_t(id))] = person;
    }
    return room;
}

TEST(Meeting, IsOfTheOthersWithTheirPoses) {
    wire::PersonPose pose;
    pose.time = TimePoint(10s);
    pose.head = wire::PartPose{{1, 2, 3}, {1, 0, 0, 0}};
    const auto people = people_of(room_of({self, anna, ben}), {{anna, pose}}, TimePoint(11s));
    ASSERT_EQ(people.size(), 2u);
    EXPECT_EQ(people[0].id, anna);
    EXPECT_EQ(people[0].name, "person");
    EXPECT_EQ(people[0].head->translation, (Vec3{1, 2, 3}));
    EXPECT_FALSE(people[0].is_stale);
    EXPECT_FALSE(people[1].head) << "it is in, but nobody knows where";
    EXPECT_TRUE(people_of(room_of({anna}), {{anna, pose}}, TimePoint(13s))[0].is_stale);
}

TEST(Meeting, AFaceIsTheBlendOfEmotionsUnlessItsOwnerSentAllChannels) {
    wire::FaceExpression face;
    face.state = wire::FaceExpression::State::tracked;
    face.emotions[std::size_t(face::Emotion::happiness)] = 1;
    face.jaw_open = 0.5F;
    face::Channels blended = channels_of(face);
    EXPECT_GT(blended[face::mouth_smile_left], 0.8F);
    EXPECT_EQ(blended[face::jaw_open], 0.5F);
    face.channels.emplace()[face::tongue_out] = 1;
    blended = channels_of(face);
    EXPECT_EQ(blended[face::mouth_smile_left], 0);
    EXPECT_EQ(blended[face::tongue_out], 1);
}

TEST(Meeting, AnEyeIsAHeadThatLooksTheSameWay) {
    const Pose eye = look_at({0, 1.6, 2}, {0, 1, 0}, {0, 1, 0});
    const wire::PersonPose pose = pose_of_eye(eye, TimePoint(1s));
    const auto people = people_of(room_of({anna}), {{anna, pose}}, TimePoint(1s));
    const Pose& head = *people.at(0).head;
    EXPECT_LT(length(rotate(head.rotation, {0, 0, -1}) - rotate(eye.rotation, {0, 0, 1})), 1e-6);
    EXPECT_GT(rotate(head.rotation, {0, 1, 0}).y, 0.9) << "upright";
}

}  // namespace
}  // namespace theatron::viewer
