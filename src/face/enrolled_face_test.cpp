// SPDX-License-Identifier: Apache-2.0
#include "face/enrolled_face.h"

#include <gtest/gtest.h>

#include <cmath>

namespace theatron::face {
namespace {

EnrolledFace some_face() {
    const MorphModel model = generated_head();
    const std::vector<float> identity = {1, -1, 0.5F};
    EnrolledFace face = enrolled_person(model, identity);
    face.textures[std::size_t(Emotion::neutral)] = Bytes(100, std::byte(7));
    face.textures[std::size_t(Emotion::anger)] = Bytes(50, std::byte(8));
    face.colors[0] = {1, 2, 3};
    return face;
}

// Where the first texture's size stands: textures are the last.
std::size_t textures_at(const Bytes& whole) {
    return whole.size() - 6 * 4 - 150;
}

TEST(EnrolledFace, BytesRoundTripAndAreSmall) {
    const EnrolledFace face = some_face();
    const Bytes whole = enrolled_bytes(face);
    EXPECT_LT(whole.size(), 400'000U);
    const auto read = parse_enrolled(whole);
    ASSERT_TRUE(read);
    EXPECT_EQ(enrolled_bytes(*read), whole);
    EXPECT_EQ(read->textures, face.textures);
    EXPECT_EQ(read->colors, face.colors);
    EXPECT_EQ(read->rest.triangles, face.rest.triangles);
    for (std::size_t i = 0; i < face.rest.points.size(); ++i)
        ASSERT_NEAR(read->rest.points[i], face.rest.points[i], 0.011);
    for (std::size_t m = 0; m < move_count; ++m)
        for (std::size_t i = 0; i < face.rest.points.size(); ++i)
            ASSERT_NEAR(read->moves[m][i], face.moves[m][i], 0.006);
}

TEST(EnrolledFace, EveryTruncationAndWhatIsForbiddenIsRefused) {
    const Bytes whole = enrolled_bytes(some_face());
    for (std::size_t n = 0; n < whole.size(); n += n < 100 ? 1 : 4001)
        EXPECT_EQ(parse_enrolled(ByteView(whole).first(n)).error(),
                  n < 5 ? Status::malformed : Status::truncated)
            << n;
    const auto changed = [&](std::size_t at, unsigned value) {
        Bytes bytes = whole;
        bytes[at] = std::byte(value);
        return parse_enrolled(bytes).error();
    };
    EXPECT_EQ(changed(5, 2), Status::unsupported_version);
    EXPECT_EQ(changed(5, 0), Status::malformed);
    EXPECT_EQ(changed(11, 0x7f), Status::too_large);  // triangles of the skin
    Bytes longer = whole;
    longer.push_back(std::byte(0));
    EXPECT_EQ(parse_enrolled(longer).error(), Status::trailing_bytes);
    // A triangle's corner that is not there, and a point at the value that is none.
    const std::size_t points_at = 8 + 4 * part_count + 3 * part_count, vertices = 3721;
    Bytes outside = whole;
    store_le(outside.data() + points_at + 10 * vertices, std::uint16_t(vertices));
    EXPECT_EQ(parse_enrolled(outside).error(), Status::malformed);
    Bytes no_point = whole;
    store_le(no_point.data() + points_at, std::int16_t(-32768));
    EXPECT_EQ(parse_enrolled(no_point).error(), Status::malformed);
    // The neutral texture is never missing.
    Bytes without = whole;
    store_le(without.data() + whole.size() - 104, std::uint32_t(0));
    without.resize(whole.size() - 100);
    EXPECT_EQ(parse_enrolled(without).error(), Status::malformed);
    Bytes huge = whole;
    store_le(huge.data() + textures_at(whole), std::uint32_t(max_texture_bytes + 1));
    EXPECT_EQ(parse_enrolled(huge).error(), Status::too_large);
}

TEST(EnrolledFace, MovesAsTheModelDoes) {
    const MorphModel model = generated_head();
    const std::vector<float> identity = {0.5F, 1};
    const EnrolledFace face = enrolled_person(model, identity);
    std::vector<float> blended(face.rest.points.size()), expected(blended.size());
    const auto largest = [&](const Emotions& weights, const DirectChannels& direct) {
        blend_face(face, weights, direct, blended);
        blend_shape(model, identity, blend_expressions(weights, direct), expected);
        float most = 0;
        for (std::size_t i = 0; i < blended.size(); ++i)
            most = std::max(most, std::fabs(blended[i] - expected[i]));
        return most;
    };
    EXPECT_LT(largest({0, 0, 1, 0, 0, 0}, {}), 1e-3);
    EXPECT_LT(largest({0.3F, 0, 0, 0.7F, 0, 0}, {0.5F, 0.2F, 1}), 1e-3);
    EXPECT_LT(largest({1, 1, 0, 0, 1, 5}, {2, -1, NAN}), 1e-3);
    EXPECT_LT(largest({}, {}), 1e-3);
}

}  // namespace
}  // namespace theatron::face
