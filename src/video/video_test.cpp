// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "base/error.h"
#include "video/color_codec.h"
#include "video/color_raw.h"
#include "video/jpeg_header.h"
#include "video/jpeg_native.h"
#include "video/test_psnr.h"

namespace theatron::video {
namespace {

using ::testing::HasSubstr;

Bytes bytes(std::initializer_list<int> values) {
    Bytes result;
    for (const int v : values)
        result.push_back(std::byte(v));
    return result;
}

// One white pixel in grey: the test vector of docs/formats/color_jpeg.md.
const Bytes white_pixel = [] {
    Bytes all;
    const auto put = [&](std::initializer_list<int> values) {
        const Bytes more = bytes(values);
        all.insert(all.end(), more.begin(), more.end());
    };
    put({0xff, 0xd8, 0xff, 0xdb, 0, 67, 0});
    all.insert(all.end(), 64, std::byte{8});
    put({0xff, 0xc0, 0, 11, 8, 0, 1, 0, 1, 1, 1, 0x11, 0});
    for (const auto& [table, symbol] : {std::pair{0x00, 7}, {0x10, 0}}) {
        put({0xff, 0xc4, 0, 20, table, 1});
        all.insert(all.end(), 15, std::byte{0});
        put({symbol});
    }
    put({0xff, 0xda, 0, 8, 1, 1, 0, 0, 63, 0, 0x7f, 0x7f, 0xff, 0xd9});
    return all;
}();

// Smooth shades with a patch of fine texture, like a person before a wall.
ColorImage scene(Size size) {
    std::mt19937 rng(5);
    ColorImage image(size);
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) {
            const bool textured = x > size.width / 2 && y > size.height / 2;
            const int grain = textured ? int(rng() % 24) : 0;
            const double wave = 40 * std::sin(x * 0.05) + 30 * std::cos(y * 0.07);
            image.view().row(y)[x] = {std::uint8_t(120 + wave + grain),
                                      std::uint8_t(110 + wave / 2 + grain),
                                      std::uint8_t(90 + wave / 3 + grain)};
        }
    return image;
}

ColorData pixels(ColorImage image) {
    ColorData color;
    color.size = image.size;
    color.pixels = std::move(image);
    return color;
}

// A copy of exact size: the address sanitizer sees any read past the end.
Bytes encoded(std::string_view setting, const ColorData& color) {
    const ParsedColorSetting parsed = parse_color_setting(setting);
    EXPECT_EQ(parsed.problem, "");
    const auto encoder = make_color_encoder(parsed.setting);
    const auto result = encoder->encode(color, true);
    return result ? Bytes(result->bytes.begin(), result->bytes.end()) : Bytes{};
}

ColorImage decoded(ColorCodecId id, const Bytes& data) {
    const auto decoder = make_color_decoder(id);
    EXPECT_EQ(decoder->submit(data, 3), Status::ok);
    const auto result = decoder->poll();
    return result ? result->image : ColorImage{};
}

void expect_safe_at_every_truncation(ColorCodecId id, const Bytes& whole) {
    const auto decoder = make_color_decoder(id);
    for (std::size_t n = 0; n < whole.size(); ++n) {
        const Bytes part(whole.begin(), whole.begin() + std::ptrdiff_t(n));
        const Status status = decoder->submit(part, 0);
        EXPECT_EQ(decoder->poll().has_value(), status == Status::ok) << n << " bytes";
    }
}

const Size sizes[] = {{1, 1}, {1, 7}, {17, 33}, {64, 48}};

TEST(ColorSetting, HasOneSpelling) {
    EXPECT_EQ(parse_color_setting("raw").setting.text, "raw");
    EXPECT_EQ(parse_color_setting("jpeg").setting, ColorSetting{});
    EXPECT_EQ(parse_color_setting("jpeg:quality=60").setting.text, "jpeg:quality=60");
    EXPECT_EQ(parse_color_setting("jpeg:pass=0,subsampling=444").setting.text,
              "jpeg:quality=85,subsampling=444,pass=0");
    EXPECT_EQ(parse_color_setting("jpeg:subsampling=420,pass=1").setting.text, "jpeg:quality=85");
    EXPECT_EQ(parse_color_setting("jpeg:pass=0,quality=60").setting.text, "jpeg:quality=60");
    EXPECT_EQ(parse_color_setting("jpeg:pass=1,quality=60").setting.text, "jpeg:quality=60,pass=1");
}

TEST(ColorSetting, SaysWhatIsWrong) {
    EXPECT_EQ(parse_color_setting("h264").setting.text, "h264:crf=20");
    EXPECT_EQ(parse_color_setting("h264:preset=veryfast,bitrate_mbit=2.5").setting.text,
              "h264:bitrate_mbit=2.5,preset=veryfast");
    EXPECT_THAT(parse_color_setting("h264:preset=slow").problem, HasSubstr("or faster."));
    EXPECT_THAT(parse_color_setting("h264:crf=52").problem, HasSubstr("crf=52"));
    EXPECT_EQ(parse_color_setting("mp3").problem,
              "There is no colour codec 'mp3'; there are raw, jpeg, h264.");
    EXPECT_THAT(parse_color_setting("jpeg:quality=101").problem, HasSubstr("quality=101"));
    EXPECT_THAT(parse_color_setting("jpeg:subsampling=411").problem, HasSubstr("420 or 444"));
    EXPECT_THAT(parse_color_setting("jpeg:speed=1").problem, HasSubstr("'speed' is unknown"));
    EXPECT_THAT(parse_color_setting("raw:quality=1").problem, HasSubstr("'quality' is unknown"));
    EXPECT_THAT(parse_color_setting("jpeg:best").problem, HasSubstr("'best'"));
    EXPECT_NE(parse_color_setting("").problem, "");
}

TEST(ColorRaw, BytesAreAsSpecified) {
    ColorImage image({2, 1});
    image.pixels = {{1, 2, 3}, {254, 255, 0}};
    EXPECT_EQ(encoded("raw", pixels(image)), bytes({1, 0, 2, 0, 1, 0, 1, 2, 3, 254, 255, 0}));
}

TEST(ColorRaw, RoundTripsAnyImage) {
    for (const Size size : sizes) {
        const ColorImage image = scene(size);
        EXPECT_EQ(decoded(ColorCodecId::raw, encoded("raw", pixels(image))), image);
    }
}

TEST(ColorRaw, RefusesEveryTruncationAndSurplus) {
    Bytes whole = encoded("raw", pixels(scene({5, 4})));
    for (std::size_t n = 0; n < whole.size(); ++n)
        EXPECT_EQ(color_raw::read_size(ByteView(whole).first(n)).error(), Status::truncated) << n;
    expect_safe_at_every_truncation(ColorCodecId::raw, whole);
    whole.push_back({});
    EXPECT_EQ(color_raw::read_size(whole).error(), Status::trailing_bytes);
}

TEST(ColorRaw, RefusesWhatTheFormatForbids) {
    const auto status_of = [](std::initializer_list<int> values) {
        return make_color_decoder(ColorCodecId::raw)->submit(bytes(values), 0);
    };
    EXPECT_EQ(status_of({1, 0, 1, 0, 1, 0, 9, 9, 9}), Status::ok);
    EXPECT_EQ(status_of({0, 0, 1, 0, 1, 0, 9, 9, 9}), Status::malformed);
    EXPECT_EQ(status_of({2, 0, 1, 0, 1, 0, 9, 9, 9}), Status::unsupported_version);
    EXPECT_EQ(status_of({1, 1, 1, 0, 1, 0, 9, 9, 9}), Status::malformed);
    EXPECT_EQ(status_of({1, 0, 0, 0, 1, 0}), Status::malformed);
    EXPECT_EQ(status_of({1, 0, 1, 0x20, 1, 0}), Status::too_large);  // 8193 wide
}

TEST(ColorJpeg, DecodesTheTestVector) {
    const ColorImage image = decoded(ColorCodecId::jpeg, white_pixel);
    ASSERT_EQ(image.size, (Size{1, 1}));
    EXPECT_GE(image.pixels[0].r, 254);
    EXPECT_GE(image.pixels[0].g, 254);
    EXPECT_GE(image.pixels[0].b, 254);
}

TEST(ColorJpeg, KeepsPicturesOfAnySize) {
    for (const Size size : sizes) {
        const ColorImage image = scene(size);
        const ColorImage back =
            decoded(ColorCodecId::jpeg, encoded("jpeg:quality=95,subsampling=444", pixels(image)));
        ASSERT_EQ(back.size, size);
        EXPECT_GT(psnr(image, back), 36);
    }
}

TEST(ColorJpeg, QualityAndSubsamplingTradeBytesForFidelity) {
    const ColorImage image = scene({320, 240});
    const auto result = [&](std::string_view setting) {
        const Bytes data = encoded(setting, pixels(image));
        return std::pair(data.size(), psnr(image, decoded(ColorCodecId::jpeg, data)));
    };
    const auto [low_bytes, low] = result("jpeg:quality=40");
    const auto [usual_bytes, usual] = result("jpeg");
    const auto [full_bytes, full] = result("jpeg:quality=98,subsampling=444");
    EXPECT_GT(usual, 38);
    EXPECT_LT(low, usual);
    EXPECT_LT(usual, full);
    EXPECT_LT(low_bytes, usual_bytes);
    EXPECT_LT(usual_bytes, full_bytes);
}

TEST(ColorJpeg, PassesTheCamerasPictureThroughUntouched) {
    ColorData color;
    color.jpeg = encoded("jpeg:quality=50", pixels(scene({33, 17})));
    color.size = {33, 17};
    EXPECT_EQ(encoded("jpeg:quality=90", color), color.jpeg);
    EXPECT_EQ(encoded("jpeg:quality=40,pass=1", color), color.jpeg);
}

TEST(ColorJpeg, EncodesTheCamerasPictureAgainWhereLessIsAskedFor) {
    ColorData color;
    color.jpeg = encoded("jpeg:quality=90", pixels(scene({33, 17})));
    color.size = {33, 17};
    EXPECT_LT(encoded("jpeg:quality=60", color).size(), color.jpeg.size());
    EXPECT_NE(encoded("jpeg:quality=89,pass=0", color), color.jpeg);
    EXPECT_EQ(encoded("jpeg:quality=95,pass=0", color), color.jpeg) << "more bytes show no more";
}

TEST(ColorJpeg, CameraPicturesBecomePixelsWhereTheSettingWantsThem) {
    ColorData color;
    color.jpeg = encoded("jpeg", pixels(scene({33, 17})));
    color.size = {33, 17};
    EXPECT_EQ(decoded(ColorCodecId::raw, encoded("raw", color)),
              decoded(ColorCodecId::jpeg, color.jpeg));

    color.jpeg.resize(color.jpeg.size() - 20);
    for (const char* setting : {"raw", "jpeg:pass=0"})
        EXPECT_EQ(
            make_color_encoder(parse_color_setting(setting).setting)->encode(color, true).error(),
            Status::malformed);
}

TEST(ColorJpeg, EveryTruncationAndEveryFlippedByteEndsInAStatusOrAnImage) {
    const Bytes whole = encoded("jpeg", pixels(scene({17, 33})));
    expect_safe_at_every_truncation(ColorCodecId::jpeg, whole);
    expect_safe_at_every_truncation(ColorCodecId::jpeg, white_pixel);
    const auto decoder = make_color_decoder(ColorCodecId::jpeg);
    for (std::size_t i = 0; i < whole.size(); ++i)
        for (const int flip : {0x01, 0x80, 0xff}) {
            Bytes damaged = whole;
            damaged[i] ^= std::byte(flip);
            const Status status = decoder->submit(damaged, 0);
            EXPECT_EQ(decoder->poll().has_value(), status == Status::ok);
        }
}

TEST(ColorJpeg, TruncatedPicturesAreNotShown) {
    const Bytes whole = encoded("jpeg", pixels(scene({64, 64})));
    const auto decoder = make_color_decoder(ColorCodecId::jpeg);
    EXPECT_EQ(decoder->submit(ByteView(whole).first(whole.size() - 20), 0), Status::malformed);
}

TEST(ColorJpeg, RefusesBeforeTakingMemory) {
    Bytes picture = encoded("jpeg", pixels(scene({16, 16})));
    const auto frame_header = [&] {
        for (std::size_t i = 0; i + 1 < picture.size(); ++i)
            if (picture[i] == std::byte{0xff} && picture[i + 1] == std::byte{0xc0})
                return i;
        return std::size_t(0);
    }();
    const auto status_with = [&](std::size_t offset, std::initializer_list<int> values) {
        Bytes changed = picture;
        for (const int v : values)
            changed[frame_header + offset++] = std::byte(v);
        return read_jpeg_size(changed).error();
    };
    EXPECT_EQ(status_with(1, {0xc2}), Status::unsupported);                  // progressive
    EXPECT_EQ(status_with(1, {0xc9}), Status::unsupported);                  // arithmetic
    EXPECT_EQ(status_with(4, {12}), Status::unsupported);                    // bits
    EXPECT_EQ(status_with(5, {0x20, 0x00, 0x20, 0x00}), Status::truncated);  // 8192 x 8192
    EXPECT_EQ(status_with(5, {0x20, 0x01}), Status::too_large);
    EXPECT_EQ(status_with(5, {0, 0}), Status::malformed);
    EXPECT_EQ(status_with(9, {4}), Status::unsupported);  // CMYK
    EXPECT_EQ(status_with(9, {1}), Status::unsupported);  // a scan of other components
}

TEST(ColorJpeg, AcceptsStrayBytesBeforeTheEnd) {
    Bytes picture = encoded("jpeg", pixels(scene({16, 16})));
    picture.insert(picture.end() - 2, 7, std::byte{0});
    EXPECT_EQ(make_color_decoder(ColorCodecId::jpeg)->submit(picture, 0), Status::ok);
}

TEST(ColorDecoder, GivesFramesInOrderAndDropsTheOldestIfNobodyPolls) {
    const Bytes picture = encoded("jpeg", pixels(scene({8, 8})));
    const auto decoder = make_color_decoder(ColorCodecId::jpeg);
    for (FrameNumber n = 0; n < 6; ++n)
        ASSERT_EQ(decoder->submit(picture, n), Status::ok);
    for (FrameNumber n = 2; n < 6; ++n)
        EXPECT_EQ(decoder->poll()->frame, n);
    EXPECT_FALSE(decoder->poll());
}

TEST(ColorDecoder, UsesRecycledMemoryAgain) {
    for (const char* setting : {"raw", "jpeg"}) {
        const Bytes data = encoded(setting, pixels(scene({40, 30})));
        const auto decoder = make_color_decoder(parse_color_setting(setting).setting.id);
        ASSERT_EQ(decoder->submit(data, 0), Status::ok);
        auto first = decoder->poll();
        const Rgb* memory = first->image.pixels.data();
        decoder->recycle(std::move(first->image));
        ASSERT_EQ(decoder->submit(data, 1), Status::ok);
        EXPECT_EQ(decoder->poll()->image.pixels.data(), memory);
    }
}

TEST(ColorCodec, UnknownNumbersAreRefusedAtSetUp) {
    EXPECT_THROW(make_color_decoder(ColorCodecId(200)), Error);
    EXPECT_THROW(make_color_encoder({ColorCodecId(200), "holograms"}), Error);
}

}  // namespace
}  // namespace theatron::video
