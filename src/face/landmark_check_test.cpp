// SPDX-License-Identifier: Apache-2.0
#include "face/landmark_check.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "face/expression.h"
#include "face/random.h"

namespace theatron::face {
namespace {

constexpr Size photo{640, 480};
constexpr Vec2 middle{320, 240};

class LandmarkCheckTest : public testing::Test {
protected:
    static const MorphModel& model() {
        static const MorphModel made = generated_head();
        return made;
    }
    static const Landmarks& usual() {
        static const Landmarks made = usual_landmarks(model(), Emotion::neutral);
        return made;
    }
    static std::optional<LandmarkFault> fault(const Landmarks& landmarks) {
        return landmark_fault(landmarks, usual(), photo);
    }
    // The face of a person, 200 px wide, changed by `place` about the photo's middle.
    template <class Place>
    static Landmarks seen(Place place) {
        Landmarks landmarks = usual();
        for (Vec2& point : landmarks) {
            const Vec2 at = place(Vec2{1.4 * point.x, 1.4 * point.y});
            point = {middle.x + at.x, middle.y + at.y};
        }
        return landmarks;
    }
    static Landmarks turned(double degrees) {
        const double angle = degrees / 57.29577951, c = std::cos(angle), s = std::sin(angle);
        return seen([&](Vec2 p) { return Vec2{c * p.x - s * p.y, s * p.x + c * p.y}; });
    }
};

TEST_F(LandmarkCheckTest, FacesOfManyPersonsFromManySidesAreFaces) {
    double worst = 0;
    Random random(1);
    for (int person = 0; person < 20; ++person) {
        std::vector<float> identity(model().identities.size());
        for (float& share : identity)
            share = float(random.normal());
        for (std::size_t emotion = 0; emotion < emotion_count; ++emotion) {
            const Pose turn{rotation_about({0, 1, 0}, random.between(-0.6, 0.6)) *
                                rotation_about({1, 0, 0}, random.between(-0.35, 0.35)) *
                                rotation_about({0, 0, 1}, random.between(-0.5, 0.5)),
                            {}};
            Landmarks landmarks;
            for (std::size_t i = 0; i < landmark_count; ++i) {
                const Vec3 at =
                    turn * blended_vertex(model(), identity, channels_of(Emotion(emotion)),
                                          model().landmarks[i]);
                landmarks[i] = {middle.x + 1.4 * at.x, middle.y - 1.4 * at.y};
            }
            EXPECT_EQ(fault(landmarks), std::nullopt) << person << " " << emotion;
            worst = std::max(worst, unusual_share(landmarks, usual()));
        }
    }
    EXPECT_LT(worst, most_unusual / 2);
}

TEST_F(LandmarkCheckTest, WhereAndHowTheFaceStands) {
    EXPECT_EQ(fault(turned(0)), std::nullopt);
    EXPECT_EQ(fault(turned(90)), std::nullopt) << "a person who lies";
    EXPECT_EQ(fault(turned(180)), LandmarkFault::upside_down);
    EXPECT_EQ(fault(seen([](Vec2 p) { return Vec2{-p.x, p.y}; })), LandmarkFault::exchanged);
    EXPECT_EQ(fault(seen([](Vec2 p) { return Vec2{p.x, -p.y}; })), LandmarkFault::exchanged);
    EXPECT_EQ(fault(seen([](Vec2 p) {
                  return Vec2{0.05 * p.x, 0.05 * p.y};
              })),
              LandmarkFault::too_small);
    EXPECT_EQ(fault(seen([](Vec2 p) { return Vec2{p.x + 300, p.y}; })), LandmarkFault::outside);
    // Those of a photo of twice the size.
    EXPECT_EQ(fault(seen([](Vec2 p) {
                  return Vec2{2 * p.x + 320, 2 * p.y + 240};
              })),
              LandmarkFault::outside);
}

TEST_F(LandmarkCheckTest, WhatIsNoFaceIsNone) {
    Landmarks one_place, line, noise;
    Random random(2);
    for (std::size_t i = 0; i < landmark_count; ++i) {
        one_place[i] = middle;
        line[i] = {100 + 5.0 * double(i), 200};
        noise[i] = {random.between(0, 640), random.between(0, 480)};
    }
    for (const Landmarks& landmarks : {one_place, line, noise})
        EXPECT_EQ(fault(landmarks), LandmarkFault::no_face);
    Landmarks shuffled = turned(0);
    std::rotate(shuffled.begin(), shuffled.begin() + 20, shuffled.end());
    EXPECT_EQ(fault(shuffled), LandmarkFault::no_face);
    Landmarks no_number = turned(0);
    no_number[5].x = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(fault(no_number), LandmarkFault::outside);
}

}  // namespace
}  // namespace theatron::face
