// SPDX-License-Identifier: Apache-2.0
#include "room/virtual_room.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "render/ball_scene.h"
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

render::SceneFrame seen(VirtualRoom& room, const render::CameraView& view,
                        render::SceneQuality quality = render::SceneQuality::low) {
    render::SceneFrame frame;
    frame.quality = quality;
    room.build(frame.quality);
    room.add_to(frame, view);
    return frame;
}

void write_ppm(const std::string& file, const ColorImage& image) {
    std::ofstream out(file, std::ios::binary);
    out << "P6\n" << image.size.width << ' ' << image.size.height << "\n255\n";
    out.write(reinterpret_cast<const char*>(image.pixels.data()),
              std::streamsize(image.pixels.size() * sizeof(Rgb)));
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
    ASSERT_TRUE(room.free_space());
    EXPECT_EQ(room.free_space()->extent, *extent);
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
    room.build(frame.quality);
    room.add_to(frame, view);
    // The organ, six sides of the room, the furniture in one, and a mark.
    EXPECT_EQ(frame.objects.size(), 9u);
    EXPECT_EQ(frame.objects.front().mesh, &organ);
    EXPECT_EQ(frame.quality, render::SceneQuality::low);
}

TEST(VirtualRoom, InStepsItAppearsAsAWholeAndIsTheSame) {
    render::test_context();
    VirtualRoom room, at_once;
    for (VirtualRoom* each : {&room, &at_once})
        each->set_cameras({camera_at({2, 2, 1}, "a")});
    const auto view = render::view_towards({0, 1.7, 3}, {0, 1, 0}, 60, {64, 48});
    render::SceneFrame frame;
    frame.quality = render::SceneQuality::low;
    int steps = 1;
    for (; !room.build_step(frame.quality); ++steps) {
        ASSERT_LT(steps, 200);
        room.add_to(frame, view);
        ASSERT_TRUE(frame.objects.empty());
    }
    // No side is made at once.
    EXPECT_GT(steps, 50);
    EXPECT_FALSE(room.build_step(frame.quality)) << "it is made";
    room.add_to(frame, view);
    const render::SceneFrame whole = seen(at_once, view);
    ASSERT_EQ(frame.objects.size(), whole.objects.size());
    for (std::size_t i = 0; i < whole.objects.size(); ++i)
        EXPECT_EQ(frame.objects[i].look.baked, whole.objects[i].look.baked) << i;
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
    const std::size_t with_one_mark = frame.objects.size();
    // Labels right before the eye would fill the picture.
    view.room_from_eye.translation.x += 0.8;
    frame = seen(room, view);
    EXPECT_EQ(frame.objects.size(), with_one_mark + 1);
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
        render::SceneFrame frame = seen(room, view, quality);
        const auto picture = render::draw_and_read(&frame, {}, {view}, size, &passes);
        const Rgb nothing{32, 34, 38};
        EXPECT_NE(picture.color.view().row(440)[300], nothing);
        EXPECT_NE(picture.color.view().row(200)[320], nothing);
        frame.texts.clear();
        const auto bare = render::draw_and_read(&frame, {}, {view}, size, &passes);
        int letters = 0;
        for (std::size_t i = 0; i < bare.color.pixels.size(); ++i)
            letters += bare.color.pixels[i] != picture.color.pixels[i];
        EXPECT_GT(letters, 60);
        EXPECT_LT(letters, 3000);
    }
}

TEST(VirtualRoom, NeverChangesTheCloudsThatAreSeenInIt) {
    render::test_context();
    constexpr Size size{160, 120};
    render::CloudSet clouds;
    render::show_golden_scene(clouds);
    const render::CameraView view = render::golden_view();
    render::ScenePasses passes;
    for (const auto quality : {render::SceneQuality::low, render::SceneQuality::high}) {
        VirtualRoom room;
        room.set_cameras({});
        const render::SceneFrame frame = seen(room, view, quality);
        const render::Picture around = render::draw_and_read(&frame, {}, {view}, size, &passes);
        for (const std::string renderer : {"splat", "mesh"}) {
            const std::vector<render::DrawnClouds> drawn{{&clouds, renderer}};
            const render::Picture alone =
                render::draw_and_read(nullptr, drawn, {view}, size, &passes);
            const render::Picture both =
                render::draw_and_read(&frame, drawn, {view}, size, &passes);
            int compared = 0;
            for (std::size_t i = 0; i < alone.color.pixels.size(); ++i) {
                const int cloud = alone.depth_mm.pixels[i], furniture = around.depth_mm.pixels[i];
                if (cloud == 0 || (furniture != 0 && furniture < cloud + 10))
                    continue;
                ++compared;
                ASSERT_EQ(alone.color.pixels[i], both.color.pixels[i]) << renderer;
                ASSERT_EQ(alone.depth_mm.pixels[i], both.depth_mm.pixels[i]) << renderer;
            }
            EXPECT_GT(compared, 500) << renderer;
        }
    }
}

// Pictures to look at: THEATRON_WRITE_ROOM names the folder.
TEST(VirtualRoom, CanBeLookedAt) {
    const char* folder = std::getenv("THEATRON_WRITE_ROOM");
    if (!folder)
        GTEST_SKIP() << "THEATRON_WRITE_ROOM names no folder";
    render::test_context();
    const struct {
        const char* name;
        Vec3 eye, at;
        double degrees;
    } views[] = {{"surgeon", {0.1, 1.65, 1.5}, {-0.1, 1.1, -0.6}, 62},
                 {"door", {-0.6, 1.65, 3.2}, {0, 1.2, -0.5}, 62},
                 {"back", {0.4, 1.65, -3.0}, {-0.2, 1.25, 2}, 62},
                 {"left", {-3.2, 1.7, 2.6}, {1.5, 1.1, -1.2}, 62},
                 {"overview", {3.2, 2.85, 3.2}, {-0.4, 0.8, -0.6}, 66},
                 {"table", {0.9, 1.5, 0.9}, {0.0, 0.9, 0}, 55},
                 {"machine", {-0.9, 1.6, 1.9}, {-2.5, 1.0, 0.4}, 60}};
    constexpr Size size{1280, 720};
    render::ScenePasses passes;
    for (const auto quality : {render::SceneQuality::low, render::SceneQuality::high}) {
        VirtualRoom room;
        room.set_cameras({});
        for (const auto& v : views) {
            const auto view = render::view_towards(v.eye, v.at, v.degrees, size);
            render::SceneFrame frame = seen(room, view, quality);
            const bool low = quality == render::SceneQuality::low;
            write_ppm(std::string(folder) + "/" + v.name + (low ? "_low.ppm" : "_high.ppm"),
                      render::draw_and_read(&frame, {}, {view}, size, &passes).color);
        }
    }
}

}  // namespace
}  // namespace theatron::room
