// SPDX-License-Identifier: Apache-2.0
#include "relay/fan_out.h"

#include <gtest/gtest.h>

namespace theatron::relay {
namespace {

using namespace std::chrono_literals;

constexpr ParticipantId ann{1}, ben{2};
constexpr StreamId fan_stream{6};
constexpr SettingId fan_setting{3}, fan_other{4};

class FanOutTest : public ::testing::Test {
protected:
    FanOutTest()
        : fan_out({[this](ParticipantId id, const net::Media& media) {
                       got[id].push_back(media.frame);
                       net::Outbox::Pushed pushed;
                       pushed.needs_key = losing.erase(id) > 0;
                       pushed.dropped = pushed.needs_key;
                       if (slow.contains(id))
                           behind.insert(id);
                       return pushed;
                   },
                   [this](ParticipantId id, StreamId) { return behind.contains(id); }}) {}

    // A frame of a chain with temporal layers, every fourth one of layer 0.
    void film(int frames = 1, bool key = false) {
        for (int i = 0; i < frames; ++i) {
            wire::MediaHeader header;
            header.stream = fan_stream;
            header.setting = fan_setting;
            header.frame = ++frame;
            header.key = key || frame == 1;
            if (header.key)
                begun = frame;
            const FrameNumber place = (frame - begun) % 4;
            header.temporal_layer = place == 0 ? 0 : place == 2 ? 1 : 2;
            header.reference = header.key   ? frame
                               : place == 0 ? frame - 4
                               : place == 2 ? frame - 2
                                            : frame - 1;
            fan_out.on_media(header, std::make_shared<const Bytes>(1000), now);
            now += 33ms;
        }
    }
    // Independent frames of the other setting, of this layer.
    void show(int layer) {
        wire::MediaHeader header;
        header.stream = StreamId{7};
        header.setting = fan_other;
        header.frame = header.reference = ++frame;
        header.key = true;
        header.temporal_layer = std::uint8_t(layer);
        fan_out.on_media(header, std::make_shared<const Bytes>(1000), now);
    }
    void wish(int layer = 2) {
        fan_out.set_wishes({{ann, {{fan_setting, layer}}}, {ben, {{fan_setting, layer}}}}, now);
    }
    // The frames that came since the last call.
    std::vector<FrameNumber> take(ParticipantId id) { return std::exchange(got[id], {}); }
    std::size_t keys() { return fan_out.take_keys(now).size(); }

    TimePoint now = from_us(1'000'000);
    FrameNumber frame = 0, begun = 0;
    std::map<ParticipantId, std::vector<FrameNumber>> got;
    std::set<ParticipantId> losing, slow, behind;
    FanOut fan_out;
};

TEST_F(FanOutTest, EveryReceiverGetsEachFrameOfItsSetting) {
    wish();
    fan_out.come(ann, now);
    fan_out.come(ben, now);
    film(6);
    EXPECT_EQ(take(ann), (std::vector<FrameNumber>{1, 2, 3, 4, 5, 6}));
    EXPECT_EQ(take(ben), (std::vector<FrameNumber>{1, 2, 3, 4, 5, 6}));
    show(0);
    EXPECT_TRUE(take(ann).empty()) << "another setting";
    EXPECT_EQ(keys(), 0u);
}

TEST_F(FanOutTest, ALatecomerBeginsWithTheKeyFrameAndLayerZeroSince) {
    wish();
    film(14);
    fan_out.come(ann, now);
    EXPECT_EQ(take(ann), (std::vector<FrameNumber>{1, 5, 9, 13}));
    film(5);
    EXPECT_EQ(take(ann), (std::vector<FrameNumber>{17, 18, 19}))
        << "frames 15 and 16 may refer to some that were not sent";
    EXPECT_EQ(keys(), 0u) << "nobody asks the host";
}

TEST_F(FanOutTest, ALatecomerCatchesUpAsFastAsItsLinkTakesIt) {
    wish();
    film(14);
    slow.insert(ann);
    fan_out.come(ann, now);
    EXPECT_EQ(take(ann), std::vector<FrameNumber>{1});
    film(4);
    EXPECT_TRUE(take(ann).empty()) << "the first one has not left";
    for (const FrameNumber next : {5u, 9u, 13u, 17u}) {
        behind.clear();
        fan_out.on_left(ann);
        EXPECT_EQ(take(ann), std::vector<FrameNumber>{next});
    }
    behind.clear();
    fan_out.on_left(ann);
    slow.clear();
    film(4);
    EXPECT_EQ(take(ann), (std::vector<FrameNumber>{21, 22}));
}

TEST_F(FanOutTest, ANewKeyFrameBeginsAnewWhileOneCatchesUp) {
    wish();
    film(14);
    slow.insert(ann);
    fan_out.come(ann, now);
    film(1, true);
    behind.clear();
    fan_out.on_left(ann);
    EXPECT_EQ(take(ann), (std::vector<FrameNumber>{1, 15}));
}

TEST_F(FanOutTest, WithAnOldChainAKeyFrameIsAskedForOnceInTwoSeconds) {
    wish();
    film(70);
    fan_out.come(ann, now);
    EXPECT_TRUE(take(ann).empty());
    EXPECT_EQ(keys(), 1u);
    fan_out.come(ben, now);
    film(3);
    EXPECT_EQ(keys(), 0u) << "it was asked for";
    film(1, true);
    EXPECT_EQ(take(ann), std::vector<FrameNumber>{74});
    EXPECT_EQ(take(ben), std::vector<FrameNumber>{74});
    EXPECT_EQ(keys(), 0u);
}

TEST_F(FanOutTest, ALostKeyFrameIsAskedForAgain) {
    wish();
    film(70);
    fan_out.come(ann, now);
    EXPECT_EQ(keys(), 1u);
    film(59);
    EXPECT_EQ(keys(), 0u);
    film(3);
    EXPECT_EQ(keys(), 1u);
}

TEST_F(FanOutTest, KeyFramesAreASmallShareOfAStream) {
    wish();
    film(3);
    // A key frame of 400 kB beside 30 kB a second.
    wire::MediaHeader header;
    header.stream = fan_stream;
    header.setting = fan_setting;
    header.frame = header.reference = ++frame;
    header.key = true;
    begun = frame;
    fan_out.on_media(header, std::make_shared<const Bytes>(400'000), now);
    now += 33ms;
    film(200);
    fan_out.come(ann, now);
    EXPECT_EQ(keys(), 1u);
    film(100);
    EXPECT_EQ(keys(), 0u);
    film(90);
    EXPECT_EQ(keys(), 1u);
}

TEST_F(FanOutTest, AReceiverWhoseLinkLostAFrameGoesOnWithAKeyFrame) {
    wish();
    fan_out.come(ann, now);
    fan_out.come(ben, now);
    film(2);
    (void)take(ann);
    (void)take(ben);
    losing.insert(ann);
    film(2);
    EXPECT_EQ(take(ann), std::vector<FrameNumber>{3});
    EXPECT_EQ(take(ben), (std::vector<FrameNumber>{3, 4})) << "the others notice nothing";
    EXPECT_EQ(keys(), 1u);
    film(1, true);
    EXPECT_EQ(take(ann), std::vector<FrameNumber>{5});
}

TEST_F(FanOutTest, LayersAreLeftOutByTheHeaderAlone) {
    wish(1);
    fan_out.come(ann, now);
    film(8);
    EXPECT_EQ(take(ann), (std::vector<FrameNumber>{1, 3, 5, 7}));
    wish(0);
    film(4);
    EXPECT_EQ(take(ann), std::vector<FrameNumber>{9});
    wish(2);
    film(5);
    EXPECT_EQ(take(ann), (std::vector<FrameNumber>{13, 14, 15, 16, 17}));
}

TEST_F(FanOutTest, OfFramesThatDoNotReferToOneAnotherTheLayersAreLeftOut) {
    fan_out.set_wishes({{ann, {{fan_other, 0}}}}, now);
    fan_out.come(ann, now);
    for (const int layer : {0, 2, 1, 2, 0})
        show(layer);
    EXPECT_EQ(take(ann), (std::vector<FrameNumber>{1, 5}));
    fan_out.set_wishes({{ann, {{fan_other, 0}}}, {ben, {{fan_other, 0}}}}, now);
    show(2);
    fan_out.come(ben, now);
    EXPECT_EQ(take(ben), std::vector<FrameNumber>{5}) << "the newest one for everybody";
}

TEST_F(FanOutTest, FramesThatWereLostHereBeginNoChain) {
    wish();
    fan_out.come(ann, now);
    film(6);
    (void)take(ann);
    fan_out.on_lost();
    film(4);
    EXPECT_TRUE(take(ann).empty());
    EXPECT_EQ(keys(), 1u);
    fan_out.come(ben, now);
    EXPECT_TRUE(take(ben).empty());
    film(1, true);
    EXPECT_EQ(take(ann).size(), 1u);
    EXPECT_EQ(take(ben).size(), 1u);
}

TEST_F(FanOutTest, AChainWithAGapIsForgotten) {
    wish();
    film(6);
    frame += 4;  // a frame of layer 0 is missing
    film(4);
    fan_out.come(ann, now);
    EXPECT_TRUE(take(ann).empty());
    EXPECT_EQ(keys(), 1u);
    EXPECT_EQ(fan_out.cached_bytes(), 0u);
}

TEST_F(FanOutTest, WhatNobodyWishesForIsForgotten) {
    wish();
    fan_out.come(ann, now);
    film(6);
    EXPECT_EQ(fan_out.cached_bytes(), 2000u);
    fan_out.set_wishes({}, now);
    EXPECT_EQ(fan_out.cached_bytes(), 0u);
    (void)take(ann);
    film(1, true);
    EXPECT_TRUE(take(ann).empty()) << "the host names it no longer";
}

TEST_F(FanOutTest, MemoryIsBounded) {
    wish();
    film(int(FanOut::max_chain_frames) * 5);
    EXPECT_LE(fan_out.cached_bytes(), FanOut::max_chain_frames * 1000);
}

}  // namespace
}  // namespace theatron::relay
