// SPDX-License-Identifier: Apache-2.0
#include "room/mark_scene.h"

#include <gtest/gtest.h>

#include "render/room_picture.h"
#include "render/test_context.h"
#include "room/people.h"

namespace theatron::room {
namespace {

using session::Mark;
using session::MarkKind;
using session::MarkPoint;

class MarkSceneTest : public ::testing::Test {
protected:
    MarkSceneTest() { render::test_context(); }

    // A circle on a ball of 10 cm, and the other kinds around it.
    static std::vector<PlacedMark> marks() {
        const auto on_ball = [](double x, double y) {
            const double z = std::sqrt(1 - x * x - y * y);
            return MarkPoint{Vec3{x, y, z} * 0.1, {x, y, z}};
        };
        Mark stroke;
        stroke.color = 1;
        stroke.initials = "AL";
        for (int i = 0; i <= 40; ++i)
            stroke.points.push_back(
                on_ball(-0.2 + 0.35 * std::cos(i * 0.157), 0.3 + 0.35 * std::sin(i * 0.157)));
        Mark arrow;
        arrow.kind = MarkKind::arrow;
        arrow.color = 2;
        arrow.initials = "BM";
        arrow.points = {{{0.12, 0.1, 0.1}, {0, 0, 1}}, on_ball(0.5, 0.3)};
        Mark pin;
        pin.kind = MarkKind::pin;
        pin.color = 3;
        pin.initials = "AL";
        pin.number = 1;
        pin.points = {on_ball(0.3, -0.5)};
        Mark distance;
        distance.kind = MarkKind::distance;
        distance.color = 4;
        distance.initials = "BM";
        distance.deviation_m = 0.0012f;
        distance.points = {on_ball(-0.6, -0.5), on_ball(-0.1, -0.4)};
        return {{stroke, place, 1}, {arrow, place, 1}, {pin, place, 1}, {distance, place, 1}};
    }

    static constexpr Pose place{{}, {0, 1.2, 0}};
    static constexpr Size size{480, 360};
    const render::CameraView view = render::view_towards({0, 1.25, 0.45}, {0, 1.2, 0}, 40, size);
};

// Pixels whose hue is near that of a participant's colour.
int pixels_of(const render::Picture& picture, std::uint8_t color) {
    const Vec3 wanted = normalized(color_of(ParticipantId{color}));
    int count = 0;
    for (int y = 0; y < picture.color.size.height; ++y)
        for (int x = 0; x < picture.color.size.width; ++x) {
            const Rgb c = picture.color.view().row(y)[x];
            const Vec3 linear{std::pow(c.r / 255.0, 2.2), std::pow(c.g / 255.0, 2.2),
                              std::pow(c.b / 255.0, 2.2)};
            count += length(linear) > 0.1 && dot(normalized(linear), wanted) > 0.97;
        }
    return count;
}

TEST_F(MarkSceneTest, EveryMarkIsSeenOnItsSurfaceInItsAuthorsColor) {
    const render::SceneMesh ball(render::make_sphere_mesh(0.1, 40));
    MarkScene scene;
    render::SceneFrame frame;
    frame.objects.push_back({&ball, place, {{0.5, 0.5, 0.5}}});
    scene.add_to(frame, marks(), view);
    ASSERT_EQ(frame.labels.size(), 4u);
    EXPECT_EQ(frame.labels[2].utf8, "1 AL");
    EXPECT_NEAR(frame.labels[0].color.g, 180, 2);
    render::ScenePasses passes(nullptr);
    const render::Picture picture = render::draw_and_read(&frame, {}, {view}, size, &passes);
    for (const std::uint8_t color : {1, 2, 3, 4})
        EXPECT_GT(pixels_of(picture, color), 60) << int(color);

    // From behind, the ball hides what lies on it; the arrow and the pin stand out at its edge, and
    // a distance, which leads through the ball, shows faintly.
    const render::CameraView behind = render::view_towards({0, 1.25, -0.45}, {0, 1.2, 0}, 40, size);
    render::SceneFrame without_distance = frame;
    without_distance.lines.pop_back();
    const render::Picture back = render::draw_and_read(&frame, {}, {behind}, size, &passes);
    EXPECT_EQ(pixels_of(back, 1), 0);
    EXPECT_NE(back.color,
              render::draw_and_read(&without_distance, {}, {behind}, size, &passes).color);
    EXPECT_LT(pixels_of(back, 4), pixels_of(picture, 4));
}

TEST_F(MarkSceneTest, MeshesAreKeptWhileTheirMarksStay) {
    MarkScene scene;
    std::vector<PlacedMark> list = marks();
    const auto meshes = [&] {
        render::SceneFrame frame;
        scene.add_to(frame, list, view);
        std::vector<const render::SceneLineMesh::Buffers*> buffers;
        for (const render::SceneLine& line : frame.lines)
            buffers.push_back(&line.mesh->buffers());
        return buffers;
    };
    const auto first = meshes();
    EXPECT_EQ(meshes(), first);
    list.erase(list.begin());
    const auto fewer = meshes();
    EXPECT_EQ(fewer.at(0), first.at(1));
    list[0].mark.points[0].position.x += 0.01;
    EXPECT_NE(meshes().at(0), fewer.at(0));
}

TEST_F(MarkSceneTest, ScaledOrgansHaveLongerMarksOfTheSameThicknessAndLength) {
    std::vector<PlacedMark> list{marks()[3]};
    render::SceneFrame small, large;
    MarkScene scene;
    scene.add_to(small, list, view);
    list[0].scale = 2;
    scene.add_to(large, list, view);
    EXPECT_EQ(small.labels[0].utf8, large.labels[0].utf8);
    EXPECT_GT(length(large.labels[0].place - place.translation),
              1.5 * length(small.labels[0].place - place.translation));
}

TEST_F(MarkSceneTest, ALabelStandsWhereItsMarkIsSeenWhenTheMiddleIsOutOfThePicture) {
    Mark distance;
    distance.kind = MarkKind::distance;
    distance.points = {{{0, 0, 0}, {0, 0, 1}}, {{2, 0, 0}, {0, 0, 1}}};
    render::SceneFrame frame;
    MarkScene().add_to(frame, {{distance, place, 1}}, view);
    EXPECT_EQ(frame.labels.at(0).place, place.translation);
}

TEST_F(MarkSceneTest, NoiseOfAMeasuredSurfaceDoesNotCutALineOnIt) {
    Mark stroke;
    stroke.color = 1;
    stroke.points = {{{-0.06, 0, 0}, {0, 0, 1}}, {{0.06, 0, 0}, {0, 0, 1}}};
    render::SceneFrame frame;
    MarkScene scene;
    scene.add_to(frame, {{stroke, place, 1}}, view);
    render::ScenePasses passes(nullptr);
    const int alone = pixels_of(render::draw_and_read(&frame, {}, {view}, size, &passes), 1);
    EXPECT_GT(alone, 300);
    // Bumps of a centimetre, as a depth camera measures them two metres away; and a hand.
    const render::SceneMesh bump(render::make_box_mesh({-0.01, -0.01, -0.01}, {0.01, 0.01, 0.01}));
    for (const double x : {-0.04, 0.0, 0.04})
        frame.objects.push_back(
            {&bump, {{}, place.translation + Vec3{x, 0, 0}}, {{0.5, 0.5, 0.5}}});
    const auto seen = [&] {
        return pixels_of(render::draw_and_read(&frame, {}, {view}, size, &passes), 1);
    };
    EXPECT_EQ(seen(), alone);
    frame.objects.push_back({&bump, {{}, place.translation + Vec3{0, 0, 0.08}}, {{0.5, 0.5, 0.5}}});
    EXPECT_LT(seen(), alone - 50);
}

}  // namespace
}  // namespace theatron::room
