// SPDX-License-Identifier: Apache-2.0
#include "client/decoders.h"

#include <gtest/gtest.h>

#include <future>

#include "base/steady_clock.h"
#include "codec/depth_codec.h"
#include "geometry/calibration.h"
#include "video/depth_codecs.h"

namespace theatron::client {
namespace {

constexpr Size size{16, 12};
constexpr SettingId setting{1};

wire::Camera camera(int id) {
    Calibration calibration;
    calibration.depth.size = size;
    calibration.depth.fx = calibration.depth.fy = 10;
    wire::Camera c;
    c.id = CameraId(id);
    c.depth_stream = depth_stream(c.id);
    c.color_stream = color_stream(c.id);
    c.calibration = encode_calibration(calibration);
    return c;
}

// A depth image of camera 0, a key frame.
Bytes message(FrameNumber number) {
    const DepthImage depth(size);
    auto encoder = video::make_depth_encoder(video::parse_depth_setting("raw").setting);
    Bytes payload(encoder.max_encoded_size(size));
    payload.resize(encoder.encode(depth.view(), number, true, payload).bytes);
    Bytes bytes(wire::media_header_size);
    wire::MediaHeader header;
    header.codec = std::uint8_t(codec::DepthCodecId::raw);
    header.key = true;
    header.frame = header.reference = number;
    header.setting = setting;
    header.payload_size = std::uint32_t(payload.size());
    wire::write_media_header(header, bytes.data());
    bytes.insert(bytes.end(), payload.begin(), payload.end());
    return bytes;
}

// Decoders whose threads stop at the first frame until they may go on.
struct Held {
    std::promise<void> first_came, may_go_on;
    std::shared_future<void> go_on = may_go_on.get_future().share();
    std::mutex mutex;
    std::condition_variable changed;
    std::vector<std::pair<FrameNumber, std::uint64_t>> frames;
    std::size_t taken = 0;
    std::vector<std::string> problems;
    Decoders decoders{events()};

    Decoders::Events events() {
        Decoders::Events events;
        events.frame = [this](receive::CameraFramePtr frame, std::uint64_t generation) {
            if (frame->number == 0) {
                first_came.set_value();
                go_on.wait();
            }
            const std::lock_guard lock(mutex);
            frames.emplace_back(frame->number, generation);
            changed.notify_all();
        };
        events.needs_key = [](StreamId, SettingId) {};
        events.taken = [this](std::uint64_t connection, std::size_t bytes) {
            EXPECT_EQ(connection, 7u);
            const std::lock_guard lock(mutex);
            taken += bytes;
            changed.notify_all();
        };
        events.problem = [this](const std::string& text) {
            const std::lock_guard lock(mutex);
            problems.push_back(text);
            changed.notify_all();
        };
        events.now = steady_now;
        return events;
    }
    void begin() {
        decoders.set_cameras({camera(0)});
        decoders.set_settings({{depth_stream(CameraId{0}), setting, "raw"}});
    }
    // True if the message was taken at once.
    bool send(FrameNumber number) {
        Bytes bytes = message(number);
        return decoders.on_media(bytes, 7);
    }
    // Leaves the thread busy with frame 0. Returns the frame's size if it had to wait, because the
    // thread was still busy with the settings; else 0.
    std::size_t occupy() {
        const bool at_once = send(0);
        first_came.get_future().wait();
        return at_once ? 0 : message(0).size();
    }
    template <class Predicate>
    void wait_until(Predicate predicate) {
        std::unique_lock lock(mutex);
        changed.wait(lock, predicate);
    }
};

// Would hang if any of these waited for the decoder.
TEST(Decoders, NothingWaitsForADecoder) {
    Held held;
    held.begin();
    const std::size_t before = held.occupy();
    for (FrameNumber n = 1; n <= 50; ++n)
        EXPECT_FALSE(held.send(n)) << "it waits, and is not to be acknowledged yet";
    (void)held.decoders.figures();
    held.decoders.reset_figures();
    held.decoders.set_settings({{depth_stream(CameraId{0}), SettingId{2}, "rvl"}});
    {
        const std::lock_guard lock(held.mutex);
        EXPECT_EQ(held.taken, before);
    }
    held.may_go_on.set_value();
    const std::size_t all = before + 50 * message(1).size();
    held.wait_until([&] { return held.frames.size() == 51 && held.taken == all; });
}

TEST(Decoders, NewCamerasReplaceWhatWaitsForTheOldOnes) {
    Held held;
    held.begin();
    const std::size_t before = held.occupy();
    for (FrameNumber n = 1; n <= 5; ++n)
        (void)held.send(n);
    const std::uint64_t generation = held.decoders.set_cameras({camera(0)});
    {
        const std::lock_guard lock(held.mutex);
        EXPECT_EQ(held.taken, before + 5 * message(1).size()) << "their sender may go on";
    }
    held.decoders.set_settings({{depth_stream(CameraId{0}), setting, "raw"}});
    held.may_go_on.set_value();
    (void)held.send(9);
    held.wait_until([&] { return held.frames.size() == 2; });
    EXPECT_NE(held.frames[0].second, generation);
    EXPECT_EQ(held.frames[1], std::make_pair(FrameNumber(9), generation));
}

TEST(Decoders, FarTooMuchIsLeftOut) {
    Held held;
    held.begin();
    (void)held.occupy();
    const std::size_t size_of_one = message(1).size();
    std::size_t waiting = 0;
    for (FrameNumber n = 1; waiting * size_of_one < std::size_t(256) << 20; ++n) {
        if (held.send(n))
            break;
        ++waiting;
    }
    EXPECT_GT(waiting, 10'000u);
    EXPECT_LE(waiting * size_of_one, std::size_t(128) << 20);
    held.decoders.set_cameras({});
    held.may_go_on.set_value();
}

TEST(Decoders, ACodecThatIsNotKnownIsSaidOnce) {
    Held held;
    held.may_go_on.set_value();
    held.decoders.set_cameras({camera(0), camera(1)});
    held.decoders.set_settings({{depth_stream(CameraId{0}), setting, "future"},
                                {depth_stream(CameraId{1}), setting, "future"}});
    held.decoders.set_settings({{depth_stream(CameraId{0}), SettingId{2}, "raw"}});
    held.wait_until([&] { return !held.problems.empty(); });
    EXPECT_EQ(held.problems.size(), 1u);
    EXPECT_NE(held.problems[0].find("does not know"), std::string::npos);
}

}  // namespace
}  // namespace theatron::client
