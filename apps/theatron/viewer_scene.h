// SPDX-License-Identifier: Apache-2.0
// What a participant sees, drawn offscreen: the newest frames of all cameras.
#pragma once

#include <string>

#include "live_scene.h"
#include "render/offscreen_context_native.h"
#include "view_choice.h"

namespace theatron::app {

// Use from one thread.
class ViewerScene {
public:
    // Takes over what is new: cameras and frames.
    void take(Participant& participant) { (void)scene_.take(participant); }

    bool has_picture() const { return scene_.has_picture(); }
    std::size_t cameras() const { return scene_.calibrations().size(); }

    // Throws Error if that camera gave nothing, or if the driver reported an error.
    render::Picture render(const ViewChoice& view, Size size, const std::string& renderer);

private:
    render::OffscreenContext context_;
    LiveScene scene_;
};

}  // namespace theatron::app
