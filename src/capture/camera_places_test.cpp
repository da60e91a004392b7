// SPDX-License-Identifier: Apache-2.0
#include "capture/camera_places.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.h"
#include "capture/placed_camera.h"
#include "files/png_file.h"
#include "testing/temporary_folder.h"

namespace theatron::capture {
namespace {

using ::testing::HasSubstr;

CameraPlaces two_places() {
    CameraPlaces places{"2026-05-04T10:20:30Z", "lattice board, 10 poses", {}};
    places.cameras.push_back({"left", {{0, 1, 0, 0}, {1, 1.5, -2}}, {}, 1.25, {}});
    places.cameras.push_back({"right", {{1, 0, 0, 0}, {0, 2, 0}}, {}, {}, Vec3{1, 0.5, 2}});
    places.cameras[1].covariance.emplace().fill(1e-6);
    return places;
}

TEST(CameraPlaces, ReadsWhatItWrote) {
    const ParsedPlaces parsed = parse_places(write_places(two_places()));
    EXPECT_EQ(parsed.problem, "");
    EXPECT_EQ(parsed.places, two_places());
    ASSERT_TRUE(parsed.places.find("right"));
    EXPECT_EQ(parsed.places.find("right")->room_from_camera.translation.y, 2);
    EXPECT_FALSE(parsed.places.find("middle"));
}

TEST(CameraPlaces, SaysWhatIsWrongWithAFile) {
    const auto changed = [](const std::string& what, const std::string& to) {
        std::string text = write_places(two_places());
        const std::size_t at = text.find(what);
        EXPECT_NE(at, std::string::npos) << what;
        return parse_places(text.replace(at, what.size(), to)).problem;
    };
    EXPECT_THAT(parse_places("{").problem, HasSubstr("is not JSON"));
    EXPECT_THAT(changed("\"theatron_places\": 1", "\"theatron_places\": 2"), HasSubstr("version"));
    EXPECT_THAT(changed("\"right\"", "\"left\""), HasSubstr("'left' twice"));
    EXPECT_THAT(changed("\"quaternion\"", "\"quaternian\""), HasSubstr("quaternian"));
    EXPECT_THAT(changed("1.5", "1e9"), HasSubstr("1 km away"));
    EXPECT_THAT(changed("\"made\"", "\"mad\""), HasSubstr("'mad'"));
    EXPECT_THAT(changed("1.25", "101"), HasSubstr("depth_offset_mm"));
    EXPECT_THAT(changed("0.5", "5.5"), HasSubstr("color_gain"));
}

TEST(CameraPlaces, APlaceByHandIsMetresAndDegrees) {
    const auto at = [](std::string_view text, Vec3 point) { return *parse_place(text) * point; };
    const auto near = [](Vec3 a, Vec3 b) { return length(a - b) < 1e-9; };
    // A metre ahead of the camera; x right, y down in its frame.
    constexpr Vec3 ahead{0, 0, 1};
    EXPECT_TRUE(near(at("1:2:3", ahead), {1, 2, 2}));
    EXPECT_TRUE(near(at("1:2:3", {0, 1, 0}), {1, 1, 3}));
    EXPECT_TRUE(near(at("1:2:3:90", ahead), {0, 2, 3}));           // to the left
    EXPECT_TRUE(near(at("1:2:3:0:90", ahead), {1, 3, 3}));         // upwards
    EXPECT_TRUE(near(at("0:0:0:0:0:90", {1, 0, 0}), {0, -1, 0}));  // clockwise
    for (const char* wrong : {"", "1", "1:2", "1:2:x", "1:2:3:", "1:2:3:4:5:6:7", "1:2:nan"})
        EXPECT_FALSE(parse_place(wrong)) << wrong;
}

TEST(PlacedCamera, EveryKindOfCameraTakesAPlaceAndTheHandIsTheLastWord) {
    const theatron::testing::TemporaryFolder folder;
    const std::filesystem::path path = folder.path() / "scene";
    std::filesystem::create_directories(path / "depth");
    const DepthImage depth({8, 6});
    files::write_png(path / "depth/0.png", depth.view());
    const std::string camera = "folder:" + path.string();
    const std::string name = open_camera(camera)->info().name;
    CameraPlaces places = two_places();
    places.cameras[0].camera = name;
    const auto from_file = open_camera_at(camera, places);
    EXPECT_TRUE(from_file->info().calibration.registered);
    EXPECT_EQ(from_file->info().calibration.room_from_camera, places.cameras[0].room_from_camera);
    EXPECT_EQ(from_file->info().calibration.depth_offset_mm, 1.25);
    EXPECT_EQ(from_file->info().calibration.registration, places.registration());
    EXPECT_NE(places.registration(), two_places().registration());
    const auto by_hand = open_camera_at(camera + ",place=5:1:2", places);
    EXPECT_EQ(by_hand->info().calibration.depth_offset_mm, std::nullopt);
    EXPECT_EQ(by_hand->info().calibration.registration, 0u);
    EXPECT_EQ(by_hand->info().calibration.room_from_camera.translation, (Vec3{5, 1, 2}));
    EXPECT_THROW(open_camera(camera + ",place=here"), Error);
}

}  // namespace
}  // namespace theatron::capture
