// SPDX-License-Identifier: Apache-2.0
#include "viewer/camera_unrest.h"

#include <gtest/gtest.h>

#include "phrases/phrase.h"

namespace theatron::viewer {
namespace {

using std::chrono::seconds;

const std::vector<std::string> unrest_cameras{"left", "right"};
constexpr TimePoint unrest_begin{seconds(100)};

std::string unrest_stands(const std::string& camera) {
    return say(Phrase::camera_stale, camera, "It sends nothing.");
}

TEST(CameraUnrest, IsToldOnceAndThenCounted) {
    CameraUnrest unrest;
    EXPECT_TRUE(unrest.tells(unrest_stands("left"), unrest_cameras, unrest_begin));
    EXPECT_EQ(unrest.count(unrest_begin), 0u);
    EXPECT_FALSE(unrest.tells(say(Phrase::camera_live_again, "left"), unrest_cameras,
                              unrest_begin + seconds(1)));
    EXPECT_FALSE(unrest.tells(unrest_stands("right"), unrest_cameras, unrest_begin + seconds(2)));
    EXPECT_EQ(unrest.count(unrest_begin + seconds(2)), 2u);
}

TEST(CameraUnrest, IsForgottenAfterAMinuteOfRest) {
    CameraUnrest unrest;
    EXPECT_TRUE(unrest.tells(unrest_stands("left"), unrest_cameras, unrest_begin));
    EXPECT_FALSE(unrest.tells(unrest_stands("left"), unrest_cameras, unrest_begin + seconds(1)));
    EXPECT_EQ(unrest.count(unrest_begin + seconds(62)), 0u);
    EXPECT_TRUE(unrest.tells(unrest_stands("left"), unrest_cameras, unrest_begin + seconds(62)));
}

TEST(CameraUnrest, AllElseIsTold) {
    CameraUnrest unrest;
    for (int i = 0; i < 3; ++i) {
        EXPECT_TRUE(unrest.tells("Connected again.", unrest_cameras, unrest_begin));
        EXPECT_TRUE(unrest.tells(say(Phrase::camera_failed, "left", "No power."), unrest_cameras,
                                 unrest_begin));
        EXPECT_TRUE(unrest.tells(unrest_stands("left"), {"right"}, unrest_begin))
            << "no camera of this name";
    }
    EXPECT_EQ(unrest.count(unrest_begin), 0u);
}

}  // namespace
}  // namespace theatron::viewer
