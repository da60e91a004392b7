// SPDX-License-Identifier: Apache-2.0
#include "capture/synthetic_camera.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "base/error.h"
#include "testing/temporary_folder.h"

namespace theatron::capture {
namespace {

namespace fs = std::filesystem;

std::string problem_of(std::string_view specification) {
    try {
        (void)open_camera(specification);
    } catch (const Error& problem) {
        return problem.what();
    }
    return "";
}

TEST(SyntheticCamera, DeliversRegisteredFramesWithColor) {
    const testing::TemporaryFolder folder;
    const fs::path cache = folder.path() / "frames";
    const auto camera =
        open_camera("synthetic:seconds=2,fps=2,quality=quick,cache=" + cache.string());
    EXPECT_TRUE(camera->info().calibration.registered);
    EXPECT_EQ(camera->info().calibration.depth.size, (Size{320, 288}));
    for (FrameNumber number = 0; number < 2; ++number) {
        const Capture capture = camera->next(60s);
        ASSERT_EQ(capture.kind, Capture::Kind::frame);
        EXPECT_EQ(capture.frame->depth.size, (Size{320, 288}));
        EXPECT_EQ(capture.frame->color.size, (Size{640, 360}));
        EXPECT_TRUE(capture.frame->color.is_jpeg());
        // The table is in the middle of the picture, about two metres away.
        const int middle = capture.frame->depth.view().row(170)[160];
        EXPECT_GT(middle, 1000);
        EXPECT_LT(middle, 3000);
    }
    const auto preloaded =
        open_camera("synthetic:seconds=2,fps=2,quality=quick,preload=1,cache=" + cache.string());
    fs::remove_all(cache);
    const Capture from_memory = preloaded->next(60s);
    ASSERT_EQ(from_memory.kind, Capture::Kind::frame);
    EXPECT_EQ(from_memory.frame->depth.size, (Size{320, 288}));
}

TEST(SyntheticCamera, ExplainsLastingError) {
    EXPECT_NE(problem_of("synthetic:kitchen").find("room and surgeon"), std::string::npos);
    EXPECT_NE(problem_of("synthetic:color=9").find("color"), std::string::npos);
    EXPECT_NE(problem_of("synthetic:camera=2,cameras=2").find("camera"), std::string::npos);
    EXPECT_NE(problem_of("synthetic:noise=some").find("on or off"), std::string::npos);
    EXPECT_NE(problem_of("synthetic:people=2").find("people must be on or off"), std::string::npos);
    EXPECT_NE(problem_of("synthetic:nose=1").find("nose"), std::string::npos);
}

}  // namespace
}  // namespace theatron::capture
