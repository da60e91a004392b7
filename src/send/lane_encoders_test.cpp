// SPDX-License-Identifier: Apache-2.0
#include "send/lane_encoders.h"

#include <gtest/gtest.h>

#include <deque>
#include <map>

#include "video/depth_codecs.h"

namespace theatron::send {
namespace {

constexpr CameraId camera{2};
constexpr Size size{32, 24};
constexpr SettingId cheap{1}, dear{2}, other{3};
constexpr Duration share = 4ms;

// An encoder that takes a given time of a fake CPU.
class CostlyCodec final : public codec::DepthCodec {
public:
    CostlyCodec(std::unique_ptr<codec::DepthCodec> codec, const Duration& cost, Duration& cpu)
        : codec_(std::move(codec)), cost_(cost), cpu_(cpu) {}
    bool lossless() const override { return codec_->lossless(); }
    bool temporal() const override { return codec_->temporal(); }
    std::size_t max_encoded_size(Size s) const override { return codec_->max_encoded_size(s); }
    std::size_t encode(DepthView depth, const codec::Reference* reference, std::span<std::byte> out,
                       codec::Reference* next) override {
        cpu_ += cost_;
        return codec_->encode(depth, reference, out, next);
    }
    Result<Size> read_size(ByteView encoded) const override { return codec_->read_size(encoded); }
    Status decode(ByteView encoded, const codec::Reference* reference, MutableDepthView out,
                  codec::Reference* next) override {
        return codec_->decode(encoded, reference, out, next);
    }

private:
    std::unique_ptr<codec::DepthCodec> codec_;
    const Duration& cost_;
    Duration& cpu_;
};

// An encoder that fails on demand.
class FailingColor final : public video::ColorEncoder {
public:
    explicit FailingColor(const bool& fails) : fails_(fails) {}
    Result<video::EncodedColor> encode(const ColorData&, bool key) override {
        if (fails_)
            return Status::malformed;
        asked_.push_back(key);
        return video::EncodedColor{bytes_, key};
    }

private:
    const bool& fails_;
    std::vector<bool> asked_;
    Bytes bytes_ = Bytes(8);
};

class Encoders : public ::testing::Test {
protected:
    Encoders() {
        LaneEncoders::Events events;
        events.publish = [this](EncodedMedia media) {
            published[media.header.setting].push_back(std::move(media));
        };
        events.key_due = [this](StreamId, SettingId setting) { due.push_back(setting); };
        events.keeps_up = [this](SettingId setting, bool keeps_up, Duration) {
            reported.push_back({setting, keeps_up});
        };
        LaneEncoders::Environment environment;
        environment.now = [] { return TimePoint(); };
        environment.cpu_time = [this] { return cpu; };
        environment.behind = [this](std::function<void()> work) {
            behind.push_back(std::move(work));
        };
        environment.share = share;
        environment.make_depth = [this](const codec::DepthSetting& setting) {
            return codec::DepthStreamEncoder(
                std::make_unique<CostlyCodec>(video::make_depth_codec(setting), costs[setting.text],
                                              cpu),
                setting.layers);
        };
        environment.make_color = [this](const video::ColorSetting&) {
            return std::make_unique<FailingColor>(color_fails);
        };
        encoders = std::make_unique<LaneEncoders>(camera, events, environment);
        costs["trvl"] = 1ms;
        costs["zstd:delta=1,level=19"] = 150ms;
        costs["ans:delta=1"] = 3ms;
    }
    ~Encoders() override {
        while (do_behind()) {
        }
    }

    static DepthImage scene(FrameNumber n) {
        DepthImage image(size);
        for (std::size_t i = 0; i < image.pixels.size(); ++i)
            image.pixels[i] = std::uint16_t(1000 + n * 3 + i % 50);
        return image;
    }
    void set(std::vector<LaneSetting> depth, std::vector<LaneSetting> color = {}) {
        encoders->set_settings(depth, color);
    }
    void give_depth() {
        wire::MediaHeader header;
        header.frame = next++;
        encoders->encode_depth(scene(header.frame).view(), header, keys);
        keys.clear();
    }
    void give_color() {
        const auto frame = std::make_shared<Frame>();
        frame->color.size = size;
        frame->color.pixels = ColorImage(size);
        wire::MediaHeader header;
        header.frame = next++;
        (void)encoders->encode_color(frame, header, keys);
        keys.clear();
    }
    // One picture that was left to the threads behind; false if there is none.
    bool do_behind() {
        if (behind.empty())
            return false;
        const auto work = std::move(behind.front());
        behind.pop_front();
        work();
        return true;
    }
    // Everything that was published in this setting decodes, each to the frame it says.
    void expect_whole_chain(SettingId setting, const std::string& codec) {
        codec::DepthStreamDecoder decoder(
            video::make_depth_decoder(video::parse_depth_setting(codec).setting));
        for (const EncodedMedia& media : published[setting]) {
            const wire::MediaHeader& h = media.header;
            DepthImage out(size);
            ASSERT_EQ(decoder.decode({h.frame, h.reference, h.temporal_layer, h.key},
                                     wire::media_payload(*media.message), out.view()),
                      Status::ok)
                << h.frame;
            ASSERT_EQ(out, scene(h.frame)) << h.frame;
        }
    }

    std::map<std::string, Duration> costs;
    Duration cpu{};
    bool color_fails = false;
    WantedKeys keys;
    FrameNumber next = 0;
    std::map<SettingId, std::vector<EncodedMedia>> published;
    std::vector<SettingId> due;
    std::vector<std::pair<SettingId, bool>> reported;
    std::deque<std::function<void()>> behind;
    std::unique_ptr<LaneEncoders> encoders;
};

TEST_F(Encoders, ACheapSettingLosesNoFrameBesideADearOne) {
    set({{cheap, "trvl"}});
    for (int i = 0; i < 10; ++i)
        give_depth();
    set({{cheap, "trvl"}, {dear, "zstd:delta=1,level=19"}});
    for (int i = 0; i < 100; ++i) {
        give_depth();
        // The threads behind manage a picture in the time of five.
        if (i % 5 == 4)
            do_behind();
    }
    EXPECT_EQ(published[cheap].size(), 110u);
    EXPECT_EQ(published[dear].size(), 20u);
    expect_whole_chain(cheap, "trvl");
    expect_whole_chain(dear, "zstd:delta=1,level=19");
    EXPECT_EQ(encoders->figures()[1].left_out, 80u);
    EXPECT_TRUE(encoders->figures()[1].behind);
    EXPECT_EQ(reported, (std::vector{std::pair(dear, false)}));
}

TEST_F(Encoders, ADearOneThatWasFirstMakesWayForACheapOne) {
    set({{dear, "zstd:delta=1,level=19"}});
    for (int i = 0; i < 10; ++i)
        give_depth();
    EXPECT_EQ(published[dear].size(), 10u) << "alone it slows down nobody";
    set({{dear, "zstd:delta=1,level=19"}, {cheap, "trvl"}});
    int at_once = 0;
    for (int i = 0; i < 10; ++i) {
        const Duration before = cpu;
        give_depth();
        at_once += cpu - before >= 150ms;
        do_behind();
    }
    EXPECT_EQ(published[cheap].size(), 10u);
    EXPECT_EQ(at_once, 0) << "also before the new one is measured";
    expect_whole_chain(dear, "zstd:delta=1,level=19");
}

TEST_F(Encoders, ADearFirstPictureMakesNoOtherSettingWait) {
    set({{dear, "zstd:delta=1,level=19"}, {cheap, "trvl"}});
    for (int i = 0; i < 10; ++i) {
        const Duration before = cpu;
        give_depth();
        EXPECT_EQ(cpu - before, 1ms) << i;
        do_behind();
    }
    EXPECT_EQ(published[cheap].size(), 10u);
    EXPECT_EQ(published[dear].size(), 10u);
    expect_whole_chain(dear, "zstd:delta=1,level=19");
}

TEST_F(Encoders, ASettingWithinItsShareComesAtOnceSoonAfterItsFirstFrames) {
    set({{cheap, "trvl"}});
    for (int i = 0; i < 5; ++i)
        give_depth();
    set({{cheap, "trvl"}, {other, "ans:delta=1"}});
    for (int i = 0; i < 10; ++i) {
        give_depth();
        while (do_behind()) {
        }
    }
    EXPECT_FALSE(encoders->figures()[1].behind);
    EXPECT_EQ(published[other].size(), 10u);
    EXPECT_TRUE(reported.empty());
    expect_whole_chain(other, "ans:delta=1");
}

// A recording may begin with the first frame of a setting.
TEST_F(Encoders, ANewSettingLosesNoneOfItsFirstFramesWhileTheThreadsBehindAreBusy) {
    set({{cheap, "trvl"}});
    for (int i = 0; i < 5; ++i)
        give_depth();
    set({{cheap, "trvl"}, {other, "ans:delta=1"}});
    for (int i = 0; i < 6; ++i)
        give_depth();
    EXPECT_EQ(published[other].size(), 0u);
    for (int i = 0; i < 3; ++i)  // it is known now, and frames wait still
        do_behind();
    give_depth();
    while (do_behind()) {
    }
    for (int i = 0; i < 10; ++i)
        give_depth();
    EXPECT_EQ(published[other].size(), 17u);
    EXPECT_EQ(encoders->figures()[1].left_out, 0u);
    EXPECT_FALSE(encoders->figures()[1].behind);
    expect_whole_chain(other, "ans:delta=1");
}

TEST_F(Encoders, NobodyIsToldThatASettingIsTooDearBeforeItIsMeasured) {
    set({{cheap, "trvl"}});
    for (int i = 0; i < 5; ++i)
        give_depth();
    set({{cheap, "trvl"}, {other, "ans:delta=1"}});
    // The threads behind are busy with requests of others.
    for (int i = 0; i < 2 * KeepingUp::window; ++i)
        give_depth();
    for (int i = 0; i < 10; ++i) {
        do_behind();
        give_depth();
    }
    EXPECT_FALSE(encoders->figures()[1].behind);
    EXPECT_TRUE(reported.empty());
}

TEST_F(Encoders, AKeyFrameWantedOfABusyEncoderComesNext) {
    set({{cheap, "trvl"}});
    give_depth();
    give_depth();
    set({{cheap, "trvl"}, {dear, "zstd:delta=1,level=19"}});
    for (int i = 0; i < 2; ++i) {
        give_depth();
        do_behind();
    }
    give_depth();
    keys = {{depth_stream(camera), dear}};
    give_depth();  // it is busy with the one before
    EXPECT_TRUE(due.empty());
    do_behind();
    EXPECT_EQ(due, std::vector{dear}) << "the lane may have no frame for long";
    give_depth();
    do_behind();
    ASSERT_EQ(published[dear].size(), 4u);
    EXPECT_TRUE(published[dear][3].header.key);
    EXPECT_FALSE(published[cheap].back().header.key);
    expect_whole_chain(dear, "zstd:delta=1,level=19");
}

TEST_F(Encoders, AnEncoderThatFailedGoesOnWithAKeyFrame) {
    set({}, {{cheap, "jpeg"}});
    give_color();
    give_color();
    ASSERT_EQ(published[cheap].size(), 2u);
    EXPECT_FALSE(published[cheap][1].header.key);
    color_fails = true;
    give_color();
    give_color();
    color_fails = false;
    give_color();
    give_color();
    ASSERT_EQ(published[cheap].size(), 4u);
    EXPECT_TRUE(published[cheap][2].header.key) << "what the failed picture left is not known";
    EXPECT_FALSE(published[cheap][3].header.key);
    EXPECT_EQ(published[cheap][3].header.reference, published[cheap][2].header.frame);
}

TEST_F(Encoders, ASettingThatIsLeftWhileItIsEncodedBehindEndsInPeace) {
    set({{cheap, "trvl"}});
    give_depth();
    give_depth();
    set({{cheap, "trvl"}, {dear, "zstd:delta=1,level=19"}});
    give_depth();
    set({{cheap, "trvl"}});
    give_depth();
    EXPECT_TRUE(do_behind());
    EXPECT_EQ(published[cheap].size(), 4u);
}

}  // namespace
}  // namespace theatron::send
