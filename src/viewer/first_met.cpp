// SPDX-License-Identifier: Apache-2.0
#include "viewer/first_met.h"

namespace theatron::viewer {

std::optional<FirstMet> first_met(const render::SceneFrame& objects,
                                  const std::vector<CloudCamera>& cloud,
                                  const render::PickRay& ray) {
    std::optional<FirstMet> first;
    if (const auto picked = render::pick(objects, ray))
        first = {picked->distance_m, picked->place, picked->id};
    if (const auto point = pick_cloud(cloud, ray);
        point && (!first || point->distance_m < first->distance_m))
        first = {point->distance_m, point->place, std::nullopt};
    return first;
}

}  // namespace theatron::viewer
