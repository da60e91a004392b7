// SPDX-License-Identifier: Apache-2.0
#include "publish/own_camera.h"

#include <gtest/gtest.h>

#include "capture/camera.h"
#include "image/image.h"
#include "testing/shared_data.h"

namespace theatron::publish {
namespace {

// Depth in millimetres of a ball for a head and a block for a trunk, in front of a wall.
DepthImage person_picture(const CameraModel& lens, Vec3 eyes) {
    DepthImage depth(lens.size);
    for (int y = 0; y < lens.size.height; ++y)
        for (int x = 0; x < lens.size.width; ++x) {
            const Vec2 ray = unproject(lens, {double(x), double(y)}).value();
            double z = 3.0;
            const Vec3 middle = eyes + Vec3{0, 0, 0.09};
            const Vec3 along = normalized(Vec3{ray.x, ray.y, 1});
            const double near = dot(middle, along);
            const double off = length(middle - along * near);
            if (off < 0.11)
                z = (along * (near - std::sqrt(0.11 * 0.11 - off * off))).z;
            const double trunk_z = eyes.z + 0.05;
            const Vec3 on_trunk = Vec3{ray.x, ray.y, 1} * trunk_z;
            if (z > 2.9 && std::abs(on_trunk.x - eyes.x) < 0.22 && on_trunk.y > eyes.y + 0.2)
                z = trunk_z;
            depth.view().row(y)[x] = std::uint16_t(z * 1000);
        }
    return depth;
}

Calibration desk_camera() {
    Calibration calibration;
    calibration.depth = pinhole({320, 240}, 75);
    return calibration;
}

TEST(OwnCamera, FindsTheEyesOfAPersonBeforeAWall) {
    const Calibration calibration = desk_camera();
    for (const Vec3 eyes : {Vec3{0, 0, 0.7}, Vec3{0.15, -0.08, 0.9}, Vec3{-0.1, 0.05, 1.2}}) {
        const DepthImage depth = person_picture(calibration.depth, eyes);
        const auto found = find_eyes(depth.view(), calibration);
        ASSERT_TRUE(found);
        EXPECT_TRUE(found->of_head);
        const Vec3 at = found->middle;
        EXPECT_LT(length(at - eyes), 0.05) << at.x << " " << at.y << " " << at.z;
    }
}

TEST(OwnCamera, ADeskBetweenTheCameraAndThePersonIsNotTakenForThePerson) {
    const Calibration calibration = desk_camera();
    const Vec3 eyes{0.05, -0.05, 0.9};
    DepthImage depth = person_picture(calibration.depth, eyes);
    // A screen and its stand fill the lower right part of the picture, 40 cm away.
    for (int y = 150; y < 240; ++y)
        for (int x = 170; x < 320; ++x)
            depth.view().row(y)[x] = 400;
    const auto found = find_eyes(depth.view(), calibration);
    ASSERT_TRUE(found);
    EXPECT_TRUE(found->of_head);
    EXPECT_LT(length(found->middle - eyes), 0.05);
}

// Where the face is in the first picture was read by eye.
TEST(OwnCamera, FindsTheFacesOfRealPeople) {
    struct Case {
        const char* sequence;
        double left, top, right, bottom;
    };
    for (const Case& c : {Case{"turning-person_640x480", 280, 90, 370, 190},
                          Case{"azure-nfov-2x2-pair-person_320x288", 105, 15, 140, 55}}) {
        SCOPED_TRACE(c.sequence);
        THEATRON_REQUIRE_DATA(c.sequence);
        const auto camera =
            capture::open_camera("folder:" + (testing::shared_data() / c.sequence).string());
        const capture::Capture first = camera->next(1s);
        ASSERT_EQ(first.kind, capture::Capture::Kind::frame);
        const CameraModel& lens = camera->info().calibration.depth;
        const auto eyes = find_eyes(first.frame->depth.view(), camera->info().calibration);
        ASSERT_TRUE(eyes);
        EXPECT_TRUE(eyes->of_head);
        const Vec2 pixel = project(lens, eyes->middle).value();
        EXPECT_TRUE(pixel.x > c.left && pixel.x < c.right) << pixel.x;
        EXPECT_TRUE(pixel.y > c.top && pixel.y < c.bottom) << pixel.y;
    }
}

// A person who bends over so that no head stands free.
TEST(OwnCamera, WithoutAHeadTheNearestSurfaceIsThePerson) {
    const Calibration calibration = desk_camera();
    DepthImage depth(calibration.depth.size);
    for (int y = 0; y < 240; ++y)
        for (int x = 0; x < 320; ++x)
            depth.view().row(y)[x] = x > 100 && x < 220 && y > 60 ? 1000 : 3000;
    const auto found = find_eyes(depth.view(), calibration);
    ASSERT_TRUE(found);
    EXPECT_FALSE(found->of_head);
    EXPECT_NEAR(found->middle.z, 1, 0.1);
}

TEST(OwnCamera, APictureWithoutAPersonHasNoEyes) {
    const Calibration calibration = desk_camera();
    DepthImage wall(calibration.depth.size);
    for (auto& pixel : wall.pixels)
        pixel = 3000;
    EXPECT_FALSE(find_eyes(wall.view(), calibration));
    DepthImage nothing(calibration.depth.size);
    EXPECT_FALSE(find_eyes(nothing.view(), calibration));
}

TEST(OwnCamera, ThePersonFacesTheCamera) {
    const Calibration calibration = desk_camera();
    const Vec3 eyes{0.2, -0.1, 0.8};
    const Pose person = person_from_camera(calibration, eyes);
    EXPECT_LT(length(person * eyes), 1e-9);
    // The camera is ahead (-z) and lower than the eyes, which are above the image's middle.
    EXPECT_NEAR(person.translation.x, 0, 1e-9);
    EXPECT_LT(person.translation.z, -0.7);
    EXPECT_NEAR(person.translation.y, -0.1, 1e-9);
    // A point on the camera's right is on the person's left.
    EXPECT_LT((person * (eyes + Vec3{0.3, 0, 0})).x, -0.2);
}

TEST(OwnCamera, WithoutEyesThePersonIsBeforeTheCamera) {
    const Pose person = person_from_camera(desk_camera(), std::nullopt);
    EXPECT_NEAR(person.translation.z, -usual_eye_distance_m, 1e-9);
}

}  // namespace
}  // namespace theatron::publish
