// SPDX-License-Identifier: Apache-2.0
// Flat surfaces of about a given size in a depth image.
//
// On a plane, inverse depth is linear in the ray's direction: 1/z = q . (x, y, 1).
// The three numbers q describe the plane, need no normalisation, and are found by
// linear least squares; the noise of 1/z is nearly the same at all distances.
#pragma once

#include <vector>

#include "geometry/ray_table.h"
#include "image/image.h"

namespace theatron::registration {

// All points p with q . p = 1, in the camera's frame, metres. Not through the
// camera's centre.
struct Plane {
    Vec3 q;

    double inverse_depth(Ray ray) const { return q.x * ray.x + q.y * ray.y + q.z; }
    double distance_m() const { return 1 / length(q); }  // from the camera's centre
    // Unit normal towards the camera.
    Vec3 normal() const { return normalized(-q); }
    // The point where a ray meets the plane; the plane must lie in front of the camera there.
    Vec3 point(Ray ray) const {
        const double z = 1 / inverse_depth(ray);
        return {ray.x * z, ray.y * z, z};
    }
};

// Every second pixel of a depth image, with the pixels' rays.
struct SparseDepth {
    Size size;
    std::vector<float> inverse_m;      // 1/z, 0: no measurement
    const Image<Ray>* rays = nullptr;  // of the same size
};

struct SurfaceSize {
    double radius_m = 1;                            // no point is further from any other
    double least_area_m2 = 0, largest_area_m2 = 0;  // within this radius of one of its points
};

struct FoundPlane {
    Plane plane;
    Vec3 middle;  // mean of the points on it, camera frame, metres
    double area_m2 = 0;
};

// Largest distance from the plane of a measurement at this depth, metres: four
// deviations of an Azure Kinect's noise on a dark surface, and its slow errors.
inline constexpr double tolerance_m = 0.006, tolerance_per_m = 0.0012;
constexpr double plane_tolerance_m(double depth_m) {
    return tolerance_m + tolerance_per_m * depth_m * depth_m;
}

// Planes that hold a surface of this size, most of it measured. `explained` is
// scratch memory, resized as needed.
std::vector<FoundPlane> find_planes(const SparseDepth& depth, const SurfaceSize& wanted,
                                    std::vector<std::uint8_t>& explained);

}  // namespace theatron::registration
