// SPDX-License-Identifier: Apache-2.0
#include "live_scene.h"

#include <algorithm>

namespace theatron::app {
namespace {

// How much a camera that stands still is seen, and how long it takes to get there.
constexpr double stale_presence = 0.3;
constexpr double fading_seconds = 0.5;

}  // namespace

std::vector<CameraId> LiveScene::take(Participant& participant) {
    std::uint64_t generation = 0;
    const auto cameras = participant.cameras(generation);
    if (generation != generation_) {
        for (const auto& [id, calibration] : calibrations_)
            clouds_.remove_camera(id);
        calibrations_.clear();
        presence_.clear();
        newest_.clear();
        for (const auto& camera : cameras) {
            clouds_.set_camera(camera.description.id, camera.calibration);
            calibrations_[camera.description.id] = camera.calibration;
        }
        generation_ = generation;
    }
    std::vector<CameraId> updated;
    for (const auto& frame : participant.take_frames()) {
        const ColorView color = frame->color ? frame->color->view() : ColorView{};
        // A frame of a size that the calibration does not know cannot be shown.
        if (clouds_.upload(frame->camera, frame->depth.view(), color) == Status::ok) {
            newest_[frame->camera] = frame;
            updated.push_back(frame->camera);
        }
    }
    return updated;
}

bool LiveScene::fade(const Participant& participant, TimePoint now) {
    const double step = to_seconds(now - faded_at_) / fading_seconds;
    faded_at_ = now;
    std::uint64_t generation = 0;
    bool changed = false;
    for (const auto& camera : participant.cameras(generation)) {
        const CameraId id = camera.description.id;
        if (calibrations_.count(id) == 0)
            continue;
        const bool live = camera.state.condition == wire::CameraCondition::live;
        const double wanted = live ? 1 : stale_presence;
        double& presence = presence_.emplace(id, 1).first->second;
        if (presence == wanted)
            continue;
        presence = live ? std::min(wanted, presence + step) : std::max(wanted, presence - step);
        clouds_.set_presence(id, presence);
        changed = true;
    }
    return changed;
}

}  // namespace theatron::app
