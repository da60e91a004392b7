// SPDX-License-Identifier: Apache-2.0
#include "room/bricks.h"

#include <gtest/gtest.h>

namespace theatron::room {
namespace {

constexpr double near_m = 1e-9;

void expect_same(const Pose& a, const Pose& b) {
    EXPECT_LT(length(a.translation - b.translation), near_m);
    for (const Vec3 axis : {Vec3{1, 0, 0}, Vec3{0, 1, 0}})
        EXPECT_LT(length(rotate(a.rotation, axis) - rotate(b.rotation, axis)), near_m);
}

Quat turned(double degrees) {
    return rotation_about({0, 1, 0}, radians_of(degrees));
}

TEST(Bricks, SnapOnTopAndUnderneath) {
    const Brick brick{4, 2, 0};
    const Pose lower{turned(30), {1, 0.8, -2}};
    for (const double y : {brick_height_m, -brick_height_m}) {
        const Pose fits = lower * Pose{{}, {0, y, 0}};
        const Pose released = fits * Pose{turned(5), {0.008, 0.004, -0.006}};
        expect_same(snapped(brick, released, {{brick, lower}}), fits);
    }
}

TEST(Bricks, SnapToTheNearestStudsAndCrosswise) {
    const Brick brick{4, 2, 0};
    const Pose lower;
    const Pose shifted{{}, {stud_pitch_m, brick_height_m, -stud_pitch_m}};
    expect_same(snapped(brick, shifted * Pose{turned(-4), {0.01, 0.003, 0.005}}, {{brick, lower}}),
                shifted);
    // Four studs lie across two: whole steps, since both are even.
    const Pose crosswise{turned(90), {0, brick_height_m, stud_pitch_m}};
    expect_same(
        snapped(brick, crosswise * Pose{turned(6), {0.005, 0.002, 0.004}}, {{brick, lower}}),
        crosswise);
    const Brick odd{3, 1, 0};
    const Pose half{{}, {0.5 * stud_pitch_m, brick_height_m, 0.5 * stud_pitch_m}};
    expect_same(snapped(odd, half * Pose{{}, {0.006, 0, 0.006}}, {{brick, lower}}), half);
}

TEST(Bricks, StayWhereTheyAreReleasedIfNothingFits) {
    const Brick brick{4, 2, 0};
    const Pose lower;
    for (const Pose& released :
         {Pose{{}, {0, 3 * brick_height_m, 0}},             // too high
          Pose{turned(30), {0, brick_height_m, 0}},         // turned too far
          Pose{{}, {4 * stud_pitch_m, brick_height_m, 0}},  // beside it
          Pose{rotation_about({1, 0, 0}, radians_of(180)), {0, 2 * brick_height_m, 0}}})
        EXPECT_EQ(snapped(brick, released, {{brick, lower}}), released);
    EXPECT_EQ(snapped(brick, lower, {}), lower);
}

TEST(Bricks, AreReadFromTheirPropertiesAlone) {
    const Brick brick{8, 1, 200};
    EXPECT_EQ(decode_brick(encode_brick(brick)), brick);
    EXPECT_FALSE(decode_brick({}));
    for (const Bytes& bytes :
         {Bytes{std::byte{0}, std::byte{1}, std::byte{0}}, Bytes{std::byte{9}, std::byte{1}, {}},
          Bytes{std::byte{1}, std::byte{1}, std::byte{1}, std::byte{1}}})
        EXPECT_FALSE(decode_brick(bytes));
}

TEST(Bricks, HaveAClosedOutlineWithStuds) {
    const render::MeshData mesh = make_brick_mesh({2, 1, 0});
    double low = 1, high = -1;
    for (const auto& v : mesh.vertices) {
        low = std::min(low, double(v.py));
        high = std::max(high, double(v.py));
        EXPECT_NEAR(length({v.nx, v.ny, v.nz}), 1, 1e-5);
        EXPECT_LE(std::abs(v.px), stud_pitch_m);
        EXPECT_LE(std::abs(v.pz), 0.5 * stud_pitch_m);
    }
    EXPECT_EQ(low, 0);
    EXPECT_GT(high, brick_height_m);
}

}  // namespace
}  // namespace theatron::room
