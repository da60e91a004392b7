// SPDX-License-Identifier: Apache-2.0
#include "filter/background.h"

#include <gtest/gtest.h>

#include "filter/limits.h"
#include "filter/test_depth.h"

namespace theatron::filter {
namespace {

Background small() {
    return {.nearest =
                [] {
                    DepthImage image({2, 1});
                    image.pixels = {0x1234, 0};
                    return image;
                }(),
            .depth_unit_mm = 1,
            .frames = 90};
}

TEST(Background, KeepsTheNearestOfAllMeasurements) {
    Background background;
    for (const std::uint16_t depth : {1200, 0, 1195, 1210}) {
        DepthImage frame({3, 1});
        frame.pixels = {depth, 0, std::uint16_t(depth == 0 ? 0xffff : 0)};
        ASSERT_TRUE(add_frame(background, frame.view()));
    }
    EXPECT_EQ(background.frames, 4);
    EXPECT_EQ(background.nearest.pixels, (std::vector<std::uint16_t>{1195, 0, 0xffff}));
    EXPECT_FALSE(add_frame(background, DepthImage({2, 1}).view())) << "of another size";
    EXPECT_EQ(background.frames, 4);
}

TEST(Background, BytesAreAsSpecified) {
    const std::vector<int> expected = {
        'T',  'H',  'B', 'G', 1, 0, 0,    0,     // magic, version, reserved
        2,    0,    1,   0,                      // width, height
        90,   0,    0,   0,                      // frames
        0,    0,    0,   0,   0, 0, 0xf0, 0x3f,  // 1.0
        0x34, 0x12, 0,   0};
    const Bytes bytes = encode_background(small());
    ASSERT_EQ(bytes.size(), expected.size());
    for (std::size_t i = 0; i < bytes.size(); ++i)
        EXPECT_EQ(std::to_integer<int>(bytes[i]), expected[i]) << "byte " << i;
    const auto decoded = decode_background(bytes);
    ASSERT_TRUE(decoded);
    EXPECT_EQ(*decoded, small());
}

TEST(Background, RefusesWhatIsNone) {
    const Bytes whole = encode_background(small());
    for (std::size_t n = 0; n < whole.size(); ++n)
        EXPECT_EQ(decode_background(ByteView(whole).first(n)).error(), Status::truncated) << n;
    Bytes longer = whole;
    longer.push_back(std::byte{0});
    EXPECT_EQ(decode_background(longer).error(), Status::trailing_bytes);
    const auto with = [&](std::size_t at, int value) {
        Bytes changed = whole;
        changed[at] = std::byte(value);
        return decode_background(changed).error();
    };
    EXPECT_EQ(with(0, 'X'), Status::malformed);
    EXPECT_EQ(with(4, 0), Status::malformed);
    EXPECT_EQ(with(4, 2), Status::unsupported_version);
    EXPECT_EQ(with(5, 1), Status::malformed) << "reserved";
    EXPECT_EQ(with(8, 0), Status::malformed) << "no width";
    EXPECT_EQ(with(9, 0xff), Status::too_large);
    EXPECT_EQ(with(12, 0), Status::malformed) << "of no frames";
    EXPECT_EQ(with(23, 0x7f), Status::malformed) << "a unit that is no number";
    EXPECT_EQ(with(23, 0xbf), Status::malformed) << "a negative unit";
}

TEST(Background, TheMarginGrowsWithTheNoise) {
    DepthImage empty({3, 1});
    empty.pixels = {1000, 4000, 0};
    Limits limits(empty.size);
    limits.remove_background({empty, 1, 1}, 20, 2, {.constant_mm = 1, .squared_mm = 0.5}, 1);
    EXPECT_EQ(limits.furthest.row(0)[0], 1000 - 20 - 3);   // 2 * 1.5 mm
    EXPECT_EQ(limits.furthest.row(0)[1], 4000 - 20 - 18);  // 2 * 9 mm
    EXPECT_EQ(limits.furthest.row(0)[2], 0xffff) << "what was never measured is kept";
}

}  // namespace
}  // namespace theatron::filter
