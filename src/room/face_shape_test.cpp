// SPDX-License-Identifier: Apache-2.0
#include "room/face_shape.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "face/expression.h"

namespace theatron::room {
namespace {

using face::Emotion;

face::Channels only(face::Channel channel, float value = 1) {
    face::Channels channels{};
    channels[channel] = value;
    return channels;
}

// Height from the lowest to the highest vertex in metres, of those on one side.
double height(const render::MeshData& mesh, bool is_left) {
    float low = 1, high = -1;
    for (const auto& v : mesh.vertices)
        if ((v.px < 0) == is_left) {
            low = std::min(low, v.py);
            high = std::max(high, v.py);
        }
    return high - low;
}

// The mean height of the vertices nearest to the corners of the mouth.
double corner_height(const render::MeshData& lips) {
    const auto right = std::max_element(lips.vertices.begin(), lips.vertices.end(),
                                        [](const auto& a, const auto& b) { return a.px < b.px; });
    return right->py;
}

double largest_difference(const render::MeshData& a, const render::MeshData& b) {
    double largest = 0;
    for (std::size_t i = 0; i < a.vertices.size(); ++i)
        largest = std::max(largest, double(std::abs(a.vertices[i].py - b.vertices[i].py)));
    return largest;
}

class FaceShapeTest : public ::testing::Test {
protected:
    FaceShape shape_;
    FaceMeshes rest_ = shape_.meshes({});
};

TEST_F(FaceShapeTest, IsInTheFrameOfTheHeadAndFacesForward) {
    for (const render::MeshData* mesh :
         {&rest_.skin, &rest_.whites, &rest_.dark, &rest_.lips, &rest_.mouth}) {
        ASSERT_FALSE(mesh->indices.empty());
        for (const std::uint32_t i : mesh->indices)
            ASSERT_LT(i, mesh->vertices.size());
        for (const auto& v : mesh->vertices) {
            ASSERT_LT(std::abs(v.px), 0.09);
            ASSERT_LT(std::abs(v.py), 0.15);
            ASSERT_LT(std::abs(v.pz), 0.13);
            ASSERT_NEAR(std::hypot(v.nx, std::hypot(v.ny, v.nz)), 1, 1e-4);
        }
    }
    for (const auto& v : rest_.whites.vertices)
        EXPECT_LT(v.pz, -0.04) << "the eyes are in front";
    for (const auto& v : rest_.lips.vertices)
        EXPECT_LT(v.nz, 0.3F);
}

TEST_F(FaceShapeTest, ALidClosesItsOwnEye) {
    const FaceMeshes wink = shape_.meshes(only(face::eye_blink_left));
    EXPECT_LT(height(wink.whites, true), 0.6 * height(rest_.whites, true));
    EXPECT_EQ(height(wink.whites, false), height(rest_.whites, false));
}

TEST_F(FaceShapeTest, TheJawOpensTheMouth) {
    EXPECT_GT(height(shape_.meshes(only(face::jaw_open)).mouth, true),
              height(rest_.mouth, true) + 0.006);
}

TEST_F(FaceShapeTest, CornersOfTheMouthRiseAndFallWithTheEmotion) {
    const auto corners = [&](Emotion emotion) {
        return corner_height(shape_.meshes(face::channels_of(emotion)).lips);
    };
    EXPECT_GT(corners(Emotion::happiness), corner_height(rest_.lips) + 0.004);
    EXPECT_LT(corners(Emotion::sadness), corner_height(rest_.lips) - 0.004);
}

TEST_F(FaceShapeTest, EachEmotionIsSeen) {
    for (const Emotion emotion : {Emotion::sadness, Emotion::disgust, Emotion::happiness,
                                  Emotion::surprise, Emotion::anger}) {
        const FaceMeshes shown = shape_.meshes(face::channels_of(emotion));
        EXPECT_GT(std::max({largest_difference(shown.skin, rest_.skin),
                            largest_difference(shown.lips, rest_.lips)}),
                  0.003)
            << to_text(emotion);
    }
}

}  // namespace
}  // namespace theatron::room
