// SPDX-License-Identifier: Apache-2.0
// The generated operating room with its team, as a modelled Azure Kinect sees it.
#pragma once

#include <algorithm>
#include <cmath>
#include <map>

#include "registration/board_scene.h"
#include "synthetic/operating_room.h"
#include "synthetic/sensor_model.h"

namespace theatron::registration {

// The room of most tests, with a short loop.
inline const synthetic::OperatingRoom& room_with_team() {
    static const synthetic::OperatingRoom room({.seed = 3, .loop = 4s, .detail = 0.3});
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
        view_ = room_->look_from(there, {.depth = true, .surface = true, .color = false});
        scenes_.clear();
    }

    // From its place it sees this room from now on, which must outlive it.
    void enter(const synthetic::OperatingRoom& room) {
        room_ = &room;
        place_at({});
    }

    // Moments of a short loop are drawn once; noise is new each time.
    DepthImage image(Duration time) {
        constexpr std::size_t most_kept = 20;
        const Duration in_loop = time % room_->loop_duration();
        auto found = scenes_.find(in_loop);
        if (found == scenes_.end()) {
            if (scenes_.size() == most_kept)
                scenes_.clear();
            found =
                scenes_.emplace(in_loop, scene_of(view_->render(*room_->at(in_loop)), rays_)).first;
        }
        return found->second.seen_by(sensor_, frame_++);
    }

    const Calibration calibration;

private:
    const synthetic::OperatingRoom* room_ = &room_with_team();
    Image<Ray> rays_;
    synthetic::DepthSensor sensor_;
    std::unique_ptr<synthetic::RoomView> view_;
    std::map<Duration, BoardScene> scenes_;
    std::uint32_t frame_ = 0;
};

}  // namespace theatron::registration
