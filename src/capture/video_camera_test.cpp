// SPDX-License-Identifier: Apache-2.0
#include "capture/video_camera.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <random>

#include "base/error.h"
#include "capture/video_answer.h"
#include "geometry/screen.h"
#include "testing/temporary_folder.h"

namespace theatron::capture {
namespace {

using ::testing::HasSubstr;
namespace fs = std::filesystem;

// An uncompressed video (YUV4MPEG2, 4:4:4) whose frames are grey, each 10 brighter.
std::string grey_video(int width, int height, int frames) {
    std::string video = "YUV4MPEG2 W" + std::to_string(width) + " H" + std::to_string(height) +
                        " F50:1 Ip A1:1 C444 XCOLORRANGE=LIMITED\n";
    const auto pixels = std::size_t(width * height);
    for (int n = 0; n < frames; ++n)
        video +=
            "FRAME\n" + std::string(pixels, char(50 + 10 * n)) + std::string(2 * pixels, char(128));
    return video;
}

class VideoCamera : public ::testing::Test {
protected:
    fs::path file(const std::string& bytes) {
        const fs::path path = folder_.path() / "scope.y4m";
        std::ofstream(path, std::ios::binary) << bytes;
        return path;
    }
    std::string problem_with(const std::string& bytes, const std::string& options = "") {
        try {
            open_camera("video:" + file(bytes).string() + options);
        } catch (const Error& error) {
            return error.what();
        }
        return {};
    }

    testing::TemporaryFolder folder_;
};

TEST_F(VideoCamera, GivesThePicturesOfTheFileOnTheScreensPlane) {
    const auto camera = open_camera("video:" + file(grey_video(64, 48, 3)).string() + ",width=2");
    EXPECT_EQ(camera->info().name, "scope");
    EXPECT_EQ(camera->info().frames_per_second, 50);
    ASSERT_TRUE(is_screen(camera->info().calibration));
    EXPECT_NEAR(screen_place(camera->info().calibration).height_m, 1.5, 1e-9);
    Capture capture = camera->next(10s);
    ASSERT_EQ(capture.kind, Capture::Kind::frame) << capture.problem;
    EXPECT_EQ(capture.frame->depth.size, screen_grid);
    EXPECT_EQ(capture.frame->depth.pixels.front(), screen_distance_mm);
    ASSERT_EQ(capture.frame->color.size, (Size{64, 48}));
    // 16 is black and 235 white.
    const Rgb pixel = capture.frame->color.pixels.view().row(47)[63];
    EXPECT_NEAR(pixel.g, (50 + 10 * int(capture.frame->number) - 16) * 255 / 219, 2);
    EXPECT_EQ(pixel.r, pixel.g);
    while (capture.kind == Capture::Kind::frame || capture.kind == Capture::Kind::nothing)
        capture = camera->next(10s);
    EXPECT_EQ(capture.kind, Capture::Kind::end) << capture.problem;
}

TEST_F(VideoCamera, AVideoInALoopGoesOn) {
    const auto camera = open_camera("video:" + file(grey_video(16, 16, 2)).string() + ",loop=1");
    for (int n = 0; n < 5; ++n)
        EXPECT_EQ(camera->next(10s).kind, Capture::Kind::frame);
}

TEST_F(VideoCamera, AFileThatIsNoVideoIsRefusedWithASentence) {
    EXPECT_THAT(problem_with("no video"), HasSubstr("is no video that FFmpeg reads"));
    EXPECT_THAT(problem_with(""), HasSubstr("is no video that FFmpeg reads"));
    EXPECT_THAT(problem_with(grey_video(16, 16, 0)), HasSubstr("no picture"));
    EXPECT_THAT(problem_with(grey_video(16, 16, 1).substr(0, 100)), HasSubstr("no picture"));
    EXPECT_THAT(problem_with("YUV4MPEG2 W60000 H60000 F50:1 C444\nFRAME\n"), HasSubstr("scope"));
    EXPECT_THAT(problem_with(grey_video(16, 16, 2), ",start=7"), ::testing::IsEmpty());
    EXPECT_THAT(problem_with(grey_video(16, 16, 2), ",width=0"), HasSubstr("width"));
}

// A playlist cannot make the reader open another file.
TEST_F(VideoCamera, APlaylistOpensNoOtherFile) {
    std::ofstream(folder_.path() / "other.y4m", std::ios::binary) << grey_video(16, 16, 3);
    const std::string other = (folder_.path() / "other.y4m").string();
    EXPECT_NE(problem_with("ffconcat version 1.0\nfile '" + other + "'\n"), "");
    EXPECT_NE(problem_with("#EXTM3U\n#EXTINF:1,\n" + other + "\n#EXT-X-ENDLIST\n"), "");
}

TEST_F(VideoCamera, DamagedFilesHarmOnlyTheirReader) {
    std::mt19937 random(7);
    const std::string video = grey_video(16, 16, 2);
    for (int n = 0; n < 20; ++n) {
        std::string damaged = video;
        for (int i = 0; i < 4; ++i)
            damaged[random() % 80] = char(random());
        try {
            const auto camera = open_camera("video:" + file(damaged).string());
            (void)camera->next(100ms);
        } catch (const Error& error) {
            EXPECT_THAT(error.what(), HasSubstr("scope.y4m"));
        }
    }
}

TEST(VideoAnswer, PicturesFitIntoTheSharedMemory) {
    const VideoAnswer good{VideoAnswer::Kind::opened, {}, {640, 480}, 30};
    const auto read = decode_video_answer(encode(good), video_bytes(good.size));
    ASSERT_TRUE(read);
    EXPECT_EQ(read->size, good.size);
    EXPECT_EQ(decode_video_answer(encode(good), video_bytes(good.size) - 1).error(),
              Status::too_large);
    for (const Size size : {Size{0, 0}, Size{-1, -1}, Size{1 << 30, 1 << 30}})
        EXPECT_FALSE(decode_video_answer(encode(VideoAnswer{good.kind, {}, size, 30}), 1 << 25));
    EXPECT_FALSE(decode_video_answer(encode(VideoAnswer{VideoAnswer::Kind(17), {}, {}, 30}), 1000));
    EXPECT_FALSE(decode_video_answer({}, 1000));
}

}  // namespace
}  // namespace theatron::capture
