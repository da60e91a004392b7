// SPDX-License-Identifier: Apache-2.0
// A board before a wall as a modelled depth sensor sees it, for tests and measurements.
#pragma once

#include <cmath>

#include "registration/board_image.h"

namespace theatron::registration {

// A board whose middle is `distance_m` in front of the camera and `off_axis` (x/z, y/z) beside its
// axis, turned about its own x and y axes by the tilts and about z by `roll`, degrees. Untilted it
// shows its front, upright in the picture.
inline Pose board_pose(double distance_m, Vec2 off_axis, double tilt_x, double tilt_y,
                       double roll) {
    const Pose upright{Quat{0, 1, 0, 0},
                       Vec3{off_axis.x, off_axis.y, 1} * distance_m};  // board's y up, z to us
    const Quat turn = rotation_about({0, 0, 1}, radians_of(roll)) *
                      rotation_about({0, 1, 0}, radians_of(tilt_y)) *
                      rotation_about({1, 0, 0}, radians_of(tilt_x));
    return upright * Pose{turn, {}};
}

struct BoardScene {
    Image<float> depth_m, reflectivity, cos_incidence;

    // A grey wall `wall_m` away, square to the camera's axis.
    BoardScene(Size size, double wall_m) : depth_m(size), reflectivity(size), cos_incidence(size) {
        std::fill(depth_m.pixels.begin(), depth_m.pixels.end(), float(wall_m));
        std::fill(reflectivity.pixels.begin(), reflectivity.pixels.end(), 0.5f);
        std::fill(cos_incidence.pixels.begin(), cos_incidence.pixels.end(), 0.9f);
    }

    void add(const LatticeTarget& target, const Pose& camera_from_board, const Image<Ray>& rays,
             float board_reflectivity = 0.8f) {
        const Image<BoardHit> board = board_image(target, camera_from_board, rays);
        for (std::size_t i = 0; i < board.pixels.size(); ++i) {
            const BoardHit& hit = board.pixels[i];
            if (hit.depth_m == 0 || (depth_m.pixels[i] != 0 && depth_m.pixels[i] < hit.depth_m))
                continue;
            depth_m.pixels[i] = hit.depth_m;
            reflectivity.pixels[i] = board_reflectivity;
            cos_incidence.pixels[i] = hit.cos_incidence;
        }
    }

    // `sensor` is a synthetic::DepthSensor of the same size.
    template <class Sensor>
    DepthImage seen_by(Sensor& sensor, std::uint32_t frame) const {
        DepthImage image(depth_m.size);
        sensor.capture({depth_m.view(), reflectivity.view(), cos_incidence.view(), {}}, frame,
                       image.view());
        return image;
    }
};

}  // namespace theatron::registration
