// SPDX-License-Identifier: Apache-2.0
// The test vectors of docs/formats for raw, trvl and zstd, and what the planes
// of zstd and lz4 hold.
#include <gtest/gtest.h>

#include "codec/depth_codec.h"
#include "codec/planes.h"
#include "codec/raw.h"
#include "codec/test_images.h"
#include "codec/trvl.h"
#include "codec/zstd_codec.h"

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

// Decoding only: the same pixels may be compressed in more than one way.
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
    ASSERT_EQ(make_zstd(1, true)->decode(vector, &reference, decoded.view(), nullptr), Status::ok);
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
