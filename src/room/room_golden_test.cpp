// SPDX-License-Identifier: Apache-2.0
// Small pictures of the virtual room in both qualities, and of people in it.
#include <gtest/gtest.h>

#include "face/expression.h"
#include "render/room_picture.h"
#include "render/test_context.h"
#include "room/people.h"
#include "room/virtual_room.h"
#include "testing/golden_picture.h"

namespace theatron::room {
namespace {

constexpr Size picture_size{256, 144};

void expect_golden(render::SceneQuality quality, const std::string& file) {
    render::test_context();
    VirtualRoom room;
    room.set_cameras({});
    const auto view = render::view_towards({2.4, 2.2, 2.8}, {-0.4, 0.9, -0.5}, 66, picture_size);
    render::SceneFrame frame;
    frame.quality = quality;
    room.build(frame.quality);
    room.add_to(frame, view);
    render::ScenePasses passes;
    const ColorImage drawn = render::draw_and_read(&frame, {}, {view}, picture_size, &passes).color;
    theatron::testing::expect_golden(drawn, file);
}

RoomPerson person(std::uint32_t id, const char* name, Vec3 place, Vec3 looks_at, bool has_headset) {
    RoomPerson person;
    person.id = ParticipantId{id};
    person.name = name;
    person.head = look_at(place, looks_at, {0, 1, 0}) * Pose{Quat{0, 1, 0, 0}, {}};
    person.has_headset = has_headset;
    return person;
}

// From the left: a bust that looks at the eye with both hands, one from its side that points, and
// plates of people who look at the eye and to the right.
TEST(RoomGolden, FiguresAreThePictureThatWasLookedAt) {
    constexpr Size size{512, 288};
    render::test_context();
    VirtualRoom room;
    room.set_cameras({});
    const Vec3 eye{0, 1.6, 2.2};
    const auto view = render::view_towards(eye, {0, 1.5, 0}, 60, size);
    std::vector<RoomPerson> people{person(0, "Dr. Eva Lang", {-1.1, 1.65, 0.3}, eye, true),
                                   person(1, "remote expert", {-0.3, 1.6, 0}, {3, 1.2, 1}, true),
                                   person(2, "student", {0.45, 1.6, 0}, eye, false),
                                   person(3, "Ben Ito", {1.15, 1.6, 0.2}, {5, 1.2, 0}, false)};
    const auto towards = [](Vec3 hand, Vec3 at) {
        return look_at(hand, at, {0, 1, 0}) * Pose{Quat{0, 1, 0, 0}, {}};
    };
    people[0].left_hand = towards({-0.85, 1.3, 0.6}, {-0.8, 1.3, 3});
    people[0].right_hand = towards({-1.35, 1.3, 0.6}, {-1.3, 1.3, 3});
    people[1].right_hand = towards({-0.05, 1.25, 0.25}, {3, 1.2, 1});
    people[1].points = true;
    render::SceneFrame frame;
    room.build(frame.quality);
    room.add_to(frame, view);
    People figures;
    figures.add_to(frame, people, view);
    render::ScenePasses passes;
    theatron::testing::expect_golden(render::draw_and_read(&frame, {}, {view}, size, &passes).color,
                                     "tests/golden/figures.ppm", 0.8, 0.01);
}

// Sadness, disgust, happiness, surprise with an open mouth, anger, neutral: from the front, and
// turned by half of a right angle.
TEST(RoomGolden, FacesAreThePictureThatWasLookedAt) {
    constexpr int side = 128;
    constexpr double distance_m = 0.7;
    render::test_context();
    People figures;
    render::ScenePasses passes;
    ColorImage all({side * int(face::emotion_count), 2 * side});
    for (std::size_t e = 0; e < face::emotion_count; ++e)
        for (int row = 0; row < 2; ++row) {
            RoomPerson shown = person(1, "", {0, 1.6, 0}, {0, 1.6, 3}, false);
            face::Emotions weights{};
            weights[e] = 1;
            const bool is_surprised = face::Emotion(e) == face::Emotion::surprise;
            shown.expression = face::blend_expressions(weights, {is_surprised ? 0.5F : 0.0F, 0, 0});
            const double angle = row == 0 ? 0 : radians_of(45);
            const Vec3 eye{distance_m * std::sin(angle), 1.62, distance_m * std::cos(angle)};
            const auto view = render::view_towards(eye, {0, 1.6, 0}, 25, {side, side});
            render::SceneFrame frame;
            frame.shadow_middle = {0, 1.5, 0};
            frame.shadow_radius_m = 0.6;
            figures.add_to(frame, {shown}, view);
            const ColorImage drawn =
                render::draw_and_read(&frame, {}, {view}, {side, side}, &passes).color;
            for (int y = 0; y < side; ++y)
                for (int x = 0; x < side; ++x)
                    all.view().row(row * side + y)[int(e) * side + x] = drawn.view().row(y)[x];
        }
    theatron::testing::expect_golden(all, "tests/golden/faces.ppm", 0.8, 0.01);
}

TEST(RoomGolden, LowIsThePictureThatWasLookedAt) {
    expect_golden(render::SceneQuality::low, "tests/golden/room_low.ppm");
}

TEST(RoomGolden, HighIsThePictureThatWasLookedAt) {
    expect_golden(render::SceneQuality::high, "tests/golden/room_high.ppm");
}

}  // namespace
}  // namespace theatron::room
