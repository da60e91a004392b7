// SPDX-License-Identifier: Apache-2.0
#include "live_scene.h"

namespace theatron::app {

std::vector<CameraId> LiveScene::take(Participant& participant) {
    std::uint64_t generation = 0;
    const auto cameras = participant.cameras(generation);
    if (generation != generation_) {
        for (const auto& [id, calibration] : calibrations_)
            clouds_.remove_camera(id);
        calibrations_.clear();
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

}  // namespace theatron::app
