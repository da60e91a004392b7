// SPDX-License-Identifier: Apache-2.0
#include "capture/cropped_camera.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "base/error.h"
#include "capture/crop.h"
#include "testing/shared_data.h"
#include "video/color_codec.h"

namespace theatron::capture {
namespace {

using ::testing::HasSubstr;

Calibration two_lenses() {
    Calibration c;
    c.depth = pinhole({64, 56}, 70);
    c.depth.k = {0.1, -0.02, 0, 0, 0, 0};
    c.depth.cx += 1.3;
    c.color = pinhole({320, 180}, 90);
    c.color.cy -= 2.7;
    c.color_from_depth.translation = {-0.03, 0.002, 0.004};
    return c;
}

// Each pixel encodes its position.
class PatternCamera final : public Camera {
public:
    explicit PatternCamera(bool as_jpeg = false, bool has_color = true) {
        info_.name = "pattern";
        info_.calibration = two_lenses();
        frame_->number = 5;
        frame_->times.captured = from_us(77);
        frame_->depth = DepthImage({64, 56});
        for (int y = 0; y < 56; ++y)
            for (int x = 0; x < 64; ++x)
                frame_->depth.view().row(y)[x] = std::uint16_t(1000 + y * 64 + x);
        if (!has_color) {
            info_.calibration.color = {};
            return;
        }
        ColorData& color = frame_->color;
        color.size = {320, 180};
        color.pixels = ColorImage(color.size);
        for (int y = 0; y < 180; ++y)
            for (int x = 0; x < 320; ++x)
                color.pixels.view().row(y)[x] = {std::uint8_t(x * 0.79), std::uint8_t(y * 1.4),
                                                 std::uint8_t(128 + 60 * std::sin(x * 0.1))};
        if (as_jpeg) {
            const auto encoder = video::make_color_encoder(
                video::parse_color_setting("jpeg:quality=95,subsampling=444").setting);
            const auto encoded = encoder->encode(color, true);
            color.jpeg.assign(encoded->bytes.begin(), encoded->bytes.end());
            color.pixels = {};
        }
    }
    const CameraInfo& info() const override { return info_; }
    Capture next(Duration) override { return {Capture::Kind::frame, frame_, ""}; }

    CameraInfo info_;
    std::shared_ptr<Frame> frame_ = std::make_shared<Frame>();
};

std::unique_ptr<Camera> open(const CropOptions& options, bool as_jpeg = false) {
    return make_cropped_camera(std::make_unique<PatternCamera>(as_jpeg), options);
}

ColorImage pixels_of(const ColorData& color) {
    if (!color.is_jpeg())
        return color.pixels;
    const auto decoder = video::make_color_decoder(video::ColorCodecId::jpeg);
    EXPECT_EQ(decoder->submit(color.jpeg, 0), Status::ok);
    return decoder->poll()->image;
}

std::string problem_of(const CropOptions& options) {
    try {
        (void)open(options);
    } catch (const Error& problem) {
        return problem.what();
    }
    return "";
}

TEST(Crop, IsReadFromItsText) {
    EXPECT_EQ(parse_crop("50:60:540x476"), (Crop{50, 60, {540, 476}}));
    for (const char* wrong : {"", "50:60", "50:60:540", "50:60:540x476x", "-1:0:2x2", "1:1:0x5",
                              "1:1:9000x5", "a:b:cxd", "1 :1:2x2"})
        EXPECT_FALSE(parse_crop(wrong)) << wrong;
}

TEST(CroppedCamera, APointInSpaceIsSeenInTheSamePlaceOfTheScene) {
    PatternCamera before;
    const auto camera = open({"10:8:40x41", "33:20:150x140", ""});
    const Calibration& a = before.info_.calibration;
    const Calibration& b = camera->info().calibration;
    const FramePtr frame = camera->next({}).frame;
    EXPECT_EQ(frame->number, 5u);
    EXPECT_EQ(frame->times.captured, from_us(77));
    ASSERT_EQ(frame->depth.size, (Size{40, 41}));
    EXPECT_EQ(b.depth.size, frame->depth.size);
    EXPECT_EQ(b.color.size, frame->color.size);
    for (const int y : {0, 20, 40})
        for (const int x : {0, 17, 39}) {
            const auto ray = unproject(b.depth, {double(x), double(y)});
            ASSERT_TRUE(ray);
            const Vec3 point = Vec3{ray->x, ray->y, 1} * 1.5;
            const auto old_pixel = project(a.depth, point);
            EXPECT_NEAR(old_pixel->x, x + 10, 1e-6);
            EXPECT_NEAR(old_pixel->y, y + 8, 1e-6);
            EXPECT_EQ(frame->depth.view().row(y)[x],
                      before.frame_->depth.view().row(y + 8)[x + 10]);

            const auto old_color = project(a.color, a.color_from_depth * point);
            const auto new_color = project(b.color, b.color_from_depth * point);
            const int u = int(std::lround(new_color->x)), v = int(std::lround(new_color->y));
            if (u < 0 || v < 0 || u >= b.color.size.width || v >= b.color.size.height)
                continue;
            EXPECT_EQ(frame->color.pixels.view().row(v)[u],
                      before.frame_->color.pixels.view().row(
                          int(std::lround(old_color->y)))[int(std::lround(old_color->x))]);
        }
}

TEST(CroppedCamera, JpegIsCroppedWithoutDecodingOnBlocks) {
    const auto camera = open({"", "37:20:150x131", ""}, true);
    EXPECT_EQ(camera->info().calibration.color.size, (Size{155, 135}));
    const FramePtr frame = camera->next({}).frame;
    ASSERT_TRUE(frame->color.is_jpeg());
    EXPECT_EQ(frame->color.size, (Size{155, 135}));
    PatternCamera before(true);
    const ColorImage whole = pixels_of(before.frame_->color), part = pixels_of(frame->color);
    ASSERT_EQ(part.size, (Size{155, 135}));
    for (int y = 0; y < 135; ++y)
        for (int x = 0; x < 155; ++x)
            ASSERT_EQ(part.view().row(y)[x], whole.view().row(y + 16)[x + 32]) << x << " " << y;
}

TEST(CroppedCamera, ADamagedPictureIsLeftOutAndItsDepthIsNot) {
    auto inner = std::make_unique<PatternCamera>(true);
    inner->frame_->color.jpeg.resize(200);
    const auto camera = make_cropped_camera(std::move(inner), {"", "16:16:64x64", ""});
    const FramePtr frame = camera->next({}).frame;
    EXPECT_TRUE(frame->color.empty());
    EXPECT_EQ(frame->depth.size, (Size{64, 56}));
}

TEST(CroppedCamera, AutoKeepsAllColorThatDepthCanSee) {
    const auto camera = open({"8:8:48x40", "auto", ""});
    const Calibration& c = camera->info().calibration;
    const Size whole = two_lenses().color.size;
    EXPECT_LT(c.color.size.area(), whole.area());
    for (const double z : {0.3, 0.45, 0.7, 1.0, 1.5, 2.3, 3.4, 5.1, 7.7})
        for (int y = 0; y < c.depth.size.height; ++y)
            for (int x = 0; x < c.depth.size.width; ++x) {
                const auto ray = unproject(c.depth, {double(x), double(y)});
                const Vec3 point = c.color_from_depth * Vec3{ray->x * z, ray->y * z, z};
                const auto old_pixel = project(two_lenses().color, point);
                const bool was_seen = old_pixel->x >= 0 && old_pixel->y >= 0 &&
                                      old_pixel->x <= whole.width - 1 &&
                                      old_pixel->y <= whole.height - 1;
                const auto pixel = project(c.color, point);
                const bool is_seen = pixel->x >= 0 && pixel->y >= 0 &&
                                     pixel->x <= c.color.size.width - 1 &&
                                     pixel->y <= c.color.size.height - 1;
                ASSERT_EQ(is_seen, was_seen) << x << " " << y << " " << z;
            }
}

TEST(CroppedCamera, ScaledColorShowsTheSameScene) {
    const auto camera = open({"", "", "160x90"}, true);
    const FramePtr frame = camera->next({}).frame;
    ASSERT_EQ(frame->color.size, (Size{160, 90}));
    EXPECT_FALSE(frame->color.is_jpeg());
    const CameraModel big = two_lenses().color, small = camera->info().calibration.color;
    const Vec3 point{0.1, -0.05, 1};
    const auto a = project(big, point), b = project(small, point);
    EXPECT_NEAR((a->x + 0.5) / 2, b->x + 0.5, 1e-9);
    const Rgb there = frame->color.pixels.view().row(int(b->y))[int(b->x)];
    EXPECT_NEAR(there.r, a->x * 0.79, 3);
    EXPECT_NEAR(there.g, a->y * 1.4, 3);
}

TEST(CroppedCamera, ColorAsFineAsDepthHasItsFocalLength) {
    const auto camera = open({"", "", "depth"});
    const Calibration& c = camera->info().calibration;
    EXPECT_NEAR(c.color.fx, c.depth.fx, 0.01 * c.depth.fx);
}

TEST(CroppedCamera, WrongPartsAreNamed) {
    EXPECT_THAT(problem_of({"8:8", "", ""}), HasSubstr("crop=8:8 is not X:Y:WxH"));
    EXPECT_THAT(problem_of({"30:8:40x40", "", ""}), HasSubstr("beyond the picture of 64x56"));
    EXPECT_THAT(problem_of({"", "0:0:321x4", ""}), HasSubstr("color_crop=0:0:321x4"));
    EXPECT_THAT(problem_of({"", "", "640x360"}), HasSubstr("larger than the colour there is"));
    EXPECT_THAT(problem_of({"", "", "big"}), HasSubstr("not WIDTHxHEIGHT or depth"));
    try {
        (void)make_cropped_camera(std::make_unique<PatternCamera>(false, false), {"", "auto", ""});
        FAIL();
    } catch (const Error& problem) {
        EXPECT_THAT(problem.what(), HasSubstr("no colour"));
    }
}

TEST(ScaleByArea, KeepsTheMeanAndEqualPictures) {
    ColorImage image({7, 5});
    for (std::size_t i = 0; i < image.pixels.size(); ++i)
        image.pixels[i] = {std::uint8_t(i * 7), 255, 0};
    ColorImage same({7, 5}), one({1, 1});
    scale_by_area(image.view(), same.view());
    EXPECT_EQ(same, image);
    scale_by_area(image.view(), one.view());
    EXPECT_NEAR(one.pixels[0].r, 119, 1);
    EXPECT_EQ(one.pixels[0].g, 255);
    EXPECT_EQ(one.pixels[0].b, 0);
}

TEST(CroppedCamera, EveryKindOfCameraUnderstandsIt) {
    THEATRON_REQUIRE_DATA("table-person_640x360");
    const auto camera =
        open_camera("folder:" + (testing::shared_data() / "table-person_640x360").string() +
                    ",preload=0,crop=50:20:540x320,color_crop=auto");
    const Capture capture = camera->next(std::chrono::seconds(5));
    ASSERT_EQ(capture.kind, Capture::Kind::frame);
    EXPECT_EQ(capture.frame->depth.size, (Size{540, 320}));
    EXPECT_TRUE(capture.frame->color.is_jpeg());
    EXPECT_LT(capture.frame->color.size.area(), 640u * 360u);
}

}  // namespace
}  // namespace theatron::capture
