// SPDX-License-Identifier: Apache-2.0
// The first thing of the room that a ray meets: an object or a live cloud.
//
// A pure function; room coordinates, metres.
#pragma once

#include <optional>
#include <vector>

#include "render/pick.h"
#include "viewer/cloud_pick.h"

namespace theatron::viewer {

struct FirstMet {
    double distance_m = 0;
    Vec3 place;
    std::optional<render::PickId> object;  // none: a cloud
};
std::optional<FirstMet> first_met(const render::SceneFrame& objects,
                                  const std::vector<CloudCamera>& cloud,
                                  const render::PickRay& ray);

}  // namespace theatron::viewer
