// SPDX-License-Identifier: Apache-2.0
#include "medical/picture.h"

#include <gtest/gtest.h>

#include <random>

namespace theatron::medical {
namespace {

ColorImage noise(Size size, bool grey) {
    std::mt19937 rng(3);
    ColorImage image(size);
    for (Rgb& p : image.pixels) {
        p.r = std::uint8_t(rng());
        p.g = grey ? p.r : std::uint8_t(rng());
        p.b = grey ? p.r : std::uint8_t(rng());
    }
    return image;
}

TEST(Picture, BytesAreAsSpecified) {
    ColorImage image({1, 2});
    image.pixels = {{1, 2, 3}, {4, 4, 4}};
    const auto byte = [](int value) { return std::byte(value); };
    const Bytes expected{byte('T'), byte('H'), byte('P'), byte('I'), byte(1), byte(3),
                         byte(0),   byte(0),   byte(1),   byte(0),   byte(0), byte(0),
                         byte(2),   byte(0),   byte(0),   byte(0),   byte(1), byte(2),
                         byte(3),   byte(4),   byte(4),   byte(4)};
    EXPECT_EQ(encode_picture(image.view()), expected);
}

TEST(Picture, IsReadAsItWasWrittenAndGreysTakeAThird) {
    for (const bool grey : {false, true})
        for (const Size size : {Size{1, 1}, Size{7, 3}, Size{max_picture_side, 1}}) {
            const ColorImage image = noise(size, grey);
            const Bytes bytes = encode_picture(image.view());
            EXPECT_EQ(bytes.size(), 16 + (grey ? 1 : 3) * size.area());
            const auto again = decode_picture(bytes);
            ASSERT_TRUE(again);
            EXPECT_EQ(*again, image);
        }
}

TEST(Picture, AnyMissingOrSurplusByteIsRefused) {
    const Bytes bytes = encode_picture(noise({5, 4}, false).view());
    for (std::size_t size = 0; size < bytes.size(); ++size)
        EXPECT_FALSE(decode_picture(ByteView(bytes).first(size))) << size;
    Bytes longer = bytes;
    longer.push_back({});
    EXPECT_FALSE(decode_picture(longer));
}

TEST(Picture, OtherVersionsSizesAndChannelsAreRefused) {
    const Bytes bytes = encode_picture(noise({5, 4}, false).view());
    const auto with = [&](std::size_t at, int value) {
        Bytes other = bytes;
        other[at] = std::byte(value);
        return decode_picture(other).error();
    };
    EXPECT_EQ(with(4, 2), Status::unsupported_version);
    EXPECT_EQ(with(5, 4), Status::malformed);
    EXPECT_EQ(with(6, 1), Status::malformed);
    EXPECT_EQ(with(8, 0), Status::malformed);
    EXPECT_EQ(with(9, 0x10), Status::too_large);
}

TEST(Picture, ALargeOneIsReducedToTheMeansOfItsAreas) {
    ColorImage image({6, 4});
    for (std::size_t i = 0; i < image.pixels.size(); ++i)
        image.pixels[i] = {std::uint8_t(i % 6 < 3 ? 30 : 90), std::uint8_t(i % 6 * 20), 7};
    const ColorImage small = reduced(image, 2);
    ASSERT_EQ(small.size, (Size{2, 1}));
    EXPECT_EQ(small.pixels[0], (Rgb{30, 20, 7}));
    EXPECT_EQ(small.pixels[1], (Rgb{90, 80, 7}));
    EXPECT_EQ(reduced(image, 6), image);
    // Sides that do not divide: the mean stays.
    const ColorImage odd = reduced(noise({31, 17}, true), 10);
    EXPECT_EQ(odd.size, (Size{10, 5}));
    double mean = 0, mean_before = 0;
    for (const Rgb p : odd.pixels)
        mean += p.r / double(odd.pixels.size());
    const ColorImage before = noise({31, 17}, true);
    for (const Rgb p : before.pixels)
        mean_before += p.r / double(before.pixels.size());
    EXPECT_NEAR(mean, mean_before, 0.5);
    EXPECT_EQ(reduced(noise({5000, 1}, false), 100).size, (Size{100, 1}));
}

}  // namespace
}  // namespace theatron::medical
