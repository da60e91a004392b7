// SPDX-License-Identifier: Apache-2.0
#include "wire/face_expression.h"

#include <gtest/gtest.h>

#include <limits>

namespace theatron::wire {
namespace {

FaceExpression smiling() {
    FaceExpression face;
    face.time = from_us(0x0102030405);
    face.state = FaceExpression::State::tracked;
    face.emotions = {0, 0, 0.8F, 0, 0, 0.2F};
    face.jaw_open = 0.4F;
    face.blink_right = 1;
    return face;
}

// The test vector of docs/formats/face_expression.md.
TEST(FaceExpression, BytesAreAsSpecified) {
    const int expected[] = {5, 4, 3,    2, 1, 0,  0,   0,  // time
                            1, 3,                          // tracked, three channels
                            0, 0, 0xcc, 0, 0, 51, 102, 0, 255};
    const Bytes bytes = encode_face_expression(smiling());
    ASSERT_EQ(bytes.size(), std::size(expected));
    for (std::size_t i = 0; i < bytes.size(); ++i)
        EXPECT_EQ(std::to_integer<int>(bytes[i]), expected[i]) << "byte " << i;
}

TEST(FaceExpression, ComesBackToTheNearestStep) {
    FaceExpression face = smiling();
    EXPECT_EQ(*decode_face_expression(encode_face_expression(face)), face)
        << "these values are steps";
    face.channels.emplace();
    for (std::size_t i = 0; i < face_channels; ++i)
        (*face.channels)[i] = float(i) / (face_channels - 1);
    const auto back = decode_face_expression(encode_face_expression(face));
    ASSERT_TRUE(back && back->channels);
    for (std::size_t i = 0; i < face_channels; ++i)
        EXPECT_NEAR((*back->channels)[i], (*face.channels)[i], 0.5 / 255 + 1e-6);
    EXPECT_EQ(back->jaw_open, 0) << "it is in the channels";
}

TEST(FaceExpression, AGuessedMouthIsToldAndNoFurtherStateIsKnown) {
    FaceExpression face = smiling();
    face.state = FaceExpression::State::voiced;
    Bytes bytes = encode_face_expression(face);
    EXPECT_EQ(*decode_face_expression(bytes), face);
    EXPECT_EQ(std::to_integer<int>(bytes[8]), 3);
    bytes[8] = std::byte{4};
    EXPECT_EQ(decode_face_expression(bytes).error(), Status::malformed);
}

TEST(FaceExpression, NoneHasNoValues) {
    FaceExpression none = smiling();
    none.state = FaceExpression::State::none;
    const Bytes bytes = encode_face_expression(none);
    EXPECT_EQ(bytes.size(), 9u);
    EXPECT_EQ(decode_face_expression(bytes)->emotions, FaceExpression().emotions);
}

TEST(FaceExpression, HostileValuesAreLimited) {
    FaceExpression face = smiling();
    face.emotions = {
        -1, 7, std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(),
        0,  0};
    const auto back = decode_face_expression(encode_face_expression(face));
    ASSERT_TRUE(back);
    EXPECT_EQ(back->emotions, (std::array<float, face_emotions>{0, 1, 0, 1, 0, 0}));
}

TEST(FaceExpression, AnythingElseIsRefused) {
    const Bytes good = encode_face_expression(smiling());
    for (std::size_t size = 0; size < good.size(); ++size)
        EXPECT_EQ(decode_face_expression(ByteView(good).first(size)).error(), Status::truncated);
    Bytes longer = good;
    longer.push_back({});
    EXPECT_EQ(decode_face_expression(longer).error(), Status::trailing_bytes);
    for (const auto& [at, value] : {std::pair(8, 4), std::pair(9, 4), std::pair(7, 0x7f)}) {
        Bytes bad = good;
        bad[std::size_t(at)] = std::byte(value);
        EXPECT_EQ(decode_face_expression(bad).error(), Status::malformed) << "byte " << at;
    }
}

}  // namespace
}  // namespace theatron::wire
