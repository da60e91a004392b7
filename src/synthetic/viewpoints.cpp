// SPDX-License-Identifier: Apache-2.0
// Poses and lenses of the synthetic cameras.
#include <algorithm>
#include <array>

#include "synthetic/operating_room.h"

namespace theatron::synthetic {
namespace {

// The depth lens of an Azure Kinect in its narrow unbinned mode, 75 by 65 degrees. The numbers
// are like those of factory calibrations, slightly different per camera.
CameraModel depth_lens(int index) {
    CameraModel c;
    c.size = {640, 576};
    c.fx = 504.6 + 0.37 * (index % 5);
    c.fy = 504.7 + 0.37 * (index % 5);
    c.cx = 321.4 + 0.9 * (index % 3);
    c.cy = 331.9 - 0.8 * (index % 4);
    c.k = {0.5479, -0.02097, -0.002652, 0.8897, 0.08613, -0.01391};
    c.p1 = 2.06e-5;
    c.p2 = -7.21e-5;
    c.max_radius = 1.74;
    return c;
}

// The colour camera, 90 by 59 degrees at 16:9.
CameraModel color_lens(int index, Size size) {
    CameraModel c;
    c.size = {1280, 720};
    c.fx = 608.4 + 0.6 * (index % 4);
    c.fy = 608.2 + 0.6 * (index % 4);
    c.cx = 639.3 - 1.1 * (index % 3);
    c.cy = 365.8 + 0.7 * (index % 5);
    c.k = {0.3301, -2.4894, 1.4537, 0.2089, -2.3029, 1.3751};
    c.p1 = -1.62e-4;
    c.p2 = 1.29e-4;
    c.max_radius = 1.74;
    return scaled(c, size);
}

}  // namespace

Calibration synthetic_camera(Variant variant, int index, int count, Size color) {
    // The first two are at the table's foot, one on each side, each facing one of the people;
    // the others complete the circle at varying heights.
    struct Place {
        double degrees, radius, height;
    };
    static constexpr std::array<Place, max_viewpoints> places{{{-42, 1.62, 2.16},
                                                               {46, 1.64, 2.2},
                                                               {137, 1.62, 2.25},
                                                               {-132, 1.75, 2.3},
                                                               {2, 2.1, 2.0},
                                                               {182, 2.1, 2.05},
                                                               {-88, 1.9, 2.45},
                                                               {92, 1.9, 2.45},
                                                               {-20, 2.2, 1.8},
                                                               {158, 2.2, 1.8},
                                                               {25, 2.3, 1.9},
                                                               {-155, 2.3, 1.9}}};
    const Place place = places[std::size_t(std::clamp(index, 0, max_viewpoints - 1))];
    const double a = radians_of(place.degrees);
    Vec3 eye{place.radius * std::cos(a), place.height, place.radius * std::sin(a)};
    Vec3 target{0.0, 1.12, 0.02};
    if (variant == Variant::surgeon) {
        // On an arc in front of the surgeon, at about eye height.
        const int n = std::max(count, 1);
        const double turn = n == 1 ? 0.35 : -0.9 + 1.8 * (index + 0.5) / n;
        eye = {-0.1 + 1.35 * std::sin(turn), 1.72 + 0.06 * (index % 2),
               0.62 - 1.35 * std::cos(turn)};
        target = {-0.08, 1.36, 0.5};
    }
    Calibration c;
    c.depth = depth_lens(index);
    if (color.area() > 0)
        c.color = color_lens(index, color);
    c.color_from_depth = {rotation_about({1, 0, 0}, -0.105), {-0.0321, -0.0022, 0.0039}};
    c.room_from_camera = look_at(eye, target, {0, 1, 0});
    c.registered = true;
    return c;
}

Calibration free_viewpoint(Vec3 eye, Vec3 target, Size size, double horizontal_fov_degrees) {
    Calibration c;
    c.depth = c.color = pinhole(size, horizontal_fov_degrees);
    c.room_from_camera = look_at(eye, target, {0, 1, 0});
    c.registered = true;
    return c;
}

bool inside_hexagon(Size image, int x, int y) {
    // Straight lines fitted to the border of real 640x576 images.
    const double u = (x + 0.5) * 640 / image.width, v = (y + 0.5) * 576 / image.height;
    return u > 152.5 - 0.557 * v && u < 513.5 + 0.557 * v && u > 2 + 0.6 * (v - 337) &&
           u < 662.5 - 0.6 * (v - 337);
}

}  // namespace theatron::synthetic
