// SPDX-License-Identifier: Apache-2.0
#include "cases/dicom_rle.h"

#include <gtest/gtest.h>

namespace theatron::cases {
namespace {

Bytes framed(const std::vector<std::vector<int>>& segments) {
    std::vector<std::uint32_t> header(16);
    header[0] = std::uint32_t(segments.size());
    std::uint32_t at = 64;
    for (std::size_t i = 0; i < segments.size(); ++i) {
        header[i + 1] = at;
        at += std::uint32_t(segments[i].size());
    }
    Bytes frame;
    for (const std::uint32_t word : header)
        for (int shift = 0; shift < 32; shift += 8)
            frame.push_back(std::byte(word >> shift & 255));
    for (const auto& segment : segments)
        for (const int byte : segment)
            frame.push_back(std::byte(byte));
    return frame;
}

std::vector<int> unpacked(const Bytes& frame, int bytes, std::size_t count) {
    std::vector<int> values(count, 99);
    return unpack_rle(frame, bytes, values) ? values : std::vector<int>{};
}

TEST(DicomRle, LiteralsAndRunsBecomeValues) {
    // Two literals, a byte that means nothing, a run of three, a run that is a byte too long.
    EXPECT_EQ(unpacked(framed({{1, 7, 8, 128, 254, 5, 255, 6}}), 1, 6),
              (std::vector{7, 8, 5, 5, 5, 6}));
}

TEST(DicomRle, TheFirstSegmentHasTheHighBytes) {
    EXPECT_EQ(unpacked(framed({{1, 1, 2}, {255, 16}}), 2, 2), (std::vector{0x110, 0x210}));
}

TEST(DicomRle, DamagedFramesAreNone) {
    const std::vector<int> none;
    EXPECT_EQ(unpacked({}, 1, 2), none);
    EXPECT_EQ(unpacked(framed({{1, 7, 8}}), 2, 2), none) << "another number of segments";
    EXPECT_EQ(unpacked(framed({{1, 7}}), 1, 2), none) << "a literal beyond the end";
    EXPECT_EQ(unpacked(framed({{255}}), 1, 2), none) << "a run without its byte";
    EXPECT_EQ(unpacked(framed({{0, 7}}), 1, 2), none) << "too few";
    for (const int offset : {0, 63, 200}) {
        Bytes frame = framed({{1, 7, 8}});
        frame[4] = std::byte(offset);
        EXPECT_EQ(unpacked(frame, 1, 2), none) << offset;
    }
}

}  // namespace
}  // namespace theatron::cases
