// SPDX-License-Identifier: Apache-2.0
#include "receive/receiver.h"

#include <gtest/gtest.h>

#include <deque>
#include <optional>
#include <random>
#include <utility>

#include "base/error.h"
#include "geometry/calibration.h"

namespace theatron::receive {
namespace {

constexpr CameraId camera{0};
constexpr Size picture{32, 24};

wire::Camera described(bool has_color = true, Size depth = picture, Size color = picture) {
    Calibration calibration;
    calibration.depth.size = depth;
    calibration.color.size = color;
    calibration.depth.fx = calibration.depth.fy = calibration.color.fx = calibration.color.fy = 30;
    wire::Camera description;
    description.id = camera;
    description.depth_stream = depth_stream(camera);
    description.color_stream = color_stream(camera);
    description.has_color = has_color;
    description.calibration = encode_calibration(calibration);
    return description;
}

// One camera's encoders, as a host has them.
class Source {
public:
    explicit Source(const std::string& depth = "trvl", SettingId setting = SettingId{1},
                    const std::string& color = "raw")
        : setting_(setting),
          depth_setting_(codec::parse_depth_setting(depth).setting),
          depth_(depth_setting_),
          color_setting_(video::parse_color_setting(color).setting),
          color_(video::make_color_encoder(color_setting_)) {}

    static DepthImage scene(FrameNumber n) {
        DepthImage image(picture);
        std::mt19937 rng(n);
        for (std::size_t i = 0; i < image.pixels.size(); ++i)
            image.pixels[i] = std::uint16_t(1000 + i + rng() % 4);
        return image;
    }

    Bytes depth(FrameNumber n, bool key = false) {
        Bytes payload(depth_.max_encoded_size(picture));
        const auto encoded = depth_.encode(scene(n).view(), n, key, payload);
        payload.resize(encoded.bytes);
        wire::MediaHeader h;
        h.codec = std::uint8_t(depth_setting_.id);
        h.stream = depth_stream(camera);
        h.setting = setting_;
        h.reference = encoded.reference_frame;
        h.temporal_layer = std::uint8_t(encoded.layer);
        h.key = encoded.key;
        return message(h, n, payload);
    }
    void set_color_id(SettingId id) { color_id_ = id; }
    void set_color_size(Size size) { color_size_ = size; }
    Bytes color(FrameNumber n, bool key = true) {
        ColorData data;
        data.size = color_size_;
        data.pixels = ColorImage(data.size);
        data.pixels.pixels[0] = {std::uint8_t(n), 2, 3};
        const auto encoded = color_->encode(data, key);
        wire::MediaHeader h;
        h.codec = std::uint8_t(color_setting_.id);
        h.stream = color_stream(camera);
        h.setting = color_id_;
        h.reference = encoded->key ? n : last_color_;
        h.key = encoded->key;
        last_color_ = n;
        return message(h, n, encoded->bytes);
    }

private:
    static Bytes message(wire::MediaHeader h, FrameNumber n, ByteView payload) {
        h.frame = n;
        h.captured = h.moment = from_us(n * 33'333);
        h.payload_size = std::uint32_t(payload.size());
        Bytes bytes(wire::media_header_size);
        wire::write_media_header(h, bytes.data());
        bytes.insert(bytes.end(), payload.begin(), payload.end());
        return bytes;
    }
    SettingId setting_;
    codec::DepthSetting depth_setting_;
    codec::DepthStreamEncoder depth_;
    video::ColorSetting color_setting_;
    std::unique_ptr<video::ColorEncoder> color_;
    SettingId color_id_{0x8001};
    Size color_size_ = picture;
    FrameNumber last_color_ = 0;
};

class ReceiverTest : public ::testing::Test {
protected:
    explicit ReceiverTest(bool has_color = true)
        : receiver({[this](CameraFramePtr f) { frames.push_back(std::move(f)); },
                    [this](StreamId stream, SettingId) { keys_wanted.push_back(stream); }}) {
        receiver.set_cameras({described(has_color)});
        set_depth("trvl", SettingId{1});
    }
    void set_depth(const std::string& codec, SettingId id) {
        receiver.set_settings(
            {{depth_stream(camera), id, codec}, {color_stream(camera), SettingId{0x8001}, "raw"}});
    }
    void set_color(const std::string& codec) {
        receiver.set_settings({{color_stream(camera), SettingId{0x8002}, codec}});
    }
    TimePoint at(FrameNumber n) { return from_us(n * 33'333 + 5'000); }

    std::vector<CameraFramePtr> frames;
    std::vector<StreamId> keys_wanted;
    Receiver receiver;
};

TEST_F(ReceiverTest, PairsDepthAndColorOfAFrame) {
    Source source;
    for (FrameNumber n = 0; n < 3; ++n) {
        ASSERT_EQ(receiver.on_media(source.depth(n), at(n)), Status::ok);
        EXPECT_EQ(frames.size(), n);
        ASSERT_EQ(receiver.on_media(source.color(n), at(n)), Status::ok);
        ASSERT_EQ(frames.size(), n + 1);
        EXPECT_EQ(frames[n]->number, n);
        EXPECT_EQ(frames[n]->depth, Source::scene(n));
        EXPECT_EQ(frames[n]->color->pixels[0].r, n);
        EXPECT_EQ(frames[n]->times.captured, from_us(n * 33'333));
    }
    EXPECT_TRUE(keys_wanted.empty());
}

TEST_F(ReceiverTest, TellsForHowLongTheFirstPictureIsAwaited) {
    const auto awaited_ms = [&](FrameNumber n) { return receiver.figures(at(n)).at(0).awaited_ms; };
    EXPECT_EQ(awaited_ms(0), 0);
    EXPECT_NEAR(awaited_ms(60), 2000, 0.1);
    receiver.forget_ages();  // the clock was another one
    EXPECT_EQ(awaited_ms(61), 0);
    EXPECT_NEAR(awaited_ms(91), 1000, 0.1);
    Source source;
    (void)receiver.on_media(source.depth(92), at(92));
    (void)receiver.on_media(source.color(92), at(92));
    EXPECT_EQ(awaited_ms(200), 0);
    receiver.reset_figures();
    const StreamFigures figures = receiver.figures(at(300)).at(0);
    EXPECT_EQ(figures.frames, 0u);
    EXPECT_EQ(figures.awaited_ms, 0) << "one has come before";
    EXPECT_TRUE(figures.has_come);
    EXPECT_GT(figures.age_now_ms, 6000);
}

TEST_F(ReceiverTest, PutsNoPictureTogetherOfThePastAndThePresent) {
    constexpr SettingId past_depth{7}, past_color{8};
    Source live, past("trvl", past_depth);
    past.set_color_id(past_color);
    (void)receiver.on_media(live.depth(90), at(90));
    (void)receiver.on_media(live.color(90), at(90));
    (void)receiver.on_media(live.depth(91), at(91));  // waits for its colour
    receiver.set_settings({{depth_stream(camera), past_depth, "trvl", true},
                           {color_stream(camera), past_color, "raw", true}});
    // Still on its way.
    (void)receiver.on_media(live.color(91), at(91));
    ASSERT_EQ(frames.size(), 1u);
    EXPECT_FALSE(frames[0]->past);
    (void)receiver.on_media(past.depth(10), at(92));
    ASSERT_EQ(frames.size(), 1u);  // not with the colour of the present
    (void)receiver.on_media(past.color(10), at(92));
    ASSERT_EQ(frames.size(), 2u);
    EXPECT_TRUE(frames[1]->past);
    EXPECT_EQ(frames[1]->color->pixels[0].r, 10);
    const StreamFigures figures = receiver.figures(at(92)).at(0);
    EXPECT_TRUE(figures.past);
    EXPECT_GT(figures.age_now_ms, 2000);
    EXPECT_LT(figures.age_ms, 100);
    EXPECT_LT(figures.age_max_ms, 100);

    (void)receiver.on_media(past.depth(11), at(93));
    set_depth("trvl", SettingId{1});
    (void)receiver.on_media(past.color(11), at(93));
    (void)receiver.on_media(past.depth(12), at(93));
    ASSERT_EQ(frames.size(), 2u);
    (void)receiver.on_media(live.depth(94, true), at(94));
    (void)receiver.on_media(live.color(94), at(94));
    ASSERT_EQ(frames.size(), 3u);
    EXPECT_FALSE(frames[2]->past);
    EXPECT_EQ(frames[2]->color->pixels[0].r, 94);
    EXPECT_EQ(receiver.figures(at(94)).at(0).dropped, 0u);
}

TEST_F(ReceiverTest, WithoutDepthEachColorImageIsAFrame) {
    Source source;
    (void)receiver.on_media(source.depth(0), at(0));  // waits for its colour
    receiver.set_settings({{depth_stream(camera), SettingId{9}, "none"}});
    ASSERT_EQ(receiver.on_media(source.color(1), at(1)), Status::ok);
    ASSERT_EQ(receiver.on_media(source.color(2), at(2)), Status::ok);
    ASSERT_EQ(frames.size(), 2u);
    EXPECT_EQ(frames[1]->depth.size, Size{});
    EXPECT_EQ(frames[1]->color->pixels[0].r, 2);
    EXPECT_EQ(frames[1]->times.captured, from_us(2 * 33'333));
    // Depth that a host sends all the same is passed over.
    EXPECT_EQ(receiver.on_media(Source("trvl", SettingId{9}).depth(3, true), at(3)), Status::ok);
    EXPECT_EQ(frames.size(), 2u);
    for (const StreamFigures& figures : receiver.figures(at(3)))
        if (is_depth(figures.stream))
            EXPECT_EQ(figures.codec, "none");

    set_depth("trvl", SettingId{10});
    EXPECT_EQ(receiver.on_media(Source("trvl", SettingId{10}).depth(4, true), at(4)), Status::ok);
    EXPECT_EQ(frames.size(), 2u) << "it waits for its colour again";
    EXPECT_EQ(receiver.on_media(source.color(4), at(4)), Status::ok);
    ASSERT_EQ(frames.size(), 3u);
    EXPECT_EQ(frames[2]->depth.size, picture);

    receiver.set_settings({{color_stream(camera), SettingId{11}, "none"}});
    EXPECT_EQ(receiver.on_media(source.color(5), at(5)), Status::ok);
    EXPECT_EQ(frames.size(), 3u);
}

TEST_F(ReceiverTest, AnUnknownCodecOfOneStreamLeavesTheOthers) {
    const std::vector<wire::StreamSetting> settings{
        {depth_stream(camera), SettingId{9}, "newer", true},
        {color_stream(camera), SettingId{10}, "raw", true}};
    EXPECT_THROW(receiver.set_settings(settings), Error);
    EXPECT_EQ(receiver.figures({}).at(1).codec, "raw");
    EXPECT_TRUE(receiver.figures({}).at(1).past);
}

TEST_F(ReceiverTest, LateColorDoesNotHoldDepthBack) {
    Source source;
    (void)receiver.on_media(source.depth(0), at(0));
    (void)receiver.on_media(source.color(0), at(0));
    (void)receiver.on_media(source.depth(1), at(1));
    (void)receiver.on_media(source.depth(2), at(2));  // the colour of frame 1 was lost
    ASSERT_EQ(frames.size(), 2u);
    EXPECT_EQ(frames[1]->number, 1u);
    EXPECT_EQ(frames[1]->color->pixels[0].r, 0);  // the older one
    (void)receiver.on_media(source.color(2), at(2));
    EXPECT_EQ(frames.back()->number, 2u);
    EXPECT_EQ(frames.back()->color->pixels[0].r, 2);
}

TEST_F(ReceiverTest, LostColorIsAskedForAsAKeyFrame) {
    if (!video::missing_color_encoder({video::ColorCodecId::h264, "h264"}).empty())
        GTEST_SKIP() << "no H.264 encoder on this machine";
    set_color("h264");
    Source source("trvl", SettingId{1}, "h264");
    source.set_color_id(SettingId{0x8002});
    EXPECT_EQ(receiver.on_media(source.color(0, false), at(0)), Status::ok);
    EXPECT_EQ(receiver.on_media(source.color(1, false), at(1)), Status::ok);
    (void)source.color(2, false);
    EXPECT_EQ(receiver.on_media(source.color(3, false), at(3)), Status::missing_reference);
    EXPECT_EQ(receiver.on_media(source.color(4, false), at(4)), Status::missing_reference);
    EXPECT_EQ(keys_wanted, std::vector{color_stream(camera)});
    EXPECT_EQ(receiver.on_media(source.color(5, true), at(5)), Status::ok);
    EXPECT_EQ(receiver.on_media(source.color(6, false), at(6)), Status::ok);
    EXPECT_EQ(receiver.refused(), 0u);
}

TEST_F(ReceiverTest, AutomaticColorChangesItsCodecWithAKeyFrameAndOtherColorNever) {
    if (!video::missing_color_encoder({video::ColorCodecId::h264, "h264"}).empty())
        GTEST_SKIP() << "no H.264 encoder on this machine";
    Source jpeg("trvl", SettingId{1}, "jpeg"), h264("trvl", SettingId{1}, "h264"),
        raw("trvl", SettingId{1}, "raw");
    for (Source* source : {&jpeg, &h264, &raw})
        source->set_color_id(SettingId{0x8002});
    set_color("auto");
    EXPECT_EQ(receiver.figures(at(0))[1].codec, "auto");
    EXPECT_EQ(receiver.on_media(jpeg.color(0), at(0)), Status::ok);
    EXPECT_EQ(receiver.figures(at(0))[1].codec, "auto: jpeg");
    (void)h264.color(1, true);
    EXPECT_EQ(receiver.on_media(h264.color(2, false), at(2)), Status::missing_reference);
    EXPECT_EQ(receiver.on_media(h264.color(3, true), at(3)), Status::ok);
    EXPECT_EQ(receiver.figures(at(3))[1].codec, "auto: h264");
    EXPECT_EQ(receiver.on_media(h264.color(4, false), at(4)), Status::ok);
    EXPECT_EQ(receiver.on_media(jpeg.color(5), at(5)), Status::ok);
    EXPECT_EQ(receiver.on_media(raw.color(6), at(6)), Status::malformed);

    receiver.set_settings({{color_stream(camera), SettingId{0x8003}, "jpeg"}});
    for (Source* source : {&jpeg, &h264})
        source->set_color_id(SettingId{0x8003});
    EXPECT_EQ(receiver.on_media(jpeg.color(7), at(7)), Status::ok);
    EXPECT_EQ(receiver.on_media(h264.color(8, true), at(8)), Status::malformed);
}

TEST_F(ReceiverTest, AutomaticJpegMayBeHalvedTwiceAndOtherColorNever) {
    Source source("trvl", SettingId{1}, "jpeg");
    source.set_color_id(SettingId{0x8002});
    receiver.set_settings({{depth_stream(camera), SettingId{1}, "trvl"},
                           {color_stream(camera), SettingId{0x8002}, "auto"}});
    FrameNumber n = 0;
    for (const Size size : {picture, Size{16, 12}, Size{8, 6}}) {
        source.set_color_size(size);
        (void)receiver.on_media(source.depth(n), at(n));
        EXPECT_EQ(receiver.on_media(source.color(n), at(n)), Status::ok);
        ASSERT_EQ(frames.size(), n + 1);
        EXPECT_EQ(frames[n]->color->size, size);
        ++n;
    }
    for (const Size size : {Size{4, 3}, Size{16, 24}, Size{64, 48}, Size{15, 12}}) {
        source.set_color_size(size);
        EXPECT_EQ(receiver.on_media(source.color(n), at(n)), Status::size_mismatch);
    }
    receiver.set_settings({{color_stream(camera), SettingId{0x8003}, "jpeg"}});
    source.set_color_id(SettingId{0x8003});
    source.set_color_size({16, 12});
    EXPECT_EQ(receiver.on_media(source.color(n), at(n)), Status::size_mismatch);
}

// A decoder that answers when the test says, as a browser's.
class LateDecoder final : public video::ColorDecoder {
public:
    Status submit(ByteView, FrameNumber frame) override {
        waiting.push_back(frame);
        return Status::ok;
    }
    std::optional<Decoded> poll() override {
        if (finished == 0)
            return std::nullopt;
        --finished;
        Decoded decoded{waiting.front(), ColorImage(picture)};
        waiting.pop_front();
        decoded.image.pixels[0].r = std::uint8_t(decoded.frame);
        return decoded;
    }
    void recycle(ColorImage) override {}
    std::size_t pending() const override { return waiting.size(); }
    std::size_t take_failures() override { return std::exchange(failures, 0); }

    void fail() {
        failures = waiting.size();
        waiting.clear();
    }

    std::deque<FrameNumber> waiting;
    std::size_t finished = 0, failures = 0;
};

class LateColor : public ::testing::Test {
protected:
    LateColor() {
        Receiver::Events events;
        events.frame = [this](CameraFramePtr f) { frames.push_back(std::move(f)); };
        events.needs_key = [this](StreamId, SettingId) { ++keys_wanted; };
        events.make_color = [this](video::ColorCodecId) {
            auto made = std::make_unique<LateDecoder>();
            decoder = made.get();
            return made;
        };
        receiver.emplace(std::move(events));
        receiver->set_cameras({described()});
        receiver->set_settings({{depth_stream(camera), SettingId{1}, "rvl"},
                                {color_stream(camera), SettingId{0x8001}, "raw"}});
    }
    TimePoint at(FrameNumber n, int more_ms = 5) {
        return from_us(n * 33'333 + 1000 * std::uint64_t(more_ms));
    }

    std::vector<CameraFramePtr> frames;
    int keys_wanted = 0;
    LateDecoder* decoder = nullptr;
    std::optional<Receiver> receiver;
    Source source{"rvl"};
};

TEST_F(LateColor, IsShownWithItsDepthAndHasItsOwnAge) {
    for (FrameNumber n = 0; n < 2; ++n) {
        EXPECT_EQ(receiver->on_media(source.depth(n), at(n)), Status::ok);
        EXPECT_EQ(receiver->on_media(source.color(n), at(n)), Status::ok);
    }
    // The first image of depth did not wait for longer than until the second.
    ASSERT_EQ(frames.size(), 1u);
    EXPECT_FALSE(frames[0]->color);
    EXPECT_EQ(receiver->pending(), 2u);

    decoder->finished = 1;
    receiver->poll(at(1, 7));
    EXPECT_EQ(frames.size(), 1u);
    EXPECT_NEAR(receiver->figures(at(1, 7))[1].age_ms, 33.333 + 7, 0.01);
    decoder->finished = 1;
    receiver->poll(at(1, 15));
    ASSERT_EQ(frames.size(), 2u);
    EXPECT_EQ(frames[1]->number, 1u);
    EXPECT_EQ(frames[1]->color->pixels[0].r, 1);
    EXPECT_EQ(receiver->pending(), 0u);
    EXPECT_GT(receiver->figures(at(1, 15))[1].decode_ms, 10);
}

TEST_F(LateColor, ALateFailureIsCountedAndAskedForAsAKeyFrame) {
    for (FrameNumber n = 0; n < 3; ++n)
        (void)receiver->on_media(source.color(n, n == 0), at(n));
    decoder->fail();
    receiver->poll(at(3));
    EXPECT_EQ(keys_wanted, 1);
    const StreamFigures figures = receiver->figures(at(3))[1];
    EXPECT_EQ(figures.decoder_failures, 3u);
    EXPECT_EQ(figures.dropped, 3u);

    EXPECT_EQ(receiver->on_media(source.color(3), at(3)), Status::ok);
    decoder->finished = 1;
    receiver->poll(at(4));
    EXPECT_EQ(receiver->figures(at(4))[1].frames, 1u);
}

// A browser's decoder may be asked for more than it finishes, and nobody polls a hidden page.
TEST_F(LateColor, PicturesThatADecoderLeavesOutHoldNothingUp) {
    for (FrameNumber n = 0; n < 3; ++n)
        (void)receiver->on_media(source.color(n), at(n));
    decoder->waiting.erase(decoder->waiting.begin(), decoder->waiting.begin() + 2);
    decoder->finished = 1;
    receiver->poll(at(3));
    EXPECT_EQ(receiver->figures(at(3))[1].frames, 1u);
    EXPECT_NEAR(receiver->figures(at(3))[1].age_ms, 33.333 + 5, 0.01);
}

class DepthOnly : public ReceiverTest {
protected:
    DepthOnly() : ReceiverTest(false) {}
};

TEST_F(DepthOnly, NeedsNoColor) {
    Source source;
    (void)receiver.on_media(source.depth(0), at(0));
    EXPECT_EQ(frames.size(), 1u);
}

TEST_F(DepthOnly, ALostFrameIsCountedAndAKeyFrameAskedForOnce) {
    Source source;
    (void)receiver.on_media(source.depth(0), at(0));
    (void)source.depth(1);
    EXPECT_EQ(receiver.on_media(source.depth(2), at(2)), Status::missing_reference);
    EXPECT_EQ(receiver.on_media(source.depth(3), at(3)), Status::missing_reference);
    EXPECT_EQ(keys_wanted, std::vector{depth_stream(camera)});
    EXPECT_EQ(frames.size(), 1u);
    // Asked again if none comes.
    (void)receiver.on_media(source.depth(40), at(40));
    EXPECT_EQ(keys_wanted.size(), 2u);
    EXPECT_EQ(receiver.on_media(source.depth(41, true), at(41)), Status::ok);
    EXPECT_EQ(frames.back()->depth, Source::scene(41));
    EXPECT_EQ(receiver.figures(at(41))[0].dropped, 40u);
}

TEST_F(DepthOnly, AMissingUpperLayerIsSkippedWithoutAKeyFrame) {
    set_depth("trvl:layers=2", SettingId{2});
    Source source("trvl:layers=2", SettingId{2});
    std::vector<Bytes> messages;
    for (FrameNumber n = 0; n < 7; ++n)
        messages.push_back(source.depth(n));
    for (const FrameNumber n : {0u, 2u, 3u, 4u, 6u})
        EXPECT_EQ(receiver.on_media(messages[n], at(n)), Status::ok) << n;
    EXPECT_TRUE(keys_wanted.empty());
    EXPECT_EQ(frames.size(), 5u);
}

TEST_F(DepthOnly, FramesOfAnotherSettingAreLeftAlone) {
    Source old_source("trvl", SettingId{1}), new_source("rvl", SettingId{2});
    (void)receiver.on_media(old_source.depth(0), at(0));
    set_depth("rvl", SettingId{2});
    EXPECT_EQ(receiver.on_media(old_source.depth(1), at(1)), Status::ok);
    EXPECT_EQ(frames.size(), 1u);
    (void)receiver.on_media(new_source.depth(2), at(2));
    EXPECT_EQ(frames.size(), 2u);
    EXPECT_EQ(frames[1]->depth, Source::scene(2));
}

TEST_F(DepthOnly, DamageIsCountedAndAnsweredWithAKeyFrame) {
    Source source;
    Bytes message = source.depth(0);
    message[wire::media_header_size] = std::byte{0xee};
    EXPECT_NE(receiver.on_media(message, at(0)), Status::ok);
    EXPECT_EQ(receiver.refused(), 1u);
    EXPECT_EQ(keys_wanted.size(), 1u);
    EXPECT_NE(receiver.on_media(ByteView(message).first(10), at(0)), Status::ok);
    EXPECT_EQ(receiver.refused(), 2u);
}

TEST_F(DepthOnly, FiguresTellRateAndAge) {
    Source source("rvl", SettingId{2});
    set_depth("rvl", SettingId{2});
    for (FrameNumber n = 0; n < 60; ++n)
        (void)receiver.on_media(source.depth(n), at(n));
    const StreamFigures figures = receiver.figures(at(59))[0];
    EXPECT_NEAR(figures.frames_per_second, 30, 1);
    EXPECT_NEAR(figures.age_p50_ms, 5, 0.01);
    EXPECT_EQ(figures.frames, 60u);
    EXPECT_EQ(figures.dropped, 0u);
    EXPECT_GT(figures.mbit_per_second, 0);
    receiver.forget_ages();
    EXPECT_EQ(receiver.figures(at(59))[0].age_p50_ms, 0);
    EXPECT_EQ(receiver.figures(at(59))[0].age_max_ms, 0);
    EXPECT_EQ(receiver.figures(at(59))[0].frames, 60u);
    receiver.reset_figures();
    EXPECT_EQ(receiver.figures(at(59))[0].frames, 0u);
}

// A stream has no decoder until the host has said how it sends.
TEST(Receiver, MediaBeforeAnySettingIsPassedOver) {
    for (const SettingId setting : {SettingId{0}, SettingId{1}}) {
        Receiver receiver({[](CameraFramePtr) {}, [](StreamId, SettingId) {}});
        receiver.set_cameras({described()});
        Source source("trvl", setting);
        source.set_color_id(setting);
        EXPECT_EQ(receiver.on_media(source.depth(0), from_us(0)), Status::ok);
        EXPECT_EQ(receiver.on_media(source.color(0), from_us(0)), Status::ok);
        EXPECT_EQ(receiver.figures(from_us(0))[0].frames, 0u);
    }
}

TEST_F(ReceiverTest, PicturesOfAnotherSizeThanTheCalibrationsAreRefusedAndCounted) {
    receiver.set_cameras({described(true, {64, 48}, picture)});
    set_depth("trvl", SettingId{1});
    Source source;
    EXPECT_EQ(receiver.on_media(source.depth(0), at(0)), Status::size_mismatch);
    EXPECT_EQ(receiver.on_media(source.color(0), at(0)), Status::ok);
    receiver.set_cameras({described(true, picture, {64, 48})});
    set_depth("trvl", SettingId{1});
    EXPECT_EQ(receiver.on_media(source.depth(1, true), at(1)), Status::ok);
    EXPECT_EQ(receiver.on_media(source.color(1), at(1)), Status::size_mismatch);
    EXPECT_EQ(receiver.refused(), 2u);
    EXPECT_EQ(receiver.figures(at(1))[1].dropped, 1u);
}

TEST_F(ReceiverTest, AMessageLargerThanThePictureCanNeedIsRefusedUnread) {
    Source source;
    Bytes huge = source.depth(0, true);
    const std::size_t most = max_media_size(described(), depth_stream(camera));
    EXPECT_EQ(most, max_media_size(picture.area()));
    auto header = *wire::parse_media_header(huge);
    header.payload_size = std::uint32_t(most + 1 - wire::media_header_size);
    huge.resize(most + 1);
    wire::write_media_header(header, huge.data());
    EXPECT_EQ(receiver.on_media(huge, at(0)), Status::too_large);
    EXPECT_EQ(receiver.refused(), 1u);
    EXPECT_EQ(max_media_size(described(), StreamId{77}), 0u);
}

TEST_F(DepthOnly, ASettingOfNumberZeroIsLikeAnyOther) {
    set_depth("rvl", SettingId{0});
    Source source("rvl", SettingId{0});
    EXPECT_EQ(receiver.on_media(source.depth(0), at(0)), Status::ok);
    EXPECT_EQ(frames.size(), 1u);
}

TEST_F(DepthOnly, AfterACodecFromTheFutureTheOldOneStillDecodes) {
    Source source;
    EXPECT_THROW(set_depth("holograms", SettingId{9}), Error);
    EXPECT_EQ(receiver.on_media(source.depth(0), at(0)), Status::ok);
    EXPECT_EQ(frames.size(), 1u);
}

TEST_F(DepthOnly, ACodecFromTheFutureIsNamed) {
    EXPECT_THROW(set_depth("holograms", SettingId{9}), Error);
}

}  // namespace
}  // namespace theatron::receive
