// SPDX-License-Identifier: Apache-2.0
#include "client/picture_sender.h"

#include <gtest/gtest.h>

#include "codec/depth_stream.h"
#include "geometry/screen.h"
#include "session/own_pictures.h"
#include "video/color_codec.h"

namespace theatron::client {
namespace {

constexpr CameraId own{5}, other{6};

class PictureSenderTest : public ::testing::Test {
protected:
    std::vector<PictureSender::Media> messages() {
        return sender.messages(jpeg, from_us(1000), from_us(3000));
    }
    const Bytes jpeg = Bytes(100, std::byte{9});
    PictureSender sender;
    const Participant::Publishing events = sender.events();
};

TEST_F(PictureSenderTest, OffersWhatTheHostTakes) {
    const wire::OfferedCamera offer = PictureSender::face({320, 240}, 10);
    EXPECT_EQ(offer.kind, wire::CameraKind::face);
    EXPECT_FALSE(offer.may_record);
    const auto calibration = decode_calibration(offer.calibration);
    ASSERT_TRUE(calibration);
    EXPECT_TRUE(session::is_within(session::face_limits, *calibration, offer.frames_per_second));
}

TEST_F(PictureSenderTest, SendsNothingUntilTheHostWantsIt) {
    EXPECT_FALSE(sender.is_taken());
    EXPECT_TRUE(messages().empty());
    events.published({own});
    EXPECT_TRUE(sender.is_taken());
    EXPECT_TRUE(messages().empty());
    events.encode({{color_stream(own), SettingId{3}, "jpeg:quality=75"}});
    EXPECT_EQ(messages().size(), 1u);
    events.published({});
    EXPECT_TRUE(messages().empty()) << "the connection is lost";
}

TEST_F(PictureSenderTest, APictureIsThePlaneOfAScreenAndTheJpeg) {
    events.published({own});
    events.encode({{depth_stream(own), SettingId{2}, std::string(session::face_limits.depth_codec)},
                   {color_stream(own), SettingId{3}, std::string(session::face_limits.color_codec)},
                   {color_stream(other), SettingId{4}, "jpeg"}});
    const auto sent = messages();
    ASSERT_EQ(sent.size(), 2u);
    for (const PictureSender::Media& media : sent) {
        const auto header = wire::parse_media_header(*media.message);
        ASSERT_TRUE(header);
        EXPECT_TRUE(header->key);
        EXPECT_EQ(header->frame, sent[0].header.frame) << "of one moment";
        EXPECT_EQ(header->captured, from_us(1000));
        EXPECT_LT(media.message->size(), session::max_face_message);
    }
    EXPECT_EQ(sent[0].header.stream, depth_stream(own));
    codec::DepthStreamDecoder decoder(codec::parse_depth_setting("raw").setting);
    DepthImage plane(screen_grid);
    codec::FrameLink link;
    link.key = true;
    ASSERT_EQ(decoder.decode(link, wire::media_payload(*sent[0].message), plane.view()),
              Status::ok);
    EXPECT_EQ(plane.pixels.front(), screen_distance_mm);
    EXPECT_EQ(sent[1].header.codec, std::uint8_t(video::ColorCodecId::jpeg));
    const ByteView payload = wire::media_payload(*sent[1].message);
    EXPECT_TRUE(std::equal(payload.begin(), payload.end(), jpeg.begin(), jpeg.end()));
    EXPECT_NE(messages()[0].header.frame, sent[0].header.frame);
}

TEST_F(PictureSenderTest, LeavesOutWhatItCannotEncode) {
    events.published({own});
    events.encode({{depth_stream(own), SettingId{2}, "of next year"},
                   {color_stream(own), SettingId{3}, "h264:crf=20"}});
    EXPECT_TRUE(messages().empty());
}

TEST_F(PictureSenderTest, AScreenIsOfferedWithinTheHostsLimits) {
    const wire::OfferedCamera offer = PictureSender::screen("Screen of Ada", {1920, 1200}, 8);
    EXPECT_EQ(offer.kind, wire::CameraKind::screen);
    EXPECT_EQ(offer.name, "Screen of Ada");
    EXPECT_FALSE(offer.may_record);
    const auto calibration = decode_calibration(offer.calibration);
    ASSERT_TRUE(calibration);
    EXPECT_TRUE(session::is_within(session::screen_limits, *calibration, offer.frames_per_second));
    events.published({own});
    events.encode(
        {{depth_stream(own), SettingId{2}, std::string(session::screen_limits.depth_codec)},
         {color_stream(own), SettingId{3}, std::string(session::screen_limits.color_codec)}});
    EXPECT_EQ(messages().size(), 2u);
}

TEST_F(PictureSenderTest, OneThatOthersEndedSendsNothingMore) {
    events.published({own});
    events.encode({{color_stream(own), SettingId{3}, "jpeg:quality=85"}});
    events.ended({other});
    EXPECT_FALSE(sender.take_ended());
    EXPECT_EQ(messages().size(), 1u);
    events.ended({other, own});
    EXPECT_FALSE(sender.is_taken());
    EXPECT_TRUE(messages().empty());
    EXPECT_TRUE(sender.take_ended());
    EXPECT_FALSE(sender.take_ended()) << "it is told once";
}

}  // namespace
}  // namespace theatron::client
