// SPDX-License-Identifier: Apache-2.0
#include "room/people.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "face/expression.h"
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
    static People avatars;
    render::SceneFrame frame;
    avatars.add_to(frame, people, view);
    return frame;
}

class PeopleTest : public ::testing::Test {
protected:
    PeopleTest() { render::test_context(); }
    std::vector<std::string> texts_of(const RoomPerson& person) const {
        std::vector<std::string> texts;
        for (const render::SceneText& text : seen({person}, view).texts)
            texts.push_back(text.utf8);
        return texts;
    }
    const render::CameraView view = render::view_towards({0, 1.6, 1}, {0, 1.6, 0}, 60, {160, 120});
};

TEST_F(PeopleTest, AnExpressionPutsAFaceOnTheBust) {
    RoomPerson person = person_at(ParticipantId{1}, {0, 1.6, 0}, {0, 1.6, 3});
    person.has_headset = true;
    const std::size_t without_face = seen({person}, view).objects.size();
    person.expression = face::channels_of(face::Emotion::happiness);
    // Back of the head, five parts of the face, in place of head, mask and eyes.
    EXPECT_EQ(seen({person}, view).objects.size(), without_face + 3);
    person.has_headset = false;
    EXPECT_EQ(seen({person}, view).objects.size(), without_face + 3) << "no plate";
    person.expression.reset();
    EXPECT_EQ(texts_of(person), (std::vector<std::string>{"A", "Anna"})) << "the plate is back";
}

TEST_F(PeopleTest, HaveHeadNameAndTheHandsThatAreKnown) {
    RoomPerson person = person_at(ParticipantId{1}, {0, 1.6, 0}, {0, 1.6, 3});
    EXPECT_EQ(texts_of(person), (std::vector<std::string>{"A", "Anna"}));
    const std::size_t without_hands = seen({person}, view).objects.size();
    person.right_hand = Pose{{}, {0.3, 1.2, 0}};
    EXPECT_EQ(seen({person}, view).objects.size(), without_hands + 2) << "glove and cuff";
    person.head.reset();
    EXPECT_EQ(seen({person}, view).objects.size(), 2u) << "a hand alone";
    EXPECT_TRUE(seen({person}, view).texts.empty());
}

TEST_F(PeopleTest, WithAHeadsetAreABustInPlaceOfThePlate) {
    RoomPerson person = person_at(ParticipantId{1}, {0, 1.6, 0}, {0, 1.6, 3});
    person.has_headset = true;
    EXPECT_EQ(texts_of(person), std::vector<std::string>{"Anna"}) << "no initials";
}

TEST(Initials, AreOfTheFirstAndTheLastWordWithoutTitles) {
    EXPECT_EQ(initials_of("Anna"), "A");
    EXPECT_EQ(initials_of("remote expert"), "RE");
    EXPECT_EQ(initials_of("Prof. Dr. med. Eva  Maria Lang"), "EL");
    EXPECT_EQ(initials_of("\u00d6zlem \u0160imi\u0107"), "\u00d6\u0160");
    EXPECT_EQ(initials_of("Anna (recorded)"), "A");
    EXPECT_EQ(initials_of("Dr."), "D");
    EXPECT_EQ(initials_of(" "), " ");
    EXPECT_EQ(initials_of(""), "");
}

// Pixels of the picture that fulfil `is`, without texts.
template <class Is>
int pixels_of(const RoomPerson& person, const render::CameraView& view, Is is) {
    render::SceneFrame frame = seen({person}, view);
    frame.texts.clear();
    render::ScenePasses passes(nullptr);
    const auto picture = render::draw_and_read(&frame, {}, {view}, {160, 120}, &passes).color;
    return int(std::count_if(picture.pixels.begin(), picture.pixels.end(), is));
}

TEST_F(PeopleTest, ABustShowsItsMaskWhereItLooks) {
    const auto masks = [&](Vec3 looks_at) {
        RoomPerson person = person_at(ParticipantId{2}, {0, 1.6, 0}, looks_at);
        person.has_headset = true;
        return pixels_of(person, view, [](Rgb c) { return c.r > 130 && c.g > 150 && c.b > 160; });
    };
    EXPECT_GT(masks({0, 1.6, 3}), 10) << "before";
    EXPECT_EQ(masks({0, 1.6, -3}), 0) << "behind";
}

TEST_F(PeopleTest, ABodyStaysUprightUnderAHeadThatLooksDown) {
    RoomPerson person = person_at(ParticipantId{2}, {0, 1.6, 0}, {0, 0.5, 0.5});
    person.has_headset = true;
    for (const render::SceneObject& object : seen({person}, view).objects) {
        const Vec3 up = rotate(object.room_from_object.rotation, {0, 1, 0});
        if (object.room_from_object.rotation != person.head->rotation) {
            EXPECT_NEAR(up.y, 1, 1e-9);
            EXPECT_LT(length(object.room_from_object * neck_pivot - *person.head * neck_pivot),
                      1e-9);
        }
    }
    // Straight down there is no direction ahead; the crown tells it.
    person.head->rotation = rotation_about({1, 0, 0}, -std::numbers::pi / 2);
    const auto objects = seen({person}, view).objects;
    EXPECT_NEAR(rotate(objects.back().room_from_object.rotation, {0, 0, -1}).z, -1, 1e-9);
}

TEST_F(PeopleTest, APlateFacesTheEyeAndItsConeTellsWhereThePersonLooks) {
    // To the left of the one who sees it, and away.
    for (const Vec3 looks_at : {Vec3{-3, 1.6, 0}, Vec3{0, 1.6, -3}}) {
        const RoomPerson person = person_at(ParticipantId{2}, {0, 1.6, 0}, looks_at);
        const render::SceneFrame frame = seen({person}, view);
        const Vec3 to_eye = rotate(frame.objects.at(0).room_from_object.rotation, {0, 0, -1});
        EXPECT_NEAR(to_eye.z, 1, 1e-9);
        const Vec3 ahead = rotate(frame.objects.back().room_from_object.rotation, {0, 0, -1});
        EXPECT_LT(length(ahead - normalized(looks_at - Vec3{0, 1.6, 0})), 1e-9);
    }
}

// Red on the reader's left, blue on the right.
render::SceneTexture two_colors() {
    ColorImage image({64, 48});
    for (std::size_t i = 0; i < image.pixels.size(); ++i)
        image.pixels[i] = i % 64 < 32 ? Rgb{220, 60, 40} : Rgb{40, 90, 220};
    render::SceneTexture texture(image.size);
    texture.set(image.view());
    return texture;
}

ColorImage drawn(const RoomPerson& person, const render::CameraView& view) {
    render::SceneFrame frame = seen({person}, view);
    frame.texts.clear();
    render::ScenePasses passes(nullptr);
    return render::draw_and_read(&frame, {}, {view}, {160, 120}, &passes).color;
}

bool is_red(Rgb c) {
    return c.r > 180 && c.g < 100 && c.b < 100;
}
bool is_blue(Rgb c) {
    return c.r < 100 && c.g < 130 && c.b > 180;
}

TEST_F(PeopleTest, ThePictureOfAFaceIsUprightAndNotMirroredOnTheHead) {
    const render::SceneTexture texture = two_colors();
    RoomPerson person = person_at(ParticipantId{2}, {0, 1.6, 0}, {0, 1.6, 3});
    person.face = FacePicture{&texture, 1, ""};
    const ColorImage picture = drawn(person, view);
    const auto at = [&](int x, int y) { return picture.view().row(y)[x]; };
    EXPECT_TRUE(is_red(at(72, 60)));
    EXPECT_TRUE(is_blue(at(88, 60)));
    EXPECT_FALSE(is_red(at(30, 60)) || is_blue(at(30, 60))) << "beside the picture";
    int reds = 0;
    for (const Rgb& pixel : picture.pixels)
        reds += is_red(pixel);
    // Half of 0.28 m x 0.21 m, 0.86 m away, at 104 pixels a metre in a distance of one metre.
    EXPECT_NEAR(reds, 0.5 * 0.28 * 0.21 * 121 * 121, 60);
}

TEST_F(PeopleTest, APictureThatFadesShowsThePlateAndSaysHowOldItIs) {
    const render::SceneTexture texture = two_colors();
    RoomPerson person = person_at(ParticipantId{2}, {0, 1.6, 0}, {0, 1.6, 3});
    const std::size_t plain = seen({person}, view).objects.size();
    person.face = FacePicture{&texture, 1, ""};
    EXPECT_LT(seen({person}, view).objects.size(), plain) << "no plate behind the picture";
    person.face = FacePicture{&texture, 0.5, "picture stands still for 2 s"};
    const render::SceneFrame frame = seen({person}, view);
    EXPECT_EQ(frame.objects.size(), plain + 2) << "rim and picture before the plate";
    EXPECT_EQ(texts_of(person),
              (std::vector<std::string>{"A", "Anna", "picture stands still for 2 s"}));
    person.has_cloud = true;
    EXPECT_TRUE(seen({person}, view).objects.empty()) << "the cloud has a face";
    EXPECT_EQ(seen({person}, view).texts.size(), 1u);
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
    EXPECT_EQ(texts_of(person), (std::vector<std::string>{"A", "Anna (view is old)"}));
}

TEST_F(PeopleTest, TheirAgeStandsAboveTheName) {
    RoomPerson person = person_at(ParticipantId{1}, {0, 1.6, 0}, {0, 1.6, 3});
    person.age = "85 ms";
    const render::SceneFrame frame = seen({person}, view);
    ASSERT_EQ(texts_of(person), (std::vector<std::string>{"A", "Anna", "85 ms"}));
    EXPECT_GT(frame.texts[2].room_from_text.translation.y,
              frame.texts[1].room_from_text.translation.y + frame.texts[1].height_m);
}

TEST(PersonColor, DiffersBetweenNeighbours) {
    for (std::uint32_t i = 0; i < 20; ++i)
        EXPECT_NE(color_of(ParticipantId{i}), color_of(ParticipantId{i + 1}));
}

}  // namespace
}  // namespace theatron::room
