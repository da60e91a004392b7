// SPDX-License-Identifier: Apache-2.0
#include "codec/rvl.h"

#include <gtest/gtest.h>

#include "codec/test_images.h"

namespace theatron::codec::rvl {
namespace {

Bytes encoded_runs(const std::vector<std::uint16_t>& values) {
    Bytes out(max_encoded_runs(values.size()));
    out.resize(encode_runs(values, out));
    return Bytes(out);
}

Status decoded_runs(const Bytes& encoded, std::size_t count) {
    std::vector<std::uint16_t> values(count);
    return decode_runs(encoded, values);
}

// The test vector of docs/formats/depth_rvl.md.
TEST(Rvl, BytesAreAsSpecified) {
    DepthImage image({4, 2});
    image.pixels = {0, 0, 1000, 1001, 1001, 999, 0, 0xffff};
    const Bytes expected = bytes({2, 1, 0, 0, 4, 0, 2, 0,  // header
                                  0x42,                    // two empty, four measured
                                  0xa8, 0x3f,              // +1000
                                  0x02,                    // +1, 0
                                  0x13,                    // -2; one empty,
                                  0xf1, 0xf9, 0x03});      // one measured, -1000 modulo 2^16
    Bytes out(max_encoded_size(image.size));
    out.resize(encode(image.view(), out));
    EXPECT_EQ(out, expected);

    DepthImage decoded(image.size);
    ASSERT_EQ(decode(expected, decoded.view()), Status::ok);
    EXPECT_EQ(decoded, image);
}

TEST(Rvl, CodesTheLargestDifferencesAndLongestRuns) {
    std::vector<std::uint16_t> values(100'000);
    for (std::size_t i = 0; i < 400; ++i)
        values[70'000 + i] = i % 2 ? 0xffff : 0x7fff;  // the largest difference either way
    values.back() = 1;
    const Bytes encoded = encoded_runs(values);
    std::vector<std::uint16_t> decoded(values.size());
    ASSERT_EQ(decode_runs(encoded, decoded), Status::ok);
    EXPECT_EQ(decoded, values);
}

// Differences and runs of all code lengths, and at the limits of the fast paths.
TEST(Rvl, CodesEveryMixOfLengths) {
    std::mt19937 random(3);
    const int steps[] = {0, 1, 3, 4, 7, 31, 32, 40, 255, 256, 300, 2047, 2048, 16383, 20000};
    for (int round = 0; round < 2000; ++round) {
        std::vector<std::uint16_t> values(1 + random() % 70);
        std::uint16_t value = 1000;
        const unsigned rarity = 1 + random() % 20;
        const unsigned kinds = 1 + random() % std::size(steps);
        for (auto& v : values) {
            const int step = steps[random() % kinds];
            value = std::uint16_t(value + (random() % 2 ? step : -step));
            v = random() % rarity == 0 ? std::uint16_t(0) : value;
        }
        const Bytes encoded = encoded_runs(values);
        std::vector<std::uint16_t> decoded(values.size(), 0xabcd);
        ASSERT_EQ(decode_runs(encoded, decoded), Status::ok);
        ASSERT_EQ(decoded, values);
    }
}

// The bytes after a run must not be decoded as part of it, whatever their value.
TEST(Rvl, EndsRunsWhereTheyEnd) {
    for (std::size_t measured = 1; measured < 40; ++measured) {
        for (const std::size_t empty : {1u, 7u, 8u, 9u, 511u, 512u, 5000u}) {
            std::vector<std::uint16_t> values;
            for (int repeat = 0; repeat < 3; ++repeat) {
                values.insert(values.end(), measured, std::uint16_t(1));
                values.insert(values.end(), empty, std::uint16_t(0));
            }
            const Bytes encoded = encoded_runs(values);
            std::vector<std::uint16_t> decoded(values.size());
            ASSERT_EQ(decode_runs(encoded, decoded), Status::ok) << measured << ", " << empty;
            ASSERT_EQ(decoded, values);
        }
    }
}

TEST(Rvl, StaysWithinItsBoundOnTheWorstImage) {
    std::vector<std::uint16_t> values(1001);
    for (std::size_t i = 0; i < values.size(); i += 2)
        values[i] = i % 4 ? 0xffff : 0x7fff;
    const Bytes encoded = encoded_runs(values);
    EXPECT_LE(encoded.size(), max_encoded_runs(values.size()));
    EXPECT_EQ(decoded_runs(encoded, values.size()), Status::ok);
}

TEST(Rvl, TruncationsAreCalledTruncated) {
    const DepthImage image = scene({50, 20}, 1);
    const Bytes whole = encoded_runs(image.pixels);
    for (std::size_t n = 0; n < whole.size(); ++n) {
        const Bytes part(whole.begin(), whole.begin() + std::ptrdiff_t(n));
        // A cut inside a number can leave a shorter number with a needless last group.
        const Status status = decoded_runs(part, image.pixels.size());
        EXPECT_TRUE(status == Status::truncated || status == Status::malformed) << n;
    }
}

TEST(Rvl, AcceptsOneSpellingOnly) {
    // One pixel of value 1: no empty ones, one measured, +1; then the filler.
    EXPECT_EQ(decoded_runs(bytes({0x10, 0x02}), 1), Status::ok);
    EXPECT_EQ(decoded_runs(bytes({0x10, 0x12}), 1), Status::malformed) << "filler not zero";
    EXPECT_EQ(decoded_runs(bytes({0x10, 0x00}), 1), Status::malformed) << "measured, but zero";
    EXPECT_EQ(decoded_runs(bytes({0x10, 0x0a}), 1), Status::malformed) << "needless group";
    EXPECT_EQ(decoded_runs(bytes({0x10, 0x02, 0x00}), 1), Status::trailing_bytes);
    EXPECT_EQ(decoded_runs(bytes({0x00, 0x10, 0x02}), 1), Status::malformed) << "two empty runs";
    EXPECT_EQ(decoded_runs(bytes({0x02}), 1), Status::malformed) << "more pixels than there are";
    EXPECT_EQ(decoded_runs(bytes({0x20, 0x02}), 1), Status::malformed) << "more pixels, measured";
    EXPECT_EQ(decoded_runs(bytes({0x10, 0x88, 0x88, 0x48}), 1), Status::malformed) << "17 bits";
    EXPECT_EQ(decoded_runs(bytes({0x10, 0x88, 0x88, 0x88, 0x88, 0x88, 0x88, 0x88}), 1),
              Status::malformed)
        << "no end of a number";
}

}  // namespace
}  // namespace theatron::codec::rvl
