// SPDX-License-Identifier: Apache-2.0
#include "face/sent_face.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace theatron::face {
namespace {

EnrolledFace some_face() {
    const std::vector<float> identity = {0.5F, -0.5F, 1};
    EnrolledFace face = enrolled_person(generated_head(), identity);
    face.textures[std::size_t(Emotion::neutral)] = Bytes(10, std::byte(1));
    return face;
}

// The largest distance of a vertex from the nearest one of the other face.
double farthest(const std::vector<float>& from, const std::vector<float>& to) {
    double farthest = 0;
    for (std::size_t i = 0; i < from.size(); i += 3) {
        double nearest = 1e9;
        for (std::size_t k = 0; k < to.size(); k += 3)
            nearest = std::min(nearest, double(std::hypot(from[i] - to[k], from[i + 1] - to[k + 1],
                                                          from[i + 2] - to[k + 2])));
        farthest = std::max(farthest, nearest);
    }
    return farthest;
}

TEST(SentFace, TheEyesAreBetweenTheLids) {
    const Vec3 eyes = between_eyes(some_face());
    EXPECT_NEAR(eyes.x, 0, 3);
    EXPECT_NEAR(eyes.y, 25, 15);  // of the generated head
    EXPECT_GT(eyes.z, 40);
}

TEST(SentFace, AThinnedFaceKeepsItsFormAndItsMoves) {
    const EnrolledFace face = some_face();
    const std::size_t half = face.rest.vertex_count() / 2;
    const EnrolledFace thin = thinned(face, half);
    EXPECT_LE(thin.rest.vertex_count(), half);
    EXPECT_GT(thin.rest.vertex_count(), half / 2);
    EXPECT_EQ(thin.textures, face.textures);
    EXPECT_EQ(thin.rest.triangles.size(), thin.rest.part_sizes[0] + thin.rest.part_sizes[1] +
                                              thin.rest.part_sizes[2] + thin.rest.part_sizes[3] +
                                              thin.rest.part_sizes[4] + thin.rest.part_sizes[5]);
    // Each vertex is one that was there, with its place in the texture and its moves.
    for (std::size_t i = 0; i < thin.rest.vertex_count(); ++i) {
        bool found = false;
        for (std::size_t k = 0; k < face.rest.vertex_count() && !found; ++k) {
            const auto same = [&](const std::vector<float>& a, const std::vector<float>& b,
                                  std::size_t n) {
                return std::equal(a.begin() + std::ptrdiff_t(n * i),
                                  a.begin() + std::ptrdiff_t(n * (i + 1)),
                                  b.begin() + std::ptrdiff_t(n * k));
            };
            found = same(thin.rest.points, face.rest.points, 3) &&
                    same(thin.rest.places, face.rest.places, 2) &&
                    same(thin.moves[2], face.moves[2], 3);
        }
        ASSERT_TRUE(found) << i;
    }
    // Vertices that are left out lay near others.
    EXPECT_LT(farthest(face.rest.points, thin.rest.points), 15);
    // Nothing to do, and as little as borders leave.
    EXPECT_EQ(thinned(face, 100'000).rest.vertex_count(), face.rest.vertex_count());
    const EnrolledFace least = thinned(face, 1);
    EXPECT_GT(least.rest.triangles.size(), 0U);
    const auto read = parse_sent_face(enrolled_bytes(least));
    ASSERT_TRUE(read);
    EXPECT_EQ(read->rest.triangles, least.rest.triangles);
}

TEST(SentFace, ShouldersAreLeftOut) {
    EnrolledFace face = some_face();
    const std::size_t before = face.rest.triangles.size();
    EXPECT_EQ(without_shoulders(face).rest.triangles.size(), before);
    const std::uint32_t corner = face.rest.triangles[5][0];
    face.rest.points[3 * std::size_t(corner) + 1] -= 500;
    const EnrolledFace cut = without_shoulders(face);
    EXPECT_LT(cut.rest.triangles.size(), before);
    EXPECT_GT(cut.rest.triangles.size(), before - 20);
    EXPECT_EQ(cut.rest.vertex_count(), face.rest.vertex_count() - 1);
}

TEST(SentFace, MoreThanASessionTakesIsRefused) {
    EnrolledFace face = some_face();
    EXPECT_TRUE(parse_sent_face(enrolled_bytes(face)));
    face.rest.triangles.resize(max_sent_triangles + 1, face.rest.triangles[0]);
    face.rest.part_sizes = {std::uint32_t(face.rest.triangles.size())};
    EXPECT_EQ(parse_sent_face(enrolled_bytes(face)).error(), Status::too_large);
}

}  // namespace
}  // namespace theatron::face
