// SPDX-License-Identifier: Apache-2.0
#include "host/gain_watch.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>

#include "testing/manual_clock.h"
#include "testing/wait_until.h"
#include "video/color_codec.h"

namespace theatron::host {
namespace {

constexpr Size pixels{160, 120};

capture::CameraInfo camera_at(double x) {
    capture::CameraInfo info;
    Calibration& c = info.calibration;
    c.depth = c.color = pinhole(pixels, 75);
    c.registered = true;
    c.room_from_camera.translation = {x, 1.5, 0};
    return info;
}

// A wall of one colour.
std::shared_ptr<Frame> frame_of(std::uint8_t grey) {
    auto frame = std::make_shared<Frame>();
    frame->depth.resize(pixels);
    std::fill(frame->depth.pixels.begin(), frame->depth.pixels.end(), std::uint16_t(2000));
    frame->color.size = pixels;
    frame->color.pixels.resize(pixels);
    std::fill(frame->color.pixels.pixels.begin(), frame->color.pixels.pixels.end(),
              Rgb{grey, grey, grey});
    return frame;
}

std::shared_ptr<Frame> as_jpeg(std::shared_ptr<Frame> frame) {
    const auto encoder =
        video::make_color_encoder(video::parse_color_setting("jpeg:quality=95").setting);
    const auto encoded = encoder->encode(frame->color, true);
    frame->color.jpeg.assign(encoded->bytes.begin(), encoded->bytes.end());
    frame->color.pixels = {};
    return frame;
}

TEST(GainWatch, PublishesGainsOnceTheyHaveSettledAndLeavesThoseOfAFile) {
    capture::CameraInfo known = camera_at(0.6), apart = camera_at(0);
    known.calibration.color_gain = {1, 1, 1.25};
    apart.calibration.registered = false;
    testing::ManualClock clock;
    std::atomic<bool> has_published = false;
    SettledGains::Gains gains;
    GainWatch watch(
        {camera_at(0), camera_at(0.3), known, apart},
        [&](const SettledGains::Gains& settled) {
            if (!has_published)
                gains = settled;
            has_published = true;
        },
        [&] { return clock.now(); });
    const std::vector<std::shared_ptr<Frame>> pictures{frame_of(100), as_jpeg(frame_of(144)),
                                                       frame_of(120), frame_of(50)};
    // The watch takes a picture of each camera, and does nothing for most of the time, which passes
    // as soon as it has taken them.
    testing::wait_until([&] {
        clock.pass(100ms);
        for (std::size_t camera = 0; camera < pictures.size(); ++camera) {
            const auto frame = std::make_shared<Frame>(*pictures[camera]);
            frame->times.captured = clock.now();
            watch.offer(camera, frame);
        }
        return has_published.load();
    });
    ASSERT_EQ(gains.size(), 4u);
    ASSERT_TRUE(gains[0] && gains[1]);
    EXPECT_NEAR(gains[0]->x, 1.2, 0.02);
    EXPECT_NEAR(gains[0]->z, 1.2 * 1.25, 0.03);
    EXPECT_NEAR(gains[1]->y, 120 / 144.0, 0.02);
    EXPECT_FALSE(gains[2]);
    EXPECT_FALSE(gains[3]);

    const GainWatch::Gains now = watch.gains();
    ASSERT_TRUE(now[0] && now[1] && now[2]);
    EXPECT_EQ(now[0]->factors, *gains[0]);
    EXPECT_TRUE(now[0]->is_estimated);
    EXPECT_EQ(now[2]->factors, (Vec3{1, 1, 1.25}));
    EXPECT_FALSE(now[2]->is_estimated);
    EXPECT_FALSE(now[3]);
}

}  // namespace
}  // namespace theatron::host
