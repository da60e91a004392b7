// SPDX-License-Identifier: Apache-2.0
#include "capture/face_camera.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "base/error.h"
#include "geometry/screen.h"
#include "session/own_pictures.h"
#include "testing/temporary_folder.h"

namespace theatron::capture {
namespace {

constexpr Rgb red{200, 0, 0}, blue{0, 0, 200}, grey{100, 100, 100};

ColorImage bands(Size size, int left, int right) {
    ColorImage image(size);
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x)
            image.view().row(y)[x] = x < left ? red : x < right ? grey : blue;
    return image;
}

TEST(FitMiddle, KeepsTheMiddleOfAWidePicture) {
    // 16:9 in 4:3: an eighth of the width goes on each side.
    const ColorImage wide = bands({640, 360}, 80, 560);
    ColorImage out(face_picture);
    fit_middle(wide.view(), out.view());
    for (const Rgb& pixel : out.pixels)
        ASSERT_EQ(pixel, grey);
}

TEST(FitMiddle, KeepsTheMiddleOfATallPicture) {
    ColorImage tall({30, 80});
    for (std::size_t i = 0; i < tall.pixels.size(); ++i)
        tall.pixels[i] = i / 30 < 29 || i / 30 >= 51 ? red : grey;
    ColorImage out(face_picture);
    fit_middle(tall.view(), out.view());
    for (const Rgb& pixel : out.pixels)
        ASSERT_EQ(pixel, grey);
}

TEST(FitMiddle, MeansWhatAPixelCovers) {
    ColorImage image({8, 6});
    for (std::size_t i = 0; i < image.pixels.size(); ++i)
        image.pixels[i] = i % 2 ? Rgb{200, 100, 0} : Rgb{100, 0, 0};
    ColorImage out({4, 3});
    fit_middle(image.view(), out.view());
    for (const Rgb& pixel : out.pixels)
        EXPECT_EQ(pixel, (Rgb{150, 50, 0}));
}

TEST(FitMiddle, AcceptsAnySize) {
    for (const Size size : {Size{1, 1}, Size{1, 7}, Size{7, 1}, Size{319, 241}, Size{3, 1000}}) {
        ColorImage image(size), out(face_picture);
        std::fill(image.pixels.begin(), image.pixels.end(), grey);
        fit_middle(image.view(), out.view());
        EXPECT_EQ(out.pixels.front(), grey);
        EXPECT_EQ(out.pixels.back(), grey);
    }
}

TEST(FaceCamera, TheGeneratedOneIsWithinTheHostsLimits) {
    const auto camera = open_camera("face:test");
    EXPECT_TRUE(session::is_within(session::face_limits, camera->info().calibration,
                                   camera->info().frames_per_second));
    const Capture first = camera->next(1s);
    ASSERT_EQ(first.kind, Capture::Kind::frame);
    EXPECT_EQ(first.frame->depth.size, screen_grid);
    const ColorView picture = first.frame->color.pixels.view();
    EXPECT_GT(picture.row(10)[10].r, 200) << "left";
    EXPECT_GT(picture.row(10)[310].b, 200) << "right";
    const Capture second = camera->next(1s);
    ASSERT_EQ(second.kind, Capture::Kind::frame);
    EXPECT_NE(second.frame->color.pixels, first.frame->color.pixels) << "it moves";
    EXPECT_GE(second.frame->times.captured - first.frame->times.captured, 60ms);
}

TEST(FaceCamera, AVideoIsMadeSmallAndSlow) {
    const testing::TemporaryFolder folder;
    const std::filesystem::path path = folder.path() / "me.y4m";
    std::ofstream file(path, std::ios::binary);
    file << "YUV4MPEG2 W64 H36 F60:1 Ip A1:1 C444 XCOLORRANGE=LIMITED\n";
    for (int n = 0; n < 30; ++n)
        file << "FRAME\n"
             << std::string(64 * 36, char(60 + 5 * n)) << std::string(2 * 64 * 36, char(128));
    file.close();
    const auto camera = open_camera("face:" + path.string());
    EXPECT_TRUE(session::is_within(session::face_limits, camera->info().calibration,
                                   camera->info().frames_per_second));
    std::optional<TimePoint> last;
    for (int n = 0; n < 4; ++n) {
        const Capture capture = camera->next(2s);
        ASSERT_EQ(capture.kind, Capture::Kind::frame) << capture.problem;
        EXPECT_EQ(capture.frame->number, FrameNumber(n));
        EXPECT_EQ(capture.frame->color.pixels.size, face_picture);
        if (last) {
            EXPECT_GE(capture.frame->times.captured - *last, 50ms);
        }
        last = capture.frame->times.captured;
    }
}

TEST(FaceCamera, WhatIsNoneIsRefusedWithASentence) {
    EXPECT_THROW(open_camera("face:"), Error);
    EXPECT_THROW(open_camera("face:/dev/theatron-has-no-such-device"), Error);
    EXPECT_THROW(open_camera("face:test,size=9x9"), Error);
}

}  // namespace
}  // namespace theatron::capture
