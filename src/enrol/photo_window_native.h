// SPDX-License-Identifier: Apache-2.0
// The window in which a person's face is photographed and its landmarks are marked.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "capture/camera.h"
#include "enrol/landmark_finder.h"
#include "enrol/photo_guide.h"
#include "window/desktop_window_native.h"

namespace theatron::enrol {

// Goes through the guide's photos with the person. `camera` may be null for a guide of photos.
// nullopt: the person ended it, or `stops` said so. Throws Error if the camera fails.
std::optional<std::vector<Photo>> ask_photos(window::DesktopWindow& window, PhotoGuide guide,
                                             std::unique_ptr<capture::Camera> camera,
                                             const LandmarkFinder& finder,
                                             const std::function<bool()>& stops);

}  // namespace theatron::enrol
