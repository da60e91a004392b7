// SPDX-License-Identifier: Apache-2.0
#include "send/auto_color.h"

#include <gtest/gtest.h>

#include <random>

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
    const auto encoder = make_auto_encoder(is_h264, {});
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
    const auto encoder = make_auto_encoder(std::make_shared<AutoColor>(false), {});
    const auto encoded = encoder->encode(camera, true);
    ASSERT_TRUE(encoded);
    EXPECT_EQ(Bytes(encoded->bytes.begin(), encoded->bytes.end()), camera.jpeg);
}

TEST(AutoColorEncoder, ADamagedPictureIsLeftOutAndH264GoesOn) {
    if (!video::missing_color_encoder(video::parse_color_setting(auto_h264).setting).empty())
        GTEST_SKIP() << "there is no H.264 encoder on this machine";
    const auto encoder = make_auto_encoder(std::make_shared<AutoColor>(true), {});
    ColorData damaged;
    damaged.size = size;
    damaged.jpeg = Bytes(100);
    EXPECT_FALSE(encoder->encode(damaged, true));
    const auto encoded = encoder->encode(picture(1), true);
    ASSERT_TRUE(encoded);
    EXPECT_EQ(encoded->codec, video::ColorCodecId::h264);
}

// Noise takes more bytes than any picture of a camera.
ColorData noise(Size of) {
    std::mt19937 random(1);
    ColorData color;
    color.size = of;
    color.pixels = ColorImage(of);
    for (Rgb& pixel : color.pixels.pixels)
        pixel = {std::uint8_t(random()), std::uint8_t(random()), std::uint8_t(random())};
    return color;
}

TEST(AutoColorEncoder, JpegKeepsTwentyMegabitsASecond) {
    constexpr std::size_t most = 20'000'000 / 8 / 30;
    constexpr Size large{640, 480};
    const auto encoder = make_auto_encoder(std::make_shared<AutoColor>(false), {});
    const auto decoder = video::make_color_decoder(video::ColorCodecId::jpeg);
    const ColorData pixels = noise(large);
    ColorData camera;
    camera.size = large;
    const auto finest = video::make_color_encoder(video::ColorSetting{});
    const ByteView own = finest->encode(pixels, true)->bytes;
    camera.jpeg.assign(own.begin(), own.end());
    ASSERT_GT(camera.jpeg.size(), 2 * most);
    for (const ColorData& color : {pixels, camera}) {
        const auto encoded = encoder->encode(color, false);
        ASSERT_TRUE(encoded);
        EXPECT_TRUE(encoded->key);
        EXPECT_LE(encoded->bytes.size(), most);
        EXPECT_GT(encoded->bytes.size(), most / 4);
        EXPECT_EQ(decoder->submit(encoded->bytes, 0), Status::ok);
        ASSERT_TRUE(decoder->poll());
    }
}

TEST(AutoColorEncoder, PicturesThatMustNotBeSmallerKeepTheirSize) {
    constexpr Size large{1280, 720};
    const ColorData color = noise(large);
    const auto is_h264 = std::make_shared<AutoColor>(false);
    const auto size_sent = [&](const JpegLimits& limits) {
        const auto encoder = make_auto_encoder(is_h264, limits);
        const auto encoded = encoder->encode(color, true);
        return encoded ? video::read_color_size(video::ColorCodecId::jpeg, encoded->bytes).value()
                       : Size{};
    };
    EXPECT_EQ(size_sent({}), (Size{640, 360}));
    EXPECT_EQ(size_sent({.may_be_smaller = false}), large);
}

}  // namespace
}  // namespace theatron::send
