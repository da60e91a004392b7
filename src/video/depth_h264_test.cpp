// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <random>

#include "video/depth_codecs.h"
#include "video/depth_mask.h"

namespace theatron::video {
namespace {

using ::testing::HasSubstr;

// A ball before a slanted wall, with noise and holes at its rim.
DepthImage scene(Size size, int time) {
    std::mt19937 rng(static_cast<unsigned>(time) + 1u);
    DepthImage image(size);
    const double cx = size.width * 0.5 + time, cy = size.height * 0.5, r = size.height * 0.3;
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) {
            const double d = std::hypot(x - cx, y - cy) / r;
            const double wall = 2000 + 3.0 * x, ball = 1200 + 100 * d;
            const bool rim = d > 0.95 && d < 1.1 && rng() % 3 > 0;
            image.view().row(y)[x] =
                rim ? std::uint16_t(0) : std::uint16_t((d < 1 ? ball : wall) + double(rng() % 4));
        }
    return image;
}

Bytes mask_bytes(const depth_mask::Mask& mask, const depth_mask::Mask& before) {
    Bytes bytes(depth_mask::max_encoded_size(mask.size()));
    bytes.resize(depth_mask::encode(mask, before, bytes));
    return Bytes(bytes);
}

TEST(DepthMask, RoundTripsAnyImageWithAndWithoutTheFrameBefore) {
    for (const Size size : {Size{1, 1}, Size{1, 9}, Size{40, 3}, Size{160, 120}})
        for (const bool noise : {false, true}) {
            DepthImage image = scene(size, 3);
            std::mt19937 rng(1);
            for (std::uint16_t& p : image.pixels)
                if (noise)
                    p = rng() % 2;
            depth_mask::Mask mask, before, decoded;
            mask.set_from(image.view());
            before.set_from(scene(size, 2).view());
            decoded.resize(size);
            ASSERT_EQ(depth_mask::decode(mask_bytes(mask, before), before, decoded), Status::ok);
            for (int y = 0; y < size.height; ++y)
                for (int x = 0; x < size.width; ++x)
                    ASSERT_EQ(decoded.row(y)[x], image.view().row(y)[x] != 0);
        }
}

TEST(DepthMask, RefusesTruncationAndSurplus) {
    depth_mask::Mask mask, before, decoded;
    mask.set_from(scene({40, 30}, 1).view());
    before.resize({40, 30});
    decoded.resize({40, 30});
    Bytes bytes = mask_bytes(mask, before);
    for (std::size_t n = 0; n < bytes.size(); ++n)
        EXPECT_EQ(depth_mask::decode(Bytes(bytes.begin(), bytes.begin() + std::ptrdiff_t(n)),
                                     before, decoded),
                  Status::truncated);
    bytes.push_back({});
    EXPECT_EQ(depth_mask::decode(bytes, before, decoded), Status::trailing_bytes);
}

TEST(DepthMask, BytesAreAsSpecified) {
    depth_mask::Mask mask, before;
    DepthImage image({3, 2});
    image.pixels = {0, 7, 7, 0, 0, 7};
    mask.set_from(image.view());
    before.resize({3, 2});
    Bytes expected;
    for (const int b : {0x00, 0x65, 0xbf, 0xfb, 0xc0})
        expected.push_back(std::byte(b));
    EXPECT_EQ(mask_bytes(mask, before), expected);
}

class DepthH264Test : public ::testing::Test {
protected:
    void SetUp() override {
        if (!missing_depth_encoder(setting).empty())
            GTEST_SKIP() << missing_depth_encoder(setting);
    }
    struct Sent {
        codec::FrameLink link;
        Bytes bytes;
    };
    Sent send(const DepthImage& image, FrameNumber n, bool key = false) {
        Bytes bytes(encoder.max_encoded_size(image.size));
        const codec::EncodedDepth encoded = encoder.encode(image.view(), n, key, bytes);
        bytes.resize(encoded.bytes);
        return {encoded, Bytes(bytes)};
    }
    Status receive(const Sent& sent, DepthImage& out) {
        const auto size = decoder.read_size(sent.bytes);
        if (!size)
            return size.error();
        out.resize(*size);
        return decoder.decode(sent.link, sent.bytes, out.view());
    }
    // Validity is exact; the mean error of valid pixels.
    static double mean_error(const DepthImage& a, const DepthImage& b) {
        double sum = 0, count = 0;
        for (std::size_t i = 0; i < a.pixels.size(); ++i) {
            EXPECT_EQ(a.pixels[i] == 0, b.pixels[i] == 0);
            sum += std::abs(a.pixels[i] - b.pixels[i]);
            count += a.pixels[i] != 0;
        }
        return sum / count;
    }

    const codec::DepthSetting setting = parse_depth_setting("h264").setting;
    codec::DepthStreamEncoder encoder = make_depth_encoder(setting);
    codec::DepthStreamDecoder decoder = make_depth_decoder(setting);
};

TEST_F(DepthH264Test, KeepsValidityExactlyAndDepthNearly) {
    DepthImage out;
    for (FrameNumber n = 0; n < 8; ++n) {
        const DepthImage image = scene({161, 121}, int(n));
        const Sent sent = send(image, n);
        EXPECT_EQ(sent.link.key, n == 0);
        ASSERT_EQ(receive(sent, out), Status::ok) << n;
        EXPECT_LT(mean_error(image, out), 12);
    }
    EXPECT_FALSE(video::make_depth_codec(setting)->lossless());
}

TEST_F(DepthH264Test, AnEmptyImageStaysEmpty) {
    DepthImage out;
    ASSERT_EQ(receive(send(DepthImage({64, 48}), 0), out), Status::ok);
    EXPECT_EQ(out, DepthImage({64, 48}));
}

TEST_F(DepthH264Test, AfterALossOnlyAKeyFrameDecodes) {
    DepthImage out;
    ASSERT_EQ(receive(send(scene({64, 48}, 0), 0), out), Status::ok);
    (void)send(scene({64, 48}, 1), 1);
    EXPECT_EQ(receive(send(scene({64, 48}, 2), 2), out), Status::missing_reference);
    const DepthImage image = scene({64, 48}, 3);
    ASSERT_EQ(receive(send(image, 3, true), out), Status::ok);
    EXPECT_LT(mean_error(image, out), 12);
    ASSERT_EQ(receive(send(scene({64, 48}, 4), 4), out), Status::ok);
}

TEST_F(DepthH264Test, TruncationsAndFlippedBytesEndInAStatusOrAnImage) {
    const Sent key = send(scene({32, 32}, 0), 0);
    const Sent second = send(scene({32, 32}, 1), 1);
    DepthImage out;
    for (const Sent& whole : {key, second})
        for (std::size_t i = 0; i < whole.bytes.size(); ++i) {
            ASSERT_EQ(receive(key, out), Status::ok);
            Sent part = whole;
            part.bytes.resize(i);
            // The library does not miss the last bits of a picture.
            const Status status = receive(part, out);
            EXPECT_TRUE(status != Status::ok || i + 4 > whole.bytes.size()) << i;
            Sent flipped = whole;
            flipped.bytes[i] ^= std::byte{0x55};
            // Its header may promise another size, which costs only time.
            if (i < 4 || i > 7)
                (void)receive(flipped, out);
        }
}

TEST_F(DepthH264Test, ASizeMayChange) {
    DepthImage out;
    ASSERT_EQ(receive(send(scene({64, 48}, 0), 0), out), Status::ok);
    const Sent sent = send(scene({66, 50}, 1), 1);
    EXPECT_TRUE(sent.link.key);
    ASSERT_EQ(receive(sent, out), Status::ok);
    EXPECT_EQ(out.size, (Size{66, 50}));
}

TEST(DepthCodecs, H264IsOneOfThem) {
    EXPECT_THAT(depth_codec_names(), ::testing::Contains("h264"));
    EXPECT_THAT(depth_codec_names(), ::testing::Contains("trvl"));
    EXPECT_EQ(parse_depth_setting("h264").setting.text, "h264:crf=8");
    EXPECT_EQ(parse_depth_setting("h264:far=4000,near=500,crf=12").setting.text,
              "h264:crf=12,near=500,far=4000");
    EXPECT_EQ(parse_depth_setting("trvl:layers=2").setting.layers, 2);
    EXPECT_THAT(parse_depth_setting("h264:near=900,far=800").problem, HasSubstr("less than far"));
    EXPECT_THAT(parse_depth_setting("h264:layers=2").problem, HasSubstr("'layers' is unknown"));
    EXPECT_THAT(parse_depth_setting("h264:best").problem, HasSubstr("'best'"));
    EXPECT_THAT(parse_depth_setting("mp3").problem, HasSubstr("h264"));
}

}  // namespace
}  // namespace theatron::video
