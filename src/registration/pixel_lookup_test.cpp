// SPDX-License-Identifier: Apache-2.0
#include "registration/pixel_lookup.h"

#include <gtest/gtest.h>

#include "registration/modelled_camera_test.h"

namespace theatron::registration {
namespace {

TEST(PixelLookup, AgreesWithTheLensToATenthOfAPixel) {
    CameraModel camera = azure_camera();
    camera.k = {0.5, -2.6, 1.5, 0.4, -2.4, 1.4};  // an Azure Kinect's colour camera, strongly bent
    camera.max_radius = 0.9;
    const Image<Ray> rays = make_ray_table(camera);
    const PixelLookup lookup(camera, rays);
    int compared = 0;
    for (int y = 0; y < camera.size.height; y += 7)
        for (int x = 0; x < camera.size.width; x += 7) {
            const Ray ray = rays.view().row(y)[x];
            if (ray.x == no_ray)
                continue;
            const PixelLookup::Pixel pixel = lookup.at(ray.x, ray.y);
            EXPECT_NEAR(pixel.x, x, 0.1) << x << " " << y;
            EXPECT_NEAR(pixel.y, y, 0.1) << x << " " << y;
            ++compared;
        }
    EXPECT_GT(compared, 1000);
}

TEST(PixelLookup, SeesNothingInDirectionsOutsideOfThePicture) {
    const CameraModel camera = azure_camera();
    const PixelLookup lookup(camera, make_ray_table(camera));
    for (const Ray ray : {Ray{5, 0}, Ray{0, -5}, Ray{std::nanf(""), 0}, Ray{0, no_ray}})
        EXPECT_LT(lookup.at(ray.x, ray.y).x, 0);

    Image<Ray> blind(camera.size);
    for (Ray& ray : blind.pixels)
        ray = {no_ray, no_ray};
    EXPECT_LT(PixelLookup(camera, blind).at(0, 0).x, 0);
}

}  // namespace
}  // namespace theatron::registration
