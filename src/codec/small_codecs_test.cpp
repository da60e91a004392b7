// SPDX-License-Identifier: Apache-2.0
// The test vectors of docs/formats for raw, trvl, ans, zstd and lz4, and the planes of
// zstd and lz4.
#include <gtest/gtest.h>

#include "codec/ans.h"
#include "codec/depth_codec.h"
#include "codec/library_codec.h"
#include "codec/planes.h"
#include "codec/raw.h"
#include "codec/test_images.h"
#include "codec/trvl.h"

namespace theatron::codec {
namespace {

DepthImage four_by_two(std::initializer_list<std::uint16_t> pixels) {
    DepthImage image({4, 2});
    image.pixels = pixels;
    return image;
}

const DepthImage before = four_by_two({0, 5, 1000, 1001, 1001, 999, 7, 0xffff});
const DepthImage after = four_by_two({0, 0, 1002, 1000, 1001, 999, 7, 1});

TEST(Raw, BytesAreAsSpecified) {
    const Bytes expected =
        bytes({1,    1,    0,    0,    4,    0,    2,    0,     // header
               0,    0,    0,    0,    0xea, 0x03, 0xe8, 0x03,  // 0, 0, 1002, 1000
               0xe9, 0x03, 0xe7, 0x03, 7,    0,    1,    0});
    Bytes out(raw::encoded_size(after.size));
    ASSERT_EQ(raw::encode(after.view(), out), out.size());
    EXPECT_EQ(out, expected);
}

TEST(Trvl, BytesAreAsSpecified) {
    const Bytes expected = bytes({3, 1, 1, 0, 4, 0, 2, 0,  // header: a delta frame
                                  0x31,                    // one equal, three changed
                                  0x19,                    // -5
                                  0x1e,                    // from -5 to +2
                                  0x35,                    // from +2 to -1; three equal,
                                  0x61});                  // one changed, +2 modulo 2^16
    std::vector<std::uint16_t> scratch(8);
    Bytes out(trvl::max_encoded_size(after.size));
    out.resize(trvl::encode(after.view(), before.view(), scratch, out));
    EXPECT_EQ(out, expected);
}

TEST(Ans, BytesAreAsSpecified) {
    const Bytes expected = bytes({
        6,    1, 1,    0, 4,    0, 2,    0,  // header: a delta frame
        4,    0, 0,    0,                    // four runs: 1 3 3 1
        0,    0, 0x84, 0, 0,    0, 0x84, 0,  // frequencies of 1 and 3
        0,    0, 0x84, 0, 0,    0, 0x84, 0,  // the same
        0,    0, 0,    0, 0,    0, 0,    0,  // no words, no extra bits
        0,    0, 1,    0, 0,    4, 1,    0, 0,    4, 1, 0, 0,    0, 1, 0,  // states
        0,    4, 0x82, 0, 0x82, 0, 0,    1, 0x82, 0, 0, 3, 0x82, 0,  // frequencies of 5, 6, 9, 14
        0x88, 0, 0x88, 0, 0x88, 0, 0x88, 0, 0x88, 0,                 // unused contexts
        0,    0, 0,    0, 0,    0, 0,    0,                          // no words, no extra bits
        0,    4, 2,    0, 0,    6, 2,    0, 0,    0, 2, 0, 0,    2, 2, 0,  // states
    });
    ans::DepthWorkspace work;
    Bytes out(ans::max_encoded_size(after.size));
    out.resize(ans::encode(after.view(), before.view(), work, out));
    EXPECT_EQ(out, expected);
}

// Numbers of all sizes, and counts with all remainders of the four parts.
TEST(Ans, CodesAnyNumbers) {
    std::mt19937 random(9);
    ans::Workspace work;
    for (std::size_t count = 0; count < 300; ++count) {
        std::vector<std::uint32_t> numbers(count);
        const unsigned shift = random() % 16;
        for (auto& number : numbers)
            number = (random() & 0xffff) >> (random() % 3 ? shift : 0);
        Bytes out(ans::max_encoded_numbers(count));
        out.resize(ans::encode_differences(numbers, work, out));
        ByteView in(out);
        std::vector<std::uint32_t> decoded(count);
        ASSERT_EQ(ans::decode_differences(in, work, decoded), Status::ok);
        ASSERT_EQ(decoded, numbers);
        EXPECT_TRUE(in.empty());
    }
}

TEST(Ans, CodesTheLongestRuns) {
    const std::vector<std::uint32_t> runs = {0, 1, 67108864, 67108863, 15, 16, 17, 1000};
    ans::Workspace work;
    Bytes out(ans::max_encoded_numbers(runs.size()));
    out.resize(ans::encode_runs(runs, work, out));
    ByteView in(out);
    std::vector<std::uint32_t> decoded(runs.size());
    ASSERT_EQ(ans::decode_runs(in, work, decoded), Status::ok);
    EXPECT_EQ(decoded, runs);
}

TEST(Ans, ContextsAreAsSpecified) {
    using Model = ans::DifferenceModel;
    std::vector<std::uint32_t> first_of_each;
    for (std::uint32_t mean = 0; mean < 512; ++mean) {
        if (Model::context(mean) == first_of_each.size())
            first_of_each.push_back(mean);
    }
    EXPECT_EQ(first_of_each, (std::vector<std::uint32_t>{0, 4, 8, 15, 29, 81}));
    EXPECT_EQ(Model::next(7, 10), 14u);
    EXPECT_LT(Model::next(511, Model::Symbols::size - 1), 512u);
}

TEST(Ans, SymbolsPartitionTheNumbers) {
    using Symbols = ans::DifferenceModel::Symbols;
    std::uint32_t last = 0;
    for (std::uint32_t number = 1; number < 0x10000; ++number) {
        const std::uint32_t symbol = Symbols::symbol(number);
        ASSERT_TRUE(symbol == last || symbol == last + 1) << number;
        ASSERT_GE(number, Symbols::base(symbol));
        ASSERT_LT(number - Symbols::base(symbol), 1u << Symbols::extra_bits(symbol));
        last = symbol;
    }
    EXPECT_EQ(last + 1, Symbols::size);
}

// Decoding only: other LZ4 versions may compress the same pixels differently.
TEST(Lz4, DecodesTheSpecifiedBytes) {
    if (!has_lz4())
        GTEST_SKIP() << "built without LZ4";
    const Bytes vector = bytes({5,    1,    0, 2, 4,    0, 2,    0,  // header: pixels, step 2
                                0xf0, 0x01,                          // 16 literal bytes
                                0,    0,    0, 0, 0xf5, 1, 0xf4, 1, 0xf5, 1, 0xf4, 1, 4, 0, 1, 0});
    DepthImage decoded(after.size);
    const auto codec = make_depth_codec(parse_depth_setting("lz4:quant_mm=2").setting);
    ASSERT_EQ(codec->decode(vector, nullptr, decoded.view(), nullptr), Status::ok);
    EXPECT_EQ(decoded, four_by_two({0, 0, 1001, 999, 1001, 999, 7, 1}));
}

// Decoding only: other zstd versions may compress the same pixels differently.
TEST(Zstd, DecodesTheSpecifiedBytes) {
    if (!has_zstd())
        GTEST_SKIP() << "built without zstd";
    const Bytes vector = bytes({4,    1,    1,    1,    4,    0,    2, 0,  // header: delta, planes
                                0x28, 0xb5, 0x2f, 0xfd, 0x20, 0x10,  // a zstd frame of 16 bytes
                                0x81, 0x00, 0x00,                    // in one block, uncompressed
                                0,    9,    4,    1,    0,    0,    0, 4,    // low bytes
                                0,    0,    0,    0,    0,    0,    0, 0});  // high bytes
    const Reference reference{before, {}};
    DepthImage decoded(after.size);
    ASSERT_EQ(make_depth_codec(parse_depth_setting("zstd:delta=1").setting)
                  ->decode(vector, &reference, decoded.view(), nullptr),
              Status::ok);
    EXPECT_EQ(decoded, after);
}

TEST(Planes, AreLowBytesThenHighBytesOfZigzaggedDifferences) {
    Bytes planes(16);
    split_planes(after.view(), before.view(), planes);
    EXPECT_EQ(planes, bytes({0, 9, 4, 1, 0, 0, 0, 4, 0, 0, 0, 0, 0, 0, 0, 0}));
    // Without a reference: the pixel to the left, or above at the start of a row.
    split_planes(after.view(), {}, planes);
    EXPECT_EQ(planes, bytes({0, 0, 0xd4, 3, 0xd2, 3, 0xbf, 11, 0, 0, 7, 0, 7, 0, 7, 0}));
}

}  // namespace
}  // namespace theatron::codec
