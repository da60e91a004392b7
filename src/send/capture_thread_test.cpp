// SPDX-License-Identifier: Apache-2.0
#include "send/capture_thread.h"

#include <gtest/gtest.h>

#include <condition_variable>

namespace theatron::send {
namespace {

using capture::Trouble;
using capture::WatchedCamera;

// A driver whose calls return only after release.
class Driver {
public:
    void enter() {
        std::unique_lock lock(mutex_);
        entered_ = true;
        changed_.notify_all();
        changed_.wait(lock, [this] { return open_; });
    }
    void wait_until_entered() {
        std::unique_lock lock(mutex_);
        changed_.wait(lock, [this] { return entered_; });
    }
    void let_go() {
        const std::lock_guard lock(mutex_);
        open_ = true;
        changed_.notify_all();
    }

private:
    std::mutex mutex_;
    std::condition_variable changed_;
    bool entered_ = false, open_ = false;
};

class HangingCamera final : public capture::Camera {
public:
    explicit HangingCamera(Driver& driver) : driver_(driver) { info_.live = true; }
    const capture::CameraInfo& info() const override { return info_; }
    capture::Capture next(Duration) override {
        driver_.enter();
        return {};
    }

private:
    Driver& driver_;
    capture::CameraInfo info_;
};

TEST(CaptureThread, ADriverHangsOnlyWhileTheProcessRuns) {
    Driver driver;
    std::atomic<std::int64_t> now_us = 1'000'000;
    capture::Clock clock{[&] { return from_us(now_us); },
                         [](Duration) { std::this_thread::yield(); }};
    CaptureThread thread(
        std::make_unique<HangingCamera>(driver),
        [&] { return std::make_unique<HangingCamera>(driver); }, [](const FramePtr&) {}, clock);
    driver.wait_until_entered();
    EXPECT_NE(thread.look().trouble, Trouble::gone);

    // The process was stopped and continued, or the machine slept: no call of look() meanwhile.
    now_us += 10 * to_us(from_us(0) + WatchedCamera::longest_call);
    EXPECT_NE(thread.look().trouble, Trouble::gone);

    constexpr Duration between_looks = 20ms;
    const auto looks = WatchedCamera::longest_call / between_looks;
    for (int i = 0; i < looks; ++i) {
        now_us += between_looks.count();
        EXPECT_NE(thread.look().trouble, Trouble::gone) << i;
    }
    now_us += between_looks.count();
    EXPECT_EQ(thread.look().trouble, Trouble::gone);
    driver.let_go();
}

}  // namespace
}  // namespace theatron::send
