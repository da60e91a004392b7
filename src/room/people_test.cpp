// SPDX-License-Identifier: Apache-2.0
#include "room/people.h"

#include <gtest/gtest.h>

#include "render/room_picture.h"
#include "render/test_context.h"

namespace theatron::room {
namespace {

RoomPerson person_at(ParticipantId id, Vec3 place, Vec3 looks_at) {
    RoomPerson person;
    person.id = id;
    person.name = "Anna";
    person.head = look_at(place, looks_at, {0, 1, 0}) * Pose{Quat{0, 1, 0, 0}, {}};
    return person;
}

render::SceneFrame seen(const std::vector<RoomPerson>& people, const render::CameraView& view) {
    static const People avatars;
    render::SceneFrame frame;
    avatars.add_to(frame, people, view);
    return frame;
}

class PeopleTest : public ::testing::Test {
protected:
    PeopleTest() { render::test_context(); }
    const render::CameraView view = render::view_towards({0, 1.6, 1}, {0, 1.6, 0}, 60, {160, 120});
};

TEST_F(PeopleTest, HaveHeadNameAndTheHandsThatAreKnown) {
    RoomPerson person = person_at(ParticipantId{1}, {0, 1.6, 0}, {0, 1.6, 3});
    EXPECT_EQ(seen({person}, view).texts.size(), 1u);
    const std::size_t without_hands = seen({person}, view).objects.size();
    person.right_hand = Pose{{}, {0.3, 1.2, 0}};
    EXPECT_EQ(seen({person}, view).objects.size(), without_hands + 1);
    person.head.reset();
    EXPECT_EQ(seen({person}, view).objects.size(), 1u) << "a hand alone";
    EXPECT_TRUE(seen({person}, view).texts.empty());
}

TEST_F(PeopleTest, ShowTheirFaceWhereTheyLook) {
    const auto white = [&](Vec3 looks_at) {
        const render::SceneFrame frame =
            seen({person_at(ParticipantId{2}, {0, 1.6, 0}, looks_at)}, view);
        render::ScenePasses passes(nullptr);
        render::SceneFrame without_names = frame;
        without_names.texts.clear();
        const auto picture =
            render::draw_and_read(&without_names, {}, {view}, {160, 120}, &passes).color;
        int pixels = 0;
        for (int y = 0; y < 120; ++y)
            for (int x = 0; x < 160; ++x) {
                const Rgb c = picture.view().row(y)[x];
                pixels += c.r > 150 && c.g > 150 && c.b > 150;
            }
        return pixels;
    };
    EXPECT_GT(white({0, 1.6, 3}), 4) << "eyes";
    EXPECT_EQ(white({0, 1.6, -3}), 0) << "the back of a head";
}

TEST_F(PeopleTest, WhoseHeadTheEyeIsInAreNotDrawn) {
    const RoomPerson person =
        person_at(ParticipantId{1}, view.room_from_eye.translation, {0, 1.6, 0});
    EXPECT_TRUE(seen({person}, view).empty());
}

TEST_F(PeopleTest, WithOldPosesAreHalfTransparentAndSaidSo) {
    RoomPerson person = person_at(ParticipantId{1}, {0, 1.6, 0}, {0, 1.6, 3});
    person.is_stale = true;
    const render::SceneFrame frame = seen({person}, view);
    ASSERT_FALSE(frame.objects.empty());
    for (const render::SceneObject& object : frame.objects)
        EXPECT_LT(object.look.opacity, 0.5);
    EXPECT_EQ(frame.texts.at(0).utf8, "Anna (view is old)");
}

TEST_F(PeopleTest, TheirAgeStandsAboveTheName) {
    RoomPerson person = person_at(ParticipantId{1}, {0, 1.6, 0}, {0, 1.6, 3});
    person.age = "85 ms";
    const render::SceneFrame frame = seen({person}, view);
    ASSERT_EQ(frame.texts.size(), 2u);
    EXPECT_EQ(frame.texts[0].utf8, "Anna");
    EXPECT_EQ(frame.texts[1].utf8, "85 ms");
    EXPECT_GT(frame.texts[1].room_from_text.translation.y,
              frame.texts[0].room_from_text.translation.y + frame.texts[0].height_m);
}

TEST(PersonColor, DiffersBetweenNeighbours) {
    for (std::uint32_t i = 0; i < 20; ++i)
        EXPECT_NE(color_of(ParticipantId{i}), color_of(ParticipantId{i + 1}));
}

}  // namespace
}  // namespace theatron::room
