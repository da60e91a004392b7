// SPDX-License-Identifier: Apache-2.0
// Counts what a running lane allocates.
#include <gtest/gtest.h>

#include <atomic>
#include <random>

#include "base/steady_clock.h"
#include "image/frame_pool.h"
#include "send/camera_lane.h"
#include "testing/counted_allocations.h"

namespace theatron::send {
namespace {

constexpr Size size{160, 120};

// Noise at full speed, in pooled frames.
class NoisyCamera final : public capture::Camera {
public:
    NoisyCamera() {
        info_.calibration.depth = pinhole(size, 60);
        info_.frames_per_second = 200;
    }
    const capture::CameraInfo& info() const override { return info_; }
    capture::Capture next(Duration) override {
        std::this_thread::sleep_for(5ms);
        const auto frame = pool_.take();
        frame->depth.resize(size);
        frame->color.size = size;
        frame->color.pixels.resize(size);
        for (auto& pixel : frame->depth.pixels)
            pixel = std::uint16_t(1500 + rng_() % 16);
        for (auto& pixel : frame->color.pixels.pixels)
            pixel = {std::uint8_t(rng_() % 64), 80, 90};
        frame->times = {};
        frame->times.captured = frame->times.delivered = steady_now();
        return {.kind = capture::Capture::Kind::frame, .frame = frame, .problem = {}};
    }

private:
    capture::CameraInfo info_;
    FramePool pool_;
    std::minstd_rand rng_;
};

TEST(LaneMemory, ARunningLaneAllocatesNoPictures) {
    if (!testing::counts_allocations)
        GTEST_SKIP() << testing::counts_none;
    // One thread: each makes its scratch memory with its first frame, which may come late.
    Workers workers(1);
    std::atomic<std::uint64_t> messages{0};
    CameraLane::Events events;
    events.media = [&](const EncodedMedia&) { ++messages; };
    events.state = [](const wire::CameraState&) {};
    CameraLane lane(CameraId{0}, std::make_unique<NoisyCamera>(), events, workers,
                    CameraLane::Options{});
    lane.set_filter(filter::parse_chain("default").settings, nullptr);
    lane.set_settings({{SettingId{1}, "strata"}, {SettingId{2}, "trvl"}},
                      {{SettingId{3}, "jpeg:quality=85"}});
    const auto wait_for = [&](std::uint64_t count) {
        const std::uint64_t before = messages;
        for (int i = 0; i < 20'000 && messages < before + count; ++i)
            std::this_thread::sleep_for(1ms);
        return messages - before;
    };
    ASSERT_GE(wait_for(150), 150u);
    // A hundred frames, each of several pictures and messages.
    using testing::allocations, testing::large_allocations;
    allocations = large_allocations = 0;
    testing::counting = true;
    const std::uint64_t made = wait_for(300);
    testing::counting = false;
    ASSERT_GE(made, 300u);
    // One picture allocated per frame would make a hundred. On a slow machine a setting may be
    // found dear meanwhile, and the thread that encodes it behind then makes its scratch memory.
    EXPECT_LE(large_allocations, 10u);
    EXPECT_LE(double(allocations) / double(made), 4);
    std::printf("%llu allocations, %llu of them large, for %llu messages\n",
                static_cast<unsigned long long>(allocations),
                static_cast<unsigned long long>(large_allocations),
                static_cast<unsigned long long>(made));
}

}  // namespace
}  // namespace theatron::send
