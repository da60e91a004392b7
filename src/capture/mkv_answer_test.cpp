// SPDX-License-Identifier: Apache-2.0
#include "capture/mkv_answer.h"

#include <gtest/gtest.h>

#include <limits>

namespace theatron::capture {
namespace {

using Kind = MkvAnswer::Kind;

constexpr std::size_t shared_bytes = 1000;

TEST(MkvAnswer, ComesBackAsItWas) {
    const Bytes bytes = encode(MkvAnswer{Kind::color, -5us, 1000});
    const auto answer = decode_mkv_answer(bytes, shared_bytes);
    ASSERT_TRUE(answer);
    EXPECT_EQ(answer->kind, Kind::color);
    EXPECT_EQ(answer->time, -5us);
    EXPECT_EQ(answer->bytes, 1000u);
}

TEST(MkvAnswer, IsNeverLongerThanTheSharedMemory) {
    for (const std::uint32_t bytes : {std::uint32_t(1001), ~std::uint32_t(0)})
        EXPECT_EQ(
            decode_mkv_answer(encode(MkvAnswer{Kind::depth, {}, bytes}), shared_bytes).error(),
            Status::malformed);
}

TEST(MkvAnswer, KindsThatAreNoneAndTimesBeyondReasonAreRefused) {
    for (const int kind : {0, 9, 255})
        EXPECT_EQ(decode_mkv_answer(encode(MkvAnswer{Kind(kind), {}, 0}), shared_bytes).error(),
                  Status::malformed);
    for (const Duration time : {Duration::min(), Duration::max()})
        EXPECT_EQ(decode_mkv_answer(encode(MkvAnswer{Kind::depth, time, 0}), shared_bytes).error(),
                  Status::malformed);
}

TEST(MkvAnswer, EveryOtherLengthIsRefused) {
    Bytes bytes = encode(MkvAnswer{Kind::depth, 1s, 7});
    for (std::size_t n = 0; n < bytes.size(); ++n)
        EXPECT_EQ(decode_mkv_answer(ByteView(bytes).first(n), shared_bytes).error(),
                  Status::truncated);
    bytes.push_back({});
    EXPECT_EQ(decode_mkv_answer(bytes, shared_bytes).error(), Status::trailing_bytes);
}

const MkvDescription usual = {{640, 576}, {1280, 720}, 30, "H264", "{}"};

TEST(MkvDescription, ComesBackAsItWas) {
    const auto description = decode_mkv_description(encode(usual));
    ASSERT_TRUE(description);
    EXPECT_EQ(description->depth, usual.depth);
    EXPECT_EQ(description->color, usual.color);
    EXPECT_EQ(description->frames_per_second, 30);
    EXPECT_EQ(description->other_color, "H264");
    EXPECT_EQ(description->calibration, "{}");
}

TEST(MkvDescription, WhatNoHonestReaderSaysIsRefused) {
    std::vector<MkvDescription> wrong(6, usual);
    wrong[0].depth = {0, 576};
    wrong[1].depth = {640, max_side + 1};
    wrong[2].color = {-1280, 720};
    wrong[3].frames_per_second = std::numeric_limits<double>::quiet_NaN();
    wrong[4].other_color.assign(max_codec_name + 1, 'x');
    wrong[5].calibration.assign(max_calibration_bytes + 1, ' ');
    for (const MkvDescription& description : wrong)
        EXPECT_EQ(decode_mkv_description(encode(description)).error(), Status::malformed);
}

TEST(MkvDescription, EveryOtherLengthIsRefused) {
    Bytes bytes = encode(usual);
    for (std::size_t n = 0; n < bytes.size(); ++n)
        EXPECT_FALSE(decode_mkv_description(ByteView(bytes).first(n))) << n;
    bytes.push_back({});
    EXPECT_EQ(decode_mkv_description(bytes).error(), Status::trailing_bytes);
}

}  // namespace
}  // namespace theatron::capture
