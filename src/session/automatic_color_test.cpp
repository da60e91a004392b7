// SPDX-License-Identifier: Apache-2.0
// Colour whose codec its publisher chooses frame by frame: each frame's header names it.
#include <gtest/gtest.h>

#include "session/streams.h"

namespace theatron::session {
namespace {

constexpr ParticipantId alice{1};
constexpr std::uint8_t jpeg = 66, h264 = 67;

class AutomaticColor : public ::testing::Test {
protected:
    static SessionCameras::Config config() {
        SessionCameras::Config config;
        config.codecs.layered = [](const std::string& codec) {
            return CodecSteps::Layered{codec, true};
        };
        config.codecs.refers = [](std::uint8_t codec) { return codec == h264; };
        return config;
    }

    AutomaticColor() : streams(config(), actions) {
        wire::Camera camera;
        camera.has_color = true;
        camera.frames_per_second = 30;
        streams.add(host_publisher, {camera});
        streams.join(alice, {"rvl", "auto"}, false);
    }

    // How many frames of colour reach alice in this time.
    int pass(Duration time, std::uint8_t codec) {
        int given = 0;
        for (const TimePoint end = now + time; now < end; now += frame_period, ++frame) {
            wire::MediaHeader header;
            header.captured = now;
            header.frame = header.reference = frame;
            header.stream = depth_stream(CameraId{0});
            header.setting = streams.settings(CameraId{0}, true).at(0).id;
            (void)streams.on_media(header, 10'000, now);
            header.stream = color_stream(CameraId{0});
            header.setting = streams.settings(CameraId{0}, false).at(0).id;
            header.codec = codec;
            given += int(streams.on_media(header, 10'000, now).size());
            if (frame % 3 == 0)
                streams.on_link(alice, {1e7, 2ms, 5ms, 0}, now);
        }
        return given;
    }

    static constexpr Duration frame_period = std::chrono::microseconds(33'333);
    std::vector<Action> actions;
    Streams streams;
    TimePoint now = from_us(1'000'000);
    FrameNumber frame = 0;
};

TEST_F(AutomaticColor, FramesAreLeftOutAsLongAsNoneRefersToAnother) {
    EXPECT_GE(pass(2s, jpeg), 59);
    // Depth and colour together take 4.8 Mbit/s.
    streams.set_goal(alice, {150, 3000});
    (void)pass(5s, jpeg);
    EXPECT_LE(pass(2s, jpeg), 31) << "half of them";
    EXPECT_GE(pass(2s, h264), 59) << "its publisher has changed the codec";
    EXPECT_LE(pass(2s, jpeg), 31);
}

}  // namespace
}  // namespace theatron::session
