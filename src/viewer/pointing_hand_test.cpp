// SPDX-License-Identifier: Apache-2.0
#include "viewer/pointing_hand.h"

#include <gtest/gtest.h>

#include <cmath>
#include <tuple>
#include <utility>

namespace theatron::viewer {
namespace {

// An eye at the origin of the room that looks along z, 90 degrees wide; y is down.
class PointingHand : public ::testing::Test {
protected:
    PointingHand() { std::tie(view.left, view.right, view.top, view.bottom) = sides; }

    // A wall at 2 m. `before`: what a ray meets nearer than it.
    MetPlace wall(MetPlace before = {}) const {
        return [before = std::move(before)](const render::PickRay& ray) -> std::optional<Vec3> {
            if (before)
                if (const auto place = before(ray))
                    return place;
            const double t = (2 - ray.from.z) / ray.direction.z;
            return t > 0 ? std::optional(ray.from + ray.direction * t) : std::nullopt;
        };
    }
    std::optional<Vec3> pointed(const MetPlace& met) const {
        return pointed_place([&](Vec2 at) { return render::ray_through(view, at); }, 4.0 / 3,
                             {0.5, 0.5}, met);
    }
    static bool passes(const render::PickRay& ray, Vec3 place) {
        const Vec3 to = place - ray.from;
        return length(cross(to, normalized(ray.direction))) < 1e-9 && dot(to, ray.direction) > 0;
    }

    const std::tuple<double, double, double, double> sides{-1, 1, -0.75, 0.75};
    render::CameraView view;
};

// The far side of a plate at z 1 m whose edge is at x: it hides what is right of the edge.
MetPlace plate_right_of(double x) {
    return [x](const render::PickRay& ray) -> std::optional<Vec3> {
        const Vec3 at = ray.from + ray.direction * ((1 - ray.from.z) / ray.direction.z);
        return ray.from.z < 1 && at.x > x ? std::optional(at) : std::nullopt;
    };
}

TEST_F(PointingHand, TheHandIsBesideTheEyeWhereNothingIsBetween) {
    const render::PickRay ray = pointing_ray(view, {0.5, 0.5}, wall());
    EXPECT_NEAR(length(ray.from - Vec3{0.15, 0.25, 0.2}), 0, 1e-12);
    EXPECT_TRUE(passes(ray, {0, 0, 2}));
    EXPECT_NEAR(length(ray.direction), 1, 1e-12);
}

TEST_F(PointingHand, WhatIsBeforeTheHandAloneBringsItNearerToTheEye) {
    // The ray from the eye passes left of the plate, that of the hand at the side does not.
    const MetPlace met = wall(plate_right_of(0.03));
    const render::PickRay ray = pointing_ray(view, {0.5, 0.5}, met);
    EXPECT_TRUE(passes(ray, {0, 0, 2}));
    EXPECT_LT(ray.from.x, 0.06);
    EXPECT_GT(ray.from.x, 0);
    EXPECT_NEAR(length(*met(ray) - Vec3{0, 0, 2}), 0, 1e-9);
}

TEST_F(PointingHand, BehindANarrowGapTheHandIsOnTheEyesRay) {
    const MetPlace met = wall(plate_right_of(0.0001));
    const render::PickRay ray = pointing_ray(view, {0.5, 0.5}, met);
    EXPECT_NEAR(ray.from.x, 0, 1e-12);
    EXPECT_NEAR(ray.from.z, 1.4, 1e-12);
    EXPECT_NEAR(length(*met(ray) - Vec3{0, 0, 2}), 0, 1e-9);
}

TEST_F(PointingHand, AGapOfTheSurfaceIsClosedAndALargerOneIsNot) {
    // The wall was not measured within `radius` of the middle of the picture.
    const auto with_hole = [&](double radius) {
        return MetPlace([radius](const render::PickRay& ray) -> std::optional<Vec3> {
            const Vec3 at = ray.from + ray.direction * ((2 - ray.from.z) / ray.direction.z);
            return std::hypot(at.x, at.y) < radius ? std::nullopt : std::optional(at);
        });
    };
    // 1 % of the picture's height is 0.03 m on the wall.
    const auto closed = pointed(with_hole(0.029));
    ASSERT_TRUE(closed);
    EXPECT_LT(std::hypot(closed->x, closed->y), 0.0301);
    EXPECT_FALSE(pointed(with_hole(0.031)));
    const render::PickRay ray = pointing_ray(view, {0.5, 0.5}, with_hole(0.029));
    EXPECT_TRUE(with_hole(0.029)(ray)) << "the others find a place, too";
}

TEST_F(PointingHand, BesideAnEdgeThePlaceIsOnTheNearerSurfaceAndNotAtTheEdge) {
    // A plate at 1 m that begins right of the middle, and nothing behind it.
    const MetPlace met = plate_right_of(0.004);
    const auto place = pointed(met);
    ASSERT_TRUE(place);
    EXPECT_NEAR(place->z, 1, 1e-9);
    EXPECT_GT(place->x, 0.005);
    EXPECT_LT(place->x, 0.0151);
}

TEST_F(PointingHand, ARayIntoTheFreeMeetsNothing) {
    // Below and right of the eye is a thing that the hand's ray would meet.
    const MetPlace met = plate_right_of(0.05);
    const render::PickRay ray = pointing_ray(view, {0.5, 0.5}, met);
    EXPECT_FALSE(met(ray));
    EXPECT_TRUE(passes(ray, {0, 0, 3}));
}

TEST_F(PointingHand, TheHandPointsAlongTheRay) {
    for (const Vec3 direction : {Vec3{0.6, 0, 0.8}, Vec3{0, -1, 0}, Vec3{0, 1, 0}}) {
        const Pose hand = hand_on({{1, 2, 3}, direction});
        EXPECT_NEAR(length(hand.translation - Vec3{1, 2, 3}), 0, 1e-12);
        EXPECT_NEAR(length(rotate(hand.rotation, {0, 0, -1}) - direction), 0, 1e-9);
    }
}

}  // namespace
}  // namespace theatron::viewer
