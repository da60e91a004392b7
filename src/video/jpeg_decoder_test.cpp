// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <turbojpeg.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <random>
#include <string>

#include "testing/every_target.h"
#include "video/jpeg_baseline.h"
#include "video/jpeg_decoder.h"
#include "video/jpeg_native.h"
#include "video/jpeg_reference_native.h"
#include "video/test_psnr.h"

namespace theatron::video {
namespace {

constexpr int subsamplings[] = {TJSAMP_420, TJSAMP_422, TJSAMP_444};

// Waves and edges of strong colours with some noise.
ColorImage scene(Size size, unsigned noise) {
    std::mt19937 rng(5);
    ColorImage image(size);
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) {
            const auto channel = [&](double shift) {
                const double wave = 128 + 100 * std::sin(x * 0.11 + shift) * std::cos(y * 0.07);
                const double edge = (x / 19 + y / 23) % 2 ? 20 : 0;
                return std::uint8_t(std::min(wave + edge + rng() % (noise + 1), 255.0));
            };
            image.view().row(y)[x] = {channel(0), channel(1), channel(3)};
        }
    return image;
}

// A copy of exact size: the address sanitizer sees any read past the end.
// `restart`: an interval in units, or 0.
Bytes encoded(const ColorImage& image, int subsampling, int quality, int restart = 0) {
    const std::string interval = std::to_string(restart) + "B";
    setenv("TJ_RESTART", restart ? interval.c_str() : "", 1);
    void* const encoder = tjInitCompress();
    unsigned char* bytes = nullptr;
    unsigned long size = 0;
    EXPECT_EQ(tjCompress2(encoder, &image.pixels[0].r, image.size.width, 0, image.size.height,
                          TJPF_RGB, &bytes, &size, subsampling, quality, TJFLAG_ACCURATEDCT),
              0);
    const ByteView view = std::as_bytes(std::span(bytes, size));
    const Bytes result(view.begin(), view.end());
    tjFree(bytes);
    tjDestroy(encoder);
    unsetenv("TJ_RESTART");
    return result;
}

ColorImage decoded_by_library(const Bytes& jpeg, Size size) {
    ColorImage image(size);
    void* const decoder = tjInitDecompress();
    EXPECT_EQ(tjDecompress2(decoder, reinterpret_cast<const unsigned char*>(jpeg.data()),
                            static_cast<unsigned long>(jpeg.size()), &image.pixels[0].r, size.width,
                            0, size.height, TJPF_RGB, TJFLAG_ACCURATEDCT),
              0);
    tjDestroy(decoder);
    return image;
}

Status status_of(const Bytes& jpeg) {
    ColorImage image, expected;
    const Status status = BaselineJpegDecoder().decode(jpeg, image);
    EXPECT_EQ(status, decode_jpeg_reference(jpeg, expected));
    return status;
}

// Where the segment with this marker begins.
std::size_t find(const Bytes& jpeg, int marker, std::size_t from = 0) {
    const std::byte bytes[] = {std::byte{0xff}, std::byte(marker)};
    const auto found =
        std::search(jpeg.begin() + std::ptrdiff_t(from), jpeg.end(), bytes, bytes + 2);
    EXPECT_NE(found, jpeg.end());
    return std::size_t(found - jpeg.begin());
}

void expect_equal_on_every_target(const Bytes& jpeg) {
    ColorImage expected;
    ASSERT_EQ(decode_jpeg_reference(jpeg, expected), Status::ok);
    testing::on_every_target([&] {
        ColorImage image;
        const Status status = BaselineJpegDecoder().decode(jpeg, image);
        if (status == Status::unsupported)
            return;  // no vectors
        ASSERT_EQ(status, Status::ok);
        ASSERT_EQ(image.size, expected.size);
        EXPECT_TRUE(image == expected);
    });
}

TEST(JpegDecoder, EveryTargetEqualsTheReferenceForAllRemaindersOfSizes) {
    for (const int subsampling : subsamplings)
        for (int i = 1; i <= 70; ++i) {
            const Size size{i, 1 + i * 7 % 40};
            SCOPED_TRACE(std::to_string(i) + " wide, subsampling " + std::to_string(subsampling));
            expect_equal_on_every_target(encoded(scene(size, 60), subsampling, 1 + i * 37 % 100));
        }
    expect_equal_on_every_target(encoded(scene({333, 70}, 20), TJSAMP_420, 85));
}

TEST(JpegDecoder, EveryTargetEqualsTheReferenceForPureNoise) {
    for (const int subsampling : subsamplings)
        for (const int quality : {1, 10, 50, 95, 100})
            expect_equal_on_every_target(encoded(scene({75, 40}, 255), subsampling, quality));
}

TEST(JpegDecoder, IsAsGoodAsTheLibraryAndCloseToIt) {
    for (const int subsampling : subsamplings)
        for (const int quality : {30, 60, 85, 95, 100})
            for (const Size size : {Size{320, 240}, Size{97, 51}}) {
                const ColorImage original = scene(size, 15);
                const Bytes jpeg = encoded(original, subsampling, quality);
                const ColorImage library = decoded_by_library(jpeg, size);
                ColorImage own;
                ASSERT_EQ(BaselineJpegDecoder().decode(jpeg, own), Status::ok);
                // Where nothing is lost in quantisation, 16 bits show.
                const double margin = quality < 100 ? 0.02 : 0.5;
                EXPECT_GT(psnr(own, original), psnr(library, original) - margin) << quality;
                EXPECT_GT(psnr(own, library), 47) << quality;
                int largest = 0;
                for (std::size_t i = 0; i < own.pixels.size(); ++i)
                    for (const auto channel : {&Rgb::r, &Rgb::g, &Rgb::b})
                        largest = std::max(
                            largest, std::abs(own.pixels[i].*channel - library.pixels[i].*channel));
                EXPECT_LE(largest, 6) << quality;
            }
}

// The largest coefficients that there are, and quantisation that makes them larger.
TEST(JpegDecoder, BlackAndWhiteOverflowNothing) {
    for (const int subsampling : subsamplings)
        for (int i = 0; i < 60; ++i) {
            const int step_x = 1 + i % 9, step_y = 1 + i / 9;
            ColorImage image({32, 32});
            for (int y = 0; y < 32; ++y)
                for (int x = 0; x < 32; ++x) {
                    const auto value = std::uint8_t((x / step_x + y / step_y) % 2 ? 255 : 0);
                    image.view().row(y)[x] = {value, value, std::uint8_t(i % 2 ? value : ~value)};
                }
            const Bytes jpeg = encoded(image, subsampling, 1 + i * 29 % 100);
            ColorImage own;
            ASSERT_EQ(BaselineJpegDecoder().decode(jpeg, own), Status::ok);
            EXPECT_GT(psnr(own, decoded_by_library(jpeg, image.size)), 47) << i;
        }
}

TEST(JpegDecoder, RestartIntervalsChangeNoPixel) {
    const ColorImage image = scene({150, 90}, 30);
    for (const int subsampling : subsamplings) {
        ColorImage plain;
        ASSERT_EQ(BaselineJpegDecoder().decode(encoded(image, subsampling, 85), plain), Status::ok);
        for (const int interval : {1, 2, 3, 5, 7, 40}) {
            const Bytes jpeg = encoded(image, subsampling, 85, interval);
            ASSERT_EQ(read_baseline_jpeg(jpeg)->restart_interval, interval);
            ColorImage restarted;
            ASSERT_EQ(BaselineJpegDecoder().decode(jpeg, restarted), Status::ok);
            EXPECT_TRUE(restarted == plain) << interval;
            expect_equal_on_every_target(jpeg);
        }
    }
}

TEST(JpegDecoder, OneDecoderTakesPicturesOfAnyKindInTurn) {
    BaselineJpegDecoder decoder;
    ColorImage image, expected;
    for (int i = 0; i < 12; ++i) {
        const Size size{20 + i * 37 % 90, 20 + i * 53 % 60};
        Bytes jpeg = encoded(scene(size, 30), subsamplings[i % 3], 20 + i * 7);
        if (i % 4 == 3) {  // a failure leaves nothing behind
            jpeg.resize(jpeg.size() * 3 / 4);
            EXPECT_EQ(decoder.decode(jpeg, image), Status::malformed);
            continue;
        }
        ASSERT_EQ(decoder.decode(jpeg, image), Status::ok);
        ASSERT_EQ(decode_jpeg_reference(jpeg, expected), Status::ok);
        EXPECT_TRUE(image == expected) << i;
    }
}

TEST(JpegDecoder, RefusesEveryTruncation) {
    for (const int restart : {0, 2}) {
        const Bytes whole = encoded(scene({33, 35}, 30), TJSAMP_420, 85, restart);
        const std::size_t scan = find(whole, 0xda);
        EXPECT_EQ(status_of(whole), Status::ok);
        for (std::size_t n = 0; n < whole.size(); ++n) {
            const Bytes part(whole.begin(), whole.begin() + std::ptrdiff_t(n));
            EXPECT_EQ(status_of(part), n < scan + 14 ? Status::truncated : Status::malformed) << n;
        }
    }
}

TEST(JpegDecoder, EveryFlippedByteEndsAsInTheReference) {
    const Bytes whole = encoded(scene({37, 18}, 60), TJSAMP_420, 90, 3);
    ColorImage image, expected;
    BaselineJpegDecoder decoder;
    for (std::size_t i = 0; i < whole.size(); ++i)
        for (const int flip : {0x01, 0x10, 0x80, 0xff}) {
            Bytes damaged = whole;
            damaged[i] ^= std::byte(flip);
            const Status status = decoder.decode(damaged, image);
            ASSERT_EQ(status, decode_jpeg_reference(damaged, expected)) << i;
            if (status == Status::ok) {
                ASSERT_TRUE(image == expected) << i;
            }
        }
}

TEST(JpegDecoder, RefusesImpossibleCodes) {
    const Bytes whole = encoded(scene({32, 32}, 30), TJSAMP_420, 85);
    const std::size_t counts = find(whole, 0xc4) + 5;
    Bytes jpeg = whole;
    jpeg[counts] = std::byte{3};  // codes of one bit
    EXPECT_EQ(status_of(jpeg), Status::malformed);
    jpeg = whole;
    jpeg[counts + 15] = std::byte{255};  // more symbols than there are bytes
    EXPECT_EQ(status_of(jpeg), Status::malformed);
    jpeg = whole;
    jpeg[counts + 16] = std::byte{16};  // DC differences have no 16 bits
    EXPECT_EQ(status_of(jpeg), Status::malformed);
    jpeg = whole;
    jpeg[counts - 1] = std::byte{0x04};  // there are four tables
    EXPECT_EQ(status_of(jpeg), Status::malformed);
}

TEST(JpegDecoder, CodesWithoutSymbolsEndInAStatus) {
    Bytes jpeg = encoded(scene({32, 32}, 30), TJSAMP_420, 85);
    for (std::size_t at = 0, i = 0; i < 4; ++i) {
        at = find(jpeg, 0xc4, at + 1);
        const auto length = std::to_integer<std::ptrdiff_t>(jpeg[at + 2]) * 256 +
                            std::to_integer<std::ptrdiff_t>(jpeg[at + 3]);
        const auto begin = jpeg.begin() + std::ptrdiff_t(at);
        std::fill(begin + 5, begin + 5 + 16, std::byte{0});
        jpeg.erase(begin + 5 + 16, begin + 2 + length);
        jpeg[at + 2] = {};
        jpeg[at + 3] = std::byte{19};
    }
    EXPECT_EQ(status_of(jpeg), Status::malformed);
}

TEST(JpegDecoder, LeavesToTheLibraryWhatItDoesNotKnow) {
    const ColorImage image = scene({40, 40}, 10);
    const Bytes whole = encoded(image, TJSAMP_420, 85);
    JpegDecompressor decompressor;
    ColorImage out;
    for (const int subsampling : {TJSAMP_440, TJSAMP_411, TJSAMP_GRAY}) {
        const Bytes jpeg = encoded(image, subsampling, 85);
        EXPECT_EQ(status_of(jpeg), Status::unsupported);
        EXPECT_EQ(decompressor.decompress(jpeg, out), Status::ok);
        EXPECT_TRUE(out == decoded_by_library(jpeg, image.size));
    }

    // Motion JPEG: the usual codes are not in the picture.
    Bytes jpeg = whole;
    for (int i = 0; i < 4; ++i) {
        const std::size_t at = find(jpeg, 0xc4);
        const auto length = std::to_integer<std::ptrdiff_t>(jpeg[at + 2]) * 256 +
                            std::to_integer<std::ptrdiff_t>(jpeg[at + 3]);
        const auto begin = jpeg.begin() + std::ptrdiff_t(at);
        jpeg.erase(begin, begin + 2 + length);
    }
    EXPECT_EQ(status_of(jpeg), Status::unsupported);
    EXPECT_EQ(decompressor.decompress(jpeg, out), Status::ok);
    EXPECT_TRUE(out == decoded_by_library(whole, image.size));

    // And no steps of quantisation at all.
    jpeg = whole;
    for (int i = 0; i < 2; ++i) {
        const auto begin = jpeg.begin() + std::ptrdiff_t(find(jpeg, 0xdb));
        jpeg.erase(begin, begin + 2 + 67);
    }
    EXPECT_EQ(status_of(jpeg), Status::unsupported);
    EXPECT_EQ(JpegDecompressor().decompress(jpeg, out), Status::malformed);
}

TEST(JpegDecoder, WhatFollowsTheCodedBytesMatters) {
    const Bytes whole = encoded(scene({32, 32}, 30), TJSAMP_420, 85, 2);
    const auto with_before_the_end = [&](std::initializer_list<int> values) {
        Bytes jpeg = whole;
        for (const int value : values)
            jpeg.insert(jpeg.end() - 2, std::byte(value));
        return status_of(jpeg);
    };
    EXPECT_EQ(with_before_the_end({0, 0, 0xff, 0, 7}), Status::ok);            // surplus
    EXPECT_EQ(with_before_the_end({0xff, 0xff, 0xff}), Status::ok);            // padding
    EXPECT_EQ(with_before_the_end({0xff, 0xfe, 0, 3, 1}), Status::ok);         // a comment
    EXPECT_EQ(with_before_the_end({0xff, 0xda, 0, 3, 1}), Status::malformed);  // a scan
    EXPECT_EQ(with_before_the_end({0xff, 0xfe, 0, 9, 1}), Status::malformed);  // no end

    Bytes jpeg = whole;
    jpeg.push_back(std::byte{1});
    EXPECT_EQ(status_of(jpeg), Status::ok);

    jpeg = whole;
    const std::size_t restart = find(jpeg, 0xd0);
    jpeg.insert(jpeg.begin() + std::ptrdiff_t(restart), 5, std::byte{0});
    EXPECT_EQ(status_of(jpeg), Status::ok);
    jpeg[restart + 6] = std::byte{0xd1};  // not its turn
    EXPECT_EQ(status_of(jpeg), Status::malformed);
}

TEST(JpegDecoder, KeepsTheMemoryOfTheImage) {
    const Bytes jpeg = encoded(scene({64, 48}, 30), TJSAMP_420, 85);
    BaselineJpegDecoder decoder;
    ColorImage image;
    ASSERT_EQ(decoder.decode(jpeg, image), Status::ok);
    const Rgb* const memory = image.pixels.data();
    ASSERT_EQ(decoder.decode(jpeg, image), Status::ok);
    EXPECT_EQ(image.pixels.data(), memory);
}

}  // namespace
}  // namespace theatron::video
