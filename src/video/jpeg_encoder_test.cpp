// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <turbojpeg.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>

#include "testing/every_target.h"
#include "testing/shared_data.h"
#include "video/jpeg_encoder_native.h"
#include "video/jpeg_encoder_reference.h"
#include "video/test_psnr.h"

namespace theatron::video {
namespace {

constexpr std::size_t header_size = 623;

Bytes encoded(ColorView image, int quality, bool halve_chroma) {
    JpegCompressor compressor(quality, halve_chroma);
    const ByteView bytes = compressor.compress(image);
    return Bytes(bytes.begin(), bytes.end());
}

// With libjpeg-turbo, which refuses what is damaged.
ColorImage decoded(const Bytes& jpeg) {
    void* const library = tjInitDecompress();
    const auto* from = reinterpret_cast<const unsigned char*>(jpeg.data());
    int width = 0, height = 0, subsampling = 0, colors = 0;
    EXPECT_EQ(
        tjDecompressHeader3(library, from, jpeg.size(), &width, &height, &subsampling, &colors), 0);
    ColorImage image(Size{width, height});
    EXPECT_EQ(tjDecompress2(library, from, jpeg.size(), &image.pixels.data()->r, width, 0, height,
                            TJPF_RGB, TJFLAG_ACCURATEDCT),
              0)
        << tjGetErrorStr2(library);
    tjDestroy(library);
    return image;
}

Bytes encoded_by_libjpeg(const ColorImage& image, int quality, bool halve_chroma) {
    const int subsampling = halve_chroma ? TJSAMP_420 : TJSAMP_444;
    void* const library = tjInitCompress();
    Bytes jpeg(tjBufSize(image.size.width, image.size.height, subsampling));
    auto* to = reinterpret_cast<unsigned char*>(jpeg.data());
    auto used = static_cast<unsigned long>(jpeg.size());
    EXPECT_EQ(tjCompress2(library, &image.pixels.data()->r, image.size.width, 0, image.size.height,
                          TJPF_RGB, &to, &used, subsampling, quality,
                          TJFLAG_NOREALLOC | TJFLAG_ACCURATEDCT),
              0);
    tjDestroy(library);
    jpeg.resize(used);
    return jpeg;
}

template <class Color>
ColorImage picture(Size size, Color color) {
    ColorImage image(size);
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x)
            image.view().row(y)[x] = color(x, y);
    return image;
}

// Shades, edges and texture, like a room; integers only, so everywhere the same.
ColorImage room(Size size) {
    std::mt19937 random(5);
    return picture(size, [&](int x, int y) {
        const bool textured = (x / 40 + y / 30) % 3 == 0, edge = (x + 2 * y) % 160 < 50;
        const int grain = textured ? int(random() % 32) : int(random() % 4);
        return Rgb{std::uint8_t(60 + x * 97 / size.width + grain + 50 * edge),
                   std::uint8_t(50 + y * 113 / size.height + grain + 30 * edge),
                   std::uint8_t(150 - x * 83 / size.width + grain - 40 * edge)};
    });
}

ColorImage noise(Size size, unsigned seed) {
    std::mt19937 random(seed);
    return picture(size, [&](int, int) {
        const unsigned bits = unsigned(random());
        return Rgb{std::uint8_t(bits), std::uint8_t(bits >> 8), std::uint8_t(bits >> 16)};
    });
}

// Every channel of every pixel is 0 or 255.
ColorImage saturated_noise(Size size, unsigned seed) {
    ColorImage image = noise(size, seed);
    for (Rgb& p : image.pixels)
        p = {std::uint8_t(p.r & 1 ? 255 : 0), std::uint8_t(p.g & 1 ? 255 : 0),
             std::uint8_t(p.b & 1 ? 255 : 0)};
    return image;
}

// One block per basis function of the transform, black where it is negative and
// white where it is positive or the other way round: the largest coefficients.
ColorImage largest_coefficients() {
    return picture({64, 128}, [](int x, int y) {
        const auto wave = [](int frequency, int at) {
            return std::cos((2 * at + 1) * frequency * 3.14159265358979 / 16);
        };
        const bool positive = wave(x / 8, x % 8) * wave(y / 8 % 8, y % 8) > 0;
        const auto value = std::uint8_t(positive == (y < 64) ? 255 : 0);
        return Rgb{value, value, value};
    });
}

// The same in blue and yellow, which are the ends of a chroma component.
ColorImage largest_chroma_coefficients() {
    ColorImage image = largest_coefficients();
    for (Rgb& p : image.pixels)
        p.b = std::uint8_t(255 - p.b);
    return image;
}

void expect_equals_reference(const ColorImage& image) {
    for (const int quality : {1, 30, 85, 100})
        for (const bool halve_chroma : {true, false}) {
            SCOPED_TRACE(::testing::Message() << image.size.width << "x" << image.size.height << " "
                                              << quality << (halve_chroma ? " 420" : " 444"));
            const Bytes whole = encoded(image.view(), quality, halve_chroma);
            const Bytes scan(whole.begin() + header_size, whole.end() - 2);
            ASSERT_EQ(scan, jpeg::ReferenceScan(image.view(), quality, halve_chroma).encode());
        }
}

TEST(JpegEncoder, EveryTargetEqualsTheReference) {
    theatron::testing::on_every_target([] {
        unsigned seed = 0;
        for (const Size size : {Size{1, 1}, Size{1, 7}, Size{7, 1}, Size{16, 16}, Size{17, 33},
                                Size{63, 15}, Size{64, 16}, Size{65, 17}, Size{129, 9}}) {
            expect_equals_reference(room(size));
            expect_equals_reference(noise(size, ++seed));
            expect_equals_reference(saturated_noise(size, ++seed));
        }
    });
}

TEST(JpegEncoder, EveryTargetEqualsTheReferenceAtTheLimits) {
    theatron::testing::on_every_target([] {
        expect_equals_reference(largest_coefficients());
        expect_equals_reference(largest_chroma_coefficients());
    });
}

TEST(JpegEncoder, HeadersAreThoseOfLibjpeg) {
    const ColorImage image = room({33, 18});
    for (const int quality : {1, 49, 50, 85, 100})
        for (const bool halve_chroma : {true, false}) {
            Bytes ours = encoded(image.view(), quality, halve_chroma);
            Bytes theirs = encoded_by_libjpeg(image, quality, halve_chroma);
            ours.resize(header_size);
            theirs.resize(header_size);
            EXPECT_EQ(ours, theirs) << quality;
        }
}

void expect_as_good_as_libjpeg(const ColorImage& image) {
    for (const int quality : {50, 85, 95})
        for (const bool halve_chroma : {true, false}) {
            SCOPED_TRACE(::testing::Message() << quality << (halve_chroma ? " 420" : " 444"));
            const Bytes ours = encoded(image.view(), quality, halve_chroma);
            const Bytes theirs = encoded_by_libjpeg(image, quality, halve_chroma);
            EXPECT_NEAR(double(ours.size()), double(theirs.size()), 0.01 * double(theirs.size()));
            EXPECT_GT(psnr(image, decoded(ours)), psnr(image, decoded(theirs)) - 0.05);
        }
}

TEST(JpegEncoder, IsAsFaithfulAndAsSmallAsLibjpeg) {
    expect_as_good_as_libjpeg(room({320, 240}));
    expect_as_good_as_libjpeg(room({203, 131}));
}

TEST(JpegEncoder, IsAsFaithfulAndAsSmallAsLibjpegWithCamerasPictures) {
    THEATRON_REQUIRE_DATA("table-person_640x360/color/00000.jpg");
    for (const char* name :
         {"table-person_640x360/color/00000.jpg", "turning-person_640x480/color/00000.jpg"}) {
        SCOPED_TRACE(name);
        std::ifstream in(theatron::testing::shared_data() / name, std::ios::binary);
        const std::string file{std::istreambuf_iterator<char>(in), {}};
        const auto* bytes = reinterpret_cast<const std::byte*>(file.data());
        expect_as_good_as_libjpeg(decoded(Bytes(bytes, bytes + file.size())));
    }
}

TEST(JpegEncoder, PicturesOfAnySizeComeBack) {
    for (const Size size : {Size{1, 1}, Size{5, 2}, Size{8, 8}, Size{15, 31}, Size{66, 65}})
        for (const bool halve_chroma : {true, false}) {
            const ColorImage image = picture(size, [](int x, int y) {
                return Rgb{std::uint8_t(100 + x), std::uint8_t(90 + y), 80};
            });
            const ColorImage back = decoded(encoded(image.view(), 98, halve_chroma));
            ASSERT_EQ(back.size, size);
            EXPECT_GT(psnr(image, back), 42) << size.width << "x" << size.height;
        }
}

TEST(JpegEncoder, NothingOverflowsWithTheLargestCoefficients) {
    for (const ColorImage& image : {largest_coefficients(), largest_chroma_coefficients()})
        EXPECT_GT(psnr(image, decoded(encoded(image.view(), 100, false))), 46);
}

TEST(JpegEncoder, SaturatedNoiseComesBack) {
    const ColorImage image = saturated_noise({200, 100}, 3);
    EXPECT_GT(psnr(image, decoded(encoded(image.view(), 100, false))), 45);
    EXPECT_GT(psnr(image, decoded(encoded(image.view(), 90, false))), 30);
}

TEST(JpegEncoder, OnesInTheScanAreNoMarkers) {
    const Bytes jpeg = encoded(saturated_noise({256, 256}, 4).view(), 100, false);
    int stuffed = 0;
    for (std::size_t i = header_size; i + 2 < jpeg.size(); ++i)
        if (jpeg[i] == std::byte{0xff}) {
            ASSERT_EQ(jpeg[i + 1], std::byte{0}) << i;
            ++stuffed;
        }
    EXPECT_GT(stuffed, 3000);
}

TEST(JpegEncoder, FlatPicturesAreTinyAndExact) {
    for (const Rgb color :
         {Rgb{0, 0, 0}, Rgb{255, 255, 255}, Rgb{128, 128, 128}, Rgb{77, 77, 77}}) {
        const ColorImage image = picture({100, 70}, [&](int, int) { return color; });
        const Bytes jpeg = encoded(image.view(), 100, true);
        EXPECT_LT(jpeg.size(), header_size + 150);
        EXPECT_EQ(decoded(jpeg), image);
    }
}

TEST(JpegEncoder, RowsMayLieApart) {
    const ColorImage whole = noise({90, 50}, 8);
    const ColorView part(whole.view().row(3) + 5, {70, 40}, whole.view().stride);
    const ColorImage copy = picture(part.size, [&](int x, int y) { return part.row(y)[x]; });
    EXPECT_EQ(encoded(part, 85, true), encoded(copy.view(), 85, true));
}

TEST(JpegEncoder, PicturesOfOneSizeUseTheSameMemory) {
    JpegCompressor compressor(85, true);
    const std::byte* memory = compressor.compress(room({64, 48}).view()).data();
    EXPECT_EQ(compressor.compress(saturated_noise({64, 48}, 1).view()).data(), memory);
    const ColorImage other = room({48, 64});
    const ByteView bytes = compressor.compress(other.view());
    EXPECT_EQ(Bytes(bytes.begin(), bytes.end()), encoded(other.view(), 85, true));
}

TEST(JpegEncoder, BytesAreTheSameEverywhere) {
    std::uint64_t hash = 14695981039346656037u;  // FNV-1a
    for (const bool halve_chroma : {true, false})
        for (const std::byte b : encoded(room({150, 70}).view(), 85, halve_chroma))
            hash = (hash ^ std::uint64_t(b)) * 1099511628211u;
    EXPECT_EQ(hash, 11491443025927330702u);
}

}  // namespace
}  // namespace theatron::video
