// SPDX-License-Identifier: Apache-2.0
// The generated operating room with its team, as a modelled Azure Kinect sees it.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>

#include "registration/board_scene.h"
#include "synthetic/operating_room.h"
#include "synthetic/sensor_model.h"

namespace theatron::registration {

// MINUTES is set for a long test, which has time for a longer loop.
inline const synthetic::OperatingRoom& room_with_team() {
    static const synthetic::OperatingRoom room(
        {.seed = 3, .loop = std::getenv("MINUTES") ? Duration(60s) : Duration(4s), .detail = 0.3});
    return room;
}

// Exact surfaces with what a sensor model needs to know of them.
inline BoardScene scene_of(const synthetic::GroundTruth& truth, const Image<Ray>& rays) {
    BoardScene scene(truth.depth_m.size, 0);
    scene.depth_m = truth.depth_m;
    for (std::size_t i = 0; i < truth.surface.pixels.size(); ++i) {
        const synthetic::SurfaceSample& s = truth.surface.pixels[i];
        const Ray ray = rays.pixels[i];
        const double length = std::sqrt(ray.x * ray.x + ray.y * ray.y + 1.0);
        scene.reflectivity.pixels[i] = s.infrared;
        scene.cos_incidence.pixels[i] =
            float(std::max(0.0, -(s.nx * ray.x + s.ny * ray.y + s.nz) / length));
    }
    return scene;
}

// One camera in that room. `moved` is where the camera is, as seen from its place.
class RoomCamera {
public:
    RoomCamera(int index, int count, const synthetic::DepthSensorParams& sensor)
        : calibration(synthetic::synthetic_camera(synthetic::Variant::room, index, count, {})),
          rays_(make_ray_table(calibration.depth)),
          sensor_(sensor, calibration.depth.size, 70 + std::uint32_t(index)) {
        place_at({});
    }

    void place_at(const Pose& moved) {
        Calibration there = calibration;
        there.room_from_camera = calibration.room_from_camera * moved;
        view_ = room_with_team().look_from(there, {.depth = true, .surface = true, .color = false});
        scenes_.clear();
    }

    // Moments of the loop are drawn once; noise is new each time.
    DepthImage image(Duration time) {
        const Duration in_loop = time % room_with_team().loop_duration();
        auto found = scenes_.find(in_loop);
        if (found == scenes_.end())
            found =
                scenes_
                    .emplace(in_loop, scene_of(view_->render(*room_with_team().at(in_loop)), rays_))
                    .first;
        return found->second.seen_by(sensor_, frame_++);
    }

    const Calibration calibration;

private:
    Image<Ray> rays_;
    synthetic::DepthSensor sensor_;
    std::unique_ptr<synthetic::RoomView> view_;
    std::map<Duration, BoardScene> scenes_;
    std::uint32_t frame_ = 0;
};

}  // namespace theatron::registration
