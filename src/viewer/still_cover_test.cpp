// SPDX-License-Identifier: Apache-2.0
#include "viewer/still_cover.h"

#include <gtest/gtest.h>

#include "testing/speaking.h"

namespace theatron::viewer {
namespace {

constexpr TimePoint judged{100s};

ShownCamera taken(Duration ago, bool is_exempt = false) {
    return {judged - ago, is_exempt};
}

const ShownCamera first_on_its_way{};

TEST(StillCover, APictureIsCoveredFromTwoSecondsOn) {
    EXPECT_FALSE(all_still({taken(1999ms)}, judged));
    EXPECT_EQ(all_still({taken(2s)}, judged), std::optional<Duration>(2s));
    EXPECT_EQ(all_still({taken(2s)}, judged + 3s), std::optional<Duration>(5s));
}

TEST(StillCover, TheNewestPictureOfAllCamerasCounts) {
    EXPECT_EQ(all_still({taken(9s), taken(4s), taken(60s)}, judged), std::optional<Duration>(4s));
}

TEST(StillCover, OneCameraThatIsLiveKeepsThePictureAndTheOthersStandStill) {
    EXPECT_FALSE(all_still({taken(9s), taken(40ms)}, judged));
    EXPECT_TRUE(stands_still(taken(9s), judged));
    EXPECT_FALSE(stands_still(taken(40ms), judged));
}

TEST(StillCover, TheFirstPictureIsWaitedFor) {
    EXPECT_FALSE(all_still({}, judged));
    EXPECT_FALSE(all_still({first_on_its_way}, judged + 1h));
    EXPECT_EQ(all_still({first_on_its_way, taken(3s)}, judged), std::optional<Duration>(3s))
        << "which is what one sees until then";
}

TEST(StillCover, WhatIsMarkedAsNotLiveIsNotCovered) {
    EXPECT_FALSE(stands_still(taken(1h, true), judged));
    EXPECT_FALSE(all_still({taken(1h, true)}, judged));
    EXPECT_FALSE(all_still({taken(1h, true), taken(9s)}, judged));
}

client::CameraFigures figures(double age_ms) {
    client::CameraFigures camera;
    camera.depth.has_come = true;
    camera.depth.codec = "strata";
    camera.depth.age_now_ms = age_ms;
    return camera;
}

TEST(StillCover, FiguresTellAgesRecordingsAndThePast) {
    const auto cover = [](const client::CameraFigures& camera) {
        return all_still(shown_cameras({camera}, judged), judged);
    };
    EXPECT_FALSE(cover(figures(1500)));
    EXPECT_EQ(cover(figures(2500)), std::optional<Duration>(2500ms));
    client::CameraFigures camera = figures(2500);
    camera.depth.has_come = false;
    EXPECT_FALSE(cover(camera)) << "before its first picture";
    camera = figures(2500);
    camera.played = client::CameraFigures::Played::paused;
    EXPECT_FALSE(cover(camera));
    camera = figures(2500);
    camera.depth.past = true;
    EXPECT_FALSE(cover(camera));
    camera = figures(2500);
    camera.camera.description.kind = wire::CameraKind::person;
    EXPECT_FALSE(cover(camera)) << "a person's own camera is not the room's picture";
}

TEST(StillCover, SaysHowLong) {
    EXPECT_EQ(still_text(std::nullopt), "");
    EXPECT_EQ(still_text(5900ms), "No picture for 5 s");
    const testing::Speaking german(Language::german);
    EXPECT_EQ(still_text(125s), "Seit 2 min kein Bild");
    const testing::Speaking french(Language::french);
    EXPECT_EQ(still_text(125s), "Pas d'image depuis 2 min");
}

}  // namespace
}  // namespace theatron::viewer
