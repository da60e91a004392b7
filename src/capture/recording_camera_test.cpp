// SPDX-License-Identifier: Apache-2.0
#include "capture/recording_camera.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>
#include <set>

#include "base/error.h"
#include "base/steady_clock.h"
#include "record/recorder.h"
#include "testing/temporary_folder.h"
#include "video/jpeg_encoder_native.h"

namespace theatron::capture {
namespace {

using ::testing::HasSubstr;
namespace fs = std::filesystem;

constexpr Size depth_size{24, 18}, color_size{16, 12};
const record::ClockPair session_begin{from_us(5), UtcTime(1'700'000'000s)};
constexpr int period_us = 33'333;

Calibration calibration_of(int camera) {
    Calibration calibration;
    calibration.depth = pinhole(depth_size, 60 + camera);
    calibration.color = pinhole(color_size, 70);
    return calibration;
}

// A wall that approaches, with noise: all frames differ.
DepthImage depth_of(int camera, FrameNumber n) {
    DepthImage image(depth_size);
    std::minstd_rand random(n * 8 + unsigned(camera) + 1);
    for (auto& p : image.pixels)
        p = random() % 16 == 0 ? 0 : std::uint16_t(2000 - n + random() % 4);
    return image;
}

Bytes jpeg_of(int camera, FrameNumber n) {
    ColorImage image(color_size);
    std::fill(image.pixels.begin(), image.pixels.end(),
              Rgb{std::uint8_t(n * 3), std::uint8_t(camera * 50), 9});
    video::JpegCompressor compressor(85, true);
    const ByteView bytes = compressor.compress(image.view());
    return Bytes(bytes.begin(), bytes.end());
}

// Irregular times, and a pause in the middle.
Duration time_of(FrameNumber n) {
    return Duration(std::int64_t(n) * period_us + (n % 3) * 700 + (n >= 6 ? 90'000 : 0));
}

class RecordingCamera : public ::testing::Test {
protected:
    fs::path path() const { return folder_.path() / "recording.mkv"; }

    record::RecordedCamera description(int camera, const std::string& depth_codec) {
        record::RecordedCamera d;
        d.id = CameraId(camera);
        d.name = "camera";
        d.frames_per_second = 30;
        d.calibration = encode_calibration(calibration_of(camera));
        d.depth = {depth_codec, depth_size.width, depth_size.height};
        d.color = record::RecordedStream{"jpeg:quality=85", color_size.width, color_size.height};
        return d;
    }

    static void add(record::Recorder& recorder, wire::MediaHeader header, ByteView payload) {
        header.payload_size = std::uint32_t(payload.size());
        auto message = std::make_shared<Bytes>(wire::media_header_size);
        wire::write_media_header(header, message->data());
        message->insert(message->end(), payload.begin(), payload.end());
        EXPECT_EQ(recorder.add(header, message, header.captured), record::Recorder::Added::taken);
    }

    // Records `frames` frames of each camera. For camera 0, the depth of those in `left_out` is
    // missing, not their colour. Each camera starts 5 ms after the one before.
    void record(const std::string& codec, int cameras, FrameNumber frames,
                const std::set<FrameNumber>& left_out = {}) {
        std::vector<record::RecordedCamera> descriptions;
        std::vector<codec::DepthStreamEncoder> encoders;
        const auto setting = codec::parse_depth_setting(codec);
        ASSERT_EQ(setting.problem, "");
        for (int c = 0; c < cameras; ++c) {
            descriptions.push_back(description(c, setting.setting.text));
            encoders.emplace_back(setting.setting);
        }
        record::Recorder recorder(path(), descriptions, session_begin);
        for (FrameNumber n = 0; n < frames; ++n)
            for (int c = 0; c < cameras; ++c) {
                wire::MediaHeader header;
                header.frame = n;
                header.captured = from_us(77'000'000) + time_of(n) + c * 5ms;
                header.stream = depth_stream(CameraId(c));
                Bytes encoded(encoders[std::size_t(c)].max_encoded_size(depth_size));
                const auto link =
                    encoders[std::size_t(c)].encode(depth_of(c, n).view(), n, false, encoded);
                header.key = link.key;
                header.reference = link.reference_frame;
                header.temporal_layer = std::uint8_t(link.layer);
                if (c != 0 || !left_out.contains(n))
                    add(recorder, header, ByteView(encoded).first(link.bytes));
                header.stream = color_stream(CameraId(c));
                header.key = true;
                header.reference = n;
                header.temporal_layer = 0;
                add(recorder, header, jpeg_of(c, n));
            }
    }

    RecordedFrames frames(int camera) {
        return RecordedFrames(record::RecordingFile::open(path()), std::size_t(camera),
                              path().string());
    }

    testing::TemporaryFolder folder_;
};

TEST_F(RecordingCamera, GivesTheVeryFramesInTheirSpacingWithEveryKindOfCodec) {
    for (const char* codec : {"raw", "rvl", "trvl", "zstd:delta=1", "zstd:delta=1,layers=3"}) {
        SCOPED_TRACE(codec);
        record(codec, 4, 12);
        for (int c = 0; c < 4; ++c) {
            RecordedFrames camera = frames(c);
            EXPECT_EQ(camera.info().calibration, calibration_of(c));
            EXPECT_EQ(camera.info().frames_per_second, 30);
            Frame frame;
            for (int round = 0; round < 2; ++round) {
                for (FrameNumber n = 0; n < 12; ++n) {
                    ASSERT_EQ(camera.offset(), time_of(n) + c * 5ms) << n;
                    camera.read(frame);
                    ASSERT_EQ(frame.depth, depth_of(c, n)) << n;
                    ASSERT_EQ(frame.color.jpeg, jpeg_of(c, n)) << n;
                    ASSERT_EQ(frame.color.size, color_size);
                }
                EXPECT_FALSE(camera.offset());
                camera.rewind();
            }
        }
    }
}

TEST_F(RecordingCamera, FramesThatArePassedOverAreStillReferences) {
    record("zstd:delta=1,layers=2", 1, 12);
    RecordedFrames camera = frames(0);
    Frame frame;
    for (FrameNumber n = 0; n < 12; ++n) {
        ASSERT_TRUE(camera.offset());
        if (n % 3 != 2) {
            camera.skip();
            continue;
        }
        camera.read(frame);
        EXPECT_EQ(frame.depth, depth_of(0, n)) << n;
        EXPECT_EQ(frame.color.jpeg, jpeg_of(0, n)) << n;
    }
}

TEST_F(RecordingCamera, FramesWhoseReferenceIsMissingAreLeftOut) {
    // With three layers, frame 4 is the reference of 5, 6 and 8; frame 8 of the rest.
    record("zstd:delta=1,layers=3", 1, 12, {4});
    RecordedFrames camera = frames(0);
    std::vector<FrameNumber> played;
    Frame frame;
    while (camera.offset()) {
        const FrameNumber n = camera.upcoming().frame;
        camera.read(frame);
        EXPECT_EQ(frame.depth, depth_of(0, n)) << n;
        played.push_back(n);
    }
    EXPECT_EQ(played, (std::vector<FrameNumber>{0, 1, 2, 3}));
}

// Where this build has no encoder or decoder for the colour, the tests are skipped.
class RecordingCameraOfVideo : public RecordingCamera {
protected:
    void SetUp() override {
        for (const std::string& missing :
             {video::missing_color_encoder(setting_), video::missing_color_decoder(setting_)})
            if (!missing.empty())
                GTEST_SKIP() << missing;
    }

    // Records eight frames whose colours refer to one another. The colours are `expected_`. A
    // second segment begins with these frames of depth and of colour; null: there is none.
    void record_video(FrameNumber second_depth = 0, FrameNumber second_color = 0) {
        record::RecordedCamera d = description(0, "raw");
        d.color->codec = setting_.text;
        record::Recorder recorder(path(), {d}, session_begin);
        codec::DepthStreamEncoder depth(codec::parse_depth_setting("raw").setting);
        const auto encoder = video::make_color_encoder(setting_);
        const auto decoder = video::make_color_decoder(setting_.id);
        std::vector<std::pair<wire::MediaHeader, Bytes>> of_second;
        const auto put = [&](const wire::MediaHeader& header, ByteView payload,
                             FrameNumber second) {
            if (second == 0 || header.frame < second)
                add(recorder, header, payload);
            else
                of_second.emplace_back(header, Bytes(payload.begin(), payload.end()));
        };
        for (FrameNumber n = 0; n < 8; ++n) {
            wire::MediaHeader header;
            header.frame = header.reference = n;
            header.key = true;
            header.captured = from_us(1000) + time_of(n);
            header.stream = depth_stream(CameraId(0));
            Bytes encoded(depth.max_encoded_size(depth_size));
            const auto link = depth.encode(depth_of(0, n).view(), n, true, encoded);
            put(header, ByteView(encoded).first(link.bytes), second_depth);

            ColorData color;
            color.size = color_size;
            color.pixels = ColorImage(color_size);
            for (std::size_t i = 0; i < color_size.area(); ++i)
                color.pixels.pixels[i] = {std::uint8_t(n * 20 + i), std::uint8_t(i), 50};
            const auto picture = encoder->encode(color, n == 0 || n == second_color);
            ASSERT_TRUE(picture);
            header.stream = color_stream(CameraId(0));
            header.key = picture->key;
            header.reference = picture->key ? n : n - 1;
            put(header, picture->bytes, second_color);
            ASSERT_EQ(decoder->submit(picture->bytes, n), Status::ok);
            expected_.push_back(decoder->poll()->image);
        }
        if (of_second.empty())
            return;
        recorder.begin_segment({d}, session_begin);
        for (const auto& [header, payload] : of_second)
            add(recorder, header, payload);
    }

    const video::ColorSetting setting_ = video::parse_color_setting("h264:crf=20").setting;
    std::vector<ColorImage> expected_;
};

TEST_F(RecordingCameraOfVideo, ColourMayChangeTheSegmentBeforeOrAfterItsDepth) {
    for (const auto& [depth, color] : {std::pair<FrameNumber, FrameNumber>{3, 6}, {6, 3}}) {
        expected_.clear();
        record_video(depth, color);
        RecordedFrames camera = frames(0);
        Frame frame;
        for (FrameNumber n = 0; n < 8; ++n) {
            ASSERT_TRUE(camera.offset());
            camera.read(frame);
            EXPECT_EQ(frame.depth, depth_of(0, n)) << n;
            EXPECT_EQ(frame.color.pixels, expected_[n]) << n << ", depth from " << depth;
        }
        EXPECT_EQ(camera.losses().color(), 0u);
        // One that is only looked up needs those before it.
        camera.go_to(time_of(5));
        ASSERT_TRUE(camera.offset());
        camera.read(frame);
        EXPECT_EQ(frame.color.pixels, expected_[5]) << "depth from " << depth;
    }
}

TEST_F(RecordingCameraOfVideo, ColourIsTheSameAfterFramesWerePassedOver) {
    record_video();
    RecordedFrames camera = frames(0);
    Frame frame;
    for (int round = 0; round < 2; ++round) {
        for (FrameNumber n = 0; n < 8; ++n) {
            ASSERT_TRUE(camera.offset());
            if (n % 4 == 1 || n % 4 == 2) {
                camera.skip();
                continue;
            }
            camera.read(frame);
            EXPECT_EQ(frame.color.pixels, expected_[n]) << n;
        }
        camera.rewind();
    }
}

TEST_F(RecordingCamera, PlaysInRealTimeAndLoops) {
    record("trvl", 2, 4);
    for (const char* preload : {"0", "1"}) {
        const auto camera =
            open_camera("recording:" + path().string() + ",camera=1,loop=1,preload=" + preload);
        // A busy machine may skip frames, which their numbers show. The other camera begins
        // 5 ms before this one, and a round takes equally long for both.
        const Duration round = time_of(3) + 5ms + Duration(period_us);
        FramePtr first;
        for (FrameNumber number = 0; number < 9;) {
            const Capture next = camera->next(1s);
            if (next.kind == Capture::Kind::nothing)
                continue;
            ASSERT_EQ(next.kind, Capture::Kind::frame);
            if (!first)
                first = next.frame;
            number = next.frame->number;
            EXPECT_EQ(next.frame->depth, depth_of(1, number % 4));
            EXPECT_EQ(next.frame->times.captured - first->times.captured,
                      time_of(number % 4) - time_of(first->number % 4) + int(number / 4) * round);
        }
    }
}

TEST_F(RecordingCamera, WhatIsWrongIsOneSentence) {
    const auto sentence = [](const std::string& specification) -> std::string {
        try {
            const auto camera = open_camera(specification);
        } catch (const Error& problem) {
            return problem.what();
        }
        return "opened";
    };
    record("rvl", 2, 3);
    const std::string name = path().string();
    EXPECT_THAT(sentence("recording:" + name + ",camera=2"),
                HasSubstr("holds 2 cameras, numbered from 0, so camera=2 is none of them."));
    EXPECT_THAT(sentence("recording:" + name + ",start=3"),
                HasSubstr("has 3 frames, so start=3 is too far."));
    EXPECT_THAT(sentence("recording:" + name + ",camara=1"), HasSubstr("camara"));
    EXPECT_EQ(sentence("recording:"),
              "The camera 'recording' needs a file, as in recording:FILE.mkv.");
    EXPECT_EQ(sentence("recording:/none.mkv"),
              "Cannot open '/none.mkv': No such file or directory.");
}

TEST_F(RecordingCamera, WithoutAnyWholePictureIsOneSentence) {
    {
        record::Recorder recorder(path(), {description(0, "rvl")}, session_begin);
        wire::MediaHeader header;
        header.key = true;
        header.captured = from_us(5);
        add(recorder, header, Bytes(30, std::byte{0x55}));
    }
    try {
        const auto camera = open_camera("recording:" + path().string());
        FAIL();
    } catch (const Error& problem) {
        EXPECT_THAT(problem.what(), HasSubstr("None of the pictures of camera 0 in"));
    }
}

}  // namespace
}  // namespace theatron::capture
