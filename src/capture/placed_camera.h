// SPDX-License-Identifier: Apache-2.0
// Any camera with its place in the room: by hand, or from a file of places.
#pragma once

#include <memory>
#include <optional>

#include "base/options.h"
#include "capture/camera.h"
#include "capture/camera_places.h"

namespace theatron::capture {

inline constexpr const char* place_help =
    "every camera: place=X:Y:Z[:YAW[:PITCH[:ROLL]]] (where it is in the room, metres and degrees)";

// The key `place`. Throws Error where it is not a place.
std::optional<Pose> take_place_option(Options& options);

// `camera`, registered at this place whatever its own calibration says.
std::unique_ptr<Camera> make_placed_camera(std::unique_ptr<Camera> camera, const Pose& place);

// Opens a camera and gives it the place and the corrections that `places` has under its name. A
// place in the specification, given by hand, overrides all of them. Throws as open_camera does.
std::unique_ptr<Camera> open_camera_at(const std::string& specification, const CameraPlaces& places,
                                       const Progress& progress = {});

}  // namespace theatron::capture
