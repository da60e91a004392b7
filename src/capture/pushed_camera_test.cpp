// SPDX-License-Identifier: Apache-2.0
#include "capture/pushed_camera.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace theatron::capture {
namespace {

using ::testing::HasSubstr;

constexpr Size size{4, 3};

std::shared_ptr<PushedFrames> make_frames() {
    CameraInfo info{"pushed", {}, 30};
    info.calibration.depth = info.calibration.color = pinhole(size, 60);
    return std::make_shared<PushedFrames>(info);
}

std::shared_ptr<Frame> frame(Size depth, Size color = {}) {
    auto f = std::make_shared<Frame>();
    f->depth = DepthImage(depth);
    f->color.pixels = ColorImage(color);
    return f;
}

TEST(PushedCamera, GivesTheNewestFrameAndThenNone) {
    const auto frames = make_frames();
    const auto camera = make_pushed_camera(frames);
    EXPECT_EQ(camera->next(0us).kind, Capture::Kind::nothing);
    EXPECT_EQ(frames->push(frame(size), from_us(10)), "");
    EXPECT_EQ(frames->push(frame(size, size), from_us(20)), "");
    const Capture capture = camera->next(0us);
    ASSERT_EQ(capture.kind, Capture::Kind::frame);
    EXPECT_EQ(capture.frame->number, 1u);
    EXPECT_EQ(capture.frame->times.captured, from_us(20));
    EXPECT_EQ(capture.frame->color.size, size);
    EXPECT_EQ(frames->replaced(), 1u);
    EXPECT_EQ(camera->next(0us).kind, Capture::Kind::nothing);
}

TEST(PushedCamera, RefusesWhatIsNotAsItsCalibrationSays) {
    const auto frames = make_frames();
    const auto camera = make_pushed_camera(frames);
    EXPECT_THAT(frames->push(frame({3, 4}), from_us(1)), HasSubstr("Depth is 3x4"));
    EXPECT_THAT(frames->push(frame(size, {3, 4}), from_us(1)), HasSubstr("Colour is 3x4"));
    auto damaged = frame(size);
    damaged->color.jpeg = Bytes(10);
    EXPECT_THAT(frames->push(damaged, from_us(1)), HasSubstr("JPEG"));
    EXPECT_EQ(frames->push(frame(size), from_us(5)), "");
    EXPECT_THAT(frames->push(frame(size), from_us(5)), HasSubstr("captured after"));
    EXPECT_EQ(camera->next(0us).frame->times.captured, from_us(5));
}

TEST(PushedCamera, EndsAfterItsLastFrame) {
    const auto frames = make_frames();
    const auto camera = make_pushed_camera(frames);
    frames->push(frame(size), from_us(1));
    frames->end();
    EXPECT_EQ(camera->next(0us).kind, Capture::Kind::frame);
    EXPECT_EQ(camera->next(0us).kind, Capture::Kind::end);
    frames->end("The driver is gone.");
    const Capture failed = camera->next(0us);
    EXPECT_EQ(failed.kind, Capture::Kind::failed);
    EXPECT_EQ(failed.problem, "The driver is gone.");
}

}  // namespace
}  // namespace theatron::capture
