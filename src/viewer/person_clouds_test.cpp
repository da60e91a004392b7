// SPDX-License-Identifier: Apache-2.0
#include "viewer/person_clouds.h"

#include <gtest/gtest.h>

namespace theatron::viewer {
namespace {

Pose head(Vec3 place, Vec3 looks_at) {
    return look_at(place, looks_at, {0, 1, 0}) * Pose{Quat{0, 1, 0, 0}, {}};
}

TEST(RoomFromPerson, IsUprightAndTurnedLikeTheHead) {
    for (const double down : {0.0, -0.5, -1.4}) {
        const Pose place = room_from_person(head({1, 1.6, 2}, Vec3{1, 1.6, 2} + Vec3{-1, down, 0}));
        EXPECT_EQ(place.translation, (Vec3{1, 1.6, 2}));
        EXPECT_LT(length(rotate(place.rotation, {0, 1, 0}) - Vec3{0, 1, 0}), 1e-9);
        EXPECT_LT(length(rotate(place.rotation, {0, 0, -1}) - Vec3{-1, 0, 0}), 1e-6);
    }
}

TEST(RoomFromPerson, KeepsItsDirectionWhenTheHeadLooksStraightDownOrUp) {
    for (const double up : {-8.0, 8.0}) {
        const Pose place = room_from_person(head({0, 1.6, 0}, {0, 1.6 + up, -1}));
        EXPECT_LT(length(rotate(place.rotation, {0, 0, -1}) - Vec3{0, 0, -1}), 1e-6) << up;
    }
}

}  // namespace
}  // namespace theatron::viewer
