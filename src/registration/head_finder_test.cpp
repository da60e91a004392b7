// SPDX-License-Identifier: Apache-2.0
#include "registration/head_finder.h"

#include <gtest/gtest.h>

#include "registration/modelled_camera_test.h"
#include "registration/room_view_test.h"

namespace theatron::registration {
namespace {

// How far along a ray an ellipsoid is met; 0: it is missed.
double hit(Vec3 ray, Vec3 middle, Vec3 radii, const Pose& turned) {
    const Quat back = conjugate(turned.rotation);
    const Vec3 o = rotate(back, -middle), d = rotate(back, ray);
    const Vec3 os{o.x / radii.x, o.y / radii.y, o.z / radii.z},
        ds{d.x / radii.x, d.y / radii.y, d.z / radii.z};
    const double a = dot(ds, ds), b = dot(os, ds), c = dot(os, os) - 1;
    const double root = b * b - a * c;
    return root < 0 ? 0 : (-b - std::sqrt(root)) / a;
}

// A person of ellipsoids before a wall, turned about the vertical, through the modelled sensor.
DepthImage person(const SurfaceCamera& camera, Vec3 head, double yaw, std::uint32_t seed,
                  bool with_head = true) {
    const Pose turned{rotation_about({0, 1, 0}, yaw), {}};
    BoardScene scene(camera.model.size, 3.2);
    for (std::size_t i = 0; i < camera.rays.pixels.size(); ++i) {
        const Ray ray = camera.rays.pixels[i];
        if (ray.x == no_ray)
            continue;
        const Vec3 d{ray.x, ray.y, 1};
        double z = 3.2;
        const auto meet = [&](Vec3 middle, Vec3 radii) {
            if (const double t = hit(d, middle, radii, turned); t > 0)
                z = std::min(z, t);
        };
        if (with_head)
            meet(head, {0.08, 0.12, 0.1});
        meet(head + Vec3{0, 0.16, 0}, {0.055, 0.12, 0.055});
        meet(head + Vec3{0, 0.5, 0}, {0.24, 0.28, 0.12});
        scene.depth_m.pixels[i] = float(z);
    }
    synthetic::DepthSensor sensor(synthetic::nfov_unbinned(), camera.model.size, seed);
    return scene.seen_by(sensor, 1);
}

TEST(HeadFinder, APersonAtADeskIsFoundAndTheirShouldersTellTheDirection) {
    const SurfaceCamera camera(azure_camera(), 1);
    std::uint32_t seed = 5;
    for (const double distance : {0.7, 1.2, 2.0})
        for (const double yaw : {-0.5, 0.0, 0.4}) {
            SCOPED_TRACE(::testing::Message() << distance << " m, " << yaw);
            const Vec3 truth{0.12, -0.1, distance};
            const DepthImage image = person(camera, truth, yaw, ++seed);
            const auto head = find_head(camera, image.view());
            ASSERT_TRUE(head);
            EXPECT_LT(length(head->middle - truth), 0.025);
            EXPECT_LT(length(head->middle - truth), 3 * head->middle_m);
            // Ahead is towards the camera, turned as the body is.
            const Vec3 ahead = rotate(head->camera_from_head.rotation, {0, 0, 1});
            const Vec3 expected = rotate(rotation_about({0, 1, 0}, yaw), {0, 0, -1});
            EXPECT_GT(dot(ahead, expected), std::cos(0.3));
            EXPECT_GT(rotate(head->camera_from_head.rotation, {0, 1, 0}).y, 0.99);
        }
}

TEST(HeadFinder, NoHeadIsFoundInABodyWithoutOneNorBeforeAWall) {
    const SurfaceCamera camera(azure_camera(), 1);
    const DepthImage body = person(camera, {0, -0.1, 1.2}, 0, 1, false);
    EXPECT_FALSE(find_head(camera, body.view()));
    const DepthImage nothing(camera.model.size);
    EXPECT_FALSE(find_head(camera, nothing.view()));
}

TEST(HeadFinder, TheCameraIsPlacedFromTheHeadsPlaceInTheRoom) {
    FoundHead head;
    head.camera_from_head = {rotation_about({0, 1, 0}, 2.5), {0.1, -0.2, 1}};
    const Pose room_from_head = look_at({1, 1.6, 2}, {1, 1.6, 0}, {0, 1, 0});
    const Pose camera = room_from_camera(room_from_head, head);
    EXPECT_LT(length(camera * head.camera_from_head.translation - room_from_head.translation),
              1e-12);
}

// The generated team with caps and masks, among lamps, table and drapes.
TEST(HeadFinder, PeopleOfTheOperatingRoomAreFoundAndNothingElse) {
    for (int index = 0; index < 3; ++index) {
        SCOPED_TRACE(index);
        const Calibration calibration =
            synthetic::synthetic_camera(synthetic::Variant::surgeon, index, 3, {});
        const SurfaceCamera camera(calibration.depth, 1);
        const auto view = room_with_team().look_from(
            calibration, {.depth = true, .surface = true, .color = false});
        const synthetic::GroundTruth truth = view->render(*room_with_team().at(1s));
        synthetic::DepthSensor sensor(synthetic::nfov_unbinned(), camera.model.size, 9);
        const DepthImage image = scene_of(truth, camera.rays).seen_by(sensor, 1);
        const Vec3 up = rotate(conjugate(calibration.room_from_camera.rotation), {0, 1, 0});
        const auto head = find_head(camera, image.view(), up);
        ASSERT_TRUE(head);
        // Cap and mask around it.
        Vec3 mean{};
        int count = 0;
        for (std::size_t i = 0; i < truth.surface.pixels.size(); ++i) {
            const auto material = truth.surface.pixels[i].material;
            const double z = truth.depth_m.pixels[i];
            const Vec3 p{camera.rays.pixels[i].x * z, camera.rays.pixels[i].y * z, z};
            if ((material == synthetic::Material::cap || material == synthetic::Material::mask) &&
                length(p - head->middle) < 0.2) {
                mean = mean + p;
                ++count;
            }
        }
        EXPECT_GT(count, 1000);
        // The visible side lies some centimetres before the middle.
        EXPECT_LT(length(head->middle - mean * (1.0 / count)), 0.09);
    }
}

}  // namespace
}  // namespace theatron::registration
