// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/camera_names.h"
#include "base/error.h"
#include "region_text.h"
#include "viewer/head_text.h"
#include "viewer/view_choice.h"

namespace theatron::app {
namespace {

using ::testing::HasSubstr;

// The error sentence of `call`.
template <class Call>
std::string refusal(const Call& call) {
    try {
        call();
    } catch (const Error& sentence) {
        return sentence.what();
    }
    return "";
}

TEST(RegionText, FourNumbersAreABoxAndSixOrMoreAPolygon) {
    const RegionText box = parse_region("0=120:80:200:160");
    EXPECT_EQ(box.camera, "0");
    EXPECT_EQ(box.polygon, codec::strata::box(120, 80, 320, 240));
    const RegionText polygon = parse_region("a=b=10:10:200:20:90:150");
    EXPECT_EQ(polygon.camera, "a=b");
    ASSERT_EQ(polygon.polygon.size(), 3u);
    EXPECT_EQ(polygon.polygon[2].x, 90);
    EXPECT_EQ(polygon.polygon[2].y, 150);
}

TEST(RegionText, WhatIsNoRegionIsNamed) {
    for (const char* text : {"1:2:3:4", "=1:2:3:4", ""})
        EXPECT_THAT(refusal([&] { parse_region(text); }), HasSubstr("does not say which camera"))
            << text;
    for (const char* text : {"", "1:2:3", "1:2:0:4", "1:2:3:0", "1:2:3:4:5", "1:2:3:4:", "1:2:3:-4",
                             "1:2:3:9000", "1:2:3:70000", "1 :2:3:4"})
        EXPECT_THAT(refusal([&] { parse_polygon(text); }), HasSubstr("is no region")) << text;
}

TEST(RegionText, APolygonHasNoMoreCornersThanTheCodecTakes) {
    const auto corners = [](std::size_t count) {
        std::string text = "1:1";
        for (std::size_t i = 1; i < count; ++i)
            text += ":1:1";
        return text;
    };
    EXPECT_EQ(parse_polygon(corners(codec::strata::max_corners)).size(),
              std::size_t(codec::strata::max_corners));
    EXPECT_THAT(refusal([&] { parse_polygon(corners(codec::strata::max_corners + 1)); }),
                HasSubstr("is no region"));
}

TEST(RegionText, ACameraIsMeantByItsNameBeforeItsNumber) {
    const std::vector<std::string> names{"left", "0"};
    EXPECT_EQ(find_camera("left", names), 0u);
    EXPECT_EQ(find_camera("0", names), 1u);
    EXPECT_EQ(find_camera("1", names), 1u);
    for (const char* none : {"2", "-1", "", "1x", "right"})
        EXPECT_THAT(refusal([&] { find_camera(none, names); }), HasSubstr("There is no camera"))
            << none;
}

TEST(HeadText, APersonStandsWhereTheTextSaysAndLooksAlongMinusZ) {
    const viewer::SeenPerson person =
        viewer::parse_seen_person("1=0.2:1.65:-0.4", viewer::Seen::oneself);
    EXPECT_EQ(person.camera, "1");
    EXPECT_EQ(person.who, viewer::Seen::oneself);
    const Vec3 eyes = person.room_from_head * Vec3{0, 0, 0};
    const Vec3 ahead = person.room_from_head * Vec3{0, 0, 1} - eyes;
    EXPECT_NEAR(eyes.x, 0.2, 1e-9);
    EXPECT_NEAR(eyes.y, 1.65, 1e-9);
    EXPECT_NEAR(eyes.z, -0.4, 1e-9);
    EXPECT_NEAR(ahead.z, -1, 1e-9);
    const viewer::SeenPerson turned =
        viewer::parse_seen_person("1=0:0:0,yaw=90", viewer::Seen::other);
    EXPECT_NEAR((turned.room_from_head * Vec3{0, 0, 1}).x, -1, 1e-9);
}

TEST(HeadText, WhatIsNoPersonIsNamed) {
    for (const char* text : {"0.2:1.65:-0.4", "=0:0:0", "1=0:0", "1=0:0:0:0", "1=0:0:x",
                             "1=nan:0:0", "1=0:inf:0", "1=0:101:0"})
        EXPECT_THAT(refusal([&] { viewer::parse_seen_person(text, viewer::Seen::other); }),
                    HasSubstr("is not understood"))
            << text;
    EXPECT_THAT(
        refusal([&] { viewer::parse_seen_person("1=0:0:0,pitch=81", viewer::Seen::other); }),
        HasSubstr("pitch"));
    EXPECT_THAT(
        refusal([&] { viewer::parse_seen_person("1=0:0:0,reach=nan", viewer::Seen::other); }),
        HasSubstr("reach"));
}

TEST(HeadText, OneCameraHasOnePerson) {
    EXPECT_EQ(viewer::parse_seen_people({"0=0:0:0"}, {"1=0:0:0"}).size(), 2u);
    EXPECT_THAT(refusal([&] { viewer::parse_seen_people({"0=0:0:0"}, {"0=0:0:0"}); }),
                HasSubstr("has two people"));
}

TEST(ViewText, ACameraAndTwoAnglesOrASentence) {
    const viewer::ViewChoice view = viewer::parse_view("camera:12,yaw=20,pitch=-10");
    EXPECT_EQ(view.camera, CameraId(12));
    EXPECT_EQ(view.yaw_degrees, 20);
    EXPECT_EQ(view.pitch_degrees, -10);
    EXPECT_THAT(refusal([&] { viewer::parse_view(""); }), HasSubstr("names no kind"));
    for (const char* text : {"camera", "camera:", "camera:-1", "camera:1000", "camera:1x", "eye:1"})
        EXPECT_THAT(refusal([&] { viewer::parse_view(text); }), HasSubstr("is not understood"))
            << text;
    EXPECT_THAT(refusal([&] { viewer::parse_view("camera:1,yaw=181"); }), HasSubstr("yaw"));
}

}  // namespace
}  // namespace theatron::app
