// SPDX-License-Identifier: Apache-2.0
#include "room/virtual_room.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "render/room_picture.h"
#include "render/test_context.h"

namespace theatron::room {
namespace {

RoomCamera camera_at(Vec3 place, const char* label, bool registered = true) {
    RoomCamera camera{label, {}};
    camera.calibration.registered = registered;
    camera.calibration.room_from_camera = look_at(place, {0, 1, 0}, {0, 1, 0});
    return camera;
}

render::SceneFrame seen(const VirtualRoom& room, const render::CameraView& view) {
    render::SceneFrame frame;
    room.add_to(frame, view);
    return frame;
}

TEST(VirtualRoom, HoldsAllCamerasAndNeverFeelsNarrow) {
    const auto one = extent_of({camera_at({0, 2, 1}, "a")});
    ASSERT_TRUE(one);
    EXPECT_GE(one->right - one->left, 6);
    EXPECT_GE(one->front - one->back, 6);
    EXPECT_GE(one->height, 2.4);
    const auto two = extent_of({camera_at({-4, 3.2, 1}, "a"), camera_at({5, 2, 1}, "b")});
    EXPECT_LT(two->left, -5);
    EXPECT_GT(two->right, 6);
    EXPECT_GT(two->height, 3.3);
}

TEST(VirtualRoom, IsAroundTheOriginWhereThereAreNoCameras) {
    render::test_context();
    const auto extent = extent_of({});
    ASSERT_TRUE(extent);
    EXPECT_EQ(extent->left, -extent->right);
    EXPECT_EQ(extent->back, -extent->front);
    VirtualRoom room;
    room.set_cameras({});
    EXPECT_EQ(room.extent(), extent);
    EXPECT_FALSE(seen(room, render::view_towards({0, 1.7, 2}, {0, 1, 0}, 60, {64, 48})).empty());
}

TEST(VirtualRoom, IsNotThereUntilItIsKnownWhereTheCamerasAre) {
    render::test_context();
    EXPECT_FALSE(extent_of({camera_at({0, 2, 1}, "a", false)}));
    VirtualRoom room;
    const auto view = render::view_towards({0, 1.7, 3}, {0, 1, 0}, 60, {64, 48});
    EXPECT_TRUE(seen(room, view).empty());
    room.set_cameras({camera_at({0, 2, 1}, "a", false)});
    EXPECT_TRUE(seen(room, view).empty());
    room.set_cameras({camera_at({0, 2, 1}, "a", false), camera_at({2, 2, 1}, "b")});
    ASSERT_EQ(seen(room, view).texts.size(), 1u);
    EXPECT_EQ(seen(room, view).texts[0].utf8, "b");
    room.set_cameras({camera_at({0, 2, 1}, "a", false)});
    EXPECT_TRUE(seen(room, view).empty()) << "another host's cameras may be nowhere";
}

TEST(VirtualRoom, AppendsToWhatIsThere) {
    render::test_context();
    VirtualRoom room;
    room.set_cameras({camera_at({2, 2, 1}, "a")});
    const auto view = render::view_towards({0, 1.7, 3}, {0, 1, 0}, 60, {64, 48});
    const render::SceneMesh organ(render::make_box_mesh({0, 0, 0}, {0.1, 0.1, 0.1}));
    render::SceneFrame frame;
    frame.objects.push_back({&organ, {}, {}});
    frame.quality = render::SceneQuality::low;
    room.add_to(frame, view);
    EXPECT_EQ(frame.objects.size(), 4u) << "organ, floor, walls and a mark";
    EXPECT_EQ(frame.objects.front().mesh, &organ);
    EXPECT_EQ(frame.quality, render::SceneQuality::low);
}

TEST(VirtualRoom, WhoLooksFromACamerasPlaceDoesNotSeeItsMark) {
    render::test_context();
    VirtualRoom room;
    const RoomCamera left = camera_at({-2, 2, 1}, "left"), right = camera_at({2, 2, 1}, "right");
    room.set_cameras({left, right});
    render::CameraView view;
    view.room_from_eye = left.calibration.room_from_camera;
    render::SceneFrame frame = seen(room, view);
    ASSERT_EQ(frame.texts.size(), 1u);
    EXPECT_EQ(frame.texts[0].utf8, "right");
    EXPECT_EQ(frame.objects.size(), 3u) << "floor, walls and one mark";
    // Labels right before the eye would fill the picture.
    view.room_from_eye.translation.x += 0.8;
    frame = seen(room, view);
    EXPECT_EQ(frame.objects.size(), 4u);
    EXPECT_EQ(frame.texts.size(), 1u);
}

TEST(VirtualRoom, FloorAndWallsAreSeenFromInsideAndLabelsCanBeRead) {
    render::test_context();
    const char* const font = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf";
    if (!std::filesystem::exists(font))
        GTEST_SKIP() << "fonts-dejavu-core is not installed";
    std::ifstream file(font, std::ios::binary);
    const std::string bytes((std::istreambuf_iterator<char>(file)), {});
    const render::FontAtlas atlas = render::load_font_atlas(std::as_bytes(std::span(bytes)));

    VirtualRoom room;
    room.set_cameras({camera_at({-1, 2, -1}, "left"), camera_at({1.5, 2, -1}, "right (stale)")});
    render::ScenePasses passes(&atlas);
    constexpr Size size{640, 480};
    for (const auto quality : {render::SceneQuality::low, render::SceneQuality::high}) {
        const auto view = render::view_towards({0, 1.7, 2.5}, {0, 1.5, -1}, 70, size);
        render::SceneFrame frame = seen(room, view);
        frame.quality = quality;
        const auto picture = render::draw_and_read(&frame, {}, {view}, size, &passes);
        const char* name = std::getenv("THEATRON_WRITE_SCENE");
        if (name && quality == render::SceneQuality::high) {
            std::ofstream out(name, std::ios::binary);
            out << "P6\n640 480\n255\n";
            out.write(reinterpret_cast<const char*>(picture.color.pixels.data()),
                      std::streamsize(picture.color.pixels.size() * 3));
        }
        const Rgb floor = picture.color.view().row(440)[300],
                  wall = picture.color.view().row(200)[320];
        const Rgb nothing{32, 34, 38};
        EXPECT_NE(floor, nothing);
        EXPECT_NE(wall, nothing);
        EXPECT_GT(floor.g, wall.g) << "light comes from above";
        int letters = 0;
        for (const Rgb& pixel : picture.color.pixels)
            letters += pixel.r > 190;
        EXPECT_GT(letters, 60);
        EXPECT_LT(letters, 3000);
    }
}

}  // namespace
}  // namespace theatron::room
