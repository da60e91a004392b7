// SPDX-License-Identifier: Apache-2.0
#include "room/own_head.h"

#include <gtest/gtest.h>

#include <cmath>

#include "face/morph_model.h"

namespace theatron::room {
namespace {

using face::Emotion;

ColorImage plain(Rgb color) {
    ColorImage image(Size{8, 8});
    std::fill(image.pixels.begin(), image.pixels.end(), color);
    return image;
}

OwnHead some_head() {
    OwnHead::Textures textures;
    textures[std::size_t(Emotion::neutral)] = plain({100, 100, 100});
    textures[std::size_t(Emotion::happiness)] = plain({200, 0, 100});
    return {face::enrolled_person(face::generated_head(), {}), std::move(textures)};
}

ShownFace showing(Emotion emotion, float weight) {
    ShownFace shown;
    shown.emotions[std::size_t(emotion)] = weight;
    shown.emotions[std::size_t(Emotion::neutral)] += 1 - weight;
    return shown;
}

TEST(OwnHead, IsWhereTheBustHasItsFace) {
    const OwnHead head = some_head();
    EXPECT_FALSE(head.is_whole());  // the generated head is a face alone
    EXPECT_NEAR(head.cap().scale, 1, 0.25);
    // The back is as wide as the face's edges, which the mean person shares with the usual bust.
    double widest = 0;
    for (const auto& v : head.back().vertices)
        widest = std::max(widest, double(v.px));
    EXPECT_NEAR(widest, 0.07, 0.006);
    EXPECT_EQ(head.neck().scale, 1);
    // Above the brows, and not far from where it is on the usual bust.
    EXPECT_NEAR(head.cap().place.translation.y, 0.02, 0.01);
    EXPECT_NEAR(head.cap().place.translation.z, 0, 0.02);
    const auto meshes = head.meshes({});
    const render::MeshData& skin = meshes[0];
    ASSERT_FALSE(skin.indices.empty());
    double front = 0, low = 0, high = 0, side = 0;
    for (const auto& v : skin.vertices) {
        EXPECT_NEAR(std::hypot(v.nx, v.ny, v.nz), 1, 1e-3);
        front = std::min(front, double(v.pz));
        low = std::min(low, double(v.py));
        high = std::max(high, double(v.py));
        side += v.px;
    }
    // The nose is before the pupils (74 mm), the chin below them, the brow below the cap.
    EXPECT_LT(front, -0.078);
    EXPECT_GT(front, -0.13);
    EXPECT_LT(low, -0.09);
    EXPECT_GT(high, 0.045);
    EXPECT_NEAR(side / double(skin.vertices.size()), 0, 0.004);
    // The face looks along -z: its triangles are seen from there.
    int towards = 0;
    for (const auto& v : skin.vertices)
        towards += v.nz < 0 ? 1 : -1;
    EXPECT_GT(towards, 0);
}

TEST(OwnHead, TheNeckOfAWholeHeadGoesIntoTheCollar) {
    face::EnrolledFace face = face::enrolled_person(face::generated_head(), {});
    // As deep as a head with its back, and with a neck as wide as shoulders.
    for (std::size_t i = 0; i < face.rest.vertex_count(); ++i) {
        float* p = &face.rest.points[3 * i];
        p[0] *= p[1] < -80 ? 3 : 1;
        p[2] *= 2;
    }
    OwnHead::Textures textures;
    textures[std::size_t(Emotion::neutral)] = plain({100, 100, 100});
    const OwnHead head(face, std::move(textures));
    EXPECT_TRUE(head.is_whole());
    const auto meshes = head.meshes({});
    for (const auto& v : meshes[0].vertices)
        if (v.py < -0.1)
            EXPECT_LT(std::abs(v.px), 0.072);
    EXPECT_LT(head.neck_in_cloud().scale, head.neck().scale);
}

TEST(OwnHead, MovesWithWhatThePersonShows) {
    const OwnHead head = some_head();
    const auto rest = head.meshes({})[0].vertices;
    ShownFace open;
    open.direct.jaw_open = 1;
    const auto moved = head.meshes(open)[0].vertices;
    ASSERT_EQ(rest.size(), moved.size());
    double lowest = 0;
    for (std::size_t i = 0; i < rest.size(); ++i)
        lowest = std::min(lowest, double(moved[i].py - rest[i].py));
    EXPECT_LT(lowest, -0.005);
    EXPECT_TRUE(ShownFace{} == ShownFace{});
    EXPECT_FALSE(ShownFace{} == open);
}

TEST(OwnHead, ItsSkinIsBlendedFromThePicturesThatThereAre) {
    const OwnHead head = some_head();
    ColorImage out;
    const auto color_for = [&](Emotion emotion, float weight) {
        head.blend(head.shares(showing(emotion, weight).emotions), out);
        EXPECT_EQ(out.size, (Size{8, 8}));
        return out.pixels[9];
    };
    EXPECT_EQ(color_for(Emotion::neutral, 1), (Rgb{100, 100, 100}));
    EXPECT_EQ(color_for(Emotion::happiness, 1), (Rgb{200, 0, 100}));
    EXPECT_EQ(color_for(Emotion::happiness, 0.5F), (Rgb{150, 50, 100}));
    EXPECT_EQ(color_for(Emotion::anger, 1), (Rgb{100, 100, 100}));  // has none of its own
    // Small changes keep the picture.
    EXPECT_EQ(head.shares(showing(Emotion::happiness, 0.5F).emotions),
              head.shares(showing(Emotion::happiness, 0.51F).emotions));
    face::Emotions wild;
    wild.fill(std::nanf(""));
    EXPECT_EQ(head.shares(wild)[std::size_t(Emotion::neutral)], OwnHead::whole_share);
    wild.fill(1e30F);
    unsigned sum = 0;
    for (const std::uint16_t share : head.shares(wild))
        sum += share;
    EXPECT_EQ(sum, OwnHead::whole_share);
}

}  // namespace
}  // namespace theatron::room
