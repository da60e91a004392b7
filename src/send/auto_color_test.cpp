// SPDX-License-Identifier: Apache-2.0
#include "send/auto_color.h"

#include <gtest/gtest.h>

namespace theatron::send {
namespace {

constexpr Size size{64, 48};

ColorData picture(int number) {
    ColorData color;
    color.size = size;
    color.pixels = ColorImage(size);
    for (std::size_t i = 0; i < color.pixels.pixels.size(); ++i)
        color.pixels.pixels[i] = {std::uint8_t(i % 97 + std::size_t(number)), 80, 120};
    return color;
}

TEST(AutoColorEncoder, ChangesItsCodecBetweenPicturesAndBeginsWithAKeyFrame) {
    if (!video::missing_color_encoder(video::parse_color_setting(auto_h264).setting).empty())
        GTEST_SKIP() << "there is no H.264 encoder on this machine";
    const auto is_h264 = std::make_shared<AutoColor>(false);
    const auto encoder = make_auto_encoder(is_h264);
    const auto jpeg = video::make_color_decoder(video::ColorCodecId::jpeg);
    const auto h264 = video::make_color_decoder(video::ColorCodecId::h264);
    std::string codecs;
    for (int i = 0; i < 9; ++i) {
        *is_h264 = i % 6 >= 3;
        const auto encoded = encoder->encode(picture(i), false);
        ASSERT_TRUE(encoded) << i;
        const bool sent_h264 = encoded->codec == video::ColorCodecId::h264;
        codecs += sent_h264 ? (encoded->key ? 'K' : 'h') : 'j';
        EXPECT_EQ((sent_h264 ? h264 : jpeg)->submit(encoded->bytes, FrameNumber(i)), Status::ok);
    }
    EXPECT_EQ(codecs, "jjjKhhjjj");
}

TEST(AutoColorEncoder, SendsACamerasOwnJpegUntouched) {
    const auto made =
        video::make_color_encoder(video::parse_color_setting("jpeg:quality=40").setting);
    ColorData camera;
    camera.size = size;
    const ByteView bytes = made->encode(picture(1), true)->bytes;
    camera.jpeg.assign(bytes.begin(), bytes.end());
    const auto encoder = make_auto_encoder(std::make_shared<AutoColor>(false));
    const auto encoded = encoder->encode(camera, true);
    ASSERT_TRUE(encoded);
    EXPECT_EQ(Bytes(encoded->bytes.begin(), encoded->bytes.end()), camera.jpeg);
}

TEST(AutoColorEncoder, ADamagedPictureIsLeftOutAndH264GoesOn) {
    if (!video::missing_color_encoder(video::parse_color_setting(auto_h264).setting).empty())
        GTEST_SKIP() << "there is no H.264 encoder on this machine";
    const auto encoder = make_auto_encoder(std::make_shared<AutoColor>(true));
    ColorData damaged;
    damaged.size = size;
    damaged.jpeg = Bytes(100);
    EXPECT_FALSE(encoder->encode(damaged, true));
    const auto encoded = encoder->encode(picture(1), true);
    ASSERT_TRUE(encoded);
    EXPECT_EQ(encoded->codec, video::ColorCodecId::h264);
}

}  // namespace
}  // namespace theatron::send
