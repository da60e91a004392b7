// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "video/avc_native.h"
#include "video/avc_setting.h"
#include "video/avc_stream.h"
#include "video/color_codec.h"
#include "video/h264_header.h"
#include "video/test_psnr.h"

namespace theatron::video {
namespace {

// A bright square that moves over shades, with a little sensor noise.
ColorImage scene(Size size, int time) {
    std::mt19937 rng(static_cast<unsigned>(time) + 1u);
    ColorImage image(size);
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) {
            const int left = (time * 3) % size.width;
            const bool square = x >= left && x < left + size.width / 4 && y < size.height / 2;
            const double wave = 40 * std::sin(x * 0.05) + 30 * std::cos(y * 0.07);
            const double value = (square ? 200 : 110) + wave / 2 + double(rng() % 4);
            image.view().row(y)[x] = {std::uint8_t(value), std::uint8_t(value * 0.8),
                                      std::uint8_t(value * 0.6)};
        }
    return image;
}

// With each library that encodes.
class H264 : public ::testing::TestWithParam<const char*> {
protected:
    void SetUp() override {
        const ColorSetting setting =
            parse_color_setting(std::string("h264:encoder=") + GetParam()).setting;
        if (!missing_color_encoder(setting).empty())
            GTEST_SKIP() << missing_color_encoder(setting);
        encoder = make_color_encoder(setting);
        decoder = make_color_decoder(setting.id);
    }
    struct Payload {
        Bytes bytes;
        bool key = false;
    };
    Payload encode(const ColorImage& image, bool key = false) {
        ColorData color;
        color.size = image.size;
        color.pixels = image;
        const auto encoded = encoder->encode(color, key);
        if (!encoded)
            return {};
        return {Bytes(encoded->bytes.begin(), encoded->bytes.end()), encoded->key};
    }
    ColorImage decode(const Bytes& payload) {
        EXPECT_EQ(decoder->submit(payload, 4), Status::ok);
        const auto decoded = decoder->poll();
        return decoded ? decoded->image : ColorImage{};
    }

    std::unique_ptr<ColorEncoder> encoder;
    std::unique_ptr<ColorDecoder> decoder;
};

TEST_P(H264, EveryFrameComesBackAtOnceAndOnlyTheFirstIsAKeyFrame) {
    const Size size{160, 120};
    std::size_t first = 0, others = 0;
    for (int i = 0; i < 12; ++i) {
        const ColorImage image = scene(size, i);
        const Payload payload = encode(image);
        EXPECT_EQ(payload.key, i == 0);
        (i == 0 ? first : others) += payload.bytes.size();
        const ColorImage back = decode(payload.bytes);
        ASSERT_EQ(back.size, size);
        EXPECT_GT(psnr(image, back), 34) << i;
    }
    EXPECT_LT(others / 11, first);
}

TEST_P(H264, AWantedKeyFrameStandsAlone) {
    (void)encode(scene({64, 48}, 0));
    (void)encode(scene({64, 48}, 1));
    const ColorImage image = scene({64, 48}, 2);
    const Payload key = encode(image, true);
    EXPECT_TRUE(key.key);
    EXPECT_GT(psnr(image, decode(key.bytes)), 34);
    const ColorImage next = scene({64, 48}, 3);
    EXPECT_GT(psnr(next, decode(encode(next).bytes)), 34);
}

TEST_P(H264, OddSizesAndChangesOfSizeWork) {
    for (const Size size : {Size{33, 17}, Size{34, 18}, Size{1, 1}, Size{70, 50}}) {
        // OpenH264 takes no picture of less than one block.
        if (size.width < 16 && GetParam() == std::string(openh264_name)) {
            EXPECT_TRUE(encode(scene(size, 1)).bytes.empty());
            continue;
        }
        const ColorImage image = scene(size, 1);
        const Payload payload = encode(image);
        EXPECT_TRUE(payload.key);
        const ColorImage back = decode(payload.bytes);
        ASSERT_EQ(back.size, size);
        EXPECT_GT(psnr(image, back), 30) << size.width;
    }
}

TEST_P(H264, PicturesBeyondTheLimitAreRefused) {
    EXPECT_TRUE(encode(ColorImage({5000, 2000})).bytes.empty());
}

TEST_P(H264, WithoutAKeyFrameNothingDecodes) {
    (void)encode(scene({64, 48}, 0));
    const Payload second = encode(scene({64, 48}, 1));
    EXPECT_EQ(decoder->submit(second.bytes, 1), Status::missing_reference);
    EXPECT_FALSE(decoder->poll());
}

TEST_P(H264, AfterDamageTheDecoderWaitsForAKeyFrame) {
    const Payload key = encode(scene({64, 48}, 0));
    Payload damaged = encode(scene({64, 48}, 1));
    const Payload later = encode(scene({64, 48}, 2));
    (void)decode(key.bytes);
    damaged.bytes.resize(h264_header_size + 5);
    EXPECT_NE(decoder->submit(damaged.bytes, 1), Status::ok);
    EXPECT_EQ(decoder->submit(later.bytes, 2), Status::missing_reference);
    (void)decode(key.bytes);
}

TEST_P(H264, TheHeaderMustNameTheSizeOfThePicture) {
    Payload key = encode(scene({64, 48}, 0));
    put_h264_header(true, {66, 48}, key.bytes.data());
    EXPECT_EQ(decoder->submit(key.bytes, 0), Status::size_mismatch);
}

TEST_P(H264, TruncationsAndFlippedBytesEndInAStatusOrAPicture) {
    const Bytes key = encode(scene({32, 32}, 0)).bytes;
    const Bytes second = encode(scene({32, 32}, 1)).bytes;
    for (const Bytes& whole : {key, second}) {
        for (std::size_t n = 0; n < whole.size(); ++n) {
            (void)decode(key);
            const Bytes part(whole.begin(), whole.begin() + std::ptrdiff_t(n));
            const Status status = decoder->submit(part, 0);
            EXPECT_EQ(decoder->poll().has_value(), status == Status::ok) << n << " bytes";
        }
        for (std::size_t i = 0; i < whole.size(); ++i)
            for (const int flip : {0x01, 0x80, 0xff}) {
                (void)decode(key);
                Bytes changed = whole;
                changed[i] ^= std::byte(flip);
                const Status status = decoder->submit(changed, 0);
                EXPECT_EQ(decoder->poll().has_value(), status == Status::ok);
            }
    }
}

TEST_P(H264, OnlyTheShapesOfOurEncoderReachTheDecoder) {
    const Bytes key = encode(scene({64, 48}, 0)).bytes;
    const Bytes second = encode(scene({64, 48}, 1)).bytes;
    const ByteView stream = ByteView(key).subspan(h264_header_size);
    const auto unit = avc::read_access_unit(stream);
    ASSERT_TRUE(unit);
    EXPECT_TRUE(unit->key);
    EXPECT_EQ(unit->sequence, (avc::Sequence{{64, 48}, 8, false}));

    Bytes two(stream.begin(), stream.end());
    two.insert(two.end(), second.begin() + h264_header_size, second.end());
    EXPECT_EQ(avc::read_access_unit(two).error(), Status::trailing_bytes);

    ByteView rest = stream;
    const auto sequence = avc::take_unit(rest);
    EXPECT_EQ(sequence->type(), avc::UnitType::sequence);
    EXPECT_EQ(avc::read_access_unit(sequence->with_start_code).error(), Status::truncated);
    EXPECT_EQ(avc::read_access_unit(rest).error(), Status::unsupported);  // a picture header
    EXPECT_EQ(avc::read_access_unit(stream.subspan(5)).error(), Status::truncated);
}

INSTANTIATE_TEST_SUITE_P(Encoders, H264, ::testing::Values(x264_name, openh264_name));

TEST(H264Setting, NamesItsEncoderOnlyWhereThatSaysMore) {
    const auto spelled = [](const char* text) { return parse_color_setting(text).setting.text; };
    EXPECT_EQ(spelled("h264"), "h264:crf=20");
    EXPECT_EQ(spelled("h264:encoder=openh264"), "h264:crf=20,encoder=openh264");
    EXPECT_EQ(spelled("h264:encoder=x264,preset=veryfast"), "h264:crf=20,preset=veryfast");
    for (const char* wrong : {"h264:encoder=nvenc", "h264:encoder=openh264,preset=veryfast"})
        EXPECT_FALSE(parse_color_setting(wrong).problem.empty()) << wrong;
}

TEST(H264Setting, PicturesTooSmallForTheUsualEncoderGoToTheOther) {
    if (!AvcEncoder::problem(x264_name).empty())
        GTEST_SKIP() << AvcEncoder::problem(x264_name);
    const auto encoder = make_color_encoder(parse_color_setting("h264").setting);
    ColorData color;
    color.size = {6, 4};
    color.pixels = scene(color.size, 1);
    const auto encoded = encoder->encode(color, true);
    EXPECT_TRUE(encoded);
}

TEST(H264Header, RefusesWhatTheFormatForbids) {
    const auto status_of = [](std::initializer_list<int> values) {
        Bytes payload;
        for (const int v : values)
            payload.push_back(std::byte(v));
        return read_h264_picture(payload).error();
    };
    EXPECT_EQ(status_of({1, 1, 2, 0, 2, 0, 0}), Status::ok);
    EXPECT_EQ(status_of({1, 1, 2, 0, 2, 0}), Status::truncated);
    EXPECT_EQ(status_of({2, 1, 2, 0, 2, 0, 0}), Status::unsupported_version);
    EXPECT_EQ(status_of({0, 1, 2, 0, 2, 0, 0}), Status::malformed);
    EXPECT_EQ(status_of({1, 2, 2, 0, 2, 0, 0}), Status::malformed);
    EXPECT_EQ(status_of({1, 1, 0, 0, 2, 0, 0}), Status::malformed);
    EXPECT_EQ(status_of({1, 1, 0, 0x20, 0, 0x10, 0}), Status::too_large);
}

}  // namespace
}  // namespace theatron::video
