// SPDX-License-Identifier: Apache-2.0
#include "host/gain_watch.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <condition_variable>

#include "base/steady_clock.h"
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
    frame->times.captured = steady_now();
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

// Takes a few seconds, since the watch does nothing most of the time.
TEST(GainWatch, PublishesGainsOnceTheyHaveSettledAndLeavesThoseOfAFile) {
    capture::CameraInfo known = camera_at(0.6), apart = camera_at(0);
    known.calibration.color_gain = {1, 1, 1.25};
    apart.calibration.registered = false;
    std::mutex mutex;
    std::condition_variable changed;
    std::optional<SettledGains::Gains> published;
    GainWatch watch({camera_at(0), camera_at(0.3), known, apart},
                    [&](const SettledGains::Gains& gains) {
                        {
                            const std::lock_guard lock(mutex);
                            published = gains;
                        }
                        changed.notify_all();
                    });
    std::unique_lock lock(mutex);
    while (!published) {
        lock.unlock();
        watch.offer(0, frame_of(100));
        watch.offer(1, as_jpeg(frame_of(144)));
        watch.offer(2, frame_of(120));
        watch.offer(3, frame_of(50));
        lock.lock();
        changed.wait_for(lock, std::chrono::milliseconds(30),
                         [&] { return published.has_value(); });
    }
    const SettledGains::Gains gains = *published;
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
