// SPDX-License-Identifier: Apache-2.0
#include "window/navigation.h"

#include <gtest/gtest.h>

namespace theatron::window {
namespace {

// Two metres before the pivot, looking along -z of the room, one metre up.
const Viewpoint start{look_at({0, 1, 2}, {0, 1, 0}, {0, 1, 0}), {0, 1, 0}};

Vec3 eye(const Viewpoint& v) {
    return v.room_from_eye.translation;
}
// A point of the room as the eye has it: x right, y down, z forward.
Vec3 seen(const Viewpoint& v, Vec3 point) {
    return inverse(v.room_from_eye) * point;
}
double up(const Viewpoint& v) {
    return -rotate(v.room_from_eye.rotation, {0, 1, 0}).y;
}
Viewpoint after(const Steering& steering, Duration elapsed = 100ms) {
    return steered(start, steering, 1.0, elapsed);
}

void expect_near(Vec3 a, Vec3 b) {
    EXPECT_NEAR(a.x, b.x, 1e-9);
    EXPECT_NEAR(a.y, b.y, 1e-9);
    EXPECT_NEAR(a.z, b.z, 1e-9);
}

TEST(Navigation, NothingMovesWithoutInput) {
    EXPECT_FALSE(Steering{}.moves());
    EXPECT_EQ(after({}), start);
}

TEST(Navigation, TurningKeepsThePivotWhereItIsInThePicture) {
    const Viewpoint to = after({.turn = {0.3, 0.1}});
    expect_near(seen(to, to.pivot), seen(start, start.pivot));
    expect_near(to.pivot, start.pivot);
    EXPECT_GT(length(eye(to) - eye(start)), 0.5);
}

TEST(Navigation, TheSceneFollowsTheMouseWhenTurning) {
    const Vec3 in_front{0, 1, 0.5};  // nearer than the pivot
    EXPECT_GT(seen(after({.turn = {0.1, 0}}), in_front).x, 0.05);
    EXPECT_GT(seen(after({.turn = {0, 0.1}}), in_front).y, 0.05);
}

TEST(Navigation, TurnsAroundWhatWasGrabbed) {
    const Viewpoint grabbed = around(start, {0.3, -0.2}, 1.5);
    EXPECT_EQ(grabbed.room_from_eye, start.room_from_eye);
    expect_near(seen(grabbed, grabbed.pivot), {0.45, -0.3, 1.5});
    const Viewpoint to = steered(grabbed, {.turn = {0.2, 0.1}}, 1.0, 16ms);
    expect_near(seen(to, grabbed.pivot), {0.45, -0.3, 1.5});
}

TEST(Navigation, TurningNeverEndsUpsideDown) {
    for (const double way : {0.02, -0.02, 0.3, -0.3}) {
        Viewpoint v = start;
        for (int i = 0; i < 200; ++i) {
            v = steered(v, {.turn = {0.01, way}}, 1.0, 16ms);
            ASSERT_GT(up(v), 0) << way << " after " << i;
        }
        // And it comes back from there.
        EXPECT_GT(up(steered(v, {.turn = {0, -way}}, 1.0, 16ms)), up(v));
    }
}

TEST(Navigation, ACameraThatHangsUpsideDownCanBeTurnedUpright) {
    Viewpoint v = start;
    v.room_from_eye.rotation = v.room_from_eye.rotation * rotation_about({1, 0, 0}, 1.8);
    v.pivot = v.room_from_eye * Vec3{0, 0, 2};
    ASSERT_LT(up(v), 0);
    const double better = up(steered(v, {.turn = {0, 0.1}}, 1.0, 16ms));
    const double other = up(steered(v, {.turn = {0, -0.1}}, 1.0, 16ms));
    EXPECT_GT(std::max(better, other), up(v) + 0.1);
    EXPECT_NEAR(std::min(better, other), up(v), 1e-9);
}

TEST(Navigation, SlidingKeepsThePivotUnderTheMouse) {
    const double view_height = 1.2;
    const Viewpoint to = steered(start, {.slide = {0.25, -0.1}}, view_height, 16ms);
    const Vec3 old_pivot = seen(to, start.pivot);
    EXPECT_NEAR(old_pivot.x / old_pivot.z, 0.25 * view_height, 1e-9);
    EXPECT_NEAR(old_pivot.y / old_pivot.z, -0.1 * view_height, 1e-9);
    expect_near(to.pivot - start.pivot, eye(to) - eye(start));
}

TEST(Navigation, TheWheelComesCloserButNeverThrough) {
    EXPECT_NEAR(length(eye(after({.approach = 1})) - start.pivot), 2 * 0.88, 1e-9);
    expect_near(eye(steered(after({.approach = 3}), {.approach = -3}, 1.0, 16ms)), eye(start));
    const Viewpoint close = after({.approach = 1000});
    EXPECT_NEAR(length(eye(close) - start.pivot), 0.15, 1e-9);
    EXPECT_GT(seen(close, close.pivot).z, 0);
    // From there it goes away again.
    EXPECT_GT(length(eye(steered(close, {.approach = -1}, 1.0, 16ms)) - start.pivot), 0.16);
}

TEST(Navigation, TheWheelNeverPushesAwayWhoFlewClose) {
    Viewpoint v = start;
    v.pivot = {0, 1, 1.95};
    EXPECT_EQ(steered(v, {.approach = 2}, 1.0, 16ms), v);
}

TEST(Navigation, FlyingGoesWhereTheKeysSayForAsLongAsTheyAreHeld) {
    expect_near(eye(after({.fly = {0, 0, 1}})) - eye(start), {0, 0, -0.1});
    expect_near(eye(after({.fly = {1, 0, 0}})) - eye(start), {0.1, 0, 0});
    expect_near(eye(after({.fly = {0, 1, 0}})) - eye(start), {0, 0.1, 0});
    expect_near(eye(after({.fly = {0, 0, 1}}, 200ms)) - eye(start), {0, 0, -0.2});
    expect_near(eye(after({.fly = {0, 0, 1}, .fast = true})) - eye(start), {0, 0, -0.3});
    EXPECT_EQ(after({.fly = {0, 0, 1}}).room_from_eye.rotation, start.room_from_eye.rotation);
}

TEST(Navigation, ASlowPictureDoesNotThrowTheEyeAway) {
    EXPECT_LT(length(eye(after({.fly = {0, 0, 1}}, 60s)) - eye(start)), 0.3);
}

TEST(Navigation, UpAndDownAreTheRoomsWhereverTheEyeLooks) {
    const Viewpoint down = steered(start, {.turn = {0.2, 0.4}}, 1.0, 16ms);
    expect_near(eye(steered(down, {.fly = {0, -1, 0}}, 1.0, 100ms)) - eye(down), {0, -0.1, 0});
}

}  // namespace
}  // namespace theatron::window
