// SPDX-License-Identifier: Apache-2.0
#include "viewer_scene.h"

#include "base/error.h"

namespace theatron::app {

void ViewerScene::take(Participant& participant) {
    std::uint64_t generation = 0;
    const auto cameras = participant.cameras(generation);
    if (generation != generation_) {
        for (const auto& [id, calibration] : calibrations_)
            scene_.remove_camera(id);
        calibrations_.clear();
        for (const auto& camera : cameras) {
            scene_.set_camera(camera.description.id, camera.calibration);
            calibrations_[camera.description.id] = camera.calibration;
        }
        generation_ = generation;
    }
    for (const auto& frame : participant.take_frames()) {
        const ColorView color = frame->color ? frame->color->view() : ColorView{};
        // A frame of a size that the calibration does not know cannot be shown.
        if (scene_.upload(frame->camera, frame->depth.view(), color) == Status::ok)
            newest_[frame->camera] = frame;
    }
}

render::Picture ViewerScene::render(const ViewChoice& view, Size size,
                                    const std::string& renderer) {
    const render::CameraView camera_view = view.resolve(calibrations_, newest_, size);
    render::Picture picture = scene_.render(camera_view, size, renderer);
    if (context_.errors() > 0)
        throw Error("The graphics driver reported an error: " + context_.first_error());
    return picture;
}

}  // namespace theatron::app
