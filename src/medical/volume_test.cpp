// SPDX-License-Identifier: Apache-2.0
#include "medical/volume.h"

#include <gtest/gtest.h>

#include <limits>

namespace theatron::medical {
namespace {

Volume small_volume() {
    Volume volume;
    volume.grid = {3, 2, 2, {-10, 20.5, -300}, {0.5, 0, 0}, {0, 0.75, 0}, {0, 0, 2.5}};
    volume.intercept = -1024;
    volume.samples = {0, 1, 2, 3, 4, 5, -1, -2, -32768, 32767, 1000, 0x0102};
    return volume;
}

TEST(Volume, BytesAreAsSpecified) {
    const Bytes bytes = encode_volume(small_volume());
    ASSERT_EQ(bytes.size(), 148u + 24);
    const auto at = [&](std::size_t i) { return std::to_integer<int>(bytes[i]); };
    EXPECT_EQ(std::string(reinterpret_cast<const char*>(bytes.data()), 4), "THVO");
    EXPECT_EQ(at(4), 1);      // version
    EXPECT_EQ(at(8), 3);      // columns
    EXPECT_EQ(at(12), 2);     // rows
    EXPECT_EQ(at(16), 2);     // slices
    EXPECT_EQ(at(27), 0xc0);  // the origin's x is -10: c0 24 00 00 00 00 00 00
    EXPECT_EQ(at(26), 0x24);
    EXPECT_EQ(at(170), 2);  // the last sample
    EXPECT_EQ(at(171), 1);
}

TEST(Volume, ComesBackAsItWasWritten) {
    Volume volume = small_volume();
    volume.inverted = true;
    volume.slope = 0.25;
    volume.window = {100, 1};
    const Result<Volume> read = decode_volume(encode_volume(volume));
    ASSERT_TRUE(read);
    EXPECT_EQ(read->grid, volume.grid);
    EXPECT_EQ(read->samples, volume.samples);
    EXPECT_EQ(read->slope, 0.25);
    EXPECT_EQ(read->intercept, -1024);
    EXPECT_EQ(read->window, volume.window);
    EXPECT_TRUE(read->inverted);
}

TEST(Volume, EveryTruncationIsRefused) {
    const Bytes whole = encode_volume(small_volume());
    for (std::size_t n = 0; n < whole.size(); ++n)
        EXPECT_EQ(decode_volume(Bytes(whole.begin(), whole.begin() + std::ptrdiff_t(n))).error(),
                  Status::truncated)
            << n;
}

TEST(Volume, WhatCannotBeIsRefused) {
    const auto changed = [](auto change) {
        Bytes bytes = encode_volume(small_volume());
        change(bytes);
        return decode_volume(bytes).error();
    };
    EXPECT_EQ(changed([](Bytes& b) { b.push_back(std::byte(0)); }), Status::trailing_bytes);
    EXPECT_EQ(changed([](Bytes& b) { b[0] = std::byte('X'); }), Status::malformed);
    EXPECT_EQ(changed([](Bytes& b) { b[4] = std::byte(2); }), Status::unsupported_version);
    EXPECT_EQ(changed([](Bytes& b) { b[4] = std::byte(0); }), Status::malformed);
    EXPECT_EQ(changed([](Bytes& b) { b[5] = std::byte(2); }), Status::malformed);
    EXPECT_EQ(changed([](Bytes& b) { b[6] = std::byte(1); }), Status::malformed);
    EXPECT_EQ(changed([](Bytes& b) { store_le(&b[8], 0u); }), Status::malformed);
    EXPECT_EQ(changed([](Bytes& b) { store_le(&b[8], 5000u); }), Status::too_large);
    EXPECT_EQ(changed([](Bytes& b) {
                  for (const int i : {8, 12, 16})
                      store_le(&b[std::size_t(i)], 4096u);
              }),
              Status::too_large);
    // A slope of 0, an infinite origin, and a slice step that lies in the plane of the slices.
    EXPECT_EQ(changed([](Bytes& b) { std::fill_n(&b[116], 8, std::byte(0)); }), Status::malformed);
    EXPECT_EQ(changed([](Bytes& b) { store_le(&b[20], std::uint64_t(0x7ff0) << 48); }),
              Status::malformed);
    EXPECT_EQ(changed([](Bytes& b) { std::copy_n(&b[44], 24, &b[92]); }), Status::malformed);
}

TEST(Volume, PatientCoordinatesLeadToSamplesAndBack) {
    const VolumeGrid sheared{10, 20, 30, {1, 2, 3}, {0.7, 0.1, 0}, {-0.1, 0.7, 0}, {0, 0.4, 2.5}};
    ASSERT_TRUE(is_valid(sheared));
    const Vec3 back = SamplesFromPatient(sheared).point(sheared.point_at(4, 5.5, 6));
    EXPECT_NEAR(back.x, 4, 1e-12);
    EXPECT_NEAR(back.y, 5.5, 1e-12);
    EXPECT_NEAR(back.z, 6, 1e-12);
}

}  // namespace
}  // namespace theatron::medical
