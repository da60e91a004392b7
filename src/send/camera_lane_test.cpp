// SPDX-License-Identifier: Apache-2.0
#include "send/camera_lane.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <deque>
#include <semaphore>

#include "codec/depth_stream.h"
#include "testing/manual_clock.h"
#include "video/color_codec.h"

namespace theatron::send {
namespace {

constexpr Size size{16, 12};

// Time that passes when the test says so, not while somebody sleeps.
class LaneClock : public testing::ManualClock {
public:
    capture::Clock clock() {
        return {[this] { return read(); }, [](Duration) { std::this_thread::yield(); }};
    }
    // Calls `then` once, between the next reading of the clock and the use of what was read.
    void after_next_reading(std::function<void()> then) {
        then_ = std::move(then);
        has_then_ = true;
    }

private:
    TimePoint read() {
        const TimePoint read = now();
        if (has_then_.exchange(false))
            then_();
        return read;
    }

    std::function<void()> then_;
    std::atomic<bool> has_then_ = false;
};

// Hands over frames when the test says so.
class ManualCamera final : public capture::Camera {
public:
    struct Script {
        LaneClock clock;
        std::mutex mutex;
        std::condition_variable changed;
        std::deque<capture::Capture> waiting;
        int handed_over = 0;  // frames that the lane has; counted when it asks for the next one
        bool last_on_its_way = false;

        void give(capture::Capture capture) {
            {
                const std::lock_guard lock(mutex);
                waiting.push_back(std::move(capture));
            }
            changed.notify_all();
        }
        void give_frame(std::uint16_t value) {
            auto frame = std::make_shared<Frame>();
            frame->depth = DepthImage(size);
            frame->depth.pixels.assign(size.area(), value);
            frame->color.size = size;
            frame->color.pixels = ColorImage(size);
            send_now(frame);
        }
        // As far behind the one before as those of a camera are.
        void send_now(const std::shared_ptr<Frame>& frame) {
            clock.pass(33ms);
            frame->times.captured = frame->times.delivered = clock.now();
            give({capture::Capture::Kind::frame, frame, ""});
        }
        // Returns when the lane has taken `frames` since the beginning.
        void wait_until_taken(int frames) {
            std::unique_lock lock(mutex);
            changed.wait(lock, [&] { return handed_over >= frames; });
        }
    };

    explicit ManualCamera(std::shared_ptr<Script> script) : script_(std::move(script)) {
        info_.name = "manual";
        info_.calibration.depth = pinhole(size, 60);
    }
    const capture::CameraInfo& info() const override { return info_; }
    bool skip_none() override { return true; }
    capture::Capture next(Duration timeout) override {
        std::unique_lock lock(script_->mutex);
        if (std::exchange(script_->last_on_its_way, false)) {
            ++script_->handed_over;
            script_->changed.notify_all();
        }
        script_->changed.wait_for(lock, timeout, [&] { return !script_->waiting.empty(); });
        if (script_->waiting.empty())
            return {};
        capture::Capture capture = script_->waiting.front();
        if (capture.kind == capture::Capture::Kind::frame) {
            script_->waiting.pop_front();
            script_->last_on_its_way = true;
        }
        return capture;
    }

private:
    std::shared_ptr<Script> script_;
    capture::CameraInfo info_;
};

// Encodes a picture when the test says so.
class GatedColor final : public video::ColorEncoder {
public:
    using Gate = std::shared_ptr<std::counting_semaphore<>>;
    explicit GatedColor(Gate gate) : gate_(std::move(gate)) {}
    Result<video::EncodedColor> encode(const ColorData&, bool) override {
        gate_->acquire();
        return video::EncodedColor{bytes_};
    }

private:
    const Gate gate_;
    const Bytes bytes_ = Bytes(8);
};

// A lane with everything that it published.
class Lane : public ::testing::Test {
protected:
    Lane() { open({}); }
    // With these options, but for the clock.
    void open(CameraLane::Options options) {
        lane.reset();
        CameraLane::Events events;
        events.media = [this](EncodedMedia media) {
            const std::lock_guard lock(mutex);
            published.push_back(std::move(media));
            changed.notify_all();
        };
        events.state = [this](wire::CameraState state) {
            const std::lock_guard lock(mutex);
            states.push_back(std::move(state));
            changed.notify_all();
        };
        options.clock = script->clock.clock();
        lane = std::make_unique<CameraLane>(CameraId{3}, std::make_unique<ManualCamera>(script),
                                            events, workers, std::move(options));
    }
    // Returns when there are `count` messages.
    void wait_for(std::size_t count) {
        std::unique_lock lock(mutex);
        changed.wait(lock, [&] { return published.size() >= count; });
    }

    std::shared_ptr<ManualCamera::Script> script = std::make_shared<ManualCamera::Script>();
    std::mutex mutex;
    std::condition_variable changed;
    std::vector<EncodedMedia> published;
    std::vector<wire::CameraState> states;
    Workers workers;
    std::unique_ptr<CameraLane> lane;  // last: its threads use what is above
};

TEST_F(Lane, EncodesOncePerSettingBeginningWithKeyFrames) {
    lane->set_settings({{SettingId{1}, "trvl"}, {SettingId{2}, "rvl"}}, {});
    script->give_frame(1000);
    wait_for(2);
    lane->wait_idle();  // else the second encoder may be busy, and leave the next frame out
    script->give_frame(1001);
    wait_for(4);
    const std::lock_guard lock(mutex);
    EXPECT_EQ(published.size(), 4u);
    EXPECT_EQ(published[0].header.setting, SettingId{1});
    EXPECT_TRUE(published[0].header.key);
    EXPECT_EQ(published[1].header.setting, SettingId{2});
    EXPECT_FALSE(published[2].header.key);
    EXPECT_EQ(published[2].header.reference, published[0].header.frame);
    EXPECT_EQ(published[2].header.stream, depth_stream(CameraId{3}));
    EXPECT_GE(published[2].header.encoded, published[2].header.captured);

    // The published images equal those of the camera.
    codec::DepthStreamDecoder decoder(codec::parse_depth_setting("trvl").setting);
    DepthImage image(size);
    for (const int i : {0, 2}) {
        const wire::MediaHeader& h = published[i].header;
        EXPECT_EQ(*wire::parse_media_header(*published[i].message), h);
        ASSERT_EQ(decoder.decode({h.frame, h.reference, h.temporal_layer, h.key},
                                 wire::media_payload(*published[i].message), image.view()),
                  Status::ok);
    }
    EXPECT_EQ(image.pixels[5], 1001);
}

TEST_F(Lane, AStandingCameraAnswersARequestWithItsLastFrame) {
    lane->set_settings({{SettingId{1}, "trvl"}}, {});
    script->give_frame(1000);
    wait_for(1);
    lane->request_key(depth_stream(CameraId{3}), SettingId{1});
    script->clock.pass(1s);
    wait_for(2);
    const std::lock_guard lock(mutex);
    EXPECT_TRUE(published[1].header.key);
    EXPECT_NE(published[1].header.frame, published[0].header.frame);
    EXPECT_EQ(published[1].header.captured, published[0].header.captured);
}

TEST_F(Lane, ANewSettingLeavesTheOthersReferencesAlone) {
    lane->set_settings({{SettingId{1}, "trvl"}}, {});
    script->give_frame(1000);
    wait_for(1);
    lane->set_settings({{SettingId{1}, "trvl"}, {SettingId{2}, "zstd"}}, {});
    wait_for(2);
    lane->wait_idle();
    script->give_frame(1001);
    wait_for(4);
    const std::lock_guard lock(mutex);
    EXPECT_EQ(published[1].header.setting, SettingId{2});
    EXPECT_TRUE(published[1].header.key);
    EXPECT_EQ(published[1].header.frame, published[0].header.frame);
    for (const std::size_t i : {2u, 3u}) {
        EXPECT_EQ(published[i].header.frame, published[0].header.frame + 1) << "none is missing";
        EXPECT_TRUE(published[i].header.setting == SettingId{2} || !published[i].header.key);
    }
}

// Others join again and again, each time with another codec.
TEST_F(Lane, ABystanderGetsTheFramesOfTheCameraAndNoOthers) {
    const auto in = [&](SettingId setting) {
        std::vector<wire::MediaHeader> headers;
        const std::lock_guard lock(mutex);
        for (const EncodedMedia& media : published)
            if (media.header.setting == setting)
                headers.push_back(media.header);
        return headers;
    };
    constexpr SettingId usual{1};
    lane->set_settings({{usual, "trvl"}}, {});
    constexpr int frames = 30;
    int joined = 1;
    for (int n = 0; n < frames; ++n) {
        script->give_frame(std::uint16_t(1000 + n));
        script->wait_until_taken(n + 1);
        lane->wait_idle();
        for (int k = 0; k < 4; ++k) {
            lane->set_settings({{usual, "trvl"}, {SettingId(++joined), "rvl"}}, {});
            lane->wait_idle();
        }
    }
    const auto usual_frames = in(usual);
    ASSERT_EQ(usual_frames.size(), std::size_t(frames));
    for (std::size_t i = 0; i < usual_frames.size(); ++i) {
        EXPECT_EQ(usual_frames[i].key, i == 0);
        EXPECT_EQ(usual_frames[i].frame, i) << "no number is missing";
    }
    // The last one of those who join between two frames gets the next frame in any case.
    std::size_t of_others = 0;
    for (int setting = 2; setting <= joined; ++setting)
        of_others += in(SettingId(setting)).size();
    const auto repeats = std::size_t(frames * 33ms / CameraLane::repeat_interval) + 1;
    EXPECT_LE(of_others, std::size_t(frames - 1) + repeats);
    EXPECT_GE(of_others, std::size_t(frames - 1));
}

TEST_F(Lane, AStandingCameraIsRepeatedAtMostTwiceASecond) {
    lane->set_settings({{SettingId{1}, "trvl"}}, {});
    script->give_frame(1000);
    wait_for(1);
    script->clock.pass(10s);
    int setting = 1;
    const auto join = [&] {
        lane->set_settings({{SettingId{1}, "trvl"}, {SettingId(++setting), "rvl"}}, {});
        lane->wait_idle();
    };
    join();
    wait_for(2);
    for (int k = 0; k < 20; ++k)
        join();
    {
        const std::lock_guard lock(mutex);
        EXPECT_EQ(published.size(), 2u);
    }
    script->clock.pass(CameraLane::repeat_interval);
    wait_for(3);
    lane->wait_idle();
    const std::lock_guard lock(mutex);
    EXPECT_EQ(published[2].header.setting, SettingId(setting));
    EXPECT_TRUE(published[2].header.key);
}

TEST_F(Lane, ARepeatIsNotOlderThanTheOrderThatAskedForIt) {
    lane->set_settings({{SettingId{1}, "trvl"}}, {});
    script->give_frame(1000);
    wait_for(1);
    lane->wait_idle();
    // A receiver comes ten seconds after the clock was read for other work.
    script->clock.after_next_reading([&] {
        script->clock.pass(10s);
        lane->set_settings({{SettingId{1}, "trvl"}, {SettingId{2}, "rvl"}}, {});
    });
    lane->set_settings({{SettingId{1}, "trvl"}}, {});
    wait_for(2);
    lane->wait_idle();
    lane->set_settings({{SettingId{1}, "trvl"}, {SettingId{3}, "rvl"}}, {});
    lane->wait_idle();
    const std::lock_guard lock(mutex);
    EXPECT_EQ(published.size(), 2u);
}

TEST_F(Lane, ColorFramesNameWhatTheyReferTo) {
    if (!video::missing_color_encoder({video::ColorCodecId::h264, "h264"}).empty())
        GTEST_SKIP() << "no H.264 encoder on this machine";
    lane->set_settings({}, {{SettingId{1}, "h264:crf=20"}, {SettingId{2}, "jpeg:quality=85"}});
    for (std::size_t i = 0; i < 3; ++i) {
        script->give_frame(1000);
        wait_for(2 * i + 2);
        lane->wait_idle();
    }
    const std::lock_guard lock(mutex);
    // The order of a frame's settings depends on their costs.
    const auto of = [&](SettingId setting) {
        std::vector<wire::MediaHeader> headers;
        for (const EncodedMedia& media : published)
            if (media.header.setting == setting)
                headers.push_back(media.header);
        return headers;
    };
    const auto h264 = of(SettingId{1}), jpeg = of(SettingId{2});
    ASSERT_EQ(h264.size(), 3u);
    ASSERT_EQ(jpeg.size(), 3u);
    EXPECT_TRUE(h264[0].key);
    for (const std::size_t i : {1u, 2u}) {
        EXPECT_FALSE(h264[i].key);
        EXPECT_EQ(h264[i].reference, h264[i - 1].frame);
        EXPECT_TRUE(jpeg[i].key);
        EXPECT_EQ(jpeg[i].reference, jpeg[i].frame);
    }
}

TEST_F(Lane, TheRegionHoldsFromTheNextFrameOn) {
    lane->set_settings({{SettingId{1}, "strata:max_error_mm=9"}}, {});
    const auto give_slope = [&] {
        auto frame = std::make_shared<Frame>();
        frame->depth = DepthImage(size);
        for (std::size_t i = 0; i < size.area(); ++i)
            frame->depth.pixels[i] = std::uint16_t(1000 + i * 7919 % 1000);
        script->send_now(frame);
        return frame->depth.pixels;
    };
    const codec::strata::Region regions[] = {{}, {codec::strata::box(4, 3, 9, 8)}, {}};
    codec::DepthStreamDecoder decoder(codec::parse_depth_setting("strata").setting);
    DepthImage image(size);
    for (std::size_t n = 0; n < std::size(regions); ++n) {
        lane->set_region(regions[n]);
        const auto given = give_slope();
        wait_for(n + 1);
        const std::lock_guard lock(mutex);
        const wire::MediaHeader& h = published[n].header;
        EXPECT_EQ(h.key, n == 0);
        ASSERT_EQ(decoder.decode({h.frame, h.reference, h.temporal_layer, h.key},
                                 wire::media_payload(*published[n].message), image.view()),
                  Status::ok);
        int changed_inside = 0, changed_outside = 0;
        for (std::size_t i = 0; i < size.area(); ++i) {
            const int x = int(i) % size.width, y = int(i) / size.width;
            const bool inside = regions[n].empty() || (x >= 4 && x < 9 && y >= 3 && y < 8);
            (inside ? changed_inside : changed_outside) += image.pixels[i] != given[i];
            EXPECT_LE(std::abs(int(image.pixels[i]) - int(given[i])), 9);
        }
        EXPECT_EQ(changed_inside, 0) << n;
        EXPECT_EQ(changed_outside > 0, !regions[n].empty()) << n;
    }
}

TEST_F(Lane, NothingIsEncodedForNobody) {
    script->give_frame(1000);
    script->give_frame(1001);
    script->give({capture::Capture::Kind::end, nullptr, ""});
    std::unique_lock lock(mutex);
    changed.wait(lock, [&] { return !states.empty(); });
    EXPECT_EQ(states[0].condition, wire::CameraCondition::ended);
    EXPECT_TRUE(published.empty());
}

// A recorded background would else show the room in the first picture.
TEST_F(Lane, AFrameThatCameBeforeAnybodyWatchedIsFiltered) {
    lane->set_filter(filter::parse_chain("range:max_mm=500").settings, nullptr);
    script->give_frame(1000);
    script->wait_until_taken(1);
    lane->wait_idle();  // it has found no receiver for the frame
    lane->set_settings({{SettingId{1}, "trvl"}}, {});
    wait_for(1);
    const std::lock_guard lock(mutex);
    const wire::MediaHeader& h = published[0].header;
    codec::DepthStreamDecoder decoder(codec::parse_depth_setting("trvl").setting);
    DepthImage image(size);
    ASSERT_EQ(decoder.decode({h.frame, h.reference, h.temporal_layer, h.key},
                             wire::media_payload(*published[0].message), image.view()),
              Status::ok);
    EXPECT_EQ(image.pixels, std::vector<std::uint16_t>(size.area(), 0));
}

TEST_F(Lane, WhileHeldTheNewestFrameWaitsAndNoReferenceIsMissing) {
    lane->set_settings({{SettingId{1}, "trvl"}}, {});
    script->give_frame(1000);
    wait_for(1);
    lane->hold(true);
    script->give_frame(1001);
    script->wait_until_taken(2);
    lane->wait_idle();
    script->give_frame(1002);
    script->wait_until_taken(3);
    EXPECT_EQ(lane->figures().dropped[std::size_t(DropReason::newer)], 1u);
    lane->hold(false);
    wait_for(2);
    const std::lock_guard lock(mutex);
    ASSERT_EQ(published.size(), 2u);
    EXPECT_FALSE(published[1].header.key);
    EXPECT_EQ(published[1].header.reference, published[0].header.frame);
    codec::DepthStreamDecoder decoder(codec::parse_depth_setting("trvl").setting);
    DepthImage image(size);
    for (const EncodedMedia& media : published) {
        const wire::MediaHeader& h = media.header;
        ASSERT_EQ(decoder.decode({h.frame, h.reference, h.temporal_layer, h.key},
                                 wire::media_payload(*media.message), image.view()),
                  Status::ok);
    }
    EXPECT_EQ(image.pixels[0], 1002);
}

// The end of a recording: no last depth without its colour, and what is missing has a number.
TEST_F(Lane, AClosedLaneEncodesTheFramesThatItHasTakenAndNoFurther) {
    const GatedColor::Gate gate = std::make_shared<std::counting_semaphore<>>(0);
    CameraLane::Options options;
    options.waiting_frames = 15;
    options.make_color = [gate](const video::ColorSetting&) {
        return std::make_unique<GatedColor>(gate);
    };
    open(std::move(options));
    lane->set_settings({{SettingId{1}, "rvl"}}, {{SettingId{2}, "jpeg"}});
    for (int n = 1; n <= 3; ++n) {
        script->give_frame(1000);
        script->wait_until_taken(n);
    }
    lane->close();
    script->give_frame(1000);
    script->wait_until_taken(4);
    EXPECT_EQ(lane->wait_until_encoded(0s), 3u);
    gate->release(2);
    wait_for(5);  // the third depth, too, if another thread encodes it
    gate->release();
    EXPECT_EQ(lane->wait_until_encoded(std::chrono::hours(1)), 0u);
    const std::lock_guard lock(mutex);
    EXPECT_EQ(std::count_if(published.begin(), published.end(),
                            [](const auto& media) { return is_depth(media.header.stream); }),
              3);
    EXPECT_EQ(published.size(), 6u);
}

// A file that is converted: no frame is lost before the settings are there, nor to slow work, and
// none is sent twice.
TEST_F(Lane, WhereEveryFrameIsWantedTheCameraWaits) {
    constexpr int frames = 20;
    const GatedColor::Gate gate = std::make_shared<std::counting_semaphore<>>(0);
    CameraLane::Options options;
    options.waiting_frames = 3;
    options.every_frame = true;
    options.make_color = [gate](const video::ColorSetting&) {
        return std::make_unique<GatedColor>(gate);
    };
    open(std::move(options));
    EXPECT_TRUE(lane->waits());
    for (int n = 0; n < frames; ++n)
        script->give_frame(1000);
    script->wait_until_taken(2);
    lane->set_settings({{SettingId{1}, "rvl"}}, {{SettingId{2}, "jpeg"}});
    lane->hold(false);
    lane->request_key(depth_stream(CameraId{3}), SettingId{1});
    gate->release(frames);
    wait_for(2 * frames);
    lane->wait_idle();
    const std::lock_guard lock(mutex);
    EXPECT_EQ(published.size(), std::size_t(2 * frames));
    EXPECT_EQ(lane->dropped_newest(), 0u);
}

TEST_F(Lane, AFailureIsToldWithItsSentence) {
    script->give({capture::Capture::Kind::failed, nullptr, "The cable is out."});
    std::unique_lock lock(mutex);
    changed.wait(lock, [&] { return !states.empty(); });
    EXPECT_EQ(states[0].condition, wire::CameraCondition::failed);
    EXPECT_EQ(states[0].problem, wire::as_written("The cable is out."));
    EXPECT_EQ(states[0].camera, CameraId{3});
}

}  // namespace
}  // namespace theatron::send
