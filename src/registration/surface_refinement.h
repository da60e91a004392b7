// SPDX-License-Identifier: Apache-2.0
// Better places of cameras from the scene's own surfaces: those that two cameras see are brought
// onto each other (point to plane, after Chen and Medioni, Image and Vision Computing 1992).
#pragma once

#include <vector>

#include "registration/surface_grid.h"

namespace theatron::registration {

struct SurfaceView {
    const SurfaceCamera* camera = nullptr;
    DepthView depth;  // of a still scene; a mean of some frames is better
    Pose reference_from_camera;
};

struct SurfaceRefinement {
    std::vector<Pose> reference_from_camera;  // as given where `is_kept` is false
    // Half of the surfaces, in tiles, took no part; their median distance tells before and after.
    double before_m = 0, after_m = 0;
    std::size_t points = 0;  // held out, after
    bool is_kept = false;    // that distance has fallen
};

struct RefinementOptions {
    double reach_m = 0.05;  // largest distance of surfaces that may be the same
    // How well the given places are known: deviations of shift and turn.
    double shift_m = 0.002, turn = 0.002;
};

// At least two views. The first one keeps its place.
SurfaceRefinement refine_on_surfaces(const std::vector<SurfaceView>& views,
                                     const RefinementOptions& options = {});

// `now` moved as a whole so that the camera whose place fits the others' best keeps the place that
// it has in `before`: a single camera that was moved does not move the room. Same sizes, at least
// one.
std::vector<Pose> with_most_places_kept(const std::vector<Pose>& before, std::vector<Pose> now);

}  // namespace theatron::registration
